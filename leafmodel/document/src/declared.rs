//! Blocks that are declared by their fields.
//!
//! `#[derive(Declared)]` makes the keys of a block from a struct: `#[key("name", …)]` at a field
//! gives the key and the range, and the first paragraph of the doc comment is the sentence of the
//! schema.
//!
//! ```
//! use document::declared::Declared;
//! use document::keys::Keys;
//!
//! #[derive(Clone, Declared)]
//! struct Fan {
//!     /// How many there are.
//!     #[key("blades", required, 2..=12)]
//!     blades: u32,
//!     /// How far they are turned.
//!     ///
//!     /// Radians here, degrees in a file.
//!     #[key("pitch_deg", degrees(0.0..=80.0))]
//!     pitch: f64,
//! }
//!
//! let mut fan = Fan { blades: 13, pitch: 0.5 };
//! let error = fan.in_range().expect_err("there are too many");
//! assert_eq!(error.to_string(), "blades is 13, outside 2 to 12");
//! assert_eq!(Keys::describe(|keys| fan.declare(keys)).entries.len(), 2);
//! ```
//!
//! | in `#[key(…)]` | is |
//! | --- | --- |
//! | `low..=high`, `low..high`, `above(low, high)`, `open(low, high)`, `within(LIMITS)` | a range; the field's type says whether of an integer, a number, or each of several |
//! | `degrees(…)` | the same of an angle, which is in radians in the program |
//! | `milli(…)`, `nano(…)` | the same of a number that a file has in thousandths or billionths of the program's unit |
//! | `word` | a word of an enum with `#[derive(Words)]` |
//! | `block`, `list(most = …, wanted = …)` | a block of keys, a list of blocks |
//! | `skip` | at a variant: it is no kind of block, but what there is without one |
//! | `flat` | a struct whose keys lie in the block around it |
//! | an expression | any other [`Kind`](super::value_kind::Kind) |
//! | `required` | the key must be there, unless a preset lies beneath |
//! | `default = …` | what a block has of which nothing is said, where that is not `Default`; at a field of a struct with `#[derive(Defaults)]`, its value there |
//! | `about = …` | the sentence, where it is not that of the doc comment |
//! | `at = …` | an element of an array has a key of its own |
//! | `when = …` | the key is there only then; `self` is the block |
//! | `with = function` | keys that are declared by hand, from the field or, without a name, from the block |
//! | `last = function` | at the struct: what is called behind all keys |
//!
//! A `bool` and a seed (`u64`) need a name only. An enum with data is a block of one of several
//! kinds: each variant is a block with the name of the variant or of its `#[key("name")]`.

pub use leafmodel_derive::{Declared, Defaults, Words};

use super::keys::Keys;
use super::keys::kinds::Variant;
use super::ranges::RangeError;

/// A block whose keys are declared once.
pub trait Declared {
    /// Names its keys.
    fn declare(&mut self, keys: &mut Keys<'_>);

    /// The kinds that the block may be of, if there are several.
    fn kinds() -> Vec<&'static str> {
        Vec::new()
    }

    /// Checks every value by itself.
    ///
    /// # Errors
    ///
    /// [`RangeError`] of the first key whose value lies outside its range.
    fn in_range(&self) -> Result<(), RangeError>
    where
        Self: Clone,
    {
        let mut own = self.clone();
        let errors = Keys::check(|keys| own.declare(keys));
        errors.into_iter().next().map_or(Ok(()), Err)
    }
}

/// An enum, each of whose variants is a block.
pub trait Kinds: Sized + 'static {
    /// The variants in the order in which they are described.
    const KINDS: &'static [Variant<Self>];
}

/// An enum that a file writes as a word.
pub trait Words: Sized + 'static {
    /// The words and what they are.
    const WORDS: &'static [(&'static str, Self)];

    /// The word for this one.
    fn word(&self) -> &'static str
    where
        Self: PartialEq,
    {
        let found = Self::WORDS.iter().find(|(_, one)| one == self);
        found.map_or("", |(word, _)| word)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
        #[key("motor", block)]
        motor: Option<Motor>,
    }

    #[derive(Clone, Debug, Declared, Defaults, PartialEq)]
    struct Motor {
        /// What it takes.
        #[key("power_w", required, above(0.0, 1e3), default = 1.0)]
        power: f64,
        #[key(default = 3)]
        blades: u32,
    }

    #[test]
    fn values_outside_the_range_of_their_key_are_reported_with_their_path() {
        let fan = |blades, degrees: f64, power: Option<f64>| Fan {
            blades,
            pitch: degrees.to_radians(),
            motor: power.map(|power| Motor { power, blades: 3 }),
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
    fn defaults_are_what_the_keys_say() {
        let expected = Motor {
            power: 1.0,
            blades: 3,
        };
        assert_eq!(Motor::default(), expected);
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
