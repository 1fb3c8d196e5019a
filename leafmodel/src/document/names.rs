//! Names of blocks, and what refers to them.

use std::collections::BTreeMap;

use super::context::{Context, ENOUGH, QUOTED};
use super::error::DocumentError;
use super::nearest::nearest;
use super::reader::Block;
use super::schema::Type;
use super::source::{Place, escaped};
use super::tree::{Node, Value};
use super::value_kind::Kind;
use super::values::{listed, text_at};

/// Longest name of a block or scene, in characters.
const LONGEST: usize = 100;

/// A block with the name it has in the file.
#[derive(Clone, Debug)]
pub struct Named<T> {
    /// Name in the file.
    pub name: String,
    /// The block.
    pub value: T,
}

/// The names of one section, in the file's order; a block's index is its place here.
#[derive(Debug)]
pub struct Names {
    kind: &'static str,
    in_order: Vec<String>,
    index: BTreeMap<String, usize>,
    /// Whether the section may stand in the file under a misspelt name.
    hidden: bool,
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

    /// Names that are no section.
    pub fn of_list<'n>(kind: &'static str, names: impl IntoIterator<Item = &'n str>) -> Self {
        let in_order: Vec<String> = names.into_iter().map(str::to_owned).collect();
        let numbered = in_order.iter().enumerate();
        Self {
            kind,
            index: numbered
                .map(|(index, name)| (name.clone(), index))
                .collect(),
            in_order,
            hidden: false,
        }
    }

    /// The index of a name, if there is one.
    pub fn index_of(&self, name: &str) -> Option<usize> {
        self.index.get(name).copied()
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

    /// Whether the section has no block, and is not just misspelt.
    pub fn are_missing(&self) -> bool {
        self.in_order.is_empty() && !self.hidden
    }

    /// The name at an index.
    pub fn name(&self, index: usize) -> &str {
        self.in_order.get(index).map_or("", String::as_str)
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

/// What one block of a section is called.
pub fn singular(section: &str) -> &'static str {
    match section {
        "leaves" => "leaf",
        "meshes" => "mesh",
        "materials" => "material",
        "objects" => "object",
        "lights" => "light",
        "solids" => "solid",
        _ => "block",
    }
}

/// Whether a name can be part of a file name and an identifier in other programs.
pub fn is_name(name: &str) -> bool {
    let allowed = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'_' || byte == b'-';
    (1..=LONGEST).contains(&name.len()) && name.bytes().all(allowed)
}

/// Reports a name that is none.
pub fn require_name(cx: &Context, name: &str, at: &Place) {
    if !is_name(name) {
        let error = DocumentError::BadName {
            name: escaped(name, QUOTED),
        };
        cx.error(at, error);
    }
}
