//! Names of blocks, and what refers to them.

use super::context::{Context, ENOUGH, QUOTED};
use super::error::DocumentError;
use super::nearest::nearest;
use super::reader::Block;
use super::schema::Type;
use super::sections::{Names, singular};
use super::source::{Place, escaped};
use super::tree::{Node, Value};
use super::value_kind::Kind;
use super::values::{listed, text_at};

/// Longest name of a block or scene, in characters.
pub(super) const LONGEST: usize = 100;
/// Longest name of a scene, in bytes: systems allow 255 for a file with its ending.
pub const LONGEST_FILE: usize = 200;

/// A block with the name it has in the file.
#[derive(Clone, Debug)]
pub struct Named<T> {
    /// Name in the file.
    pub name: String,
    /// The block.
    pub value: T,
}

impl Names {
    /// The names in a section of the file, whose other sections are given too.
    pub fn of(root: &Block<'_>, section: &'static str, sections: &[&str]) -> Self {
        let entries = root.entry(section).and_then(|entry| entry.node.table());
        let names = entries.into_iter().flat_map(|table| &table.0);
        let mut found = Self::of_list(singular(section), names.map(|entry| entry.key.as_str()));
        found.hidden = entries.is_none()
            && root
                .first_entries()
                .any(|entry| nearest(&entry.key, sections.iter().copied()) == Some(section));
        found
    }

    /// The index of the block that a piece of text names.
    pub fn find(&self, cx: &Context, (name, at): (&str, &Place)) -> Option<usize> {
        let index = self.index_of(name);
        if index.is_none() && !self.hidden && !cx.is_full() {
            let names = || self.in_order.iter().map(String::as_str);
            let error = DocumentError::UnknownName {
                kind: self.kind,
                name: escaped(name, QUOTED),
                nearest: nearest(name, names().take(ENOUGH)).map(|name| escaped(name, QUOTED)),
                known: listed(names()),
            };
            cx.error(at, error);
        }
        index
    }
}

/// The name of a block of a section, as its index there; what messages call it.
#[derive(Clone, Copy, Debug)]
pub struct NameIn(pub &'static str, pub &'static str);

impl Kind for NameIn {
    type Of = usize;

    fn read(&self, cx: &Context, node: &Node, key: &str) -> Option<usize> {
        let name = text_at(cx, node, key)?;
        cx.names(self.0)?.find(cx, name)
    }

    fn write(&self, value: &usize) -> Value {
        Value::Integer(*value as i128)
    }

    fn describe(&self) -> Type {
        Type::Text(self.1)
    }
}

/// As [`NameIn`], or a word for all blocks, which is read as `None`.
#[derive(Clone, Copy, Debug)]
pub struct NameOrAll(pub NameIn, pub &'static str);

impl Kind for NameOrAll {
    type Of = Option<usize>;

    fn read(&self, cx: &Context, node: &Node, key: &str) -> Option<Option<usize>> {
        if text_at(cx, node, key)?.0 == self.1 {
            return Some(None);
        }
        self.0.read(cx, node, key).map(Some)
    }

    fn write(&self, value: &Option<usize>) -> Value {
        match value {
            Some(number) => self.0.write(number),
            None => Value::Text(self.1.to_owned()),
        }
    }

    fn describe(&self) -> Type {
        self.0.describe()
    }
}

/// Whether a name can be part of a file name and an identifier in other programs.
pub fn is_name(name: &str) -> bool {
    let allowed = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'_' || byte == b'-';
    (1..=LONGEST).contains(&name.len()) && name.bytes().all(allowed)
}

/// Whether a letter may be part of the name of a scene, which is that of files: letters and digits of
/// every script, their combining marks, `_` and `-`.
pub fn may_be_in_a_title(letter: char) -> bool {
    let is_mark = ('\u{300}'..='\u{36f}').contains(&letter);
    letter.is_alphanumeric() || is_mark || matches!(letter, '_' | '-')
}

/// Whether a name can be that of a scene and of its files.
pub fn is_title(name: &str) -> bool {
    let is_short = name.len() <= LONGEST_FILE && name.chars().count() <= LONGEST;
    !name.is_empty() && is_short && name.chars().all(may_be_in_a_title)
}

/// Reports a name of a scene that is none.
pub fn require_title(cx: &Context, name: &str, at: &Place) {
    if !is_title(name) {
        let error = DocumentError::BadName {
            name: escaped(name, QUOTED),
            allowed: "letters and digits of any script, `_` and `-`",
        };
        cx.error(at, error);
    }
}

/// Reports a name that is none.
pub(crate) fn require_name(cx: &Context, name: &str, at: &Place) {
    if !is_name(name) {
        let error = DocumentError::BadName {
            name: escaped(name, QUOTED),
            allowed: "the letters A-Z and a-z, digits, `_` and `-`",
        };
        cx.error(at, error);
    }
}
