//! Tables of instances as `NumPy` writes them: a structured array whose fields have the names of
//! columns.
//!
//! Supported are one-dimensional, little-endian arrays with fields of floats or integers, such as
//! those written by `np.save("canopy.npy", np.rec.fromarrays([x, y, z], names="x_m,y_m,z_m"))`.
//!
//! # Source
//!
//! `numpy.lib.format`, versions 1.0 to 3.0 of the file format.

mod header;

use self::header::{Array, Field};
use super::columns::{Header, Row, SHAPE};
use super::table::{RowError, Rows, Table, WrongRow};
use crate::scene::description::InstancePlace;
use leafmodel::document::context::Context;
use leafmodel::document::source::Place;

/// Reads the rows; `None`, after a report, if the file has no readable rows.
pub(super) fn read(cx: &Context, table: &Table<'_>, at: &Place, bytes: &[u8]) -> Option<Rows> {
    const HELP: &str = "write a structured array: `np.save(\"places.npy\", \
                        np.rec.fromarrays([x, y, z], names=\"x_m,y_m,z_m\"))`";
    let array = match Array::of(bytes) {
        Ok(array) => array,
        Err(problem) => {
            table.refuse(cx, at, problem, HELP);
            return None;
        }
    };
    let names: Vec<&str> = array.fields.iter().map(|f| f.name.as_str()).collect();
    let header = match Header::of(&names, table.shapes.len()) {
        Ok(header) => header,
        Err(errors) => {
            for error in errors {
                cx.error(at, error.of_file(table));
            }
            return None;
        }
    };
    if !table.bear(cx, at, array.rows) {
        return None;
    }
    let held = bytes.len() - array.start;
    let wanted = array.rows.checked_mul(array.stride);
    if wanted != Some(held) {
        let problem = format!(
            "holds {held} bytes after its header, which promises {} rows of {} bytes",
            array.rows, array.stride
        );
        table.refuse(cx, at, problem, "copy or write the file anew");
        return None;
    }
    let rows = bytes[array.start..].chunks_exact(array.stride);
    let rows: Vec<(usize, &[u8])> = (1..).zip(rows).collect();
    let read = |row| read_row(table, &header, &array, row);
    let wrong = |number, row, errors| wrong_row(&header, &array, row, number, errors);
    Some(Rows::read(&rows, read, wrong))
}

fn read_row(
    table: &Table<'_>,
    header: &Header,
    array: &Array,
    bytes: &[u8],
) -> Result<InstancePlace, Vec<RowError>> {
    let mut row = Row::of(header);
    for (field, &column) in array.fields.iter().zip(&header.columns) {
        let value = field.read(bytes);
        let shown = || value.to_string();
        if column == SHAPE {
            row.shape(table, value, shown);
        } else {
            row.number(column, Some(value), shown);
        }
    }
    row.place(table)
}

impl Field {
    fn read(&self, row: &[u8]) -> f64 {
        self.number
            .read(&row[self.start..self.start + self.number.size()])
    }
}

/// The row as text, for the report.
fn wrong_row(
    header: &Header,
    array: &Array,
    bytes: &[u8],
    number: usize,
    errors: Vec<RowError>,
) -> WrongRow {
    let mut shown = String::new();
    let mut spans = Vec::new();
    for field in &array.fields {
        if !shown.is_empty() {
            shown.push_str(", ");
        }
        let start = shown.len();
        shown += &format!("{} {}", field.name, field.read(bytes));
        spans.push(start..shown.len());
    }
    WrongRow::new((number, shown), &header.columns, &spans, errors)
}

#[cfg(test)]
mod tests {
    use super::super::text;
    use super::*;
    use leafmodel::document::rows::Form;
    use leafmodel::document::source::Sources;

    fn file(literal: &str) -> Vec<u8> {
        let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
        bytes.extend((literal.len() as u16).to_le_bytes());
        bytes.extend(literal.as_bytes());
        bytes
    }

    #[test]
    fn an_array_gives_the_places_that_the_same_rows_give_as_text() {
        let count = 25_000;
        let literal = format!(
            "{{'descr': [('shape', '<i8'), ('x_m', '<f8'), ('y_m', '<f4'), ('z_m', '<i4'), ('scale', '<f4')], \
             'fortran_order': False, 'shape': ({count},), }}"
        );
        let mut bytes = file(&literal);
        let mut text = "shape x_m y_m z_m scale\n".to_owned();
        for row in 0..count {
            let shape = row as i64 % 3;
            let (x, y, z) = (0.1 * row as f64, row as f32 / 3.0, row as i32 - 9);
            let scale = 1.0 + row as f32 / 7.0;
            bytes.extend(shape.to_le_bytes());
            bytes.extend(x.to_le_bytes());
            bytes.extend(y.to_le_bytes());
            bytes.extend(z.to_le_bytes());
            bytes.extend(scale.to_le_bytes());
            // The shortest digits of a 32-bit number differ from those of the same number in 64
            // bits.
            let (y, scale) = (f64::from(y), f64::from(scale));
            text += &format!("{shape} {x} {y} {z} {scale}\n");
        }
        let cx = Context::new(Sources::default(), std::path::PathBuf::new());
        let at = Place {
            source: 0,
            span: 0..0,
        };
        let frame = glam::DMat4::from_scale(glam::DVec3::splat(0.3));
        let names = ["a", "b", "c"].map(str::to_owned);
        let table = Table::new("t".to_owned(), &names, frame);
        let array = read(&cx, &table, &at, &bytes).expect("an array");
        let text = text::read(&cx, &table, &at, text.as_bytes(), Form::default()).expect("a text");
        assert_eq!(cx.error_count(), 0);
        assert_eq!(array.places.len(), count);
        assert!(array.places == text.places);
        // The report of a wrong row has its number and values.
        let second = bytes.len() - (count - 1) * 28;
        bytes[second..second + 8].copy_from_slice(&7_i64.to_le_bytes());
        let wrong = read(&cx, &table, &at, &bytes).expect("an array").wrong;
        assert_eq!(wrong.len(), 1);
        assert_eq!(wrong[0].line, 2);
        assert!(
            wrong[0].shown.starts_with("shape 7, x_m 0.1, "),
            "{wrong:?}"
        );
        assert_eq!(wrong[0].errors[0].0, 0..7);
    }
}
