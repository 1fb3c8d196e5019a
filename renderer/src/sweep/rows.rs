//! Rows of a CSV file: a column for each key, a task for each row.

use std::path::Path;

use leafmodel::document::context::{Context, QUOTED};
use leafmodel::document::encoding::decoded;
use leafmodel::document::error::DocumentError;
use leafmodel::document::rows::{Field, Form, Ragged, Row, Rows};
use leafmodel::document::source::{Place, escaped};

use super::values::{Axis, Cell, Key, MOST_TASKS, cell, impossible};

/// Greatest size of a CSV file, bytes.
pub(super) const MOST_BYTES: u64 = 1 << 30;

/// The columns of the file at `path`, which `written` names at `at`.
pub(super) fn read(
    cx: &Context,
    path: &Path,
    written: &str,
    at: &Place,
    form: Form,
) -> Option<Axis> {
    let bad = |problem: String, help: &str| {
        let error = DocumentError::BadFile {
            path: escaped(written, QUOTED),
            problem,
            help: help.to_owned(),
        };
        cx.error(at, error);
    };
    let bytes = std::fs::read(path)
        .map_err(|error| bad(format!("cannot be read: {error}"), "make it readable"))
        .ok()?;
    let decoded = decoded(&bytes)
        .map_err(|error| bad(error.to_string(), "save it as UTF-8 text"))
        .ok()?;
    let errors = cx.error_count();
    let text = &*decoded.text;
    let source = cx.sources.borrow_mut().add(escaped(written, QUOTED), text);
    let table = Rows::written(text, form);
    let good = |row: Result<Row, Ragged>| {
        let ragged = row.map(|row| row.fields);
        ragged
            .map_err(|ragged| cx.error(&ragged.at(source), ragged.error()))
            .ok()
    };
    let mut records = table
        .records()
        .take_while(|_| !cx.is_full())
        .filter_map(good);
    let keys = records
        .next()
        .map_or_else(Vec::new, |names| header(cx, source, names));
    // One more than may be, which the sweep refuses.
    let rows = records
        .take(MOST_TASKS + 1)
        .filter_map(|fields| row(cx, source, &keys, fields, &table))
        .collect();
    let axis = Axis { keys, rows };
    if axis.rows.is_empty() && cx.error_count() == errors {
        bad(
            "has no rows".to_owned(),
            "write keys into its first line, and values into a line for each task",
        );
    }
    for guess in decoded.guess().into_iter().chain(table.guesses()) {
        let message = format!("\"{}\": {}", escaped(written, QUOTED), guess.what);
        let help = guess.key();
        let help = help
            .as_deref()
            .unwrap_or("save it as UTF-8 if that is wrong");
        cx.warn(at, "sweep::table", message, help);
    }
    (cx.error_count() == errors).then_some(axis)
}

fn header(cx: &Context, source: usize, names: Vec<Field>) -> Vec<Key> {
    let keys = names.into_iter().map(|name| {
        let (at, path) = (name.at(source), name.text);
        if path.is_empty() {
            let help = "write the key that the column sets";
            impossible(cx, &at, "", "a column without a key", help);
        }
        Key { path, at }
    });
    keys.collect()
}

fn row(
    cx: &Context,
    source: usize,
    keys: &[Key],
    fields: Vec<Field>,
    table: &Rows<'_>,
) -> Option<Vec<Cell>> {
    let cells = fields.into_iter().zip(keys);
    cells
        .map(|(field, key)| {
            let at = field.at(source);
            let has_comma = field.text.contains(',') && table.is_number(&field.text);
            let text = if has_comma {
                field.text.replace(',', ".")
            } else {
                field.text
            };
            cell(cx, &key.path, &text, at)
        })
        .collect()
}
