//! Films that see as cameras do: white as by the eye, unbiased in the colours of any light.

use std::path::Path;
use std::sync::atomic::AtomicBool;

use renderer::image::Attribute;
use renderer::image::Picture;
use renderer::integrator::caption::Caption;
use renderer::integrator::develop::develop;
use renderer::integrator::render::{Job, render};
use renderer::scene::description::FilmKind;
use renderer::scene::load::parse;
use renderer::scene::world::World;
use renderer::spectrum::observer::Observer;
use support::picture::mean_and_error_of;

/// A room without walls, of one light, and something too small to be seen.
fn room(sensitivities: &str, light: &str) -> String {
    format!(
        r#"
format = 1
[film.rgb]
size = [24, 24]
spp = 64
sensitivities = {sensitivities}
[camera.perspective]
position_m = [0, -1, 0]
look_at_m = [0, 0, 0]
vertical_fov_deg = 10
[materials.grey.diffuse]
reflectance = 0.5
[meshes.dot.sphere]
radius_m = 0.001
[objects.dot]
mesh = "dot"
material = "grey"
position_m = [0, 5000, 0]
[lights.room.constant]
radiance_w_m2_sr_nm = {light}
"#
    )
}

/// The picture of a room, and the observer that its film has.
fn seen(text: &str, folder: &Path) -> (Picture, Observer) {
    let loaded = parse(text, "test.toml", folder, &[]);
    let scene = loaded
        .unwrap_or_else(|errors| panic!("{errors}"))
        .description;
    let world = World::build(&scene).expect("it can be built");
    let job = Job {
        width: 24,
        height: 24,
        spp: 64,
        seed: 2,
    };
    let rendered = render(&world, &job, &AtomicBool::new(false), &|_| ());
    let caption = Caption::of(&scene, &world.view, &world.light_colours);
    let picture = develop(&caption, &job, &rendered.expect("a small film"));
    let observer = match scene.film.kind {
        FilmKind::Rgb { observer, .. } => observer,
        FilmKind::Spectral { .. } | FilmKind::Sensor(_) => panic!("a film of colour"),
    };
    (picture, observer)
}

/// Mean and standard error of each channel of colour.
fn means(picture: &Picture) -> [(f64, f64); 3] {
    ["R", "G", "B"].map(|name| {
        let layer = &picture.layer(name).expect("a film of colour").data;
        let values: Vec<f64> = layer.iter().map(|value| f64::from(*value)).collect();
        mean_and_error_of(&values)
    })
}

/// What the film records of a spectrum by definition: the integral of radiance times linear sRGB of
/// each wavelength, 400 to 780 nm.
fn integral(observer: &Observer, radiance: impl Fn(f64) -> f64) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for step in 0..38_000 {
        let nm = 400.0 + (f64::from(step) + 0.5) * 0.01;
        for (sum, value) in sum.iter_mut().zip(observer.srgb_at(nm)) {
            *sum += 0.01 * value * radiance(nm);
        }
    }
    sum
}

/// Sensitivities to three bands of 12 nm.
fn narrow() -> String {
    let mut text = "wavelength_nm,r,g,b\n".to_owned();
    for nm in 380..=780 {
        let bell = |middle: f64| {
            let off = (f64::from(nm) - middle) / (12.0 / 2.355);
            (-0.5 * off * off).exp()
        };
        let [r, g, b] = [620.0, 540.0, 460.0].map(bell);
        text += &format!("{nm},{r:.9},{g:.9},{b:.9}\n");
    }
    text
}

#[test]
fn the_mean_of_samples_is_the_integral_over_the_cameras_sensitivities() {
    let folder = tempfile::tempdir().expect("a place for temporary files");
    std::fs::write(folder.path().join("narrow.csv"), narrow()).expect("it can be written");
    // Steep where cameras are, so that a wrong weight of any wavelength shows.
    let light = "{ table = [[380, 0.1], [450, 1], [500, 0.2], [560, 0.9], [600, 0.3], [780, 2]] }";
    let points = [
        (380.0, 0.1),
        (450.0, 1.0),
        (500.0, 0.2),
        (560.0, 0.9),
        (600.0, 0.3),
        (780.0, 2.0),
    ];
    let radiance = |nm: f64| {
        let above = points.partition_point(|point| point.0 <= nm).clamp(1, 5);
        let ((low, from), (high, to)) = (points[above - 1], points[above]);
        from + (nm - low) / (high - low) * (to - from)
    };
    let shipped = Observer::names().map(|name| format!("\"{name}\""));
    for sensitivities in shipped.chain(["{ file = \"narrow.csv\" }".to_owned()]) {
        let (picture, observer) = seen(&room(&sensitivities, light), folder.path());
        let expected = integral(&observer, radiance);
        for ((mean, error), expected) in means(&picture).into_iter().zip(expected) {
            let off = (mean - expected).abs();
            assert!(
                off < 4.0 * error + 2e-4,
                "{sensitivities}: {mean} ± {error}, not {expected}"
            );
            // A 24th of this is the error of one pixel of 64 samples.
            assert!(error < 2e-3, "{sensitivities}: {error}");
        }
    }
}

#[test]
fn light_of_d65_is_as_bright_and_as_white_by_a_camera_as_by_the_eye() {
    let folder = Path::new(".");
    let by_eye = means(&seen(&room("\"cie-1931\"", "{ d65 = 1 }"), folder).0);
    for name in Observer::names().skip(1) {
        let by_camera = means(&seen(&room(&format!("\"{name}\""), "{ d65 = 1 }"), folder).0);
        for ((camera, error), (eye, _)) in by_camera.into_iter().zip(by_eye) {
            // Cameras see 380 to 400 nm, which this film does not record, by up to a hundredth.
            let off = (camera / eye - 1.0).abs();
            assert!(
                off < 0.01 + 4.0 * error,
                "{name}: {camera} by the camera, {eye} by the eye"
            );
        }
    }
}

#[test]
fn a_picture_names_its_observer() {
    let told = |sensitivities: &str| {
        let (picture, observer) = seen(&room(sensitivities, "1"), Path::new("."));
        match picture.attribute("lamina:observer") {
            Some(Attribute::Text(text)) => (text.clone(), observer),
            other => panic!("{other:?}"),
        }
    };
    let (text, _) = told("\"cie-1931\"");
    assert_eq!(text, "CIE 1931 2° standard observer");
    let (text, observer) = told("\"nikon-d5100\"");
    let Observer::Camera(camera) = observer else {
        panic!("a camera");
    };
    let matrix = camera.fit().matrix;
    let first = format!(
        "[{:.6} {:.6} {:.6};",
        matrix[0][0], matrix[0][1], matrix[0][2]
    );
    assert!(
        text.contains("Nikon D5100") && text.contains(&first),
        "{text}"
    );
    assert!(text.contains("CIEDE2000"), "{text}");
}
