//! Thin elastic shells: a sheet whose material wants a metric and a curvature of its own, in
//! equilibrium with its weight and the ground.
//!
//! The sheet is a surface of quadratic B-splines over a square grid on its flat state, of which
//! only the cells that it covers exist (a cut grid). Stretching and bending follow Kirchhoff and
//! Love: energy is quadratic in the differences of the first and second fundamental form from those
//! that the material wants ([`Sheet`]). [`relaxed`] finds a minimum.
//!
//! - **In**: places on the flat state, stiffnesses, wanted forms, weight.
//! - **Out**: the places in space of the grid's control points.
//! - **Always true**: a sheet that is as it wants to be, without weight, does not move; the same
//!   input gives the same bits.
//! - **Left out**: friction, speed, contact of parts within two cells of each other.
//!
//! # Source
//!
//! \[koiter1966\] for the energy, \[cirak2000\] and \[kiendl2009\] for splines as elements, \[li2020\] for
//! contact.

mod contact;
mod crossings;
mod envelope;
mod equilibrium;
mod forms;
mod grid;
mod nearest;
mod patch;
mod sheet;
mod skin;
mod tensor;
#[cfg(test)]
mod tests;

#[cfg(test)]
pub(crate) use crossings::crossings;
pub(crate) use crossings::{Extent, cross, each_near, sweep};
pub(crate) use equilibrium::{Effort, relaxed};
pub(crate) use grid::Grid;
pub(crate) use patch::Patch;
pub(crate) use sheet::{Clamp, Ground, Sheet};
pub(crate) use skin::Skin;
