//! `lamina sweep --list`: the tasks as JSON lines, for programs that do them elsewhere.

use std::ops::Range;

use leafmodel::document::schema::unit_of;
use serde_json::{Map, Value, json};

use super::tasks::{identities, words_of};
use crate::checkpoint::PROGRAM;
use crate::cli::arguments::SweepArguments;
use crate::cli::terminal::{Failure, has_no_reader, say};
use crate::scene::fingerprint::hexadecimal;
use crate::sweep::{Sweep, Target};

/// Prints a line for the sweep ([`about`]), then one for each task as soon as it is read: its number,
/// its identity, the values of its keys, and the words behind `lamina` that do it, but for its
/// outputs. A task that is refused ends the list with its error.
pub(super) fn print(
    sweep: &Sweep,
    arguments: &SweepArguments,
    range: Range<usize>,
) -> Result<(), Failure> {
    say(about(sweep));
    identities(sweep, range, |number, identity| {
        let task = sweep.task(number);
        let settings = task.settings.iter();
        let mut values: Map<String, Value> = settings
            .map(|(key, cell)| (key.path.clone(), value(&cell.text)))
            .collect();
        if let Some(seed) = task.seed {
            values.insert("seed".to_owned(), json!(seed));
        }
        say(json!({
            "task": number,
            "id": hexadecimal(identity),
            "values": values,
            "arguments": words_of(sweep, &task, &arguments.cache),
        }));
        !has_no_reader()
    })
}

/// What all tasks share.
pub(super) fn about(sweep: &Sweep) -> Value {
    let mut keys: Vec<Value> = sweep
        .keys()
        .map(|key| {
            let last = key.path.rsplit('.').next().unwrap_or_default();
            json!({ "key": key.path, "unit": unit_of(last) })
        })
        .collect();
    if sweep.has_seeds() {
        keys.push(json!({ "key": "seed", "unit": null }));
    }
    json!({
        "program": PROGRAM,
        "kind": match sweep.target {
            Target::Scene(_) => "render",
            Target::Leaf(_) => "grow",
        },
        "tasks": sweep.len(),
        "keys": keys,
    })
}

/// A value of TOML as one of JSON; a word without quotes is text.
pub(super) fn value(text: &str) -> Value {
    let parsed = toml::from_str::<toml::Table>(&format!("value = {text}")).ok();
    let value = parsed.and_then(|mut table| table.remove("value"));
    let value = value.and_then(|value| serde_json::to_value(value).ok());
    value.unwrap_or_else(|| Value::String(text.to_owned()))
}

/// A value as a table has it: text without quotes.
pub(super) fn plain(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Null | Value::Bool(_) | Value::Number(_) | Value::Array(_) | Value::Object(_) => {
            value.to_string()
        }
    }
}
