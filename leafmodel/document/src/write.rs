//! A tree as TOML again: what is recorded of a scene with overrides.

use std::fmt::Write;

use super::tree::{Node, Table, Value};

/// The tree as a file that reads back to the same tree; comments are lost.
pub fn to_toml(tree: &Table) -> String {
    let mut text = String::new();
    write_table(&mut text, "", tree);
    text
}

fn write_table(text: &mut String, path: &str, table: &Table) {
    for entry in &table.0 {
        if entry.node.table().is_none() {
            text.push_str(&key(&entry.key));
            text.push_str(" = ");
            write_value(text, &entry.node);
            text.push('\n');
        }
    }
    for entry in &table.0 {
        let Some(inner) = entry.node.table() else {
            continue;
        };
        let dot = if path.is_empty() { "" } else { "." };
        let inner_path = format!("{path}{dot}{}", key(&entry.key));
        let only_blocks =
            !inner.0.is_empty() && inner.0.iter().all(|entry| entry.node.table().is_some());
        if !only_blocks {
            text.extend(["\n[", &inner_path, "]\n"]);
        }
        write_table(text, &inner_path, inner);
    }
}

/// A value as it stands behind `key =`.
pub fn value_to_toml(node: &Node) -> String {
    let mut text = String::new();
    write_value(&mut text, node);
    text
}

fn write_value(text: &mut String, node: &Node) {
    match &node.value {
        Value::Text(value) => text.push_str(&quoted(value)),
        Value::Integer(value) => text.push_str(&value.to_string()),
        // The shortest form that reads back to the same bits, always with a point or an exponent.
        Value::Number(value) => text.push_str(&format!("{value:?}").to_lowercase()),
        Value::Flag(value) => text.push_str(if *value { "true" } else { "false" }),
        Value::Other(_, value) => text.push_str(value),
        Value::List(nodes) => {
            text.push('[');
            for (index, node) in nodes.iter().enumerate() {
                text.push_str(if index == 0 { "" } else { ", " });
                write_value(text, node);
            }
            text.push(']');
        }
        Value::Table(table) => {
            text.push('{');
            for (index, entry) in table.0.iter().enumerate() {
                text.push_str(if index == 0 { " " } else { ", " });
                text.push_str(&key(&entry.key));
                text.push_str(" = ");
                write_value(text, &entry.node);
            }
            text.push_str(" }");
        }
    }
}

fn key(key: &str) -> String {
    let bare = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'_' || byte == b'-';
    if !key.is_empty() && key.bytes().all(bare) {
        key.to_owned()
    } else {
        quoted(key)
    }
}

fn quoted(value: &str) -> String {
    let mut text = String::from("\"");
    for character in value.chars() {
        match character {
            '"' | '\\' => text.extend(['\\', character]),
            _ if character.is_control() => {
                // Writing to a String cannot fail.
                let _ = write!(text, "\\u{:04x}", u32::from(character));
            }
            _ => text.push(character),
        }
    }
    text.push('"');
    text
}

#[cfg(test)]
mod tests {
    use toml::de::DeTable;

    use super::*;

    fn tree(text: &str) -> Table {
        Table::from_toml(
            0,
            DeTable::parse(text)
                .expect("the test's text is TOML")
                .into_inner(),
        )
    }

    #[test]
    fn a_written_tree_reads_back_to_the_same() {
        let text = "a = 1\n'x y' = \"q\\\"\\u001b\"\n[b.c]\n\
                    d = [1.5, -1e-300, [2, {e = true, f = {}}]]\n[b.g.none]\n[h]\n\
                    t = { table = [[1, 2.0]] }\n";
        let written = to_toml(&tree(text));
        assert_eq!(to_toml(&tree(&written)), written);
        for piece in [
            "\"x y\" = \"q\\\"\\u001b\"",
            "[b.g.none]",
            "[h.t]",
            "-1e-300",
            "{ e = true, f = { } }",
        ] {
            assert!(written.contains(piece), "{piece} is not in\n{written}");
        }
    }
}
