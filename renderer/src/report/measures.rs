//! Measures of a network: words, CSV and JSON.

use std::fmt::Write as _;

use glam::DVec2;
use leafmodel::import::Fault;
use leafmodel::measure::{
    Entry, Interval, Known, Measures, OrderRow, Row, Structure, Subject, Supply, definition,
};
use leafmodel::venation::network::VenationNetwork;
use serde_json::{Map, Value, json};

use super::table::{Table, cell};
use crate::checkpoint::PROGRAM;

/// What is measured beside the shape, and how.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wanted {
    /// Pair statistics of areoles.
    pub(crate) structure: bool,
    /// What cuts cost, of so many veins.
    pub(crate) supply: Option<usize>,
    /// Exponent of Murray's law.
    pub(crate) murray_exponent: f64,
}

/// All measures of a network, and the pair statistics and the supply that are among them.
pub(crate) fn measured(
    subject: &Subject,
    wanted: Wanted,
) -> (Measures, Option<Structure>, Option<Supply>) {
    let structure = wanted.structure.then(|| subject.structure()).flatten();
    let supply = wanted.supply.and_then(|cut| subject.supply(cut));
    let measures = subject
        .measures(wanted.murray_exponent)
        .and(subject.more_measures(structure.as_ref(), supply.as_ref()));
    (measures, structure, supply)
}

/// What the veins of each order cost, as rows of a table; radii count only where they are known.
pub(crate) fn by_order(subject: &Subject, known: Known) -> Vec<Row> {
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

/// What is measured of a network from a file.
pub(crate) struct Report<'a> {
    /// The file, as it was named.
    pub(crate) file: String,
    pub(crate) network: &'a VenationNetwork,
    pub(crate) known: Known,
    pub(crate) faults: &'a [Fault],
    pub(crate) subject: &'a Subject<'a>,
    pub(crate) measures: Measures,
    pub(crate) structure: Option<Structure>,
    pub(crate) supply: Option<Supply>,
    pub(crate) intervals: Vec<Interval>,
}

impl Report<'_> {
    fn entries(&self) -> impl Iterator<Item = &Entry> {
        self.measures.entries().iter()
    }

    fn interval(&self, key: &str) -> Option<&Interval> {
        self.intervals.iter().find(|interval| interval.key == key)
    }

    /// All measures for a person.
    pub(crate) fn table(&self) -> String {
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
    pub(crate) fn csv(&self) -> String {
        let mut table = Table::new("measure,part,value,low,high,unit,definition");
        let mut add = |row: &Row, interval: Option<&Interval>| {
            table.row([
                row.key,
                &cell(row.part),
                &cell(row.value),
                &cell(interval.map(|interval| interval.low)),
                &cell(interval.map(|interval| interval.high)),
                row.unit,
                row.definition,
            ]);
        };
        for row in self.measures.rows() {
            add(&row, self.interval(row.key));
        }
        for row in by_order(self.subject, self.known) {
            add(&row, None);
        }
        table.text()
    }

    /// The measures as `lamina grow --measure` writes them, and what belongs to them.
    pub(crate) fn json(&self) -> String {
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
        let (known, network) = (self.known, self.network);
        let faults = self.faults.iter().map(|fault| {
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

    /// The structure factor, a row for each bin.
    pub(crate) fn structure_table(&self) -> String {
        let mut table = Table::new("k_rad_per_mm,structure_factor,error,wavevectors");
        for bin in self.structure.iter().flat_map(|found| &found.bins) {
            let numbers = [bin.k_per_mm, bin.value, bin.error].map(|number| number.to_string());
            table.row(numbers.into_iter().chain([bin.wavevectors.to_string()]));
        }
        table.text()
    }

    /// The tree of loops, a row for each that two others make.
    pub(crate) fn loops(&self) -> String {
        let mut table = Table::new("loop,first,second,areoles,strahler,radius_mm");
        let areoles = self.subject.areoles().len();
        for (merge, number) in self.subject.loop_tree().iter().zip(areoles..) {
            let [first, second] = merge.branches.map(|branch| branch.to_string());
            let [areoles, strahler] = [merge.areoles.to_string(), merge.strahler.to_string()];
            let radius = merge.radius_mm.to_string();
            table.row([number.to_string(), first, second, areoles, strahler, radius]);
        }
        table.text()
    }

    /// What is lost by each vein that is cut.
    pub(crate) fn cuts(&self) -> String {
        let mut table =
            Table::new("x_mm,y_mm,order,radius_mm,length_mm,cut_off_share,conductance_lost");
        for cut in self.supply.iter().flat_map(|found| &found.cuts) {
            let order = cell(Some(cut.order).filter(|_| self.known.orders));
            let numbers = [cut.radius_mm, cut.length_mm, cut.cut_off, cut.lost];
            let place = cut.place.to_array().map(|length| length.to_string());
            let rest = numbers.map(|number| number.to_string());
            table.row(place.into_iter().chain([order]).chain(rest));
        }
        table.text()
    }

    /// A row for each single value.
    pub(crate) fn samples(&self) -> String {
        let mut table = Table::new("kind,order,value,unit,x_mm,y_mm");
        for sample in self.subject.distributions() {
            table.row([
                sample.kind,
                &cell(sample.order),
                &sample.value.to_string(),
                sample.unit,
                &sample.place.x.to_string(),
                &sample.place.y.to_string(),
            ]);
        }
        table.text()
    }
}
