//! A block of the file that knows which of its keys were asked for.
//!
//! Every getter notes what is wrong and gives `None` (or the default), so that one pass over a
//! file finds all of its errors. Blocks are read in full before anything is put together from
//! them; [`Block::finish`] then reports the keys that nobody asked for.

use std::cell::{Cell, RefCell};

use super::context::{Context, ENOUGH, KnownKey, QUOTED};
use super::error::{DocumentError, NONE};
use super::limits::Limits;
use super::nearest::{nearest, other_unit};
use super::source::{Place, escaped};
use super::tree::{Entry, Node, Table, Value};
use super::values::{listed, number_at, text_at, wrong_type};

/// What a survey of the keys reads in place of a block that is left out.
static NOTHING: Table = Table(Vec::new());

/// A table of the file under its full name.
#[derive(Debug)]
pub struct Block<'a> {
    /// Where errors go.
    pub cx: &'a Context,
    /// Its keys and values.
    pub table: &'a Table,
    /// Keys from the top of the file, joined by dots; empty for the file itself.
    pub path: String,
    /// Where it stands.
    pub at: Place,
    asked: RefCell<Vec<&'static str>>,
    missing: RefCell<Vec<(&'static str, String)>>,
    /// Whether keys stand here that exclude each other, so that nobody knows which others belong.
    is_ambiguous: Cell<bool>,
    /// What to say of keys that are missing since nothing is taken from the preset.
    anew: Option<String>,
}

impl<'a> Block<'a> {
    /// A table under the name it has in reports.
    pub fn new(cx: &'a Context, table: &'a Table, path: String, at: Place) -> Self {
        Self {
            cx,
            table,
            path,
            at,
            asked: RefCell::default(),
            missing: RefCell::default(),
            is_ambiguous: Cell::default(),
            anew: None,
        }
    }

    /// Notes that the block is of another kind than the preset's, of which nothing is taken then.
    pub(crate) fn starts_over(&mut self, preset: &str, kind: &str) {
        self.anew = Some(format!(
            "; the preset `{preset}` has the kind `{kind}` here, of which nothing is taken"
        ));
    }

    /// Whether a key is missing.
    pub(crate) fn lacks_something(&self) -> bool {
        !self.missing.borrow().is_empty()
    }

    /// The block as a sentence names it.
    pub fn title(&self) -> String {
        if self.path.is_empty() {
            "the file".to_owned()
        } else {
            format!("[{}]", escaped(&self.path, QUOTED))
        }
    }

    /// The entry of a key, which from now on is a known one.
    pub fn entry(&self, key: &'static str) -> Option<&'a Entry> {
        self.asked.borrow_mut().push(key);
        self.table.get(key)
    }

    /// The value of a key, which from now on is a known one.
    pub fn node(&self, key: &'static str) -> Option<&'a Node> {
        self.entry(key).map(|entry| &entry.node)
    }

    /// The value of a key that must be there; `wanted` completes "add …".
    pub fn needed(&self, key: &'static str, wanted: impl FnOnce() -> String) -> Option<&'a Node> {
        let node = self.node(key);
        if node.is_none() {
            self.missing.borrow_mut().push((key, wanted()));
        }
        node
    }

    /// A real number.
    pub fn number(&self, key: &'static str, limits: Limits) -> Option<f64> {
        let node = self.needed(key, || format!("`{key} = …`, a number within {limits}"))?;
        number_at(self.cx, node, key, limits)
    }

    /// Text.
    pub fn text(&self, key: &'static str, wanted: &str) -> Option<(&'a str, &'a Place)> {
        let node = self.needed(key, || format!("`{key} = \"…\"`, {wanted}"))?;
        text_at(self.cx, node, key)
    }

    /// A block inside this one, of one of the named variants if there are any.
    pub fn block(&self, key: &'static str, variants: &[&str]) -> Option<Block<'a>> {
        self.needed(key, || {
            let path = escaped(&self.path_of(key), QUOTED);
            if variants.is_empty() {
                return format!("a block `[{path}]`");
            }
            let headers: Vec<String> = variants
                .iter()
                .map(|variant| format!("`[{path}.{variant}]`"))
                .collect();
            format!("a block {}", headers.join(" or "))
        })?;
        self.optional_block(key)
    }

    /// A block inside this one that may be left out.
    pub fn optional_block(&self, key: &'static str) -> Option<Block<'a>> {
        let Some(entry) = self.entry(key) else {
            let surveyed = self.cx.survey.borrow().is_some();
            let path = self.path_of(key);
            return surveyed.then(|| Block::new(self.cx, &NOTHING, path, self.at.clone()));
        };
        self.open(entry)
    }

    /// The blocks inside this one, whatever their names; for sections such as `[materials]`.
    pub fn open(&self, entry: &'a Entry) -> Option<Block<'a>> {
        if let Value::Table(table) = &entry.node.value {
            let path = self.path_of(&entry.key);
            Some(Block::new(self.cx, table, path, entry.key_at.clone()))
        } else {
            let key = escaped(&entry.key, QUOTED);
            wrong_type(self.cx, &entry.node, &key, "a table");
            None
        }
    }

    /// The one block among `variants` that is there, and nothing else beside it.
    ///
    /// Where none is there and one is `kept`, it is that one, empty.
    pub fn variant(
        &self,
        variants: &[&'static str],
        kept: Option<&'static str>,
    ) -> Option<(&'static str, Block<'a>)> {
        let chosen = self.one_of(variants);
        self.note_known_keys();
        let known: Vec<&str> = self.asked.borrow().clone();
        let mut strangers = false;
        for entry in &self.table.0 {
            if known.contains(&entry.key.as_str()) {
                continue;
            }
            let meant = nearest(&entry.key, variants.iter().copied());
            // A key of the block that should be around it: that this lacks is the error.
            let is_inside = meant.is_none() && entry.node.table().is_none();
            if is_inside && matches!(chosen, Choice::None) && kept.is_none() {
                continue;
            }
            strangers = true;
            if self.cx.is_full() {
                break;
            }
            let error = DocumentError::UnknownVariant {
                variant: escaped(&entry.key, QUOTED),
                block: self.title(),
                nearest: meant.map(str::to_owned),
                known: listed(variants.iter().copied()),
            };
            self.cx.error(&entry.key_at, error);
        }
        match chosen {
            Choice::One(key) => Some((key, self.optional_block(key)?)),
            // Whoever wrote another word meant one of these: one error is enough.
            Choice::None if strangers => None,
            Choice::None if kept.is_some() => {
                let key = kept?;
                let path = self.path_of(key);
                Some((key, Block::new(self.cx, &NOTHING, path, self.at.clone())))
            }
            Choice::None | Choice::Several(_) => {
                self.report_choice(variants, &chosen, "needs exactly");
                None
            }
        }
    }

    /// The one key among `keys` that is there, reported if it is not one.
    pub fn exactly_one(&self, keys: &[&'static str]) -> Option<&'static str> {
        self.one_alone(keys, "needs exactly")
    }

    /// As [`Block::exactly_one`], for keys of which there may be none.
    pub(crate) fn at_most_one(&self, keys: &[&'static str]) -> Option<&'static str> {
        self.one_alone(keys, "takes at most")
    }

    fn one_alone(&self, keys: &[&'static str], allows: &'static str) -> Option<&'static str> {
        let chosen = self.one_of(keys);
        if let Choice::One(key) = chosen {
            return Some(key);
        }
        let misspelt = |entry: &Entry| {
            !self.asked.borrow().contains(&entry.key.as_str())
                && nearest(&entry.key, keys.iter().copied()).is_some()
        };
        let several = matches!(chosen, Choice::Several(_));
        if several || !self.first_entries().any(misspelt) {
            self.report_choice(keys, &chosen, allows);
        }
        self.is_ambiguous.set(self.is_ambiguous.get() || several);
        None
    }

    /// The entries among which misspelt keys are looked for.
    pub(crate) fn first_entries(&self) -> impl Iterator<Item = &'a Entry> {
        self.table.0.iter().take(ENOUGH)
    }

    fn one_of(&self, keys: &[&'static str]) -> Choice {
        let found: Vec<&'static str> = keys
            .iter()
            .copied()
            .filter(|key| self.entry(key).is_some())
            .collect();
        match found.as_slice() {
            [] => Choice::None,
            [key] => Choice::One(key),
            _ => Choice::Several(found),
        }
    }

    fn report_choice(&self, keys: &[&'static str], chosen: &Choice, allows: &'static str) {
        let found = match chosen {
            Choice::None | Choice::One(_) => NONE.to_owned(),
            Choice::Several(found) => listed(found.iter().copied()),
        };
        let error = DocumentError::NotOne {
            block: self.title(),
            allows,
            alternatives: listed(keys.iter().copied()),
            found,
        };
        self.cx.error(&self.at, error);
    }

    /// Reports two keys that exclude each other, if both are there.
    pub fn exclude(&self, first: &'static str, second: &'static str) {
        if let (Some(_), Some(entry)) = (self.entry(first), self.entry(second)) {
            let error = DocumentError::Conflict {
                first: first.to_owned(),
                second: second.to_owned(),
            };
            self.cx.error(&entry.key_at, error);
        }
    }

    /// Reports what nobody asked for, and what is missing.
    ///
    /// A missing key is left out if an unknown one is most probably just that, misspelt; unknown
    /// keys are, where others exclude each other: each of those has keys of its own beside it.
    pub fn finish(&self) {
        self.note_known_keys();
        let asked = self.asked.borrow();
        let mut known: Vec<&str> = Vec::new();
        for key in asked.iter() {
            if !known.contains(key) {
                known.push(key);
            }
        }
        let is_absent = |key: &&str| self.table.get(key).is_none();
        let absent: Vec<&str> = known.iter().copied().filter(is_absent).collect();
        let mut missing = self.missing.borrow().clone();
        for entry in &self.table.0 {
            if known.contains(&entry.key.as_str()) || self.is_ambiguous.get() {
                continue;
            }
            if self.cx.is_full() {
                break;
            }
            // What is still missing is meant rather than what is there already.
            let meant = nearest(&entry.key, absent.iter().copied())
                .or_else(|| nearest(&entry.key, known.iter().copied()));
            missing.retain(|(key, _)| Some(*key) != meant);
            let error = DocumentError::UnknownKey {
                key: escaped(&entry.key, QUOTED),
                block: self.title(),
                nearest: meant.map(str::to_owned),
                unit: meant.and_then(|meant| other_unit(&entry.key, meant)),
                known: listed(known.iter().copied()),
            };
            self.cx.error(&entry.key_at, error);
        }
        for (key, wanted) in missing {
            let anew = self.anew.as_deref().unwrap_or_default();
            let error = DocumentError::MissingKey {
                key: key.to_owned(),
                block: self.title(),
                wanted: wanted + anew,
            };
            if self.path.is_empty() {
                self.cx.error_of_the_file(error);
            } else {
                self.cx.error(&self.at, error);
            }
        }
    }

    fn note_known_keys(&self) {
        if let Some(known) = self.cx.survey.borrow_mut().as_mut() {
            known.extend(self.asked.borrow().iter().map(|key| KnownKey {
                path: self.path_of(key),
                block_is_there: !std::ptr::eq(self.table, &raw const NOTHING),
            }));
        }
    }

    /// The full name of a key of this block.
    pub fn path_of(&self, key: &str) -> String {
        if self.path.is_empty() {
            key.to_owned()
        } else {
            format!("{}.{key}", self.path)
        }
    }
}

enum Choice {
    None,
    One(&'static str),
    Several(Vec<&'static str>),
}
