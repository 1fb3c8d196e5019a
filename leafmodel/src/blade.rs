//! The lamina in space: its mesh and relief, and the contents of its tissue at each place.
//!
//! [`BladeMesh::build`] cuts the flat lamina into triangles that follow the margin and the major
//! veins, raises the veins, and bends the whole. [`petiole`] gives it a stalk.
//!
//! - **In**: an outline, the veins, a [`BladeForm`].
//! - **Out**: a [`BladeMesh`] in millimetres, base at the origin, midrib along +y, adaxial side +z.
//! - **Always true**: no cracks, no flipped or folded faces.
//! - **Left out**: the two surfaces of a sheet with thickness (thickness is a number at each
//!   vertex).
//!
//! ```
//! use leafmodel::blade::{BladeForm, BladeMesh};
//! use leafmodel::species;
//!
//! let plan = species::find("poplar").ok_or("the poplar is a preset")?.plan();
//! let lamina = plan.grow_lamina()?;
//! // Halves raised by 20° about a straight midrib.
//! let form = BladeForm { fold: 20_f64.to_radians(), curl: 0.0, ..plan.form };
//! let mesh = BladeMesh::build(&lamina.outline, &lamina.network, &form)?;
//! let highest = mesh.positions.iter().map(|p| p.z).fold(0.0, f64::max);
//! assert!(highest > 0.0, "the margin stands above the midrib");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod ageing;
pub mod ageing_courses;
mod closed;
pub mod contents_map;
mod coverage;
pub(crate) mod error;
mod form;
pub mod frame;
pub mod hairs;
pub mod layers;
pub(crate) mod margin_thickness;
pub mod masks;
pub mod mesh;
pub mod mottle;
pub mod petiole;
mod plan;
mod planes;
mod pleats;
mod refine;
mod relief;
pub mod senescence;
pub(crate) mod sheet;
mod size_field;
mod skeleton;
pub mod stalk;
pub mod stance;
pub mod surface;
mod thinning;
pub mod tissue;
mod triangulate;
pub mod unevenness;
pub mod vein_body;
pub mod vein_cover;
pub mod vein_field;
mod vein_grid;
mod vein_light;
pub mod vein_profile;
pub mod weathering;

pub use frame::UvFrame;
pub use margin_thickness::MarginThickness;
pub use mesh::{BladeError, BladeMesh};
pub use plan::BladeForm;

#[cfg(test)]
mod tests;
