//! The leaves that are compared: their measures and single values.

use leafmodel::measure::{Known, Row, Sample};
use leafmodel::shape::outline::Outline;
use leafmodel::venation::network::VenationNetwork;

/// Numbers that are no measures of their own: coefficients that mean something together only, what
/// the curves of distributions show in full, and an error.
pub(crate) const LEFT_OUT: [&str; 5] = [
    "elliptic_fourier",
    "areole_area_mm2_percentiles",
    "areole_circularity_percentiles",
    "areole_elongation_percentiles",
    "hyperuniformity_exponent_error",
];

/// A leaf with its measures.
#[derive(Clone, Debug)]
pub(crate) struct Leaf {
    pub(crate) name: String,
    /// Its group, by number.
    pub(crate) group: usize,
    /// The file or the plan, as named.
    pub(crate) given: String,
    pub(crate) nodes: usize,
    pub(crate) edges: usize,
    pub(crate) areoles: usize,
    pub(crate) area_mm2: Option<f64>,
    /// A row for each measure that is compared.
    pub(crate) rows: Vec<Row>,
    pub(crate) samples: Vec<Values>,
    /// What a person should know of it.
    pub(crate) remarks: Vec<String>,
    /// Margins and veins, if it is drawn.
    pub(crate) shown: Option<Shown>,
}

/// All single values of a kind.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Values {
    pub(crate) kind: &'static str,
    pub(crate) unit: &'static str,
    /// They ascend.
    pub(crate) numbers: Vec<f64>,
}

/// What is drawn of a leaf.
#[derive(Clone, Debug)]
pub(crate) struct Shown {
    pub(crate) outlines: Vec<Outline>,
    pub(crate) network: VenationNetwork,
    pub(crate) known: Known,
}

/// The values of each kind, ascending; kinds in the order of their first value.
pub(crate) fn by_kind(samples: &[Sample]) -> Vec<Values> {
    let mut kinds: Vec<Values> = Vec::new();
    for sample in samples.iter().filter(|sample| sample.value.is_finite()) {
        let place = kinds.iter().position(|known| known.kind == sample.kind);
        let place = place.unwrap_or_else(|| {
            kinds.push(Values {
                kind: sample.kind,
                unit: sample.unit,
                numbers: Vec::new(),
            });
            kinds.len() - 1
        });
        // Adding 0 turns a negative zero into zero.
        kinds[place].numbers.push(sample.value + 0.0);
    }
    for kind in &mut kinds {
        kind.numbers.sort_unstable_by(f64::total_cmp);
    }
    kinds
}

/// Pairs of leaves whose measures and single values are all the same.
pub(crate) fn same(leaves: &[Leaf]) -> Vec<[usize; 2]> {
    let mut pairs = Vec::new();
    for (number, leaf) in leaves.iter().enumerate() {
        let is_same = |other: &&Leaf| other.rows == leaf.rows && other.samples == leaf.samples;
        if let Some(earlier) = leaves[..number].iter().position(|other| is_same(&other)) {
            pairs.push([earlier, number]);
        }
    }
    pairs
}
