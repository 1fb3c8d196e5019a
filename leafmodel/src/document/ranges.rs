//! Values of a plan against the ranges of their keys.

use thiserror::Error;

use super::keys::Keys;
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
    pub(crate) fn unless(valid: bool, path: &str, value: f64, limits: &str) -> Result<(), Self> {
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
    /// Checks what a block inside this one declares.
    pub(super) fn block(&mut self, name: &str, declare: impl FnOnce(&mut Keys<'_>)) {
        let inner = Self {
            path: self.path_of(name) + ".",
            errors: std::mem::take(&mut self.errors),
        };
        self.errors = Keys::check_within(inner, declare).errors;
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::declared::Declared;

    #[derive(Clone, Declared)]
    struct Fan {
        /// How many there are.
        #[key("blades", 2..=12)]
        blades: u32,
        /// How far they are turned.
        ///
        /// Radians.
        #[key("pitch_deg", degrees(-90.0..=90.0))]
        pitch: f64,
        /// What turns it.
        #[key("motor", block, default = Motor { power: 1.0 })]
        motor: Option<Motor>,
    }

    #[derive(Clone, Declared)]
    struct Motor {
        /// What it takes.
        #[key("power_w", required, above(0.0, 1e3))]
        power: f64,
    }

    #[test]
    fn values_outside_the_range_of_their_key_are_reported_with_their_path() {
        let fan = |blades, degrees: f64, power: Option<f64>| Fan {
            blades,
            pitch: degrees.to_radians(),
            motor: power.map(|power| Motor { power }),
        };
        assert_eq!(fan(3, 90.0, Some(1e3)).in_range(), Ok(()));
        let mut wrong = fan(1, -90.5, Some(f64::NAN));
        let errors = Keys::check(|keys| wrong.declare(keys));
        let messages: Vec<String> = errors.iter().map(ToString::to_string).collect();
        assert_eq!(
            messages,
            [
                "blades is 1, outside 2 to 12",
                "pitch_deg is -90.5, outside -90 to 90",
                "motor.power_w is NaN, outside the values above 0 and up to 1000",
            ]
        );
    }

    #[test]
    fn what_is_derived_describes_a_block_as_if_written_by_hand() {
        let mut fan = Fan {
            blades: 3,
            pitch: 0.5,
            motor: None,
        };
        let schema = Keys::describe(|keys| fan.declare(keys));
        let keys: Vec<&str> = schema.entries.iter().map(|entry| &*entry.key).collect();
        assert_eq!(keys, ["blades", "pitch_deg", "motor"]);
        assert_eq!(schema.entries[1].about, "How far they are turned.");
    }
}
