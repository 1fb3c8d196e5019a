//! From the film's sums to the layers of a picture.

use glam::DVec3;

use crate::film::Pixel;
use crate::image::openexr::{spectral_attributes, spectral_channel_name};
use crate::image::{Attribute, Layer, Picture, REC709};
use crate::integrator::render::{Job, Rendered};
use crate::scene::description::{Camera as CameraBlock, Description, FilmKind};
use crate::scene::world::World;

/// The picture with all its layers and what is to be known about it, worked out on the current thread pool.
///
/// Colour: `R G B A`, `albedo.*`, `variance.*`. Bands: `S0.<nm>nm` in the layout of Fichet, Pacanowski and Wilkie
/// (JCGT 10(3), 2021), `variance.S0.<nm>nm`, `A`. Both: `P.*` (m), `N.*`, means over covered samples among the first
/// [`crate::film::FEATURE_SAMPLES`]; `depth.Z` (m), the distance of P from the camera; `samples.Y`; `id.object`, the number + 1 of
/// the object that the pixel's first sample met, 0 for none.
pub fn develop(scene: &Description, world: &World, job: &Job, rendered: &Rendered) -> Picture {
    let film = &rendered.film;
    let beauty: Vec<String> = match &scene.film.kind {
        FilmKind::Rgb { .. } => ["R", "G", "B"].map(str::to_owned).to_vec(),
        FilmKind::Spectral { bands } => bands
            .iter()
            .map(|band| spectral_channel_name(band.center_nm))
            .collect(),
    };
    let mut layers = Vec::new();
    let mut layer = |name: &str, data: Vec<f32>| {
        let name = name.to_owned();
        layers.push(Layer { name, data });
    };
    for (channel, name) in beauty.iter().enumerate() {
        layer(name, film.mean(channel));
        layer(&format!("variance.{name}"), film.variance_of_mean(channel));
    }
    layer("A", film.map(|pixel| pixel.alpha() as f32));
    layer("depth.Z", film.map(|pixel| depth(&scene.camera, pixel)));
    for (axis, letter) in ["X", "Y", "Z"].into_iter().enumerate() {
        let position = |pixel: &Pixel<'_>| pixel.position().map_or(0.0, |p| p[axis] as f32);
        layer(&format!("P.{letter}"), film.map(position));
        layer(
            &format!("N.{letter}"),
            film.map(|pixel| pixel.normal()[axis] as f32),
        );
    }
    if rendered.layout.albedo {
        for (component, letter) in ["R", "G", "B"].into_iter().enumerate() {
            let albedo = |pixel: &Pixel<'_>| pixel.albedo()[component].clamp(0.0, 1.0) as f32;
            layer(&format!("albedo.{letter}"), film.map(albedo));
        }
    }
    layer("samples.Y", film.map(|pixel| pixel.samples() as f32));
    layer("id.object", film.map(|pixel| pixel.object() as f32));
    Picture {
        width: job.width,
        height: job.height,
        layers,
        attributes: attributes(scene, world, job, rendered),
    }
}

/// Distance of a pixel's mean point from the middle of the lens, m; 0 where nothing is covered.
///
/// Points that a pixel sees lie along one line but for its width and the blur of the lens, so this is the mean distance nearly.
fn depth(camera: &CameraBlock, pixel: &Pixel<'_>) -> f32 {
    pixel.position().map_or(0.0, |position| {
        (DVec3::from_array(position) - camera.position).length() as f32
    })
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
            // What pixels really have: fewer than asked for if time or noise ended the render.
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
        text("lamina:objects", manifest.join("\n")),
        ("worldToCamera".to_owned(), Attribute::Matrix4(to_camera)),
        ("worldToNDC".to_owned(), Attribute::Matrix4(to_ndc)),
    ];
    if let Some(noise) = rendered.noise {
        attributes.push(text("lamina:noise", noise.aim.to_string()));
    }
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
