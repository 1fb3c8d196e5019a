//! Two parameters of the veins against what is measured:
//! `cargo run --release -p leafmodel --example parameter_sweep -- [seeds]`.
//!
//! Each kill distance is combined with each birth distance of auxin sources (in vein segments), and
//! each pair with several seeds. A leaf is a row of the CSV on the standard output. Leaves grow on
//! all threads; the rows are the same on any number of them.

use std::error::Error;
use std::io::Write as _;

use leafmodel::leaf::{LeafError, LeafPlan};
use leafmodel::measure::{Measures, measure};
use leafmodel::species;
use leafmodel::venation::plan::AuxinPlan;
use rayon::prelude::*;

const KILL_DISTANCES: [f64; 3] = [1.0, 2.0, 4.0];
const BIRTH_DISTANCES: [f64; 3] = [3.0, 4.5, 6.0];
const MEASURED: [&str; 4] = [
    "vein_density_mm_per_mm2",
    "areoles_per_mm2",
    "vein_distance_mm_mean",
    "spanning_tree_ratio",
];

/// The same leaf with other numbers.
fn varied(leaf: &LeafPlan, kill_distance: f64, birth_distance: f64, seed: u64) -> Option<LeafPlan> {
    let venation = AuxinPlan {
        kill_distance,
        source_birth_distance: birth_distance,
        vein_birth_distance: birth_distance,
        final_length: 150.0,
        darts_per_area: 0.01,
        ..leaf.venation.auxin()?.clone()
    };
    Some(LeafPlan {
        seed,
        venation: venation.into(),
        ..leaf.clone()
    })
}

fn measured(plan: &LeafPlan) -> Result<Measures, LeafError> {
    let lamina = plan.grow_lamina()?;
    let exponent = plan.venation.murray_exponent();
    Ok(measure(&lamina.outline, &lamina.network, exponent))
}

fn main() -> Result<(), Box<dyn Error>> {
    let seeds: u64 = std::env::args().nth(1).map_or(Ok(3), |text| text.parse())?;
    let poplar = species::find("poplar").ok_or("the poplar is a preset")?;
    let poplar = poplar.plan();

    let mut rows = Vec::new();
    for kill_distance in KILL_DISTANCES {
        for birth_distance in BIRTH_DISTANCES {
            for seed in 0..seeds {
                let plan = varied(&poplar, kill_distance, birth_distance, seed);
                let plan = plan.ok_or("the poplar's veins grow towards auxin")?;
                rows.push((kill_distance, birth_distance, plan));
            }
        }
    }
    let found: Vec<Measures> = rows
        .par_iter()
        .map(|(_, _, plan)| measured(plan))
        .collect::<Result<_, _>>()?;

    let mut out = std::io::stdout().lock();
    writeln!(
        out,
        "kill_distance,birth_distance,seed,{}",
        MEASURED.join(",")
    )?;
    for ((kill_distance, birth_distance, plan), measures) in rows.iter().zip(&found) {
        write!(out, "{kill_distance},{birth_distance},{}", plan.seed)?;
        for key in MEASURED {
            // A leaf without areoles has none to measure: an empty field.
            let value = measures.number(key).map(|value| value.to_string());
            write!(out, ",{}", value.unwrap_or_default())?;
        }
        writeln!(out)?;
    }
    Ok(())
}
