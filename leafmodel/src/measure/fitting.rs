//! Which measures parameters of growth are fitted to unless others are named, and which are held
//! out to test the fit.
//!
//! None of them depends on the size of the blade, so a leaf and its simulations may differ a little
//! in area; none is a function of another. Lists are left out: their numbers go together.

use glam::DVec2;

use super::{Blade, Entry, Known, Subject, Value};
use crate::venation::network::{VeinEdge, VeinNode, VenationNetwork};

/// Measures that are fitted.
pub const FITTED: [&str; 15] = [
    "vein_density_mm_per_mm2",
    "minor_vein_share",
    "vein_distance_mm_mean",
    "vein_distance_mm_median",
    "areoles_per_mm2",
    "areole_area_mm2_median",
    "areole_area_cv",
    "freely_ending_veinlets_per_mm2",
    "freely_ending_veinlet_length_mm_mean",
    "junction_degree_3_share",
    "junction_largest_angle_deg_median",
    "branching_fine_deflection_deg_median",
    "loop_nesting",
    "secondary_spacing_mm_mean",
    "tertiary_angle_deg_mean",
];

/// Measures that the fit does not see: the form of areoles, forks and the tree within the net.
pub const HELD_OUT: [&str; 4] = [
    "areole_circularity_median",
    "areole_elongation_median",
    "branching_angle_deg_median",
    "spanning_tree_ratio",
];

/// Keys of the single numbers that are measured of every leaf that is grown, in the order of
/// tables: all that can be fitted or held out.
pub fn possible() -> Vec<&'static str> {
    let node = |y: f64| VeinNode {
        position: DVec2::new(0.0, y),
        born: 0,
    };
    let edge = VeinEdge {
        from: 0,
        to: 1,
        radius_from: 0.1,
        radius_to: 0.1,
        order: 1,
    };
    let network = VenationNetwork::from_parts(vec![node(0.0), node(1.0)], vec![edge], 1.0)
        .expect("one edge leads from one node to the other");
    let measures = Subject::new(Blade::Unknown, &network, Known::ALL).measures(3.0);
    let is_number = |entry: &&Entry| match entry.value {
        Value::Count(_) | Value::Number(_) => true,
        Value::List(_) | Value::Orders(_) => false,
    };
    let numbers = measures.entries().iter().filter(is_number);
    numbers.map(|entry| entry.key).collect()
}

#[cfg(test)]
mod tests {
    use std::convert::Infallible;

    use rayon::prelude::*;

    use super::*;
    use crate::inference::{Identified, Observation, Outcome, Parameter, Problem, Role, fit};
    use crate::leaf::LeafPlan;
    use crate::measure::measure;
    use crate::species;
    use crate::venation::plan::AuxinPlan;

    fn measured(plan: &LeafPlan) -> Outcome {
        let lamina = plan.grow_lamina().map_err(|error| error.to_string())?;
        let exponent = plan.venation.murray_exponent();
        let measures = measure(&lamina.outline, &lamina.network, exponent);
        let keys = FITTED.iter().chain(&HELD_OUT);
        Ok(keys.map(|key| measures.number(key)).collect())
    }

    #[test]
    fn what_is_possible_is_what_a_grown_leaf_has() {
        let lamina = species::find("poplar").expect("a preset").plan();
        let lamina = lamina.grow_lamina().expect("a good plan");
        let measures = measure(&lamina.outline, &lamina.network, 2.0);
        let possible = possible();
        for key in FITTED.iter().chain(&HELD_OUT) {
            assert!(possible.contains(key), "{key}");
        }
        for key in &possible {
            assert!(measures.number(key).is_some(), "{key} of a poplar");
        }
        assert!(!possible.contains(&"conductance_mm3_per_s_mpa"));
        assert!(!possible.contains(&"elliptic_fourier"));
    }

    #[test]
    fn a_leaf_with_a_net_has_every_measure_once() {
        let poplar = species::find("poplar").expect("a preset").plan();
        let measures = measured(&poplar).expect("a good plan");
        assert!(measures.iter().all(Option::is_some), "{measures:?}");
        let mut keys: Vec<&str> = FITTED.iter().chain(&HELD_OUT).copied().collect();
        keys.sort_unstable();
        keys.dedup();
        assert_eq!(keys.len(), FITTED.len() + HELD_OUT.len());
    }

    #[test]
    fn distances_by_which_a_leaf_has_grown_are_found_again() {
        let poplar = species::find("poplar").expect("a preset").plan();
        let grown = |kill_distance: f64, birth_distance: f64, seed: u64| LeafPlan {
            seed,
            venation: AuxinPlan {
                final_length: 120.0,
                darts_per_area: 0.01,
                kill_distance,
                source_birth_distance: birth_distance,
                vein_birth_distance: birth_distance,
                ..AuxinPlan::default()
            }
            .into(),
            ..poplar.clone()
        };
        let truth = [1.5, 4.0];
        let seen = measured(&grown(truth[0], truth[1], 4711)).expect("a good plan");
        let roles = FITTED.iter().map(|key| (*key, Role::Fitted));
        let roles = roles.chain(HELD_OUT.iter().map(|key| (*key, Role::HeldOut)));
        let observed = roles.zip(seen).map(|((key, role), value)| {
            Observation::from((key, value.expect("this leaf has every measure"), role))
        });
        let parameters = [("kill", 0.5, 3.0), ("birth", 3.0, 10.0)]
            .map(|(name, low, high)| Parameter::new(name, low, high).expect("a range"));
        let problem = Problem::new(parameters.to_vec(), observed.collect(), 600, 1);
        let problem = problem.expect("a problem");
        let found = fit(&problem, |draws| {
            let grow = |values: &[f64], seed| measured(&grown(values[0], values[1], seed));
            let outcomes = draws.par_iter().map(|draw| grow(&draw.values, draw.seed));
            Ok::<_, Infallible>(outcomes.collect())
        });
        let found = found.expect("a fit");
        for (told, truth) in found.parameters.iter().zip(truth) {
            let [_, _, [low, high]] = told.intervals;
            assert!((low..=high).contains(&truth), "{told:?}");
            // 600 leaves; a thousand make it 0.83 to 0.96 (examples/fit_calibration).
            assert!(told.contraction > 0.6, "{told:?}");
            assert_ne!(told.identified(), Identified::No);
        }
    }
}
