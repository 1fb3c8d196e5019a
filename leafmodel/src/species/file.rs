//! The file of a preset: its heading, and the blocks that it inherits.

use std::path::Path;
use std::sync::OnceLock;

use crate::document::reader::Block;
use crate::document::schema::BlockSchema;
use crate::document::source::Place;
use crate::document::{Keys, Limits, ListOf, Number, Opened, Table, Text};

/// The blocks of a file.
pub(crate) const BLOCKS: [&str; 6] = ["sources", "traits", "tissues", "age", "counts", "leaf"];

/// The keys at the top of a preset's file, which no other inherits.
#[derive(Debug, Default)]
pub(super) struct Heading {
    pub(super) about: String,
    pub(super) source: String,
    pub(super) adaxial_roughness: Option<f64>,
    base: Option<String>,
    without: Vec<String>,
}

impl Heading {
    fn declare(&mut self, keys: &mut Keys<'_>) {
        let text = Text("a text");
        keys.key("about", &mut self.about, text, "What the preset shows.");
        let about = "Where its numbers are from.";
        keys.key("source", &mut self.source, text, about);
        let about = "The file whose blocks hold where this one says nothing else.";
        keys.optional("base", &mut self.base, Text("a file's name"), about);
        let paths = ListOf {
            of: Text("a path of keys"),
            least: 0,
            most: 100,
            wanted: "a list of paths",
        };
        let about = "What the base has and this leaf lacks.";
        keys.key("without", &mut self.without, paths, about);
        let limits = Number(Limits::closed(0.0, 1.0));
        let about = "GGX roughness of the adaxial coat.";
        let roughness = &mut self.adaxial_roughness;
        keys.optional("adaxial_roughness", roughness, limits, about);
    }
}

/// A preset's file.
#[derive(Debug)]
pub(super) struct PresetFile {
    name: &'static str,
    text: &'static str,
    heading: OnceLock<Heading>,
}

/// The file of a name, if there is one.
type Bases<'a> = &'a dyn Fn(&str) -> Option<&'static PresetFile>;

impl PresetFile {
    pub(super) const fn new(name: &'static str, text: &'static str) -> Self {
        Self {
            name,
            text,
            heading: OnceLock::new(),
        }
    }

    /// The heading of the file, whose blocks are not parsed.
    pub(super) fn heading(&self) -> &Heading {
        self.heading.get_or_init(|| {
            let end = self
                .text
                .find(
                    "
[",
                )
                .unwrap_or(self.text.len());
            let opened = open(self.name, &self.text[..end]);
            let mut heading = Heading::default();
            read(opened, |keys| heading.declare(keys));
            heading
        })
    }

    /// The file with the blocks that it inherits in place of what it leaves out.
    pub(super) fn opened(&self, bases: Bases<'_>) -> Opened {
        let mut opened = open(self.name, self.text);
        let own = std::mem::take(&mut opened.tree);
        opened.tree = self.whole(own, &mut opened, bases);
        opened
    }

    /// `own`, the tree of the file itself, on top of what it inherits.
    fn whole(&self, own: Table, opened: &mut Opened, bases: Bases<'_>) -> Table {
        let heading = self.heading();
        let mut tree = Table::default();
        if let Some(base) = &heading.base {
            let base = bases(base).unwrap_or_else(|| panic!("{} has no such base", self.name));
            let beneath = opened.also(base.text, &shown(base.name));
            tree = base.whole(beneath, opened, bases);
        }
        for path in &heading.without {
            let is_there = tree.remove(path);
            assert!(is_there, "the base of {} has no {path}", self.name);
        }
        for entry in own.0 {
            if BLOCKS.contains(&entry.key.as_str()) {
                // The keys of a leaf change one by one; of other blocks, whole entries do.
                let depth = if entry.key == "leaf" { usize::MAX } else { 2 };
                tree.put(entry, depth);
            }
        }
        tree
    }
}

fn open(name: &str, text: &str) -> Opened {
    let folder = Path::new(".");
    let opened = Opened::text(text, &shown(name), folder, &[], BlockSchema::default);
    opened.expect("no file is as large as that")
}

fn shown(name: &str) -> String {
    format!("species/{name}.toml")
}

/// Reads the keys at the top of a file, all of which are declared. The files are part of the program
/// and read by its tests, so that an error is a bug.
pub(crate) fn read(opened: Opened, declare: impl FnOnce(&mut Keys<'_>)) {
    let start = Place {
        source: 0,
        span: 0..0,
    };
    let root = Block::new(&opened.cx, &opened.tree, String::new(), start);
    let is_sound = Keys::read(root, None, declare);
    let finished = opened.finish(is_sound.then_some(()));
    finished.unwrap_or_else(|errors| panic!("{errors}"));
}
