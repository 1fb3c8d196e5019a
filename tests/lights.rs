//! Lights: drawn as their densities say, and no light lost or won by choosing one of many.

use std::f64::consts::PI;
use std::path::Path;
use std::sync::atomic::AtomicBool;

use glam::{DVec3, Vec2, Vec3};
use renderer::integrator::render::{Job, render};
use renderer::light::Receiver;
use renderer::light::daylight::spctrl2::Atmosphere;
use renderer::light::patch::{Patch, patches};
use renderer::sampling::stream::Stream;
use renderer::sampling::warp;
use renderer::scene::load::parse;
use renderer::scene::world::World;
use support::chi_square::{ChiSquare, Outcome, sidak};
use support::picture::{mean_and_error, mean_of};

const RECTANGLE: [[Vec3; 3]; 2] = [
    [
        Vec3::new(-1.0, -0.5, 0.0),
        Vec3::new(1.0, -0.5, 0.0),
        Vec3::new(1.0, 0.5, 0.0),
    ],
    [
        Vec3::new(-1.0, -0.5, 0.0),
        Vec3::new(1.0, 0.5, 0.0),
        Vec3::new(-1.0, 0.5, 0.0),
    ],
];

/// Points around a patch about the origin in the plane z = 0: above it near and far, over an edge,
/// near a corner, beside it close to the plane, and where its solid angle is all but the half
/// space.
const RECEIVERS: [Vec3; 8] = [
    Vec3::new(0.1, -0.1, 0.5),
    Vec3::new(3.0, 40.0, 60.0),
    Vec3::new(-1.0, 0.2, 0.3),
    Vec3::new(1.2, 0.6, 0.2),
    Vec3::new(2.0, 1.0, 0.03),
    Vec3::new(-3.0, -2.0, 0.001),
    Vec3::new(0.3, -0.2, 0.05),
    Vec3::new(1.0, 2.0, 2.0),
];

/// Compares drawn points with the told density, in cells of equal area on the patch.
///
/// The unit square of places on the patch, laid around the sphere without change of area, stands in
/// for the directions that the test wants: so its cells are as fine on a patch that is far or seen
/// edge-on.
fn outcome(patch: &Patch, receiver: &Receiver, factor: impl Fn(f32) -> f32) -> Outcome {
    let test = ChiSquare {
        rings: 24,
        spokes: 24,
        draws: 60_000,
        midpoints: 12,
    };
    let to_sphere = |u: Vec2| {
        let z = 1.0 - 2.0 * u.y;
        let radius = (1.0 - z * z).max(0.0).sqrt();
        let (sin, cos) = libm::sincosf(std::f32::consts::TAU * u.x);
        Vec3::new(radius * cos, radius * sin, z)
    };
    let from_sphere = |w: Vec3| {
        let azimuth = libm::atan2f(w.y, w.x) / std::f32::consts::TAU;
        Vec2::new(azimuth - azimuth.floor(), 0.5 - 0.5 * w.z)
    };
    let sample = |draw: usize| {
        // A pixel each: points of one pixel are spread more evenly than chance, and would hide what
        // is wrong.
        let mut stream = Stream::new(11, draw as u32, 0, 0);
        let [x, y, ..] = stream.next4();
        let point = patch.sample(receiver, Vec2::new(x, y))?.point;
        Some(to_sphere(match patch {
            Patch::Rectangle(_) => Vec2::new(0.5 * point.x + 0.5, point.y + 0.5),
            Patch::Triangle(_) => {
                // Weights of the triangle's second and third corner, and `warp::triangle`
                // backwards.
                let third = point.y + 0.5;
                let sum = 0.5 * (point.x + 1.0);
                Vec2::new(sum * sum, third / sum)
            }
        }))
    };
    let pdf = |w: Vec3| {
        let u = from_sphere(w);
        let point = match patch {
            Patch::Rectangle(_) => Vec3::new(2.0 * u.x - 1.0, u.y - 0.5, 0.0),
            Patch::Triangle(_) => {
                let weights = warp::triangle(u);
                Vec3::new(2.0 * (weights.x + weights.y) - 1.0, weights.y - 0.5, 0.0)
            }
        };
        let offset = receiver.position - point;
        let distance2 = offset.length_squared();
        let solid_angle_per_area = offset.z.max(0.0) / (distance2 * distance2.sqrt());
        let by_area = patch.pdf(receiver, point) * solid_angle_per_area;
        factor(u.x) * by_area * patch.area() / (4.0 * std::f32::consts::PI)
    };
    test.run(sample, pdf)
}

fn rectangle_and_triangle() -> [Patch; 2] {
    let [rectangle] = <[Patch; 1]>::try_from(patches(&RECTANGLE).0).expect("one rectangle");
    let [triangle] = <[Patch; 1]>::try_from(patches(&RECTANGLE[..1]).0).expect("one triangle");
    [rectangle, triangle]
}

#[test]
fn points_of_a_patch_are_drawn_with_the_density_that_is_reported_for_them() {
    let normals = [Vec3::Z, Vec3::X, Vec3::new(0.6, -0.5, 0.2).normalize()];
    let level = sidak(0.01, 2 * RECEIVERS.len() * normals.len());
    for patch in rectangle_and_triangle() {
        for position in RECEIVERS {
            for normal in normals {
                let outcome = outcome(&patch, &Receiver { position, normal }, |_| 1.0);
                eprintln!("{position}, {normal}: {outcome}");
                assert!(outcome.p_value > level, "{position}, {normal}: {outcome}");
                assert!(outcome.drawn > 0.9999, "{position}: {outcome}");
                let total = outcome.total_density;
                assert!((total - 1.0).abs() < 5e-3, "{position}: {outcome}");
            }
        }
    }
}

#[test]
fn a_density_that_ripples_by_a_fifth_is_found() {
    let normal = Vec3::Z;
    for patch in rectangle_and_triangle() {
        for position in RECEIVERS {
            let receiver = Receiver { position, normal };
            let ripple = |u: f32| 1.0 + 0.2 * libm::sinf(12.0 * std::f32::consts::TAU * u);
            let outcome = outcome(&patch, &receiver, ripple);
            assert!(outcome.p_value < 1e-6, "{position}: {outcome}");
        }
    }
}

/// Irradiance at the origin with normal +z from a polygon of radiance 1 above it, by Lambert's
/// formula.
fn lambert(corners: &[DVec3]) -> f64 {
    let mut sum = 0.0;
    for (i, a) in corners.iter().enumerate() {
        let b = corners[(i + 1) % corners.len()];
        let normal = a.cross(b);
        sum += a.angle_between(b) * normal.normalize().z;
    }
    0.5 * sum.abs()
}

/// A floor of reflectance 0.5 at the origin, seen from aside, under what `blocks` hang over it.
fn floor_under(blocks: &str, spp: u32) -> String {
    format!(
        "format = 1\n[film.spectral]\nsize = [16, 16]\nspp = {spp}\nbands_nm = [550]\nband_width_nm = 0\n\
         [camera.perspective]\nposition_m = [0.6, 0, 0.1]\nlook_at_m = [0, 0, 0]\nvertical_fov_deg = 0.1\n\
         [materials.grey.diffuse]\nreflectance = 0.5\n[materials.black.diffuse]\nreflectance = 0\n\
         [meshes.floor.rectangle]\nwidth_m = 0.1\nheight_m = 0.1\n[objects.floor]\nmesh = \"floor\"\nmaterial = \"grey\"\n{blocks}"
    )
}

fn assert_agrees(what: &str, found: (f64, f64), expected: f64, slack: f64) {
    let (mean, error) = found;
    eprintln!("{what}: {mean:.6} ± {error:.1e}, expected {expected:.6}");
    assert!(
        error < 3e-3 * expected,
        "{what}: the error {error} hides what is to be seen"
    );
    assert!(
        (mean - expected).abs() < 4.0 * error + slack * expected,
        "{what}: {mean} ± {error}, not {expected}"
    );
}

#[test]
fn a_hundred_lamps_give_the_sum_of_their_irradiances() {
    let mut blocks = "[meshes.lamp.rectangle]\nwidth_m = 0.06\nheight_m = 0.03\n".to_owned();
    let mut irradiance = 0.0;
    for i in 0..100_u32 {
        let (x, y) = (
            0.2 * (f64::from(i % 10) - 4.5),
            0.2 * (f64::from(i / 10) - 4.5),
        );
        let z = 1.0 + 0.003 * f64::from(i);
        let tilt = 180.0 + 40.0 * f64::from(i % 7) / 6.0 - 20.0;
        // One in eleven turns its back and gives nothing.
        let tilt = if i % 11 == 0 { tilt - 180.0 } else { tilt };
        let radiance = f64::from(1 + i % 5).powi(3);
        blocks += &format!(
            "[objects.lamp-{i}]\nmesh = \"lamp\"\nmaterial = \"black\"\nposition_m = [{x}, {y}, {z}]\n\
             rotate_deg = [{tilt}, 0, 0]\n[lights.lamp-{i}.area]\nobject = \"lamp-{i}\"\n\
             radiance_w_m2_sr_nm = {radiance}\n"
        );
        if i % 11 != 0 {
            let (sin, cos) = tilt.to_radians().sin_cos();
            let corners = [
                (-0.03, -0.015),
                (0.03, -0.015),
                (0.03, 0.015),
                (-0.03, 0.015),
            ];
            let corners = corners.map(|(p, q)| DVec3::new(x + p, y + q * cos, z + q * sin));
            irradiance += radiance * lambert(&corners);
        }
    }
    let found = mean_and_error(&floor_under(&blocks, 64), 0, 16);
    assert_agrees("100 lamps", found, 0.5 / PI * irradiance, 2e-5);
}

/// A spotlight over the floor, and the irradiance that it has at the origin by `I cos / d²`.
fn spot(number: u32, aim: DVec3, cone_deg: f64, penumbra_deg: f64) -> (String, f64) {
    let turn = f64::from(number);
    let place = DVec3::new(libm::sin(turn), libm::cos(turn), 0.7 + 0.01 * turn);
    let intensity = f64::from(1 + number % 4);
    let block = format!(
        "[lights.spot-{number}.spot]\nintensity_w_sr_nm = {intensity}\n\
         position_m = [{}, {}, {}]\nlook_at_m = [{}, {}, {}]\n\
         cone_angle_deg = {cone_deg}\npenumbra_angle_deg = {penumbra_deg}\n",
        place.x, place.y, place.z, aim.x, aim.y, aim.z
    );
    let off_axis = (aim - place).angle_between(-place).to_degrees();
    let share = if penumbra_deg > 0.0 {
        ((cone_deg - off_axis) / penumbra_deg).clamp(0.0, 1.0)
    } else {
        f64::from(u8::from(off_axis < cone_deg))
    };
    let cos = place.z / place.length();
    (block, share * intensity * cos / place.length_squared())
}

#[test]
fn spots_give_the_floor_their_intensity_by_the_square_of_the_distance() {
    let (aside, on) = (DVec3::new(0.2, 0.1, 0.0), DVec3::ZERO);
    for (aim, cone, penumbra) in [(on, 5.0, 0.0), (aside, 60.0, 0.0), (aside, 18.0, 15.0)] {
        let (block, irradiance) = spot(3, aim, cone, penumbra);
        let found = mean_and_error(&floor_under(&block, 16), 0, 4);
        // The picture is a millimetre of the floor, over which the distance changes by a
        // thousandth.
        let what = format!("{cone}°, {penumbra}°");
        assert_agrees(&what, found, 0.5 / PI * irradiance, 1e-3);
    }
}

#[test]
fn spots_among_lamps_are_chosen_without_loss() {
    let mut blocks = "[meshes.lamp.rectangle]\nwidth_m = 0.06\nheight_m = 0.03\n\
        [objects.lamp]\nmesh = \"lamp\"\nmaterial = \"black\"\nposition_m = [0, 0, 1]\n\
        rotate_deg = [180, 0, 0]\n[lights.lamp.area]\nobject = \"lamp\"\n\
        radiance_w_m2_sr_nm = 500\n"
        .to_owned();
    let corners = [
        (-0.03, -0.015),
        (0.03, -0.015),
        (0.03, 0.015),
        (-0.03, 0.015),
    ];
    let mut irradiance = 500.0 * lambert(&corners.map(|(x, y)| DVec3::new(x, y, 1.0)));
    let mut lit = 0;
    for number in 0..40 {
        let aim = DVec3::new(0.1 * f64::from(number % 9), 0.0, 0.0);
        let (block, own) = spot(number, aim, 16.0, f64::from(number % 3) * 8.0);
        blocks += &block;
        irradiance += own;
        lit += u32::from(own > 0.0);
    }
    assert!(
        (10..40).contains(&lit),
        "{lit} of 40 spots reach the origin"
    );
    let found = mean_and_error(&floor_under(&blocks, 256), 0, 16);
    assert_agrees("40 spots and a lamp", found, 0.5 / PI * irradiance, 1e-3);
}

#[test]
fn a_shining_ball_of_many_triangles_has_the_irradiance_of_a_sphere() {
    let (radius, height) = (0.3, 0.8);
    let blocks = format!(
        "[meshes.ball.sphere]\nradius_m = {radius}\nsegments = 128\n[objects.ball]\nmesh = \"ball\"\n\
         material = \"black\"\nposition_m = [0, 0, {height}]\n[lights.ball.area]\nobject = \"ball\"\n\
         radiance_w_m2_sr_nm = 2\n"
    );
    let irradiance = PI * 2.0 * (radius / height) * (radius / height);
    let found = mean_and_error(&floor_under(&blocks, 64), 0, 16);
    // Triangles between points of the sphere lie inside it, by at most 1 − cos(π / 128).
    assert_agrees("ball", found, 0.5 / PI * irradiance, 1.5e-3);
}

#[test]
fn a_floor_in_daylight_gets_the_irradiance_of_sun_and_sky_beside_other_lights_too() {
    let lamp = "[meshes.lamp.rectangle]\nwidth_m = 0.06\nheight_m = 0.03\n[objects.lamp]\n\
        mesh = \"lamp\"\nmaterial = \"black\"\nposition_m = [0, 0, 1]\nrotate_deg = [180, 0, 0]\n\
        [lights.lamp.area]\nobject = \"lamp\"\nradiance_w_m2_sr_nm = 500\n";
    let corners = [
        (-0.03, -0.015),
        (0.03, -0.015),
        (0.03, 0.015),
        (-0.03, 0.015),
    ];
    let by_lamp = 500.0 * lambert(&corners.map(|(x, y)| DVec3::new(x, y, 1.0)));
    for (elevation, blocks, beside) in [(25.0_f64, "", 0.0), (60.0, lamp, by_lamp)] {
        let day = format!(
            "[lights.day.daylight]\nelevation_deg = {elevation}\nazimuth_deg = 70\n{blocks}"
        );
        let air = Atmosphere::default();
        let rows = air.irradiance(elevation.to_radians());
        let row = rows.iter().find(|row| row.nm == 550.0);
        let row = row.expect("it is one of the rows of SPCTRL2");
        let up = elevation.to_radians().sin();
        let irradiance = row.direct * up + row.diffuse + beside;
        for sampled in ["", "[integrator]\nsample_skies = false\n"] {
            let day = format!("{day}{sampled}");
            let found = mean_and_error(&floor_under(&day, 64), 0, 8);
            // The lamp hides less than a thousandth of the sky.
            assert_agrees(&day, found, 0.5 / PI * irradiance, 1e-3);
        }
    }
}

#[test]
fn only_skies_without_bright_spots_may_be_left_to_bounces() {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
    let day = "[lights.day.daylight]\nelevation_deg = 30\nazimuth_deg = 70\n";
    let picture = |path: &str| format!("[lights.sky.environment]\npath = \"{path}\"\n");
    for (blocks, may_be) in [
        (picture("first-leaf/evening.png"), true),
        (day.to_owned(), true),
        // Gaps between leaves send most of its light.
        (picture("gallery/forest.hdr"), false),
        // Its sun was taken down.
        (picture("gallery/sunrise.hdr"), true),
        (
            "[lights.sky.constant]\nradiance_w_m2_sr_nm = 1\n".to_owned(),
            false,
        ),
    ] {
        let loaded = parse(&floor_under(&blocks, 16), "test.toml", &scenes, &[]);
        let description = loaded.map_err(|errors| errors.to_string());
        let description = description
            .expect("the test's own scene is right")
            .description;
        let world = World::build(&description).expect("the test's own scene can be built");
        assert_eq!(world.selections.have_even_skies(), may_be, "{blocks}");
        assert!(world.selections.of(false).is_empty(), "{blocks}");
    }
}

#[test]
fn lamps_and_a_picture_of_the_sky_add_up() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/first-leaf");
    let lamp = "[meshes.lamp.rectangle]\nwidth_m = 0.3\nheight_m = 0.3\n[objects.lamp]\nmesh = \"lamp\"\n\
                material = \"black\"\nposition_m = [0.1, 0.2, 0.4]\nrotate_deg = [180, 0, 0]\n";
    let lit = "[lights.lamp.area]\nobject = \"lamp\"\nradiance_w_m2_sr_nm = 3\n";
    let sky = "[lights.sky.environment]\npath = \"evening.png\"\n";
    let mean_and_error = |blocks: &str| {
        let text = floor_under(blocks, 64);
        let loaded = parse(&text, "test.toml", &folder, &[]);
        let description = loaded.map_err(|errors| errors.to_string());
        let description = description
            .expect("the test's own scene is right")
            .description;
        let world = World::build(&description).expect("the test's own scene can be built");
        let means = [1, 2, 3, 4, 5, 6, 7, 8].map(|seed| {
            let film = &description.film;
            let job = Job {
                width: film.width,
                height: film.height,
                spp: film.spp,
                seed,
            };
            let rendered = render(&world, &job, &AtomicBool::new(false), &|_| ());
            mean_of(&rendered.expect("a small film fits"), 0)
        });
        let mean = means.iter().sum::<f64>() / 8.0;
        let variance = means.iter().map(|m| (m - mean) * (m - mean)).sum::<f64>() / 7.0;
        (mean, (variance / 8.0).sqrt())
    };
    let alone = mean_and_error(&[lamp, lit].concat());
    // The dark lamp stays where it is and hides its part of the sky.
    let with_dark = mean_and_error(&[lamp, sky].concat());
    for samples in [
        "[integrator]\nlight_samples = 1\n",
        "[integrator]\nlight_samples = 6\n",
        "[integrator]\nlight_samples = 6\nsample_skies = false\n",
    ] {
        let both = mean_and_error(&[lamp, lit, sky, samples].concat());
        let error = (alone.1 * alone.1 + with_dark.1 * with_dark.1 + both.1 * both.1).sqrt();
        assert_agrees(samples, (both.0, error), alone.0 + with_dark.0, 2e-5);
    }
}
