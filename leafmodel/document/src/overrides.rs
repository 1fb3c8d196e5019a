//! Overrides from the command line: `key=value`, written as in the file.

use toml::de::DeTable;

use super::context::{Context, ENOUGH, QUOTED};
use super::error::{DocumentError, LocatedError};
use super::nearest::nearest;
use super::other_format::with_equals;
use super::schema::{BlockSchema, EntrySchema, Is, Type};
use super::sections::singular;
use super::source::{Place, escaped};
use super::tree::{Entry, Node, Table};
use super::values::listed;

/// Puts one override into a file's tree. Errors point into the override's own text, which reports
/// show under the name of its `flag`.
///
/// Text may go without its quotes, which a shell takes away: the schema says which keys take text.
pub fn apply(cx: &Context, tree: &mut Table, flag: &str, text: &str, schema: &BlockSchema) {
    let quoted = with_quotes(text, schema);
    let text = quoted.as_deref().unwrap_or(text);
    let source = cx.sources.borrow_mut().add(flag, text);
    let whole = Place {
        source,
        span: 0..text.len(),
    };
    let not_one = |problem: &str| {
        let error = DocumentError::NotAnOverride {
            problem: problem.to_owned(),
        };
        cx.error(&whole, error);
    };
    if text.contains(['\n', '\r']) {
        not_one("several lines");
        return;
    }
    if !text.contains('=') {
        let meant =
            with_equals(text).map_or_else(String::new, |meant| format!(": write `{meant}`"));
        not_one(&format!("`{}`, without `=`{meant}", escaped(text, QUOTED)));
        return;
    }
    if text
        .split_once('=')
        .is_some_and(|(_, value)| value.trim().is_empty())
    {
        not_one(&format!(
            "`{}`, whose value is missing",
            escaped(text.trim(), QUOTED)
        ));
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
        cx.error(
            &at,
            DocumentError::Syntax {
                message,
                help: None,
            },
        );
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
                note_new_name(cx, tree, &path);
                if let Err(at) = tree.set(&path, node) {
                    let error = DocumentError::NotAnOverride {
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

/// The override with quotes around its value, if its key takes text, or if that makes a word of
/// what else is no TOML.
fn with_quotes(text: &str, schema: &BlockSchema) -> Option<String> {
    let is_toml = |text: &str| DeTable::parse_recoverable(text).1.is_empty();
    let (key, value) = text.split_once('=')?;
    let value = value.trim();
    let is_plain = !value.is_empty()
        && !value.contains([
            '"', '\'', '\\', '[', ']', '{', '}', ',', '=', '#', '\n', '\r',
        ]);
    let path: Vec<&str> = key.split('.').map(str::trim).collect();
    let takes_text = schema.key_at(&path).is_some_and(takes_text);
    if !is_plain || (is_toml(text) && !takes_text) {
        return None;
    }
    let quoted = format!("{key}=\"{value}\"");
    is_toml(&quoted).then_some(quoted)
}

/// Whether a key takes text.
fn takes_text(entry: &EntrySchema) -> bool {
    let is_text = |of: &Type| matches!(of, Type::Text(_) | Type::Word(_) | Type::Name(..));
    match &entry.is {
        Is::Value {
            of: Type::AnyOf(types, _),
            ..
        } => {
            // Where a number may stand, a word without quotes is no TOML and gets them by that.
            let is_number = |of: &Type| matches!(of, Type::Number(_) | Type::Integer { .. });
            types.iter().any(is_text) && !types.iter().any(is_number)
        }
        Is::Value { of, .. } => is_text(of),
        Is::Block(_) | Is::Named(_) | Is::List { .. } => false,
    }
}

/// Notes a name in the second place of a path, `leaves.NAME`, that is not in the file and like one
/// that is.
fn note_new_name(cx: &Context, tree: &Table, path: &[(String, Place)]) {
    let [(section, _), (name, at), _, ..] = path else {
        return;
    };
    let Some(names) = tree.get(section).and_then(|entry| entry.node.table()) else {
        return;
    };
    let names = || names.0.iter().take(ENOUGH).map(|entry| entry.key.as_str());
    if names().any(|known| known == name) {
        return;
    }
    let Some(meant) = nearest(name, names()) else {
        return;
    };
    let error = DocumentError::UnknownName {
        kind: singular(section),
        name: escaped(name, QUOTED),
        nearest: Some(escaped(meant, QUOTED)),
        known: listed(names()),
    };
    let at = Some(at.clone());
    cx.perhaps_misspelt
        .borrow_mut()
        .push(LocatedError { error, at });
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
