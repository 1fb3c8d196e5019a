use std::f64::consts::PI;

use super::*;
use crate::solid::HalfSpace;

mod directions;

/// Layers that differ in everything, some of which do not absorb if `clear`.
fn varied(clear: bool) -> Stack {
    let layer = |index, albedo, depth, phase| Layer {
        index,
        albedo: if clear { 1.0 } else { albedo },
        depth,
        phase,
    };
    let double = Phase::Double {
        first: 0.7,
        second: -0.2,
        share: 0.8,
    };
    Stack::new(vec![
        layer(1.47, 0.5, 0.05, Phase::Rayleigh),
        layer(1.36, 0.95, 1.2, Phase::HenyeyGreenstein { g: 0.6 }),
        layer(1.20, 0.99, 2.0, double),
        layer(1.47, 0.8, 0.1, Phase::ISOTROPIC),
    ])
    .expect("layers in range")
}

fn solved(stack: &Stack, cosines: &[f64]) -> Ordinates {
    Ordinates::new(stack, Resolution::new(24), cosines).expect("cosines in range")
}

fn one_layer(index: f64, albedo: f64, depth: f64, g: f64) -> Stack {
    let phase = Phase::HenyeyGreenstein { g };
    let layer = Layer {
        index,
        albedo,
        depth,
        phase,
    };
    Stack::new(vec![layer]).expect("layer in range")
}

fn fluxes(light: &Ordinates, face: Face, incidences: &[Incidence]) -> Vec<Fluxes> {
    light
        .fluxes(face, incidences)
        .expect("it was solved for them")
}

fn leaving(light: &Ordinates, face: Face, incidence: Incidence) -> Vec<Leaving> {
    light
        .leaving(face, incidence)
        .expect("it was solved for it")
}

fn leaving_by_azimuth(
    light: &Ordinates,
    face: Face,
    cosine: f64,
    azimuths: &[f64],
) -> Vec<Vec<Leaving>> {
    let leaving = light.leaving_by_azimuth(face, cosine, azimuths);
    leaving.expect("it was solved for it")
}

fn followed(
    stack: &Stack,
    face: Face,
    incidence: Incidence,
    bins: Bins,
    photons: u64,
    seed: u64,
) -> Tallies {
    follow(stack, face, incidence, bins, photons, seed).expect("a direction in range")
}

const COSINES: [f64; 3] = [1.0, 0.6, 0.15];

fn incidences() -> Vec<Incidence> {
    COSINES
        .map(|cosine| Incidence::Directional { cosine })
        .into_iter()
        .chain([Incidence::Lambertian])
        .collect()
}

#[test]
fn without_absorption_nothing_is_lost() {
    let light = solved(&varied(true), &COSINES);
    for face in [Face::First, Face::Last] {
        for fluxes in fluxes(&light, face, &incidences()) {
            let sum = fluxes.reflected + fluxes.transmitted;
            assert!((sum - 1.0).abs() < 1e-11, "{sum}");
            for absorbed in fluxes.absorbed {
                assert!(absorbed.abs() < 1e-11, "{absorbed}");
            }
        }
    }
}

#[test]
fn all_shares_add_up_to_one_and_none_is_negative() {
    let light = solved(&varied(false), &COSINES);
    for face in [Face::First, Face::Last] {
        for fluxes in fluxes(&light, face, &incidences()) {
            let absorbed: f64 = fluxes.absorbed.iter().sum();
            let sum = fluxes.reflected + fluxes.transmitted + absorbed;
            assert!((sum - 1.0).abs() < 1e-12, "{sum}");
            let shares = [fluxes.reflected, fluxes.transmitted].into_iter();
            assert!(shares.chain(fluxes.absorbed).all(|share| share > 0.0));
        }
    }
}

#[test]
fn diffuse_light_passes_equally_well_from_both_faces() {
    let light = solved(&varied(false), &[]);
    let [first, last] = [Face::First, Face::Last]
        .map(|face| fluxes(&light, face, &[Incidence::Lambertian])[0].clone());
    assert!((first.transmitted - last.transmitted).abs() < 1e-13);
    assert!((first.reflected - last.reflected).abs() > 0.01);
}

#[test]
fn radiance_is_the_same_when_light_goes_the_other_way() {
    let light = solved(&varied(false), &[0.9, 0.3]);
    let from = |face, cosine| leaving(&light, face, Incidence::Directional { cosine });
    for face in [Face::First, Face::Last] {
        let there = from(face, 0.9)[1].reflected;
        let back = from(face, 0.3)[0].reflected;
        assert!((there / back - 1.0).abs() < 1e-7, "{there} {back}");
    }
    let there = from(Face::First, 0.9)[1].transmitted;
    let back = from(Face::Last, 0.3)[0].transmitted;
    assert!((there / back - 1.0).abs() < 1e-7, "{there} {back}");
    let azimuths = [0.0, 1.0, PI];
    let there = leaving_by_azimuth(&light, Face::First, 0.9, &azimuths);
    let back = leaving_by_azimuth(&light, Face::Last, 0.3, &azimuths);
    for (there, back) in there.iter().zip(&back) {
        let (there, back) = (there[1].transmitted, back[0].transmitted);
        assert!((there / back - 1.0).abs() < 1e-6, "{there} {back}");
    }
}

#[test]
fn layers_that_are_cut_in_two_do_the_same() {
    let whole = varied(false);
    let halves = whole.layers().iter().flat_map(|layer| {
        let part = |share: f64| Layer {
            depth: layer.depth * share,
            ..*layer
        };
        [part(0.3), part(0.7)]
    });
    let cut = Stack::new(halves.collect()).expect("layers in range");
    let (whole, cut) = (solved(&whole, &COSINES), solved(&cut, &COSINES));
    for face in [Face::First, Face::Last] {
        let pairs = fluxes(&whole, face, &incidences());
        for (whole, cut) in pairs.into_iter().zip(fluxes(&cut, face, &incidences())) {
            assert!((whole.reflected - cut.reflected).abs() < 1e-11);
            assert!((whole.transmitted - cut.transmitted).abs() < 1e-11);
            for (whole, halves) in whole.absorbed.iter().zip(cut.absorbed.chunks(2)) {
                assert!((whole - halves[0] - halves[1]).abs() < 1e-11);
            }
        }
    }
}

#[test]
fn a_layer_without_end_reflects_as_the_h_function_says() {
    for eta in [1.0, 1.38, 1.5] {
        let space = HalfSpace::new(eta);
        for albedo in [0.0, 0.3, 0.9, 0.999] {
            let light = solved(&one_layer(eta, albedo, f64::INFINITY, 0.0), &[1.0]);
            let incidences = [Incidence::NORMAL, Incidence::Lambertian];
            let fluxes = fluxes(&light, Face::First, &incidences);
            let exact = space.reflected(albedo, 0.0);
            for (found, exact) in fluxes.iter().zip([exact.normal, exact.diffuse]) {
                let off = found.reflected - exact;
                assert!(off.abs() < 2e-7, "{eta} {albedo}: {off:e}");
                assert!(found.transmitted.abs() < 1e-15);
            }
        }
    }
}

#[test]
fn a_plate_that_does_not_scatter_follows_the_geometric_series() {
    for (index, depth) in [(1.47, 0.0), (1.47, 0.3), (1.33, 4.0)] {
        let light = solved(&one_layer(index, 0.0, depth, 0.0), &[1.0, 0.4]);
        for cosine in [1.0_f64, 0.4] {
            let refracted = (1.0 - (1.0 - cosine * cosine) / (index * index)).sqrt();
            let r = boundary::reflectance(1.0, index, cosine, refracted);
            let through = libm::exp(-depth / refracted);
            let series = 1.0 / (1.0 - r * r * through * through);
            let t = (1.0 - r) * (1.0 - r) * through * series;
            let found = &fluxes(&light, Face::Last, &[Incidence::Directional { cosine }])[0];
            assert!((found.transmitted - t).abs() < 1e-12);
            assert!((found.reflected - r - r * through * t).abs() < 1e-12);
        }
    }
}

#[test]
fn a_deeper_layer_that_absorbs_lets_less_through_and_one_too_deep_nothing() {
    let through = |depth| {
        let light = solved(&one_layer(1.4, 0.9, depth, 0.5), &[1.0]);
        fluxes(&light, Face::First, &[Incidence::NORMAL])[0].transmitted
    };
    let mut before = 1.0;
    for depth in [0.01, 0.1, 1.0, 10.0] {
        let now = through(depth);
        assert!(now < before && now > 0.0, "{depth}: {now:e}");
        before = now;
    }
    assert!(through(100.0).abs() < 1e-15 && through(1e6).abs() < 1e-15);
}

#[test]
fn a_thick_layer_without_absorption_diffuses() {
    // The asymptotic law of a conservative isotropic slab, (4/3) K(1) / (b + 2 q), with Hopf's
    // q = 0.710446 and the escape function K(1) = √3/4 H(1), H(1) = 2.907810.
    for depth in [100.0, 1e4, 1e6] {
        let light = solved(&one_layer(1.0, 1.0, depth, 0.0), &[1.0]);
        let found = &fluxes(&light, Face::First, &[Incidence::NORMAL])[0];
        let law = 2.907_810 / 3.0_f64.sqrt() / (depth + 2.0 * 0.710_446);
        let off = found.transmitted / law - 1.0;
        assert!(off.abs() < 1e-5, "{depth}: {off:e}");
        assert!((found.reflected + found.transmitted - 1.0).abs() < 1e-9);
    }
}

#[test]
fn layers_that_differ_do_as_another_programs_layers_do() {
    // PythonicDISORT, `reference/results/slabs.md`: R and T at normal and at Lambertian incidence.
    let layer = |albedo, depth, g| Layer {
        index: 1.0,
        albedo,
        depth,
        phase: Phase::HenyeyGreenstein { g },
    };
    let layers = vec![
        layer(0.8, 0.5, 0.5),
        layer(0.99, 1.0, 0.7),
        layer(0.9, 2.0, 0.0),
    ];
    let stack = Stack::new(layers).expect("layers in range");
    let light = solved(&stack, &[1.0]);
    for (face, known) in [
        (Face::First, [0.3118409, 0.2496975, 0.3696118, 0.1786844]),
        (Face::Last, [0.3835999, 0.2482193, 0.4554050, 0.1786844]),
    ] {
        let found = fluxes(&light, face, &[Incidence::NORMAL, Incidence::Lambertian]);
        let found = found
            .iter()
            .flat_map(|one| [one.reflected, one.transmitted]);
        for (found, known) in found.zip(known) {
            assert!((found - known).abs() < 1e-6, "{found} for {known}");
        }
    }
}

#[test]
fn both_ways_find_the_same_in_layers_that_differ() {
    let stack = varied(false);
    let light = solved(&stack, &COSINES);
    for (seed, face) in (1..).zip([Face::First, Face::Last]) {
        for incidence in incidences() {
            let exact = &fluxes(&light, face, &[incidence])[0];
            let found = followed(&stack, face, incidence, Bins::NONE, 100_000, seed);
            let agree = |found: Estimate, exact: f64| {
                let z = (found.value - exact) / found.standard_error;
                assert!(z.abs() < 4.0, "{incidence:?}: {found:?} for {exact}");
            };
            agree(found.reflected, exact.reflected);
            agree(found.transmitted, exact.transmitted);
            for (found, exact) in found.absorbed.iter().zip(&exact.absorbed) {
                agree(*found, *exact);
            }
            let sum: f64 = found.absorbed.iter().map(|one| one.value).sum();
            let sum = sum + found.reflected.value + found.transmitted.value;
            assert!((sum - 1.0).abs() < 1e-12, "photons are lost: {sum}");
        }
    }
}

#[test]
fn photons_find_the_same_bits_on_any_number_of_threads() {
    let found = [1, 3].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let pool = pool.build().expect("threads can be made");
        let stack = varied(false);
        pool.install(|| {
            follow(
                &stack,
                Face::First,
                Incidence::NORMAL,
                Bins::NONE,
                30_000,
                3,
            )
        })
    });
    assert_eq!(found[0], found[1]);
}

#[test]
fn layers_out_of_range_are_refused_by_number_and_name() {
    let good = varied(false).layers()[1];
    let message = |layers: Vec<Layer>| Stack::new(layers).expect_err("refused").to_string();
    assert_eq!(
        message(vec![]),
        "there are no layers, there must be at least one"
    );
    assert_eq!(
        message(vec![good, Layer { index: 0.9, ..good }]),
        "the index of layer 2 is 0.9, it must be from 1 to 3"
    );
    for bad in [f64::NAN, -0.1, 1.1] {
        assert!(
            message(vec![Layer {
                albedo: bad,
                ..good
            }])
            .contains("the albedo of layer 1")
        );
    }
    let endless = Layer {
        depth: f64::INFINITY,
        ..good
    };
    assert!(message(vec![endless, good]).contains("infinite in the last layer only"));
    let lossless = Layer {
        albedo: 1.0,
        ..endless
    };
    assert!(message(vec![good, lossless]).contains("below 1 in a layer of infinite depth"));
    assert!(Stack::new(vec![good, endless]).is_ok());
    let phase = Phase::HenyeyGreenstein { g: 1.0 };
    assert!(message(vec![Layer { phase, ..good }]).contains("phase function of layer 1"));
    for cosine in [0.0, 1.1, f64::NAN] {
        let error = Ordinates::new(&varied(false), Resolution::FAST, &[cosine]);
        assert!(
            error
                .expect_err("refused")
                .to_string()
                .contains("the cosine")
        );
    }
}
