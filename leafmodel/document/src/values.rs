//! Single values of the file: their type and range checked, every error noted at its place.

use super::context::{Context, QUOTED};
use super::error::DocumentError;
use super::limits::Limits;
use super::source::{Place, escaped};
use super::tree::{Node, Value};

/// Names as a sentence lists them; a long list is cut.
pub fn listed<'n>(names: impl IntoIterator<Item = &'n str>) -> String {
    const MOST: usize = 20;
    let mut text = String::new();
    for (index, name) in names.into_iter().enumerate() {
        if index == MOST {
            text.push_str(", …");
            break;
        }
        if index > 0 {
            text.push_str(", ");
        }
        text.push('`');
        text.push_str(&escaped(name, QUOTED));
        text.push('`');
    }
    text
}

/// A sum as it is told, without the rounding of its summands.
pub fn rounded(sum: f64) -> f64 {
    (1e9 * sum).round() / 1e9
}

/// Reports a value of another type.
pub fn wrong_type(cx: &Context, node: &Node, key: &str, wanted: &str) {
    let written = cx.quoted(node);
    let help = match &node.value {
        Value::Text(text) if text.parse::<f64>().is_ok() && wanted.contains("number") => {
            format!("leave the quotes out: {}", escaped(text, QUOTED))
        }
        Value::Number(value) if wanted.contains("integer") => {
            format!("round it: {}", value.round())
        }
        Value::Integer(_) | Value::Number(_) | Value::Flag(_) | Value::Other(..)
            if wanted.contains("text") =>
        {
            format!("put it in quotes: \"{written}\"")
        }
        Value::Text(_)
        | Value::Integer(_)
        | Value::Number(_)
        | Value::Flag(_)
        | Value::Other(..)
        | Value::List(_)
        | Value::Table(_) => format!("write {wanted}"),
    };
    let error = DocumentError::WrongType {
        key: key.to_owned(),
        found: node.value.kind().to_owned(),
        wanted: wanted.to_owned(),
        help,
    };
    cx.error(&node.at, error);
}

/// Reports a list, or a table of a spectrum, that is too short or too long.
pub fn wrong_length(cx: &Context, at: &Place, key: &str, found: &str, length: usize, wanted: &str) {
    let error = DocumentError::WrongType {
        key: key.to_owned(),
        found: format!("{found} of {length}"),
        wanted: wanted.to_owned(),
        help: format!("write {wanted}"),
    };
    cx.error(at, error);
}

/// A finite number, whatever its size.
pub fn finite_at(cx: &Context, node: &Node, key: &str, wanted: &str) -> Option<f64> {
    let value = match node.value {
        Value::Integer(value) => value as f64,
        Value::Number(value) => value,
        Value::Text(_) | Value::Flag(_) | Value::Other(..) | Value::List(_) | Value::Table(_) => {
            wrong_type(cx, node, key, wanted);
            return None;
        }
    };
    if value.is_finite() {
        return Some(value);
    }
    let error = DocumentError::NotFinite {
        key: key.to_owned(),
        value: cx.quoted(node),
    };
    cx.error(&node.at, error);
    None
}

/// A number in its range.
pub fn number_at(cx: &Context, node: &Node, key: &str, limits: Limits) -> Option<f64> {
    let value = finite_at(cx, node, key, "a number")?;
    if limits.contain(value) {
        return Some(value);
    }
    let error = DocumentError::OutOfRange {
        key: key.to_owned(),
        value: cx.quoted(node),
        range: limits.to_string(),
        help: limits.advice(value),
    };
    cx.error(&node.at, error);
    None
}

/// A list of exactly `N` numbers in their range.
pub fn numbers_at<const N: usize>(
    cx: &Context,
    node: &Node,
    key: &str,
    limits: Limits,
) -> Option<[f64; N]> {
    let wanted = format!("a list of {N} numbers");
    let Value::List(list) = &node.value else {
        wrong_type(cx, node, key, &wanted);
        return None;
    };
    if list.len() != N {
        wrong_length(cx, &node.at, key, "a list", list.len(), &wanted);
        return None;
    }
    let mut values = [Some(0.0); N];
    for (value, node) in values.iter_mut().zip(list) {
        *value = number_at(cx, node, key, limits);
    }
    values
        .iter()
        .all(Option::is_some)
        .then(|| values.map(Option::unwrap_or_default))
}

/// An integer in its range.
pub fn integer_at(cx: &Context, node: &Node, key: &str, low: u64, high: u64) -> Option<u64> {
    let value = match &node.value {
        Value::Integer(value) => *value,
        Value::Other(_, text) if !text.contains(['-', ':']) => i128::MAX,
        Value::Number(value) if !value.is_finite() => {
            finite_at(cx, node, key, "an integer");
            return None;
        }
        Value::Number(_)
        | Value::Text(_)
        | Value::Flag(_)
        | Value::Other(..)
        | Value::List(_)
        | Value::Table(_) => {
            wrong_type(cx, node, key, "an integer");
            return None;
        }
    };
    match u64::try_from(value) {
        Ok(value) if (low..=high).contains(&value) => return Some(value),
        Ok(_) | Err(_) => {}
    }
    let error = DocumentError::OutOfRange {
        key: key.to_owned(),
        value: cx.quoted(node),
        range: format!("{low} to {high}"),
        help: if value < i128::from(low) {
            format!("the least allowed value is {low}")
        } else {
            format!("the greatest allowed value is {high}")
        },
    };
    cx.error(&node.at, error);
    None
}

/// A list of exactly `N` integers in their range.
pub fn integers_at<const N: usize>(
    cx: &Context,
    node: &Node,
    key: &str,
    low: u64,
    high: u64,
) -> Option<[u64; N]> {
    let wanted = format!("a list of {N} integers");
    match &node.value {
        Value::List(list) if list.len() != N => {
            wrong_length(cx, &node.at, key, "a list", list.len(), &wanted);
            None
        }
        Value::List(list) => {
            let mut values = [Some(0); N];
            for (value, node) in values.iter_mut().zip(list) {
                *value = integer_at(cx, node, key, low, high);
            }
            values
                .iter()
                .all(Option::is_some)
                .then(|| values.map(Option::unwrap_or_default))
        }
        Value::Text(_)
        | Value::Integer(_)
        | Value::Number(_)
        | Value::Flag(_)
        | Value::Other(..)
        | Value::Table(_) => {
            wrong_type(cx, node, key, &wanted);
            None
        }
    }
}

/// Text.
pub fn text_at<'a>(cx: &Context, node: &'a Node, key: &str) -> Option<(&'a str, &'a Place)> {
    if let Value::Text(text) = &node.value {
        Some((text, &node.at))
    } else {
        wrong_type(cx, node, key, "text in quotes");
        None
    }
}

/// A number as one would write it: without a point if it is whole.
pub fn number(value: f64) -> Value {
    // Every whole number so small is exact either way.
    if value.fract() == 0.0 && value.abs() < 1e15 && !(value == 0.0 && value.is_sign_negative()) {
        Value::Integer(value as i128)
    } else {
        Value::Number(value)
    }
}

/// A list that stands nowhere in a file yet.
pub fn list(values: impl IntoIterator<Item = Value>) -> Value {
    Value::List(values.into_iter().map(Node::unplaced).collect())
}
