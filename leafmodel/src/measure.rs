//! Measures of a leaf's shape and veins as used in biology.
//!
//! - **In**: an [`Outline`]; for veins also a [`VenationNetwork`] and the exponent of Murray's law.
//! - **Out**: [`Measures`]: a list of keys, units and values, which can be written as JSON or as a
//!   table.
//! - **Always true**: no value is NaN or infinite; a measure that does not exist (the median area
//!   without areoles) is missing. The same network gives the same bits on every machine.
//! - **Left out**: pictures of leaves, of which [`crate::tracing`] makes margins and networks.
//!
//! `docs/src/theory/measures.md` defines every measure.
//!
//! ```
//! use leafmodel::measure::measure;
//! use leafmodel::species;
//!
//! let plan = species::find("poplar").ok_or("the poplar is a preset")?.plan();
//! let lamina = plan.grow_lamina()?;
//! let measures = measure(&lamina.outline, &lamina.network, plan.venation.murray_exponent());
//! for key in ["width_over_length", "vein_density_mm_per_mm2", "areoles_per_mm2"] {
//!     let value = measures.number(key).ok_or("a poplar has a blade, veins and areoles")?;
//!     assert!(value > 0.0, "{key} = {value}");
//! }
//! print!("{}", measures.table());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod description;
mod forks;
mod fourier;
mod hierarchy;
mod junctions;
mod margin;
mod nesting;
pub mod projections;
#[cfg(test)]
mod shape_tests;
mod skeleton;
mod spanning;
mod statistics;
#[cfg(test)]
mod tests;

use glam::DVec2;
use serde_json::{Map, Value as Json};

use self::forks::Forks;
use self::hierarchy::Hierarchy;
use self::junctions::Junctions;
use self::skeleton::Skeleton;
use self::statistics::{mean, median, mode, quantile, variation};
use crate::shape::outline::Outline;
use crate::venation::areole::{Areole, Areoles, areoles};
use crate::venation::chance::{Use, uniform};
use crate::venation::network::VenationNetwork;

/// Distance from the margin, in segments, within which a vein counts as ending at the margin, not
/// as a free ending inside the blade.
const MARGIN_SEGMENTS: f64 = 2.0;

/// Number of points of the blade at which the distance to the nearest vein is measured.
const PROBES: usize = 1 << 14;

/// Veins from this order on are minor veins.
const FIRST_MINOR_ORDER: usize = 4;

/// Shares of a distribution that are told.
const PERCENTILES: [f64; 5] = [0.05, 0.25, 0.5, 0.75, 0.95];

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

/// All measures of a leaf.
#[derive(Clone, Debug, PartialEq)]
pub struct Measures {
    entries: Vec<Entry>,
}

/// Measures the shape of a blade.
///
/// \[kuhl1982\] for the elliptic Fourier descriptors; `docs/src/theory/measures.md` defines all.
pub fn shape(outline: &Outline) -> Measures {
    let mut list = List {
        entries: Vec::new(),
        area: outline.area(),
    };
    list.shape(outline);
    Measures {
        entries: list.entries,
    }
}

/// Measures the shape and the veins of a leaf.
///
/// `murray_exponent` is the exponent `n` of `murray_ratio_median`; if it is not finite and above 0,
/// that value is missing. Takes about twice as long as finding the areoles.
pub fn measure(outline: &Outline, network: &VenationNetwork, murray_exponent: f64) -> Measures {
    let found = areoles(network);
    let edges: Vec<[u32; 2]> = found
        .graph()
        .edges()
        .iter()
        .map(|e| [e.from, e.to])
        .collect();
    let skeleton = Skeleton::new(found.graph(), &edges);
    let mut list = List {
        entries: Vec::new(),
        area: outline.area(),
    };
    list.shape(outline);
    list.count("crossing_count", found.graph().crossings());
    list.number("blade_area_mm2", "mm²", Some(outline.area()));
    list.veins(&skeleton);
    list.number("spanning_tree_ratio", "", spanning::ratio(found.chains()));
    list.distances(outline, &found);
    list.areoles(&found);
    list.free_endings(outline, network, &found);
    list.forks(&Forks::new(&skeleton, murray_exponent));
    list.junctions(Junctions::new(&skeleton));
    let nesting = nesting::nesting(&found);
    list.number("loop_nesting", "", nesting.mean);
    list.number("loop_nesting_weighted", "", nesting.weighted);
    list.count("loop_tree_strahler", nesting.strahler as usize);
    list.hierarchy(&Hierarchy::new(&skeleton, outline.base()));
    Measures {
        entries: list.entries,
    }
}

struct List {
    entries: Vec<Entry>,
    area: f64,
}

impl List {
    fn count(&mut self, key: &'static str, value: usize) {
        let (unit, value) = ("", Value::Count(value as u64));
        self.entries.push(Entry { key, unit, value });
    }

    fn number(&mut self, key: &'static str, unit: &'static str, value: Option<f64>) {
        // Adding 0 turns the negative zero of an empty sum into zero.
        let value = Value::Number(value.filter(|v| v.is_finite()).map(|v| v + 0.0));
        self.entries.push(Entry { key, unit, value });
    }

    fn list(&mut self, key: &'static str, unit: &'static str, value: Vec<f64>) {
        let value = Value::List(value);
        self.entries.push(Entry { key, unit, value });
    }

    /// The distribution of some values: 5th, 25th, 50th, 75th and 95th percentile, or nothing
    /// without values.
    fn percentiles(&mut self, key: &'static str, unit: &'static str, values: &mut [f64]) {
        let all = PERCENTILES
            .iter()
            .filter_map(|&share| quantile(values, share));
        let all = all.collect();
        self.list(key, unit, all);
    }

    fn shape(&mut self, outline: &Outline) {
        let (length, perimeter) = (outline.length(), outline.perimeter());
        let extent = margin::extent(outline);
        let round = 4.0 * std::f64::consts::PI * self.area / (perimeter * perimeter);
        let (low, high) = extent.along;
        self.number("length_mm", "mm", Some(length));
        self.number("width_mm", "mm", Some(extent.width));
        self.number("width_over_length", "", Some(extent.width / length));
        self.number("extent_over_length", "", Some((high - low) / length));
        self.number("widest_at", "", Some(extent.widest / length));
        self.number("area_mm2", "mm²", Some(self.area));
        self.number("perimeter_mm", "mm", Some(perimeter));
        self.number("circularity", "", Some(round));
        let solidity = self.area / margin::hull_area(outline);
        self.number("solidity", "", Some(solidity));
        self.list("elliptic_fourier", "", fourier::descriptors(outline));
    }

    fn veins(&mut self, skeleton: &Skeleton) {
        let lengths = skeleton.lengths_by_order();
        let total: f64 = lengths.iter().sum();
        let minor: f64 = lengths.iter().skip(FIRST_MINOR_ORDER - 1).sum();
        self.number("vein_length_mm", "mm", Some(total));
        self.number("vein_density_mm_per_mm2", "mm/mm²", Some(total / self.area));
        let by_order = lengths.iter().map(|length| length / self.area).collect();
        self.list("vein_density_mm_per_mm2_by_order", "mm/mm²", by_order);
        self.number(
            "minor_vein_share",
            "",
            (total > 0.0).then_some(minor / total),
        );
    }

    fn distances(&mut self, outline: &Outline, found: &Areoles) {
        let (low, high) = outline.bounds();
        let probe = |i: u64| {
            let share = DVec2::new(uniform(0, Use::ProbeX, i), uniform(0, Use::ProbeY, i));
            low + share * (high - low)
        };
        // A blade that fills very little of its rectangle is measured at fewer points.
        let mut distances: Vec<f64> = (0..64 * PROBES as u64)
            .map(probe)
            .filter(|&p| outline.contains(p))
            .take(PROBES)
            .filter_map(|p| found.graph().distance_to_vein(p))
            .collect();
        self.number("vein_distance_mm_mean", "mm", mean(&distances));
        self.number("vein_distance_mm_mode", "mm", mode(&distances));
        self.number("vein_distance_mm_median", "mm", median(&mut distances));
    }

    fn areoles(&mut self, found: &Areoles) {
        let mut areas: Vec<f64> = found.iter().map(|a| a.area_mm2).collect();
        let mut round: Vec<f64> = found.iter().map(Areole::circularity).collect();
        let mut long: Vec<f64> = found.iter().map(|a| a.elongation).collect();
        self.count("areole_count", found.len());
        self.number(
            "areoles_per_mm2",
            "1/mm²",
            Some(found.len() as f64 / self.area),
        );
        self.number("areole_area_mm2_mean", "mm²", mean(&areas));
        self.number("areole_area_cv", "", variation(&areas));
        self.number("areole_area_mm2_median", "mm²", median(&mut areas));
        self.number("areole_circularity_mean", "", mean(&round));
        self.number("areole_circularity_median", "", median(&mut round));
        self.number("areole_elongation_median", "", median(&mut long));
        self.percentiles("areole_area_mm2_percentiles", "mm²", &mut areas);
        self.percentiles("areole_circularity_percentiles", "", &mut round);
        self.percentiles("areole_elongation_percentiles", "", &mut long);
    }

    fn free_endings(&mut self, outline: &Outline, network: &VenationNetwork, found: &Areoles) {
        let margin = MARGIN_SEGMENTS * network.segment_mm();
        let free: Vec<_> = found
            .free_endings()
            .filter(|f| f.areole.is_some() || outline.distance_to_margin(f.tip) > margin)
            .collect();
        let lengths: Vec<f64> = free.iter().map(|f| f.length_mm).collect();
        let inside = free.iter().filter(|f| f.areole.is_some()).count();
        let per_areole = (!found.is_empty()).then(|| inside as f64 / found.len() as f64);
        self.count("freely_ending_veinlet_count", free.len());
        let density = free.len() as f64 / self.area;
        self.number("freely_ending_veinlets_per_mm2", "1/mm²", Some(density));
        self.number("freely_ending_veinlets_per_areole", "", per_areole);
        self.number("freely_ending_veinlet_length_mm_mean", "mm", mean(&lengths));
    }

    fn forks(&mut self, forks: &Forks) {
        self.count("junction_count", forks.junctions);
        self.number("junction_degree_3_share", "", forks.degree_3_share);
        self.number("branching_angle_deg_median", "°", forks.angle_deg);
        self.number("branching_wide_deflection_deg_median", "°", forks.wide_deg);
        self.number("branching_fine_deflection_deg_median", "°", forks.fine_deg);
        self.number("murray_ratio_median", "", forks.murray_ratio);
        self.number("murray_exponent_median", "", forks.murray_exponent);
    }

    fn junctions(&mut self, found: Junctions) {
        self.list("junction_degree_shares", "", found.degree_shares);
        self.number("junction_bent_share", "", found.bent_share);
        let angle = found.largest_angle_deg;
        self.number("junction_largest_angle_deg_median", "°", angle);
        self.entries.push(Entry {
            key: "murray_exponent_by_order",
            unit: "",
            value: Value::Orders(found.exponents),
        });
    }

    fn hierarchy(&mut self, veins: &Hierarchy) {
        self.number("midrib_length_mm", "mm", veins.midrib_mm);
        self.count("secondary_vein_count_left", veins.left);
        self.count("secondary_vein_count_right", veins.right);
        self.number("secondary_spacing_mm_mean", "mm", veins.spacing_mm);
        self.number("secondary_spacing_cv", "", veins.spacing_cv);
        self.number("secondary_angle_deg_mean", "°", veins.secondary_deg);
        self.number("tertiary_angle_deg_mean", "°", veins.tertiary_deg);
    }
}

impl Measures {
    /// All measures, in the order of tables.
    pub fn entries(&self) -> &[Entry] {
        &self.entries
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
