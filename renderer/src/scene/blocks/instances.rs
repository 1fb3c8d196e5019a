//! `[objects.NAME.instances]`: a file with one row for each place of an object.
//!
//! - **In**: text with a header ([`text`]) or a structured `NumPy` array ([`npy`]); both have the
//!   same column names ([`columns`]).
//! - **Out**: places in the world, 64 bytes each, in the file's order; or errors, each with row,
//!   column, value and allowed range.
//! - **Always true**: numbers are finite and in range, shapes are among the object's.
//! - **Left out**: relations between rows. Instances may overlap.
//!
//! Rows are read on all threads. The first [`MOST_REPORTED`] wrong rows are reported, the others are
//! only counted, so that reports stay short and fast for a million rows.

mod columns;
mod npy;
mod text;

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use glam::DMat4;
use rayon::prelude::*;

use self::columns::{RowError, WrongRow};
use crate::scene::description::InstancePlace;
use leafmodel::document::context::{Context, QUOTED};
use leafmodel::document::error::DocumentError;
use leafmodel::document::keys::Keys;
use leafmodel::document::rows::{Decimal, Form, Separator};
use leafmodel::document::source::{Place, escaped};
use leafmodel::document::value_kind::{FilePath, NamedFile, Word};

/// Greatest number of wrong rows of a file that are reported one by one.
const MOST_REPORTED: usize = 20;

/// Greatest number of rows of a file, so that the picture's 32-bit layers can number them.
const MOST_ROWS: usize = 1 << 24;

/// The names of an object's shapes, in the order in which the object lists them.
type ShapeNames = [String];

/// Data for reading the rows of a file.
#[derive(Debug)]
struct Table<'a> {
    /// The path as written, safe to print.
    name: String,
    shapes: &'a ShapeNames,
    /// Index of each name in the list; `None` if the name occurs more than once.
    numbers: BTreeMap<&'a str, Option<u32>>,
    /// Local to world of the frame in which the rows are given.
    frame: DMat4,
}

/// The result of reading some rows of a file.
#[derive(Debug)]
struct Rows {
    places: Vec<InstancePlace>,
    /// The first wrong ones.
    wrong: Vec<WrongRow>,
    wrong_count: usize,
}

impl Rows {
    /// Reads rows on all threads, each with its number; `wrong` is one with errors.
    fn read<R: Copy + Sync>(
        rows: &[(usize, R)],
        read: impl Fn(R) -> Result<InstancePlace, Vec<RowError>> + Sync,
        wrong: impl Fn(usize, R, Vec<RowError>) -> WrongRow,
    ) -> Self {
        let found = rows.par_iter().map(|(_, row)| read(*row).ok());
        let found: Vec<Option<InstancePlace>> = found.collect();
        // The errors of the few that are reported are found again.
        let missing = rows.iter().zip(&found).filter(|(_, place)| place.is_none());
        let errors = missing
            .take(MOST_REPORTED)
            .filter_map(|((number, row), _)| {
                let errors = read(*row).err()?;
                Some(wrong(*number, *row, errors))
            });
        Self {
            wrong: errors.collect(),
            wrong_count: found.iter().filter(|place| place.is_none()).count(),
            places: found.into_iter().flatten().collect(),
        }
    }
}

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

impl<'a> Table<'a> {
    fn new(name: String, shapes: &'a ShapeNames, frame: DMat4) -> Self {
        let mut numbers = BTreeMap::new();
        for (number, shape) in shapes.iter().map(String::as_str).enumerate() {
            let number = Some(number as u32);
            let known = numbers.entry(shape).or_insert(number);
            if *known != number {
                *known = None;
            }
        }
        Self {
            name,
            shapes,
            numbers,
            frame,
        }
    }

    /// Reports an error of the file as a whole at its name in the scene.
    fn refuse(&self, cx: &Context, at: &Place, problem: String, help: &str) {
        cx.error(at, self.bad_file(problem, help));
    }

    /// An error of the file.
    fn bad_file(&self, problem: String, help: &str) -> DocumentError {
        DocumentError::BadFile {
            path: self.name.clone(),
            problem,
            help: help.to_owned(),
        }
    }

    /// Whether a file may have this many rows; reports an error otherwise.
    fn bear(&self, cx: &Context, at: &Place, rows: usize) -> bool {
        if rows == 0 {
            let help = "add a row for each place, or take the block out";
            self.refuse(cx, at, "has a header and no rows".to_owned(), help);
        } else if rows > MOST_ROWS {
            let problem = format!("has {rows} rows, more than the {MOST_ROWS} that are read");
            self.refuse(cx, at, problem, "spread them over several objects");
        }
        (1..=MOST_ROWS).contains(&rows)
    }

    /// Reports wrong rows; `None` if there are any.
    fn report(&self, cx: &Context, at: &Place, rows: &Rows) -> Option<()> {
        for row in &rows.wrong {
            let shown = row.shown.clone();
            let source = cx
                .sources
                .borrow_mut()
                .add_excerpt(self.name.clone(), shown, row.line);
            for (span, error) in &row.errors {
                let place = Place {
                    source,
                    span: span.clone(),
                };
                cx.error(&place, error.clone());
            }
        }
        let unshown = rows.wrong_count - rows.wrong.len();
        if unshown > 0 {
            let problem = format!("has {unshown} more wrong rows after those that are shown");
            self.refuse(cx, at, problem, "mend the program that wrote the file");
        }
        (rows.wrong_count == 0).then_some(())
    }
}
