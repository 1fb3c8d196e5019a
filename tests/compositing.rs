//! Pictures of a foreground alone: what they are over a background is the picture of both.

use support::picture::picture_of;

use crate::radiometry::{GREY_FLOOR, scene};

/// Radiance of the sky, W m⁻² sr⁻¹ nm⁻¹.
const SKY: f64 = 0.5;

const CAMERA: &str = "position_m = [0.1, -2, 1]\nlook_at_m = [0, 0, 0.1]\nvertical_fov_deg = 40\n\
                      aperture_diameter_mm = 30";

/// A blurred ball on a floor below sky, sun and a lamp in view.
fn still_life(integrator: &str, ball: &str) -> String {
    let blocks = format!(
        "{GREY_FLOOR}\
         [meshes.ball.sphere]\nradius_m = 0.25\n\
         [objects.ball]\nmesh = \"ball\"\nmaterial = \"grey\"\nposition_m = [0, 0, 0.3]\n{ball}\n\
         [lights.sky.constant]\nradiance_w_m2_sr_nm = {SKY}\n\
         [lights.sun.distant]\nirradiance_w_m2_nm = 1\nelevation_deg = 50\n"
    );
    scene(CAMERA, integrator, &blocks)
}

/// Alpha and the radiance of both bands, by pixel.
fn pixels(text: &str) -> Vec<[f64; 3]> {
    let rendered = picture_of(text, 1);
    rendered
        .film
        .map(|pixel| [pixel.alpha(), pixel.mean(0), pixel.mean(1)])
}

/// Both pictures follow the same paths, so that they agree to the rounding of single precision.
fn assert_same(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-5, "{found} for {expected}");
}

#[test]
fn a_foreground_over_the_sky_that_it_hides_is_the_picture_with_that_sky() {
    let whole = pixels(&still_life("", ""));
    let foreground = pixels(&still_life("hide_lights = true", ""));
    let mut soft = 0;
    for (all, front) in whole.iter().zip(&foreground) {
        assert_eq!(all[0], front[0], "alpha is that of the objects in both");
        soft += u32::from(0.0 < front[0] && front[0] < 1.0);
        for band in 1..=2 {
            assert_same(front[band] + (1.0 - front[0]) * SKY, all[band]);
        }
    }
    assert!(soft > 20, "{soft} pixels with soft edges");
}

#[test]
fn what_is_held_out_and_all_else_have_together_the_light_and_alpha_of_the_whole() {
    let hidden = "hide_lights = true";
    let whole = pixels(&still_life(hidden, ""));
    let held_out = pixels(&still_life(hidden, "holdout = true"));
    let floor =
        still_life(hidden, "").replace("[objects.floor]", "[objects.floor]\nholdout = true");
    let ball = pixels(&floor);
    let mut shared = 0;
    for ((all, rest), ball) in whole.iter().zip(&held_out).zip(&ball) {
        shared += u32::from(rest[0] > 0.0 && ball[0] > 0.0);
        for number in 0..3 {
            assert_same(rest[number] + ball[number], all[number]);
        }
    }
    assert!(shared > 5, "{shared} pixels that both share");
}

#[test]
fn the_camera_looks_through_a_hidden_lamp_whose_light_stays() {
    let lamp = "[meshes.panel.rectangle]\nwidth_m = 0.3\nheight_m = 0.3\n\
                [objects.panel]\nmesh = \"panel\"\nmaterial = \"grey\"\nposition_m = [0, 0, 0.5]\n\
                rotate_deg = [180, 0, 0]\n\
                [lights.panel.area]\nobject = \"panel\"\nradiance_w_m2_sr_nm = 3\n";
    let above =
        "position_m = [0, 0, 2]\nlook_at_m = [0, 0, 0]\nup = [0, 1, 0]\nvertical_fov_deg = 1";
    let below =
        "position_m = [0, 0.3, 0.4]\nlook_at_m = [0, 0, 0]\nup = [0, 1, 0]\nvertical_fov_deg = 4";
    let seen = |camera: &str, integrator: &str| {
        let pixels = pixels(&scene(camera, integrator, &format!("{GREY_FLOOR}{lamp}")));
        let count = pixels.len() as f64;
        [0, 1].map(|number| pixels.iter().map(|pixel| pixel[number]).sum::<f64>() / count)
    };
    // The back of the panel hides the floor, unless it is looked through.
    assert_eq!(seen(above, "")[1], 0.0);
    let [alpha, through] = seen(above, "hide_lights = true");
    assert_eq!(alpha, 1.0, "the floor is there");
    // The view is so narrow that a point below the middle stands for it: its radiance is ρ F L, with
    // F = 4/π · x/√(1+x²) · atan(x/√(1+x²)) of the half edge over the distance, x = 0.3.
    let x: f64 = 0.15 / 0.5;
    let side = x / x.hypot(1.0);
    let factor = 4.0 / std::f64::consts::PI * side * side.atan();
    let expected = 0.25 * factor * 3.0;
    assert!(
        (through / expected - 1.0).abs() < 0.01,
        "{through} for {expected}"
    );
    assert_eq!(seen(below, ""), seen(below, "hide_lights = true"));
}
