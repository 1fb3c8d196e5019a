//! What belongs together in a block, and reports of what does not.

use std::rc::Rc;

use super::{Keys, Pass, Reading};
use crate::error::DocumentError;
use crate::reader::Block;
use crate::source::Place;
use crate::tree::{Node, Value};

/// Name of a preset that is misspelt.
pub(super) const UNKNOWN: &str = "";

impl<'p> Keys<'p> {
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
            Pass::Write { .. } | Pass::Check(_) => false,
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

    /// Whether a file is read, as far as here without an error in this block: then what belongs
    /// together can be checked.
    pub fn is_sound(&self) -> bool {
        match &self.pass {
            Pass::Read(reading) => {
                reading.block.cx.error_count() == reading.errors
                    && !reading.block.lacks_something()
                    && reading.block.cx.survey.borrow().is_none()
            }
            Pass::Write { .. } | Pass::Describe(_) | Pass::Check(_) => false,
        }
    }

    /// Whether a file is read that has a block inside this one, itself or by its preset, without an
    /// error in it.
    pub fn is_whole(&self, name: &str) -> bool {
        let Pass::Read(Reading {
            block,
            base,
            broken,
            ..
        }) = &self.pass
        else {
            return false;
        };
        let is_there = base.is_some() || block.table.get(name).is_some();
        is_there && block.cx.survey.borrow().is_none() && !broken.contains(&name)
    }

    /// Whether a block is described, so that every key is to be declared.
    pub fn is_description(&self) -> bool {
        matches!(self.pass, Pass::Describe(_))
    }

    /// The block of the file that is read, for what needs its places.
    pub fn reader(&self) -> Option<&Block<'p>> {
        match &self.pass {
            Pass::Read(reading) => Some(&reading.block),
            Pass::Write { .. } | Pass::Describe(_) | Pass::Check(_) => None,
        }
    }

    /// The preset that stands beneath, if a file is read and there is one.
    pub fn base(&self) -> Option<&str> {
        match &self.pass {
            Pass::Read(reading) => reading.base.as_deref(),
            Pass::Write { .. } | Pass::Describe(_) | Pass::Check(_) => None,
        }
    }

    /// From here on the values are those of a preset, and no key is required.
    pub fn set_base(&mut self, preset: &str) {
        if let Pass::Read(reading) = &mut self.pass {
            reading.base = Some(Rc::from(preset));
        }
    }

    /// Notes that a preset stands beneath whose name is misspelt. Whatever is missing may be its, so
    /// that one error is enough.
    pub fn set_unknown_base(&mut self) {
        self.set_base(UNKNOWN);
    }

    /// Reports what is wrong with values that are allowed one by one, at the deepest part of the
    /// path that is there. A `*` stands for the only block, whatever its name.
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

    /// Refuses a value that is neither 0 nor within a range that begins above 0.
    pub fn refuse_gap(&self, key: &str, value: f64, [least, most]: [f64; 2], help: &str) {
        if value > 0.0 && value < least {
            let problem = format!("{value} is neither 0 nor from {least} to {most}");
            self.refuse(&[key], problem, help);
        }
    }

    /// Whether a path is in the file that is read.
    pub fn has_path(&self, path: &[&str]) -> bool {
        self.reader()
            .is_some_and(|block| deepest(block, path).1 == path.len())
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

    /// Warns of something that is allowed and hardly meant.
    pub fn warn(&self, code: &'static str, message: String, help: &str) {
        if let Pass::Read(Reading { block, .. }) = &self.pass
            && block.cx.survey.borrow().is_none()
        {
            block.cx.warn(&block.at, code, message, help);
        }
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
