//! Measures with their keys and units, and how they are written.

use serde_json::{Map, Value as Json};

use super::definitions::definition;

/// Greatest number of entries of a list that a table shows.
const LONGEST_LIST: usize = 12;

/// A measured value.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A count.
    Count(u64),
    /// A finite number, or `None` where the leaf has nothing to measure.
    Number(Option<f64>),
    /// Several numbers that belong together: one per vein order, from order 1, or the coefficients
    /// of a series.
    List(Vec<f64>),
    /// One number per vein order, from order 1; `None` where an order has nothing to measure.
    Orders(Vec<Option<f64>>),
}

/// One measure of a leaf.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Its key, which includes the unit.
    pub key: &'static str,
    /// The unit for tables, empty for pure numbers.
    pub unit: &'static str,
    /// The value.
    pub value: Value,
}

/// One number of a table of measures.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The measure's key.
    pub key: &'static str,
    /// Which part of a list, from 1: the vein order, the percentile, the coefficient.
    pub part: Option<usize>,
    /// The value, if there is one.
    pub value: Option<f64>,
    /// Its unit, empty for pure numbers.
    pub unit: &'static str,
    /// What it is, in one phrase.
    pub definition: &'static str,
}

/// All measures of a leaf.
#[derive(Clone, Debug, PartialEq)]
pub struct Measures {
    pub(super) entries: Vec<Entry>,
}

impl Measures {
    /// All measures, in the order of tables.
    pub fn entries(&self) -> &[Entry] {
        &self.entries
    }

    /// These measures, and others behind them.
    pub fn and(mut self, others: Self) -> Self {
        self.entries.extend(others.entries);
        self
    }

    /// The number with a key; `None` if there is no such key or nothing to measure.
    pub fn number(&self, key: &str) -> Option<f64> {
        let entry = self.entries.iter().find(|entry| entry.key == key)?;
        match &entry.value {
            Value::Count(count) => Some(*count as f64),
            Value::Number(number) => *number,
            Value::List(_) | Value::Orders(_) => None,
        }
    }

    /// A table with a row for each number: `measure`, `part`, `value`, `unit`, `definition`. A list
    /// has a row for each of its parts, which are numbered from 1; a missing value is an empty field.
    pub fn rows(&self) -> Vec<Row> {
        let row = |entry: &Entry, part: Option<usize>, value: Option<f64>| Row {
            key: entry.key,
            part,
            value,
            unit: entry.unit,
            definition: definition(entry.key),
        };
        let mut rows = Vec::new();
        for entry in &self.entries {
            match &entry.value {
                Value::Count(count) => rows.push(row(entry, None, Some(*count as f64))),
                Value::Number(number) => rows.push(row(entry, None, *number)),
                Value::List(list) => {
                    let parts = list.iter().zip(1..);
                    rows.extend(parts.map(|(value, part)| row(entry, Some(part), Some(*value))));
                }
                Value::Orders(list) => {
                    let parts = list.iter().zip(1..);
                    rows.extend(parts.map(|(value, part)| row(entry, Some(part), *value)));
                }
            }
        }
        rows
    }

    /// A JSON object with one member per measure: a number, `null`, or an array.
    pub fn json(&self) -> Json {
        let value = |entry: &Entry| match &entry.value {
            Value::Count(count) => Json::from(*count),
            Value::Number(number) => Json::from(*number),
            Value::List(list) => Json::from(list.clone()),
            Value::Orders(list) => Json::from(list.clone()),
        };
        let members = self
            .entries
            .iter()
            .map(|entry| (entry.key.to_owned(), value(entry)));
        Json::Object(members.collect::<Map<String, Json>>())
    }

    /// Lines of key, value and unit, in columns. Values have four digits; a missing value is a
    /// dash; long lists are cut short.
    pub fn table(&self) -> String {
        let listed = |list: &mut dyn Iterator<Item = Option<f64>>| {
            let missing = || "–".to_owned();
            let mut parts: Vec<String> = list
                .take(LONGEST_LIST + 1)
                .map(|number| number.map_or_else(missing, four_digits))
                .collect();
            if parts.len() > LONGEST_LIST {
                "…".clone_into(&mut parts[LONGEST_LIST]);
            }
            parts.join(" ")
        };
        let text = |value: &Value| match value {
            Value::Count(count) => count.to_string(),
            Value::Number(None) => "–".to_owned(),
            Value::Number(Some(number)) => four_digits(*number),
            Value::List(list) => listed(&mut list.iter().copied().map(Some)),
            Value::Orders(list) => listed(&mut list.iter().copied()),
        };
        let wide = self.entries.iter().map(|e| e.key.len()).max().unwrap_or(0);
        let lines = self.entries.iter().map(|entry| {
            let line = format!("{:wide$}  {} {}", entry.key, text(&entry.value), entry.unit);
            format!("{}\n", line.trim_end())
        });
        lines.collect()
    }
}

/// A number with four significant digits; digits before the decimal point are never dropped.
fn four_digits(number: f64) -> String {
    let (mut digits, mut shifted) = (0, number.abs());
    while shifted < 1000.0 && digits < 8 && number != 0.0 {
        shifted *= 10.0;
        digits += 1;
    }
    format!("{number:.digits$}")
}
