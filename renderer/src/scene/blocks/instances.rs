//! `[objects.NAME.instances]`: a file with one row for each place of an object.
//!
//! - **In**: text with a header ([`text`]) or a structured `NumPy` array ([`npy`]); both have the
//!   same column names ([`columns`]).
//! - **Out**: places in the world, 64 bytes each, in the file's order; or errors, each with row,
//!   column, value and allowed range.
//! - **Always true**: numbers are finite and in range, shapes are among the object's.
//! - **Left out**: relations between rows. Instances may overlap.
//!
//! Rows are read on all threads. A number of wrong rows is reported, the others are
//! only counted, so that reports stay short and fast for a million rows.

mod columns;
mod npy;
mod table;
mod text;

use std::fs;
use std::path::Path;

use glam::DMat4;

use self::table::{Rows, ShapeNames, Table};
use crate::scene::description::InstancePlace;
use leafmodel::document::context::{Context, QUOTED};
use leafmodel::document::keys::Keys;
use leafmodel::document::rows::{Decimal, Form, Separator};
use leafmodel::document::source::{Place, escaped};
use leafmodel::document::value_kind::{FilePath, NamedFile, Word};

/// The keys of the block. Rows choose from `shapes`; `frame` maps the rows' coordinates to the
/// world. Without either, only the existence of the file is checked.
pub(super) fn instances(
    places: &mut Vec<InstancePlace>,
    keys: &mut Keys<'_>,
    shapes: Option<&ShapeNames>,
    frame: Option<DMat4>,
) {
    const PATH: FilePath = FilePath::of(
        "the path of a CSV or NPY file with a row a place",
        &["csv", "tsv", "txt", "npy"],
        2 << 30,
    );
    let mut named = NamedFile::default();
    keys.needed("file", &mut named, PATH, "The file.");
    let mut form = Form::default();
    let about = "What separates the fields of a text, instead of a guess.";
    keys.optional(
        "separator",
        &mut form.separator,
        Word(&Separator::ALL),
        about,
    );
    let about = "The decimal mark of a text, instead of a guess.";
    keys.optional("decimal", &mut form.decimal, Word(&Decimal::ALL), about);
    let (Some(block), true) = (keys.reader(), keys.is_sound()) else {
        return;
    };
    let at = block.node("file").map_or(&block.at, |node| &node.at);
    if let (Some(shapes), Some(frame)) = (shapes, frame) {
        let table = Table::new(escaped(&named.written, 2 * QUOTED), shapes, frame);
        let rows = read_rows(block.cx, &table, &named.file, at, form);
        if let Some(rows) = rows
            && table.report(block.cx, at, &rows).is_some()
        {
            *places = rows.places;
        }
    }
}

fn read_rows(cx: &Context, table: &Table<'_>, file: &Path, at: &Place, form: Form) -> Option<Rows> {
    let bytes = match fs::read(file) {
        Ok(bytes) => bytes,
        Err(error) => {
            table.refuse(
                cx,
                at,
                format!("cannot be read: {error}"),
                "make the file readable",
            );
            return None;
        }
    };
    let is_array = file
        .extension()
        .is_some_and(|ending| ending.eq_ignore_ascii_case("npy"));
    if is_array {
        npy::read(cx, table, at, &bytes)
    } else {
        text::read(cx, table, at, &bytes, form)
    }
}
