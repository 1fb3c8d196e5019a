//! The goniometer against the BSDF itself, closed forms, the sphere, and counting.

use std::f64::consts::{FRAC_1_PI, PI};

use glam::{Vec2, Vec3};
use renderer::instruments::Direction;
use renderer::spectrum::Wavelengths;

use super::brf::seen;
use super::{NORMAL, built, figures, of, rays};

fn beam(angle_deg: f64) -> Direction {
    Direction::Beam(angle_deg.to_radians())
}

/// A sheet of a leaf under coats, askew, and an instrument over a part of it.
fn coated(instrument: &str) -> String {
    format!(
        "[meshes.sheet.rectangle]\nwidth_m = 0.1\nheight_m = 0.1\n\
         [materials.leaf.leaf]\npreset = \"sun-green\"\n\
         adaxial = {{ eta = 1.5, alpha = 0.3 }}\nabaxial = {{ eta = 1.4, alpha = 0.5 }}\n\
         [objects.leaf]\nmesh = \"sheet\"\nmaterial = \"leaf\"\nposition_m = [0.3, 0.2, 0.1]\n\
         rotate_deg = [30, 20, 10]\n{instrument}"
    )
}

/// Unit vector at a zenith angle and an azimuth, degrees, on a side.
fn towards(zenith_deg: f64, azimuth_deg: f64, side: f64) -> Vec3 {
    let (sin, cos) = libm::sincos(zenith_deg.to_radians());
    let (sin_azimuth, cos_azimuth) = libm::sincos(azimuth_deg.to_radians());
    Vec3::new(
        (sin * cos_azimuth) as f32,
        (sin * sin_azimuth) as f32,
        (side * cos) as f32,
    )
}

#[test]
fn a_bare_leaf_has_the_factors_of_a_perfect_diffuser_times_its_reflectance_and_transmittance() {
    let text = "[meshes.sheet.rectangle]\nwidth_m = 0.1\nheight_m = 0.1\n\
        [materials.leaf.leaf]\nabaxial_ratio = 1\nadaxial = { eta = 1, alpha = 1 }\n\
        abaxial = { eta = 1, alpha = 1 }\n\
        [materials.leaf.leaf.measured]\nreflectance = 0.4\ntransmittance = 0.3\n\
        [objects.leaf]\nmesh = \"sheet\"\nmaterial = \"leaf\"\n\
        [instruments.arm.gonio]\nobject = \"leaf\"\nwavelengths_nm = [550]\n\
        spot = { at_mm = [0, 0], diameter_mm = 10 }\nincidence_deg = [0, 50]\ndiffuse = true\n\
        detector = { zenith_deg = [-70, 0, 35], relative_azimuth_deg = [0, 90] }\n";
    let rows = figures(text, &rays(1024)).expect("it can be measured");
    // Two faces; of beams four quantities, of diffuse light two; six directions.
    assert_eq!(rows.len(), 2 * (2 * 4 + 2) * 6);
    for row in rows {
        let expected = match row.quantity {
            "brf" | "hdrf" => 0.4,
            "btf" | "hdtf" => 0.3,
            "brdf" => 0.4 * FRAC_1_PI,
            "btdf" => 0.3 * FRAC_1_PI,
            other => panic!("{other}"),
        };
        assert!((row.value - expected).abs() < 1e-6, "{row:?}");
        let unit = if row.quantity.ends_with("df") {
            "sr-1"
        } else {
            "1"
        };
        assert_eq!(row.unit, unit);
    }
}

#[test]
fn a_flat_sheet_has_the_brdf_and_the_btdf_of_its_material() {
    let text = coated(
        "[instruments.arm.gonio]\nobject = \"leaf\"\nwavelengths_nm = [450, 550, 800]\n\
         spot = { at_mm = [3, -20], diameter_mm = 20 }\nincidence_deg = [0, 25, 60]\n\
         azimuth_deg = 40\n\
         detector = { zenith_deg = [-60, -25, 0, 40], relative_azimuth_deg = [0, 50] }\n",
    );
    let rows = figures(&text, &rays(1024)).expect("it can be measured");
    let (_, world, _) = built(&text);
    let material = &world.materials[world.objects[0].material];
    let wavelengths = Wavelengths::new([450.0_f32, 550.0, 800.0, 900.0]);
    let bsdf = material.bsdf(Vec2::splat(0.5), &wavelengths);
    let mut compared = 0;
    for row in rows.iter().filter(|row| row.unit == "sr-1") {
        let Direction::Beam(incidence) = row.incidence else {
            panic!("{row:?}");
        };
        let [zenith, azimuth] = row.view.expect("it is seen from somewhere").degrees();
        // A lit abaxial face is the lower side of the local frame; the coats are isotropic.
        let up = if row.face == Some("adaxial") {
            1.0
        } else {
            -1.0
        };
        let side = if row.quantity == "brdf" { up } else { -up };
        let light = towards(incidence.to_degrees(), 0.0, up);
        let f = bsdf.eval(light, towards(zenith, azimuth, side));
        let lane = [450.0, 550.0, 800.0]
            .iter()
            .position(|nm| row.wavelength_nm == Some(*nm))
            .expect("it is one of three");
        let expected = f64::from(f.0[lane]);
        assert!(
            (row.value - expected).abs() < 1e-4 * expected + 1e-7,
            "{row:?} for {expected}"
        );
        compared += 1;
    }
    assert_eq!(compared, 2 * 3 * 3 * 8 * 2);
}

#[test]
fn factors_of_all_directions_make_what_the_sphere_gathers() {
    // ∫ BRF cos θ dω / π: Gauss' eight points of μ² in [0, 1], and even azimuths.
    let nodes = [
        (0.019_855_071_751_232, 0.050_614_268_145_188),
        (0.101_666_761_293_187, 0.111_190_517_226_687),
        (0.237_233_795_041_835, 0.156_853_322_938_944),
        (0.408_282_678_752_175, 0.181_341_891_689_181),
        (0.591_717_321_247_825, 0.181_341_891_689_181),
        (0.762_766_204_958_164, 0.156_853_322_938_944),
        (0.898_333_238_706_813, 0.111_190_517_226_687),
        (0.980_144_928_248_768, 0.050_614_268_145_188),
    ];
    let zeniths = nodes.iter().rev();
    let zeniths: Vec<f64> = zeniths
        .map(|(square, _)| libm::acos(f64::sqrt(*square)).to_degrees())
        .collect();
    let azimuths: Vec<f64> = (0..32).map(|i| 11.25 * f64::from(i)).collect();
    let spot = "spot = { at_mm = [0, 0], diameter_mm = 10 }";
    let text = coated(&format!(
        "[instruments.ball.sphere]\nobject = \"leaf\"\nwavelengths_nm = [680]\n{spot}\n\
         incidence_deg = [30]\ndiffuse = false\n\
         [instruments.arm.gonio]\nobject = \"leaf\"\nwavelengths_nm = [680]\n{spot}\n\
         incidence_deg = [30]\n\
         detector = {{ zenith_deg = {zeniths:?}, relative_azimuth_deg = {azimuths:?} }}\n"
    ));
    let rows = figures(&text, &rays(1 << 16)).expect("it can be measured");
    for face in ["adaxial", "abaxial"] {
        for (factor, gathered) in [("brf", "reflectance"), ("btf", "transmittance")] {
            let on_face =
                |word| of(&rows, word, beam(30.0), 680.0).filter(move |row| row.face == Some(face));
            let whole = on_face(gathered).next().expect("it is measured");
            let factors: Vec<f64> = on_face(factor).map(|row| row.value).collect();
            assert_eq!(factors.len(), 8 * 32);
            let sum: f64 = factors
                .chunks(8)
                .flat_map(|of_azimuth| of_azimuth.iter().rev().zip(nodes))
                .map(|(factor, (_, weight))| factor * weight / 32.0)
                .sum();
            let off = (sum - whole.value).abs();
            assert!(
                off < 4.0 * whole.error + 5e-4,
                "{face} {factor}: {sum} for {whole:?}"
            );
            assert!(whole.error < 1e-3, "{whole:?}");
        }
    }
}

#[test]
fn counting_and_next_events_agree_on_a_body_that_lights_itself() {
    let text = |estimator: &str| {
        format!(
            "[meshes.bowl.disc]\nradius_m = 0.05\n[meshes.ball.sphere]\nradius_m = 0.05\n\
             [materials.leaf.leaf]\npreset = \"sun-green\"\n\
             [objects.ball]\nmesh = \"ball\"\nmaterial = \"leaf\"\n\
             [instruments.arm.gonio]\nobject = \"ball\"\nwavelengths_nm = [550, 800]\n\
             incidence_deg = [40]\nfaces = \"adaxial\"\n\
             detector = {{ estimator = \"{estimator}\", zenith_deg = [-60, 0, 45], \
             half_angle_deg = 12 }}\n"
        )
    };
    let [events, counted] = ["next-event", "count"]
        .map(|word| figures(&text(word), &rays(1 << 16)).expect("it can be measured"));
    for (event, count) in events.iter().zip(&counted) {
        let error = event.error.hypot(count.error);
        assert!(
            (event.value - count.value).abs() < 4.0 * error,
            "{event:?} {count:?}"
        );
        // In a cone of 0.14 sr few are counted.
        let is_sure = error < 0.1 * count.value || error < 0.02;
        assert!(is_sure, "{event:?} {count:?}");
    }
}

#[test]
fn a_white_ball_is_as_bright_as_lambert_says() {
    // The intensity of a Lambert ball over that of its lit disc: 2 (sin a + (π − a) cos a) / 3π,
    // a the phase angle; a reflectance factor divides by the cosine to the normal of its plane.
    let text = "[meshes.ball.sphere]\nradius_m = 0.1\n[materials.white.diffuse]\nreflectance = 1\n\
        [objects.ball]\nmesh = \"ball\"\nmaterial = \"white\"\n\
        [instruments.arm.gonio]\nobject = \"ball\"\nwavelengths_nm = [550]\nfaces = \"adaxial\"\n\
        detector = { zenith_deg = [0, 30, 60, 80] }\n";
    let rows = figures(text, &rays(1 << 16)).expect("it can be measured");
    for zenith in [0.0_f64, 30.0, 60.0, 80.0] {
        let row = seen(&rows, "brf", NORMAL, 550.0, [zenith, 0.0]);
        let a = zenith.to_radians();
        let (sin, cos) = libm::sincos(a);
        let expected = 2.0 / 3.0 * (sin + (PI - a) * cos) / PI / cos;
        let off = (row.value - expected).abs();
        // 64 segments take off up to 2e-3.
        assert!(
            off < 4.0 * row.error + 3e-3 * expected,
            "{row:?} for {expected}"
        );
        assert!(row.error < 5e-3 * expected, "{row:?}");
    }
}
