//! How often the intervals of fitted parameters hold the truth:
//! `cargo run --release -p leafmodel --example fit_calibration -- [leaves] [simulations]`.
//!
//! Each leaf gets a kill distance, a birth distance and a density of darts by chance from their
//! ranges, and is grown and measured. A fit that sees nothing but these measures gives back
//! intervals. A row of the CSV on the standard output is one parameter of one leaf: what it was,
//! what was found, and its rank, the share of the posterior below it. If the posterior is right,
//! ranks are uniform and an interval of 90 % holds nine in ten.

use std::convert::Infallible;
use std::error::Error;
use std::io::Write as _;
use std::time::Instant;

use leafmodel::inference::{Fit, Observation, Outcome, Parameter, Problem, Role, fit};
use leafmodel::leaf::LeafPlan;
use leafmodel::measure::fitting::{FITTED, HELD_OUT};
use leafmodel::measure::measure;
use leafmodel::species;
use leafmodel::venation::plan::AuxinPlan;
use rayon::prelude::*;

/// Lengths are vein segments.
const RANGES: [(&str, f64, f64); 3] = [
    ("kill_distance", 0.5, 4.0),
    ("birth_distance", 1.0, 8.0),
    ("darts", 5e-5, 1e-3),
];

/// The poplar with other veins.
fn varied(leaf: &LeafPlan, values: &[f64], seed: u64) -> Option<LeafPlan> {
    let venation = AuxinPlan {
        kill_distance: values[0],
        source_birth_distance: values[1],
        vein_birth_distance: values[1],
        darts_per_area: values[2],
        ..leaf.venation.auxin()?.clone()
    };
    Some(LeafPlan {
        seed,
        venation: venation.into(),
        ..leaf.clone()
    })
}

fn measured(leaf: &LeafPlan, values: &[f64], seed: u64) -> Outcome {
    let plan = varied(leaf, values, seed).ok_or("no veins of auxin")?;
    let lamina = plan.grow_lamina().map_err(|error| error.to_string())?;
    let exponent = plan.venation.murray_exponent();
    let measures = measure(&lamina.outline, &lamina.network, exponent);
    Ok(FITTED
        .iter()
        .chain(&HELD_OUT)
        .map(|key| measures.number(key))
        .collect())
}

/// A share of the posterior below a value, equal ones by half.
fn rank(found: &Fit, parameter: usize, value: f64) -> f64 {
    let below = found.sample.iter().map(|(values, weight)| {
        if values[parameter] < value {
            *weight
        } else if values[parameter] == value {
            0.5 * weight
        } else {
            0.0
        }
    });
    below.sum()
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let leaves: u32 = arguments.next().map_or(Ok(10), |text| text.parse())?;
    let simulations: usize = arguments.next().map_or(Ok(1000), |text| text.parse())?;
    let poplar = species::find("poplar")
        .ok_or("the poplar is a preset")?
        .plan();
    let parameters: Vec<Parameter> = RANGES
        .iter()
        .map(|(name, low, high)| Parameter::new(*name, *low, *high))
        .collect::<Result<_, _>>()?;

    let mut out = std::io::stdout().lock();
    writeln!(
        out,
        "leaf,parameter,truth,median,low_50,high_50,low_90,high_90,rank,contraction,seconds"
    )?;
    let mut held = [0; 2];
    let (mut foretold, mut told) = (0, 0);
    for leaf in 0..leaves {
        // Quasi-random truths (the additive recurrence of the plastic number in three dimensions)
        // cover the prior more evenly than few random ones would.
        let share = |step: f64| (0.5 + step * f64::from(leaf + 1)).fract();
        let shares = [
            0.819_172_513_396_164,
            0.671_043_606_703_789,
            0.549_700_477_901_97,
        ];
        let truth: Vec<f64> = RANGES
            .iter()
            .zip(shares)
            .map(|((_, low, high), step)| low * (high / low).powf(share(step)))
            .collect();
        let seen = measured(&poplar, &truth, 1_000_003 + u64::from(leaf))?;
        let keys = FITTED.iter().map(|key| (*key, Role::Fitted));
        let keys = keys.chain(HELD_OUT.iter().map(|key| (*key, Role::HeldOut)));
        // The places of the measures that this leaf has.
        let numbered = keys.zip(&seen).enumerate();
        let (places, observed): (Vec<usize>, Vec<Observation>) = numbered
            .filter_map(|(place, ((key, role), value))| {
                Some((place, Observation::from((key, (*value)?, role))))
            })
            .unzip();
        let problem = Problem::new(parameters.clone(), observed, simulations, u64::from(leaf))?;
        let began = Instant::now();
        let found = fit(&problem, |draws| {
            let grown = draws.par_iter().map(|draw| {
                let all = measured(&poplar, &draw.values, draw.seed)?;
                Ok(places.iter().map(|place| all[*place]).collect())
            });
            Ok::<_, Infallible>(grown.collect())
        })?;
        let seconds = began.elapsed().as_secs_f64();
        for (index, (told, truth)) in found.parameters.iter().zip(&truth).enumerate() {
            let [half, most, _] = told.intervals;
            for (count, [low, high]) in held.iter_mut().zip([half, most]) {
                *count += u32::from((low..=high).contains(truth));
            }
            writeln!(
                out,
                "{leaf},{},{truth:.5e},{:.5e},{:.5e},{:.5e},{:.5e},{:.5e},{:.3},{:.3},{seconds:.0}",
                told.parameter.name(),
                told.median,
                half[0],
                half[1],
                most[0],
                most[1],
                rank(&found, index, *truth),
                told.contraction,
            )?;
        }
        for prediction in &found.predictions {
            if prediction.role == Role::HeldOut {
                told += 1;
                foretold += u32::from(prediction.is_within() == Some(true));
            }
        }
        eprintln!(
            "leaf {leaf}: effective size {:.0}, tolerance {:.2}, {} failed, missing {:?}",
            found.effective_size, found.tolerance, found.failed, found.missing
        );
    }
    let all = leaves * RANGES.len() as u32;
    eprintln!(
        "of {all} values {} lie within 50 % intervals, {} within 90 %",
        held[0], held[1]
    );
    eprintln!("of {told} measures held out {foretold} lie within the 95 % interval foretold");
    Ok(())
}
