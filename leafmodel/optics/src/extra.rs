//! A constituent of the user's own: a table of specific absorption.
//!
//! - **In**: a table with the columns `wavelength_nm` and `absorption_cm2_per_ug` or
//!   `absorption_cm2_per_g`, over 400 to 2500 nm.
//! - **Out**: its specific absorption in cm² µg⁻¹, linear between rows.
//! - **Always true**: values are finite and from 0 to [`MOST`]; wavelengths rise.

use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use document::declared::Declared;
use document::error::DocumentError;
use document::keys::Keys;
use document::named_asset::bad_file;
use document::rows::{Row, Rows};
use document::source::Place;
use document::value_kind::{FilePath, NamedFile};
use document::whole_file;

use super::model::{FIRST_NM, LAST_NM};

/// Greatest specific absorption, cm² µg⁻¹. The strongest dyes have 2; chlorophyll in leaves has 0.09.
pub const MOST: f64 = 10.0;
/// Largest table, bytes.
const MOST_BYTES: u64 = 16 << 20;
const ENDINGS: &[&str] = &["csv", "tsv", "txt"];
const WAVELENGTH: &str = "wavelength_nm";
/// Columns of absorption, and what brings their unit to cm² µg⁻¹.
const UNITS: [(&str, f64); 2] = [
    ("absorption_cm2_per_ug", 1.0),
    ("absorption_cm2_per_g", 1e-6),
];

/// The specific absorption of a constituent.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ExtraTable {
    file: NamedFile,
    /// Wavelengths in nm and cm² µg⁻¹.
    points: Arc<[[f64; 2]]>,
}

/// What is wrong with a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BadTable {
    /// The bytes where it is wrong; `None` for the whole.
    pub span: Option<Range<usize>>,
    /// What is wrong there.
    pub problem: String,
    /// What to do about it.
    pub help: &'static str,
}

impl BadTable {
    fn of_the_whole(problem: impl Into<String>, help: &'static str) -> Self {
        Self {
            span: None,
            problem: problem.into(),
            help,
        }
    }
}

impl ExtraTable {
    /// The table in a text.
    ///
    /// # Errors
    ///
    /// [`BadTable`] for the first place at which it cannot be used.
    pub fn parse(text: &str) -> Result<Self, BadTable> {
        let rows = Rows::of(text);
        let mut records = rows.records().map(|row| {
            row.map_err(|ragged| BadTable {
                problem: ragged.to_string(),
                span: Some(ragged.span),
                help: "write a wavelength and a value in each line",
            })
        });
        let names = records.next().transpose()?;
        let (column, factor) = columns(names.as_ref())?;
        let mut points: Vec<[f64; 2]> = Vec::new();
        for row in records {
            let row = row?;
            let [nm, value] = [1 - column, column].map(|at| rows.number(&row.fields[at]));
            let wrong = |problem: String, help| BadTable {
                span: Some(row.span()),
                problem,
                help,
            };
            let (Some(nm), Some(value)) = (nm, value) else {
                let help = "write two numbers in each line";
                return Err(wrong("has something that is no number".to_owned(), help));
            };
            let value = value * factor;
            if !nm.is_finite() || points.last().is_some_and(|[before, _]| *before >= nm) {
                let help = "put the rows in the order of their wavelengths, each of them once";
                return Err(wrong(format!("{nm} nm does not follow in order"), help));
            }
            if !(0.0..=MOST).contains(&value) {
                let help = "a specific absorption is at least 0; if these are cm²/g, name the \
                    column `absorption_cm2_per_g`";
                let problem = format!("{value} cm²/µg is not from 0 to {MOST} cm²/µg");
                return Err(wrong(problem, help));
            }
            points.push([nm, value]);
        }
        match points[..] {
            [[first, _], .., [last, _]] if first <= FIRST_NM && last >= LAST_NM => Ok(Self {
                file: NamedFile::default(),
                points: points.into(),
            }),
            [[first, _], .., [last, _]] => Err(BadTable::of_the_whole(
                format!("covers {first} to {last} nm, not {FIRST_NM} to {LAST_NM} nm"),
                "add rows with the value 0 where the constituent does not absorb",
            )),
            _ => Err(BadTable::of_the_whole(
                "has fewer than two rows",
                "write a line for each wavelength",
            )),
        }
    }

    /// Specific absorption at a wavelength in nm, cm² µg⁻¹, with the end values outside.
    pub fn at(&self, wavelength_nm: f64) -> f64 {
        let points = &self.points;
        let above = points.partition_point(|[nm, _]| *nm <= wavelength_nm);
        match (
            above.checked_sub(1).map(|below| points[below]),
            points.get(above),
        ) {
            (Some([low, a]), Some([high, b])) => a + (wavelength_nm - low) / (high - low) * (b - a),
            (Some([_, end]), None) | (None, Some(&[_, end])) => end,
            (None, None) => 0.0,
        }
    }

    fn read(file: &Path) -> Result<String, BadTable> {
        let read = whole_file::read_utf8(file, MOST_BYTES);
        read.map_err(|error| {
            BadTable::of_the_whole(format!("cannot be read: {error}"), "make the file readable")
        })
    }
}

/// The place of the column with the absorption among two, and what brings it to cm² µg⁻¹.
fn columns(names: Option<&Row>) -> Result<(usize, f64), BadTable> {
    const HELP: &str = "name the columns `wavelength_nm` and `absorption_cm2_per_ug`, or \
        `absorption_cm2_per_g`, in the first line";
    let named: Vec<&str> = names
        .iter()
        .flat_map(|row| row.fields.iter().map(|field| field.text.as_str()))
        .collect();
    let unit = |name: &str| UNITS.iter().find(|(known, _)| *known == name);
    let found = match named[..] {
        [WAVELENGTH, value] => unit(value).map(|(_, factor)| (1, *factor)),
        [value, WAVELENGTH] => unit(value).map(|(_, factor)| (0, *factor)),
        _ => None,
    };
    found.ok_or_else(|| BadTable {
        span: names.map(Row::span),
        problem: "does not name two columns with their units".to_owned(),
        help: HELP,
    })
}

impl Declared for ExtraTable {
    fn declare(&mut self, keys: &mut Keys<'_>) {
        let path = FilePath::of("the path of a CSV file", ENDINGS, MOST_BYTES);
        let about = "A table of specific absorption with the columns `wavelength_nm` and \
            `absorption_cm2_per_ug` or `absorption_cm2_per_g`, over 400 to 2500 nm.";
        keys.required("file", &mut self.file, path, about);
        let Some(block) = keys.reader().filter(|_| keys.is_sound()) else {
            return;
        };
        let Some(at) = block.node("file").map(|node| &node.at) else {
            return;
        };
        let text = Self::read(&self.file.file);
        let parsed = text.as_deref().map_err(Clone::clone).and_then(Self::parse);
        match parsed {
            Ok(parsed) => self.points = parsed.points,
            Err(BadTable {
                span: None,
                problem,
                help,
            }) => bad_file(block.cx, at, &self.file.written, &problem, help),
            Err(BadTable {
                span: Some(span),
                problem,
                help,
            }) => {
                let text = text.unwrap_or_default();
                let source = block
                    .cx
                    .sources
                    .borrow_mut()
                    .add(self.file.written.clone(), &text);
                let error = DocumentError::BadFile {
                    path: self.file.written.clone(),
                    problem: format!("cannot be used: {problem}"),
                    help: help.to_owned(),
                };
                block.cx.error(&Place { source, span }, error);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_is_linear_between_its_rows_in_either_unit() {
        let micro = "wavelength_nm,absorption_cm2_per_ug\n400,0.02\n600,0.06\n2500,0\n";
        let table = ExtraTable::parse(micro).expect("the table is sound");
        for (nm, value) in [
            (350.0, 0.02),
            (400.0, 0.02),
            (500.0, 0.04),
            (600.0, 0.06),
            (2600.0, 0.0),
        ] {
            assert!((table.at(nm) - value).abs() < 1e-15, "{nm}");
        }
        let gram = "absorption_cm2_per_g;wavelength_nm\n20000;400\n60000;600\n0;2500\n";
        let other = ExtraTable::parse(gram).expect("the table is sound");
        assert!((table.at(555.5) - other.at(555.5)).abs() < 1e-15);
    }

    #[test]
    fn a_table_of_no_use_is_refused_at_its_place() {
        let head = "wavelength_nm,absorption_cm2_per_ug\n";
        for (text, problem) in [
            ("", "does not name two columns"),
            ("nm,k\n400,1\n2500,1\n", "does not name two columns"),
            (&format!("{head}400,1\n700,0\n"), "covers 400 to 700 nm"),
            (
                &format!("{head}400,1\n500,-0.1\n2500,0\n"),
                "-0.1 cm²/µg is not from 0",
            ),
            (
                &format!("{head}400,120\n2500,0\n"),
                "120 cm²/µg is not from 0",
            ),
            (
                &format!("{head}400,1\n400,1\n2500,0\n"),
                "400 nm does not follow",
            ),
            (
                &format!("{head}400,1\n2500\n"),
                "1 values, but there are 2 columns",
            ),
            (&format!("{head}400,x\n2500,1\n"), "no number"),
            (&format!("{head}400,1\n"), "fewer than two rows"),
        ] {
            let error = ExtraTable::parse(text).expect_err("the table is of no use");
            assert!(error.problem.contains(problem), "{text}: {error:?}");
        }
    }
}
