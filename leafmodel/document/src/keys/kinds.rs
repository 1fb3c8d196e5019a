//! Values that are of one of several kinds.

use super::checks::UNKNOWN;
use super::{Keys, Pass, fresh};
use crate::schema::{BlockSchema, Group, Is};

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
        $crate::keys::kinds::Variant {
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

/// What names the keys of a value.
type Declaration<'v, T> = Box<dyn Fn(&mut T, &mut Keys<'_>) + 'v>;

/// One of several kinds, of a value itself or of what lies in it.
pub struct Choice<'v, T> {
    name: &'static str,
    about: &'static str,
    new: Box<dyn Fn() -> T + 'v>,
    is: Box<dyn Fn(&mut T) -> bool + 'v>,
    declare: Declaration<'v, T>,
}

impl<T: 'static> Variant<T> {
    /// The kind of a value that may hold one of type `T`.
    pub fn within<O: 'static>(
        &self,
        put: fn(T) -> O,
        get: fn(&mut O) -> Option<&mut T>,
    ) -> Choice<'_, O> {
        Choice {
            name: self.name,
            about: self.about,
            new: Box::new(move || put((self.new)())),
            is: Box::new(move |value| get(value).is_some_and(|own| (self.is)(own))),
            declare: Box::new(move |value, keys| {
                if let Some(own) = get(value) {
                    (self.declare)(own, keys);
                }
            }),
        }
    }
}

/// Variants as the kinds of the value itself.
fn choices<T: 'static>(variants: &[Variant<T>]) -> Vec<Choice<'_, T>> {
    let variants = variants.iter();
    variants
        .map(|variant| variant.within(|own| own, |own| Some(own)))
        .collect()
}

impl Keys<'_> {
    /// The block inside this one that says of which kind the value is: exactly one, and nothing
    /// else beside it but keys declared before. With a preset beneath, none leaves the kind as it
    /// is.
    pub fn kind<T: 'static>(&mut self, value: &mut T, variants: &[Variant<T>]) {
        self.choose(value, &choices(variants));
    }

    /// The same where some of the kinds are those of a value inside this one.
    pub fn choose<T>(&mut self, value: &mut T, kinds: &[Choice<'_, T>]) {
        let current = kinds.iter().find(|kind| (kind.is)(value));
        match &mut self.pass {
            Pass::Read(reading) => {
                reading.is_judged = true;
                let names: Vec<&'static str> = kinds.iter().map(|kind| kind.name).collect();
                let base = reading.base.as_deref().zip(current);
                let kept = base.map(|(_, current)| current.name);
                let Some((name, mut inner)) = reading.block.variant(&names, kept) else {
                    return;
                };
                let Some(kind) = kinds.iter().find(|kind| kind.name == name) else {
                    return;
                };
                let mut below = reading.base.clone();
                if kept != Some(name) {
                    *value = (kind.new)();
                    if let Some((preset, current)) = base.filter(|(preset, _)| *preset != UNKNOWN) {
                        inner.starts_over(preset, current.name);
                    }
                    below = below.filter(|base| **base == *UNKNOWN);
                }
                Self::read_within(inner, below, |keys| (kind.declare)(value, keys));
            }
            Pass::Describe(schema) => {
                describe_kinds(schema, kinds);
                schema.groups.push(Group {
                    keys: kinds.iter().map(|kind| kind.name).collect(),
                    required: true,
                });
            }
            Pass::Write { .. } | Pass::Check(_) => self.present_kind(value, current),
        }
    }

    /// As [`Keys::kind`], but beside other keys, and where none of the blocks is there the value
    /// stays what it was.
    pub fn kind_or_none<T: 'static>(&mut self, value: &mut T, variants: &[Variant<T>]) {
        let kinds = choices(variants);
        let current = kinds.iter().find(|kind| (kind.is)(value));
        let names: Vec<&'static str> = kinds.iter().map(|kind| kind.name).collect();
        let chosen = self.one_of_or_none(&names, current.map(|kind| kind.name));
        match &mut self.pass {
            Pass::Read(reading) => {
                let name = chosen.first();
                let Some(kind) = kinds.iter().find(|kind| Some(&kind.name) == name) else {
                    return;
                };
                let is_same = current.is_some_and(|current| current.name == kind.name);
                if !is_same {
                    *value = (kind.new)();
                }
                let base = reading.base.clone();
                let base = base.filter(|base| is_same || **base == *UNKNOWN);
                if let Some(inner) = reading.block.optional_block(kind.name) {
                    Self::read_within(inner, base, |keys| (kind.declare)(value, keys));
                }
            }
            Pass::Describe(schema) => describe_kinds(schema, &kinds),
            Pass::Write { .. } | Pass::Check(_) => self.present_kind(value, current),
        }
    }

    /// Writes or checks the block of the kind that the value has.
    fn present_kind<T>(&mut self, value: &mut T, current: Option<&Choice<'_, T>>) {
        let Some(kind) = current else {
            return;
        };
        match &mut self.pass {
            Pass::Write { extent, block } => {
                let inner = fresh(*extent, value, &mut (kind.new)(), &kind.declare);
                block.kind(kind.name, inner);
            }
            Pass::Check(ranges) => {
                Self::check_inside(ranges, kind.name, |keys| (kind.declare)(value, keys));
            }
            Pass::Read(_) | Pass::Describe(_) => {}
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

fn describe_kinds<T>(schema: &mut BlockSchema, kinds: &[Choice<'_, T>]) {
    for kind in kinds {
        let keys = Keys::describe(|keys| (kind.declare)(&mut (kind.new)(), keys));
        schema.entry(kind.name, kind.about, false, Is::Block(keys));
    }
}
