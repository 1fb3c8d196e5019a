//! From a scene file to the immutable scene that rays are traced in.
//!
//! - **In**: a TOML file with `format = 1` ([`load::load`]), and overrides from the command line.
//! - **Out**: a [`description::Description`], which both the tracer and the exporters read. The blocks are read
//!   as the file has them, then rigs and plants become shapes and places.
//! - **Always true**: a scene is accepted as a whole or refused with a list of all its errors, each
//!   at its place; no file outside the scene's folder is read.
//!
//! ```
//! use std::path::Path;
//!
//! use renderer::scene::load::parse;
//!
//! let scene = r#"
//!     format = 1
//!     [film.rgb]
//!     size = [640, 480]
//!     [camera.perspective]
//!     position_m = [0, -1, 0.5]
//!     look_at_m = [0, 0, 0]
//!     vertical_fov_deg = 40
//!     [meshes.floor.rectangle]
//!     width_m = 1
//!     height_m = 1
//!     [materials.grey.diffuse]
//!     reflectance = 0.5
//!     [objects.floor]
//!     mesh = "floor"
//!     material = "grey"
//!     [lights.sky.constant]
//!     radiance_w_m2_sr_nm = 1
//! "#;
//! let loaded = parse(scene, "floor.toml", Path::new("."), &["film.rgb.spp=4".to_owned()])?;
//! assert_eq!(loaded.description.film.spp, 4);
//!
//! // Every mistake is told with its place and what to write instead.
//! let wrong = scene.replace("reflectance", "reflectence");
//! let errors = parse(&wrong, "floor.toml", Path::new("."), &[]).expect_err("there is no such key");
//! assert!(errors.to_string().contains("did you mean"), "{errors}");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod angle;
pub mod assets;
mod authored;
mod blocks;
pub mod description;
mod expand;
pub mod fingerprint;
pub mod load;
pub mod model;
pub mod plant_cache;
pub mod plants;
pub mod portrait;
mod tissue;
pub mod world;
