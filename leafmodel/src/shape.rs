//! The flat lamina: its margin, and how it comes to be.

pub mod contour_curve;
pub(crate) mod crossing;
pub(crate) mod cubic;
pub mod cubic_margin;
pub mod growth;
pub mod growth_form;
mod interior_grid;
mod outer_boundary;
pub mod outline;
mod slabs;
pub mod svg_path;
pub mod teeth;
