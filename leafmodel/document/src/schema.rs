//! What blocks may hold, as data: for editors (JSON Schema) and for the book (tables).

pub mod json;
pub mod tables;

use super::limits::Limits;
use super::tree::{Node, Value};
use super::write::value_to_toml;

/// The keys of a block, in the order in which they are declared.
#[derive(Clone, Debug, Default)]
pub struct BlockSchema {
    /// The keys.
    pub entries: Vec<EntrySchema>,
    /// Keys that go together.
    pub groups: Vec<Group>,
}

/// A key.
#[derive(Clone, Debug)]
pub struct EntrySchema {
    /// Its name.
    pub key: String,
    /// What it means: a sentence.
    pub about: &'static str,
    /// Whether it must be there.
    pub required: bool,
    /// What its value is.
    pub is: Is,
}

/// What the value of a key is.
#[derive(Clone, Debug)]
pub enum Is {
    /// A value.
    Value {
        /// Its type and range.
        of: Type,
        /// What it is where it is left out.
        default: Option<Value>,
    },
    /// A block.
    Block(BlockSchema),
    /// Blocks with names of the user's choice.
    Named(BlockSchema),
    /// A list of blocks.
    List {
        /// One of them.
        of: BlockSchema,
        /// How many there are at most.
        most: usize,
        /// Whether the keys are those of the enclosing list, which are described there.
        again: bool,
    },
}

/// Keys of which exactly one is there, or at most one.
#[derive(Clone, Debug)]
pub struct Group {
    /// The keys.
    pub keys: Vec<&'static str>,
    /// Whether one must be there.
    pub required: bool,
}

/// The type of a value, and its range.
#[derive(Clone, Debug)]
pub enum Type {
    /// A real number.
    Number(Limits),
    /// An integer, both ends included.
    Integer {
        /// The least.
        least: u64,
        /// The greatest.
        most: u64,
    },
    /// True or false.
    Flag,
    /// Text; holds what it is.
    Text(&'static str),
    /// One of these words.
    Word(Vec<String>),
    /// The name of one of these, and what they are.
    Name(Vec<String>, &'static str),
    /// A list of exactly these.
    Tuple(Vec<Type>),
    /// A list of one type.
    List {
        /// The type of each.
        of: Box<Type>,
        /// How many there are at least.
        least: usize,
        /// How many there are at most.
        most: usize,
        /// What messages call it.
        wanted: &'static str,
    },
    /// A table of values under names of the user's choice.
    Map(Box<Type>),
    /// A table with keys.
    Table(BlockSchema),
    /// One of several types; in words, what messages call it.
    AnyOf(Vec<Type>, &'static str),
}

impl BlockSchema {
    /// Adds a key that is not there yet. One of several of which one must be there is not required
    /// itself.
    pub fn add(&mut self, mut entry: EntrySchema) {
        if self.get(&entry.key).is_none() {
            let grouped = self.groups.iter().flat_map(|group| &group.keys);
            entry.required &= !grouped.into_iter().any(|key| *key == entry.key);
            self.entries.push(entry);
        }
    }

    /// Adds a key as [`BlockSchema::add`] does.
    pub(super) fn entry(&mut self, key: &str, about: &'static str, required: bool, is: Is) {
        self.add(EntrySchema {
            key: key.to_owned(),
            about,
            required,
            is,
        });
    }

    /// The key of that name.
    pub fn get(&self, key: &str) -> Option<&EntrySchema> {
        self.entries.iter().find(|entry| entry.key == key)
    }

    /// The key at a path, in which any name may stand where the user chooses them.
    pub fn key_at(&self, path: &[&str]) -> Option<&EntrySchema> {
        let (key, rest) = path.split_first()?;
        let entry = self.get(key)?;
        match (&entry.is, rest) {
            (_, []) => Some(entry),
            (Is::Block(inner), rest) | (Is::Named(inner), [_, rest @ ..]) => inner.key_at(rest),
            (Is::List { .. } | Is::Value { .. }, _) => None,
        }
    }

    /// What the block at a path is, `NAME` for a name of the user's choice.
    pub fn at(&self, path: &[&str]) -> Option<&Self> {
        let Some((key, rest)) = path.split_first() else {
            return Some(self);
        };
        match (&self.get(key)?.is, rest) {
            (Is::Block(inner) | Is::List { of: inner, .. }, rest)
            | (Is::Named(inner), ["NAME", rest @ ..]) => inner.at(rest),
            (Is::Named(_) | Is::Value { .. }, _) => None,
        }
    }
}

impl Type {
    /// What to add where a key of this type is missing.
    pub(crate) fn to_add(&self, key: &str) -> String {
        match self {
            Self::Text(what) => format!("`{key} = \"…\"`, {what}"),
            Self::AnyOf(types, what) if matches!(types.first(), Some(Self::Text(_))) => {
                format!("`{key} = \"…\"`, {what}")
            }
            Self::Integer { least, most } if least == most => format!("`{key} = {least}`"),
            Self::Word(_) | Self::Name(..) => format!("`{key} = \"…\"`, {}", self.in_words()),
            Self::Tuple(_) | Self::List { .. } => format!("`{key} = […]`, {}", self.in_words()),
            Self::Number(_)
            | Self::Integer { .. }
            | Self::Flag
            | Self::Map(_)
            | Self::Table(_)
            | Self::AnyOf(..) => format!("`{key} = …`, {}", self.in_words()),
        }
    }

    /// The range as a table shows it.
    pub(crate) fn in_brief(&self) -> String {
        match self {
            Self::Number(limits) => limits.to_string(),
            Self::Integer { least, most } if *most == u64::MAX => format!("{least} to 2⁶⁴ − 1"),
            Self::Integer { least, most } => format!("{least} to {most}"),
            Self::Tuple(types) => match types.as_slice() {
                [Self::Number(first), rest @ ..]
                    if rest
                        .iter()
                        .all(|one| matches!(one, Self::Number(other) if other == first)) =>
                {
                    format!("{} numbers, {first}", types.len())
                }
                _ => self.in_words(),
            },
            Self::Name(_, kind) => format!("a {kind}'s name"),
            Self::Flag
            | Self::Text(_)
            | Self::Word(_)
            | Self::List { .. }
            | Self::Map(_)
            | Self::Table(_)
            | Self::AnyOf(..) => self.in_words(),
        }
    }

    /// The type and range as a sentence names them.
    pub(crate) fn in_words(&self) -> String {
        match self {
            Self::Number(limits) => format!("a number within {limits}"),
            Self::Integer { least, most } if least == most => least.to_string(),
            Self::Integer { least, most } => format!("an integer from {least} to {most}"),
            Self::Flag => "true or false".to_owned(),
            Self::Text(what) => (*what).to_owned(),
            Self::Word(words) => {
                let words: Vec<String> = words.iter().map(|word| format!("`{word}`")).collect();
                format!("one of {}", words.join(", "))
            }
            Self::Name(_, kind) => format!("the name of a {kind}"),
            Self::Tuple(types) => format!("a list of {} numbers", types.len()),
            Self::List { wanted, .. } | Self::AnyOf(_, wanted) => (*wanted).to_owned(),
            Self::Map(of) => format!("a table of names, each with {}", of.in_words()),
            Self::Table(_) => "a table".to_owned(),
        }
    }
}

/// The unit that the ending of a key tells.
pub fn unit_of(key: &str) -> Option<&'static str> {
    const UNITS: [(&str, &str); 25] = [
        ("_w_m2_sr_nm", "W m⁻² sr⁻¹ nm⁻¹"),
        ("_w_sr_nm", "W sr⁻¹ nm⁻¹"),
        ("_w_m2_nm", "W m⁻² nm⁻¹"),
        ("_umol_m2_s", "µmol m⁻² s⁻¹"),
        ("_w_m2", "W m⁻²"),
        ("_sr", "sr"),
        ("_ug_per_cm2", "µg cm⁻²"),
        ("_g_per_cm2", "g cm⁻²"),
        ("_per_segment2", "per segment²"),
        ("_per_mm", "mm⁻¹"),
        ("_per_cm", "cm⁻¹"),
        ("_per_m", "m⁻¹"),
        ("_segments", "segments"),
        ("_days", "days"),
        ("_day", "days"),
        ("_deg", "°"),
        ("_hpa", "hPa"),
        ("_mm", "mm"),
        ("_cm", "cm"),
        ("_nm", "nm"),
        ("_px", "pixels"),
        ("_ev", "EV"),
        ("_k", "K"),
        ("day", "days"),
        ("_m", "m"),
    ];
    let found = UNITS.iter().find(|(ending, _)| key.ends_with(ending));
    found.map(|(_, unit)| *unit)
}

/// A default as it would stand in a file.
pub fn default_in_words(value: &Value) -> String {
    value_to_toml(&Node::unplaced(value.clone()))
}
