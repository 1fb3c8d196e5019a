//! Following light: one path, and all the paths of a picture.
//!
//! - **In**: a [`World`](crate::scene::world::World), and a [`render::Job`]: pixels, samples, seed.
//! - **Out**: [`render::Rendered`], sums on a film; [`develop`] turns them into the layers of a
//!   picture.
//! - **Always true**: the same job gives the same sums, bit for bit, on any number of threads.
//!
//! ```
//! use std::path::Path;
//! use std::sync::atomic::AtomicBool;
//!
//! use renderer::integrator::render::{Ended, Job, render};
//! use renderer::scene::load::parse;
//! use renderer::scene::world::World;
//!
//! // A ball of reflectance 1 under light of 1 from everywhere cannot be told from its background.
//! let scene = r#"
//!     format = 1
//!     [film.spectral]
//!     size = [8, 8]
//!     spp = 16
//!     bands_nm = [550]
//!     [camera.perspective]
//!     position_m = [0, -3, 0]
//!     look_at_m = [0, 0, 0]
//!     vertical_fov_deg = 30
//!     [meshes.ball.sphere]
//!     radius_m = 0.5
//!     [materials.white.diffuse]
//!     reflectance = 1
//!     [objects.ball]
//!     mesh = "ball"
//!     material = "white"
//!     [lights.sky.constant]
//!     radiance_w_m2_sr_nm = 1
//! "#;
//! let scene = parse(scene, "furnace.toml", Path::new("."), &[])?.description;
//! let job = Job { width: 8, height: 8, spp: 16, seed: 1 };
//! let world = World::build(&scene)?;
//! let rendered = render(&world, &job, &AtomicBool::new(false), &|_progress| ())?;
//! assert_eq!(rendered.ended, Ended::Samples);
//! let means = rendered.film.mean(0);
//! assert!(means.iter().all(|mean| (mean - 1.0).abs() < 0.05), "{means:?}");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod caption;
pub mod develop;

#[doc(inline)]
pub use trace::integrator::{
    effort, features, layers, mis, noise, path, render, sample_map, settings,
};
