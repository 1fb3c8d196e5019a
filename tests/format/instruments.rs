//! What blocks of instruments mean.

use glam::{DVec2, DVec3};
use renderer::scene::description::{Amount, Estimator, InstrumentKind, Light, SpotMiddle};

use super::accepted::assert_near;
use super::{accept, refuse, text_of};

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

#[test]
fn a_compass_bearing_is_an_azimuth_clockwise_from_plus_y() {
    let scene =
        |overrides: &[&str]| accept(&text_of("whole.toml"), "whole.toml", overrides).description;
    let sun_of = |overrides: &[&str]| {
        let lights = scene(overrides).lights;
        let noon = lights.iter().find(|light| light.name == "noon");
        let Some(Light::Daylight(day)) = noon.map(|noon| &noon.value) else {
            panic!("{noon:?}");
        };
        day.towards_sun()
    };
    // The example of Reda and Andreas (2004): 194.340° from north over east, 50.11° from the zenith.
    let by_time = [
        "lights.noon.daylight.time='2003-10-17T12:30:30-07:00'",
        "lights.noon.daylight.latitude_deg=39.742476",
        "lights.noon.daylight.longitude_deg=-105.1786",
        "lights.noon.daylight.north_azimuth_deg=90",
    ];
    let by_compass = "lights.noon={ daylight = { elevation_deg = 39.888, compass_deg = 194.340 } }";
    let [timed, bearing] = [sun_of(&by_time), sun_of(&[by_compass])];
    assert!(
        timed.angle_between(bearing) < 0.05_f64.to_radians(),
        "{timed} {bearing}"
    );
    for (bearing, expected) in [
        (0, DVec3::Y),
        (90, DVec3::X),
        (180, -DVec3::Y),
        (-90, -DVec3::X),
    ] {
        let light = format!(
            "lights.lamp={{ distant = {{ irradiance_w_m2_nm = 1, elevation_deg = 0, compass_deg = {bearing} }} }}"
        );
        let scene = scene(&[&light]);
        let lamp = scene.lights.iter().find(|light| light.name == "lamp");
        let Some(Light::Distant(lamp)) = lamp.map(|lamp| &lamp.value) else {
            panic!("{lamp:?}");
        };
        assert_eq!(lamp.towards, expected, "{bearing}");
    }
    // Light from the south-east, seen from there, from the north-east and from the south.
    let keys =
        "within_m = [0, 0, 1, 1], compass_deg = 135, detector = { compass_deg = [45, 135, 180] }";
    let field = format!("instruments.field={{ canopy = {{ {keys} }} }}");
    let scene = scene(&[&field]);
    let field = scene.instruments.iter().find(|own| own.name == "field");
    let Some(InstrumentKind::Canopy(canopy)) = field.map(|field| &field.value.kind) else {
        panic!("{field:?}");
    };
    assert_near(canopy.incidence.azimuth, -45_f64.to_radians());
    let detector = canopy.detector.as_ref().expect("it has a detector");
    for (found, expected) in detector.azimuths.iter().zip([90_f64, 0.0, -45.0]) {
        assert_near(*found, expected.to_radians());
    }
    let both = "lights.evening.daylight.compass_deg=20";
    let errors = refuse(&text_of("whole.toml"), "whole.toml", &[both]);
    assert!(
        errors
            .to_string()
            .contains("`compass_deg` and `azimuth_deg` exclude each other"),
        "{errors}"
    );
}
