//! Tables of measurements: spectra of leaves, and BSDFs over angles.
//!
//! - **In**: text of files as instruments and spreadsheets write them.
//! - **Out**: [`series`] has one spectrum, [`spectra`] the spectra of leaves by name, [`bsdf`] values
//!   by directions and wavelength with its reciprocal part. Wavelengths are nm, shares 0 to 1.
//! - **Always true**: notes name what is guessed, left out or passed over; a [`known::Known`] says
//!   otherwise. What is wrong is reported once, with its place in the file ([`Fault`]).
//! - **Left out**: opening of files, and scenes.
//!
//! ```
//! use renderer::measured::{known::Known, spectra};
//!
//! let text = "um,birch_R,birch_R_abaxial,birch_T\n0.45,5,9,1\n0.55,12,18,11\n0.65,6,10,4\n";
//! let found = spectra::read(text, &Known::default()).expect("a good table");
//! assert_eq!(found.notes.len(), 1, "percent is a guess, and micrometres are a name");
//! let birch = &found.leaves[0];
//! assert_eq!((birch.name.as_str(), birch.nm[1]), ("birch", 550.0));
//! assert_eq!((birch.reflectance[1], birch.abaxial[1], birch.transmittance[1]), (0.12, 0.18, 0.11));
//! ```

pub mod bsdf;
mod columns;
pub mod known;
mod leaf;
mod masks;
mod misnomers;
pub mod responses;

pub mod series;
pub mod spectra;
pub mod units;

use std::ops::Range;
use std::path::Path;

use leafmodel::document::rows::Ragged;
use leafmodel::document::source::line_of_byte;
use thiserror::Error;

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

/// The fault of a row with too few or too many fields.
fn of_ragged(ragged: &Ragged) -> Fault {
    Fault::at(ragged.span.clone(), ragged.to_string(), "")
}
