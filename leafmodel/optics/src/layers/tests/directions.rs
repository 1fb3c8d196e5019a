//! Where light leaves, by direction and beside its entry.

use std::f64::consts::PI;

use super::*;

/// The greatest distance of both ways' means over directions, in standard errors, and how many bins
/// were compared.
fn apart(stack: &Stack, face: Face, cosine: f64, bins: Bins, seed: u64) -> (f64, usize) {
    let incidence = Incidence::Directional { cosine };
    let found = followed(stack, face, incidence, bins, 400_000, seed);
    let exact = Binned::new(stack, Resolution::new(20), face, cosine, bins).expect("in range");
    let found = [found.reflected_by_direction, found.transmitted_by_direction];
    let pairs = found.into_iter().zip([exact.reflected, exact.transmitted]);
    let mut most = (0.0_f64, 0);
    for (found, exact) in pairs.flat_map(|(found, exact)| found.into_iter().zip(exact)) {
        assert!(found.standard_error > 0.0, "no photon came there");
        let z = (found.value - exact) / found.standard_error;
        most = (most.0.max(z.abs()), most.1 + 1);
    }
    most
}

#[test]
fn both_ways_send_light_into_the_same_directions() {
    let bins = Bins {
        polar: 4,
        azimuth: 4,
    };
    let (most, compared) = apart(&varied(false), Face::First, 0.6, bins, 5);
    assert_eq!(compared, 32);
    assert!(most < 4.0, "{most} standard errors apart");
}

#[test]
fn both_ways_send_light_of_a_leaf_into_the_same_directions() {
    let bins = Bins {
        polar: 6,
        azimuth: 6,
    };
    let contents = &crate::presets::by_name("sun-green")
        .expect("a preset")
        .contents;
    let at = crate::ProspectD::coefficients(550.0).expect("in the table");
    let stack = LayeredLeaf::new(contents).stack(&at);
    for (seed, (face, cosine)) in (11..).zip([(Face::First, 0.5), (Face::Last, 0.9)]) {
        let (most, compared) = apart(&stack, face, cosine, bins, seed);
        assert_eq!(compared, 72);
        assert!(most < 4.0, "{face:?}: {most} standard errors apart");
    }
}

#[test]
fn light_by_direction_adds_up_to_what_is_reflected_and_transmitted() {
    let stack = varied(false);
    let light = solved(&stack, &[0.6]);
    let bins = Bins {
        polar: 48,
        azimuth: 1,
    };
    for face in [Face::First, Face::Last] {
        let incidence = Incidence::Directional { cosine: 0.6 };
        let all = &fluxes(&light, face, &[incidence])[0];
        let fine = Resolution::new(24);
        let directions = Bidirectional::new(&stack, fine, &[0.6], &[1.0]).expect("in range");
        let straight = directions.unscattered(face, 0);
        let binned = Binned::new(&stack, fine, face, 0.6, bins).expect("in range");
        let mean = |shares: &[f64]| shares.iter().sum::<f64>() / shares.len() as f64;
        let off = [
            mean(&binned.reflected) + straight[0] - all.reflected,
            mean(&binned.transmitted) + straight[1] - all.transmitted,
        ];
        assert!(off.iter().all(|off| off.abs() < 2e-5), "{off:?}");
    }
}

#[test]
fn a_brdf_is_reciprocal_at_every_azimuth_and_its_mean_is_that_over_azimuths() {
    let views = [0.9, 0.3];
    let all =
        Bidirectional::new(&varied(false), Resolution::new(16), &views, &views).expect("in range");
    for face in [Face::First, Face::Last] {
        let mut sum = 0.0;
        for step in 0..48 {
            let azimuth = 2.0 * PI * f64::from(step) / 48.0;
            let there = all.at(face, 0, 1, azimuth).reflected;
            let back = all.at(face, 1, 0, azimuth).reflected;
            assert!((there / back - 1.0).abs() < 1e-6, "{there} {back}");
            sum += there / 48.0;
        }
        assert!((sum - all.mean(face, 0, 1).reflected).abs() < 1e-12);
    }
}

#[test]
fn light_through_a_clear_plate_comes_out_where_snell_says() {
    // Thickness 2, index 1.5, cosine 0.6: 2 tan of the refracted angle, once and after each two
    // reflections more.
    let stack = one_layer(1.5, 0.0, 0.0, 0.0);
    let incidence = Incidence::Directional { cosine: 0.6 };
    let found = spread(&stack, &[2.0], Face::First, incidence, 100_000, 3).expect("in range");
    let sine = 0.8 / 1.5;
    let refracted = f64::sqrt(1.0 - sine * sine);
    let r = boundary::reflectance(1.0, 1.5, 0.6, refracted);
    let once = 2.0 * sine / refracted;
    let mut sums = [0.0; 2];
    for again in 0..40 {
        let share = r.powi(2 * again);
        let far = once * f64::from(2 * again + 1);
        sums = [sums[0] + share, sums[1] + share * far * far];
    }
    let z = (found.transmitted.value - sums[1] / sums[0]) / found.transmitted.standard_error;
    assert!(z.abs() < 4.0, "{found:?} for {}", sums[1] / sums[0]);
}

#[test]
fn light_comes_further_sideways_through_a_thicker_layer_in_proportion() {
    let stack = varied(false);
    let of = |unit: f64| {
        let thickness = [0.1, 1.0, 2.0, 0.3].map(|part| part * unit);
        spread(&stack, &thickness, Face::Last, Incidence::NORMAL, 20_000, 9).expect("in range")
    };
    let (one, three) = (of(1.0), of(3.0));
    for (one, three) in [
        (one.reflected, three.reflected),
        (one.transmitted, three.transmitted),
    ] {
        assert!(one.value > 0.0 && (three.value / one.value - 9.0).abs() < 1e-9);
    }
}
