//! From the film's sums to the layers of a picture.

use glam::Vec2;

use crate::image::openexr::{spectral_attributes, spectral_channel_name};
use crate::image::{Attribute, Layer, Picture, REC709};
use crate::integrator::render::{Job, Rendered};
use crate::scene::description::{Camera as CameraBlock, Description, FilmKind};
use crate::scene::world::World;

/// The picture with all its layers and what is to be known about it.
///
/// Colour: `R G B A`, `albedo.*`, `variance.*`. Bands: `S0.<nm>nm` in the layout of Fichet, Pacanowski and Wilkie
/// (JCGT 10(3), 2021), `variance.S0.<nm>nm`, `A`. Both: `depth.Z` (m), `P.*` (m), `N.*`, `samples.Y`, `id.object`
/// (object number + 1 at the pixel's middle, 0 for none), means over the samples that met something.
pub fn develop(scene: &Description, world: &World, job: &Job, rendered: &Rendered) -> Picture {
    let film = &rendered.film;
    let layout = rendered.layout;
    let beauty: Vec<String> = match &scene.film.kind {
        FilmKind::Rgb { .. } => ["R", "G", "B"].map(str::to_owned).to_vec(),
        FilmKind::Spectral { bands } => bands
            .iter()
            .map(|band| spectral_channel_name(band.center_nm))
            .collect(),
    };
    let mut layers = Vec::new();
    for (channel, name) in beauty.iter().enumerate() {
        layers.push(Layer {
            name: name.clone(),
            data: film.mean(channel),
        });
        let variance = film.variance_of_mean(channel);
        layers.push(Layer {
            name: format!("variance.{name}"),
            data: variance,
        });
    }
    let alpha = film.mean(layout.alpha());
    let mut covered = |name: &str, channel: usize| {
        let mut data = film.mean(channel);
        for (value, alpha) in data.iter_mut().zip(&alpha) {
            *value = if *alpha > 0.0 { *value / alpha } else { 0.0 };
        }
        layers.push(Layer {
            name: name.to_owned(),
            data,
        });
    };
    covered("depth.Z", layout.depth());
    for (axis, letter) in ["X", "Y", "Z"].into_iter().enumerate() {
        covered(&format!("P.{letter}"), layout.position() + axis);
        covered(&format!("N.{letter}"), layout.normal() + axis);
    }
    if layout.albedo {
        for (component, letter) in ["R", "G", "B"].into_iter().enumerate() {
            covered(&format!("albedo.{letter}"), layout.albedo() + component);
        }
        for layer in layers
            .iter_mut()
            .filter(|layer| layer.name.starts_with("albedo"))
        {
            layer
                .data
                .iter_mut()
                .for_each(|value| *value = value.clamp(0.0, 1.0));
        }
    }
    layers.push(Layer {
        name: "A".to_owned(),
        data: alpha,
    });
    let samples = film
        .pixels()
        .iter()
        .map(|pixel| pixel.samples() as f32)
        .collect();
    layers.push(Layer {
        name: "samples.Y".to_owned(),
        data: samples,
    });
    layers.push(Layer {
        name: "id.object".to_owned(),
        data: object_numbers(world, job),
    });
    Picture {
        width: job.width,
        height: job.height,
        layers,
        attributes: attributes(scene, world, job, rendered),
    }
}

/// Number + 1 of the object in the middle of each pixel, seen through the middle of the lens.
fn object_numbers(world: &World, job: &Job) -> Vec<f32> {
    let mut numbers = Vec::with_capacity(job.width as usize * job.height as usize);
    for y in 0..job.height {
        for x in 0..job.width {
            let middle = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
            let ray = world.camera.ray(middle, Vec2::splat(0.5));
            let hit = world.geometry.intersect(&ray);
            numbers.push(hit.map_or(0.0, |hit| {
                (world.objects[hit.instance as usize].object + 1) as f32
            }));
        }
    }
    numbers
}

fn attributes(
    scene: &Description,
    world: &World,
    job: &Job,
    rendered: &Rendered,
) -> Vec<(String, Attribute)> {
    let text = |name: &str, value: String| (name.to_owned(), Attribute::Text(value));
    let manifest: Vec<String> = scene
        .objects
        .iter()
        .enumerate()
        .map(|(number, object)| format!("{} {}", number + 1, object.name))
        .collect();
    let range = world.wavelengths.range_nm();
    let (to_camera, to_ndc) = matrices(&scene.camera, job);
    let mut attributes = vec![
        text("software", format!("Lamina {}", env!("CARGO_PKG_VERSION"))),
        text("lamina:scene", scene.source.clone()),
        text("lamina:sceneName", scene.name.clone()),
        text(
            "lamina:sceneHash",
            format!("{:016x}", fnv1a(scene.source.as_bytes())),
        ),
        text("lamina:seed", job.seed.to_string()),
        (
            "lamina:spp".to_owned(),
            Attribute::Int(i32::try_from(job.spp).unwrap_or(i32::MAX)),
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
        text("lamina:objects", manifest.join("\n")),
        ("worldToCamera".to_owned(), Attribute::Matrix4(to_camera)),
        ("worldToNDC".to_owned(), Attribute::Matrix4(to_ndc)),
    ];
    match scene.film.kind {
        FilmKind::Rgb { .. } => {
            attributes.push(("chromaticities".to_owned(), REC709));
            attributes.push(text(
                "lamina:colour",
                "linear Rec. 709 primaries, D65 white; XYZ by CIE 1931 2° from W m^-2 sr^-1 nm^-1, \
                 equal energy of 1 has Y = 1"
                    .into(),
            ));
        }
        FilmKind::Spectral { .. } => {
            attributes.extend(spectral_attributes());
        }
    }
    attributes
}

/// World to camera (`x` right, y up, looking along −z) and world to normalised device coordinates (−1 to 1 over the
/// picture), both for row vectors as `OpenEXR` has them, row by row.
fn matrices(camera: &CameraBlock, job: &Job) -> ([f32; 16], [f32; 16]) {
    let axes = crate::camera::Camera::axes(camera);
    let (right, up, back) = (axes.x_axis, axes.y_axis, -axes.z_axis);
    let offset = |axis: glam::DVec3| -axis.dot(camera.position);
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
    let focal = 1.0 / libm::tan(0.5 * camera.vertical_fov);
    // Depth is left out: w = distance along the axis, z = −1.
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
        1.0,
        -1.0, //
        0.0,
        0.0,
        0.0,
        0.0,
    ]);
    let flat = |matrix: glam::DMat4| matrix.to_cols_array().map(|value| value as f32);
    (flat(to_camera), flat(projection * to_camera))
}

/// The 64-bit FNV-1a hash: tells scenes apart, guards nothing.
fn fnv1a(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}
