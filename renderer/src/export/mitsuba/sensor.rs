//! The camera with its film.

use crate::camera::thin_lens::ThinLens;
use crate::camera::view::{Projection, View};
use crate::plugin::element::Element;
use crate::plugin::{UNITS_PER_METRE, look_at};
use crate::scene::description::{Band, Description, FilmKind};
use crate::spectrum::sensor::Response;

/// Number of intervals of a band's response.
const RESPONSE_INTERVALS: usize = 64;

/// Width, nm, of the box that represents a single wavelength: Mitsuba's wavelengths are `f32`, with
/// steps of up to 2.4e-4 nm.
const SINGLE_WAVELENGTH_NM: f64 = 0.5;

/// The key of a lens that Mitsuba's lens does not have, if there is one. A pinhole has no shape.
pub(super) fn foreign_key(view: &View) -> Option<&'static str> {
    let Projection::Perspective(lens) = &view.projection else {
        return None;
    };
    let ThinLens {
        radius, iris, tilt, ..
    } = lens;
    let keys = [
        ("blades", iris.blades != 0),
        ("cats_eye", iris.cats_eye != 0.0),
        ("tilt_deg", *tilt != [0.0; 2]),
    ];
    let mut foreign = keys.into_iter().filter(|(_, is_set)| *is_set);
    foreign.next().filter(|_| *radius > 0.0).map(|(key, _)| key)
}

/// The middles and widths of the film's bands; a colour film is exported as one band over its range.
pub(super) fn bands(scene: &Description) -> Vec<Band> {
    match &scene.film.kind {
        FilmKind::Spectral { bands } => bands.clone(),
        FilmKind::Sensor(sensor) => sensor.boxes(),
        FilmKind::Rgb { range_nm, .. } => vec![Band {
            center_nm: 0.5 * (range_nm[0] + range_nm[1]),
            width_nm: range_nm[1] - range_nm[0],
        }],
    }
}

/// The sensor of a scene with its view.
pub(super) fn sensor(scene: &Description, view: &View) -> Element {
    let axes = view.axes();
    let origin = view.position * UNITS_PER_METRE;
    let target = origin + axes.z_axis * UNITS_PER_METRE;
    let placed = look_at(origin, target, axes.y_axis);
    let sensor = match &view.projection {
        Projection::Perspective(lens) => {
            let has_lens = lens.radius > 0.0;
            let kind = if has_lens { "thinlens" } else { "perspective" };
            let sensor = Element::plugin("sensor", kind)
                .placed([placed])
                .float("fov", lens.vertical_fov.to_degrees())
                .string("fov_axis", "y");
            if has_lens {
                sensor
                    .float("aperture_radius", lens.radius * UNITS_PER_METRE)
                    .float("focus_distance", lens.focus_distance * UNITS_PER_METRE)
            } else {
                sensor
            }
        }
        Projection::Orthographic { height } => {
            // Mitsuba's picture is 2 wide before it is scaled.
            let aspect = f64::from(scene.film.width) / f64::from(scene.film.height);
            let scale = 0.5 * height * aspect * UNITS_PER_METRE;
            let size = Element::new("scale").with("x", scale).with("y", scale);
            Element::plugin("sensor", "orthographic").placed([size, placed])
        }
    };
    let sampler = Element::plugin("sampler", "independent");
    let responses: Vec<Element> = match &scene.film.kind {
        FilmKind::Sensor(sensor) => (0..).zip(sensor.bands()).map(curve).collect(),
        FilmKind::Spectral { .. } | FilmKind::Rgb { .. } => {
            (0..).zip(&bands(scene)).map(response).collect()
        }
    };
    let film = Element::plugin("film", "specfilm")
        .integer("width", scene.film.width)
        .integer("height", scene.film.height)
        .string("component_format", "float32")
        .holding(Element::plugin("rfilter", "box"))
        .holding_all(responses);
    sensor
        .float("near_clip", 0.1)
        .parameter("float", "far_clip", "1e9")
        .holding(sampler.integer("sample_count", scene.film.spp))
        .holding(film)
}

/// A band of a `specfilm`, whose channel is the integral of radiance times this response: a box of
/// area 1, so that the channel is the band's mean radiance.
///
/// The film draws wavelengths from the sum of all responses, resampled at the finest spacing of any
/// of them. With only two points, a narrow band could fall between the points of that resampling.
fn response((number, band): (usize, &Band)) -> Element {
    let width = if band.width_nm > 0.0 {
        band.width_nm
    } else {
        SINGLE_WAVELENGTH_NM
    };
    let (low, high) = (band.center_nm - 0.5 * width, band.center_nm + 0.5 * width);
    regular(number, [low, high], &[1.0 / width; RESPONSE_INTERVALS + 1])
}

/// As [`response`], of a sensor's band: its curve at the middle of each of 1024 parts.
fn curve((number, band): (usize, &Response)) -> Element {
    const PARTS: usize = 1024;
    let [low, high] = band.range_nm();
    let width = (high - low) / PARTS as f64;
    let values = (0..PARTS).map(|part| band.at(low + (part as f64 + 0.5) * width));
    let values: Vec<f64> = values.collect();
    // The area that Mitsuba's lines between the values have.
    let ends = 0.5 * (values[0] + values[PARTS - 1]);
    let area = width * (values.iter().sum::<f64>() - ends);
    let values: Vec<f64> = values.into_iter().map(|value| value / area).collect();
    regular(number, [low + 0.5 * width, high - 0.5 * width], &values)
}

/// The response of a band by values at even steps of wavelength, nm.
fn regular(number: usize, [low, high]: [f64; 2], values: &[f64]) -> Element {
    let values: Vec<String> = values.iter().map(ToString::to_string).collect();
    let values = values.join(", ");
    Element::plugin("spectrum", "regular")
        .with("name", format!("band_{number:02}"))
        .float("wavelength_min", low)
        .float("wavelength_max", high)
        .string("values", values)
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::export::mitsuba::{ExportError, write};
    use crate::plugin::element::Document;
    use crate::scene::load::parse;
    use crate::scene::world::World;

    const SCENE: &str = r#"
format = 1
[film.spectral]
size = [60, 40]
spp = 1
bands_nm = [550]
[materials.grey.diffuse]
reflectance = 0.5
[meshes.floor.rectangle]
width_m = 1
height_m = 1
[objects.floor]
mesh = "floor"
material = "grey"
[lights.sky.constant]
radiance_w_m2_sr_nm = 1
"#;
    const PLACE: &str = "position_m = [0, 0, 0.3]\nlook_at_m = [0, 0, 0]\nup = [0, 1, 0]\n";

    fn built(camera: &str) -> (Description, World) {
        let text = format!("{SCENE}\n{camera}");
        let loaded = parse(&text, "scene.toml", Path::new("."), &[]);
        let scene = loaded
            .unwrap_or_else(|errors| panic!("{errors}"))
            .description;
        let world = World::build(&scene).expect("a floor");
        (scene, world)
    }

    /// The first number of an attribute or parameter of the sensor.
    fn number(xml: &str, before: &str) -> f64 {
        let (_, rest) = xml.split_once(before).expect(before);
        let figure = rest.split('"').next().expect("a quote ends it");
        figure.parse().expect("a number")
    }

    fn xml(camera: &str) -> String {
        let (scene, world) = built(camera);
        let mut document = Document::new(&Element::new("scene"));
        document.add(&sensor(&scene, &world.view));
        document.finish()
    }

    #[test]
    fn a_lens_has_the_angle_and_opening_that_its_focus_gives() {
        let lens = "focal_length_mm = 100\nf_number = 2\nmagnification = 0.5\n";
        let xml = xml(&format!("[camera.perspective]\n{PLACE}{lens}"));
        assert!(xml.contains("type=\"thinlens\""), "{xml}");
        // v = f (1 + m) = 150 mm.
        let fov = 2.0 * libm::atan(12.0 / 150.0).to_degrees();
        let value = |name: &str| number(&xml, &format!("name=\"{name}\" value=\""));
        assert!((value("fov") - fov).abs() < 1e-9, "{xml}");
        assert!((value("aperture_radius") - 25.0).abs() < 1e-9, "{xml}");
        assert!((value("focus_distance") - 300.0).abs() < 1e-9, "{xml}");
    }

    #[test]
    fn parallel_rays_span_the_width_of_the_picture() {
        let xml = xml(&format!("[camera.orthographic]\n{PLACE}height_m = 0.2\n"));
        assert!(xml.contains("type=\"orthographic\""), "{xml}");
        // 0.2 m high and half as much more wide, halved, in millimetres.
        assert!((number(&xml, "<scale x=\"") - 150.0).abs() < 1e-9, "{xml}");
        let [scale, look] = ["<scale", "<lookat"].map(|step| xml.find(step).expect(step));
        assert!(scale < look, "{xml}");
    }

    #[test]
    fn what_mitsubas_lens_has_not_is_refused_by_its_key() {
        for (key, value) in [("blades", "6"), ("cats_eye", "0.5"), ("tilt_deg", "[0, 3]")] {
            let lens = format!("vertical_fov_deg = 30\nf_number = 4\n{key} = {value}\n");
            let (scene, world) = built(&format!("[camera.perspective]\n{PLACE}{lens}"));
            let folder = tempfile::tempdir().expect("a folder");
            let out = folder.path().join("out");
            let error = write(&scene, &world, &out).expect_err(key);
            assert!(matches!(error, ExportError::Lens(named) if named == key));
            assert!(!out.exists());
            // A pinhole has no shape.
            let (scene, world) = built(&format!(
                "[camera.perspective]\n{PLACE}{}",
                lens.replace("f_number = 4\n", "")
            ));
            write(&scene, &world, &out).expect("a pinhole");
        }
    }

    #[test]
    fn a_response_has_area_one() {
        let text = response((
            3,
            &Band {
                center_nm: 550.0,
                width_nm: 10.0,
            },
        ))
        .to_string();
        assert!(text.contains("name=\"band_03\""));
        assert!(text.contains("\"wavelength_min\" value=\"545\""));
        assert!(text.contains("\"wavelength_max\" value=\"555\""));
        assert_eq!(text.matches("0.1").count(), RESPONSE_INTERVALS + 1);
        let sensor =
            crate::spectrum::sensor::Sensor::by_name("sentinel-2a").expect("it is shipped");
        for band in sensor.bands() {
            let text = curve((0, band)).to_string();
            let [low, high] = ["_min\" value=\"", "_max\" value=\""].map(|key| number(&text, key));
            let values = text
                .split("\"values\" value=\"")
                .nth(1)
                .expect("there are values");
            let values = values.split('"').next().expect("they end").split(", ");
            let values: Vec<f64> = values.map(|value| value.parse().expect(value)).collect();
            let step = (high - low) / (values.len() - 1) as f64;
            let pairs = values.windows(2);
            let area: f64 = pairs.map(|pair| 0.5 * step * (pair[0] + pair[1])).sum();
            assert!((area - 1.0).abs() < 1e-9, "{area}");
        }
    }
}
