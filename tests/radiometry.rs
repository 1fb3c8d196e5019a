//! Scenes whose radiance is known in closed form.

use std::f64::consts::PI;

use glam::Vec3;
use renderer::film::Pixel;
use support::picture::{mean_and_error, mean_of, means_and_errors, picture_of};

/// A scene of two bands with a pinhole camera, to which blocks are added.
pub(crate) fn scene(camera: &str, integrator: &str, blocks: &str) -> String {
    format!(
        "format = 1\n\
         [film.spectral]\nsize = [16, 16]\nspp = 64\nbands_nm = [550, 800]\nband_width_nm = 0\n\
         [camera.perspective]\n{camera}\n[integrator]\n{integrator}\n{blocks}"
    )
}

pub(crate) const FACING_THE_ORIGIN: &str =
    "position_m = [0.3, -0.2, 1]\nlook_at_m = [0, 0, 0]\nvertical_fov_deg = 4";

pub(crate) const GREY_FLOOR: &str = "
[materials.grey.diffuse]
reflectance = { table = [[550, 0.25], [800, 0.75]] }
[meshes.floor.rectangle]
width_m = 1
height_m = 1
[objects.floor]
mesh = \"floor\"
material = \"grey\"
";

/// A cube of edge 2 around the origin whose walls glow inward.
pub(crate) fn glowing_room(reflectance: &str, radiance: f64) -> String {
    let mut text = format!(
        "[materials.wall.diffuse]\nreflectance = {reflectance}\n\
         [meshes.wall.rectangle]\nwidth_m = 2\nheight_m = 2\n"
    );
    // Turned so that +z of each wall points to the middle, then moved out along −z of itself.
    let walls = [
        ("floor", [0, 0, 0], [0, 0, -1]),
        ("ceiling", [180, 0, 0], [0, 0, 1]),
        ("west", [0, 90, 0], [-1, 0, 0]),
        ("east", [0, -90, 0], [1, 0, 0]),
        ("north", [90, 0, 0], [0, 1, 0]),
        ("south", [-90, 0, 0], [0, -1, 0]),
    ];
    for (name, turn, place) in walls {
        text += &format!(
            "[objects.{name}]\nmesh = \"wall\"\nmaterial = \"wall\"\nrotate_deg = {turn:?}\n\
             position_m = {place:?}\n[lights.{name}.area]\nobject = \"{name}\"\n\
             radiance_w_m2_sr_nm = {radiance}\n"
        );
    }
    text
}

/// Asserts that a mean lies within four of its standard errors (and that those are small).
pub(crate) fn assert_agrees(what: &str, found: (f64, f64), expected: f64) {
    let (mean, error) = found;
    eprintln!("{what}: {mean:.6} ± {error:.1e}, expected {expected:.6}");
    assert!(
        error < 5e-3 * expected,
        "{what}: the error {error} hides what is to be seen"
    );
    // Rounding of single precision stays when there is no scatter at all.
    let allowed = 4.0 * error + 2e-5 * expected;
    assert!(
        (mean - expected).abs() < allowed,
        "{what}: {mean} ± {error}, not {expected}"
    );
}

#[test]
fn a_floor_under_the_sun_reflects_its_irradiance_times_the_cosine() {
    let blocks = format!(
        "{GREY_FLOOR}
[lights.sun.distant]
irradiance_w_m2_nm = 2
elevation_deg = 30
azimuth_deg = 40
"
    );
    let text = scene(FACING_THE_ORIGIN, "", &blocks);
    let [dark, bright] = means_and_errors(&text, 8);
    for (found, reflectance) in [(dark, 0.25), (bright, 0.75)] {
        assert_agrees("sun", found, reflectance / PI * 2.0 * 0.5);
    }
}

#[test]
fn a_floor_under_a_square_lamp_has_the_irradiance_of_its_form_factor() {
    let blocks = format!(
        "{GREY_FLOOR}
[materials.black.diffuse]
reflectance = 0
[meshes.panel.rectangle]
width_m = 1
height_m = 1
[objects.panel]
mesh = \"panel\"
material = \"black\"
position_m = [0, 0, 0.5]
rotate_deg = [180, 0, 0]
[lights.panel.area]
object = \"panel\"
radiance_w_m2_sr_nm = 3
"
    );
    let camera = "position_m = [0.6, 0, 0.1]\nlook_at_m = [0, 0, 0]\nvertical_fov_deg = 0.2";
    // Four quarters of a rectangle above the corner of each (Howell's catalogue, differential
    // element to parallel rectangle).
    let a = 0.5 / 0.5_f64;
    let root = (1.0 + a * a).sqrt();
    let quarter = 1.0 / (2.0 * PI) * 2.0 * (a / root) * (a / root).atan();
    let irradiance = PI * 3.0 * 4.0 * quarter;
    for samples in [
        "light_samples = 1",
        "light_samples = 5",
        "light_samples = 1\nlit_branches = 3",
    ] {
        let text = scene(camera, samples, &blocks);
        let found = mean_and_error(&text, 0, 16);
        assert_agrees(samples, found, 0.25 / PI * irradiance);
    }
}

#[test]
fn a_closed_glowing_room_has_the_radiance_of_the_geometric_series() {
    let blocks = glowing_room("{ table = [[550, 0.5], [800, 0.9]] }", 0.1);
    let camera = "position_m = [0.1, 0.2, 0.3]\nlook_at_m = [1, 0, 0]\nvertical_fov_deg = 90";
    let text = scene(camera, "", &blocks);
    let [half, most] = means_and_errors(&text, 8);
    assert_agrees("room, 0.5", half, 0.1 / (1.0 - 0.5));
    assert_agrees("room, 0.9", most, 0.1 / (1.0 - 0.9));
}

#[test]
fn roulette_leaves_the_mean_as_it_is() {
    let blocks = glowing_room("0.6", 0.4);
    let camera = "position_m = [0.1, 0.2, 0.3]\nlook_at_m = [1, 0, 0]\nvertical_fov_deg = 90";
    for threshold in [
        "roulette_below = 1",
        "roulette_below = 0.25",
        "roulette_below = 0.01",
    ] {
        let text = scene(camera, threshold, &blocks);
        assert_agrees(threshold, mean_and_error(&text, 0, 8), 0.4 / (1.0 - 0.6));
    }
}

/// Half of a wide sun is hidden by an upright edge, and a wall beside shines by it: which half
/// decides how many paths go on must not decide where they go.
#[test]
#[ignore = "deep: 4 s"]
fn branches_leave_the_mean_of_a_penumbra_as_it_is() {
    let blocks = "
[materials.white.diffuse]
reflectance = 0.8
[meshes.floor.rectangle]
width_m = 4
height_m = 4
[meshes.screen.rectangle]
width_m = 2
height_m = 2
[meshes.wall.rectangle]
width_m = 2
height_m = 0.4
[objects.floor]
mesh = \"floor\"
material = \"white\"
[objects.screen]
mesh = \"screen\"
material = \"white\"
rotate_deg = [90, 0, 0]
position_m = [1, 0.3, 0.9]
[objects.wall]
mesh = \"wall\"
material = \"white\"
rotate_deg = [90, 0, 90]
position_m = [-0.1, 0, 0.2]
[lights.sun.distant]
irradiance_w_m2_nm = 1
elevation_deg = 45
azimuth_deg = 90
angular_diameter_deg = 20
";
    let camera = "position_m = [0.3, -0.2, 1]\nlook_at_m = [0, 0, 0]\nvertical_fov_deg = 2";
    let found = |in_shade: u32, lit: u32| {
        let integrator =
            format!("branches = {in_shade}\nlit_branches = {lit}\nroulette_below = 0.1");
        mean_and_error(&scene(camera, &integrator, blocks), 0, 32)
    };
    let one = found(1, 1);
    for (in_shade, lit) in [(4, 1), (1, 3), (4, 2)] {
        let several = found(in_shade, lit);
        let error = one.1.hypot(several.1);
        eprintln!("{in_shade} in shade, {lit} in light: {several:?}, one: {one:?}");
        assert!(error < 1e-3 * one.0, "the error {error} hides what is seen");
        assert!(
            (one.0 - several.0).abs() < 4.0 * error,
            "{several:?} is not {one:?}"
        );
    }
}

#[test]
fn branches_leave_the_mean_as_it_is() {
    // All is lossless under a sky of 1, so whatever way light takes between ball and floor, 1
    // arrives.
    let blocks = "
[materials.white.diffuse]
reflectance = 1
[meshes.floor.rectangle]
width_m = 1
height_m = 1
[meshes.ball.sphere]
radius_m = 0.05
segments = 64
[objects.floor]
mesh = \"floor\"
material = \"white\"
[objects.ball]
mesh = \"ball\"
material = \"white\"
position_m = [0, 0, 0.05]
[lights.sky.constant]
radiance_w_m2_sr_nm = 1
";
    let camera = "position_m = [0, -0.5, 0.1]\nlook_at_m = [0, 0, 0.03]\nvertical_fov_deg = 12";
    for integrator in [
        "branches = 1\nroulette_below = 1",
        "branches = 2\nroulette_below = 0.9",
        "branches = 5\nroulette_below = 0.7",
    ] {
        let text = scene(camera, integrator, blocks);
        assert_agrees(integrator, mean_and_error(&text, 0, 8), 1.0);
    }
}

#[test]
#[ignore = "deep: 40 s of a processor"]
fn a_lossless_leaf_in_a_white_furnace_cannot_be_seen() {
    for alpha in [0.1, 0.3, 0.8] {
        let blocks = format!(
            "
[materials.leaf.leaf]
abaxial_ratio = 1
adaxial = {{ eta = 1.45, alpha = {alpha} }}
abaxial = {{ eta = 1.4, alpha = 0.5 }}
[materials.leaf.leaf.measured]
reflectance = {{ table = [[550, 0.3], [800, 0.5]] }}
transmittance = {{ table = [[550, 0.7], [800, 0.5]] }}
[meshes.ball.sphere]
radius_m = 0.04
segments = 64
[objects.ball]
mesh = \"ball\"
material = \"leaf\"
[lights.sky.constant]
radiance_w_m2_sr_nm = 1
"
        );
        let camera = "position_m = [0, -0.2, 0.05]\nlook_at_m = [0, 0, 0]\nvertical_fov_deg = 26";
        let text = scene(camera, "", &blocks).replace("spp = 64", "spp = 1024");
        let found: [_; 2] = means_and_errors(&text, 8);
        for (channel, (mean, error)) in found.into_iter().enumerate() {
            eprintln!("roughness {alpha}, band {channel}: {mean:.6} ± {error:.1e}");
            assert!(error < 2.5e-4, "the error {error} hides what is to be seen");
            assert!(
                (mean - 1.0).abs() < 1e-3,
                "roughness {alpha}: {mean} ± {error}"
            );
        }
    }
}

#[test]
fn a_leaf_between_sun_and_camera_glows_with_its_transmittance() {
    // Lit at normal incidence and seen at normal incidence from behind: for two equal coats
    // f = T (1 − E) / (P m π), with P m the mean of (1 − q x)² over what passes of diffuse light.
    let blocks = "
[materials.leaf.leaf]
abaxial_ratio = 1
adaxial = { eta = 1.45, alpha = 0.3 }
abaxial = { eta = 1.45, alpha = 0.3 }
[materials.leaf.leaf.measured]
reflectance = 0.3
transmittance = 0.4
[meshes.sheet.rectangle]
width_m = 0.1
height_m = 0.1
[objects.sheet]
mesh = \"sheet\"
material = \"leaf\"
[lights.sun.distant]
irradiance_w_m2_nm = 1
towards = [0, 0, 1]
";
    let camera =
        "position_m = [0, 0, -1]\nlook_at_m = [0, 0, 0]\nup = [0, 1, 0]\nvertical_fov_deg = 1";
    let coat = renderer::bsdf::leaf::Coat::new(1.45, 0.3, 0.3);
    let albedo = coat.albedo();
    let passed = f64::from(1.0 - albedo.normal());
    let steepness = 3.783 / libm::sqrt(1.6) * (1.0 - libm::pow(0.4 / passed, 0.125));
    let steps = 20_000;
    let mean: f64 = (0..steps)
        .map(|step| {
            let mu = (f64::from(step) + 0.5) / f64::from(steps);
            let sine = libm::sqrt(1.0 - mu * mu);
            let reflected = albedo.at(Vec3::new(sine as f32, 0.0, mu as f32));
            let slant = 1.0 - libm::sqrt(1.0 - (1.0 - mu * mu) / (1.45 * 1.45));
            let through = (1.0 - steepness * slant).powi(2);
            2.0 * mu * f64::from(1.0 - reflected) * through / f64::from(steps)
        })
        .sum();
    let expected = 0.4 / PI * passed / mean;
    assert_agrees(
        "backlit",
        mean_and_error(&scene(camera, "", blocks), 0, 8),
        expected,
    );
}

#[test]
fn a_pane_of_smooth_glass_in_a_furnace_is_invisible() {
    let blocks = "
[materials.glass.dielectric]
eta = 1.5
[meshes.ball.sphere]
radius_m = 0.04
[objects.ball]
mesh = \"ball\"
material = \"glass\"
[lights.sky.constant]
radiance_w_m2_sr_nm = 1
";
    let camera = "position_m = [0, -0.2, 0.05]\nlook_at_m = [0, 0, 0]\nvertical_fov_deg = 24";
    let mean = mean_of(&picture_of(&scene(camera, "", blocks), 1), 0);
    assert!((mean - 1.0).abs() < 1e-4, "{mean}");
}

#[test]
fn a_cats_eye_darkens_the_picture_by_the_share_that_it_covers() {
    // Everything that is seen has the radiance 1.
    let blocks = glowing_room("0.6", 0.4);
    let camera = "position_m = [0.1, 0.2, 0.3]\nlook_at_m = [1, 0, 0]\nvertical_fov_deg = 40\n\
                  aperture_diameter_mm = 20\ncats_eye = 0.8";
    let text = scene(camera, "", &blocks).replace("spp = 64", "spp = 256\nfilter_radius_px = 0");
    // Of two equal discs 2 q radii apart this share overlaps; q grows to 0.8 in the corners.
    let steps = 200;
    let at = |i: i32| 2.0 * (f64::from(i) + 0.5) / f64::from(steps) - 1.0;
    let overlap = |x: f64, y: f64| {
        let q = 0.8 * x.hypot(y) / 2_f64.sqrt();
        2.0 / PI * (q.acos() - q * (1.0 - q * q).sqrt())
    };
    let places = (0..steps).flat_map(|i| (0..steps).map(move |j| overlap(at(i), at(j))));
    let expected = places.sum::<f64>() / f64::from(steps * steps);
    assert_agrees("cat's eye", mean_and_error(&text, 0, 8), expected);
    // It takes light, but covers nothing that is seen.
    let picture = picture_of(&text, 1);
    let covered = picture.film.map(covered_share);
    assert!(covered.iter().all(|share| *share == 1.0), "{covered:?}");
}

#[test]
fn parallel_rays_show_a_sheet_as_large_as_it_is_at_any_distance() {
    for distance in [0.5, 5.0, 50.0] {
        let camera = format!(
            "position_m = [0, 0, {distance}]\nlook_at_m = [0, 0, 0]\nup = [0, 1, 0]\nheight_m = 2"
        );
        let blocks = format!("{GREY_FLOOR}[lights.sky.constant]\nradiance_w_m2_sr_nm = 1\n");
        let text = scene(&camera, "", &blocks)
            .replace("perspective", "orthographic")
            .replace("spp = 64", "spp = 4\nfilter_radius_px = 0");
        let picture = picture_of(&text, 1);
        let covered = picture.film.map(covered_share);
        // 1 m of 2: the middle eight of sixteen pixels, each way.
        let sheet =
            |pixel: usize| (4..12).contains(&(pixel % 16)) && (4..12).contains(&(pixel / 16));
        for (pixel, share) in covered.iter().enumerate() {
            assert_eq!(
                *share == 1.0,
                sheet(pixel),
                "{share} at {pixel}, {distance} m"
            );
        }
    }
}

fn covered_share(pixel: &Pixel<'_>) -> f64 {
    pixel.alpha()
}
