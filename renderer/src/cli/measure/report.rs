//! Measures as tables.

use std::fmt::Write as _;

use leafmodel::measure::{Measures, Subject, definition};
use serde_json::{Map, Value, json};

use super::input::Input;
use super::write;
use crate::checkpoint::PROGRAM;
use crate::cli::Failure;
use crate::cli::arguments::MeasureArguments;

/// What is told of a network.
pub(super) struct Report<'a> {
    file: String,
    input: &'a Input,
    pub(super) measures: Measures,
}

impl<'a> Report<'a> {
    pub(super) fn new(arguments: &MeasureArguments, input: &'a Input, subject: &Subject) -> Self {
        Self {
            file: arguments.file.display().to_string(),
            input,
            measures: subject.measures(arguments.murray_exponent),
        }
    }

    /// A row for each number.
    pub(super) fn csv(&self) -> String {
        let mut text = String::from("measure,part,value,unit,definition\n");
        for row in self.measures.rows() {
            let part = row.part.map(|part| part.to_string()).unwrap_or_default();
            let value = row.value.map(|value| value.to_string()).unwrap_or_default();
            let (key, unit, definition) = (row.key, row.unit, quoted(row.definition));
            let _ = writeln!(text, "{key},{part},{value},{unit},{definition}");
        }
        text
    }

    /// The measures as `lamina grow --measure` writes them, and what belongs to them.
    pub(super) fn json(&self) -> String {
        let mut report = self.measures.json();
        let entries = self.measures.entries();
        let of = |value: &dyn Fn(usize) -> Value| {
            let members = entries.iter().enumerate();
            let members = members.map(|(i, entry)| (entry.key.to_owned(), value(i)));
            Value::Object(members.collect::<Map<String, Value>>())
        };
        report["program"] = PROGRAM.into();
        report["file"] = self.file.clone().into();
        report["nodes"] = self.input.network.nodes().len().into();
        report["edges"] = self.input.network.edges().len().into();
        report["faults"] = self.input.faults.iter().map(|fault| {
            let places: Vec<[f64; 2]> = fault.places.iter().map(|p| p.to_array()).collect();
            json!({ "kind": fault.kind.word(), "count": fault.count, "places_mm": places, "message": fault.line() })
        }).collect();
        report["units"] = of(&|i| entries[i].unit.into());
        report["definitions"] = of(&|i| definition(entries[i].key).into());
        format!("{report:#}\n")
    }

    /// The tables that have files of their own.
    pub(super) fn write_tables(&self, arguments: &MeasureArguments) -> Result<(), Failure> {
        let _ = (arguments, write);
        Ok(())
    }
}

/// A field of a table, in quotation marks where it has commas.
fn quoted(field: &str) -> String {
    if field.contains(',') {
        format!("\"{field}\"")
    } else {
        field.to_owned()
    }
}
