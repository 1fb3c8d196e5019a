//! The keys that a sweep varies, and their values.

use leafmodel::document::context::{Context, QUOTED};
use leafmodel::document::error::DocumentError;
use leafmodel::document::source::{Place, escaped};

/// Most tasks of a sweep.
pub const MOST_TASKS: usize = 10_000_000;

/// A key that is varied: as much of its path as overrides of the target need.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Key {
    /// The path.
    pub path: String,
    pub(super) at: Place,
}

/// A value of a key, as an override has it behind `=`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cell {
    /// The value.
    pub text: String,
    pub(super) at: Place,
}

/// Keys that are set together, and the rows of their values, each as long as `keys`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Axis {
    pub(super) keys: Vec<Key>,
    pub(super) rows: Vec<Vec<Cell>>,
}

/// The shortest TOML that reads back to the same bits; integers without a point.
pub(super) fn number_text(value: f64) -> String {
    if value.fract() == 0.0 && value.abs() < 1e15 {
        format!("{value:.0}")
    } else {
        format!("{value:?}")
    }
}

/// Reports a value, or a piece of a word, that cannot be carried out.
pub(super) fn impossible(
    cx: &Context,
    at: &Place,
    key: &str,
    problem: impl Into<String>,
    help: &str,
) {
    let error = DocumentError::Impossible {
        key: escaped(key, QUOTED),
        problem: problem.into(),
        help: help.to_owned(),
    };
    cx.error(at, error);
}

/// A value as TOML has it, from text that may lack quotes: numbers in the form of TOML (`.5` is
/// 0.5), all else as it is. Reports what is empty or no finite number.
pub(super) fn cell(cx: &Context, key: &str, text: &str, at: Place) -> Option<Cell> {
    let text = text.trim();
    if text.is_empty() {
        let problem = "has an empty value";
        impossible(cx, &at, key, problem, "write a value, or take it out");
        return None;
    }
    let text = match (text.parse::<i64>(), text.parse::<f64>()) {
        (Ok(whole), _) => whole.to_string(),
        (_, Ok(number)) if number.is_finite() => number_text(number),
        (_, Ok(_)) => {
            let error = DocumentError::NotFinite {
                key: escaped(key, QUOTED),
                value: escaped(text, QUOTED),
            };
            cx.error(&at, error);
            return None;
        }
        (Err(_), Err(_)) => text.to_owned(),
    };
    Some(Cell { text, at })
}
