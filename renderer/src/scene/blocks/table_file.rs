//! Tables of spectra in files, read by [`series`]: what is wrong with one becomes a report in it.

use std::borrow::Cow;
use std::fs;

use leafmodel::document::context::{Context, QUOTED};
use leafmodel::document::error::DocumentError;
use leafmodel::document::path::{Wanted, resolve};
use leafmodel::document::rows::Guess;
use leafmodel::document::source::{Place, escaped};

use crate::measured::known::Known;
use crate::measured::{Fault, What, series};

/// Most bytes of a table.
const MOST_BYTES: u64 = 16 << 20;

/// Endings of files of one spectrum.
const ENDINGS: &[&str] = &["csv", "tsv", "txt", "sig", "asd"];

/// Rows of a table, each with its place.
#[derive(Debug, Default)]
pub(super) struct Rows {
    pub(super) points: Vec<(f64, f64)>,
    /// Places of the wavelength and of the value.
    pub(super) places: Vec<[Place; 2]>,
    /// The file that they are of, as messages name it.
    pub(super) file: Option<String>,
}

/// Reads the file behind a path that stands at a place of the scene. With `guess`, micrometres and
/// percent are recognised, and a warning says so.
pub(super) fn rows(cx: &Context, path: &str, at: &Place, guess: bool) -> Option<Rows> {
    let wanted = Wanted {
        endings: ENDINGS,
        most_bytes: MOST_BYTES,
    };
    let file = resolve(cx, path, at, wanted)?;
    let bytes = bytes(cx, &file, path, at)?;
    rows_of(cx, path, at, &bytes, guess)
}

/// All bytes of a file; an error at the place of its path otherwise.
pub(in crate::scene) fn bytes(
    cx: &Context,
    file: &std::path::Path,
    path: &str,
    at: &Place,
) -> Option<Vec<u8>> {
    let read = fs::read(file).map_err(|error| {
        let problem = format!("cannot be read: {error}");
        cx.error(at, bad_file(path, problem, "make the file readable"));
    });
    read.ok()
}

fn rows_of(cx: &Context, path: &str, at: &Place, bytes: &[u8], guess: bool) -> Option<Rows> {
    let text = &*text(cx, path, at, bytes)?;
    let known = Known::default();
    let read = series::series(text, &known).and_then(|mut found| {
        let notes = if guess {
            found.to_nm_and_fractions(&known)?
        } else {
            found.to_nm();
            std::mem::take(&mut found.notes)
        };
        Ok((found, notes))
    });
    let (found, notes) = read
        .map_err(|fault| report(cx, path, at, text, &fault))
        .ok()?;
    for note in notes {
        let help = match note.otherwise {
            Some(("decimal", _)) => "if that is wrong, write numbers with points",
            Some(("separator", _)) => "if that is wrong, keep one separator in the file",
            _ => "if that is wrong, write `scale` beside the file, and wavelengths in nm",
        };
        tell(cx, path, at, &note, help);
    }
    let name = escaped(path, 2 * QUOTED);
    let source = cx.sources.borrow_mut().add(name.clone(), text);
    let place = |span: std::ops::Range<usize>| Place { source, span };
    Some(Rows {
        points: found.points,
        places: found
            .spans
            .into_iter()
            .map(|spans| spans.map(place))
            .collect(),
        file: Some(name),
    })
}

/// The text of a file, or an error at the place of its path.
pub(in crate::scene) fn text<'b>(
    cx: &Context,
    path: &str,
    at: &Place,
    bytes: &'b [u8],
) -> Option<Cow<'b, str>> {
    let decoded = series::text(bytes).map_err(|fault| report(cx, path, at, "", &fault));
    let decoded = decoded.ok()?;
    if let Some(guess) = decoded.guess() {
        tell(cx, path, at, &guess, "");
    }
    Some(decoded.text)
}

/// Reports a fault in its file, or at the place of the file's path.
pub(in crate::scene) fn report(cx: &Context, path: &str, at: &Place, text: &str, fault: &Fault) {
    let name = escaped(path, 2 * QUOTED);
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
            bad_file(path, problem, help)
        }
    };
    match &fault.span {
        None => cx.error(at, error),
        Some(span) => {
            let source = cx.sources.borrow_mut().add(name, text);
            let span = span.clone();
            cx.error(&Place { source, span }, error);
        }
    }
}

/// Says what was guessed about a file; `help` says what to do if that is wrong.
pub(in crate::scene) fn tell(cx: &Context, path: &str, at: &Place, note: &Guess, help: &str) {
    let name = escaped(path, 2 * QUOTED);
    let message = format!("\"{name}\": {}", note.what);
    let is_guess = note.otherwise.is_some();
    let help = if is_guess {
        help
    } else {
        "change the file if that is not meant"
    };
    cx.warn(at, "scene::units", message, help);
}

/// An error of a file.
pub(in crate::scene) fn bad_file(path: &str, problem: String, help: &str) -> DocumentError {
    DocumentError::BadFile {
        path: escaped(path, 2 * QUOTED),
        problem,
        help: help.to_owned(),
    }
}

/// The error of a gap in a file's wavelengths, if it matters to the wavelengths that are needed.
pub(in crate::scene) fn gap(
    cx: &Context,
    path: &str,
    [from, to]: [f64; 2],
) -> Option<DocumentError> {
    let needed = cx.range_nm.get();
    let matters = needed.is_none_or(|[low, high]| from < high && to > low);
    matters.then(|| {
        let problem = format!("has a gap: nothing between {from} and {to} nm");
        let help = "measure or interpolate the values there and add their lines";
        bad_file(path, problem, help)
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
        let rows = rows_of(&cx, "t.csv", &at, bytes, guess);
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
    fn units_are_guessed_where_that_is_asked_for_and_told() {
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
