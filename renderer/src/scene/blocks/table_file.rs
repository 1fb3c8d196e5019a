//! Tables of spectra in files, read by [`series`]: what is wrong with one becomes a report in it.

use std::fs;
use std::ops::Range;
use std::path::Path;

use leafmodel::document::context::{Context, QUOTED};
use leafmodel::document::error::DocumentError;
use leafmodel::document::rows::Guess;
use leafmodel::document::source::{Place, escaped};
use leafmodel::document::value_kind::{FilePath, NamedFile};

use crate::measured::known::Known;
use crate::measured::{Fault, What, series, units};

/// The path of a file of one spectrum.
pub(super) const SPECTRUM: FilePath = FilePath::of(
    "the path of a CSV file",
    &["csv", "tsv", "txt", "sig", "asd"],
    16 << 20,
);

/// Rows of a table, each with its place.
#[derive(Debug, Default)]
pub(super) struct Rows {
    pub(super) points: Vec<(f64, f64)>,
    /// Places of the wavelength and of the value.
    pub(super) places: Vec<[Place; 2]>,
    /// The file that they are of, as messages name it.
    pub(super) file: Option<String>,
}

/// The text of a table's file, which the scene names at a place.
pub(in crate::scene) struct TableFile<'c> {
    cx: &'c Context,
    path: &'c str,
    at: &'c Place,
    pub(in crate::scene) text: String,
}

/// Reads the file of one spectrum, whose path stands at a place of the scene. With `guess`, micrometres
/// and percent are recognised, and a warning says so.
pub(super) fn rows(cx: &Context, named: &NamedFile, at: &Place, guess: bool) -> Option<Rows> {
    TableFile::read(cx, &named.file, &named.written, at)?.rows(guess)
}

impl<'c> TableFile<'c> {
    /// Reads a file; what is wrong with it is reported at the place of its path.
    pub(in crate::scene) fn read(
        cx: &'c Context,
        file: &Path,
        path: &'c str,
        at: &'c Place,
    ) -> Option<Self> {
        let read = fs::read(file).map_err(|error| {
            let problem = format!("cannot be read: {error}");
            cx.error(at, bad_file(path, problem, "make the file readable"));
        });
        Self::decoded(cx, path, at, &read.ok()?)
    }

    fn decoded(cx: &'c Context, path: &'c str, at: &'c Place, bytes: &[u8]) -> Option<Self> {
        let text = String::new();
        let mut file = Self { cx, path, at, text };
        let decoded = file.sound(series::text(bytes))?;
        if let Some(guess) = decoded.guess() {
            file.note(&guess, "");
        }
        file.text = decoded.text.into_owned();
        Some(file)
    }

    fn rows(&self, guess: bool) -> Option<Rows> {
        let known = Known::default();
        let mut found = self.sound(series::series(&self.text, &known))?;
        let notes = if guess {
            self.sound(found.to_nm_and_fractions(&known))?
        } else {
            found.to_nm();
            std::mem::take(&mut found.notes)
        };
        for note in notes {
            let help = match note.otherwise {
                Some(("decimal", _)) => "if that is wrong, write numbers with points",
                Some(("separator", _)) => "if that is wrong, keep one separator in the file",
                _ => "if that is wrong, write `scale` beside the file, and wavelengths in nm",
            };
            self.note(&note, help);
        }
        let name = escaped(self.path, 2 * QUOTED);
        let source = self.cx.sources.borrow_mut().add(name.clone(), &self.text);
        let place = |span: Range<usize>| Place { source, span };
        let spans = found.spans.into_iter();
        Some(Rows {
            points: found.points,
            places: spans.map(|spans| spans.map(place)).collect(),
            file: Some(name),
        })
    }

    /// What was found in the file; a fault is reported where it is, or at the place of the file's path.
    pub(in crate::scene) fn sound<T>(&self, found: Result<T, Fault>) -> Option<T> {
        let fault = match found {
            Ok(found) => return Some(found),
            Err(fault) => fault,
        };
        let name = escaped(self.path, 2 * QUOTED);
        let error = match &fault.what {
            What::NotFinite { value } => DocumentError::NotFinite {
                key: name.clone(),
                value: value.clone(),
            },
            What::Words { problem, help } => {
                let is_of_file = problem.starts_with("has ") || problem.starts_with("is ");
                let problem = if is_of_file {
                    problem.clone()
                } else {
                    format!("cannot be used: {problem}")
                };
                let help = if help.is_empty() {
                    "mend this place, or take another file"
                } else {
                    help
                };
                bad_file(self.path, problem, help)
            }
        };
        match fault.span {
            None => self.cx.error(self.at, error),
            Some(span) => {
                let source = self.cx.sources.borrow_mut().add(name, &self.text);
                self.cx.error(&Place { source, span }, error);
            }
        }
        None
    }

    /// Warns of what was guessed about the file; `help` says what to do if that is wrong.
    pub(in crate::scene) fn note(&self, note: &Guess, help: &str) {
        let help = match note.otherwise {
            Some(_) => help,
            None => "change the file if that is not meant",
        };
        self.warn("scene::units", &note.what, help);
    }

    /// Warns of something in the file.
    pub(in crate::scene) fn warn(&self, code: &'static str, what: &str, help: &str) {
        let name = escaped(self.path, 2 * QUOTED);
        let message = format!("\"{name}\": {what}");
        self.cx.warn(self.at, code, message, help);
    }

    /// Reports what is wrong with the file as a whole.
    pub(in crate::scene) fn refuse(&self, problem: String, help: &str) {
        self.cx.error(self.at, bad_file(self.path, problem, help));
    }
}

/// Warns of what was guessed about a file; `help` says what to do if that is wrong.
pub(super) fn tell(cx: &Context, path: &str, at: &Place, note: &Guess, help: &str) {
    let text = String::new();
    TableFile { cx, path, at, text }.note(note, help);
}

/// An error of a file.
pub(in crate::scene) fn bad_file(path: &str, problem: String, help: &str) -> DocumentError {
    DocumentError::BadFile {
        path: escaped(path, 2 * QUOTED),
        problem,
        help: help.to_owned(),
    }
}

/// The first gap in a file's wavelengths that matters to the wavelengths that are needed, as an error:
/// with the number of the wavelength behind it.
pub(in crate::scene) fn first_gap(
    cx: &Context,
    path: &str,
    nm: &[f64],
) -> Option<(usize, DocumentError)> {
    let needed = cx.range_nm.get();
    let mut gaps = units::gaps(nm, units::WIDE_GAP);
    gaps.find_map(|behind| {
        let [from, to] = [nm[behind - 1], nm[behind]];
        let matters = needed.is_none_or(|[low, high]| from < high && to > low);
        matters.then(|| {
            let problem = format!("has a gap: nothing between {from} and {to} nm");
            let help = "measure or interpolate the values there and add their lines";
            (behind, bad_file(path, problem, help))
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use leafmodel::document::source::Sources;

    /// The rows, the codes of the errors, and the warnings.
    type Outcome = (Option<Vec<(f64, f64)>>, Vec<&'static str>, Vec<String>);

    fn read(bytes: &[u8], guess: bool) -> Outcome {
        let cx = Context::new(Sources::default(), std::path::PathBuf::new());
        let at = Place {
            source: 0,
            span: 0..0,
        };
        let file = TableFile::decoded(&cx, "t.csv", &at, bytes);
        let rows = file.and_then(|file| file.rows(guess));
        let (_, errors, remarks) = cx.into_parts();
        let codes = errors.iter().map(|located| located.error.code()).collect();
        let said = remarks.into_iter().map(|remark| remark.message).collect();
        (rows.map(|rows| rows.points), codes, said)
    }

    #[test]
    fn faults_become_errors_of_the_scene() {
        assert_eq!(read(b"nm,R\nnm,R\n", false).1, ["scene::bad_file"]);
        assert_eq!(read(b"400,0.1,3\n", false).1, ["scene::bad_file"]);
        assert_eq!(read(b"400,inf\n", false).1, ["scene::not_finite"]);
        assert_eq!(read(b"400,\0\xff\n", false).1, ["scene::bad_file"]);
        assert_eq!(read(b"as7\0\xff", false).1, ["scene::bad_file"]);
    }

    #[test]
    fn units_are_guessed_where_that_is_asked_for_and_reported() {
        let text = b"0.4,5\n0.5,10\n0.8,50\n";
        let (rows, codes, said) = read(text, true);
        assert_eq!(rows, Some(vec![(400.0, 0.05), (500.0, 0.1), (800.0, 0.5)]));
        assert!(codes.is_empty());
        assert_eq!(said.len(), 2, "{said:?}");
        assert!(
            said[0].contains("t.csv") && said[0].contains("µm"),
            "{said:?}"
        );
        let (rows, _, said) = read(text, false);
        assert_eq!(rows.map(|rows| rows[0]), Some((0.4, 5.0)));
        assert!(said.is_empty());
    }
}
