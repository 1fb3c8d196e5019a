//! Plans that cannot be carried out.

use super::*;

#[test]
fn every_bad_number_is_named() {
    type Break = fn(&mut AuxinPlan);
    let break_one: [(&str, Break); 9] = [
        ("final_length_segments", |p| p.final_length = 1.0),
        ("kill_distance_segments", |p| p.kill_distance = 0.0),
        ("source_birth_distance_segments", |p| {
            p.source_birth_distance = 0.0;
        }),
        ("vein_birth_distance_segments", |p| {
            p.vein_birth_distance = f64::NAN;
        }),
        ("darts_per_segment2", |p| p.darts_per_area = -1e-4),
        ("murray_exponent", |p| p.murray_exponent = f64::INFINITY),
        ("veinlet_radius_mm", |p| p.veinlet_radius_mm = 0.0),
        ("growth.isogonic.initial_length_segments", |p| {
            p.growth = Growth::Isogonic {
                initial_length: 0.0,
                length_step: 1.0,
            };
        }),
        ("growth.marginal.length_step_segments", |p| {
            p.growth = Growth::Marginal {
                initial_length: 10.0,
                length_step: 0.0,
            };
        }),
    ];
    for (expected, change) in break_one {
        let mut plan = poplar();
        change(&mut plan);
        match grow(&outline(0.0, 0.0), &plan, 1) {
            Err(error) => {
                let said = error.to_string();
                assert!(said.starts_with(&format!("{expected} is ")), "{said}");
            }
            Ok(_) => panic!("{expected} is accepted"),
        }
    }
}

#[test]
fn endless_plans_are_refused() {
    let slow = AuxinPlan {
        growth: Growth::Marginal {
            initial_length: 10.0,
            length_step: 1e-5,
        },
        ..poplar()
    };
    let longer = AuxinPlan {
        growth: Growth::Isogonic {
            initial_length: 400.0,
            length_step: 1.0,
        },
        ..poplar()
    };
    let crowded = AuxinPlan {
        final_length: 1e5,
        darts_per_area: 1e3,
        ..poplar()
    };
    for (plan, expected) in [
        (longer, "initial_length is 400, outside"),
        (slow, "growing in steps of 0.00001 segments takes"),
        (crowded, "the darts per area ask for"),
    ] {
        let error = grow(&outline(0.0, 0.0), &plan, 1).expect_err(expected);
        assert!(error.to_string().starts_with(expected), "{error}");
    }
}
