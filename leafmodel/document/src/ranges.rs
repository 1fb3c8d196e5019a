//! Values of a plan against the ranges of their keys.

use thiserror::Error;

use super::limits::Plain;
use super::schema::Type;
use super::tree::Value;

/// A value outside the range of its key.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("{path} is {value}, outside {limits}")]
pub struct RangeError {
    /// The key, with the blocks that lead to it.
    pub path: String,
    /// What it is, in the unit of the key.
    pub value: String,
    /// What it may be.
    pub limits: String,
}

impl RangeError {
    /// `Ok` if `valid`, which should be false for a NaN.
    ///
    /// # Errors
    ///
    /// [`RangeError`] unless it is valid.
    pub fn unless(valid: bool, path: &str, value: f64, limits: &str) -> Result<(), Self> {
        valid.then_some(()).ok_or_else(|| Self {
            path: path.to_owned(),
            value: Plain(value).to_string(),
            limits: limits.to_owned(),
        })
    }
}

/// What is out of range in a block, and where the block lies.
#[derive(Debug, Default)]
pub(super) struct Ranges {
    path: String,
    pub(super) errors: Vec<RangeError>,
}

impl Ranges {
    /// The same for a block inside this one, which gives its errors back.
    pub(super) fn inside(&mut self, name: &str) -> Self {
        Self {
            path: self.path_of(name) + ".",
            errors: std::mem::take(&mut self.errors),
        }
    }

    /// Checks the value of a key, as a file would hold it.
    pub(super) fn value(&mut self, name: &str, of: &Type, value: &Value) {
        match (of, value) {
            (Type::Number(limits), Value::Integer(_) | Value::Number(_)) => {
                let value = as_number(value);
                if !limits.contain(value) {
                    self.refuse(name, Plain(value).to_string(), limits.to_string());
                }
            }
            (Type::Integer { least, most }, Value::Integer(integer)) => {
                if !(i128::from(*least)..=i128::from(*most)).contains(integer) {
                    self.refuse(name, integer.to_string(), of.in_brief());
                }
            }
            (Type::Tuple(types), Value::List(values)) => {
                for (of, node) in types.iter().zip(values) {
                    self.value(name, of, &node.value);
                }
            }
            (
                Type::List {
                    of,
                    least,
                    most,
                    wanted,
                },
                Value::List(values),
            ) => {
                self.length(name, values.len(), *least, *most, wanted);
                for (index, node) in values.iter().enumerate() {
                    self.value(&format!("{name}[{index}]"), of, &node.value);
                }
            }
            (Type::Map(of), Value::Table(table)) => {
                for entry in &table.0 {
                    self.value(&format!("{name}.{}", entry.key), of, &entry.node.value);
                }
            }
            (Type::AnyOf(types, _), value) => {
                let errors = types.iter().filter(|of| of.is_of(value)).map(|of| {
                    let mut ranges = Self::default();
                    ranges.value(&self.path_of(name), of, value);
                    ranges.errors
                });
                let fewest = errors.min_by_key(Vec::len);
                self.errors.extend(fewest.into_iter().flatten());
            }
            // Words, names, texts and flags have no ends, and a kind writes its own type.
            (
                Type::Number(_)
                | Type::Integer { .. }
                | Type::Flag
                | Type::Text(_)
                | Type::Word(_)
                | Type::Name(..)
                | Type::Tuple(_)
                | Type::List { .. }
                | Type::Map(_)
                | Type::Table(_),
                _,
            ) => {}
        }
    }

    /// Checks the length of a list.
    pub(super) fn length(&mut self, name: &str, found: usize, least: usize, most: usize, of: &str) {
        if !(least..=most).contains(&found) {
            self.refuse(name, format!("a list of {found}"), of.to_owned());
        }
    }

    fn refuse(&mut self, name: &str, value: String, limits: String) {
        let error = RangeError {
            path: self.path_of(name),
            value,
            limits,
        };
        self.errors.push(error);
    }

    fn path_of(&self, name: &str) -> String {
        format!("{}{name}", self.path)
    }
}

fn as_number(value: &Value) -> f64 {
    match value {
        Value::Integer(integer) => *integer as f64,
        Value::Number(number) => *number,
        Value::Text(_) | Value::Flag(_) | Value::Other(..) | Value::List(_) | Value::Table(_) => {
            f64::NAN
        }
    }
}

impl Type {
    /// Whether a value has the form of this type, whatever its numbers.
    fn is_of(&self, value: &Value) -> bool {
        match (self, value) {
            (Self::Number(_), Value::Integer(_) | Value::Number(_))
            | (Self::Integer { .. }, Value::Integer(_))
            | (Self::Flag, Value::Flag(_))
            | (Self::Text(_) | Self::Word(_) | Self::Name(..), Value::Text(_))
            | (Self::List { .. }, Value::List(_))
            | (Self::Map(_) | Self::Table(_), Value::Table(_)) => true,
            (Self::Tuple(types), Value::List(values)) => types.len() == values.len(),
            (Self::AnyOf(types, _), value) => types.iter().any(|of| of.is_of(value)),
            _ => false,
        }
    }
}
