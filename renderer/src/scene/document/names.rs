//! Names of blocks, and what refers to them.

use std::collections::BTreeMap;

use super::context::{Context, ENOUGH, QUOTED};
use super::reader::Block;
use super::values::listed;
use crate::scene::error::SceneError;
use crate::scene::nearest::nearest;
use crate::scene::source::{Place, escaped};

/// Longest name of a block or scene, in characters.
const LONGEST: usize = 100;

/// The names of one section, in the file's order; a block's index is its place here.
#[derive(Debug)]
pub(crate) struct Names<'a> {
    kind: &'static str,
    in_order: Vec<&'a str>,
    index: BTreeMap<&'a str, usize>,
    /// Whether the section may stand in the file under a misspelt name.
    hidden: bool,
}

impl<'a> Names<'a> {
    /// The names in a section of the file.
    pub(crate) fn of(root: &Block<'a>, section: &'static str, kind: &'static str) -> Self {
        let found = root.optional_block(section);
        let entries = found.iter().flat_map(|block| block.table.0.iter());
        let in_order: Vec<&str> = entries.map(|entry| entry.key.as_str()).collect();
        let hidden = found.is_none()
            && root
                .first_entries()
                .any(|entry| nearest(&entry.key, SECTIONS) == Some(section));
        Self {
            kind,
            index: in_order
                .iter()
                .enumerate()
                .map(|(index, name)| (*name, index))
                .collect(),
            in_order,
            hidden,
        }
    }

    /// The index of the block that a piece of text names.
    pub(crate) fn find(&self, cx: &Context, (name, at): (&str, &Place)) -> Option<usize> {
        let index = self.index.get(name).copied();
        if index.is_none() && !self.hidden && !cx.is_full() {
            let error = SceneError::UnknownName {
                kind: self.kind,
                name: escaped(name, QUOTED),
                nearest: nearest(name, self.in_order.iter().take(ENOUGH).copied())
                    .map(|name| escaped(name, QUOTED)),
                known: listed(self.in_order.iter().copied()),
            };
            cx.error(at, error);
        }
        index
    }

    /// Whether the section has no block, and is not just misspelt.
    pub(crate) fn are_missing(&self) -> bool {
        self.in_order.is_empty() && !self.hidden
    }

    /// The name at an index.
    pub(crate) fn name(&self, index: usize) -> &'a str {
        self.in_order.get(index).copied().unwrap_or("")
    }
}

/// All keys at the top of a scene file.
pub(crate) const SECTIONS: [&str; 13] = [
    "format",
    "name",
    "extrapolate",
    "film",
    "picture",
    "camera",
    "integrator",
    "materials",
    "meshes",
    "leaves",
    "solids",
    "lights",
    "objects",
];

/// Whether a name can be part of a file name and an identifier in other programs.
pub(crate) fn is_name(name: &str) -> bool {
    let allowed = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'_' || byte == b'-';
    (1..=LONGEST).contains(&name.len()) && name.bytes().all(allowed)
}

/// Reports a name that is none.
pub(crate) fn require_name(cx: &Context, name: &str, at: &Place) {
    if !is_name(name) {
        let error = SceneError::BadName {
            name: escaped(name, QUOTED),
        };
        cx.error(at, error);
    }
}
