//! White balance by a light of the scene: a grey card that it alone illuminates has no colour.

use std::path::Path;

use renderer::image::display::Display;
use renderer::image::light_colour::LightColour;
use renderer::image::pixels::Depth;
use renderer::image::tone::{Tone, from_srgb};
use renderer::image::{Picture, openexr};
use renderer::integrator::caption::Caption;
use renderer::integrator::develop::develop;
use renderer::integrator::render::Job;
use renderer::scene::load::parse;
use renderer::scene::world::World;
use renderer::spectrum::cie::{srgb_from_xyz, xyz_of};
use renderer::spectrum::planck;
use support::picture::{mean_and_error_of, picture_of};

const RGB: &str = "[film.rgb]";

/// A film of colour that loses nothing that the observer sees.
const WIDE: &str = "[film.rgb]\nrange_nm = [360, 830]";

/// A level grey card that fills the picture, and room for lights.
fn card(film: &str, lights: &str) -> String {
    format!(
        r#"
format = 1
{film}
size = [24, 24]
spp = 64
[camera.perspective]
position_m = [0, -0.02, 1]
look_at_m = [0, 0, 0]
vertical_fov_deg = 4
[materials.grey.diffuse]
reflectance = 0.5
[meshes.card.rectangle]
width_m = 0.5
height_m = 0.5
[objects.card]
mesh = "card"
material = "grey"
[meshes.lamp.rectangle]
width_m = 0.1
height_m = 0.1
[objects.lamp]
mesh = "lamp"
material = "grey"
rotate_deg = [180, 0, 0]
position_m = [0.6, 0, 1.2]
{lights}
"#
    )
}

/// A light that stands in no scene of these tests and would tint the card.
const SPOT: &str = "
[lights.key.spot]
position_m = [0.2, 0.1, 0.8]
look_at_m = [0, 0, 0]
cone_angle_deg = 60
intensity_w_sr_nm = ";

fn developed(text: &str) -> Picture {
    let loaded = parse(text, "test.toml", Path::new("."), &[]);
    let scene = match loaded {
        Ok(loaded) => loaded.description,
        Err(errors) => panic!("{errors}"),
    };
    let world = World::build(&scene).expect("it can be built");
    let rendered = picture_of(text, 5);
    let job = Job {
        width: scene.film.width,
        height: scene.film.height,
        spp: scene.film.spp,
        seed: 5,
    };
    let caption = Caption::of(&scene, &world.view, &world.light_colours);
    develop(&caption, &job, &rendered)
}

/// Linear values of the pixels of a picture that is balanced by a light and metered.
fn balanced(picture: &Picture, light: Option<&str>) -> Vec<[f64; 3]> {
    let display = Display {
        auto_exposure: true,
        white_light: light.map(str::to_owned),
        tone: Tone::Linear,
        depth: Depth::Sixteen,
        ..Display::default()
    };
    let pixels = display.pixels(picture).expect("it can be shown");
    let linear = |value: &u16| from_srgb(f64::from(*value) / 65535.0);
    let pixels = pixels.values.chunks(3);
    pixels
        .map(|pixel| [0, 1, 2].map(|channel| linear(&pixel[channel])))
        .collect()
}

/// How far the mean red and blue are from the mean green, relative, each with its standard error.
fn tint(pixels: &[[f64; 3]]) -> [(f64, f64); 2] {
    let green = pixels.iter().map(|pixel| pixel[1]).sum::<f64>() / pixels.len() as f64;
    [0, 2].map(|channel| {
        let offs = pixels
            .iter()
            .map(|pixel| (pixel[channel] - pixel[1]) / green);
        mean_and_error_of(&offs.collect::<Vec<_>>())
    })
}

/// Fails unless the card is grey within four standard errors, and these are small.
fn assert_grey(name: &str, picture: &Picture, light: &str) {
    for (off, error) in tint(&balanced(picture, Some(light))) {
        assert!(error < 1e-3, "{name}: the test sees nothing: {error}");
        // Values of 16 bits are a few ten-thousandths apart, and the white of sRGB is rounded.
        assert!(off.abs() < 4.0 * error + 4e-4, "{name}: {off} ± {error}");
    }
}

#[test]
fn a_grey_card_under_a_lamp_of_3000_k_comes_out_grey() {
    let lamp = "{ blackbody_k = 3000 }";
    let lights = [
        ("spot", format!("{SPOT}{lamp}")),
        (
            "area",
            format!("[lights.key.area]\nobject = \"lamp\"\nradiance_w_m2_sr_nm = {lamp}"),
        ),
        (
            "bell",
            format!(
                "[lights.key.area]\nobject = \"lamp\"\nedge_share = 0.5\nradiance_w_m2_sr_nm = {lamp}"
            ),
        ),
        (
            "distant",
            format!(
                "[lights.key.distant]\nelevation_deg = 60\nazimuth_deg = 20\nirradiance_w_m2_nm = {lamp}"
            ),
        ),
        (
            "constant",
            format!("[lights.key.constant]\nradiance_w_m2_sr_nm = {lamp}"),
        ),
        (
            "overcast",
            format!("[lights.key.overcast]\nirradiance_w_m2_nm = {lamp}"),
        ),
    ];
    for (name, light) in lights {
        let picture = developed(&card(RGB, &light));
        assert_grey(name, &picture, "key");
        let [(red, _), (blue, _)] = tint(&balanced(&picture, None));
        assert!(
            red > 0.3 && blue < -0.3,
            "{name}: orange without balance: {red} {blue}"
        );
    }
}

#[test]
fn the_colour_of_a_lamp_is_that_of_its_spectrum_under_the_observer() {
    let spectrum = "{ blackbody_k = 3000, scale = 7 }";
    let text = card(WIDE, &format!("{SPOT}{spectrum}"));
    let (_, world) = support::picture::world_of(&text);
    let LightColour { name, colour } = &world.light_colours[0];
    assert_eq!((name.as_str(), world.light_colours.len()), ("key", 1));
    let [x, y, z] = xyz_of(|nm| planck::radiance(nm, 3000.0));
    let expected = srgb_from_xyz([x / y, 1.0, z / y]);
    for (found, expected) in colour.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-3, "{colour:?} {expected:?}");
    }
}

#[test]
fn light_of_d65_changes_nothing() {
    let picture = developed(&card(WIDE, &format!("{SPOT}{{ d65 = 1 }}")));
    let (by_light, as_it_is) = (balanced(&picture, Some("key")), balanced(&picture, None));
    for (one, other) in by_light.iter().zip(&as_it_is) {
        for (one, other) in one.iter().zip(other) {
            // The rounded white of sRGB is as far from that of the tabulated D65.
            assert!((one / other - 1.0).abs() < 6e-4, "{one} {other}");
        }
    }
}

#[test]
fn daylight_is_sun_and_sky_on_level_ground_and_each_is_a_light_too() {
    let day = "[lights.day.daylight]\nelevation_deg = 15\nazimuth_deg = 200";
    let picture = developed(&card(RGB, day));
    assert_grey("day", &picture, "day");
    // In the light of the sun alone the sky makes the card blue, and the other way round.
    let [(red, _), (blue, _)] = tint(&balanced(&picture, Some("day.sun")));
    assert!(red < -0.05 && blue > 0.1, "{red} {blue}");
    let [(red, _), (blue, _)] = tint(&balanced(&picture, Some("day.sky")));
    assert!(red > 0.1 && blue < -0.1, "{red} {blue}");
}

#[test]
fn the_lights_of_a_rig_go_by_its_name_and_have_one_colour() {
    for preset in [
        "studio",
        "tent",
        "lightbox",
        "overcast",
        "golden-hour",
        "forest-edge",
    ] {
        let text = card(RGB, &format!("[lights.set.rig]\npreset = \"{preset}\""));
        let (_, world) = support::picture::world_of(&text);
        let names: Vec<_> = world
            .light_colours
            .iter()
            .map(|light| &light.name)
            .collect();
        assert_eq!(names, ["set"], "{preset}");
        assert!(world.light_colours[0].balanceable().is_ok());
    }
    let golden = card(RGB, "[lights.set.rig]\npreset = \"golden-hour\"");
    assert_grey("golden hour", &developed(&golden), "set");
}

#[test]
fn a_picture_of_surroundings_has_the_mean_of_the_sphere() {
    // Orange and blue by azimuth: a level card sees both for as much as the sphere has of them.
    let folder = tempfile::tempdir().expect("a place for temporary files");
    let (width, height) = (16, 8);
    let columns = (0..width * height).map(|texel| texel % width < 5);
    let layer = |name: &str, [orange, blue]: [f32; 2]| renderer::image::Layer {
        name: name.to_owned(),
        data: columns
            .clone()
            .map(|is| if is { orange } else { blue })
            .collect(),
    };
    let surroundings = Picture {
        width: width as u32,
        height: height as u32,
        layers: vec![
            layer("R", [1.0, 0.1]),
            layer("G", [0.6, 0.2]),
            layer("B", [0.2, 0.6]),
        ],
        attributes: Vec::new(),
    };
    openexr::write(&surroundings, &folder.path().join("around.exr")).expect("it can be written");
    let text = card(
        RGB,
        "[lights.around.environment]\npath = \"around.exr\"\nwhite_w_m2_sr_nm = { blackbody_k = 5000 }",
    );
    let loaded = parse(&text, "test.toml", folder.path(), &[]);
    let scene = loaded
        .unwrap_or_else(|errors| panic!("{errors}"))
        .description;
    let world = World::build(&scene).expect("it can be built");
    let job = Job {
        width: 24,
        height: 24,
        spp: 256,
        seed: 3,
    };
    let go = std::sync::atomic::AtomicBool::new(false);
    let rendered = renderer::integrator::render::render(&world, &job, &go, &|_| ());
    let caption = Caption::of(&scene, &world.view, &world.light_colours);
    let picture = develop(&caption, &job, &rendered.expect("a small film"));
    assert_grey("around", &picture, "around");
    let [(red, _), (blue, _)] = tint(&balanced(&picture, None));
    assert!((red.abs() + blue.abs()) > 0.05, "{red} {blue}");
}

#[test]
fn a_film_of_bands_is_balanced_as_it_is_shown() {
    let film = "[film.spectral]\nbands_nm = [450, 550, 650]\nband_width_nm = 40";
    let text = card(film, &format!("{SPOT}{{ blackbody_k = 3000 }}"));
    assert_grey("bands", &developed(&text), "key");
}

#[test]
fn a_picture_that_is_written_and_read_is_balanced_to_the_same_bytes() {
    let picture = developed(&card(RGB, &format!("{SPOT}{{ blackbody_k = 2700 }}")));
    let bytes = openexr::encode(&picture).expect("it can be written");
    let again = openexr::decode(&bytes).expect("it can be read");
    assert_eq!(
        balanced(&picture, Some("key")),
        balanced(&again, Some("key"))
    );
}

#[test]
fn a_light_that_cannot_be_white_is_refused_before_anything_is_rendered() {
    let refusal = |lights: &str, name: &str| {
        let text = format!("{}[picture]\nwhite_light = \"{name}\"\n", card(RGB, lights));
        match parse(&text, "test.toml", Path::new("."), &[]) {
            Err(errors) => errors.to_string(),
            Ok(loaded) => World::build(&loaded.description)
                .expect_err("it is refused")
                .to_string(),
        }
    };
    let spot = |spectrum: &str| format!("{SPOT}{spectrum}");
    let unknown = refusal(&spot("1"), "kye");
    assert!(
        unknown.contains("no light `kye`") && unknown.contains("`key`"),
        "{unknown}"
    );
    let dark = refusal(&spot("0"), "key");
    assert!(dark.contains("gives no light"), "{dark}");
    let sodium = spot("{ table = [[300, 0], [586, 0], [589, 1], [592, 0], [900, 0]] }");
    let told = refusal(&sodium, "key");
    assert!(told.contains("lacks a part of the spectrum"), "{told}");
}
