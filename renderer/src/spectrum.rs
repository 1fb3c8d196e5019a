//! Wavelengths that a path carries, spectra as functions of them, and the way to colour.
//!
//! - **In**: spectra as written in a scene, wavelengths in nm.
//! - **Out**: values at a path's own wavelengths ([`Lanes`]), colours as linear sRGB.
//! - **Always true**: no RGB number takes part in transport; RGB is made from radiance at the film
//!   ([`cie`]) and turned into spectra when a picture is read ([`rgb`]).

pub mod cie;
pub mod curve;
pub mod lanes;
pub mod planck;
pub mod rgb;
pub mod table;
pub mod tabulated;
pub mod wavelengths;

pub use curve::Curve;
pub use lanes::Lanes;
pub use tabulated::{Spectrum, Table};
pub use wavelengths::{WavelengthGrid, WavelengthSampler, Wavelengths};
