//! From the film's sums to the layers of a picture.

use glam::{DMat4, DVec3, DVec4};

use crate::camera::view::{Projection, View};
use crate::film::Film;
use crate::image::openexr::spectral_attributes;
use crate::image::{Attribute, Layer, Picture, REC709, light_colour};
use crate::integrator::caption::Caption;
use crate::integrator::features::Quantity;
use crate::integrator::layers::{FilmLayer, Layout, Source};
use crate::integrator::render::{Job, Rendered};
use crate::scene::description::{Band, FilmKind};
use crate::scene::fingerprint::{fnv1a, hexadecimal};
use crate::spectrum::WavelengthSampler;
use crate::spectrum::observer::Observer;

/// The picture with all its [layers](crate::integrator::layers::LAYERS) and attributes, computed on
/// the current thread pool.
///
/// Bands are named in the layout of Fichet, Pacanowski and Wilkie (JCGT 10(3), 2021).
pub fn develop(caption: &Caption, job: &Job, rendered: &Rendered) -> Picture {
    Picture {
        width: job.width,
        height: job.height,
        layers: layers(caption, &rendered.film, rendered.layout, |_| true),
        attributes: attributes(caption, job, rendered),
    }
}

/// What is seen of a film, finished or not: its radiance and what covers it, and which objects.
pub fn seen(caption: &Caption, film: &Film, layout: Layout) -> Picture {
    Picture {
        width: film.width(),
        height: film.height(),
        layers: layers(caption, film, layout, |layer| {
            layer.name.is_empty() || layer.name == "id"
        }),
        attributes: vec![
            names_of_objects(caption),
            light_colour::attribute(&caption.lights),
        ],
    }
}

fn layers(
    caption: &Caption,
    film: &Film,
    layout: Layout,
    wanted: impl Fn(&FilmLayer) -> bool,
) -> Vec<Layer> {
    let mut layers = Vec::new();
    for layer in layout.layers().filter(|layer| wanted(layer)) {
        let names = layer.channel_names(&caption.kind);
        for (channel, name) in names.into_iter().enumerate() {
            let data = developed(layer, channel, &caption.camera, film, layout);
            layers.push(Layer { name, data });
        }
    }
    layers
}

/// The values of one channel of a layer.
fn developed(
    layer: &FilmLayer,
    channel: usize,
    camera: &View,
    film: &Film,
    layout: Layout,
) -> Vec<f32> {
    let first_feature = |name| {
        let first = layout.first_feature(name);
        first.expect("a film has what its layers are made of")
    };
    match layer.source {
        Source::Radiance(of) => film.map(|pixel| of(pixel, channel) as f32),
        Source::Variance(series) => {
            let variances = film.variance(series(channel));
            variances
                .into_iter()
                .map(|variance| variance as f32)
                .collect()
        }
        Source::Pixel(of) => film.map(|pixel| of(pixel) as f32),
        Source::Feature {
            quantity,
            within: [least, most],
            ..
        } => {
            let number = first_feature(layer.name) + channel;
            // Paths know places from the origin around which the world is traced.
            let from = match quantity {
                Quantity::Position => camera.near.origin[channel],
                Quantity::Normal | Quantity::Albedo | Quantity::MeanAlbedo | Quantity::Object => {
                    0.0
                }
            };
            film.map(|pixel| {
                let value = pixel.feature(number);
                value.map_or(0.0, |value| (from + value).clamp(least, most) as f32)
            })
        }
        Source::OfPoint { layer, by } => {
            let first = first_feature(layer);
            let origin = camera.near.origin;
            film.map(|pixel| {
                let [x, y, z] = [0, 1, 2].map(|axis| pixel.feature(first + axis));
                let point = x.zip(y).zip(z);
                point.map_or(0.0, |((x, y), z)| {
                    by(origin + DVec3::new(x, y, z), camera) as f32
                })
            })
        }
    }
}

/// The attribute that names the numbers of the layer `id.object`.
fn names_of_objects(caption: &Caption) -> (String, Attribute) {
    let objects = (1..).zip(&caption.objects);
    let lines: Vec<String> = objects
        .map(|(number, name)| format!("{number} {name}"))
        .collect();
    (
        "lamina:objects".to_owned(),
        Attribute::Text(lines.join("\n")),
    )
}

fn attributes(caption: &Caption, job: &Job, rendered: &Rendered) -> Vec<(String, Attribute)> {
    let text = |name: &str, value: String| (name.to_owned(), Attribute::Text(value));
    let range = WavelengthSampler::new(&caption.kind).range_nm();
    let (to_camera, to_ndc) = matrices(&caption.camera, job);
    let mut attributes = vec![
        text("software", format!("Lamina {}", env!("CARGO_PKG_VERSION"))),
        text("lamina:scene", caption.source.clone()),
        text("lamina:sceneName", caption.name.clone()),
        text(
            "lamina:sceneHash",
            hexadecimal(fnv1a(caption.source.as_bytes())),
        ),
        text("lamina:seed", job.seed.to_string()),
        (
            "lamina:spp".to_owned(),
            // The actual number, which is less than asked for if time or noise ended the render.
            Attribute::Int(rendered.film.drawn_range()[1] as i32),
        ),
        text(
            "lamina:wavelengths",
            format!("{} to {} nm", range[0], range[1]),
        ),
        text(
            "lamina:integrator",
            "unidirectional paths, light samples weighed by the power heuristic".into(),
        ),
        text(
            "lamina:rejectedSamples",
            rendered.film.rejected().to_string(),
        ),
        text("lamina:clampedValues", rendered.film.clamped().to_string()),
        text(
            "lamina:unknownVariances",
            rendered.film.overflowed().to_string(),
        ),
        text("lamina:cutPaths", rendered.film.cut().to_string()),
        text("lamina:missingAtMost", rendered.film.missing().to_string()),
        names_of_objects(caption),
        light_colour::attribute(&caption.lights),
        ("worldToCamera".to_owned(), Attribute::Matrix4(to_camera)),
        ("worldToNDC".to_owned(), Attribute::Matrix4(to_ndc)),
    ];
    if let Some(noise) = rendered.noise {
        attributes.push(text("lamina:noise", noise.aim.to_string()));
    }
    match &caption.kind {
        FilmKind::Rgb { observer, .. } => {
            attributes.push(("chromaticities".to_owned(), REC709));
            let colour = match observer {
                Observer::Cie1931 => {
                    "linear Rec. 709 primaries, D65 white; XYZ by CIE 1931 2° from W m^-2 sr^-1 \
                     nm^-1, equal energy of 1 has Y = 1"
                }
                Observer::Camera(_) => {
                    "linear Rec. 709 primaries, D65 white; by a camera and its matrix from W m^-2 \
                     sr^-1 nm^-1, D65 as by CIE 1931 2°"
                }
            };
            attributes.push(text("lamina:colour", colour.into()));
            attributes.push(text("lamina:observer", observer.told()));
        }
        FilmKind::Spectral { .. } => {
            attributes.extend(spectral_attributes());
        }
        FilmKind::Sensor(sensor) => {
            let bands = sensor.bands().iter().zip(sensor.boxes());
            let lines = bands.map(
                |(
                    band,
                    Band {
                        center_nm,
                        width_nm,
                    },
                )| { format!("{} {center_nm:.6} {width_nm:.3}", band.name()) },
            );
            attributes.extend(spectral_attributes());
            attributes.push(text("lamina:sensor", sensor.about().to_owned()));
            attributes.push(text("lamina:bands", lines.collect::<Vec<_>>().join("\n")));
        }
    }
    attributes
}

/// The standard attributes `worldToCamera` and `worldToNDC` of `OpenEXR`, for row vectors, row by row.
///
/// In camera space x points to the right of the picture, y up and z into the scene, so that it is
/// left-handed. Normalised device coordinates are (0, 0) in the upper left and (1, 1) in the lower
/// right corner of the picture; of their z `OpenEXR` says nothing, and it is the depth over w.
fn matrices(camera: &View, job: &Job) -> ([f32; 16], [f32; 16]) {
    // A row vector times the rows of a matrix is the matrix of these columns times a column vector.
    let axes = camera.axes().transpose();
    let to_camera = DMat4::from_mat3_translation(axes, -(axes * camera.position));
    let half = camera.half_height();
    let (x, y) = (
        0.5 / (half * f64::from(job.width) / f64::from(job.height)),
        -0.5 / half,
    );
    let to_ndc = match &camera.projection {
        // x / z and y / z from −1 to 1 over the picture come to 0 to 1.
        Projection::Perspective(_) => DMat4::from_cols(
            DVec4::new(x, 0.0, 0.0, 0.0),
            DVec4::new(0.0, y, 0.0, 0.0),
            DVec4::new(0.5, 0.5, 1.0, 1.0),
            DVec4::ZERO,
        ),
        Projection::Orthographic { .. } => DMat4::from_cols(
            DVec4::new(x, 0.0, 0.0, 0.0),
            DVec4::new(0.0, y, 0.0, 0.0),
            DVec4::Z,
            DVec4::new(0.5, 0.5, 0.0, 1.0),
        ),
    };
    let flat = |matrix: DMat4| matrix.to_cols_array().map(|value| value as f32);
    (flat(to_camera), flat(to_ndc * to_camera))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::Camera;
    use crate::camera::thin_lens::{Focus, Lens};
    use crate::camera::view::Near;

    #[test]
    fn the_matrices_of_openexr_bring_what_a_ray_meets_to_its_pixel() {
        let lens = Lens::pinhole(0.7).focused(Focus::Distance(1.0));
        let lens = lens.expect("an angle can be focused");
        for projection in [
            Projection::Perspective(lens),
            Projection::Orthographic { height: 0.8 },
        ] {
            let view = View {
                position: DVec3::new(1.0, -2.0, 0.5),
                look_at: DVec3::new(0.2, 0.3, -0.1),
                up: DVec3::Z,
                projection,
                near: Near::default(),
            };
            let job = Job {
                width: 60,
                height: 40,
                spp: 1,
                seed: 0,
            };
            let camera = Camera::new(&view, job.width, job.height);
            let (to_camera, to_ndc) = matrices(&view, &job);
            // As OpenEXR has them, a row vector times a matrix whose rows follow each other.
            let times = |point: DVec3, matrix: [f32; 16]| -> [f64; 4] {
                let point = [point.x, point.y, point.z, 1.0];
                std::array::from_fn(|column| {
                    let rows = (0..4).map(|row| point[row] * f64::from(matrix[4 * row + column]));
                    rows.sum()
                })
            };
            for film in [(0.0, 0.0), (60.0, 0.0), (45.0, 30.0)] {
                let film = glam::Vec2::new(film.0, film.1);
                let ray = camera.ray(film, glam::Vec2::splat(0.5)).ray;
                let point = (ray.origin() + ray.direction() * 1.7).as_dvec3();
                let [x, y, _, w] = times(point, to_ndc);
                let expected = [film.x / 60.0, film.y / 40.0].map(f64::from);
                assert!((x / w - expected[0]).abs() < 1e-5, "{x} {w} {film}");
                assert!((y / w - expected[1]).abs() < 1e-5, "{y} {w} {film}");
                // To the right, up, and ahead of the camera.
                let expected = view.in_picture(point).extend(1.0).to_array();
                for (found, expected) in times(point, to_camera).into_iter().zip(expected) {
                    assert!((found - expected).abs() < 1e-5, "{found} {expected}");
                }
            }
        }
    }
}
