//! The rows of a file of instances, whichever form the file has.

use std::collections::BTreeMap;
use std::ops::Range;

use glam::DMat4;
use leafmodel::document::context::Context;
use leafmodel::document::error::DocumentError;
use leafmodel::document::source::Place;
use rayon::prelude::*;

use crate::scene::description::InstancePlace;

/// Greatest number of wrong rows of a file that are reported one by one.
const MOST_REPORTED: usize = 20;

/// Greatest number of rows of a file, so that the picture's 32-bit layers can number them.
const MOST_ROWS: usize = 1 << 24;

/// The names of an object's shapes, in the order in which the object lists them.
pub(super) type ShapeNames = [String];

/// Data for reading the rows of a file.
#[derive(Debug)]
pub(super) struct Table<'a> {
    /// The path as written, safe to print.
    pub(super) name: String,
    pub(super) shapes: &'a ShapeNames,
    /// Index of each name in the list; `None` if the name occurs more than once.
    pub(super) numbers: BTreeMap<&'a str, Option<u32>>,
    /// Local to world of the frame in which the rows are given.
    pub(super) frame: DMat4,
}

/// An error of a row.
#[derive(Debug)]
pub(super) struct RowError {
    /// The column that is to be underlined; `None` is the whole row.
    pub(super) column: Option<usize>,
    pub(super) error: DocumentError,
}

/// A row with errors.
#[derive(Debug)]
pub(super) struct WrongRow {
    /// Its line number, or for an array its row number, from 1.
    pub(super) line: usize,
    /// The row as a report shows it.
    pub(super) shown: String,
    /// Its errors, each with a range of bytes of `shown`.
    pub(super) errors: Vec<(Range<usize>, DocumentError)>,
}

impl WrongRow {
    /// A row whose fields, in these columns, are at these ranges of bytes of `shown`.
    pub(super) fn new(
        (line, shown): (usize, String),
        columns: &[usize],
        fields: &[Range<usize>],
        errors: Vec<RowError>,
    ) -> Self {
        let whole = fields[0].start..fields[fields.len() - 1].end;
        let place = |column: Option<usize>| {
            let number = columns.iter().position(|own| Some(*own) == column);
            number
                .and_then(|number| fields.get(number))
                .unwrap_or(&whole)
        };
        let errors = errors.into_iter();
        let errors = errors.map(|RowError { column, error }| (place(column).clone(), error));
        Self {
            line,
            errors: errors.collect(),
            shown,
        }
    }
}

/// The result of reading some rows of a file.
#[derive(Debug)]
pub(super) struct Rows {
    pub(super) places: Vec<InstancePlace>,
    /// The first wrong ones.
    pub(super) wrong: Vec<WrongRow>,
    pub(super) wrong_count: usize,
}

impl Rows {
    /// Reads rows on all threads, each with its number; `wrong` is one with errors.
    pub(super) fn read<R: Copy + Sync>(
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

impl<'a> Table<'a> {
    pub(super) fn new(name: String, shapes: &'a ShapeNames, frame: DMat4) -> Self {
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
    pub(super) fn refuse(&self, cx: &Context, at: &Place, problem: String, help: &str) {
        cx.error(at, self.bad_file(problem, help));
    }

    /// An error of the file.
    pub(super) fn bad_file(&self, problem: String, help: &str) -> DocumentError {
        DocumentError::BadFile {
            path: self.name.clone(),
            problem,
            help: help.to_owned(),
        }
    }

    /// Whether a file may have this many rows; reports an error otherwise.
    pub(super) fn bear(&self, cx: &Context, at: &Place, rows: usize) -> bool {
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
    pub(super) fn report(&self, cx: &Context, at: &Place, rows: &Rows) -> Option<()> {
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
