//! The leaves that are compared, read or grown, and measured.

use leafmodel::leaf::LeafPlan;
use leafmodel::measure::{Blade, Known, Row, Sample, Subject};
use leafmodel::shape::outline::Outline;
use leafmodel::venation::network::VenationNetwork;
use rayon::prelude::*;

use super::sources::{From, Source, Sources};
use crate::cli::arguments::{CompareNetworksArguments, MeasuringArguments};
use crate::cli::grow::{self, Wish};
use crate::cli::measure::{Input, by_order, measured};
use crate::cli::{Failure, needs};

/// Numbers that are no measures of their own: coefficients that mean something together only, what
/// the curves of distributions show in full, and an error.
pub(super) const LEFT_OUT: [&str; 5] = [
    "elliptic_fourier",
    "areole_area_mm2_percentiles",
    "areole_circularity_percentiles",
    "areole_elongation_percentiles",
    "hyperuniformity_exponent_error",
];

/// A leaf with its measures.
#[derive(Clone, Debug)]
pub(super) struct Leaf {
    pub(super) name: String,
    /// Its group, by number.
    pub(super) group: usize,
    /// The file or the plan, as named.
    pub(super) given: String,
    pub(super) nodes: usize,
    pub(super) edges: usize,
    pub(super) areoles: usize,
    pub(super) area_mm2: Option<f64>,
    /// A row for each measure that is compared.
    pub(super) rows: Vec<Row>,
    pub(super) samples: Vec<Values>,
    /// What a person should know of it.
    pub(super) remarks: Vec<String>,
    /// Margins and veins, if it is drawn.
    pub(super) shown: Option<Shown>,
}

/// All single values of a kind.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Values {
    pub(super) kind: &'static str,
    pub(super) unit: &'static str,
    /// They ascend.
    pub(super) numbers: Vec<f64>,
}

/// What is drawn of a leaf.
#[derive(Clone, Debug)]
pub(super) struct Shown {
    pub(super) outlines: Vec<Outline>,
    pub(super) network: VenationNetwork,
    pub(super) known: Known,
}

/// A leaf that is read, or that is to be grown.
enum Ready {
    Read(Box<Input>, Option<f64>),
    Plan(Box<LeafPlan>),
}

/// Reads, grows and measures all leaves; those with these numbers are kept to be drawn.
pub(super) fn measure_all(
    arguments: &CompareNetworksArguments,
    sources: &Sources,
    drawn: &[usize],
) -> Result<Vec<Leaf>, Failure> {
    let mut leaves = Vec::with_capacity(sources.leaves.len());
    // As many at a time as there are threads: a network may be large.
    let together = rayon::current_num_threads().max(1);
    for (chunk, first) in sources.leaves.chunks(together).zip((0..).step_by(together)) {
        let ready: Vec<(&Source, Ready)> = chunk
            .iter()
            .map(|source| Ok((source, ready(source)?)))
            .collect::<Result<_, Failure>>()?;
        let measured: Vec<Result<Leaf, Failure>> = ready
            .into_par_iter()
            .enumerate()
            .map(|(number, (source, ready))| {
                let is_drawn = drawn.contains(&(first + number));
                leaf(source, ready, &arguments.measuring, is_drawn)
            })
            .collect();
        for leaf in measured {
            let leaf = leaf?;
            for remark in &leaf.remarks {
                let (word, text) = remark.split_once(": ").unwrap_or(("note", remark));
                eprintln!("{word}: {}: {text}", leaf.given);
            }
            leaves.push(leaf);
        }
    }
    Ok(leaves)
}

fn ready(source: &Source) -> Result<Ready, Failure> {
    match &source.from {
        From::File { path, reading } => {
            let input = Input::read(path, reading)?;
            Ok(Ready::Read(Box::new(input), reading.area))
        }
        From::Growth { seed } => {
            let (_, plan) = grow::named_plan(Wish {
                leaf: &source.given,
                overrides: &[],
                settings: &[],
                seed: *seed,
            })?;
            let plan = plan.form_alone().map_err(Failure::bad)?;
            let memory = plan.memory().map_err(Failure::bad)?;
            needs::compare("growth", &[(memory.veins, "veins")], None)?;
            Ok(Ready::Plan(Box::new(plan)))
        }
    }
}

fn leaf(
    source: &Source,
    ready: Ready,
    measuring: &MeasuringArguments,
    is_drawn: bool,
) -> Result<Leaf, Failure> {
    let (remarks, shown, area) = match ready {
        Ready::Read(input, area) => {
            let remarks = input.remarks(input.blade(area));
            let Input {
                network,
                outlines,
                known,
                ..
            } = *input;
            let shown = Shown {
                outlines,
                network,
                known,
            };
            (remarks, shown, area)
        }
        Ready::Plan(plan) => {
            let lamina = plan
                .grow_lamina()
                .map_err(|error| Failure::bad(format!("{}: {error}", source.given)))?;
            let shown = Shown {
                outlines: vec![lamina.outline],
                network: lamina.network,
                known: Known::ALL,
            };
            (Vec::new(), shown, None)
        }
    };
    let (blade, known) = (Blade::of(&shown.outlines, area), shown.known);
    let subject = Subject::new(blade, &shown.network, known);
    let (measures, _, _) = measured(&subject, measuring, [false, false]);
    let rows = measures.rows().into_iter().chain(by_order(&subject, known));
    let rows: Vec<Row> = rows.filter(|row| !LEFT_OUT.contains(&row.key)).collect();
    let mut leaf = Leaf {
        name: source.name.clone(),
        group: source.group,
        given: source.given.clone(),
        nodes: shown.network.nodes().len(),
        edges: shown.network.edges().len(),
        areoles: subject.areoles().len(),
        area_mm2: measures.number("blade_area_mm2"),
        rows,
        samples: by_kind(&subject.distributions()),
        remarks,
        shown: None,
    };
    leaf.shown = is_drawn.then_some(shown);
    Ok(leaf)
}

/// The values of each kind, ascending; kinds in the order of their first value.
fn by_kind(samples: &[Sample]) -> Vec<Values> {
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
pub(super) fn same(leaves: &[Leaf]) -> Vec<[usize; 2]> {
    let mut pairs = Vec::new();
    for (number, leaf) in leaves.iter().enumerate() {
        let is_same = |other: &&Leaf| other.rows == leaf.rows && other.samples == leaf.samples;
        if let Some(earlier) = leaves[..number].iter().position(|other| is_same(&other)) {
            pairs.push([earlier, number]);
        }
    }
    pairs
}
