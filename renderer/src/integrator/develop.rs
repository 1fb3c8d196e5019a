//! From the film's sums to the layers of a picture.

use glam::DVec3;

use crate::camera::view::{Projection, View};
use crate::film::Film;
use crate::image::openexr::spectral_attributes;
use crate::image::{Attribute, Layer, Picture, REC709, light_colour};
use crate::integrator::caption::Caption;
use crate::integrator::features::Quantity;
use crate::integrator::layers::{FilmLayer, Layout, Source};
use crate::integrator::render::{Job, Rendered};
use crate::scene::description::FilmKind;
use crate::scene::fingerprint::fnv1a;
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
        Source::Pixel(of) => film.map(|pixel| of(pixel) as f32),
        Source::Feature {
            quantity,
            within: [least, most],
            ..
        } => {
            let number = first_feature(layer.name) + channel;
            // Paths know places from the origin around which the world is traced.
            let from = match quantity {
                Quantity::Position => camera.origin()[channel],
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
            let origin = camera.origin();
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
            format!("{:016x}", fnv1a(caption.source.as_bytes())),
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
    }
    attributes
}

/// World to camera (`x` right, y up, looking along −z) and world to normalised device coordinates
/// (−1 to 1 over the picture), both for row vectors as in `OpenEXR`, row by row.
fn matrices(camera: &View, job: &Job) -> ([f32; 16], [f32; 16]) {
    let axes = camera.axes();
    let (right, up, back) = (axes.x_axis, axes.y_axis, -axes.z_axis);
    let offset = |axis: DVec3| -axis.dot(camera.position);
    let to_camera = glam::DMat4::from_cols_array(&[
        right.x,
        up.x,
        back.x,
        0.0, //
        right.y,
        up.y,
        back.y,
        0.0, //
        right.z,
        up.z,
        back.z,
        0.0, //
        offset(right),
        offset(up),
        offset(back),
        1.0,
    ]);
    let aspect = f64::from(job.width) / f64::from(job.height);
    // Depth is left out: z = −w, where w is the distance along the axis, or 1 for parallel rays.
    let (focal, [z_z, w_z], [z_1, w_1]) = match &camera.projection {
        Projection::Perspective(lens) => {
            let focal = 1.0 / libm::tan(0.5 * lens.vertical_fov);
            (focal, [1.0, -1.0], [0.0, 0.0])
        }
        Projection::Orthographic { height } => (2.0 / height, [0.0, 0.0], [-1.0, 1.0]),
    };
    let projection = glam::DMat4::from_cols_array(&[
        focal / aspect,
        0.0,
        0.0,
        0.0, //
        0.0,
        focal,
        0.0,
        0.0, //
        0.0,
        0.0,
        z_z,
        w_z, //
        0.0,
        0.0,
        z_1,
        w_1,
    ]);
    let flat = |matrix: glam::DMat4| matrix.to_cols_array().map(|value| value as f32);
    (flat(to_camera), flat(projection * to_camera))
}

#[cfg(test)]
mod tests {
    use glam::{DMat4, DVec4};

    use super::*;
    use crate::camera::Camera;
    use crate::camera::thin_lens::{Focus, Lens};

    #[test]
    fn what_a_ray_meets_has_the_coordinates_of_its_pixel() {
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
            };
            let job = Job {
                width: 60,
                height: 40,
                spp: 1,
                seed: 0,
            };
            let camera = Camera::new(&view, job.width, job.height);
            let (_, to_ndc) = matrices(&view, &job);
            // For row vectors, row by row: for columns, column by column.
            let to_ndc = DMat4::from_cols_array(&to_ndc.map(f64::from));
            for film in [(0.0, 0.0), (60.0, 0.0), (45.0, 30.0)] {
                let film = glam::Vec2::new(film.0, film.1);
                let ray = camera.ray(film, glam::Vec2::splat(0.5)).ray;
                let point = (ray.origin() + ray.direction() * 1.7).as_dvec3();
                let DVec4 { x, y, w, .. } = to_ndc * point.extend(1.0);
                let [right, up] = [film.x / 30.0 - 1.0, 1.0 - film.y / 20.0];
                assert!((x / w - f64::from(right)).abs() < 1e-5, "{x} {w} {film}");
                assert!((y / w - f64::from(up)).abs() < 1e-5, "{y} {w} {film}");
            }
        }
    }
}
