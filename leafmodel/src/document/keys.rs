//! One declaration of a block, from which it is read, written and described.
//!
//! A function that takes the value and [`Keys`] names each key once, with the place of its value,
//! its kind (type and range), and its meaning:
//!
//! ```
//! use leafmodel::document::keys::Keys;
//! use leafmodel::document::limits::Limits;
//! use leafmodel::document::schema;
//! use leafmodel::document::value_kind::Number;
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
//! let described = schema::describe(|keys| fan(&mut Fan { blades: 3.0 }, keys));
//! assert_eq!(described.entries[0].key, "blades");
//! ```
//!
//! The value that it is given holds the defaults. While a file is read the keys that are there
//! take their places; while one is written they are compared. So a default stands where the
//! type's own `Default` does, and nowhere else.

use std::rc::Rc;

use super::error::DocumentError;
use super::names::require_name;
use super::reader::Block;
use super::schema::{BlockSchema, EntrySchema, Group, Is};
use super::source::Place;
use super::tree::{Node, Value};
use super::value_kind::Kind;
use super::values::{wrong_length, wrong_type};
use super::written::{Extent, Written};

/// A block while it is read, written or described.
#[derive(Debug)]
pub struct Keys<'p> {
    pass: Pass<'p>,
}

#[derive(Debug)]
enum Pass<'p> {
    Read(Reading<'p>),
    Write { extent: Extent, block: Written },
    Describe(BlockSchema),
}

#[derive(Debug)]
struct Reading<'p> {
    block: Block<'p>,
    /// The preset whose values stand beneath those of the file.
    base: Option<Rc<str>>,
    /// Number of errors before this block.
    errors: usize,
    /// Whether unknown keys were already reported.
    is_judged: bool,
}

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

#[allow(
    clippy::needless_pass_by_value,
    reason = "a kind is made where it is used"
)]
impl<'p> Keys<'p> {
    /// Reads a block; whether it has no error. With a `base`, the values are those of a preset of that name, and no key
    /// is required.
    pub fn read(block: Block<'p>, base: Option<&str>, declare: impl FnOnce(&mut Keys<'_>)) -> bool {
        Self::read_within(block, base.map(Rc::from), declare)
    }

    fn read_within(
        block: Block<'p>,
        base: Option<Rc<str>>,
        declare: impl FnOnce(&mut Keys<'_>),
    ) -> bool {
        let errors = block.cx.error_count();
        let mut keys = Keys {
            pass: Pass::Read(Reading {
                block,
                base,
                errors,
                is_judged: false,
            }),
        };
        declare(&mut keys);
        let Pass::Read(reading) = keys.pass else {
            return false;
        };
        if !reading.is_judged {
            reading.block.finish();
        }
        reading.block.cx.error_count() == errors
    }

    /// Writes a block.
    pub fn write(extent: Extent, declare: impl FnOnce(&mut Keys<'_>)) -> Written {
        let block = Written::default();
        let mut keys = Keys {
            pass: Pass::Write { extent, block },
        };
        declare(&mut keys);
        match keys.pass {
            Pass::Write { block, .. } => block,
            Pass::Read(_) | Pass::Describe(_) => Written::default(),
        }
    }

    /// Describes a block whose values are defaults.
    pub fn describe(declare: impl FnOnce(&mut Keys<'_>)) -> BlockSchema {
        let mut keys = Keys {
            pass: Pass::Describe(BlockSchema::default()),
        };
        declare(&mut keys);
        match keys.pass {
            Pass::Describe(schema) => schema,
            Pass::Read(_) | Pass::Write { .. } => BlockSchema::default(),
        }
    }

    /// A key that may be left out: the value is then what it was.
    pub fn key<K: Kind>(
        &mut self,
        name: &'static str,
        value: &mut K::Of,
        kind: K,
        about: &'static str,
    ) {
        match &mut self.pass {
            Pass::Read(reading) => {
                if let Some(node) = reading.block.node(name)
                    && let Some(read) = kind.read_in(&reading.block, node, name)
                {
                    *value = read;
                }
            }
            Pass::Write { block, .. } => block.value(name, false, kind.write(value)),
            Pass::Describe(schema) => schema.add(EntrySchema {
                key: name.to_owned(),
                about,
                required: false,
                is: Is::Value {
                    of: kind.describe(),
                    default: Some(kind.write(value)),
                },
            }),
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
        match &mut self.pass {
            Pass::Read(reading) => {
                let block = &reading.block;
                let node = if reading.base.is_some() {
                    block.node(name)
                } else {
                    block.needed(name, || kind.describe().to_add(name))
                };
                if let Some(node) = node
                    && let Some(read) = kind.read_in(block, node, name)
                {
                    *value = read;
                }
            }
            Pass::Write { block, .. } => block.value(name, true, kind.write(value)),
            Pass::Describe(schema) => schema.add(EntrySchema {
                key: name.to_owned(),
                about,
                required: true,
                is: Is::Value {
                    of: kind.describe(),
                    default: None,
                },
            }),
        }
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
            Pass::Write { .. } => None,
        };
        self.required(name, value, kind, about);
        if let Pass::Read(reading) = &mut self.pass {
            reading.base = base;
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
        match &mut self.pass {
            Pass::Read(reading) => {
                if let Some(node) = reading.block.node(name) {
                    *value = kind.read_in(&reading.block, node, name).or(value.take());
                }
            }
            Pass::Write { block, .. } => {
                if let Some(value) = value {
                    block.value(name, false, kind.write(value));
                }
            }
            Pass::Describe(schema) => schema.add(EntrySchema {
                key: name.to_owned(),
                about,
                required: false,
                is: Is::Value {
                    of: kind.describe(),
                    default: None,
                },
            }),
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

    /// A block that must be there, unless a preset stands beneath; of one of the kinds, if there are any.
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
                let inner = match required {
                    Some(kinds) if reading.base.is_none() => reading.block.block(name, kinds),
                    Some(_) | None => reading.block.optional_block(name),
                };
                if let Some(inner) = inner {
                    Self::read_within(inner, reading.base.clone(), declare);
                }
            }
            Pass::Write { extent, block } => {
                let inner = Self::write(*extent, declare);
                let kept = required.is_some();
                if kept || !inner.is_empty() {
                    block.block(name, kept, inner);
                }
            }
            Pass::Describe(schema) => schema.add(EntrySchema {
                key: name.to_owned(),
                about,
                required: required.is_some(),
                is: Is::Block(Self::describe(declare)),
            }),
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
            Pass::Describe(schema) => schema.add(EntrySchema {
                key: name.to_owned(),
                about,
                required: false,
                is: Is::Block(Self::describe(|keys| declare(&mut new(), keys))),
            }),
        }
    }

    /// The block inside this one that says of which kind the value is: exactly one, and nothing else beside it but keys
    /// declared before. With a preset beneath, none leaves the kind as it is.
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
                    if let Some((preset, current)) = base {
                        inner.starts_anew(preset, current.name);
                    }
                    below = None;
                }
                Self::read_within(inner, below, |keys| (variant.declare)(value, keys));
            }
            Pass::Write { extent, block } => {
                if let Some(variant) = current {
                    let inner = fresh(*extent, value, &mut (variant.new)(), &variant.declare);
                    block.kind(variant.name, inner);
                }
            }
            Pass::Describe(schema) => {
                describe_variants(schema, variants);
                schema.groups.push(Group {
                    keys: variants.iter().map(|variant| variant.name).collect(),
                    required: true,
                });
            }
        }
    }

    /// As [`Keys::kind`], but beside other keys, and where none of the blocks is there the value stays what it was.
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
                let base = reading.base.clone().filter(|_| is_same);
                if let Some(inner) = reading.block.optional_block(variant.name) {
                    Self::read_within(inner, base, |keys| (variant.declare)(value, keys));
                }
            }
            Pass::Write { extent, block } => {
                if let Some(variant) = current {
                    let inner = fresh(*extent, value, &mut (variant.new)(), &variant.declare);
                    block.kind(variant.name, inner);
                }
            }
            Pass::Describe(schema) => describe_variants(schema, variants),
        }
    }

    /// Whichever of these keys is there, of which there must be exactly one; the caller then declares it. `current` is the one
    /// that the value has. A description gets them all, one after the other.
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
                block.exactly_one(names).into_iter().collect()
            }
            Pass::Write { .. } => current.into_iter().collect(),
            Pass::Describe(schema) => {
                schema.groups.push(Group {
                    keys: names.to_vec(),
                    required,
                });
                names.to_vec()
            }
        }
    }

    /// A list of tables; those of a file take the place of all that were there.
    pub fn blocks<T>(
        &mut self,
        name: &'static str,
        value: &mut Vec<T>,
        list: &BlockList<'_, T>,
        about: &'static str,
        declare: impl Fn(&mut T, &mut Keys<'_>),
    ) {
        match &mut self.pass {
            Pass::Read(reading) => {
                let block = &reading.block;
                let Some(node) = block.node(name) else {
                    return;
                };
                let Value::List(nodes) = &node.value else {
                    wrong_type(block.cx, node, name, list.wanted);
                    return;
                };
                if nodes.len() > list.most {
                    wrong_length(block.cx, &node.at, name, "a list", nodes.len(), list.wanted);
                    return;
                }
                value.clear();
                for (number, node) in nodes.iter().enumerate() {
                    let Some(table) = node.table() else {
                        wrong_type(block.cx, node, name, list.wanted);
                        continue;
                    };
                    let path = format!("{}[{number}]", block.path_of(name));
                    let inner = Block::new(block.cx, table, path, node.at.clone());
                    let mut read = (list.new)();
                    Self::read_within(inner, None, |keys| declare(&mut read, keys));
                    value.push(read);
                }
            }
            Pass::Write { extent, block } => {
                if !value.is_empty() {
                    let tables = value.iter_mut().map(|one| {
                        let own = fresh(*extent, one, &mut (list.new)(), &declare);
                        Node::unplaced(Value::Table(own.into_table()))
                    });
                    block.value(name, true, Value::List(tables.collect()));
                }
            }
            Pass::Describe(schema) => {
                let of = list.is_inside_itself.then_some(BlockSchema::default());
                let of =
                    of.unwrap_or_else(|| Self::describe(|keys| declare(&mut (list.new)(), keys)));
                schema.add(EntrySchema {
                    key: name.to_owned(),
                    about,
                    required: false,
                    is: Is::List {
                        of,
                        most: list.most,
                        again: list.is_inside_itself,
                    },
                });
            }
        }
    }

    /// A block of blocks with names of the user's choice. Those of a file come behind the preset's; one with a name that the
    /// preset has changes that one.
    pub fn named<T>(
        &mut self,
        name: &'static str,
        value: &mut Vec<T>,
        list: &NamedList<'_, T>,
        about: &'static str,
        declare: impl Fn(&mut T, &mut Keys<'_>),
    ) {
        match &mut self.pass {
            Pass::Read(reading) => {
                let block = &reading.block;
                let demanded = list.required && reading.base.is_none();
                if block.entry(name).is_none() && !demanded {
                    return;
                }
                let section = if demanded {
                    block.block(name, &[])
                } else {
                    block.optional_block(name)
                };
                let Some(section) = section else {
                    return;
                };
                for entry in &section.table.0 {
                    require_name(section.cx, &entry.key, &entry.key_at);
                    let Some(inner) = section.open(entry) else {
                        continue;
                    };
                    let known = value
                        .iter()
                        .position(|one| (list.name_of)(one) == entry.key);
                    let base = reading.base.clone().filter(|_| known.is_some());
                    let index = known.unwrap_or_else(|| {
                        value.push((list.new)(&entry.key));
                        value.len() - 1
                    });
                    Self::read_within(inner, base, |keys| declare(&mut value[index], keys));
                }
            }
            Pass::Write { extent, block } => {
                if !value.is_empty() {
                    let mut all = Written::default();
                    for one in value {
                        let name = (list.name_of)(one).to_owned();
                        let own = fresh(*extent, one, &mut (list.new)(&name), &declare);
                        all.block(&name, true, own);
                    }
                    block.block(name, true, all);
                }
            }
            Pass::Describe(schema) => schema.add(EntrySchema {
                key: name.to_owned(),
                about,
                required: list.required,
                is: Is::Named(Self::describe(|keys| {
                    declare(&mut (list.new)("NAME"), keys);
                })),
            }),
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

    /// Reports two keys that shut each other out, if both are there.
    pub fn exclude(&mut self, first: &'static str, second: &'static str) {
        if let Pass::Read(reading) = &self.pass {
            reading.block.exclude(first, second);
        }
    }

    /// Keys that are another reader's: known, and left alone.
    pub fn leave(&mut self, names: &[&'static str]) {
        if let Pass::Read(reading) = &self.pass {
            for name in names {
                reading.block.entry(name);
            }
        }
    }

    /// Whether the key stands in the file that is read; always so where a block is described.
    pub fn has(&self, name: &'static str) -> bool {
        match &self.pass {
            Pass::Read(reading) => reading.block.entry(name).is_some(),
            Pass::Write { .. } => false,
            Pass::Describe(_) => true,
        }
    }

    /// Whether the block that is read has no keys but these.
    pub fn has_only(&self, names: &[&str]) -> bool {
        let block = self.reader();
        block.is_some_and(|block| {
            let mut entries = block.table.0.iter();
            entries.all(|entry| names.contains(&entry.key.as_str()))
        })
    }

    /// Whether a file is read, as far as here without an error in this block: then what belongs together can be checked.
    pub fn is_sound(&self) -> bool {
        match &self.pass {
            Pass::Read(reading) => {
                reading.block.cx.error_count() == reading.errors
                    && !reading.block.lacks_something()
                    && reading.block.cx.survey.borrow().is_none()
            }
            Pass::Write { .. } | Pass::Describe(_) => false,
        }
    }

    /// Whether a block is described, so that every key is to be declared.
    pub fn is_description(&self) -> bool {
        matches!(self.pass, Pass::Describe(_))
    }

    /// The block of the file that is read, for what needs its places.
    pub fn reader(&self) -> Option<&Block<'p>> {
        match &self.pass {
            Pass::Read(reading) => Some(&reading.block),
            Pass::Write { .. } | Pass::Describe(_) => None,
        }
    }

    /// The preset that stands beneath, if a file is read and there is one.
    pub fn base(&self) -> Option<&str> {
        match &self.pass {
            Pass::Read(reading) => reading.base.as_deref(),
            Pass::Write { .. } | Pass::Describe(_) => None,
        }
    }

    /// From here on the values are those of a preset, and no key is required.
    pub fn set_base(&mut self, preset: &str) {
        if let Pass::Read(reading) = &mut self.pass {
            reading.base = Some(Rc::from(preset));
        }
    }

    /// Reports what is wrong with values that are allowed one by one, at the deepest part of the path that is there. A `*`
    /// stands for the only block, whatever its name.
    pub fn refuse(&self, path: &[&str], problem: String, help: &str) {
        let Pass::Read(reading) = &self.pass else {
            return;
        };
        let block = &reading.block;
        let error = DocumentError::Impossible {
            key: named_by(path).map_or_else(|| block.title(), str::to_owned),
            problem,
            help: help.to_owned(),
        };
        block.cx.error(&place_of(block, path), error);
    }

    /// Reports any error at the last key of a path, where it is there.
    pub fn report_at_key(&self, path: &[&str], error: DocumentError) {
        let Some((key, above)) = path.split_last() else {
            return;
        };
        let Some(block) = self.reader() else {
            return;
        };
        let mut table = Some(block.table);
        for key in above {
            table = table.and_then(|table| table.get(key)?.node.table());
        }
        let entry = table.and_then(|table| table.get(key));
        block
            .cx
            .error(entry.map_or(&block.at, |entry| &entry.key_at), error);
    }

    /// Reports any error at a path, as [`Keys::refuse`] does.
    pub fn report(&self, path: &[&str], error: DocumentError) {
        if let Pass::Read(reading) = &self.pass {
            reading
                .block
                .cx
                .error(&place_of(&reading.block, path), error);
        }
    }

    /// Whether a path is in the file that is read.
    pub fn has_path(&self, path: &[&str]) -> bool {
        self.reader()
            .is_some_and(|block| deepest(block, path).1 == path.len())
    }

    /// Warns of something that is allowed and hardly meant.
    pub fn warn(&self, code: &'static str, message: String, help: &str) {
        if let Pass::Read(Reading { block, .. }) = &self.pass
            && block.cx.survey.borrow().is_none()
        {
            block.cx.warn(&block.at, code, message, help);
        }
    }
}

/// The list that [`Keys::blocks`] reads.
pub struct BlockList<'w, T> {
    /// How many there are at most.
    pub most: usize,
    /// One with all defaults.
    pub new: &'w dyn Fn() -> T,
    /// What messages call the list.
    pub wanted: &'w str,
    /// Whether the list is part of a list of the same kind, whose description holds.
    pub is_inside_itself: bool,
}

/// The blocks that [`Keys::named`] reads.
pub struct NamedList<'n, T> {
    /// Whether there must be one at least, unless a preset stands beneath.
    pub required: bool,
    /// One with all defaults under a name.
    pub new: &'n dyn Fn(&str) -> T,
    /// The name of one.
    pub name_of: fn(&T) -> &str,
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

fn describe_variants<T>(schema: &mut BlockSchema, variants: &[Variant<T>]) {
    for variant in variants {
        schema.add(EntrySchema {
            key: variant.name.to_owned(),
            about: variant.about,
            required: false,
            is: Is::Block(Keys::describe(|keys| {
                (variant.declare)(&mut (variant.new)(), keys);
            })),
        });
    }
}

/// The key that a message names: the last that is no place in a list.
fn named_by<'k>(path: &[&'k str]) -> Option<&'k str> {
    let is_name = |key: &&&str| key.parse::<usize>().is_err();
    path.iter().rev().find(is_name).copied()
}

/// Where the deepest part of a path stands that is there.
fn place_of(block: &Block<'_>, path: &[&str]) -> Place {
    deepest(block, path).0.clone()
}

/// The place of the deepest part of a path that is there, and how many steps it is down.
fn deepest<'b>(block: &'b Block<'_>, path: &[&str]) -> (&'b Place, usize) {
    let mut at = &block.at;
    let mut table = Some(block.table);
    let mut list: Option<&[Node]> = None;
    for (depth, key) in path.iter().enumerate() {
        let node = match (table, list, *key) {
            (Some(table), _, "*") => {
                let mut nodes = table.0.iter().map(|entry| &entry.node);
                nodes.find(|node| node.table().is_some())
            }
            (Some(table), _, key) => table.get(key).map(|entry| &entry.node),
            (None, Some(list), key) => key.parse().ok().and_then(|index: usize| list.get(index)),
            (None, None, _) => None,
        };
        let Some(node) = node else {
            return (at, depth);
        };
        at = &node.at;
        table = node.table();
        list = match &node.value {
            Value::List(nodes) => Some(nodes),
            Value::Text(_)
            | Value::Integer(_)
            | Value::Number(_)
            | Value::Flag(_)
            | Value::Other(..)
            | Value::Table(_) => None,
        };
    }
    (at, path.len())
}
