//! One declaration of a block, from which it is read, written, described and checked.
//!
//! A function that takes the value and [`Keys`] names each key once, with the place of its value,
//! its kind (type and range), and its meaning:
//!
//! ```
//! use document::keys::Keys;
//! use document::limits::Limits;
//! use document::value_kind::Number;
//!
//! struct Fan {
//!     blades: f64,
//! }
//!
//! fn fan(value: &mut Fan, keys: &mut Keys<'_>) {
//!     let limits = Limits::closed(2.0, 12.0);
//!     keys.key("blades", &mut value.blades, Number(limits), "How many there are.");
//! }
//!
//! let described = Keys::describe(|keys| fan(&mut Fan { blades: 3.0 }, keys));
//! assert_eq!(described.entries[0].key, "blades");
//! ```
//!
//! The value that it is given holds the defaults. While a file is read the keys that are there
//! take their places; while one is written they are compared. So a default stands where the
//! type's own `Default` does, and nowhere else.

mod checks;
pub mod kinds;
pub mod lists;

use std::rc::Rc;

use super::ranges::{RangeError, Ranges};
use super::reader::Block;
use super::schema::{BlockSchema, Is};
use super::value_kind::Kind;
use super::written::{Extent, Written};

/// A block while it is read, written, described or checked.
#[derive(Debug)]
pub struct Keys<'p> {
    pass: Pass<'p>,
}

#[derive(Debug)]
enum Pass<'p> {
    Read(Reading<'p>),
    Write { extent: Extent, block: Written },
    Describe(BlockSchema),
    Check(Ranges),
}

#[derive(Debug)]
struct Reading<'p> {
    block: Block<'p>,
    /// The preset whose values stand beneath those of the file.
    base: Option<Rc<str>>,
    /// Number of errors before this block.
    errors: usize,
    /// Blocks inside this one that have errors.
    broken: Vec<&'static str>,
    /// Whether unknown keys were already reported.
    is_judged: bool,
}

/// What is to be done where a key is left out.
#[derive(Clone, Copy, PartialEq)]
enum Need {
    HasDefault,
    Required,
    MayLack,
}

#[allow(
    clippy::needless_pass_by_value,
    reason = "a kind is made where it is used"
)]
impl<'p> Keys<'p> {
    /// Reads a block; whether it has no error. With a `base`, the values are those of a preset of
    /// that name, and no key is required.
    pub fn read(block: Block<'p>, base: Option<&str>, declare: impl FnOnce(&mut Keys<'_>)) -> bool {
        Self::read_within(block, base.map(Rc::from), declare)
    }

    fn read_within(
        block: Block<'p>,
        base: Option<Rc<str>>,
        declare: impl FnOnce(&mut Keys<'_>),
    ) -> bool {
        let errors = block.cx.error_count();
        let pass = Self::declared(
            Pass::Read(Reading {
                block,
                base,
                errors,
                broken: Vec::new(),
                is_judged: false,
            }),
            declare,
        );
        let Pass::Read(reading) = pass else {
            return false;
        };
        if !reading.is_judged {
            reading.block.finish();
        }
        reading.block.cx.error_count() == errors
    }

    /// A pass once all keys are named.
    fn declared(pass: Pass<'_>, declare: impl FnOnce(&mut Keys<'_>)) -> Pass<'_> {
        let mut keys = Keys { pass };
        declare(&mut keys);
        keys.pass
    }

    /// Writes a block.
    pub fn write(extent: Extent, declare: impl FnOnce(&mut Keys<'_>)) -> Written {
        let block = Written::default();
        match Self::declared(Pass::Write { extent, block }, declare) {
            Pass::Write { block, .. } => block,
            Pass::Read(_) | Pass::Describe(_) | Pass::Check(_) => Written::default(),
        }
    }

    /// Describes a block whose values are defaults.
    pub fn describe(declare: impl FnOnce(&mut Keys<'_>)) -> BlockSchema {
        match Self::declared(Pass::Describe(BlockSchema::default()), declare) {
            Pass::Describe(schema) => schema,
            Pass::Read(_) | Pass::Write { .. } | Pass::Check(_) => BlockSchema::default(),
        }
    }

    /// Everything in a block that lies outside the range of its key.
    pub fn check(declare: impl FnOnce(&mut Keys<'_>)) -> Vec<RangeError> {
        Self::check_within(Ranges::default(), declare).errors
    }

    fn check_within(ranges: Ranges, declare: impl FnOnce(&mut Keys<'_>)) -> Ranges {
        match Self::declared(Pass::Check(ranges), declare) {
            Pass::Check(ranges) => ranges,
            Pass::Read(_) | Pass::Write { .. } | Pass::Describe(_) => Ranges::default(),
        }
    }

    /// Checks a block inside the one that is checked.
    fn check_inside(ranges: &mut Ranges, name: &str, declare: impl FnOnce(&mut Keys<'_>)) {
        ranges.errors = Self::check_within(ranges.inside(name), declare).errors;
    }

    /// A key that may be left out: the value is then what it was.
    pub fn key<K: Kind>(
        &mut self,
        name: &'static str,
        value: &mut K::Of,
        kind: K,
        about: &'static str,
    ) {
        if let Some(read) = self.value(name, Some(&*value), &kind, about, Need::HasDefault) {
            *value = read;
        }
    }

    /// A key that must be there, unless a preset stands beneath.
    pub fn required<K: Kind>(
        &mut self,
        name: &'static str,
        value: &mut K::Of,
        kind: K,
        about: &'static str,
    ) {
        if let Some(read) = self.value(name, Some(&*value), &kind, about, Need::Required) {
            *value = read;
        }
    }

    /// A key without a default: what is not there is `None`.
    pub fn optional<K: Kind>(
        &mut self,
        name: &'static str,
        value: &mut Option<K::Of>,
        kind: K,
        about: &'static str,
    ) {
        if let Some(read) = self.value(name, value.as_ref(), &kind, about, Need::MayLack) {
            *value = Some(read);
        }
    }

    /// A key with a value, if it has one; gives what a file has.
    fn value<K: Kind>(
        &mut self,
        name: &'static str,
        value: Option<&K::Of>,
        kind: &K,
        about: &'static str,
        need: Need,
    ) -> Option<K::Of> {
        let required = need == Need::Required;
        match (&mut self.pass, value) {
            (Pass::Read(reading), _) => {
                let block = &reading.block;
                let node = if required && reading.base.is_none() {
                    block.needed(name, || kind.describe().to_add(name))
                } else {
                    block.node(name)
                };
                return kind.read_in(block, node?, name);
            }
            (Pass::Write { block, .. }, Some(value)) => {
                block.value(name, required, kind.write(value));
            }
            (Pass::Check(ranges), Some(value)) => {
                ranges.value(name, &kind.describe(), &kind.write(value));
            }
            (Pass::Describe(schema), _) => {
                let default = value.filter(|_| need == Need::HasDefault);
                let is = Is::Value {
                    of: kind.describe(),
                    default: default.map(|value| kind.write(value)),
                };
                schema.entry(name, about, required, is);
            }
            (Pass::Write { .. } | Pass::Check(_), None) => {}
        }
        None
    }

    /// A key that must be there beside another that is, with or without a preset.
    pub fn needed<K: Kind>(
        &mut self,
        name: &'static str,
        value: &mut K::Of,
        kind: K,
        about: &'static str,
    ) {
        let base = match &mut self.pass {
            Pass::Read(reading) => reading.base.take(),
            Pass::Describe(_) => {
                return self.optional(name, &mut None, kind, about);
            }
            Pass::Write { .. } | Pass::Check(_) => None,
        };
        self.required(name, value, kind, about);
        if let Pass::Read(reading) = &mut self.pass {
            reading.base = base;
        }
    }

    /// A block of keys that all have defaults.
    pub fn block(
        &mut self,
        name: &'static str,
        about: &'static str,
        declare: impl FnOnce(&mut Keys<'_>),
    ) {
        self.inner_block(name, about, None, declare);
    }

    /// A block that must be there, unless a preset stands beneath; of one of the kinds, if there
    /// are any.
    pub fn required_block(
        &mut self,
        name: &'static str,
        about: &'static str,
        kinds: &[&'static str],
        declare: impl FnOnce(&mut Keys<'_>),
    ) {
        self.inner_block(name, about, Some(kinds), declare);
    }

    fn inner_block(
        &mut self,
        name: &'static str,
        about: &'static str,
        required: Option<&[&'static str]>,
        declare: impl FnOnce(&mut Keys<'_>),
    ) {
        match &mut self.pass {
            Pass::Read(reading) => {
                let errors = reading.block.cx.error_count();
                let inner = match required {
                    Some(kinds) if reading.base.is_none() => reading.block.block(name, kinds),
                    Some(_) | None => reading.block.optional_block(name),
                };
                if let Some(inner) = inner {
                    Self::read_within(inner, reading.base.clone(), declare);
                }
                if reading.block.cx.error_count() > errors {
                    reading.broken.push(name);
                }
            }
            Pass::Write { extent, block } => {
                let inner = Self::write(*extent, declare);
                let kept = required.is_some();
                if kept || !inner.is_empty() {
                    block.block(name, kept, inner);
                }
            }
            Pass::Check(ranges) => Self::check_inside(ranges, name, declare),
            Pass::Describe(schema) => schema.entry(
                name,
                about,
                required.is_some(),
                Is::Block(Self::describe(declare)),
            ),
        }
    }

    /// A block that is `None` where it is left out. `new` gives one with all defaults.
    pub fn optional_block<T>(
        &mut self,
        name: &'static str,
        value: &mut Option<T>,
        new: impl Fn() -> T,
        about: &'static str,
        declare: impl Fn(&mut T, &mut Keys<'_>),
    ) {
        match &mut self.pass {
            Pass::Read(reading) => {
                let is_there = reading.block.table.get(name).is_some();
                let Some(inner) = reading.block.optional_block(name) else {
                    return;
                };
                let base = reading.base.clone().filter(|_| value.is_some());
                let mut read = value.take().unwrap_or_else(&new);
                Self::read_within(inner, base, |keys| declare(&mut read, keys));
                // A survey of the keys looks into blocks that are not there.
                *value = is_there.then_some(read);
            }
            Pass::Write { extent, block } => {
                if let Some(value) = value {
                    block.block(name, true, fresh(*extent, value, &mut new(), &declare));
                }
            }
            Pass::Check(ranges) => {
                if let Some(value) = value {
                    Self::check_inside(ranges, name, |keys| declare(value, keys));
                }
            }
            Pass::Describe(schema) => schema.entry(
                name,
                about,
                false,
                Is::Block(Self::describe(|keys| declare(&mut new(), keys))),
            ),
        }
    }
}

/// A value as it is written where it does not stand on the defaults of the block around it.
fn fresh<T>(
    extent: Extent,
    value: &mut T,
    usual: &mut T,
    declare: &impl Fn(&mut T, &mut Keys<'_>),
) -> Written {
    let own = Keys::write(extent, |keys| declare(value, keys));
    match extent {
        Extent::All => own,
        Extent::Changed => {
            let usual = Keys::write(extent, |keys| declare(usual, keys));
            own.without_defaults(&usual)
        }
    }
}
