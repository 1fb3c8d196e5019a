//! Values that are of one of several kinds.

use super::checks::UNKNOWN;
use super::{Keys, Pass, fresh};
use crate::document::schema::{BlockSchema, Group, Is};

/// One of several kinds that a value of type `T` can be, with the block that says so.
#[derive(Debug)]
pub struct Variant<T> {
    /// Name of the block.
    pub name: &'static str,
    /// What this kind is.
    pub about: &'static str,
    /// One with all defaults.
    pub new: fn() -> T,
    /// Whether a value is of this kind.
    pub is: fn(&T) -> bool,
    /// Its keys; for values of this kind only.
    pub declare: fn(&mut T, &mut Keys<'_>),
}

/// A [`Variant`] whose enum variant holds one value with a `Default`.
#[macro_export]
macro_rules! variant {
    ($name:literal, $kind:path, $declare:expr, $about:literal) => {
        $crate::document::keys::Variant {
            name: $name,
            about: $about,
            new: || $kind(Default::default()),
            is: |value| matches!(value, $kind(_)),
            declare: |value, keys| {
                if let $kind(inner) = value {
                    $declare(inner, keys);
                }
            },
        }
    };
}

impl Keys<'_> {
    /// The block inside this one that says of which kind the value is: exactly one, and nothing
    /// else beside it but keys declared before. With a preset beneath, none leaves the kind as it
    /// is.
    pub fn kind<T>(&mut self, value: &mut T, variants: &[Variant<T>]) {
        let current = variants.iter().find(|variant| (variant.is)(value));
        match &mut self.pass {
            Pass::Read(reading) => {
                reading.is_judged = true;
                let names: Vec<&'static str> =
                    variants.iter().map(|variant| variant.name).collect();
                let base = reading.base.as_deref().zip(current);
                let kept = base.map(|(_, current)| current.name);
                let Some((name, mut inner)) = reading.block.variant(&names, kept) else {
                    return;
                };
                let Some(variant) = variants.iter().find(|variant| variant.name == name) else {
                    return;
                };
                let mut below = reading.base.clone();
                if kept != Some(name) {
                    *value = (variant.new)();
                    if let Some((preset, current)) = base.filter(|(preset, _)| *preset != UNKNOWN) {
                        inner.starts_anew(preset, current.name);
                    }
                    below = below.filter(|base| **base == *UNKNOWN);
                }
                Self::read_within(inner, below, |keys| (variant.declare)(value, keys));
            }
            Pass::Write { .. } | Pass::Check(_) => self.current_kind(value, current),
            Pass::Describe(schema) => {
                describe_variants(schema, variants);
                schema.groups.push(Group {
                    keys: variants.iter().map(|variant| variant.name).collect(),
                    required: true,
                });
            }
        }
    }

    /// As [`Keys::kind`], but beside other keys, and where none of the blocks is there the value
    /// stays what it was.
    pub fn kind_or_none<T>(&mut self, value: &mut T, variants: &[Variant<T>]) {
        let current = variants.iter().find(|variant| (variant.is)(value));
        let names: Vec<&'static str> = variants.iter().map(|variant| variant.name).collect();
        let chosen = self.one_of_or_none(&names, current.map(|variant| variant.name));
        match &mut self.pass {
            Pass::Read(reading) => {
                let name = chosen.first();
                let variant = variants.iter().find(|variant| Some(&variant.name) == name);
                let Some(variant) = variant else {
                    return;
                };
                let is_same = current.is_some_and(|current| current.name == variant.name);
                if !is_same {
                    *value = (variant.new)();
                }
                let base = reading.base.clone();
                let base = base.filter(|base| is_same || **base == *UNKNOWN);
                if let Some(inner) = reading.block.optional_block(variant.name) {
                    Self::read_within(inner, base, |keys| (variant.declare)(value, keys));
                }
            }
            Pass::Write { .. } | Pass::Check(_) => self.current_kind(value, current),
            Pass::Describe(schema) => describe_variants(schema, variants),
        }
    }

    /// Writes or checks a value that is of a kind.
    fn current_kind<T>(&mut self, value: &mut T, current: Option<&Variant<T>>) {
        match (&mut self.pass, current) {
            (Pass::Write { extent, block }, Some(variant)) => {
                let inner = fresh(*extent, value, &mut (variant.new)(), &variant.declare);
                block.kind(variant.name, inner);
            }
            (Pass::Check(ranges), Some(variant)) => {
                Self::check_inside(ranges, variant.name, |keys| (variant.declare)(value, keys));
            }
            (_, None) | (Pass::Read(_) | Pass::Describe(_), _) => {}
        }
    }

    /// Whichever of these keys is there, of which there must be exactly one; the caller then
    /// declares it. `current` is the one that the value has. A description gets them all, one after
    /// the other.
    pub fn one_of(
        &mut self,
        names: &[&'static str],
        current: Option<&'static str>,
    ) -> Vec<&'static str> {
        self.choice(names, current, true)
    }

    /// As [`Keys::one_of`], but none of them may be there.
    pub fn one_of_or_none(
        &mut self,
        names: &[&'static str],
        current: Option<&'static str>,
    ) -> Vec<&'static str> {
        self.choice(names, current, false)
    }

    fn choice(
        &mut self,
        names: &[&'static str],
        current: Option<&'static str>,
        required: bool,
    ) -> Vec<&'static str> {
        match &mut self.pass {
            Pass::Read(reading) => {
                let block = &reading.block;
                let none = names.iter().all(|name| block.entry(name).is_none());
                if none && (reading.base.is_some() || !required) {
                    let looked_into = block.cx.survey.borrow().is_some();
                    return current.filter(|_| looked_into).into_iter().collect();
                }
                let one = if required {
                    block.exactly_one(names)
                } else {
                    block.at_most_one(names)
                };
                one.into_iter().collect()
            }
            Pass::Write { .. } | Pass::Check(_) => current.into_iter().collect(),
            Pass::Describe(schema) => {
                schema.groups.push(Group {
                    keys: names.to_vec(),
                    required,
                });
                names.to_vec()
            }
        }
    }

    /// Tells a description of keys of which exactly one is there.
    pub fn group(&mut self, names: &[&'static str]) {
        if let Pass::Describe(schema) = &mut self.pass {
            schema.groups.push(Group {
                keys: names.to_vec(),
                required: true,
            });
        }
    }
}

fn describe_variants<T>(schema: &mut BlockSchema, variants: &[Variant<T>]) {
    for variant in variants {
        schema.entry(
            variant.name,
            variant.about,
            false,
            Is::Block(Keys::describe(|keys| {
                (variant.declare)(&mut (variant.new)(), keys);
            })),
        );
    }
}
