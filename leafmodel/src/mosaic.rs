//! Clonal mosaics: cells that divide on a surface, and the pattern that their clones leave.
//!
//! Cells are thrown on a surface at random, each of a type. They repel one another as far as their types do not adhere,
//! and divide at the rate of their type; a child lies beside its parent, so that the descendants of one cell, its clone,
//! stay together and make a blotch or a stripe.
//!
//! - **In**: a [`Surface`], and a plan of cell types.
//! - **Out**: cells on the surface with their types and clones.
//! - **Always true**: distances are measured on the surface, faces unfolded into a plane ([`patch`]), never through space.
//! - **Left out**: what genes do inside a cell.

pub mod atlas;
#[cfg(test)]
mod claims;
pub mod control;
mod division;
pub mod growth;
pub mod noise_pattern;
pub mod paint;
pub mod patch;
pub mod pattern;
pub mod plan;
mod relaxation;
pub mod shapes;
mod simulation;
pub mod statistics;
pub mod surface;
#[cfg(test)]
mod testing;
pub mod voronoi;
mod walk;

pub use self::control::{ControlError, ControlImage, CylinderControl, Steered};
pub use self::growth::{GrowthCourse, SurfaceGrowth};
pub use self::patch::{Patch, PatchFinder};
pub use self::plan::{CellType, MosaicError, MosaicPlan, RadiusRule};
pub use self::simulation::{Cell, Mosaic};
pub use self::surface::{Ancestry, Surface, SurfaceError, SurfacePoint, Unfold};
