//! What blocks of instruments mean.

use glam::DVec2;
use renderer::scene::description::{Amount, Estimator, InstrumentKind, SpotMiddle};

use super::accepted::assert_near;
use super::{accept, text_of};

#[test]
fn instruments_are_in_si_units_and_know_where_they_stand() {
    let scene = accept(&text_of("whole.toml"), "whole.toml", &[]).description;
    let [ball, spot, field, arm, inside] = scene.instruments.as_slice() else {
        panic!("{:?}", scene.instruments);
    };
    assert_eq!(
        ball.value.wavelengths_nm,
        [500.0, 550.0, 600.0, 650.0, 700.0]
    );
    assert!(
        ball.value.at.starts_with("whole.toml:"),
        "{}",
        ball.value.at
    );
    let InstrumentKind::Sphere(sphere) = &ball.value.kind else {
        panic!("{ball:?}");
    };
    assert_eq!((sphere.object, sphere.faces), (0, [false, true]));
    let incidence = &sphere.incidence;
    assert_near(incidence.angles[1], 60_f64.to_radians());
    assert_near(incidence.azimuth, std::f64::consts::FRAC_PI_2);
    assert!(!incidence.diffuse);
    let own = sphere.spot.as_ref().expect("it has a spot");
    assert_near(own.diameter, 0.005);
    assert_eq!(own.middle, SpotMiddle::Point(DVec2::new(0.001, -0.002)));
    // What is left out has the defaults of the book.
    let InstrumentKind::Sphere(sphere) = &spot.value.kind else {
        panic!("{spot:?}");
    };
    assert_eq!(spot.value.wavelengths_nm.len(), 211);
    assert_eq!(
        (sphere.faces, &*sphere.incidence.angles),
        ([true, true], &[0.0][..])
    );
    assert!(sphere.incidence.diffuse);
    let InstrumentKind::Canopy(canopy) = &field.value.kind else {
        panic!("{field:?}");
    };
    assert_eq!(canopy.within, [DVec2::ZERO, DVec2::new(2.0, 1.0)]);
    assert_eq!((canopy.soil, &*canopy.layers), (Some(0), &[0.5, 1.5][..]));
    assert!(canopy.incidence.diffuse);
    assert!(canopy.constituents && canopy.instances);
    let detector = canopy.detector.as_ref().expect("it has a detector");
    assert_near(detector.zeniths[0], -30_f64.to_radians());
    assert_near(detector.azimuths[1], std::f64::consts::FRAC_PI_2);
    // 2π (1 − cos α) = 0.01 sr.
    assert_near(
        std::f64::consts::TAU * (1.0 - detector.half_angle.cos()),
        0.01,
    );
    let incident = field.value.incident.as_ref().expect("it has light");
    assert_eq!(incident.amount, Amount::Photons(1500.0));
    let InstrumentKind::Gonio(gonio) = &arm.value.kind else {
        panic!("{arm:?}");
    };
    assert_eq!(gonio.detector.zeniths.len(), 7);
    assert_eq!(gonio.detector.estimator, Estimator::Count);
    assert!(!gonio.sample.incidence.diffuse);
    // Bands alone: nine of the sensor, two of its own, two lines of the PRI.
    assert_eq!(arm.value.wavelengths_nm.len(), 0);
    assert_eq!(arm.value.bands.len(), 13);
    assert_eq!(arm.value.indices[0].bands, [4, 3]);
    let InstrumentKind::Depth(depth) = &inside.value.kind else {
        panic!("{inside:?}");
    };
    assert_eq!((depth.slices, depth.faces), (4, [true, true]));
}
