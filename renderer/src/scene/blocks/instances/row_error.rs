//! Errors of a row of a table of instances, and their messages.

use super::Table;
use super::column_names::{NAMES, QUATERNION, SHAPE, limits};
use leafmodel::document::context::{ENOUGH, QUOTED};
use leafmodel::document::error::DocumentError;
use leafmodel::document::nearest::nearest;
use leafmodel::document::source::escaped;
use leafmodel::document::values::listed;

/// An error of a row.
#[derive(Debug, PartialEq)]
pub(super) enum RowError {
    /// It has more or fewer fields than the header.
    Fields {
        /// How many it has.
        found: usize,
        /// How many the header has.
        wanted: usize,
    },
    /// It is too long to be a row.
    TooLong {
        /// Its bytes.
        bytes: usize,
    },
    /// A field is not a number.
    NotANumber {
        /// Index of the column.
        column: usize,
        /// The field as written.
        field: String,
    },
    /// A number is not finite.
    NotFinite {
        /// Index of the column.
        column: usize,
        /// The field as written.
        field: String,
    },
    /// A number is outside its range.
    Outside {
        /// Index of the column.
        column: usize,
        /// The field as written.
        field: String,
        /// The number.
        value: f64,
    },
    /// A shape that the object does not have.
    NoSuchShape {
        /// The field as written.
        field: String,
    },
    /// A name that the object lists more than once.
    AmbiguousShape {
        /// The field as written.
        field: String,
    },
    /// A quaternion is not of unit length.
    NotUnit {
        /// Its length.
        length: f64,
    },
}

impl RowError {
    /// The column that is to be underlined; `None` is the whole row.
    pub(super) fn column(&self) -> Option<usize> {
        match self {
            Self::Fields { .. } | Self::TooLong { .. } => None,
            Self::NotANumber { column, .. }
            | Self::NotFinite { column, .. }
            | Self::Outside { column, .. } => Some(*column),
            Self::NoSuchShape { .. } | Self::AmbiguousShape { .. } => Some(SHAPE),
            Self::NotUnit { .. } => Some(QUATERNION),
        }
    }

    /// The error as it appears in a scene's report.
    pub(super) fn told(&self, table: &Table<'_>) -> DocumentError {
        let key = |column: usize| NAMES[column].to_owned();
        match self {
            Self::Fields { found, wanted } => DocumentError::BadFile {
                path: table.name.clone(),
                problem: format!("has {found} fields in this row, its header names {wanted}"),
                help: "give every row a field for each column, with decimal points".to_owned(),
            },
            Self::TooLong { bytes } => DocumentError::BadFile {
                path: table.name.clone(),
                problem: format!("has a line of {bytes} bytes"),
                help: "end each row with a line feed".to_owned(),
            },
            Self::NotANumber { column, field } => DocumentError::WrongType {
                key: key(*column),
                found: format!("`{field}`"),
                wanted: "a number".to_owned(),
                help: format!("write a number within {}", limits(*column)),
            },
            Self::NotFinite { column, field } => DocumentError::NotFinite {
                key: key(*column),
                value: field.clone(),
            },
            Self::Outside {
                column,
                field,
                value,
            } => DocumentError::OutOfRange {
                key: key(*column),
                value: field.clone(),
                range: limits(*column).to_string(),
                help: limits(*column).advice(*value),
            },
            Self::NoSuchShape { field } => {
                if field.parse::<f64>().is_ok() {
                    let last = table.shapes.len() - 1;
                    return DocumentError::OutOfRange {
                        key: key(SHAPE),
                        value: field.clone(),
                        range: format!("the whole numbers from 0 to {last}"),
                        help: format!("the object's shapes are {}", shown(table)),
                    };
                }
                DocumentError::UnknownName {
                    kind: "shape",
                    name: field.clone(),
                    nearest: nearest(field, table.shapes.iter().take(ENOUGH).map(String::as_str))
                        .map(|name| escaped(name, QUOTED)),
                    known: listed(table.shapes.iter().map(String::as_str)),
                }
            }
            Self::AmbiguousShape { field } => DocumentError::Impossible {
                key: key(SHAPE),
                problem: format!("the object lists `{field}` more than once"),
                help: "write its place in the object's list, counted from 0".to_owned(),
            },
            Self::NotUnit { length } => DocumentError::Impossible {
                key: "quaternion".to_owned(),
                problem: format!("its length is {length:.4}, that of a rotation is 0.99 to 1.01"),
                help: "divide its four numbers by that length".to_owned(),
            },
        }
    }
}

fn shown(table: &Table<'_>) -> String {
    listed(table.shapes.iter().map(String::as_str))
}
