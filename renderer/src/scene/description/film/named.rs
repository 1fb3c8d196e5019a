//! What a film sees by, given by a name or as a table in a file.

use std::fmt::Debug;

use leafmodel::document::context::{Context, QUOTED};
use leafmodel::document::error::DocumentError;
use leafmodel::document::keys::Keys;
use leafmodel::document::nearest::nearest;
use leafmodel::document::reader::Block;
use leafmodel::document::schema::Type;
use leafmodel::document::source::escaped;
use leafmodel::document::tree::{Node, Table, Value};
use leafmodel::document::value_kind::{FilePath, Kind};
use leafmodel::document::values::{listed, wrong_type};

use crate::scene::blocks::table_file::TableFile;

/// What has names, or a table of its own.
pub(super) trait Tabled: Copy + Debug {
    type Of;

    /// What a value may be.
    const WANTED: &'static str;
    /// What the table of a file holds.
    const ABOUT_FILE: &'static str;

    /// All names.
    fn names() -> impl Iterator<Item = &'static str>;

    /// What a name stands for.
    fn by_name(name: &str) -> Option<Self::Of>;

    /// Its name, or that of its file.
    fn name(value: &Self::Of) -> &str;

    /// What a file's table holds; what is wrong with it is reported there. `path` is the file as the
    /// scene writes it.
    fn of_file(self, file: &TableFile<'_>, path: &str) -> Option<Self::Of>;
}

/// A value that has a name or is in a file.
#[derive(Clone, Copy, Debug)]
pub(super) struct NameOrFile<T>(pub(super) T);

const FILE: FilePath = FilePath::of("the path of a CSV file", &["csv", "tsv", "txt"], 1 << 20);

impl<T: Tabled> Kind for NameOrFile<T> {
    type Of = T::Of;

    fn read(&self, cx: &Context, node: &Node, key: &str) -> Option<T::Of> {
        self.form(cx, node, key, key.to_owned())
    }

    fn read_in(&self, block: &Block<'_>, node: &Node, key: &str) -> Option<T::Of> {
        self.form(block.cx, node, key, block.path_of(key))
    }

    fn write(&self, value: &T::Of) -> Value {
        let name = Value::Text(T::name(value).to_owned());
        if T::names().any(|known| known == T::name(value)) {
            return name;
        }
        Value::Table(Table::of([("file", name)]))
    }

    fn describe(&self) -> Type {
        let form = Keys::describe(|keys| {
            keys.one_of(&["file"], None);
            keys.optional("file", &mut None, FILE, T::ABOUT_FILE);
        });
        let names = T::names().map(str::to_owned).collect();
        Type::AnyOf(vec![Type::Word(names), Type::Table(form)], T::WANTED)
    }
}

impl<T: Tabled> NameOrFile<T> {
    fn form(&self, cx: &Context, node: &Node, key: &str, path: String) -> Option<T::Of> {
        match &node.value {
            Value::Text(name) => {
                let found = T::by_name(name);
                if found.is_none() {
                    let error = DocumentError::UnknownWord {
                        key: key.to_owned(),
                        word: escaped(name, QUOTED),
                        nearest: nearest(name, T::names()).map(str::to_owned),
                        known: listed(T::names()),
                    };
                    cx.error(&node.at, error);
                }
                found
            }
            Value::Table(table) => {
                let mut found = None;
                let form = Block::new(cx, table, path, node.at.clone());
                Keys::read(form, None, |keys| {
                    keys.one_of(&["file"], None);
                    let mut named = None;
                    keys.optional("file", &mut named, FILE, T::ABOUT_FILE);
                    let at = keys.reader().and_then(|form| form.node("file"));
                    found = named.zip(at).and_then(|(named, node)| {
                        let file = TableFile::read(cx, &named.file, &named.written, &node.at)?;
                        self.0.of_file(&file, &named.written)
                    });
                });
                found
            }
            Value::Integer(_)
            | Value::Number(_)
            | Value::Flag(_)
            | Value::Other(..)
            | Value::List(_) => {
                wrong_type(cx, node, key, T::WANTED);
                None
            }
        }
    }
}
