//! Rows of CSV text: fields with the places that reports show.
//!
//! Commas, semicolons or tabs separate the fields, whichever the first row has most of. Lines that
//! begin with `#` are comments.

use csv::{ErrorKind, Position, ReaderBuilder, StringRecord, Trim};

use super::context::Context;
use super::error::DocumentError;
use super::source::Place;

/// CSV text among the texts of a document.
#[derive(Clone, Copy, Debug)]
pub struct Rows<'c> {
    cx: &'c Context,
    source: usize,
    text: &'c str,
    delimiter: u8,
}

/// A field of a row.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field {
    /// What is written, without quotes and the spaces around it.
    pub text: String,
    /// Where.
    pub at: Place,
}

impl<'c> Rows<'c> {
    /// Takes a text in under the name that reports show.
    pub fn of(cx: &'c Context, name: impl Into<String>, text: &'c str) -> Self {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let source = cx.sources.borrow_mut().add(name, text);
        Self {
            cx,
            source,
            text,
            delimiter: delimiter(text),
        }
    }

    /// Whether numbers may have a decimal comma, because something else separates the fields.
    pub fn have_decimal_commas(&self) -> bool {
        self.delimiter != b','
    }

    /// All rows, the names of columns first. They end early, with an error, at a row whose fields
    /// are not as many, and where errors are enough.
    pub fn records(self) -> impl Iterator<Item = Vec<Field>> + use<'c> {
        let mut reader = ReaderBuilder::new()
            .delimiter(self.delimiter)
            .trim(Trim::All)
            .comment(Some(b'#'))
            .has_headers(false)
            .from_reader(self.text.as_bytes());
        let mut record = StringRecord::new();
        std::iter::from_fn(move || {
            if self.cx.is_full() {
                return None;
            }
            match reader.read_record(&mut record) {
                Ok(true) => Some(self.fields(&record)),
                Ok(false) => None,
                Err(error) => {
                    self.broken(&error);
                    None
                }
            }
        })
        .fuse()
    }

    fn fields(&self, record: &StringRecord) -> Vec<Field> {
        let mut from = self.start(record.position());
        let place = |field: &str| {
            let rest = self.text.get(from..).unwrap_or_default();
            // A field with doubled quotes is written otherwise: then it is the rest of its line.
            let span = match rest.find(field) {
                Some(start) => from + start..from + start + field.len(),
                None => from..from + rest.find('\n').unwrap_or(rest.len()),
            };
            let is_delimiter = self.text.as_bytes().get(span.end) == Some(&self.delimiter);
            from = span.end + usize::from(is_delimiter);
            Place {
                source: self.source,
                span,
            }
        };
        let places: Vec<Place> = record.iter().map(place).collect();
        let texts = record.iter().map(str::to_owned);
        let fields = texts.zip(places).map(|(text, at)| Field { text, at });
        fields.collect()
    }

    /// Where a record begins. The reader gives a position before empty lines and comments.
    fn start(&self, position: Option<&Position>) -> usize {
        let mut rest = self
            .text
            .get(position.map_or(0, Position::byte) as usize..)
            .unwrap_or_default()
            .trim_start();
        while rest.starts_with('#') {
            rest = rest.split_once('\n').map_or("", |(_, below)| below);
            rest = rest.trim_start();
        }
        self.text.len() - rest.len()
    }

    /// Reports a record that is none.
    fn broken(&self, error: &csv::Error) {
        let start = self.start(error.position());
        let line = self.text.get(start..).unwrap_or_default();
        let at = Place {
            source: self.source,
            span: start..start + line.find('\n').unwrap_or(line.len()),
        };
        let problem = if let ErrorKind::UnequalLengths {
            expected_len, len, ..
        } = error.kind()
        {
            format!("a row of {len} values under {expected_len} names")
        } else {
            error.to_string()
        };
        let help = "write one value for each name of the first line; quote values with commas";
        let error = DocumentError::Impossible {
            key: "rows".to_owned(),
            problem,
            help: help.to_owned(),
        };
        self.cx.error(&at, error);
    }
}

/// The separator that the first row has most of.
pub fn delimiter(text: &str) -> u8 {
    let names = text
        .lines()
        .find(|line| !line.starts_with('#') && !line.trim().is_empty());
    let names = names.unwrap_or_default();
    let count = |separator: u8| names.bytes().filter(|byte| *byte == separator).count();
    // The last of equals is taken, so that the comma wins.
    [b'\t', b';', b',']
        .into_iter()
        .max_by_key(|separator| count(*separator))
        .unwrap_or(b',')
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::source::Sources;

    fn context() -> Context {
        Context::new(Sources::default(), ".".into())
    }

    #[test]
    fn a_field_lies_where_it_is_written_below_comments_that_hold_it_too() {
        let cx = context();
        let text = "\u{feff}a;b;c\n\n# 7 and 8\n 7;;\"8\"\r\n";
        let rows: Vec<Vec<Field>> = Rows::of(&cx, "t.csv", text).records().collect();
        let shown: Vec<(&str, String)> = rows
            .iter()
            .flatten()
            .map(|field| (field.text.as_str(), cx.shown(&field.at)))
            .collect();
        let at = |text, place: &str| (text, format!("t.csv:{place}"));
        let wanted = [
            at("a", "1:1"),
            at("b", "1:3"),
            at("c", "1:5"),
            at("7", "4:2"),
            at("", "4:4"),
            at("8", "4:6"),
        ];
        assert_eq!(shown, wanted);
    }

    #[test]
    fn a_row_with_too_few_fields_is_an_error_at_its_line() {
        let cx = context();
        let rows = Rows::of(&cx, "t.csv", "a,b\n# x\n1,2\n3\n5,6\n");
        assert_eq!(rows.records().count(), 2);
        let (sources, errors, _) = cx.into_parts();
        let places: Vec<String> = errors
            .iter()
            .filter_map(|error| Some(sources.shown(error.at.as_ref()?)))
            .collect();
        assert_eq!(places, ["t.csv:4:1"]);
    }
}
