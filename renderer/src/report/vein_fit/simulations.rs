//! The leaves that a fit has grown, as a table that reads back to the same.

use std::collections::BTreeMap;

use leafmodel::document::rows::{Decimal, Form, Rows, Separator};
use leafmodel::inference::{Draw, Outcome, Problem};

use crate::report::table::{Table, cell};

/// Simulations by generation and number.
pub(crate) type Grown = BTreeMap<(u32, u32), (Draw, Outcome)>;

/// The table of a fit of this identity.
pub(crate) fn table(grown: &Grown, identity: &str, problem: &Problem) -> String {
    let mut table = Table::of(header(problem));
    // All digits, and a point.
    let exact = |value: &f64| format!("{value:?}");
    for (draw, outcome) in grown.values() {
        let numbers = [draw.generation.into(), draw.number.into(), draw.seed];
        let mut cells = vec![identity.to_owned()];
        cells.extend(numbers.map(|number: u64| number.to_string()));
        cells.extend(draw.values.iter().map(exact));
        match outcome {
            Ok(measures) => {
                cells.extend(measures.iter().map(|value| cell(value.as_ref().map(exact))));
                cells.push(String::new());
            }
            Err(why) => {
                cells.extend(problem.observed().iter().map(|_| String::new()));
                cells.push(why.clone());
            }
        }
        table.row(cells);
    }
    table.text()
}

/// The simulations in the table of a fit; `None` if it is of another fit. Rows that are damaged count as none.
pub(crate) fn read(text: &str, identity: &str, problem: &Problem) -> Option<Grown> {
    let form = Form {
        separator: Some(Separator::Comma),
        decimal: Some(Decimal::Point),
    };
    let table = Rows::written(text, form);
    let mut rows = table.of_any_length().map(|row| {
        let texts = row.fields.into_iter().map(|field| field.text);
        texts.collect::<Vec<String>>()
    });
    let header = header(problem);
    if rows.next().as_ref() != Some(&header) {
        return None;
    }
    let mut grown = Grown::new();
    for row in rows {
        if row.first().map(String::as_str) != Some(identity) {
            return None;
        }
        if let Some((draw, outcome)) = simulation(&row, header.len(), problem) {
            grown.insert(place(&draw), (draw, outcome));
        }
    }
    Some(grown)
}

/// The key of a simulation.
pub(crate) fn place(draw: &Draw) -> (u32, u32) {
    (draw.generation, draw.number)
}

/// `fit` (which one), `generation`, `number`, `seed`, the free keys, the measures, and why a leaf
/// failed.
fn header(problem: &Problem) -> Vec<String> {
    let first = ["fit", "generation", "number", "seed"].map(str::to_owned);
    let keys = problem.parameters().iter().map(|one| one.name().to_owned());
    let measures = problem.observed().iter().map(|one| one.key.clone());
    let all = first.into_iter().chain(keys).chain(measures);
    all.chain(["failed".to_owned()]).collect()
}

fn simulation(row: &[String], cells: usize, problem: &Problem) -> Option<(Draw, Outcome)> {
    if row.len() != cells {
        return None;
    }
    let measures_from = 4 + problem.parameters().len();
    let values = (4..measures_from).map(|cell| row[cell].parse::<f64>().ok());
    let draw = Draw {
        generation: row[1].parse().ok()?,
        number: row[2].parse().ok()?,
        seed: row[3].parse().ok()?,
        values: values.collect::<Option<_>>()?,
    };
    let failed = &row[cells - 1];
    if !failed.is_empty() {
        return Some((draw, Err(failed.clone())));
    }
    let measures = (measures_from..cells - 1).map(|cell| match row[cell].as_str() {
        "" => Some(None),
        text => text.parse::<f64>().ok().map(Some),
    });
    let measures: Option<Vec<Option<f64>>> = measures.collect();
    Some((draw, Ok(measures?)))
}
