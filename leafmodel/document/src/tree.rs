//! The file as a tree of values, each with its place, in the order in which they are written.

use toml::Spanned;
use toml::de::{DeInteger, DeTable, DeValue};

use super::source::Place;

/// A value and its place. A table's place is its header, or the key that opens it.
#[derive(Clone, Debug)]
pub struct Node {
    /// Where it stands.
    pub at: Place,
    /// What it is.
    pub value: Value,
}

/// A value of any type that TOML has.
#[derive(Clone, Debug)]
pub enum Value {
    /// Text in quotes.
    Text(String),
    /// A number without a point.
    Integer(i128),
    /// A number with a point or an exponent.
    Number(f64),
    /// True or false.
    Flag(bool),
    /// A date or time, or an integer with more than 128 bits: no key takes one.
    Other(&'static str, String),
    /// A list in brackets.
    List(Vec<Node>),
    /// A table, or a block.
    Table(Table),
}

/// Keys and values in the order in which they are written.
#[derive(Clone, Debug, Default)]
pub struct Table(pub Vec<Entry>);

/// A key with its value.
#[derive(Clone, Debug)]
pub struct Entry {
    /// The key.
    pub key: String,
    /// Where the key stands.
    pub key_at: Place,
    /// Its value.
    pub node: Node,
}

impl Value {
    /// Whether both are the same, wherever they stand. A whole number is the same with and without
    /// a point.
    pub fn is_same(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Text(a), Self::Text(b)) | (Self::Other(_, a), Self::Other(_, b)) => a == b,
            (Self::Integer(a), Self::Integer(b)) => a == b,
            (Self::Number(a), Self::Number(b)) => a.to_bits() == b.to_bits(),
            (Self::Integer(whole), Self::Number(number))
            | (Self::Number(number), Self::Integer(whole)) => *whole as f64 == *number,
            (Self::Flag(a), Self::Flag(b)) => a == b,
            (Self::List(a), Self::List(b)) => {
                a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.value.is_same(&b.value))
            }
            (Self::Table(a), Self::Table(b)) => {
                let same = |(a, b): (&Entry, &Entry)| {
                    a.key == b.key && a.node.value.is_same(&b.node.value)
                };
                a.0.len() == b.0.len() && a.0.iter().zip(&b.0).all(same)
            }
            (
                Self::Text(_)
                | Self::Integer(_)
                | Self::Number(_)
                | Self::Flag(_)
                | Self::Other(..)
                | Self::List(_)
                | Self::Table(_),
                _,
            ) => false,
        }
    }

    /// What reports call the value.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Text(_) => "text",
            Self::Integer(_) => "an integer",
            Self::Number(_) => "a number",
            Self::Flag(_) => "true or false",
            Self::Other(kind, _) => kind,
            Self::List(_) => "a list",
            Self::Table(_) => "a table",
        }
    }
}

impl Table {
    /// A table that stands nowhere in a file yet.
    pub fn of<K: Into<String>>(entries: impl IntoIterator<Item = (K, Value)>) -> Self {
        let entries = entries.into_iter().map(|(key, value)| {
            let node = Node::unplaced(value);
            Entry {
                key: key.into(),
                key_at: node.at.clone(),
                node,
            }
        });
        Self(entries.collect())
    }

    /// The tree of a parsed document.
    pub(crate) fn from_toml(source: usize, table: DeTable<'_>) -> Self {
        let mut entries: Vec<Entry> = table
            .into_iter()
            .map(|(key, value)| {
                let key_at = Place {
                    source,
                    span: key.span(),
                };
                let node = Node::from_toml(source, &key_at, value);
                Entry {
                    key: key.into_inner().into_owned(),
                    key_at,
                    node,
                }
            })
            .collect();
        // The parser hands tables out by name.
        entries.sort_by_key(|entry| entry.key_at.span.start);
        Self(entries)
    }

    /// The entry of that name.
    pub fn get(&self, key: &str) -> Option<&Entry> {
        self.0.iter().find(|entry| entry.key == key)
    }

    /// Puts a value at a path of keys, opening the tables on the way.
    ///
    /// # Errors
    ///
    /// The key on the way that is no table, with its place in the path.
    pub fn set(&mut self, path: &[(String, Place)], node: Node) -> Result<(), Place> {
        let Some(((key, key_at), rest)) = path.split_first() else {
            return Ok(());
        };
        let index = self.0.iter().position(|entry| entry.key == *key);
        let index = index.unwrap_or_else(|| {
            self.0.push(Entry {
                key: key.clone(),
                key_at: key_at.clone(),
                node: Node {
                    at: key_at.clone(),
                    value: Value::Table(Self::default()),
                },
            });
            self.0.len() - 1
        });
        let entry = &mut self.0[index];
        if rest.is_empty() {
            entry.key_at = key_at.clone();
            entry.node = node;
            return Ok(());
        }
        if let Value::Table(table) = &mut entry.node.value {
            table.set(rest, node)
        } else {
            Err(key_at.clone())
        }
    }

    /// Puts an entry in the place of what is there under its key, tables within `depth` key by key.
    pub fn put(&mut self, entry: Entry, depth: usize) {
        let Some(place) = self.0.iter_mut().find(|there| there.key == entry.key) else {
            self.0.push(entry);
            return;
        };
        match (&mut place.node.value, entry.node.value) {
            (Value::Table(there), Value::Table(own)) if depth > 1 => {
                for entry in own.0 {
                    there.put(entry, depth - 1);
                }
            }
            (_, value) => {
                place.key_at = entry.key_at;
                place.node.at = entry.node.at;
                place.node.value = value;
            }
        }
    }

    /// Removes what is at a path of keys with dots between them; whether anything was.
    pub fn remove(&mut self, path: &str) -> bool {
        let (key, rest) = path.split_once('.').unwrap_or((path, ""));
        let Some(index) = self.0.iter().position(|entry| entry.key == key) else {
            return false;
        };
        if rest.is_empty() {
            self.0.remove(index);
            return true;
        }
        match &mut self.0[index].node.value {
            Value::Table(inner) => inner.remove(rest),
            Value::Text(_)
            | Value::Integer(_)
            | Value::Number(_)
            | Value::Flag(_)
            | Value::Other(..)
            | Value::List(_) => false,
        }
    }
}

impl Node {
    /// A value that stands nowhere in a file yet.
    pub(crate) fn unplaced(value: Value) -> Self {
        let at = Place {
            source: 0,
            span: 0..0,
        };
        Self { at, value }
    }

    /// The table that the node is, if it is one.
    pub fn table(&self) -> Option<&Table> {
        if let Value::Table(table) = &self.value {
            Some(table)
        } else {
            None
        }
    }

    fn from_toml(source: usize, key_at: &Place, value: Spanned<DeValue<'_>>) -> Self {
        let at = Place {
            source,
            span: value.span(),
        };
        let (at, value) = match value.into_inner() {
            DeValue::String(text) => (at, Value::Text(text.into_owned())),
            DeValue::Integer(integer) => (at, integer_value(&integer)),
            // Underscores are gone; what is too great becomes infinite and is refused as such.
            DeValue::Float(float) => (
                at,
                Value::Number(float.as_str().parse().unwrap_or(f64::NAN)),
            ),
            DeValue::Boolean(flag) => (at, Value::Flag(flag)),
            DeValue::Datetime(time) => (at, Value::Other("a date or time", time.to_string())),
            DeValue::Array(list) => {
                let nodes = list
                    .into_iter()
                    .map(|node| Self::from_toml(source, key_at, node))
                    .collect();
                (at, Value::List(nodes))
            }
            DeValue::Table(table) => {
                // A table that was opened in passing (`[a.b]` opens `a`) has the place of its key.
                let at = if at.span.is_empty() {
                    key_at.clone()
                } else {
                    at
                };
                (at, Value::Table(Table::from_toml(source, table)))
            }
        };
        Self { at, value }
    }
}

fn integer_value(integer: &DeInteger<'_>) -> Value {
    match i128::from_str_radix(integer.as_str(), integer.radix()) {
        Ok(value) => Value::Integer(value),
        Err(_) => Value::Other("an integer beyond all bounds", integer.to_string()),
    }
}
