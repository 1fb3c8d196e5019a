//! Tables of measurements: spectra of leaves, and BSDFs over angles.
//!
//! - **In**: text of files as instruments and spreadsheets write them.
//! - **Out**: [`series`] has one spectrum, [`spectra`] the spectra of leaves by name, [`bsdf`] values
//!   by directions and wavelength with its reciprocal part. Wavelengths are nm, shares 0 to 1.
//! - **Always true**: what is guessed about units is told in notes; what is wrong is told once, with
//!   its place in the file ([`Fault`]).
//! - **Left out**: opening of files, and scenes.
//!
//! ```
//! use renderer::measured::spectra;
//!
//! let text = "um,birch_R,birch_R_abaxial,birch_T\n0.45,5,9,1\n0.55,12,18,11\n0.65,6,10,4\n";
//! let found = spectra::read(text).expect("a good table");
//! assert_eq!(found.notes.len(), 2, "micrometres and percent are told");
//! let birch = &found.leaves[0];
//! assert_eq!((birch.name.as_str(), birch.nm[1]), ("birch", 550.0));
//! assert_eq!((birch.reflectance[1], birch.abaxial[1], birch.transmittance[1]), (0.12, 0.18, 0.11));
//! ```

pub mod bsdf;
mod columns;
pub mod sensitivities;
pub mod series;
pub mod spectra;
pub mod units;

use std::ops::Range;
use std::path::Path;

use leafmodel::document::source::line_of_byte;
use thiserror::Error;

/// Longest piece of a file that a message repeats, in characters.
const QUOTED: usize = 40;

/// How far values may leave the range that physics allows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slack(f64);

impl Slack {
    /// None but rounding.
    pub const NONE: Self = Self(1e-9);
    /// That of the noise of measurements, which fits average out.
    pub const NOISE: Self = Self(0.05);
}

/// What is wrong with a file, and where.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("{what}")]
pub struct Fault {
    /// Bytes of the text, if it has a place.
    pub span: Option<Range<usize>>,
    /// What is wrong.
    pub what: What,
}

/// What is wrong with a file.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum What {
    /// In words.
    #[error("{problem}")]
    Words {
        /// What is wrong, as a sentence that follows the file's name.
        problem: String,
        /// What to do about it; empty if that is plain.
        help: &'static str,
    },
    /// A number that is none.
    #[error("has {value}, which is not a finite number")]
    NotFinite {
        /// As written, safe to print.
        value: String,
    },
}

impl Fault {
    /// A fault of the file as a whole.
    fn of_file(problem: impl Into<String>, help: &'static str) -> Self {
        Self {
            span: None,
            what: What::Words {
                problem: problem.into(),
                help,
            },
        }
    }

    /// A fault at bytes of the text.
    fn at(span: Range<usize>, problem: impl Into<String>, help: &'static str) -> Self {
        Self {
            span: Some(span),
            ..Self::of_file(problem, help)
        }
    }

    /// A fault of a whole line, counted from 1.
    fn in_line(text: &str, line: usize, problem: impl Into<String>, help: &'static str) -> Self {
        Self::at(span_of_line(text, line), problem, help)
    }

    /// As a message of a program: file, line, problem, help.
    pub fn shown(&self, file: &Path, text: &str) -> String {
        let file = file.display();
        let line = self
            .span
            .as_ref()
            .map(|span| line_of_byte(text.as_bytes(), span.start));
        let place = line.map_or_else(|| file.to_string(), |line| format!("{file}, line {line}"));
        match &self.what {
            What::Words { problem, help: "" } => format!("{place}: {problem}"),
            What::Words { problem, help } => format!("{place}: {problem}: {help}"),
            What::NotFinite { .. } => format!("{place}: {}", self.what),
        }
    }
}

/// The bytes of a line, counted from 1, without its end.
fn span_of_line(text: &str, line: usize) -> Range<usize> {
    let mut start = 0;
    for (number, piece) in text.split_inclusive('\n').enumerate() {
        if number + 1 == line {
            return start..start + piece.trim_end().len();
        }
        start += piece.len();
    }
    text.len()..text.len()
}

/// Lines of the records of a table, counted from 1, asked for in their order.
///
/// A reader tells where it began to look for a record: before the rest of a line's end, empty lines
/// and comments.
struct Lines<'a> {
    text: &'a [u8],
    byte: usize,
    line: usize,
}

impl<'a> Lines<'a> {
    fn of(text: &'a str) -> Self {
        Self {
            text: text.as_bytes(),
            byte: 0,
            line: 1,
        }
    }

    /// The line on which a record begins.
    fn at(&mut self, began: &csv::Position) -> usize {
        while self.byte < began.byte() as usize {
            self.step();
        }
        while let Some(byte) = self.text.get(self.byte) {
            match byte {
                b'\r' | b'\n' => self.step(),
                b'#' => {
                    while self.text.get(self.byte).is_some_and(|byte| *byte != b'\n') {
                        self.step();
                    }
                }
                _ => break,
            }
        }
        self.line
    }

    fn step(&mut self) {
        self.line += usize::from(self.text.get(self.byte) == Some(&b'\n'));
        self.byte += 1;
    }
}

/// A fault that the reader of a table tells.
fn of_csv(text: &str, error: &csv::Error) -> Fault {
    let line = error.position().map(|began| Lines::of(text).at(began));
    // Its own words name a line too, counted in its way.
    let problem = if let csv::ErrorKind::UnequalLengths {
        expected_len, len, ..
    } = error.kind()
    {
        format!("the line has {len} values, but there are {expected_len} columns")
    } else {
        error.to_string()
    };
    Fault {
        span: line.map(|line| span_of_line(text, line)),
        ..Fault::of_file(problem, "")
    }
}

/// A piece of a file, safe to print.
fn quoted(piece: &str) -> String {
    let piece: String = piece.chars().take(QUOTED).collect();
    piece.escape_debug().to_string()
}
