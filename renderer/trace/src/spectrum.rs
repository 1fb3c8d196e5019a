//! Wavelengths of paths, spectra as functions of wavelength, and colour.
//!
//! - **In**: spectra as written in a scene, wavelengths in nm.
//! - **Out**: values at a path's own wavelengths ([`Lanes`]), colours as linear sRGB.
//! - **Always true**: no RGB number takes part in transport; RGB is computed from radiance at the
//!   film ([`cie`]), and RGB pictures are converted into spectra when they are read ([`rgb`]).
//!
//! ```
//! use trace::spectrum::cie;
//!
//! // The colour of a surface under daylight: XYZ with Y = 1 for the perfect diffuser, then linear sRGB.
//! let red = |nm: f64| if nm < 600.0 { 0.05 } else { 0.6 };
//! let xyz = cie::xyz_under_d65(red);
//! let [r, g, b] = cie::srgb_from_xyz(xyz);
//! assert!(r > g && g > 0.0 && r > b);
//! let [.., y, _] = cie::xyz_under_d65(|_| 1.0);
//! assert!((y - 1.0).abs() < 1e-6);
//! ```

pub mod band;
pub mod cie;
pub mod curve;
pub mod delta_e;
mod density;
pub mod grid;
pub mod lanes;
pub mod library;
pub mod observer;
pub mod planck;
pub mod recorded;
pub mod rgb;
pub mod sensor;
pub mod table;
pub mod tabulated;
pub mod wavelengths;
pub mod wet_soil;
pub mod written;

pub use curve::Curve;
pub use grid::{Share, WavelengthGrid, Wavelengths};
pub use lanes::Lanes;
pub use tabulated::{Spectrum, Table};
pub use wavelengths::WavelengthSampler;
