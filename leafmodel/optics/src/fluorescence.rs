//! Chlorophyll fluorescence of a leaf: light absorbed by chlorophyll that leaves again as red light.
//!
//! The leaf is one of Fluspect's: PROSPECT's reflectance and transmittance of a wavelength, less the
//! two outer surfaces, are those of a [`Mesophyll`] in which two streams of diffuse light are
//! absorbed and scattered evenly with depth. Chlorophyll emits a share of the photons that it
//! absorbs ([`Leaf::quantum_efficiency`]), half up and half down, with an
//! [`EmissionSpectrum`], wherever in the leaf that is; what it emits is scattered, absorbed again
//! and reflected by the surfaces from within on its way out. Fluspect sums this up by doubling thin
//! layers. Here it is an integral over depth of the closed solution, which gives the same matrices
//! and splits them into factors of the excitation and of the emission alone.
//!
//! - **In**: [`Leaf`], wavelengths in nm.
//! - **Out**: photons that leave through the lit face (backward) and through the other one
//!   (forward), for each incident photon and each nanometre of emission, nm⁻¹;
//!   [`energy_over_photons`] turns that into energy.
//! - **Always true**: chlorophyll emits `quantum_efficiency` times the photons that it absorbs; of
//!   these, none is lost but those absorbed again.
//! - **Left out**: what is emitted by light that was emitted before (at most `quantum_efficiency` of
//!   it), differences between faces and between palisade and spongy tissue, photochemistry and heat,
//!   which decide the quantum efficiency.
//!
//! `docs/src/theory/fluorescence.md` derives it.
//!
//! ```
//! use optics::fluorescence::{EmissionSpectrum, Leaf, matrices};
//! use optics::{Contents, Pigments};
//!
//! let leaf = Leaf {
//!     contents: Contents::new(1.5, 40.0, 10.0, 0.0, 0.0, 0.01, 0.009)?,
//!     pigments: Pigments::default(),
//!     quantum_efficiency: 0.01,
//!     emission: EmissionSpectrum::default(),
//! };
//! let found = matrices(&leaf, &[440.0], &[685.0, 740.0]);
//! // More red light is absorbed again on the way through the leaf than on the way back.
//! let back = found.backward[0][0] / found.backward[0][1];
//! let through = found.forward[0][0] / found.forward[0][1];
//! assert!(through < 0.5 * back && back < leaf.emission.at(685.0) / leaf.emission.at(740.0));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Source
//!
//! \[vilfan2016\] for the model; its matrices hold for the same assumptions but two, which the book
//! tells.

mod emission;
mod mesophyll;

pub use emission::{EMITTED_NM, EmissionSpectrum, RATIO_NM, RED_OVER_FAR_RED};
pub use mesophyll::{DEPTHS, Mesophyll, Profile};

use super::constituent::Constituent;
use super::contents::Contents;
use super::pigments::Pigments;
use super::prospect_d::{Coefficients, ProspectD};

/// First and last wavelength at which chlorophyll is taken to be excited, nm. Beyond, it absorbs
/// next to nothing, and below there are no data.
pub const EXCITED_NM: [f64; 2] = [400.0, 750.0];

/// A leaf that fluoresces.
#[derive(Clone, Debug, PartialEq)]
pub struct Leaf {
    /// What it holds.
    pub contents: Contents,
    /// Which substances its pigments are.
    pub pigments: Pigments,
    /// Photons emitted for each photon that chlorophyll absorbs, in [0, 1]; some 0.005 to 0.02 in
    /// daylight.
    pub quantum_efficiency: f64,
    /// The spectrum of what it emits within.
    pub emission: EmissionSpectrum,
}

/// Excitation–emission matrices, by excitation and emission: photons for each incident photon and
/// each nanometre of emission, nm⁻¹, ≥ 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Matrices {
    /// Out of the lit face.
    pub backward: Vec<Vec<f64>>,
    /// Out of the other face.
    pub forward: Vec<Vec<f64>>,
}

/// Factor from numbers of photons to energy: a photon carries `hc / λ`, so that each photon absorbed
/// at `excitation_nm` and emitted at `emission_nm` keeps `λₑ / λ_f` of its energy.
pub fn energy_over_photons(excitation_nm: f64, emission_nm: f64) -> f64 {
    excitation_nm / emission_nm
}

/// What chlorophyll absorbs of all that the leaf absorbs at a wavelength, in [0, 1].
pub fn chlorophyll_share(at: &Coefficients, contents: &Contents) -> f64 {
    let whole = at.absorption_of_leaf(contents);
    let own = contents[Constituent::Chlorophyll] * at.absorption[Constituent::Chlorophyll];
    if whole > 0.0 { own / whole } else { 0.0 }
}

/// The matrices of a leaf in light near its normal, at these wavelengths, nm.
///
/// `M(λₑ, λ_f) = η A(λₑ) c(λₑ) φ(λ_f) ∫ a(x, λₑ) e(x, λ_f) dx` with the quantum efficiency η, the
/// leaf's absorptance A, chlorophyll's share c of it, the spectrum φ of emission, the distribution a
/// of absorption over depth, and the share e of what is emitted at a depth that leaves through a
/// face. Excitations outside [`EXCITED_NM`] and emissions outside [`EMITTED_NM`] give 0.
pub fn matrices(leaf: &Leaf, excitations_nm: &[f64], emissions_nm: &[f64]) -> Matrices {
    let of = |nm: f64| {
        let at = ProspectD::coefficients_of(&leaf.pigments, nm);
        let optics = at.reflectance_transmittance(&leaf.contents);
        (at, optics, Mesophyll::of(&at.interface, optics))
    };
    let emitted: Vec<(f64, Profile)> = emissions_nm
        .iter()
        .map(|&nm| (leaf.emission.at(nm), of(nm).2.escaping()))
        .collect();
    let mut found = Matrices {
        backward: Vec::new(),
        forward: Vec::new(),
    };
    for &nm in excitations_nm {
        let (at, optics, mesophyll) = of(nm);
        let is_excited = (EXCITED_NM[0]..=EXCITED_NM[1]).contains(&nm);
        let absorbed = 1.0 - optics.reflectance - optics.transmittance;
        let by_chlorophyll = chlorophyll_share(&at, &leaf.contents) * absorbed.max(0.0);
        let photons = f64::from(u8::from(is_excited)) * leaf.quantum_efficiency * by_chlorophyll;
        let excited = mesophyll.absorbing();
        let row = |through: bool| -> Vec<f64> {
            let escaping = emitted.iter();
            escaping
                .map(|(phi, escaping)| photons * phi * excited.dot(escaping, through))
                .collect()
        };
        found.backward.push(row(false));
        found.forward.push(row(true));
    }
    found
}

#[cfg(test)]
mod tests;
