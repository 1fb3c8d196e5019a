//! Measures as tables.

use std::fmt::Write as _;

use glam::DVec2;
use leafmodel::measure::{
    Entry, Interval, Known, Measures, OrderRow, Row, Sample, Structure, Subject, Supply, definition,
};
use serde_json::{Map, Value, json};

use super::input::Input;
use super::write;
use crate::checkpoint::PROGRAM;
use crate::cli::Failure;
use crate::cli::arguments::{MeasureArguments, MeasuringArguments};

/// All measures of a network; pair statistics and supply where they are asked for, or all are.
pub(in crate::cli) fn measured(
    subject: &Subject,
    arguments: &MeasuringArguments,
    [asks_structure, asks_supply]: [bool; 2],
) -> (Measures, Option<Structure>, Option<Supply>) {
    let structure = (!arguments.quick || asks_structure)
        .then(|| subject.structure())
        .flatten();
    let supply = (!arguments.quick || asks_supply)
        .then(|| subject.supply(arguments.cut as usize))
        .flatten();
    let measures = subject
        .measures(arguments.murray_exponent)
        .and(subject.more_measures(structure.as_ref(), supply.as_ref()));
    (measures, structure, supply)
}

/// What the veins of each order cost, as rows of a table; radii count only where they are known.
pub(in crate::cli) fn by_order(subject: &Subject, known: Known) -> Vec<Row> {
    let rows = |row: OrderRow| {
        let wide = |value: f64| Some(value).filter(|_| known.radii);
        let part = Some(usize::from(row.order)).filter(|order| *order > 0);
        let columns = [
            ("order_vein_length", "mm", Some(row.length_mm)),
            ("order_vein_width", "mm", wide(row.width_mm)),
            ("order_vein_surface", "mm²", wide(row.surface_mm2)),
            ("order_vein_volume", "mm³", wide(row.volume_mm3)),
        ];
        columns.map(|(key, unit, value)| Row {
            key,
            part,
            value,
            unit,
            definition: definition(key),
        })
    };
    subject.by_order().into_iter().flat_map(rows).collect()
}

/// What is told of a network.
pub(super) struct Report<'a> {
    file: String,
    input: &'a Input,
    subject: &'a Subject<'a>,
    measures: Measures,
    structure: Option<Structure>,
    supply: Option<Supply>,
    intervals: Vec<Interval>,
}

impl<'a> Report<'a> {
    /// A measure that is a number.
    pub(super) fn number(&self, key: &str) -> Option<f64> {
        self.measures.number(key)
    }

    pub(super) fn new(
        arguments: &MeasureArguments,
        input: &'a Input,
        subject: &'a Subject<'a>,
    ) -> Self {
        let asked = [&arguments.structure_factor, &arguments.cuts].map(Option::is_some);
        let (measures, structure, supply) = measured(subject, &arguments.measuring, asked);
        Self {
            file: arguments.file.display().to_string(),
            input,
            subject,
            measures,
            structure,
            supply,
            intervals: subject.confidence(arguments.bootstrap, arguments.seed),
        }
    }

    fn entries(&self) -> impl Iterator<Item = &Entry> {
        self.measures.entries().iter()
    }

    fn interval(&self, key: &str) -> Option<&Interval> {
        self.intervals.iter().find(|interval| interval.key == key)
    }

    /// All measures for a person.
    pub(super) fn table(&self) -> String {
        let mut text = self.measures.table();
        for interval in &self.intervals {
            let Interval { key, low, high, .. } = interval;
            let _ = writeln!(
                text,
                "{key}: 95 % of the draws lie from {low:.4} to {high:.4}"
            );
        }
        text
    }

    /// A row for each number: measures, and what veins of each order cost.
    pub(super) fn csv(&self) -> String {
        let mut text = String::from("measure,part,value,low,high,unit,definition\n");
        let mut add = |row: &Row, interval: Option<&Interval>| {
            let part = row.part.map(|part| part.to_string()).unwrap_or_default();
            let of = |value: Option<f64>| value.map(|value| value.to_string()).unwrap_or_default();
            let (low, high) = (interval.map(|i| i.low), interval.map(|i| i.high));
            let _ = writeln!(
                text,
                "{},{part},{},{},{},{},{}",
                row.key,
                of(row.value),
                of(low),
                of(high),
                row.unit,
                quoted(row.definition)
            );
        };
        for row in self.measures.rows() {
            add(&row, self.interval(row.key));
        }
        for row in by_order(self.subject, self.input.known) {
            add(&row, None);
        }
        text
    }

    /// The measures as `lamina grow --measure` writes them, and what belongs to them.
    pub(super) fn json(&self) -> String {
        let mut report = Map::new();
        if let Value::Object(members) = self.measures.json() {
            report.extend(members);
        }
        let of = |value: &dyn Fn(&Entry) -> Value| {
            let members = self
                .entries()
                .map(|entry| (entry.key.to_owned(), value(entry)));
            Value::Object(members.collect())
        };
        let (known, network) = (self.input.known, &self.input.network);
        let faults = self.input.faults.iter().map(|fault| {
            let places: Vec<[f64; 2]> = fault.places.iter().map(DVec2::to_array).collect();
            json!({
                "kind": fault.kind.word(),
                "count": fault.count,
                "places_mm": places,
                "message": fault.line(),
            })
        });
        let orders = self.subject.by_order().into_iter().map(|row| {
            let wide = |value: f64| known.radii.then_some(value);
            json!({
                "order": Some(row.order).filter(|order| *order > 0),
                "length_mm": row.length_mm,
                "width_mm": wide(row.width_mm),
                "surface_mm2": wide(row.surface_mm2),
                "volume_mm3": wide(row.volume_mm3),
            })
        });
        let intervals = self.intervals.iter().map(|interval| {
            let body =
                json!({ "low": interval.low, "high": interval.high, "error": interval.error });
            (interval.key.to_owned(), body)
        });
        let window = self
            .structure
            .as_ref()
            .map(|found| [found.window.0.to_array(), found.window.1.to_array()]);
        let more = [
            ("by_order", orders.collect()),
            ("confidence_95", Value::Object(intervals.collect())),
            ("centroid_window_mm", json!(window)),
            ("faults", faults.collect()),
            ("units", of(&|entry| entry.unit.into())),
            ("definitions", of(&|entry| definition(entry.key).into())),
            ("file", self.file.clone().into()),
            ("nodes", network.nodes().len().into()),
            ("edges", network.edges().len().into()),
            ("program", PROGRAM.into()),
        ];
        report.extend(more.map(|(key, value)| (key.to_owned(), value)));
        format!("{:#}\n", Value::Object(report))
    }

    /// The tables that have files of their own.
    pub(super) fn write_tables(&self, arguments: &MeasureArguments) -> Result<(), Failure> {
        if let Some(path) = &arguments.distributions {
            write(path, &samples(&self.subject.distributions()))?;
        }
        if let Some(path) = &arguments.structure_factor {
            write(path, &self.structure_table())?;
        }
        if let Some(path) = &arguments.loop_tree {
            write(path, &self.loops())?;
        }
        if let Some(path) = &arguments.cuts {
            write(path, &self.cuts())?;
        }
        Ok(())
    }

    fn structure_table(&self) -> String {
        let mut text = String::from("k_rad_per_mm,structure_factor,error,wavevectors\n");
        for bin in self.structure.iter().flat_map(|found| &found.bins) {
            let _ = writeln!(
                text,
                "{},{},{},{}",
                bin.k_per_mm, bin.value, bin.error, bin.wavevectors
            );
        }
        text
    }

    fn loops(&self) -> String {
        let areoles = self.subject.areoles().len();
        let mut text = String::from("loop,first,second,areoles,strahler,radius_mm\n");
        for (merge, number) in self.subject.loop_tree().iter().zip(areoles..) {
            let [first, second] = merge.branches;
            let _ = writeln!(
                text,
                "{number},{first},{second},{},{},{}",
                merge.areoles, merge.strahler, merge.radius_mm
            );
        }
        text
    }

    fn cuts(&self) -> String {
        let mut text =
            String::from("x_mm,y_mm,order,radius_mm,length_mm,cut_off_share,conductance_lost\n");
        for cut in self.supply.iter().flat_map(|found| &found.cuts) {
            let order = if self.input.known.orders {
                cut.order.to_string()
            } else {
                String::new()
            };
            let _ = writeln!(
                text,
                "{},{},{order},{},{},{},{}",
                cut.place.x, cut.place.y, cut.radius_mm, cut.length_mm, cut.cut_off, cut.lost
            );
        }
        text
    }
}

/// A row for each value.
fn samples(samples: &[Sample]) -> String {
    let mut text = String::from("kind,order,value,unit,x_mm,y_mm\n");
    for sample in samples {
        let order = sample
            .order
            .map(|order| order.to_string())
            .unwrap_or_default();
        let _ = writeln!(
            text,
            "{},{order},{},{},{},{}",
            sample.kind, sample.value, sample.unit, sample.place.x, sample.place.y
        );
    }
    text
}

/// A field of a table, in quotation marks where it has commas.
fn quoted(field: &str) -> String {
    if field.contains(',') {
        format!("\"{field}\"")
    } else {
        field.to_owned()
    }
}
