//! Export of scenes to other programs, and flat drawings of veins.
//!
//! Exporters read what the tracer reads, the resolved
//! [`Description`](crate::scene::description::Description) and the
//! [`World`](crate::scene::world::World) built from it, so that both programs get the same input.
//!
//! ```
//! use std::path::Path;
//!
//! use renderer::export::mitsuba;
//! use renderer::scene::load::parse;
//! use renderer::scene::world::World;
//!
//! let scene = r#"
//!     format = 1
//!     [film.spectral]
//!     size = [8, 8]
//!     spp = 4
//!     bands_nm = [550, 800]
//!     [camera.perspective]
//!     position_m = [0, -1, 1]
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
//! let scene = parse(scene, "floor.toml", Path::new("."), &[])?.description;
//! let folder = tempfile::tempdir()?;
//! let exported = folder.path().join("exported");
//! mitsuba::write(&scene, &World::build(&scene)?, &exported)?;
//! let xml = std::fs::read_to_string(exported.join("scene.xml"))?;
//! assert!(xml.contains("<emitter type=\"constant\""));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod blade;
pub mod caption;
pub(crate) mod daylight;
pub mod drawing;
pub mod gltf;
pub mod mitsuba;
mod names;
pub mod overlay;
pub(crate) mod sheet;
pub(crate) mod veins;
