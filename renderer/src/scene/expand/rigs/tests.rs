use std::path::Path;

use glam::{Vec2, Vec3};

use super::*;
use std::f64::consts::TAU;

use crate::geometry::ray::Ray;
use crate::light::{Light as Built, LightSample, Receiver};
use crate::scene::load::parse;
use crate::scene::world::World;
use crate::spectrum::Wavelengths;

const SCENE: &str = r#"
format = 1
[film.rgb]
size = [8, 8]
spp = 1
[camera.perspective]
position_m = [0.3, -0.4, 0.5]
look_at_m = [0.1, 0.2, 0]
vertical_fov_deg = 20
[meshes.floor.rectangle]
width_m = 0.1
height_m = 0.1
[materials.paper.diffuse]
reflectance = 0.8
[objects.floor]
mesh = "floor"
material = "paper"
position_m = [0.1, 0.2, 0]
"#;

fn scene(rig: &str) -> Description {
    let text = format!("{SCENE}[lights.set.rig]\n{rig}\n");
    let loaded = parse(&text, "scene.toml", Path::new("."), &[]);
    loaded.expect("the test's own scene is right").description
}

/// Whether anything but the sheet itself lies between a point on it and another.
fn is_shaded(world: &World, from: Vec3, way: Vec3) -> bool {
    let distance = way.length();
    let ray = Ray::new(from + 1e-5 * Vec3::Z, way / distance)
        .starting_at(1e-4)
        .up_to(distance);
    world.geometry.occluded(&ray)
}

/// Share of directions over a level sheet, by their cosine, in which nothing lies.
fn open_share(world: &World, from: Vec3) -> f64 {
    let side: u32 = 128;
    let open = (0..side * side).filter(|i| {
        let u = (f64::from(i % side) + 0.5) / f64::from(side);
        let turn = TAU * (f64::from(i / side) + 0.5) / f64::from(side);
        let level = (1.0 - u * u).sqrt();
        // Even over directions; each counts by its cosine.
        let way = DVec3::new(level * turn.cos(), level * turn.sin(), u);
        !is_shaded(world, from, 1e6 * way.as_vec3())
    });
    let cosine = |i: u32| (f64::from(i % side) + 0.5) / f64::from(side);
    let all: f64 = (0..side * side).map(cosine).sum();
    open.map(cosine).sum::<f64>() / all
}

/// Irradiance of a level sheet at the subject at 560 nm, by samples of every light.
fn on_paper(world: &World) -> f64 {
    let receiver = Receiver {
        position: (DVec3::new(0.1, 0.2, 0.0) - world.geometry.origin()).as_vec3(),
        normal: Vec3::Z,
    };
    let wavelengths = Wavelengths::<1>::new([LEVEL_NM]);
    let side = 128;
    let mut sum = 0.0;
    for light in &world.lights {
        let parts = match light {
            Built::Constant(radiance) => {
                let open = open_share(world, receiver.position);
                sum += PI * open * f64::from(radiance.lanes(&wavelengths).mean());
                continue;
            }
            Built::Area(area) => area.patches().len(),
            Built::Distant(_)
            | Built::Environment(_)
            | Built::Sun(_)
            | Built::Sky(_)
            | Built::Spot(_) => 1,
        };
        for part in 0..parts {
            for i in 0..side * side {
                let u = Vec2::new((i % side) as f32 + 0.5, (i / side) as f32 + 0.5);
                let sample = light.sample(part, &receiver, &wavelengths, u / side as f32);
                let reaches = |sample: &LightSample<1>| {
                    let point = sample
                        .point
                        .map_or(1e6 * sample.wi, |p| p - receiver.position);
                    sample.wi.z > 0.0 && !is_shaded(world, receiver.position, 0.999 * point)
                };
                if let Some(sample) = sample.filter(reaches) {
                    let light = sample.radiance.mean() * sample.wi.z / sample.pdf;
                    sum += f64::from(light) / f64::from(side * side);
                }
            }
        }
    }
    sum
}

#[test]
fn a_level_sheet_gets_the_light_of_a_picture_that_needs_no_exposure() {
    for preset in ["studio", "tent", "lightbox", "overcast", "golden-hour"] {
        for (keys, expected) in [("", ON_PAPER), ("ev = -1\nsize_m = 0.3", 0.5 * ON_PAPER)] {
            let scene = scene(&format!("preset = \"{preset}\"\n{keys}"));
            let world = World::build(&scene).expect("it can be built");
            let found = on_paper(&world);
            let off = (found / expected - 1.0).abs();
            assert!(off < 0.01, "{preset} {keys}: {found}, not {expected}");
        }
    }
}

#[test]
fn a_tent_is_open_where_the_camera_looks_in() {
    let walls = |position: &str| {
        let text = SCENE.replace("[0.3, -0.4, 0.5]", position);
        let fov = "vertical_fov_deg = 20";
        let text = text.replace(fov, &format!("{fov}\nup = [0, 1, 0.1]"));
        let text = format!("{text}[lights.set.rig]\npreset = \"tent\"\n");
        let scene = parse(&text, "scene.toml", Path::new("."), &[]);
        let scene = scene.expect("the test's own scene is right").description;
        let walls = scene
            .objects
            .iter()
            .filter_map(|object| object.name.strip_prefix("set."));
        walls.map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(walls("[0.1, -0.6, 0.1]"), ["left", "right", "back", "roof"]);
    assert_eq!(walls("[0.1, 0.2, 0.8]"), ["left", "right", "back"]);
}

#[test]
fn a_forest_takes_some_of_the_sky_but_not_the_sun() {
    let world = World::build(&scene("preset = \"forest-edge\"")).expect("it can be built");
    let share = on_paper(&world) / ON_PAPER;
    assert!(
        (0.8..1.0).contains(&share),
        "{share} of the light of open land"
    );
}

#[test]
fn soft_boxes_turn_with_the_camera_and_grow_with_the_subject() {
    let boxes = |keys: &str| {
        let scene = scene(&format!("preset = \"studio\"\n{keys}"));
        let objects = scene
            .objects
            .into_iter()
            .filter(|object| object.name.starts_with("set."));
        objects
            .map(|object| (object.name, object.value.to_world))
            .collect::<Vec<_>>()
    };
    let usual = boxes("");
    let names: Vec<_> = usual.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["set.key", "set.fill", "set.rim"]);
    let subject = DVec3::new(0.1, 0.2, 0.0);
    for (_, frame) in &usual {
        let towards = (subject - frame.w_axis.truncate()).normalize();
        assert!((frame.z_axis.truncate() - towards).length() < 1e-12);
    }
    // The camera stands behind and to the right, and looks to the left of +y.
    let ahead = DVec3::new(-0.2, 0.6, 0.0).normalize();
    let key = usual[0].1.w_axis.truncate() - subject;
    assert!(key.dot(ahead) < 0.0, "the key stands on the camera's side");
    assert!(key.dot(ahead.cross(DVec3::Z)) < 0.0, "and to its left");
    let larger = boxes("size_m = 0.2\nazimuth_deg = 90");
    let turned = larger[0].1.w_axis.truncate() - subject;
    assert!(
        (turned - 0.2 * DVec3::new(-4.0, -2.5, 4.5)).length() < 1e-12,
        "{turned}"
    );
}
