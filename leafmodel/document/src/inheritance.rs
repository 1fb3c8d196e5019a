//! Blocks that start from another block of their section.
//!
//! - **In**: the tree of a file, in which a block may have `base = "NAME"` and `without = ["PATH"]`.
//! - **Out**: the tree with the keys of the base in place of what a block leaves out. Values keep their
//!   places, so that an error of an inherited value points at the base.
//! - **Always true**: no block starts from itself, directly or over others.

use crate::context::QUOTED;
use crate::error::{DocumentError, LocatedError};
use crate::keys::Keys;
use crate::nearest::nearest;
use crate::sections::singular;
use crate::source::escaped;
use crate::tree::{Entry, Node, Table, Value};
use crate::value_kind::{ListOf, Text};
use crate::values::listed;

/// Sections whose blocks may have a base.
pub(crate) const SECTIONS: [&str; 1] = ["leaves"];

/// The key that names the base.
const BASE: &str = "base";
/// The key with what the base has and the block lacks.
const WITHOUT: &str = "without";

/// Declares both keys for schemas; they are read before all others.
pub(crate) fn describe(keys: &mut Keys<'_>) {
    const PATHS: ListOf<Text> = ListOf {
        of: Text("a path of keys"),
        least: 0,
        most: 100,
        wanted: "a list of paths",
    };
    let about = "The other block of this section whose keys hold where this one says nothing else.";
    keys.optional(BASE, &mut None, Text("the name of a block"), about);
    let about = "What the base has and this block lacks, such as `venation.closed`.";
    keys.key(WITHOUT, &mut Vec::new(), PATHS, about);
}

/// Puts inherited keys into all sections of a file whose blocks may have a base; returns what is wrong with
/// `base` and `without`.
pub(crate) fn inherit(file: &mut Table) -> Vec<LocatedError> {
    let mut errors = Vec::new();
    for section in &mut file.0 {
        let may_inherit = SECTIONS.contains(&section.key.as_str());
        if let (true, Value::Table(blocks)) = (may_inherit, &mut section.node.value) {
            let mut steps = Steps {
                section: &section.key,
                open: Vec::new(),
                errors: &mut errors,
            };
            for index in 0..blocks.0.len() {
                steps.complete(blocks, index);
            }
        }
    }
    errors
}

/// Blocks of a section that wait for their bases.
struct Steps<'a> {
    section: &'a str,
    open: Vec<usize>,
    errors: &'a mut Vec<LocatedError>,
}

impl Steps<'_> {
    /// Gives the block at `index` what its base has, whose own base comes first.
    fn complete(&mut self, blocks: &mut Table, index: usize) {
        let Some(own) = table_of(&mut blocks.0[index]) else {
            return;
        };
        let base = take(own, BASE);
        let without = take(own, WITHOUT);
        let Some(base) = base else {
            if let Some(without) = without {
                self.impossible(&without.node, WITHOUT, "there is no base to take it from");
            }
            return;
        };
        let Some(number) = self.named(blocks, &base.node) else {
            return;
        };
        self.open.push(index);
        if self.open.contains(&number) {
            let problem = format!("{} starts from itself", self.title(&blocks.0[index].key));
            self.impossible(&base.node, BASE, &problem);
        } else {
            self.complete(blocks, number);
            let mut whole =
                table_of(&mut blocks.0[number]).map_or_else(Table::default, |table| table.clone());
            for (path, node) in self.paths(without.as_ref()) {
                if !whole.remove(path) {
                    let problem = format!(
                        "{} has no `{}`",
                        self.title(&blocks.0[number].key),
                        escaped(path, QUOTED)
                    );
                    self.impossible(node, WITHOUT, &problem);
                }
            }
            if let Some(own) = table_of(&mut blocks.0[index]) {
                for entry in std::mem::take(own).0 {
                    whole.put(entry, usize::MAX);
                }
                *own = whole;
            }
        }
        self.open.pop();
    }

    /// The block of the section that a base names.
    fn named(&mut self, blocks: &Table, base: &Node) -> Option<usize> {
        let Value::Text(name) = &base.value else {
            let wanted = format!("the name of a {}", singular(self.section));
            self.wrong_type(base, BASE, &wanted);
            return None;
        };
        let names = || blocks.0.iter().map(|block| block.key.as_str());
        let found = names().position(|other| other == name);
        if found.is_none() {
            let error = DocumentError::UnknownName {
                kind: singular(self.section),
                name: escaped(name, QUOTED),
                nearest: nearest(name, names()).map(|name| escaped(name, QUOTED)),
                known: listed(names()),
            };
            self.error(base, error);
        }
        found
    }

    /// The paths of `without`, with their nodes.
    fn paths<'n>(&mut self, without: Option<&'n Entry>) -> Vec<(&'n str, &'n Node)> {
        let Some(entry) = without else {
            return Vec::new();
        };
        let Value::List(nodes) = &entry.node.value else {
            self.wrong_type(&entry.node, WITHOUT, "a list of paths");
            return Vec::new();
        };
        let mut paths = Vec::new();
        for node in nodes {
            if let Value::Text(path) = &node.value {
                paths.push((path.as_str(), node));
            } else {
                self.wrong_type(node, WITHOUT, "a path of keys in quotes");
            }
        }
        paths
    }

    fn title(&self, name: &str) -> String {
        format!("[{}.{}]", self.section, escaped(name, QUOTED))
    }

    fn impossible(&mut self, node: &Node, key: &str, problem: &str) {
        let error = DocumentError::Impossible {
            key: key.to_owned(),
            problem: problem.to_owned(),
            help: "name another block of the file, or leave the key out".to_owned(),
        };
        self.error(node, error);
    }

    fn wrong_type(&mut self, node: &Node, key: &str, wanted: &str) {
        let error = DocumentError::WrongType {
            key: key.to_owned(),
            found: node.value.kind().to_owned(),
            help: format!("write {wanted}"),
            wanted: wanted.to_owned(),
        };
        self.error(node, error);
    }

    fn error(&mut self, node: &Node, error: DocumentError) {
        let at = Some(node.at.clone());
        self.errors.push(LocatedError { error, at });
    }
}

fn table_of(entry: &mut Entry) -> Option<&mut Table> {
    match &mut entry.node.value {
        Value::Table(table) => Some(table),
        Value::Text(_)
        | Value::Integer(_)
        | Value::Number(_)
        | Value::Flag(_)
        | Value::Other(..)
        | Value::List(_) => None,
    }
}

fn take(table: &mut Table, key: &str) -> Option<Entry> {
    let index = table.0.iter().position(|entry| entry.key == key)?;
    Some(table.0.remove(index))
}
