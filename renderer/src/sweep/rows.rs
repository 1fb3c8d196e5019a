//! Rows of a CSV file: a column for each key, a task for each row.

use std::path::Path;

use csv::{ErrorKind, Position, ReaderBuilder, StringRecord, Trim};
use leafmodel::document::context::{Context, QUOTED};
use leafmodel::document::error::DocumentError;
use leafmodel::document::source::{Place, escaped};

use super::{Axis, Cell, Key, MOST_TASKS, cell, impossible};

/// Greatest size of a CSV file, bytes.
pub(super) const MOST_BYTES: u64 = 1 << 30;

/// The columns of the file at `path`, which `written` names at `at`. Lines that begin with `#` are
/// comments.
pub(super) fn read(cx: &Context, path: &Path, written: &str, at: &Place) -> Option<Axis> {
    let bad = |problem: String, help: &str| {
        let error = DocumentError::BadFile {
            path: escaped(written, QUOTED),
            problem,
            help: help.to_owned(),
        };
        cx.error(at, error);
    };
    let text = match std::fs::read_to_string(path) {
        Ok(text) => text,
        Err(error) => {
            bad(format!("cannot be read: {error}"), "save it as UTF-8 text");
            return None;
        }
    };
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
    let source = cx.sources.borrow_mut().add(escaped(written, QUOTED), text);
    let errors = cx.error_count();
    let file = File { cx, source, text };
    let mut reader = ReaderBuilder::new()
        .trim(Trim::All)
        .comment(Some(b'#'))
        .has_headers(false)
        .from_reader(text.as_bytes());
    let mut axis = Axis {
        keys: Vec::new(),
        rows: Vec::new(),
    };
    for record in reader.records() {
        match record {
            Ok(record) if axis.keys.is_empty() => axis.keys = file.header(&record),
            Ok(record) => axis.rows.extend(file.row(&record, &axis.keys)),
            Err(error) => {
                file.broken(&error);
                return None;
            }
        }
        if cx.is_full() || axis.rows.len() > MOST_TASKS {
            break;
        }
    }
    if axis.rows.is_empty() && cx.error_count() == errors {
        bad(
            "has no rows".to_owned(),
            "write keys into its first line, and values into a line for each task",
        );
    }
    (cx.error_count() == errors).then_some(axis)
}

/// A CSV file that is among the texts of a sweep.
struct File<'c> {
    cx: &'c Context,
    source: usize,
    text: &'c str,
}

impl File<'_> {
    fn header(&self, record: &StringRecord) -> Vec<Key> {
        let places = self.places(record);
        let keys = record.iter().zip(places).map(|(path, at)| {
            if path.is_empty() {
                let help = "write the key that the column sets";
                impossible(self.cx, &at, "", "a column without a key", help);
            }
            let path = path.to_owned();
            Key { path, at }
        });
        keys.collect()
    }

    fn row(&self, record: &StringRecord, keys: &[Key]) -> Option<Vec<Cell>> {
        let places = self.places(record);
        let cells = record.iter().zip(keys).zip(places);
        cells
            .map(|((text, key), at)| cell(self.cx, &key.path, text, at))
            .collect()
    }

    /// Where the fields of a record stand.
    fn places(&self, record: &StringRecord) -> Vec<Place> {
        let mut from = record.position().map_or(0, Position::byte) as usize;
        let mut places = Vec::with_capacity(record.len());
        for field in record {
            let rest = self.text.get(from..).unwrap_or_default();
            // A field with doubled quotes stands there otherwise: then it is the rest of its line.
            let span = match rest.find(field) {
                Some(start) => from + start..from + start + field.len(),
                None => from..from + rest.find('\n').unwrap_or(rest.len()),
            };
            from = span.end;
            places.push(Place {
                source: self.source,
                span,
            });
        }
        places
    }

    /// A record that is none.
    fn broken(&self, error: &csv::Error) {
        let position = error.position().map_or(0, Position::byte) as usize;
        let line = self.text.get(position..).unwrap_or_default();
        // The position is behind the line before.
        let start = position + (line.len() - line.trim_start().len());
        let line = self.text.get(start..).unwrap_or_default();
        let at = Place {
            source: self.source,
            span: start..start + line.find('\n').unwrap_or(line.len()),
        };
        let problem = if let ErrorKind::UnequalLengths {
            expected_len, len, ..
        } = error.kind()
        {
            format!("a row of {len} values under {expected_len} keys")
        } else {
            error.to_string()
        };
        let help = "write one value for each key of the first line; quote values with commas";
        impossible(self.cx, &at, "rows", problem, help);
    }
}
