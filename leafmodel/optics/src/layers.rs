//! Plane-parallel layers of tissue that scatters and absorbs, and the leaf made of them.
//!
//! A [`Stack`] of [`Layer`]s, each with a refractive index, an optical depth, a single-scattering
//! albedo and a phase function, lies in air; boundaries are smooth and reflect by Fresnel's
//! formulae. Light in it is found in two ways that share nothing but those formulae:
//! [`Ordinates`] solves it for a set of directions, [`follow`] follows photons. A
//! [`LayeredLeaf`] is the stack of a leaf of given contents.
//!
//! - **In**: layers, the face that is lit, light from one direction or from all.
//! - **Out**: shares reflected, transmitted and absorbed by each layer; radiance by direction.
//! - **Always true**: the shares add up to 1; layers that do not absorb lose nothing; diffuse light
//!   passes a stack equally well from both faces.
//! - **Left out**: rough boundaries, polarisation (light that meets two boundaries is taken as
//!   unpolarised at each), interference; sideways spread but in [`spread`].
//!
//! `docs/src/theory/leaf-layers.md` derives it.
//!
//! ```
//! use optics::layers::{Face, Incidence, Layer, Ordinates, Phase, Resolution, Stack};
//!
//! let phase = Phase::HenyeyGreenstein { g: 0.75 };
//! let layer = Layer { index: 1.0, albedo: 0.9, depth: 2.0, phase };
//! let stack = Stack::new(vec![layer])?;
//! let light = Ordinates::new(&stack, Resolution::FINE, &[1.0])?;
//! let fluxes = light.fluxes(Face::First, &[Incidence::NORMAL])?;
//! assert!((fluxes[0].reflected - 0.097395).abs() < 1e-6);
//! assert!((fluxes[0].transmitted - 0.660958).abs() < 1e-6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod anatomy;
mod bidirectional;
mod boundary;
mod directions;
mod leaf;
mod matrix;
mod monte_carlo;
mod ordinates;
mod phase;
mod slab;
mod stack;

pub use anatomy::{Anatomy, AnatomyError, Tissue};
pub use bidirectional::{Bidirectional, Binned};
pub use leaf::{Cells, DRY_BELOW, Faces, LayeredLeaf, Scattering, Slice};
pub use monte_carlo::{Bins, Estimate, Spread, Tallies, follow, spread};
pub use ordinates::{Fluxes, Leaving, Ordinates, Resolution};
pub use phase::{Phase, wall};
pub use stack::{Face, Incidence, Layer, Stack, StackError};

#[cfg(test)]
mod tests;
