//! Leaves that develop from their margin: convergence points, the veins that start there, and the
//! blade that grows along them.
//!
//! Where a growing margin has room, a convergence point of auxin appears; from there a vein
//! canalises to those that are there already; the vein elongates and carries the margin with it,
//! while growth is held back between convergence points. A tooth, a lobe or a leaflet and the vein
//! that feeds it are one thing.
//!
//! - **In**: a [`DevelopmentPlan`], a seed, a length in millimetres.
//! - **Out**: an [`Outline`](crate::shape::outline::Outline), the main veins as a
//!   [`VenationNetwork`](crate::venation::network::VenationNetwork), and both at every step.
//! - **Always true**: every convergence point is the tip of one vein, and lies on the outline;
//!   every vein is connected to the base and lies on the blade; the same plan and seed give the
//!   same bits on every machine.
//! - **Left out**: cells, and the transport of auxin between them; the blade stays flat.
//!
//! # Source
//!
//! \[runions2017\]; `docs/src/theory/development.md` tells what is the paper's and what is ours.

mod blade;
mod check;
mod initiation;
mod leaf;
mod margin;
mod network;
mod plan;
mod skeleton;
mod steps;
#[cfg(test)]
mod tests;
mod tissue;

pub use self::leaf::{DevelopedLeaf, MainVein};
pub use self::network::MainVeinStyle;
pub use self::plan::{DevelopmentPlan, Primordium, Sequence, Wave};
