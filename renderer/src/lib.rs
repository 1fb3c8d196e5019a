//! Lamina: a spectral path tracer for leaves and leaf scenes.
//!
//! Lengths are metres, wavelengths nanometres, radiance W m⁻² sr⁻¹ nm⁻¹, transport in `f32`.
//!
//! # A tour
//!
//! A scene is text: [`scene::load`] reads it, or reports everything that is wrong with it.
//! [`World::build`](scene::world::World::build) grows its leaves and builds the trees for ray
//! tracing. [`integrator::render`] traces paths of light at several wavelengths each and adds up
//! the arriving radiance on a [`film`]. [`integrator::develop`] computes the layers of a picture
//! from the film; [`image`] writes them.
//!
//! ```
//! use std::path::Path;
//! use std::sync::atomic::AtomicBool;
//!
//! use renderer::image::openexr;
//! use renderer::integrator::caption::Caption;
//! use renderer::integrator::develop::develop;
//! use renderer::integrator::render::{Job, render};
//! use renderer::scene::load::parse;
//! use renderer::scene::world::World;
//!
//! // A leaf of the other crate by the name of its preset, what lights it, and who looks at it.
//! let scene = r#"
//!     format = 1
//!
//!     [leaves.birch]
//!     preset = "birch"
//!     map_size = 64
//!
//!     [objects.leaf]
//!     leaf = "birch"
//!
//!     [lights.sky.constant]
//!     radiance_w_m2_sr_nm = { d65 = 0.05 }
//!
//!     [camera.perspective]
//!     position_m = [0, 0.03, 0.2]
//!     look_at_m = [0, 0.03, 0]
//!     up = [0, 1, 0]
//!     vertical_fov_deg = 25
//!
//!     [film.rgb]
//!     size = [24, 32]
//!     spp = 16
//! "#;
//! let scene = parse(scene, "birch.toml", Path::new("."), &[])?.description;
//! let world = World::build(&scene)?;
//!
//! // Samples of every pixel, on all threads. The seed decides the noise; nothing else does.
//! let film = &scene.film;
//! let job = Job { width: film.width, height: film.height, spp: film.spp, seed: 1 };
//! let never_stop = AtomicBool::new(false);
//! let rendered = render(&world, &job, &never_stop, &|_progress| ())?;
//!
//! // Layers of a picture: radiance, its variance, positions, normals, albedo and more.
//! let picture = develop(&Caption::of(&scene, &world.view, &world.light_colours), &job, &rendered);
//! let middle = (job.height / 2 * job.width + job.width / 2) as usize;
//! let [red, green, blue] = ["R", "G", "B"].map(|name| picture.layer(name).expect("a film of colours").data[middle]);
//! assert!(green > red && red > blue, "a leaf is green: {red}, {green}, {blue}");
//!
//! // The same as an OpenEXR file.
//! let folder = tempfile::tempdir()?;
//! let file = folder.path().join("birch.exr");
//! openexr::write(&picture, &file)?;
//! assert_eq!(openexr::read(&file)?.layer("G"), picture.layer("G"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The command `lamina` is [`cli`]. The book in `docs/` describes the scene format and derives what
//! is computed here.

pub mod checkpoint;
pub mod cli;
mod codec;
mod comparison;
pub mod export;
pub mod image;
pub mod instruments;
pub mod integrator;
pub mod measured;
mod plot;
mod plugin;
pub mod provenance;
mod report;
pub mod scene;
pub mod sweep;

#[doc(inline)]
pub use trace::{
    bsdf, camera, film, geometry, light, material, medium, sampling, simd, spectrum, walk,
};
