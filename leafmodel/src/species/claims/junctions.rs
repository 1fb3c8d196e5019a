//! How veins meet in the closed nets of species.

use super::Grown;
use crate::measure::{Measures, Value};
use crate::species::PRESETS;
use crate::venation::network::{self, VenationNetwork};
use crate::venation::topology::Topology;

/// Daughters within so many degrees of each other are nearly parallel.
const PARALLEL_DEG: f64 = 20.0;

fn list(measures: &Measures, key: &str) -> Vec<f64> {
    let entry = measures.entries().iter().find(|entry| entry.key == key);
    match entry.map(|entry| &entry.value) {
        Some(Value::List(list)) => list.clone(),
        Some(Value::Orders(list)) => list.iter().map(|value| value.unwrap_or(f64::NAN)).collect(),
        Some(Value::Count(_) | Value::Number(_)) | None => Vec::new(),
    }
}

/// The most daughters of a node within a narrow angle.
fn most_parallel(network: &VenationNetwork) -> usize {
    let ends = network::ends(network.edges());
    let topology = Topology::new(network.nodes().len(), &ends);
    let place = |node: u32| network.nodes()[node as usize].position;
    let of_node = |node: u32| {
        let out = topology.leaving(node);
        let turn = |&edge: &u32| {
            let way = place(ends[edge as usize][1]) - place(node);
            libm::atan2(way.y, way.x).to_degrees()
        };
        let turns: Vec<f64> = out.iter().map(turn).collect();
        let beside = |a: f64| {
            let after = |b: &&f64| (*b - a).rem_euclid(360.0) <= PARALLEL_DEG;
            turns.iter().filter(after).count()
        };
        turns.iter().map(|&a| beside(a)).max().unwrap_or(0)
    };
    // The base bears as many primaries as the species has.
    (1..network.nodes().len() as u32)
        .map(of_node)
        .max()
        .unwrap_or(0)
}

#[test]
fn junctions_of_species_are_balanced_and_simple_and_widths_follow_murray_by_order() {
    let mut seen = 0;
    let mut wrong = Vec::new();
    for preset in PRESETS {
        let plan = preset.plan();
        let architecture = plan
            .venation
            .auxin()
            .and_then(|plan| plan.architecture.as_ref());
        let is_net = plan
            .venation
            .auxin()
            .is_some_and(|plan| plan.tension_rounds > 0);
        let is_coloured = preset.is_coloured();
        if architecture.is_none() || !is_net || is_coloured {
            continue;
        }
        seen += 1;
        let leaf = Grown::preset(preset.name);
        let measures = leaf.measures();
        let mut hold = |holds: bool, what: String| {
            if !holds {
                wrong.push(format!("{}: {what}", preset.name));
            }
        };
        let number = |key: &str| measures.number(key).unwrap_or(f64::NAN);
        hold(number("crossing_count") == 0.0, "veins cross".to_owned());
        let bent = number("junction_bent_share");
        // Without tension 0.91 of them are, after 40 rounds 0.35 to 0.41; the aspen has 0.322 by directions
        // over a length.
        hold(
            bent < 0.33,
            format!("{bent} of the junctions of equal veins are bent"),
        );
        let angle = number("junction_largest_angle_deg_median");
        hold(
            (120.0..145.0).contains(&angle),
            format!("equal veins meet at up to {angle}°"),
        );
        let degrees = list(&measures, "junction_degree_shares");
        hold(
            degrees[0] > 0.9 && degrees[2] < 1e-3,
            format!("degrees {degrees:?}"),
        );
        let parallel = most_parallel(&leaf.network);
        hold(
            parallel < 4,
            format!("{parallel} nearly parallel daughters"),
        );
        let exponents = list(&measures, "murray_exponent_by_order");
        let (coarsest, finest) = (exponents[0], exponents[exponents.len() - 1]);
        hold(
            (2.0..2.55).contains(&coarsest) && (2.7..3.0).contains(&finest),
            format!("Murray's exponents {exponents:.2?}"),
        );
        // One order's medians may differ by chance from its neighbour's.
        let falls = exponents.windows(2).any(|pair| pair[1] < pair[0] - 0.05);
        hold(
            !falls,
            format!("Murray's exponents {exponents:.2?} do not rise"),
        );
    }
    assert_eq!(wrong, [""; 0]);
    assert!(seen >= 12, "{seen}");
}
