use std::path::Path;
use std::sync::atomic::AtomicBool;

use glam::DVec3;

use super::World;
use crate::camera::view::Projection;
use crate::image::{Layer, Picture, openexr};
use crate::integrator::caption::Caption;
use crate::integrator::develop::develop;
use crate::integrator::render::{Job, render};
use crate::scene::load::parse;

const SCENE: &str = r#"
format = 1
[film.rgb]
size = [4, 4]
spp = 1
[camera.perspective]
position_m = [0, -1, 0]
look_at_m = [0, 0, 0]
vertical_fov_deg = 40
[lights.sky.constant]
radiance_w_m2_sr_nm = 1
[solids.first.shape.sphere]
radius_mm = 20
[solids.first.contents]
[solids.first.mosaic]
cells = 2000
days = 0
[solids.first.mosaic.types.one]
initial_share = 1
[solids.second.shape.sphere]
radius_mm = 20
[solids.second.contents]
[objects.first]
solid = "first"
[objects.second]
solid = "second"
"#;

#[test]
fn a_turned_camera_looks_at_the_same_point_from_another_side() {
    for (degrees, expected) in [(90.0, DVec3::X), (360.0, DVec3::NEG_Y)] {
        let turn = format!("camera.perspective.turn_deg={degrees}");
        let loaded = parse(SCENE, "scene.toml", Path::new("."), &[turn]);
        let loaded = loaded.unwrap_or_else(|errors| panic!("{errors}"));
        let view = loaded.description.camera.view;
        assert!((view.position - expected).length() < 1e-12, "{view:?}");
        assert_eq!(view.look_at, DVec3::ZERO);
    }
}

#[test]
fn of_several_bodies_that_cannot_be_grown_the_first_of_the_scene_is_reported() {
    let loaded = parse(SCENE, "scene.toml", Path::new("."), &[]);
    let mut scene = loaded
        .unwrap_or_else(|errors| panic!("{errors}"))
        .description;
    // The first error is found only when the mosaic is grown, the second at once.
    let pattern = scene.solids[0].value.plan.mosaic.clone();
    scene.solids[0].value.plan.map_size = 1;
    let pattern = scene.solids[1]
        .value
        .plan
        .mosaic
        .insert(pattern.expect("a mosaic"));
    pattern.contents.clear();
    let threads = rayon::ThreadPoolBuilder::new().num_threads(2).build();
    let built = threads
        .expect("two threads")
        .install(|| World::build(&scene));
    let error = built.expect_err("neither can be grown").to_string();
    assert!(error.starts_with("solids.first: map_size"), "{error}");
}

const MESHES: &str = r#"
format = 1
[film.rgb]
size = [4, 4]
spp = 1
[camera.perspective]
position_m = [0, -1, 0]
look_at_m = [0, 0, 0]
vertical_fov_deg = 40
[materials.grey.diffuse]
reflectance = 0.5
[materials.red.diffuse]
reflectance = 0.3
[meshes.floor.rectangle]
width_m = 1
height_m = 2
[meshes.ball.sphere]
radius_m = 0.1
[objects.row]
mesh = ["floor", "ball"]
material = ["grey", "red"]
position_m = [0, 0, 1]
rotate_deg = [0, 90, 0]
scale = 2
instances.file = "row.csv"
[objects.lamp]
mesh = "floor"
material = "grey"
[lights.lamp.area]
object = "lamp"
radiance_w_m2_sr_nm = 1
"#;

#[test]
fn instances_lie_where_their_object_and_their_row_say() {
    let folder = tempfile::tempdir().expect("a folder");
    let rows = "x_m y_m z_m rotate_z_deg scale shape\n0.5 0 0 90 3 ball\n0 0 0 0 1 floor\n\
                0 0.5 0 0 1 ball\n";
    std::fs::write(folder.path().join("row.csv"), rows).expect("a file");
    let loaded = parse(MESHES, "scene.toml", folder.path(), &[]);
    let scene = loaded
        .unwrap_or_else(|errors| panic!("{errors}"))
        .description;
    let world = World::build(&scene).expect("a scene that can be built");
    // The lamp stands in one place, so it comes first, and it alone shines.
    let of = |instance: usize| {
        let is = &world.objects[instance];
        let mesh = world.geometry.instance(instance as u32).mesh;
        (
            is.object,
            mesh,
            is.material,
            is.light,
            world.objects.place_of(instance as u32),
        )
    };
    assert_eq!(world.objects.len(), 4);
    assert_eq!(of(0), (1, 0, 0, Some(0), 0));
    assert_eq!(of(1), (0, 1, 1, None, 0));
    assert_eq!(of(2), (0, 0, 0, None, 1));
    assert_eq!(of(3), (0, 1, 1, None, 2));
    // (0.1, 0, 0) of the first row's ball: three times as large, turned to y, moved to x = 0.5;
    // then the object's: twice as large, x to −z, one up.
    let point = world
        .geometry
        .to_world(1)
        .transform_point3(glam::Vec3::new(0.1, 0.0, 0.0));
    let expected = glam::Vec3::new(0.0, 0.6, 1.0 - 1.0);
    assert!(point.distance(expected) < 1e-6, "{point} is not {expected}");
}

/// A leaf under a spotlight, and everything that has a place a given way off along x and z.
fn far_scene(off: f64) -> String {
    format!(
        r#"
format = 1
[film.rgb]
size = [24, 24]
spp = 32
[camera.perspective]
position_m = [{x0}, -0.25, {z2}]
look_at_m = [{x0}, 0, {z0}]
vertical_fov_deg = 20
aperture_diameter_mm = 4
[materials.leaf.leaf.contents]
structure = 1.5
chlorophyll_ug_per_cm2 = 40
carotenoids_ug_per_cm2 = 8
water_cm = 0.01
dry_matter_g_per_cm2 = 0.005
[meshes.ball.sphere]
radius_m = 0.03
[objects.ball]
mesh = "ball"
material = "leaf"
position_m = [{x0}, 0, {z0}]
[lights.lamp.spot]
position_m = [{x1}, -0.3, {z2}]
look_at_m = [{x0}, 0, {z0}]
cone_angle_deg = 30
intensity_w_sr_nm = 0.01
"#,
        x0 = off,
        x1 = off + 0.2,
        z0 = off,
        z2 = off + 0.2,
    )
}

#[test]
fn a_leaf_a_million_metres_away_looks_as_at_the_origin() {
    let picture = |off: f64| {
        let loaded = parse(&far_scene(off), "scene.toml", Path::new("."), &[]);
        let scene = loaded
            .unwrap_or_else(|errors| panic!("{errors}"))
            .description;
        let world = World::build(&scene).expect("it can be built");
        let job = Job {
            width: 24,
            height: 24,
            spp: 32,
            seed: 1,
        };
        let go = AtomicBool::new(false);
        let rendered = render(&world, &job, &go, &|_| ()).expect("a small film");
        develop(
            &Caption::of(&scene, &world.view, &world.light_colours),
            &job,
            &rendered,
        )
    };
    let off = 999_000.0;
    let (near, far) = (picture(0.0), picture(off));
    let channel = |picture: &Picture, name: &str| picture.layer(name).expect(name).data.clone();
    let mean = |values: &[f32]| values.iter().sum::<f32>() / values.len() as f32;
    for name in ["R", "G", "B", "A", "depth.Z"] {
        let (near, far) = (channel(&near, name), channel(&far, name));
        assert!(mean(&near) > 0.0, "{name}: nothing is seen");
        // The random numbers are the same, so only roundings differ.
        let off = (mean(&far) / mean(&near) - 1.0).abs();
        assert!(off < 1e-3, "{name}: {off}");
    }
    // Places are those of the scene as written, as fine as single precision has them.
    let (near, far) = (channel(&near, "P.X"), channel(&far, "P.X"));
    for (near, far) in near.iter().zip(&far).filter(|(near, _)| **near != 0.0) {
        assert!(
            (f64::from(*far) - off - f64::from(*near)).abs() < 0.04,
            "{near} and {far}"
        );
    }
}

const FOCUS: &str = r#"
format = 1
[film.rgb]
size = [8, 8]
spp = 1
[camera.perspective]
position_m = [0, OFF, 0]
look_at_m = [0, AHEAD, 0]
focal_length_mm = 100
f_number = 4
focus_object = "balls"
[materials.grey.diffuse]
reflectance = 0.5
[meshes.ball.sphere]
radius_m = 0.1
[objects.other]
mesh = "ball"
material = "grey"
position_m = [0, AHEAD, 0]
[objects.balls]
mesh = "ball"
material = "grey"
scale = 2
position_m = [0, OFF, 0]
instances.file = "balls.csv"
[lights.sky.constant]
radiance_w_m2_sr_nm = 1
"#;

#[test]
fn a_camera_focuses_on_the_middle_of_an_object_in_all_its_places() {
    let folder = tempfile::tempdir().expect("a place for temporary files");
    let focused = |off: i32, places: &str| {
        let text = FOCUS.replace("OFF", &off.to_string());
        let text = text.replace("AHEAD", &(off + 1).to_string());
        let places = format!("x_m y_m z_m\n{places}");
        std::fs::write(folder.path().join("balls.csv"), places).expect("a place");
        let loaded = parse(&text, "scene.toml", folder.path(), &[]);
        let scene = loaded
            .unwrap_or_else(|errors| panic!("{errors}"))
            .description;
        World::build(&scene)
    };
    // From 1 − 0.2 to 2 + 0.2 m; what lies beside the axis counts along it.
    for off in [0, -7000] {
        let world = focused(off, "0.5 0.5 0\n-0.1 1 0.2").expect("it is in front");
        let Projection::Perspective(lens) = &world.view.projection else {
            panic!("a lens was asked for");
        };
        // The coordinates of places are in single precision.
        let distance = lens.focus_distance;
        assert!((distance - 1.5).abs() < 2e-3, "{distance}");
        assert_eq!(world.view.position.y, f64::from(off));
        let image = 1.0 / (1.0 / 0.1 - 1.0 / distance);
        assert!((lens.image_distance - image).abs() < 1e-12);
    }
    for (places, problem) in [
        ("0 -1 0", "lies 2 m behind the lens"),
        ("0 0.045 0", "not farther than the focal length of 0.1 m"),
    ] {
        let error = focused(0, places).expect_err("it cannot be sharp");
        let error = error.to_string();
        let key = "camera.perspective.focus_object: ";
        assert!(error.starts_with(key) && error.contains(problem), "{error}");
    }
}

#[test]
fn a_camera_stands_as_near_as_what_fills_its_picture_allows() {
    let ball_of = |radius: f64, camera: &str, size: [u32; 2]| {
        let text = format!(
            "format = 1\n[film.rgb]\nsize = {size:?}\nspp = 1\n{camera}\nposition_m = [3, -4, 12]\nlook_at_m = [0, 0, 0]\n\
             [materials.grey.diffuse]\nreflectance = 0.5\n[meshes.ball.sphere]\nradius_m = {radius}\nsegments = 512\n\
             [objects.ball]\nmesh = \"ball\"\nmaterial = \"grey\"\nposition_m = [5, 6, 7]\n\
             [objects.far]\nmesh = \"ball\"\nmaterial = \"grey\"\nposition_m = [-50, 6, 7]\n\
             [lights.sky.constant]\nradiance_w_m2_sr_nm = 1\n"
        );
        let loaded = parse(&text, "scene.toml", Path::new("."), &[]);
        let loaded = loaded.unwrap_or_else(|errors| panic!("{errors}"));
        World::build(&loaded.description)
    };
    let ball = |camera: &str, size| ball_of(0.1, camera, size).expect("a good scene").view;
    let middle = DVec3::new(5.0, 6.0, 7.0);
    let direction = DVec3::new(-3.0, 4.0, -12.0) / 13.0;
    // A cone about the ball touches it at r / sin of half its angle.
    for (size, margin) in [([60, 40], 0.0), ([40, 60], 0.1)] {
        let camera = format!(
            "[camera.perspective]\nvertical_fov_deg = 40\nf_number = 8\nframe = \"ball\"\nframe_margin = {margin}"
        );
        let view = ball(&camera, size);
        let narrower = f64::from(size[0].min(size[1])) / f64::from(size[1]);
        let half = libm::atan(libm::tan(20_f64.to_radians()) * narrower * (1.0 - 2.0 * margin));
        let distance = 0.1 / libm::sin(half);
        let expected = middle - direction * distance;
        assert!(
            (view.position - expected).length() < 1e-4 * distance,
            "{view:?}"
        );
        let Projection::Perspective(lens) = &view.projection else {
            panic!("a lens was asked for");
        };
        assert!(
            (lens.focus_distance - distance).abs() < 1e-4 * distance,
            "{lens:?}"
        );
    }
    // With a focal length the angle depends on the distance, also nearer than the lens would be sharp at first: half a
    // sensor's height is more than the small ball's radius.
    for (radius, focal_length) in [(0.1, 0.1), (0.001, 0.085), (0.0001, 0.2)] {
        let camera = format!(
            "[camera.perspective]\nfocal_length_mm = {}\nframe = \"ball\"\nframe_margin = 0",
            1000.0 * focal_length
        );
        let view = ball_of(radius, &camera, [40, 40])
            .expect("a good scene")
            .view;
        let distance = (view.position - middle).length();
        let film = 1.0 / (1.0 / focal_length - 1.0 / distance);
        let half = libm::atan(0.012 / film);
        assert!(
            (distance - radius / libm::sin(half)).abs() < 1e-4 * distance,
            "{distance}"
        );
    }
    // A point may be sharp that lies behind where the file lets the camera stand.
    let sharp = |at: &str, field: &str| {
        let camera = format!("[camera.perspective]\n{field}\nframe = \"ball\"\n{at}");
        ball_of(0.1, &camera, [40, 40]).map(|world| world.view)
    };
    let behind = middle - direction * 30.0;
    let at = format!("focus_point_m = {:?}", behind.to_array());
    let error = sharp(&at, "vertical_fov_deg = 40").expect_err("it stands before that");
    assert!(
        error
            .to_string()
            .starts_with("camera.perspective.focus_point_m: "),
        "{error}"
    );
    let view = sharp(&at, "focal_length_mm = 100").expect("it stands behind that");
    let Projection::Perspective(lens) = &view.projection else {
        panic!("a lens was asked for");
    };
    let focus = (view.position - behind).length();
    assert!((lens.focus_distance - focus).abs() < 1e-6, "{lens:?}");
    let half = libm::asin(0.1 / (view.position - middle).length());
    assert!(
        (libm::tan(half) / 0.9 - libm::tan(0.5 * lens.vertical_fov)).abs() < 1e-6,
        "{lens:?}"
    );
    // Parallel rays show the ball itself, and everything from ball to ball.
    for (frame, size, height) in [("ball", [40, 40], 0.2), ("everything", [40, 40], 44.2)] {
        let camera = format!("[camera.orthographic]\nframe = \"{frame}\"\nframe_margin = 0");
        let view = ball(&camera, size);
        let Projection::Orthographic { height: found } = view.projection else {
            panic!("parallel rays were asked for");
        };
        assert!(
            found >= height * (1.0 - 1e-4) && found < height * 1.05,
            "{frame} {found}"
        );
    }
}

#[test]
fn a_soft_box_needs_texture_coordinates() {
    let folder = tempfile::tempdir().expect("a folder");
    let obj = "v 0 0 1\nv 1 0 1\nv 0 1 1\nf 1 2 3\n";
    std::fs::write(folder.path().join("lamp.obj"), obj).expect("a file");
    let lamp = r#"
[meshes.lamp.file]
path = "lamp.obj"
[materials.black.diffuse]
reflectance = 0
[objects.lamp]
mesh = "lamp"
material = "black"
[lights.lamp.area]
object = "lamp"
radiance_w_m2_sr_nm = 1
"#;
    let build = |keys: &str| {
        let text = format!("{SCENE}{lamp}{keys}");
        let scene = parse(&text, "scene.toml", folder.path(), &[]);
        World::build(&scene.expect("the test's own scene is right").description)
    };
    build("").expect("an even lamp needs none");
    let error = build("edge_share = 0.5").expect_err("a bell has nothing to lie on");
    assert!(
        error.to_string().starts_with("lights.lamp.area: "),
        "{error}"
    );
}

/// What is built below a sky with this number of 400 pixels below 0, each by this much.
fn below_a_sky(dark: usize, value: f32) -> Result<World, String> {
    let folder = tempfile::tempdir().expect("a place for temporary files");
    let layers = ["R", "G", "B"].map(|name| {
        let mut data = vec![0.5; 400];
        // Red is right everywhere.
        if name != "R" {
            data[7..7 + dark].fill(value);
        }
        Layer {
            name: name.to_owned(),
            data,
        }
    });
    let sky = Picture {
        width: 20,
        height: 20,
        layers: layers.into(),
        attributes: Vec::new(),
    };
    openexr::write(&sky, &folder.path().join("sky.exr")).expect("it can be written");
    let constant = "[lights.sky.constant]\nradiance_w_m2_sr_nm = 1";
    let text = SCENE.replace(constant, "[lights.sky.environment]\npath = \"sky.exr\"");
    let loaded = parse(&text, "scene.toml", folder.path(), &[]);
    let scene = loaded
        .unwrap_or_else(|errors| panic!("{errors}"))
        .description;
    World::build(&scene).map_err(|error| error.to_string())
}

#[test]
fn a_sky_with_few_values_below_0_shines_and_one_with_many_does_not() {
    let note = |world: &World| {
        let notes = world.notes.iter();
        notes
            .filter(|note| note.starts_with("lights.sky") && note.contains("below 0"))
            .cloned()
            .collect::<Vec<_>>()
    };
    assert!(note(&below_a_sky(0, 0.0).expect("it shines")).is_empty());
    let world = below_a_sky(5, -0.01).expect("it shines");
    let is_stretched = |note: &String| note.contains("20 × 20 pixels is not twice as wide as high");
    assert!(world.notes.iter().any(is_stretched), "{:?}", world.notes);
    let told = note(&world);
    assert!(told.len() == 1 && told[0].contains("1.25 %"), "{told:?}");
    // Too many, and too deep.
    for (dark, value) in [(21, -0.01), (5, -2.0)] {
        let error = below_a_sky(dark, value).expect_err("it is refused");
        assert!(
            error.contains("lights.sky") && error.contains("pixel (7, 0)"),
            "{error}"
        );
        assert!(error.contains(&value.to_string()), "{error}");
    }
    let error = below_a_sky(5, f32::NEG_INFINITY).expect_err("it is refused");
    assert!(error.contains("pixel (7, 0)"), "{error}");
}

/// The notes on a ball at a place, seen along +y from 1 m before the origin.
fn notes_on_ball(overrides: &[&str]) -> Vec<String> {
    const BALL: &str = r#"
format = 1
[film.rgb]
size = [8, 8]
spp = 1
[camera.perspective]
position_m = [0, -1, 0]
look_at_m = [0, 0, 0]
vertical_fov_deg = 40
[materials.grey.diffuse]
reflectance = 0.5
[meshes.ball.sphere]
radius_m = 0.1
[objects.ball]
mesh = "ball"
material = "grey"
[objects.other]
mesh = "ball"
material = "grey"
[lights.sky.constant]
radiance_w_m2_sr_nm = 1
"#;
    let overrides: Vec<String> = overrides.iter().map(ToString::to_string).collect();
    let loaded = parse(BALL, "scene.toml", Path::new("."), &overrides);
    let scene = loaded
        .unwrap_or_else(|errors| panic!("{errors}"))
        .description;
    World::build(&scene).expect("it can be built").notes
}

#[test]
fn a_picture_that_shows_no_object_is_noted() {
    assert_eq!(notes_on_ball(&[]), [""; 0]);
    let away = ["camera.perspective.look_at_m=[0, -2, 0]"];
    let [note] = &notes_on_ball(&away)[..] else {
        panic!("one note is wanted");
    };
    assert!(
        note.starts_with("camera: no object is in the picture") && note.contains("[0, 0, 0] m"),
        "{note}"
    );
    // Of one of two objects nothing is said.
    assert_eq!(
        notes_on_ball(&["objects.ball.position_m=[0, -2, 0]"]),
        [""; 0]
    );
    let tiny = ["objects.ball.scale=1e-4", "objects.other.scale=1e-4"];
    let [note] = &notes_on_ball(&tiny)[..] else {
        panic!("one note is wanted");
    };
    assert!(note.contains("are 2.2e-4 pixels large"), "{note}");
}

#[test]
fn what_is_too_far_from_the_picture_for_its_size_is_noted() {
    assert_eq!(
        notes_on_ball(&["objects.other.position_m=[0, 900, 0]"]),
        [""; 0]
    );
    let [note] = &notes_on_ball(&["objects.other.position_m=[0, 900000, 0]"])[..] else {
        panic!("one note is wanted");
    };
    assert!(
        note.starts_with("objects.other: 1 of its parts") && note.contains("by up to 5.4e-2 m"),
        "{note}"
    );
}

#[test]
fn a_scale_that_makes_a_leaf_longer_than_any_is_noted() {
    const LEAF: &str = r#"
format = 1
[film.rgb]
size = [8, 8]
spp = 1
[camera.perspective]
position_m = [0, 0.1, 1]
look_at_m = [0, 0.1, 0]
up = [0, 1, 0]
vertical_fov_deg = 40
[leaves.leaf]
length_mm = 118
map_size = 16
[leaves.leaf.outline.growth_algorithm]
rate_ratio = 1.2
widest_at = 0.4
falloff = 2.5
[leaves.leaf.venation.arcuate]
[leaves.leaf.contents]
structure = 1.5
chlorophyll_ug_per_cm2 = 35
carotenoids_ug_per_cm2 = 9
water_cm = 0.008
dry_matter_g_per_cm2 = 0.005
[objects.leaf]
leaf = "leaf"
scale = SCALE
[lights.sky.constant]
radiance_w_m2_sr_nm = 1
"#;
    let notes = |scale: &str| {
        let text = LEAF.replace("SCALE", scale);
        let loaded = parse(&text, "scene.toml", Path::new("."), &[]);
        let scene = loaded
            .unwrap_or_else(|errors| panic!("{errors}"))
            .description;
        let notes = World::build(&scene).expect("it can be built").notes;
        let of_leaf = notes.into_iter().filter(|note| note.contains("a leaf is"));
        of_leaf.collect::<Vec<_>>()
    };
    assert_eq!(notes("1"), [""; 0]);
    let [long] = &notes("100")[..] else {
        panic!("one note is wanted");
    };
    assert!(
        long.starts_with("objects.leaf: a leaf is 11.8 m long") && long.contains("`scale`"),
        "{long}"
    );
    let [short] = &notes("1e-3")[..] else {
        panic!("one note is wanted");
    };
    assert!(short.contains("1.2e-1 mm long"), "{short}");
}
