//! Lists of names of blocks.

use leafmodel::document::context::{Context, ENOUGH};
use leafmodel::document::schema::Type;
use leafmodel::document::tree::{Node, Value};
use leafmodel::document::value_kind::Kind;
use leafmodel::document::values::{list, text_at, wrong_length, wrong_type};

/// Reads a name or a list of names of blocks of a section.
#[derive(Clone, Copy, Debug)]
pub(in crate::scene) struct NamesIn(
    pub(in crate::scene) &'static str,
    pub(in crate::scene) &'static str,
);

impl Kind for NamesIn {
    type Of = Vec<(usize, String)>;

    fn read(&self, cx: &Context, node: &Node, key: &str) -> Option<Self::Of> {
        let written = match &node.value {
            Value::List(list) if !(1..=ENOUGH).contains(&list.len()) => {
                let wanted = format!("a list of 1 to {ENOUGH} names");
                wrong_length(cx, &node.at, key, "a list", list.len(), &wanted);
                return None;
            }
            Value::List(list) => list.iter().map(|name| text_at(cx, name, key)).collect(),
            Value::Text(_) => vec![text_at(cx, node, key)],
            Value::Integer(_)
            | Value::Number(_)
            | Value::Flag(_)
            | Value::Other(..)
            | Value::Table(_) => {
                wrong_type(cx, node, key, "text in quotes");
                return None;
            }
        };
        let known = cx.names(self.0)?;
        let found: Vec<Option<(usize, String)>> = written
            .into_iter()
            .map(|name| Some((known.find(cx, name?)?, name?.0.to_owned())))
            .collect();
        found.into_iter().collect()
    }

    fn write(&self, value: &Self::Of) -> Value {
        list(value.iter().map(|(_, name)| Value::Text(name.clone())))
    }

    fn describe(&self) -> Type {
        let list = Type::List {
            of: Box::new(Type::Text(self.1)),
            least: 1,
            most: ENOUGH,
            wanted: "a list of names",
        };
        Type::AnyOf(vec![Type::Text(self.1), list], self.1)
    }
}

/// The same where nothing asks for the names.
#[derive(Clone, Copy, Debug)]
pub(in crate::scene) struct IndicesIn(pub(in crate::scene) NamesIn);

impl Kind for IndicesIn {
    type Of = Vec<usize>;

    fn read(&self, cx: &Context, node: &Node, key: &str) -> Option<Vec<usize>> {
        let named = self.0.read(cx, node, key)?.into_iter();
        Some(named.map(|(index, _)| index).collect())
    }

    fn write(&self, value: &Vec<usize>) -> Value {
        list(value.iter().map(|index| Value::Integer(*index as i128)))
    }

    fn describe(&self) -> Type {
        self.0.describe()
    }
}
