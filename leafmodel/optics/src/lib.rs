//! Leaf optics: from what a leaf contains to what it reflects and transmits (PROSPECT-D, -PRO, -5, -4).
//!
//! The leaf is a pile of `N` identical absorbing plates with rough faces. [`constituent`] says what
//! a leaf is made of, [`prospect_d`] what one unit of each constituent absorbs in each version of
//! PROSPECT ([`model`]), [`extra`] reads what one of the user's own absorbs, [`absorption`] turns contents into the absorption
//! coefficient of one plate, [`interface`] averages Fresnel's formulae over directions, [`plate`]
//! and [`pile`] follow the light between the faces. [`fast`] is the same model for inner loops;
//! [`pigments`] says which substances the pigment columns consist of; [`inversion`] goes the way back,
//! from spectra to contents. [`faces`] has the rule by which faces differ. [`layers`] is another model:
//! tissue of several layers, whose faces differ. [`fluorescence`] is light that chlorophyll emits.
//!
//! - **In**: [`Contents`] per leaf area, a wavelength in nm.
//! - **Out**: [`ReflectanceTransmittance`], both in [0, 1], for light at near-normal incidence.
//! - **Always true**: reflectance + transmittance ≤ 1, and = 1 where nothing absorbs.
//! - **Left out**: the direction in which light leaves and faces that differ, but in [`faces`] and
//!   [`layers`].
//!
//! ```
//! use optics::{Contents, ProspectD};
//!
//! let green = Contents::new(1.5, 40.0, 8.0, 0.0, 0.0, 0.01, 0.009)?;
//! let optics = ProspectD::coefficients(550.0)?.reflectance_transmittance(&green);
//! assert!((optics.reflectance - 0.1512).abs() < 1e-4);
//! assert!((optics.transmittance - 0.1503).abs() < 1e-4);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod absorption;
pub mod betalains;
pub mod constituent;
pub mod contents;
pub mod contents_keys;
pub mod dust;
pub mod extra;
pub mod faces;
pub mod fast;
pub mod fluorescence;
pub mod interface;
pub mod inversion;
pub mod layers;
pub mod model;
pub mod per_constituent;
pub mod pigments;
pub mod pile;
pub mod plate;
pub mod presets;
pub mod prospect_d;
mod quadrature;
pub mod solid;
pub mod vein_factors;

pub use constituent::Constituent;
pub use contents::{Contents, ContentsError, Texel};
pub use interface::Interface;
pub use model::Model;
pub use per_constituent::PerConstituent;
pub use pigments::Pigments;
pub use pile::ReflectanceTransmittance;
pub use prospect_d::{Coefficients, OutsideTable, ProspectD};
pub use vein_factors::VeinFactors;
