//! Overrides from the command line: `key=value`, written as in the file.

use toml::de::DeTable;

use super::context::{Context, QUOTED};
use super::tree::{Entry, Node, Table};
use crate::scene::error::SceneError;
use crate::scene::source::{Place, escaped};

/// Puts one override into a file's tree. Errors point into the override's own text, which reports show under the
/// name of its `flag`.
pub(crate) fn apply(cx: &Context, tree: &mut Table, flag: &str, text: &str) {
    let source = cx.sources.borrow_mut().add(flag, text);
    let whole = Place {
        source,
        span: 0..text.len(),
    };
    let not_one = |problem: &str| {
        let error = SceneError::NotAnOverride {
            problem: problem.to_owned(),
        };
        cx.error(&whole, error);
    };
    if text.contains(['\n', '\r']) {
        not_one("several lines");
        return;
    }
    if !text.contains('=') {
        not_one(&format!("`{}`, without `=`", escaped(text, QUOTED)));
        return;
    }
    if text.trim_start().starts_with('[') {
        not_one("a block, not a value");
        return;
    }
    let (parsed, errors) = DeTable::parse_recoverable(text);
    for error in &errors {
        let at = Place {
            source,
            span: error.span().unwrap_or(0..text.len()),
        };
        let message = escaped(error.message(), 4 * QUOTED);
        cx.error(&at, SceneError::Syntax { message });
    }
    if !errors.is_empty() {
        return;
    }
    let mut table = Table::from_toml(source, parsed.into_inner());
    let mut path: Vec<(String, Place)> = Vec::new();
    loop {
        let Some(entry) = table.0.pop() else {
            not_one("a block, not a value");
            return;
        };
        let Entry { key, key_at, node } = entry;
        let key_end = key_at.span.end;
        path.push((key, key_at));
        match into_rest_of_path(text, key_end, node) {
            Ok(rest) => table = rest,
            Err(node) => {
                if let Err(at) = tree.set(&path, node) {
                    let error = SceneError::NotAnOverride {
                        problem: format!(
                            "a key inside of `{}`, which is a value",
                            escaped(key_before(&path, &at), QUOTED)
                        ),
                    };
                    cx.error(&at, error);
                }
                return;
            }
        }
    }
}

/// The table behind a key if the next key follows by a dot, or else the value behind `=`.
fn into_rest_of_path(text: &str, key_end: usize, node: Node) -> Result<Table, Node> {
    let dotted = text
        .get(key_end..)
        .is_some_and(|rest| rest.trim_start().starts_with('.'));
    if dotted && let super::tree::Value::Table(table) = node.value {
        return Ok(table);
    }
    Err(node)
}

fn key_before<'p>(path: &'p [(String, Place)], at: &Place) -> &'p str {
    path.iter()
        .find(|(_, key_at)| key_at == at)
        .map_or("", |(key, _)| key.as_str())
}
