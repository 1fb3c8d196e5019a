//! Parameters of growth that were found from measures: CSV, JSON, a drawing, and words.

mod picture;
pub(crate) mod simulations;

use leafmodel::inference::{
    Correlation, Fit, Identified, Parameter, ParameterEstimate, Prediction, Problem, Role,
};
use serde_json::{Map, Value, json};

pub(crate) use self::picture::marginals;
use super::table::{Table, in_columns};
use crate::plot;

/// A fitted measure with less than this share of what is foretold on one side of it is missed.
const BESIDE: f64 = 0.1;

/// Effective sizes below this are told: ends of intervals are then off by half their width.
const FEW: f64 = 50.0;

/// The posterior: a column for each free key, and the weight of each row.
pub(crate) fn sample(problem: &Problem, found: &Fit) -> String {
    let keys = problem.parameters().iter().map(Parameter::name);
    let mut table = Table::of(keys.chain(["weight"]));
    for (values, weight) in &found.sample {
        let numbers = values.iter().chain([weight]);
        table.row(numbers.map(|number| format!("{number:?}")));
    }
    table.text()
}

/// All that is known.
pub(crate) fn json(problem: &Problem, found: &Fit) -> Value {
    let counted = |pairs: &[(String, usize)]| -> Map<String, Value> {
        let pairs = pairs.iter();
        pairs.map(|(key, n)| (key.clone(), json!(n))).collect()
    };
    let constant = found.constant.iter();
    let constant: Map<String, Value> = constant
        .map(|(key, is_same)| (key.clone(), json!({ "as_observed": is_same })))
        .collect();
    let correlations = found.correlations.iter();
    let correlations: Vec<Value> = correlations
        .map(|one| json!({ "keys": one.names, "correlation": one.value }))
        .collect();
    json!({
        "seed": problem.seed(),
        "simulations": found.simulations,
        "failed": found.failed,
        "first_failure": found.first_failure,
        "missing": counted(&found.missing),
        "constant": constant,
        "accepted": found.sample.len(),
        "acceptance": found.sample.len() as f64 / found.simulations as f64,
        "effective_sample_size": found.effective_size,
        "tolerance": found.tolerance,
        "parameters": found.parameters.iter().map(parameter).collect::<Vec<_>>(),
        "correlations": correlations,
        "predictions": found.predictions.iter().map(prediction).collect::<Vec<_>>(),
        "told": sentences(found),
    })
}

fn parameter(told: &ParameterEstimate) -> Value {
    let [low, high] = told.parameter.range();
    let [half, most, nearly_all] = told.intervals;
    json!({
        "key": told.parameter.name(),
        "prior": {
            "low": low,
            "high": high,
            "scale": if told.parameter.is_logarithmic() { "logarithmic" } else { "linear" },
            "whole": told.parameter.is_whole(),
        },
        "mean": told.mean,
        "median": told.median,
        "standard_deviation": told.deviation,
        "interval_50": half,
        "interval_90": most,
        "interval_95": nearly_all,
        "contraction": told.contraction,
        "share_of_prior": told.share_of_prior,
        "identified": match told.identified() {
            Identified::Well => "well",
            Identified::Weakly => "weakly",
            Identified::No => "no",
        },
    })
}

fn prediction(one: &Prediction) -> Value {
    let level = |index: usize| one.intervals.map(|intervals| intervals[index]);
    json!({
        "measure": one.key,
        "held_out": one.role == Role::HeldOut,
        "observed": one.observed,
        "median": one.median,
        "interval_50": level(0),
        "interval_90": level(1),
        "interval_95": level(2),
        "share_below": one.below,
        "within_95": one.is_within(),
        "simulations": one.count,
    })
}

/// What a person should take away.
pub(crate) fn sentences(found: &Fit) -> Vec<String> {
    let mut lines: Vec<String> = found
        .parameters
        .iter()
        .map(ParameterEstimate::sentence)
        .collect();
    lines.extend(found.correlations.iter().filter_map(Correlation::sentence));
    if found.effective_size < FEW {
        lines.push(format!(
            "the sample is worth {:.0} draws only: take more --simulations, and see whether another \
             --seed says the same",
            found.effective_size
        ));
    }
    if found.failed > 0 {
        let first = found.first_failure.as_deref().unwrap_or_default();
        lines.push(format!(
            "{} of {} leaves did not grow and are left out (the first: {first})",
            found.failed, found.simulations
        ));
    }
    for (key, count) in &found.missing {
        lines.push(format!(
            "{count} of {} leaves have nothing to measure for {key}",
            found.simulations
        ));
    }
    for (key, is_same) in &found.constant {
        let beside = if *is_same {
            ""
        } else {
            ", and the leaf that was measured has another value"
        };
        lines.push(format!(
            "{key} is the same in all leaves{beside}: it was left out"
        ));
    }
    // A sample that has come near has what it was fitted to in its middle.
    let is_beside = |one: &&Prediction| {
        let ends = [BESIDE, 1.0 - BESIDE];
        one.role == Role::Fitted
            && one
                .below
                .is_some_and(|below| below < ends[0] || below > ends[1])
    };
    let beside: Vec<String> = found
        .predictions
        .iter()
        .filter(is_beside)
        .filter_map(|one| {
            Some(format!(
                "{} {} for {}",
                one.key,
                short(one.median?),
                short(one.observed)
            ))
        })
        .collect();
    if !beside.is_empty() {
        lines.push(format!(
            "the sample has not come near to what it was fitted to (foretold {}): narrow the ranges of \
             --free about the medians, or take more --simulations",
            beside.join(", ")
        ));
    }
    let outside = |one: &&Prediction| one.is_within() == Some(false);
    for one in found.predictions.iter().filter(outside) {
        let [_, _, [low, high]] = one.intervals.unwrap_or_default();
        let what = match one.role {
            Role::Fitted => "fitted",
            Role::HeldOut => "held out",
        };
        lines.push(format!(
            "{} ({what}) is {}, outside {} to {}, where 95 % of the fitted leaves lie",
            one.key,
            short(one.observed),
            short(low),
            short(high)
        ));
    }
    lines
}

/// Parameters, predictions and sentences in columns.
pub(crate) fn table(found: &Fit) -> String {
    let rows = found.parameters.iter().map(|told| {
        let [half, most, nearly_all] = told.intervals.map(|[low, high]| interval(low, high));
        [
            told.parameter.name().to_owned(),
            short(told.median),
            short(told.mean),
            short(told.deviation),
            half,
            most,
            nearly_all,
        ]
    });
    let heads = ["", "median", "mean", "sd", "50 %", "90 %", "95 %"];
    let parameters = in_columns(heads, rows);
    let dash = || "–".to_owned();
    let rows = found.predictions.iter().map(|one| {
        let mark = match (one.role, one.is_within()) {
            (Role::HeldOut, Some(true) | None) => "held out",
            (Role::HeldOut, Some(false)) => "held out, outside",
            (Role::Fitted, Some(true) | None) => "",
            (Role::Fitted, Some(false)) => "outside",
        };
        let nearly_all = one.intervals.map(|[_, _, [low, high]]| interval(low, high));
        [
            one.key.clone(),
            short(one.observed),
            one.median.map_or_else(dash, short),
            nearly_all.unwrap_or_else(dash),
            mark.to_owned(),
        ]
    });
    let predictions = in_columns(["", "observed", "foretold", "95 %", ""], rows);
    let mut text = format!("{parameters}\n\n{predictions}\n\n");
    for line in sentences(found) {
        text += &format!("{line}\n");
    }
    text += &format!(
        "{} leaves, {} accepted, worth {:.0} equal draws\n",
        found.simulations,
        found.sample.len(),
        found.effective_size
    );
    text
}

fn interval(low: f64, high: f64) -> String {
    format!("{} – {}", short(low), short(high))
}

/// Four significant digits.
fn short(number: f64) -> String {
    plot::short(number, 4)
}
