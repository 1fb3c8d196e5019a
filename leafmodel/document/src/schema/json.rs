//! Blocks as a JSON Schema: editors complete and explain keys by it. Draft 7, since the language
//! server of TOML knows no later one.

use serde_json::{Map, Value as Json, json};

use super::{BlockSchema, EntrySchema, Is, Type, default_in_words, unit_of};
use crate::limits::Limits;
use crate::tree::Value;

/// A section that a file may hold without what other files need.
#[derive(Clone, Copy, Debug)]
pub struct Alone {
    /// The section.
    pub section: &'static str,
    /// Sections that a file of this section alone does not have.
    pub without: &'static [&'static str],
    /// A key of its blocks that is only needed beside those.
    pub optional: &'static str,
}

/// The schema of a file with these keys, which may also hold one section `alone`.
pub fn json_schema(root: &BlockSchema, alone: Alone, title: &str) -> Json {
    let mut definitions = Map::new();
    let mut schema = block(root, &mut definitions);
    schema["$schema"] = json!("http://json-schema.org/draft-07/schema#");
    schema["title"] = json!(title);
    if !definitions.is_empty() {
        schema["definitions"] = Json::Object(definitions);
    }
    if let Some(whole) = demands(root) {
        let one = |key: &&str| json!({ "required": [*key] });
        let others: Vec<Json> = alone.without.iter().map(one).collect();
        let is_alone = json!({ "required": [alone.section], "not": { "anyOf": others } });
        let demands = demands(&only(root, alone)).unwrap_or_else(|| json!({}));
        schema["allOf"] = json!([{ "if": is_alone, "then": demands, "else": whole }]);
    }
    schema
}

/// The keys of a file with one section alone.
fn only(root: &BlockSchema, alone: Alone) -> BlockSchema {
    let mut own = root.clone();
    own.groups.clear();
    own.entries
        .retain(|entry| entry.key == "format" || entry.key == alone.section);
    for entry in &mut own.entries {
        if let Is::Named(inner) = &mut entry.is {
            let optional = inner.entries.iter_mut();
            let mut optional = optional.filter(|entry| entry.key == alone.optional);
            if let Some(optional) = optional.next() {
                optional.required = false;
            }
        }
    }
    own
}

/// What a block may hold.
fn block(schema: &BlockSchema, definitions: &mut Map<String, Json>) -> Json {
    let mut properties = Map::new();
    for entry in &schema.entries {
        properties.insert(entry.key.clone(), property(entry, definitions));
    }
    json!({
        "type": "object",
        "properties": properties,
        "additionalProperties": false,
    })
}

/// What a block must hold, and the blocks inside it if they are there; nothing of what a preset
/// brings.
fn demands(schema: &BlockSchema) -> Option<Json> {
    let mut json = Map::new();
    let required = schema.entries.iter().filter(|entry| entry.required);
    let required: Vec<&str> = required.map(|entry| entry.key.as_str()).collect();
    if !required.is_empty() {
        json.insert("required".to_owned(), json!(required));
    }
    let groups: Vec<Json> = schema
        .groups
        .iter()
        .map(|group| {
            let one = |key: &&str| json!({ "required": [*key] });
            let mut choices: Vec<Json> = group.keys.iter().map(one).collect();
            if !group.required {
                choices.push(json!({ "not": { "anyOf": choices.clone() } }));
            }
            json!({ "oneOf": choices })
        })
        .collect();
    if !groups.is_empty() {
        json.insert("allOf".to_owned(), json!(groups));
    }
    let mut inside = Map::new();
    for entry in &schema.entries {
        let inner = match &entry.is {
            Is::Block(inner) => demands(inner),
            Is::Named(inner) => {
                demands(inner).map(|demands| json!({ "additionalProperties": demands }))
            }
            // A list's blocks are all of them written out, beside a preset too.
            Is::List { .. } | Is::Value { .. } => None,
        };
        if let Some(inner) = inner {
            inside.insert(entry.key.clone(), inner);
        }
    }
    if !inside.is_empty() {
        json.insert("properties".to_owned(), Json::Object(inside));
    }
    if json.is_empty() {
        return None;
    }
    let json = Json::Object(json);
    // What a preset or another block has need not be there.
    let has = |key: &str| schema.get(key).is_some();
    Some(match (has("preset"), has("without")) {
        (true, true) => {
            let either = json!([{ "required": ["preset"] }, { "required": ["base"] }]);
            json!({ "if": { "anyOf": either }, "else": json })
        }
        (true, false) => json!({ "if": { "required": ["preset"] }, "else": json }),
        (false, _) => json,
    })
}

fn property(entry: &EntrySchema, definitions: &mut Map<String, Json>) -> Json {
    let mut json = match &entry.is {
        Is::Value { of, default } => {
            let mut json = of_type(of, definitions);
            if let Some(default) = default {
                json["default"] = value(default);
            }
            json
        }
        Is::Block(inner) => block(inner, definitions),
        Is::Named(inner) => json!({
            "type": "object",
            "propertyNames": { "pattern": "^[A-Za-z0-9_-]{1,100}$" },
            "additionalProperties": block(inner, definitions),
        }),
        Is::List { of, most, again } => {
            if !again {
                let mut inner = block(of, definitions);
                if let Some(demands) = demands(of) {
                    inner["allOf"] = json!([demands]);
                }
                definitions.insert(entry.key.clone(), inner);
            }
            json!({
                "type": "array",
                "maxItems": most,
                "items": { "$ref": format!("#/definitions/{}", entry.key) },
            })
        }
    };
    json["title"] = json!(title(entry));
    json["description"] = json!(description(entry));
    json
}

/// The key with its unit.
fn title(entry: &EntrySchema) -> String {
    match unit_of(&entry.key) {
        Some(unit) => format!("{} [{unit}]", entry.key),
        None => entry.key.clone(),
    }
}

/// The meaning with range and default.
fn description(entry: &EntrySchema) -> String {
    let mut text = entry.about.to_owned();
    if let Is::Value { of, default } = &entry.is {
        text.push_str(&format!(" Allowed: {}.", of.in_words()));
        if let Some(default) = default {
            text.push_str(&format!(" Default: {}.", default_in_words(default)));
        }
    }
    text
}

fn of_type(of: &Type, definitions: &mut Map<String, Json>) -> Json {
    match of {
        Type::Number(limits) => number(*limits),
        Type::Integer { least, most } => {
            json!({ "type": "integer", "minimum": least, "maximum": most })
        }
        Type::Flag => json!({ "type": "boolean" }),
        Type::Text(_) => json!({ "type": "string" }),
        Type::Word(words) | Type::Name(words, _) => json!({ "enum": words }),
        Type::Tuple(types) => {
            let items: Vec<Json> = types.iter().map(|one| of_type(one, definitions)).collect();
            json!({
                "type": "array",
                "minItems": types.len(),
                "maxItems": types.len(),
                "items": items,
            })
        }
        Type::List {
            of, least, most, ..
        } => json!({
            "type": "array",
            "minItems": least,
            "maxItems": most,
            "items": of_type(of, definitions),
        }),
        Type::Map(of) => json!({
            "type": "object",
            "additionalProperties": of_type(of, definitions),
        }),
        Type::Table(inner) => {
            let mut json = block(inner, definitions);
            if let Some(demands) = demands(inner) {
                json["allOf"] = json!([demands]);
            }
            json
        }
        Type::AnyOf(types, _) => {
            let any: Vec<Json> = types.iter().map(|one| of_type(one, definitions)).collect();
            json!({ "anyOf": any })
        }
    }
}

fn number(limits: Limits) -> Json {
    let [(low, low_included), (high, high_included)] = limits.ends();
    let least = if low_included {
        "minimum"
    } else {
        "exclusiveMinimum"
    };
    let most = if high_included {
        "maximum"
    } else {
        "exclusiveMaximum"
    };
    json!({ "type": "number", least: low, most: high })
}

fn value(value: &Value) -> Json {
    match value {
        Value::Text(text) | Value::Other(_, text) => json!(text),
        Value::Integer(integer) => {
            u64::try_from(*integer).map_or_else(|_| json!(*integer as f64), |whole| json!(whole))
        }
        Value::Number(number) => json!(number),
        Value::Flag(flag) => json!(flag),
        Value::List(nodes) => nodes.iter().map(|node| self::value(&node.value)).collect(),
        Value::Table(table) => {
            let entries = table.0.iter();
            let entries = entries.map(|entry| (entry.key.clone(), self::value(&entry.node.value)));
            Json::Object(entries.collect())
        }
    }
}
