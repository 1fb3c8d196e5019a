//! Clonal mosaics: cells that divide on a surface, and the pattern that their clones leave.
//!
//! Cells are placed on a surface at random, each with a type. They repel one another; the more
//! their types adhere, the less. Each divides at the rate of its type. A child lies beside its
//! parent, so the descendants of one cell, its clone, stay together and form a blotch or a stripe.
//!
//! - **In**: a [`Surface`], and a plan of cell types.
//! - **Out**: cells on the surface with their types and clones.
//! - **Always true**: distances are measured on the surface, faces unfolded into a plane
//!   ([`patch`]), never through space.
//! - **Left out**: gene regulation inside cells.
//!
//! ```
//! use leafmodel::mosaic::shapes::sphere;
//! use leafmodel::mosaic::{CellType, Mosaic, MosaicPlan, RadiusRule, Surface};
//!
//! // Cells of one kind that divide about once in two days, on a ball of 10 mm.
//! let cells = CellType {
//!     name: "green".to_owned(),
//!     division_days: 2.0,
//!     initial_probability: 1.0,
//!     switching: vec![1.0],
//!     adhesion: vec![0.0],
//! };
//! let plan = MosaicPlan {
//!     initial_cells: 20,
//!     days: 4.0,
//!     radius_weight: 1.0,
//!     relaxations_per_day: 4,
//!     step: 0.1,
//!     initial_relaxations: 10,
//!     initial_step: 0.1,
//!     radius: RadiusRule::Daily,
//!     types: vec![cells],
//!     controls: Vec::new(),
//!     growth: None,
//! };
//! let ball = sphere(10.0, 2.0)?;
//! let mosaic = Mosaic::grow(&Surface::new(ball.positions, ball.faces)?, &plan, 1)?;
//! assert!(mosaic.cells.len() > 20);
//! // Every cell descends from one of the first twenty.
//! assert!(mosaic.cells.iter().all(|cell| cell.clone < 20));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod atlas;
pub mod control;
mod division;
pub mod growth;
mod live;
pub mod noise_pattern;
pub mod paint;
pub mod patch;
pub mod pattern;
pub mod plan;
mod relaxation;
pub mod shapes;
mod simulation;
pub mod surface;
#[cfg(test)]
mod testing;
#[cfg(test)]
mod tests;
mod types;
pub mod voronoi;
mod walk;

pub use self::control::{ControlImage, CylinderControl, Steered};
pub use self::growth::SurfaceGrowth;
pub use self::patch::{Patch, PatchFinder};
pub use self::plan::{CellType, MosaicPlan, RadiusRule};
pub use self::simulation::{Cell, Mosaic};
pub use self::surface::subdivide::Ancestry;
pub use self::surface::{Surface, SurfacePoint, Unfold};
