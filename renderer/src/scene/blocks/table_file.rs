//! Tables of spectra in files: two columns, wavelength in nm and value.

use leafmodel::document::context::{Context, QUOTED};
use leafmodel::document::error::DocumentError;
use leafmodel::document::source::{Place, escaped, line_of_byte};

/// Rows of a table, each with its place.
#[derive(Debug, Default)]
pub(super) struct Rows {
    pub(super) points: Vec<(f64, f64)>,
    /// Places of the wavelength and of the value.
    pub(super) places: Vec<[Place; 2]>,
}

/// Reads a table file: columns separated by comma, semicolon, tab or spaces, an optional header
/// line, `#` before comments; empty lines are ignored.
///
/// Errors point into the file; `at` is the place of its name in the scene, for files that are not
/// text.
pub(super) fn read_table_file(cx: &Context, path: &str, at: &Place, bytes: &[u8]) -> Option<Rows> {
    let name = escaped(path, 2 * QUOTED);
    let text = match std::str::from_utf8(bytes) {
        Ok(text) => text.strip_prefix('\u{feff}').unwrap_or(text),
        Err(error) => {
            let byte = error.valid_up_to();
            let line = line_of_byte(bytes, byte);
            cx.error(
                at,
                DocumentError::NotUtf8 {
                    path: name,
                    byte,
                    line,
                },
            );
            return None;
        }
    };
    let source = cx.sources.borrow_mut().add(name.clone(), text);
    let mut rows = Rows::default();
    let mut names_allowed = true;
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        let fields = fields(line, start, source);
        start += line.len();
        if fields.is_empty() {
            continue;
        }
        let numbers: Vec<Option<f64>> =
            fields.iter().map(|(field, _)| field.parse().ok()).collect();
        if names_allowed && numbers[0].is_none() {
            names_allowed = false;
            continue;
        }
        names_allowed = false;
        let whole_line = Place {
            source,
            span: fields[0].1.span.start..fields[fields.len() - 1].1.span.end,
        };
        let bad = |problem: String, help: &str| DocumentError::BadFile {
            path: name.clone(),
            problem,
            help: help.to_owned(),
        };
        if fields.len() != 2 {
            let problem = format!("has {} columns in this line, wanted are 2", fields.len());
            let help = "keep the wavelength in nm and the value, with a decimal point";
            cx.error(&whole_line, bad(problem, help));
            return None;
        }
        for ((field, at), number) in fields.iter().zip(&numbers) {
            match number {
                Some(number) if number.is_finite() => {}
                Some(_) => {
                    let error = DocumentError::NotFinite {
                        key: name.clone(),
                        value: escaped(field, QUOTED),
                    };
                    cx.error(at, error);
                    return None;
                }
                None => {
                    let problem =
                        format!("has `{}` where a number is wanted", escaped(field, QUOTED));
                    cx.error(at, bad(problem, "write a number, or `#` before a comment"));
                    return None;
                }
            }
        }
        if let (Some(wavelength_nm), Some(value)) = (numbers[0], numbers[1]) {
            rows.points.push((wavelength_nm, value));
            rows.places.push([fields[0].1.clone(), fields[1].1.clone()]);
        }
    }
    Some(rows)
}

/// The columns of a line before its comment, each with its place.
fn fields(line: &str, start: usize, source: usize) -> Vec<(&str, Place)> {
    let line = line.split('#').next().unwrap_or("");
    let separator =
        |character: char| character == ',' || character == ';' || character.is_whitespace();
    let base = line.as_ptr() as usize;
    line.split(separator)
        .filter(|field| !field.is_empty())
        .map(|field| {
            let from = start + (field.as_ptr() as usize - base);
            let place = Place {
                source,
                span: from..from + field.len(),
            };
            (field, place)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use leafmodel::document::source::Sources;

    /// The rows, and the codes of the errors.
    type Outcome = (Option<Vec<(f64, f64)>>, Vec<&'static str>);

    fn read(text: &str) -> Outcome {
        let cx = Context::new(Sources::default(), std::path::PathBuf::new());
        let at = Place {
            source: 0,
            span: 0..0,
        };
        let rows = read_table_file(&cx, "t.csv", &at, text.as_bytes());
        let (_, errors, _) = cx.into_parts();
        let codes = errors.iter().map(|located| located.error.code()).collect();
        (rows.map(|rows| rows.points), codes)
    }

    #[test]
    fn names_comments_and_every_separator_are_read() {
        let text = "\u{feff}# made up\nwavelength_nm,R\r\n400,0.1\r\n500; 0.2 # peak\n\n\
                    600\t0.3\n700 4e-1";
        let points = vec![(400.0, 0.1), (500.0, 0.2), (600.0, 0.3), (700.0, 0.4)];
        assert_eq!(read(text), (Some(points), vec![]));
    }

    #[test]
    fn what_is_no_number_is_an_error_below_the_names() {
        assert_eq!(read("nm,R\nnm,R\n").1, ["scene::bad_file"]);
        assert_eq!(read("400,0.1,3\n").1, ["scene::bad_file"]);
        assert_eq!(read("400;0,1\n").1, ["scene::bad_file"]);
        assert_eq!(read("400,nan\n").1, ["scene::not_finite"]);
    }
}
