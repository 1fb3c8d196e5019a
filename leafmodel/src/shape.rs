//! The flat lamina: its margin, and how it comes to be.

mod cell_rows;
mod crossing;
pub mod growth;
pub mod growth_shape;
mod interior_grid;
mod outer_boundary;
pub mod outline;
mod slabs;
