//! Leaves that are read or grown, and measured.

use leafmodel::leaf::LeafPlan;
use leafmodel::measure::{Blade, Known, Row, Subject};
use rayon::prelude::*;

use super::sources::{From, Source, Sources};
use crate::cli::arguments::{CompareNetworksArguments, MeasuringArguments};
use crate::cli::grow::{self, Wish};
use crate::cli::measure::Input;
use crate::cli::needs;
use crate::cli::terminal::Failure;
use crate::comparison::leaves::{LEFT_OUT, Leaf, Shown, by_kind};
use crate::report::measures::{by_order, measured};

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
                .map_err(|error| bad!("{}: {error}", source.given))?;
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
    let (measures, _, _) = measured(&subject, measuring.wanted([false, false]));
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
