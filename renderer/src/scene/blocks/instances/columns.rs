//! The columns of a table of instances, and the place that a row's numbers give.

use glam::{DMat3, DMat4, DQuat, DVec3};

use super::table::{RowError, Table};
use crate::geometry::instance::COORDINATES_M;
use crate::scene::blocks::placement::{ANGLES_DEG, SCALES, turn};
use crate::scene::description::InstancePlace;
use leafmodel::document::context::{ENOUGH, QUOTED};
use leafmodel::document::error::DocumentError;
use leafmodel::document::limits::Limits;
use leafmodel::document::nearest::nearest;
use leafmodel::document::source::escaped;
use leafmodel::document::values::listed;

/// The columns with the ranges of their numbers, in the order in which a row stores these; shapes are
/// looked up instead.
const COLUMNS: [(&str, Limits); COUNT] = [
    ("x_m", COORDINATES_M),
    ("y_m", COORDINATES_M),
    ("z_m", COORDINATES_M),
    ("rotate_x_deg", ANGLES_DEG),
    ("rotate_y_deg", ANGLES_DEG),
    ("rotate_z_deg", ANGLES_DEG),
    ("quaternion_w", COMPONENTS),
    ("quaternion_x", COMPONENTS),
    ("quaternion_y", COMPONENTS),
    ("quaternion_z", COMPONENTS),
    ("scale", SCALES),
    ("scale_x", SCALES),
    ("scale_y", SCALES),
    ("scale_z", SCALES),
    ("shape", SCALES),
];

/// Number of columns.
const COUNT: usize = 15;
const POSITION: usize = 0;
const ROTATION: usize = 3;
const QUATERNION: usize = 6;
const SCALE: usize = 10;
const AXES: usize = 11;
/// Index of the column for the object's shape.
pub(super) const SHAPE: usize = 14;

/// Greatest deviation of a quaternion's length from 1. Quaternions with three digits pass; columns
/// with other meanings do not.
const UNIT_TOLERANCE: f64 = 0.01;

/// The range of the components of a quaternion.
const COMPONENTS: Limits = Limits::closed(-1.0 - UNIT_TOLERANCE, 1.0 + UNIT_TOLERANCE);

/// The name of a column.
fn name(column: usize) -> &'static str {
    COLUMNS[column].0
}

/// The columns of a file, in its order.
#[derive(Debug)]
pub(super) struct Header {
    /// The column of each field.
    pub(super) columns: Vec<usize>,
}

/// An error of a header.
#[derive(Debug, PartialEq)]
pub(super) struct HeaderError {
    /// Number of the field, if a single field is wrong.
    pub(super) field: Option<usize>,
    /// Completes "the header …".
    pub(super) problem: String,
    /// What to write instead.
    pub(super) help: String,
}

impl HeaderError {
    /// The error as it appears in a scene's report.
    pub(super) fn of_file(self, table: &Table<'_>) -> DocumentError {
        DocumentError::Header {
            path: table.name.clone(),
            problem: self.problem,
            help: self.help,
        }
    }
}

impl Header {
    /// Looks up the names of a header.
    pub(super) fn of(names: &[&str], shapes: usize) -> Result<Self, Vec<HeaderError>> {
        let mut errors = Vec::new();
        let mut wrong = |field: Option<usize>, problem: String, help: String| {
            errors.push(HeaderError {
                field,
                problem,
                help,
            });
        };
        // The column of each field, if its name is known.
        let mut found: Vec<Option<usize>> = Vec::new();
        let mut misspelt = Vec::new();
        for (field, written) in names.iter().take(ENOUGH).enumerate() {
            let column = COLUMNS.iter().position(|(known, _)| known == written);
            let is_second = column.is_some() && found.contains(&column);
            found.push(column);
            if column.is_none() {
                let meant = nearest(written, COLUMNS.map(|(name, _)| name));
                misspelt.extend(meant);
                let problem = format!("names `{}`, which is no column", escaped(written, QUOTED));
                let help = meant.map_or_else(
                    || format!("columns: {}", COLUMNS.map(|(name, _)| name).join(", ")),
                    |meant| format!("did you mean `{meant}`?"),
                );
                wrong(Some(field), problem, help);
            }
            if is_second {
                let problem = format!("names `{written}` twice");
                wrong(Some(field), problem, "keep one of the two".to_owned());
            }
        }
        let columns: Vec<usize> = found.iter().copied().flatten().collect();
        let has = |column: usize| columns.contains(&column) || misspelt.contains(&name(column));
        let mut needed: Vec<usize> = (POSITION..ROTATION).collect();
        for group in [ROTATION..QUATERNION, QUATERNION..SCALE, AXES..SHAPE] {
            // A missing angle is 0; a missing component of a position, a quaternion or of scales
            // along axes is an error.
            if group.start != ROTATION && group.clone().any(has) {
                needed.extend(group);
            }
        }
        if shapes > 1 {
            needed.push(SHAPE);
        }
        for column in needed.into_iter().filter(|column| !has(*column)) {
            let why = if column == SHAPE {
                format!(", which says which of the object's {shapes} shapes a row is")
            } else {
                String::new()
            };
            let problem = format!("lacks `{}`{why}", name(column));
            wrong(None, problem, format!("add a column `{}`", name(column)));
        }
        for (one, other) in [
            (ROTATION..QUATERNION, QUATERNION..SCALE),
            (SCALE..AXES, AXES..SHAPE),
        ] {
            let first = |mut group: std::ops::Range<usize>| group.find(|c| columns.contains(c));
            if let (Some(one), Some(other)) = (first(one), first(other)) {
                let problem = format!(
                    "names `{}` and `{}`, which exclude each other",
                    name(one),
                    name(other)
                );
                let field = found.iter().position(|column| *column == Some(other));
                wrong(field, problem, "keep one of the two".to_owned());
            }
        }
        if errors.is_empty() {
            Ok(Self { columns })
        } else {
            Err(errors)
        }
    }
}

/// The numbers of a row, by column.
#[derive(Debug)]
pub(super) struct Row {
    numbers: [f64; COUNT],
    shape: u32,
    has_quaternion: bool,
    errors: Vec<RowError>,
}

impl Row {
    /// A row of a file with this header, before its fields are read.
    pub(super) fn of(header: &Header) -> Self {
        let mut numbers = [0.0; COUNT];
        numbers[SCALE] = 1.0;
        numbers[AXES..SHAPE].fill(1.0);
        Self {
            numbers,
            shape: 0,
            has_quaternion: header.columns.contains(&QUATERNION),
            errors: Vec::new(),
        }
    }

    /// Adds an error of the row.
    fn fail(&mut self, column: usize, error: DocumentError) {
        let column = Some(column);
        self.errors.push(RowError { column, error });
    }

    /// Sets the number of a column, if it is one; `field` is its text in the file.
    pub(super) fn number(&mut self, column: usize, value: Option<f64>, field: impl Fn() -> String) {
        let (key, limits) = (name(column).to_owned(), COLUMNS[column].1);
        match value {
            None => self.fail(
                column,
                DocumentError::WrongType {
                    key,
                    found: format!("`{}`", field()),
                    wanted: "a number".to_owned(),
                    help: format!("write a number within {limits}"),
                },
            ),
            Some(value) if !value.is_finite() => {
                let value = field();
                self.fail(column, DocumentError::NotFinite { key, value });
            }
            Some(value) if !limits.contain(value) => self.fail(
                column,
                DocumentError::OutOfRange {
                    key,
                    value: field(),
                    range: limits.to_string(),
                    help: limits.advice(value),
                },
            ),
            Some(value) => self.numbers[column] = value,
        }
    }

    /// Sets the shape of a row by its number in the object's list.
    pub(super) fn shape(&mut self, table: &Table<'_>, number: f64, field: impl Fn() -> String) {
        let is_one = number >= 0.0 && number < table.shapes.len() as f64 && number.fract() == 0.0;
        if is_one {
            self.shape = number as u32;
            return;
        }
        let (field, known) = (field(), || table.shapes.iter().map(String::as_str));
        let error = if field.parse::<f64>().is_ok() {
            DocumentError::OutOfRange {
                key: name(SHAPE).to_owned(),
                value: field,
                range: format!("the whole numbers from 0 to {}", table.shapes.len() - 1),
                help: format!("the object's shapes are {}", listed(known())),
            }
        } else {
            DocumentError::UnknownName {
                kind: "shape",
                nearest: nearest(&field, known().take(ENOUGH)).map(|name| escaped(name, QUOTED)),
                known: listed(known()),
                name: field,
            }
        };
        self.fail(SHAPE, error);
    }

    /// Sets the shape of a row by its name, or by its number.
    pub(super) fn shape_named(&mut self, table: &Table<'_>, written: &str) {
        let field = || escaped(written, QUOTED);
        match table.numbers.get(written) {
            Some(Some(number)) => self.shape(table, f64::from(*number), field),
            Some(None) => {
                let error = DocumentError::Impossible {
                    key: name(SHAPE).to_owned(),
                    problem: format!("the object lists `{}` more than once", field()),
                    help: "write its place in the object's list, counted from 0".to_owned(),
                };
                self.fail(SHAPE, error);
            }
            None => self.shape(table, written.parse().unwrap_or(f64::NAN), field),
        }
    }

    /// The place of the row's instance: scale, rotation, translation, as for objects, then the
    /// object's own frame.
    pub(super) fn place(mut self, table: &Table<'_>) -> Result<InstancePlace, Vec<RowError>> {
        let three = |at: usize| DVec3::from_slice(&self.numbers[at..at + 3]);
        let linear = if self.has_quaternion {
            let [w, x, y, z] = std::array::from_fn(|i| self.numbers[QUATERNION + i]);
            let quaternion = DQuat::from_xyzw(x, y, z, w);
            let length = quaternion.length();
            // A wrong number has already been reported.
            if self.errors.is_empty() && (length - 1.0).abs() > UNIT_TOLERANCE {
                let error = DocumentError::Impossible {
                    key: "quaternion".to_owned(),
                    problem: format!(
                        "its length is {length:.4}, that of a rotation is 0.99 to 1.01"
                    ),
                    help: "divide its four numbers by that length".to_owned(),
                };
                let column = Some(QUATERNION);
                self.errors.push(RowError { column, error });
            }
            DMat3::from_quat(quaternion.normalize())
        } else {
            turn(three(ROTATION).to_array())
        };
        if !self.errors.is_empty() {
            return Err(self.errors);
        }
        let linear = linear * DMat3::from_diagonal(three(AXES) * self.numbers[SCALE]);
        let local = DMat4::from_translation(three(POSITION)) * DMat4::from_mat3(linear);
        let world = table.frame * local;
        Ok(InstancePlace::new(self.shape, world))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn problems(names: &[&str], shapes: usize) -> Vec<String> {
        let errors = Header::of(names, shapes).err().unwrap_or_default();
        errors.into_iter().map(|error| error.problem).collect()
    }

    #[test]
    fn a_header_needs_positions_whole_groups_and_one_of_each_kind() {
        assert!(problems(&["z_m", "x_m", "y_m", "rotate_z_deg", "scale"], 1).is_empty());
        assert_eq!(problems(&["x_m", "y_m"], 1), ["lacks `z_m`"]);
        let shapes = problems(&["x_m", "y_m", "z_m"], 3);
        assert!(shapes[0].starts_with("lacks `shape`"), "{shapes:?}");
        let half = ["x_m", "y_m", "z_m", "quaternion_w", "quaternion_x"];
        assert_eq!(
            problems(&half, 1),
            ["lacks `quaternion_y`", "lacks `quaternion_z`"]
        );
        let twice = ["x_m", "y_m", "z_m", "x_m", "scale", "scale_x"];
        assert_eq!(
            problems(&twice, 1),
            [
                "names `x_m` twice",
                "lacks `scale_y`",
                "lacks `scale_z`",
                "names `scale` and `scale_x`, which exclude each other"
            ]
        );
        // A misspelt column is not reported as missing too.
        assert_eq!(
            problems(&["x_mm", "y_m", "z_m"], 1),
            ["names `x_mm`, which is no column"]
        );
    }
}
