//! Places far from the origin of a scene, and cameras and lamps far from what they see.

use std::f64::consts::PI;

use glam::DVec3;
use renderer::scene::load::parse;
use renderer::scene::world::World;
use support::picture::{mean_of, picture_of, world_of};

/// A place far from the origin, m, which single precision rounds by 3 cm.
const FAR: DVec3 = DVec3::new(-500_000.0, 900_000.0, 999_000.0);

/// Leaves of every kind of placing around a place, m.
fn placed(at: DVec3) -> String {
    let DVec3 { x, y, z } = at;
    format!(
        r#"format = 1
[film.spectral]
size = [16, 16]
spp = 16
bands_nm = [550]
[camera.orthographic]
position_m = [{x}, {y}, {}]
look_at_m = [{x}, {y}, {z}]
up = [0, 1, 0]
height_m = 2
[lights.sky.constant]
radiance_w_m2_sr_nm = 1
[materials.paper.diffuse]
reflectance = 0.5
[meshes.disc.disc]
radius_m = 0.03
[meshes.floor.rectangle]
width_m = 1
height_m = 1
[meshes.hill.terrain]
width_m = 1
height_m = 1
deviation_mm = 20
waves_mm = [500, 100]
[objects.floor]
mesh = "floor"
material = "paper"
position_m = [{x}, {y}, {z}]
[objects.hill]
mesh = "hill"
material = "paper"
position_m = [{x}, {}, {z}]
[objects.rows]
mesh = "disc"
material = "paper"
instances.file = "rows.csv"
[objects.framed]
mesh = "disc"
material = "paper"
position_m = [{x}, {y}, {z}]
instances.file = "framed.csv"
[objects.floating]
mesh = "disc"
material = "paper"
volume = {{ within_m = [{x}, {y}, {z}, {}, {}, {}], lai = 0.5, inclination = "spherical", seed = 4 }}
[objects.standing]
mesh = "disc"
material = "paper"
scatter = {{ on = "hill", count = 30, seed = 2 }}
[objects.resting]
mesh = "disc"
material = "paper"
scatter = {{ on = "floor", count = 30, settle = true, seed = 3 }}
[leaves.leaf]
length_mm = 40
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
[leaves.leaf.blade]
max_edge_mm = 4
[plants.shoot]
leaf = "leaf"
nodes = 7
stray_deg = 5
[objects.shoot]
plant = "shoot"
position_m = [{}, {y}, {z}]
instances.file = "framed.csv"
"#,
        z + 3.0,
        y + 2.0,
        x + 1.0,
        y + 1.0,
        z + 1.0,
        x - 2.0
    )
}

/// The world of a scene around a place, whose files hold places there and around their object.
fn world_around(at: DVec3) -> World {
    let folder = tempfile::tempdir().expect("a place for temporary files");
    let rows = |at: DVec3| {
        let place = |number: u32| {
            let [x, y] = [0.03, 0.0731].map(|step| step * f64::from(number));
            format!("{} {} {}\n", at.x + x, at.y + y, at.z)
        };
        let rows: String = (0..10).map(place).collect();
        format!("x_m y_m z_m\n{rows}")
    };
    for (name, at) in [("rows.csv", at), ("framed.csv", DVec3::ZERO)] {
        std::fs::write(folder.path().join(name), rows(at)).expect("a file");
    }
    let loaded = parse(&placed(at), "scene.toml", folder.path(), &[]);
    let scene = loaded
        .unwrap_or_else(|errors| panic!("{errors}"))
        .description;
    World::build(&scene).expect("it can be built")
}

#[test]
fn instances_of_every_kind_are_as_exact_far_away_as_at_the_origin() {
    let [here, away] = [DVec3::ZERO, FAR].map(world_around);
    assert_eq!(here.objects.len(), away.objects.len());
    assert!(here.objects.len() > 150, "{}", here.objects.len());
    for number in 0..here.objects.len() as u32 {
        let [own, other] = [&here, &away].map(|world| *world.geometry.instance(number));
        let object = here.objects[number as usize].object;
        let off = (other.translation - FAR).distance(own.translation);
        // A double holds 1e6 m to 1e-10 m; what comes to rest does so to some thousandths of a
        // millimetre.
        assert!(off < 3e-6, "object {object}, part {number}: {off} m");
        // The search for rest ends within a tolerance: something turned by 0.0004 in another place.
        let turned = (other.linear - own.linear).to_cols_array();
        assert!(turned.iter().all(|by| by.abs() < 1e-3), "{turned:?}");
        // Rays meet it there.
        let [near, far] = [&here, &away].map(|world| {
            let around = world.geometry.to_world(number).translation;
            glam::Vec3::from(around).as_dvec3() + world.geometry.origin()
        });
        let off = (far - FAR).distance(near);
        assert!(off < 3e-6, "object {object}, part {number}: {off} m");
    }
}

/// Leaves over soil in the sun, seen by a camera whose middle of the lens is at a place.
fn sunlit(at: DVec3, camera: &str, from: DVec3) -> String {
    let place = |x: f64, y: f64, z: f64| format!("[{}, {}, {}]", at.x + x, at.y + y, at.z + z);
    let [eye, middle] = [place(from.x, from.y, from.z), place(0.0, 0.0, 0.0)];
    let within = |list: String| list.trim_matches(['[', ']']).to_owned();
    let [low, high] = [(-1.0, 0.05), (1.0, 0.5)].map(|(side, z)| within(place(side, side, z)));
    format!(
        r#"format = 1
[film.spectral]
size = [16, 16]
spp = 64
bands_nm = [550]
[camera.{camera}]
position_m = {eye}
look_at_m = {middle}
up = [0, 1, 0]
[materials.leaf.leaf.measured]
reflectance = 0.4
transmittance = 0.3
[materials.soil.diffuse]
reflectance = 0.2
[meshes.disc.disc]
radius_m = 0.01
[objects.leaves]
mesh = "disc"
material = "leaf"
volume = {{ within_m = [{low}, {high}], lai = 1, inclination = "planophile", seed = 3 }}
[meshes.ground.rectangle]
width_m = 3
height_m = 3
[objects.ground]
mesh = "ground"
material = "soil"
position_m = {middle}
[lights.sun.distant]
irradiance_w_m2_nm = 1
elevation_deg = 60
"#
    )
}

/// Asserts that two numbers are the same but for roundings of rays.
fn assert_same(what: &str, found: f64, expected: f64) {
    assert!(
        (found / expected - 1.0).abs() < 1e-3,
        "{what}: {found}, not {expected}"
    );
}

#[test]
fn a_picture_by_parallel_rays_does_not_depend_on_the_distance_of_the_camera() {
    let seen = |from: DVec3, at: DVec3| {
        let text = sunlit(at, "orthographic", from)
            .replace("up = [0, 1, 0]", "up = [0, 1, 0]\nheight_m = 1");
        mean_of(&picture_of(&text, 1), 0)
    };
    for slope in [DVec3::Z, DVec3::new(0.6, -0.3, 1.0)] {
        let near = seen(10.0 * slope, DVec3::ZERO);
        for far in [3e4, 786e3] {
            assert_same("from afar", seen(far * slope, DVec3::ZERO), near);
        }
        // A camera at the edge of where places may be, and all it sees at the other.
        let corner = DVec3::new(-999_000.0, 999_000.0, -200_000.0);
        let across = seen(786e3 * slope * DVec3::new(1.0, 1.0, 1.0), corner);
        assert_same("from and at afar", across, near);
    }
}

#[test]
fn a_picture_through_a_lens_far_away_is_that_by_parallel_rays() {
    // Of 2 m at 11.5 km, and of 137 m at 786 km, of which the canopy covers little.
    let fov: f64 = 0.01;
    for (distance, share) in [(11_459.0, 1.0), (786_000.0, 1e-3)] {
        let height = 2.0 * distance * libm::tan(0.5 * fov.to_radians());
        let seen = |camera: &str, keys: &str| {
            let text = sunlit(DVec3::ZERO, camera, distance * DVec3::Z);
            let text = text.replace("up = [0, 1, 0]", &format!("up = [0, 1, 0]\n{keys}"));
            mean_of(&picture_of(&text, 1), 0)
        };
        let flat = seen("orthographic", &format!("height_m = {height}"));
        assert!(flat > 0.07 * share * 0.1, "{flat}");
        for opening in [0.0, 1000.0] {
            let keys = format!("vertical_fov_deg = {fov}\naperture_diameter_mm = {opening}");
            assert_same("through a lens", seen("perspective", &keys), flat);
        }
    }
}

#[test]
fn rays_of_a_far_camera_start_near_what_is_seen() {
    let near = |from: DVec3, at: DVec3| {
        let text = sunlit(at, "orthographic", from);
        let (_, world) = world_of(&text.replace("up = [0, 1, 0]", "up = [0, 1, 0]\nheight_m = 1"));
        world.view.near
    };
    let own = near(10.0 * DVec3::Z, DVec3::ZERO);
    assert_eq!((own.origin, own.distance), (DVec3::ZERO, 0.0));
    let far = near(786e3 * DVec3::Z, DVec3::ZERO);
    assert_eq!(far.origin, DVec3::ZERO);
    assert!((785_990.0..785_999.5).contains(&far.distance), "{far:?}");
    let both = near(786e3 * DVec3::Z, FAR - 800e3 * DVec3::Z);
    assert!(
        (both.origin - FAR + 800e3 * DVec3::Z).length() < 5.0,
        "{both:?}"
    );
}

#[test]
fn a_lamp_far_away_lights_as_its_distance_says() {
    // A level floor below a spotlight, and below a ball that shines.
    let floor = |at: DVec3, lamp: &str| {
        let DVec3 { x, y, z } = at;
        let text = format!(
            "format = 1\n[film.spectral]\nsize = [8, 8]\nspp = 64\nbands_nm = [550]\n\
             [camera.orthographic]\nposition_m = [{x}, {y}, {}]\nlook_at_m = [{x}, {y}, {z}]\n\
             up = [0, 1, 0]\nheight_m = 0.5\n[materials.grey.diffuse]\nreflectance = 0.5\n\
             [meshes.floor.rectangle]\nwidth_m = 1\nheight_m = 1\n\
             [objects.floor]\nmesh = \"floor\"\nmaterial = \"grey\"\nposition_m = [{x}, {y}, {z}]\n{lamp}",
            z + 1.0
        );
        mean_of(&picture_of(&text, 1), 0)
    };
    let far = 7e5;
    for at in [DVec3::ZERO, FAR - 1.2e6 * DVec3::Z] {
        let DVec3 { x, y, z } = at;
        let spot = format!(
            "[lights.lamp.spot]\nposition_m = [{x}, {y}, {}]\nlook_at_m = [{x}, {y}, {z}]\n\
             cone_angle_deg = 1\nintensity_w_sr_nm = 1e12\n",
            z + far
        );
        assert_same(
            "a spotlight",
            floor(at, &spot),
            0.5 / PI * 1e12 / (far * far),
        );
        let ball = format!(
            "[meshes.ball.sphere]\nradius_m = 1000\nsegments = 512\n[objects.ball]\nmesh = \"ball\"\n\
             material = \"grey\"\nposition_m = [{x}, {y}, {}]\n[lights.lamp.area]\nobject = \"ball\"\n\
             radiance_w_m2_sr_nm = 1e6\n",
            z + far
        );
        let irradiance = PI * 1e6 * (1000.0 / far) * (1000.0 / far);
        // Which triangle is sampled is chance.
        let (found, expected) = (floor(at, &ball), 0.5 / PI * irradiance);
        assert!(
            (found / expected - 1.0).abs() < 1e-2,
            "a ball: {found}, not {expected}"
        );
    }
}
