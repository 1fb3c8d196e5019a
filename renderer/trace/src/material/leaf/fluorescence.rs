//! What a leaf's chlorophyll takes of light at some wavelengths and emits at others.
//!
//! Matrices of excitation and emission are never stored: at a hit they are products of a factor of
//! the excitations and one of the emissions, each a number for every depth in the leaf
//! ([`optics::fluorescence`]). So leaves with maps fluoresce as uniform ones do.

use glam::Vec2;
use optics::fast::PileLanes;
use optics::fluorescence::{DEPTHS, EXCITED_NM, EmissionSpectrum, Mesophyll, Profile};
use optics::{Constituent, Texel};

use super::{LeafMaterial, LeafTissue};
use crate::bsdf::coat::Coat;
use crate::spectrum::{Lanes, Wavelengths};

/// What light at some wavelengths excites.
#[derive(Clone, Debug)]
pub struct Excited<const N: usize> {
    /// Photons emitted at each depth for each photon that the tissue absorbs.
    emitted: [Profile; N],
    /// Share of the light in the tissue of the adaxial and of the abaxial face that it absorbs.
    absorbed: [Lanes<N>; 2],
}

/// What is emitted at some wavelengths.
#[derive(Clone, Debug)]
pub struct Emitting<const N: usize> {
    /// Share of the photons emitted at each depth that leave through the face from which depth is
    /// counted with these wavelengths, nm⁻¹.
    escaping: [Profile; N],
}

/// Photons emitted at each depth below the lit face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Source([f64; DEPTHS]);

impl<const N: usize> Excited<N> {
    /// Photons emitted where photons that passed the coat of a face (0 adaxial, 1 abaxial) are so
    /// many for each lane.
    pub fn source(&self, face: usize, photons: &[f64; N]) -> Source {
        let mut source = [0.0; DEPTHS];
        for (lane, photons) in photons.iter().enumerate() {
            let absorbed = photons * f64::from(self.absorbed[face].0[lane]);
            for (sum, emitted) in source.iter_mut().zip(&self.emitted[lane].0) {
                *sum += absorbed * emitted;
            }
        }
        Source(source)
    }
}

impl<const N: usize> Emitting<N> {
    /// Whether nothing is emitted at any of the wavelengths.
    pub(crate) fn is_nothing(&self) -> bool {
        self.escaping
            .iter()
            .all(|escaping| *escaping == Profile([0.0; DEPTHS]))
    }

    /// Photons that leave through the lit face or, `through` the leaf, through the other one, nm⁻¹.
    pub fn leaving(&self, source: &Source, through: bool) -> [f64; N] {
        let source = Profile(source.0);
        self.escaping.map(|escaping| source.dot(&escaping, through))
    }
}

impl LeafMaterial {
    /// The same leaf, whose chlorophyll emits so many photons for each that it absorbs, with this spectrum.
    #[must_use]
    pub fn fluorescing(mut self, quantum_efficiency: f64, emission: EmissionSpectrum) -> Self {
        self.quantum_efficiency = quantum_efficiency;
        self.emission = emission;
        self
    }

    /// Whether it fluoresces. Measured spectra do not say what chlorophyll absorbs, and the cut of a
    /// half leads to no other half.
    pub fn fluoresces(&self) -> bool {
        let is_held = match &self.tissue {
            LeafTissue::Held(_) => true,
            LeafTissue::Measured { .. } => false,
        };
        self.quantum_efficiency > 0.0 && is_held && self.half.is_none()
    }

    /// The coats of its faces.
    pub fn coats(&self) -> &[Coat; 2] {
        self.outer_coats()
    }

    /// What light at these wavelengths excites at texture coordinates `uv`.
    pub fn excited<const N: usize>(&self, uv: Vec2, wavelengths: &Wavelengths<N>) -> Excited<N> {
        let mut emitted = [Profile([0.0; DEPTHS]); N];
        if let Some((contents, pile)) = self.held_at(uv, wavelengths) {
            let mesophylls = mesophylls(&contents, &pile);
            let row = CHLOROPHYLL_ROW;
            let whole = pile.absorption(&contents);
            for (lane, emitted) in emitted.iter_mut().enumerate() {
                let nm = f64::from(wavelengths.nm[lane]);
                let own = pile.constants[row][lane] * contents[Constituent::Chlorophyll];
                if own > 0.0 && (EXCITED_NM[0]..=EXCITED_NM[1]).contains(&nm) {
                    let photons = self.quantum_efficiency * f64::from(own) / f64::from(whole[lane]);
                    let absorbing = mesophylls[lane].absorbing();
                    *emitted = Profile(absorbing.0.map(|share| share * photons));
                }
            }
        }
        let [r_a, r_b, t_ab, t_ba, ..] = self.tissue_at(uv, wavelengths).to_lanes();
        let absorbed = [(r_a, t_ab), (r_b, t_ba)].map(|(r, t)| {
            let rest = Lanes::ONE - r - t;
            Lanes(rest.0.map(|rest| rest.max(0.0)))
        });
        Excited { emitted, absorbed }
    }

    /// What is emitted at these wavelengths at texture coordinates `uv`.
    pub fn emitting<const N: usize>(&self, uv: Vec2, wavelengths: &Wavelengths<N>) -> Emitting<N> {
        let mut escaping = [Profile([0.0; DEPTHS]); N];
        let phi = wavelengths.nm.map(|nm| self.emission.at(f64::from(nm)));
        if phi.iter().any(|phi| *phi > 0.0)
            && let Some((contents, pile)) = self.held_at(uv, wavelengths)
        {
            for (lane, mesophyll) in mesophylls(&contents, &pile).iter().enumerate() {
                if phi[lane] > 0.0 {
                    escaping[lane] = Profile(mesophyll.escaping().0.map(|e| e * phi[lane]));
                }
            }
        }
        Emitting { escaping }
    }

    /// Its contents at a point and PROSPECT's constants; `None` if it was measured.
    fn held_at<const N: usize>(
        &self,
        uv: Vec2,
        wavelengths: &Wavelengths<N>,
    ) -> Option<(Texel, PileLanes<N>)> {
        match &self.tissue {
            LeafTissue::Held(held) => Some((held.at(uv), self.palette.lanes(wavelengths))),
            LeafTissue::Measured { .. } => None,
        }
    }
}

/// The row of chlorophyll among the constants of a pile: behind those of the faces, in the order of
/// [`Constituent::ABSORBING`].
const CHLOROPHYLL_ROW: usize = optics::fast::CONSTANTS - Constituent::ABSORBING.len();

/// The mesophyll at each wavelength.
fn mesophylls<const N: usize>(contents: &Texel, pile: &PileLanes<N>) -> [Mesophyll; N] {
    let (r, t) = pile.reflectance_transmittance(contents);
    let [entering, _, out, ..] = &pile.constants;
    std::array::from_fn(|lane| {
        let optics = [r[lane], t[lane]].map(f64::from);
        Mesophyll::new(optics, f64::from(entering[lane]), f64::from(out[lane]))
    })
}
