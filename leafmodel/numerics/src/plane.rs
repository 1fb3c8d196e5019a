//! Geometry of the plane: segments, polylines, polygons and their indices.
//!
//! - **In**: points; a polygon is a list of corners, whose last is joined to the first.
//! - **Always true**: a degenerate segment, without length, acts as a point.
//! - **Left out**: surfaces in space, and trees over points that grow (`venation`).
//!
//! Where two formulas for one thing stay beside each other, they differ in the last bit, and grown
//! leaves depend on it.

pub mod distances;
mod first_crossing;
mod interior_grid;
mod lattice;
mod points;
pub mod polygon;
pub mod polyline;
pub mod segment;
mod slabs;

pub use self::first_crossing::first_crossing;
pub use self::interior_grid::InteriorGrid;
pub use self::lattice::Lattice;
pub use self::points::{bounds, rectangle_distance_squared, turn};
pub use self::slabs::Slabs;
