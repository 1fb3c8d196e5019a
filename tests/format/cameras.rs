//! The keys of cameras that exclude each other.

use renderer::camera::thin_lens::ThinLens;
use renderer::camera::view::Projection;

use super::accepted::assert_near;
use super::{accept, text_of};

/// The minimal scene with another camera 1.25 m² away.
fn projection(camera: &str) -> Projection {
    let minimal = text_of("minimal.toml");
    let (place, lens) = camera.split_once(']').expect("a header");
    let text = minimal
        .replace("[camera.perspective]", &format!("{place}]"))
        .replace("vertical_fov_deg = 40", lens);
    let scene = accept(&text, "camera.toml", &[]).description;
    scene.camera.view.projection
}

fn lens(keys: &str) -> ThinLens {
    match projection(&format!("[camera.perspective]{keys}")) {
        Projection::Perspective(lens) => lens,
        Projection::Orthographic { .. } => panic!("parallel rays"),
    }
}

#[test]
fn the_focus_is_where_the_camera_looks_if_nothing_says_where() {
    let lens = lens("focal_length_mm = 50");
    let distance = 1.25_f64.sqrt();
    assert_near(lens.focus_distance, distance);
    assert_near(lens.image_distance, 1.0 / (1.0 / 0.05 - 1.0 / distance));
    assert_near(lens.radius, 0.0);
}

#[test]
fn a_focus_is_a_distance_a_point_an_object_or_a_magnification() {
    let at = |keys: &str| lens(&format!("focal_length_mm = 50\nf_number = 4\n{keys}"));
    assert_near(at("focus_distance_m = 0.3").focus_distance, 0.3);
    // From (0, −1, 0.5) towards the origin: the plane through a point up there is nearer.
    let along = (0.5 + 0.25 * 0.5) / 1.25_f64.sqrt();
    assert_near(at("focus_point_m = [3, -0.5, 0.25]").focus_distance, along);
    let life_size = at("magnification = 1");
    assert_near(life_size.focus_distance, 0.1);
    assert_near(life_size.image_distance, 0.1);
    assert_near(life_size.radius, 0.00625);
    // Where the floor is, is known when it is built.
    assert_eq!(at("focus_object = \"floor\"").focus_distance, f64::INFINITY);
}

#[test]
fn parallel_rays_show_a_height_or_the_sensors_at_a_magnification() {
    for (keys, expected) in [
        ("height_m = 0.3", 0.3),
        ("magnification = 0.5", 0.048),
        ("magnification = 2\nsensor_height_mm = 15.6", 0.0078),
    ] {
        let Projection::Orthographic { height } =
            projection(&format!("[camera.orthographic]{keys}"))
        else {
            panic!("a lens");
        };
        assert_near(height, expected);
    }
}

#[test]
fn a_shape_without_an_opening_is_reported() {
    let text = text_of("minimal.toml")
        .replace("vertical_fov_deg = 40", "vertical_fov_deg = 40\nblades = 5");
    let warnings = accept(&text, "camera.toml", &[]).warnings;
    assert_eq!(warnings.len(), 1);
    let text = text.replace("blades = 5", "blades = 5\nf_number = 2");
    assert!(accept(&text, "camera.toml", &[]).warnings.is_empty());
}
