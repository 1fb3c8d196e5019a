//! Lists of neighbours: what NEFI writes.
//!
//! A line `(12, 30)|2` names a node by its row and column and says how many lines of neighbours
//! follow, such as `(12, 44)|{'length': 15.1, 'width': 3.2}`.

use super::draft::Draft;
use super::error::ImportError;
use super::fields::{EdgeField, numbers};
use super::graph::{Builder, Text};

/// Reads a list of neighbours.
///
/// # Errors
///
/// [`ImportError`] if a line does not follow the format, or a value cannot be read.
pub(super) fn read(text: &str) -> Result<Draft, ImportError> {
    let mut builder = Builder::new(false);
    let mut node = None;
    let mut left = 0;
    for (number, line) in (1..).zip(text.lines()) {
        let line = line.trim();
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        let place = &|| format!("line {number}");
        let malformed = || {
            let wanted = "is neither (ROW, COLUMN)|COUNT nor (ROW, COLUMN)|{'length': …}";
            let format = "list of neighbours as NEFI writes it";
            ImportError::malformed(format, format!("{} {wanted}", place()))
        };
        let (name, rest) = line.split_once('|').ok_or_else(malformed)?;
        let at = numbers(name)
            .filter(|at| at.len() == 2)
            .ok_or_else(malformed)?;
        let here = builder.node_in_rows([at[0], at[1]]);
        let Some(from) = node.filter(|_| left > 0) else {
            left = rest.trim().parse::<u64>().map_err(|_| malformed())?;
            node = Some(here);
            continue;
        };
        left -= 1;
        builder.edge_between([from, here]);
        let members = rest
            .trim()
            .strip_prefix('{')
            .and_then(|rest| rest.strip_suffix('}'));
        for (key, value) in members.ok_or_else(malformed).map(pairs)? {
            match builder.edge_field(key) {
                Some(EdgeField::End(_) | EdgeField::EndCoordinate(..)) => {
                    builder.ignore("edge", key);
                }
                Some(_) | None => builder.edge_entry(Text { key, value, place })?,
            }
        }
        builder.edge_is_done(place);
    }
    builder.draft.is_y_down = true;
    Ok(builder.done())
}

/// Keys and values of a dictionary as Python prints it, numbers without the names of their types.
fn pairs(members: &str) -> Vec<(&str, &str)> {
    let mut pairs = Vec::new();
    let (mut depth, mut start) = (0_i32, 0);
    let ends = members.char_indices().chain([(members.len(), ',')]);
    for (at, letter) in ends {
        match letter {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth -= 1,
            ',' if depth == 0 || at == members.len() => {
                if let Some((key, value)) = members[start..at].split_once(':') {
                    let key = key.trim().trim_matches(['\'', '"']);
                    let value = value.trim();
                    let bare = value.strip_prefix("np.").and_then(|typed| {
                        let (_, bare) = typed.split_once('(')?;
                        bare.strip_suffix(')')
                    });
                    pairs.push((key, bare.unwrap_or(value)));
                }
                start = at + 1;
            }
            _ => {}
        }
    }
    pairs
}
