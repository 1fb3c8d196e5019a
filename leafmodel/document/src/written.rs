//! Blocks on their way into a file, and what of them need not stand there.

use super::source::Place;
use super::tree::{Entry, Node, Table, Value};

/// How much of a block is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// What is required, and what differs from its default.
    Changed,
    /// Every key that has a value.
    All,
}

/// A block that is being written.
#[derive(Clone, Debug, Default)]
pub struct Written {
    entries: Vec<WrittenEntry>,
    /// The kind that the block is of, if it is one of several: the key of the block that says so.
    kind: Option<&'static str>,
}

#[derive(Clone, Debug)]
struct WrittenEntry {
    key: String,
    /// Whether it stands in a file even with its default.
    required: bool,
    item: Item,
}

#[derive(Clone, Debug)]
enum Item {
    Value(Value),
    Block(Written),
}

impl Written {
    /// Adds a value.
    pub fn value(&mut self, key: &str, required: bool, value: Value) {
        self.push(key, required, Item::Value(value));
    }

    /// Adds a block.
    pub fn block(&mut self, key: &str, required: bool, block: Self) {
        self.push(key, required, Item::Block(block));
    }

    /// Adds all that another block has.
    pub fn extend(&mut self, other: Self) {
        self.kind = self.kind.or(other.kind);
        self.entries.extend(other.entries);
    }

    /// Adds the block that says of which kind this one is.
    pub fn kind(&mut self, name: &'static str, block: Self) {
        self.kind = Some(name);
        self.block(name, true, block);
    }

    /// Whether there is nothing in it.
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    fn push(&mut self, key: &str, required: bool, item: Item) {
        self.entries.push(WrittenEntry {
            key: key.to_owned(),
            required,
            item,
        });
    }

    fn get(&self, key: &str) -> Option<&Item> {
        let found = self.entries.iter().find(|entry| entry.key == key);
        found.map(|entry| &entry.item)
    }

    /// Removes what equals the `defaults`; required keys stay.
    pub fn without_defaults(self, defaults: &Self) -> Self {
        self.without(defaults, true)
    }

    /// The keys that make this block when they stand beside the name of a preset; `None` if there
    /// are none, because the preset has something that this block lacks.
    pub fn beside_preset(self, preset: &Self) -> Option<Self> {
        self.has_all_of(preset).then(|| self.without(preset, false))
    }

    fn without(self, usual: &Self, keep_required: bool) -> Self {
        let mut rest = Self {
            entries: Vec::new(),
            kind: self.kind,
        };
        for entry in self.entries {
            let kept = entry.required && keep_required;
            let item = match (entry.item, usual.get(&entry.key)) {
                (Item::Value(own), Some(Item::Value(other))) if own.is_same(other) && !kept => {
                    continue;
                }
                (Item::Block(own), Some(Item::Block(other))) => {
                    let own = own.without(other, keep_required);
                    if own.entries.is_empty() && !kept {
                        continue;
                    }
                    Item::Block(own)
                }
                (item, _) => item,
            };
            rest.push(&entry.key, entry.required, item);
        }
        rest
    }

    fn has_all_of(&self, preset: &Self) -> bool {
        preset.entries.iter().all(|entry| {
            let own = self.get(&entry.key);
            match (&entry.item, own) {
                (Item::Block(other), Some(Item::Block(own))) => own.has_all_of(other),
                (Item::Block(_) | Item::Value(_), Some(_)) => true,
                // The other kind takes the place of the preset's.
                (_, None) => preset.kind == Some(entry.key.as_str()) && self.kind != preset.kind,
            }
        })
    }

    /// The block as the table that is written out.
    pub fn into_table(self) -> Table {
        let entries = self.entries.into_iter().map(|entry| {
            let value = match entry.item {
                Item::Value(value) => value,
                Item::Block(block) => Value::Table(block.into_table()),
            };
            let key_at = Place {
                source: 0,
                span: 0..0,
            };
            Entry {
                key: entry.key,
                key_at,
                node: Node::unplaced(value),
            }
        });
        Table(entries.collect())
    }
}
