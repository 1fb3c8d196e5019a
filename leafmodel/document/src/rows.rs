//! Tables as text: rows of fields with the places that reports show.
//!
//! One reader for every table of the program. Tabs, semicolons, commas or blanks separate the
//! fields; which of them do is found from the first lines, unless the caller knows. Lines that begin
//! with `#` are comments. A comma within a field is a decimal comma.
//!
//! - **In**: text, with or without a byte order mark, whose lines end in any of the three ways.
//! - **Out**: rows, each with its line and fields, each field with its bytes of the text.
//! - **Always true**: no row is left out; one whose fields are too few or too many is a [`Ragged`].
//! - **Left out**: what columns mean.
//!
//! ```
//! use document::rows::Rows;
//!
//! let rows = Rows::of("nm;R\n400;0,05\n410;0,06\n");
//! let found: Result<Vec<_>, _> = rows.records().collect();
//! let found = found.expect("each row has two fields");
//! assert_eq!(rows.number(&found[1].fields[1]), Some(0.05));
//! assert_eq!(rows.guesses().len(), 1, "decimal commas are a guess");
//! ```

mod form;

use std::borrow::Cow;
use std::cell::Cell;
use std::ops::Range;

use csv::{ReaderBuilder, StringRecord, Trim};
use thiserror::Error;

use self::form::parsed;
pub use self::form::{Decimal, Form, Separator, number};
use super::error::DocumentError;
use super::source::{Place, quoted};

/// A table as text.
#[derive(Debug)]
pub struct Rows<'t> {
    text: &'t str,
    from: usize,
    separator: Separator,
    /// What might separate fields as well, where nobody has said what does.
    rival: Option<Separator>,
    decimal: Option<Decimal>,
    is_loose: bool,
    has_commas: Cell<bool>,
}

/// A row of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    /// The byte of the text at which it begins.
    start: usize,
    /// The line on which it begins, counted from 1.
    pub line: usize,
    /// Its fields.
    pub fields: Vec<Field>,
}

/// A field of a row.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field {
    /// What is written, without quotes and the spaces around it.
    pub text: String,
    /// Its bytes of the text.
    pub span: Range<usize>,
}

impl Row {
    /// Drops empty fields behind so many.
    pub fn cut(&mut self, most: usize) {
        while self.fields.len() > most
            && self.fields.last().is_some_and(|last| last.text.is_empty())
        {
            self.fields.pop();
        }
    }

    /// The bytes from its first field to its last.
    pub fn span(&self) -> Range<usize> {
        let last = self.fields.last().map_or(self.start, |last| last.span.end);
        self.start..last
    }
}

impl Field {
    /// Its place in a text of a document.
    pub fn at(&self, source: usize) -> Place {
        let span = self.span.clone();
        Place { source, span }
    }

    /// As messages repeat it.
    pub fn shown(&self) -> String {
        quoted(&self.text)
    }
}

/// A row with another number of fields than the first.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("the line has {found} values, but there are {wanted} columns")]
pub struct Ragged {
    /// Its line, counted from 1.
    pub line: usize,
    /// The bytes of the line.
    pub span: Range<usize>,
    /// How many it has.
    pub found: usize,
    /// How many the first row has.
    pub wanted: usize,
}

impl Ragged {
    /// Its place in a text of a document.
    pub fn at(&self, source: usize) -> Place {
        let span = self.span.clone();
        Place { source, span }
    }

    /// As an error of a document.
    pub fn error(&self) -> DocumentError {
        DocumentError::Impossible {
            key: "rows".to_owned(),
            problem: self.to_string(),
            help: "write one value for each name of the first line; quote values with commas"
                .to_owned(),
        }
    }
}

/// A text without the mark that some programs put in front.
pub fn without_mark(text: &str) -> &str {
    text.strip_prefix('\u{feff}').unwrap_or(text)
}

impl<'t> Rows<'t> {
    /// The rows of a text.
    pub fn of(text: &'t str) -> Self {
        Self::written(text, Form::default())
    }

    /// The rows of a text whose separator or decimal mark may be known.
    pub fn written(text: &'t str, form: Form) -> Self {
        Self::below(text, 0, form)
    }

    /// The rows from a byte of the text on.
    pub fn below(text: &'t str, byte: usize, Form { separator, decimal }: Form) -> Self {
        let from = byte.max(text.len() - without_mark(text).len());
        let (separator, rival) = match separator {
            Some(separator) => (separator, None),
            None => Separator::with_rival(&text[from..]),
        };
        Self {
            text,
            from,
            separator,
            rival,
            decimal,
            is_loose: false,
            has_commas: Cell::new(false),
        }
    }

    /// Rows of plain numbers: comments may follow them, and a line may have a separator of its own.
    pub fn of_numbers(self) -> Self {
        let is_loose = true;
        Self { is_loose, ..self }
    }

    /// Whether a text is a number as this table may write it.
    pub fn is_number(&self, text: &str) -> bool {
        self.parsed(text).is_some()
    }

    /// The number in a field. It may have a decimal comma, unless the caller knows better.
    pub fn number(&self, field: &Field) -> Option<f64> {
        self.parsed(&field.text)
    }

    fn parsed(&self, text: &str) -> Option<f64> {
        let (number, has_comma) = parsed(text)?;
        if has_comma {
            self.has_commas.set(true);
        }
        let is_point = self.decimal == Some(Decimal::Point);
        (!has_comma || !is_point).then_some(number)
    }

    /// What was taken for granted in what has been read, and the flag that says otherwise.
    pub fn guesses(&self) -> Vec<Guess> {
        let has_decimal_commas = self.has_commas.get() && self.decimal.is_none();
        let decimal = has_decimal_commas.then(Guess::decimal_commas);
        // Commas that are decimal marks separate nothing.
        let rival = self
            .rival
            .filter(|rival| *rival != Separator::Comma || !self.has_commas.get());
        let separator = rival.map(|rival| Guess {
            what: format!("each {} separates fields", self.separator.word()),
            otherwise: Some(("separator", rival.word())),
        });
        separator.into_iter().chain(decimal).collect()
    }

    /// All rows, the names of columns first.
    pub fn records(&self) -> impl Iterator<Item = Result<Row, Ragged>> + use<'t, '_> {
        let mut wanted = None;
        self.of_any_length().map(move |mut row| {
            let wanted = *wanted.get_or_insert(row.fields.len());
            // Spreadsheets end rows with separators.
            row.cut(wanted);
            let found = row.fields.len();
            if found == wanted {
                return Ok(row);
            }
            let start = row.start;
            let rest = &self.text[start..];
            let end = rest.find(['\n', '\r']).unwrap_or(rest.len());
            Err(Ragged {
                line: row.line,
                span: start..start + rest[..end].trim_end().len(),
                found,
                wanted,
            })
        })
    }

    /// All rows, however many fields they have.
    pub fn of_any_length(&self) -> impl Iterator<Item = Row> + use<'t, '_> {
        let text = &self.text[self.from..];
        // Fields keep their places.
        let text: Cow<'t, [u8]> = if self.separator == Separator::Blanks {
            text.replace('\t', " ").into_bytes().into()
        } else {
            text.as_bytes().into()
        };
        let mut reader = ReaderBuilder::new()
            .delimiter(self.separator.byte())
            .trim(Trim::All)
            .comment(Some(b'#'))
            .has_headers(false)
            .flexible(true)
            .from_reader(std::io::Cursor::new(text));
        let mut record = StringRecord::new();
        let mut lines = Lines::of(self.text);
        std::iter::from_fn(move || {
            loop {
                // The text is UTF-8 and lies in memory, so that nothing can fail.
                if !reader.read_record(&mut record).unwrap_or(false) {
                    return None;
                }
                let start = self.start(record.position().map_or(0, csv::Position::byte) as usize);
                let fields = self.fields(start, &record);
                let is_comment = matches!(&fields[..], [only] if only.text.starts_with('#'));
                if !fields.is_empty() && !is_comment {
                    let line = lines.at(start);
                    return Some(Row {
                        start,
                        line,
                        fields,
                    });
                }
            }
        })
    }

    /// The fields of a record that begins at a byte of the text.
    fn fields(&self, start: usize, record: &StringRecord) -> Vec<Field> {
        let mut from = start;
        let separator = char::from(self.separator.byte());
        let mut fields: Vec<Field> = Vec::with_capacity(record.len());
        for text in record {
            if text.is_empty() && self.separator == Separator::Blanks {
                continue;
            }
            let rest = self.text.get(from..).unwrap_or_default();
            // A field with doubled quotes is written otherwise: then it is the rest of its line.
            let span = match rest.find(text) {
                Some(at) => from + at..from + at + text.len(),
                None => from..from + rest.find('\n').unwrap_or(rest.len()),
            };
            let after = self.text.get(span.end..).unwrap_or_default();
            let after = after.strip_prefix('"').unwrap_or(after);
            let after = after.trim_start_matches(' ');
            from = self.text.len() - after.strip_prefix(separator).unwrap_or(after).len();
            let text = text.to_owned();
            fields.push(Field { text, span });
        }
        if self.is_loose {
            self.loosen(&mut fields);
        }
        fields
    }

    /// Cuts the comment behind numbers, and parts a line by its own separator if it lacks the
    /// table's.
    fn loosen(&self, fields: &mut Vec<Field>) {
        // A field with doubled quotes is written otherwise.
        let is_exact = |field: &Field| self.text.get(field.span.clone()) == Some(&field.text);
        if let Some(at) = fields.iter().position(|field| field.text.contains('#')) {
            let is_exact = is_exact(&fields[at]);
            let field = &mut fields[at];
            let kept = field.text.split('#').next().unwrap_or_default().trim_end();
            let length = kept.len();
            field.text.truncate(length);
            if is_exact {
                field.span.end = field.span.start + length;
            }
            fields.truncate(at + usize::from(length > 0));
        }
        if let [only] = fields.as_slice()
            && is_exact(only)
        {
            let own = Separator::of(&only.text);
            if own != self.separator && own.count(&only.text) > 1 {
                let form = Form {
                    separator: Some(own),
                    decimal: self.decimal,
                };
                let start = only.span.start;
                let inner = Rows::written(&only.text, form);
                let parts = inner.of_any_length().flat_map(|row| row.fields);
                let moved = parts.map(|part| Field {
                    span: part.span.start + start..part.span.end + start,
                    text: part.text,
                });
                *fields = moved.collect();
            }
        }
    }

    /// Where a record begins. The reader gives a position before empty lines and comments, counted
    /// from where it began.
    fn start(&self, position: usize) -> usize {
        let rest = self.text.get(self.from + position..).unwrap_or_default();
        let mut rest = rest.trim_start();
        while rest.starts_with('#') {
            let below = rest.split_once(['\n', '\r']);
            rest = below.map_or("", |(_, below)| below).trim_start();
        }
        self.text.len() - rest.len()
    }
}

/// Lines of bytes that are asked for in their order.
struct Lines<'t> {
    text: &'t [u8],
    byte: usize,
    line: usize,
}

impl<'t> Lines<'t> {
    fn of(text: &'t str) -> Self {
        Self {
            text: text.as_bytes(),
            byte: 0,
            line: 1,
        }
    }

    fn at(&mut self, byte: usize) -> usize {
        while self.byte < byte.min(self.text.len()) {
            let is_pair = self.text.get(self.byte + 1) == Some(&b'\n');
            self.line += match self.text[self.byte] {
                b'\n' => 1,
                b'\r' => usize::from(!is_pair),
                _ => 0,
            };
            self.byte += 1;
        }
        self.line
    }
}

/// Something about a file that was taken for granted, or left out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Guess {
    /// What, as a sentence.
    pub what: String,
    /// The flag, and its value, that say otherwise.
    pub otherwise: Option<(&'static str, &'static str)>,
}

impl Guess {
    /// That commas are decimal marks.
    pub fn decimal_commas() -> Self {
        Self {
            what: "commas in numbers are decimal marks".to_owned(),
            otherwise: Some(("decimal", "point")),
        }
    }

    /// That a file which says nothing of its encoding, and is not UTF-8, is read as Latin-1.
    pub(crate) fn latin_1() -> Self {
        Self {
            what: "it is not in UTF-8, and is read as Latin-1 (Windows-1252)".to_owned(),
            otherwise: None,
        }
    }
}

impl Guess {
    /// What to write in the file that names this one, if the guess is wrong.
    pub fn key(&self) -> Option<String> {
        let (key, value) = self.otherwise?;
        Some(format!(
            "if that is wrong, write `{key} = \"{value}\"` beside the file"
        ))
    }
}

impl std::fmt::Display for Guess {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.what)?;
        match self.otherwise {
            Some((flag, value)) => write!(f, " (if not, say --{flag} {value})"),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests;
