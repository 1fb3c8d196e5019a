//! A leaf's material: what decides its R and T, and its coats.

use std::sync::OnceLock;

use glam::Vec2;
use leafmodel::optics::fast::PileLane;
use leafmodel::optics::{Coefficients, Contents, Interface, ProspectD, SpecificAbsorption};

use crate::bsdf::leaf::{Coat, LeafBsdf};
use crate::material::PathSpectra;
use crate::material::contents_texture::ContentsTexture;
use crate::spectrum::{Curve, Lanes, Wavelengths};

/// A leaf's material.
#[derive(Clone, Debug)]
pub struct LeafMaterial {
    /// What decides R and T.
    pub tissue: LeafTissue,
    /// Abaxial over adaxial reflectance.
    pub abaxial_ratio: Curve,
    /// Adaxial and abaxial coat.
    pub coats: [Coat; 2],
}

/// What decides a leaf's reflectance and transmittance.
#[derive(Clone, Debug)]
pub enum LeafTissue {
    /// PROSPECT-D of contents that are the same everywhere.
    Uniform(Contents),
    /// PROSPECT-D of contents that a map gives.
    Map(ContentsTexture),
    /// Measured spectra.
    Measured {
        /// Reflectance of the adaxial face.
        reflectance: Curve,
        /// Transmittance.
        transmittance: Curve,
    },
}

/// PROSPECT-D's tables at a path's wavelengths.
#[derive(Clone, Debug)]
pub struct LeafOptics<const N: usize> {
    lanes: [PileLane; N],
}

impl<const N: usize> LeafOptics<N> {
    /// At these wavelengths; outside 400–2500 nm the tables' end values hold (a scene that comes there has said so).
    pub fn new(wavelengths: &Wavelengths<N>) -> Self {
        Self {
            lanes: wavelengths
                .nm
                .map(|nm| PileLane::new(&coefficients(f64::from(nm)))),
        }
    }

    /// R and T of a leaf with these contents.
    pub fn reflectance_transmittance(&self, contents: &Contents) -> (Lanes<N>, Lanes<N>) {
        let (reflectance, transmittance) = PileLane::evaluate_lanes(&self.lanes, contents);
        (Lanes(reflectance), Lanes(transmittance))
    }

    /// What contents absorb in all, `Σ C K`.
    pub fn absorption(&self, contents: &Contents) -> [f64; N] {
        let whole = Contents {
            structure: 1.0,
            ..*contents
        };
        self.lanes
            .each_ref()
            .map(|lane| lane.absorption_per_plate(&whole))
    }
}

/// First and last whole nanometre of PROSPECT's table.
const TABLE_NM: [usize; 2] = [400, 2500];

/// PROSPECT's constants, linear between whole nanometres.
///
/// The mean transmissivities of the faces are interpolated too instead of being worked out from the interpolated index: over
/// one nanometre the difference is below 1e-7, and it is what a path would otherwise spend most of its time on.
fn coefficients(nm: f64) -> Coefficients {
    static TABLE: OnceLock<Vec<Coefficients>> = OnceLock::new();
    let table = TABLE.get_or_init(|| {
        (TABLE_NM[0]..=TABLE_NM[1])
            .map(|nm| ProspectD::coefficients_extrapolated(nm as f64))
            .collect()
    });
    let place = (nm - TABLE_NM[0] as f64).clamp(0.0, (table.len() - 1) as f64);
    let below = (place as usize).min(table.len() - 2);
    let share = place - below as f64;
    let (a, b) = (&table[below], &table[below + 1]);
    let between = |low: f64, high: f64| low + share * (high - low);
    Coefficients {
        interface: Interface {
            refractive_index: between(a.interface.refractive_index, b.interface.refractive_index),
            t_av_40: between(a.interface.t_av_40, b.interface.t_av_40),
            t_av_90: between(a.interface.t_av_90, b.interface.t_av_90),
        },
        absorption: SpecificAbsorption {
            chlorophyll: between(a.absorption.chlorophyll, b.absorption.chlorophyll),
            carotenoids: between(a.absorption.carotenoids, b.absorption.carotenoids),
            anthocyanins: between(a.absorption.anthocyanins, b.absorption.anthocyanins),
            betacyanins: between(a.absorption.betacyanins, b.absorption.betacyanins),
            betaxanthins: between(a.absorption.betaxanthins, b.absorption.betaxanthins),
            brown: between(a.absorption.brown, b.absorption.brown),
            water: between(a.absorption.water, b.absorption.water),
            dry_matter: between(a.absorption.dry_matter, b.absorption.dry_matter),
        },
    }
}

impl LeafMaterial {
    /// A wavelength of the range, on a coarse grid, at which the adaxial coat at normal incidence reflects more than
    /// R, so that the leaf cannot give R back; with a map its mean contents stand for all.
    pub fn coat_exceeds_reflectance(&self, range_nm: [f64; 2]) -> Option<f64> {
        let coat = f64::from(self.coats[0].albedo().normal());
        let steps = 200;
        let contents = match &self.tissue {
            LeafTissue::Uniform(contents) => Some(*contents),
            LeafTissue::Map(map) => Some(map.mean()),
            LeafTissue::Measured { .. } => None,
        };
        (0..=steps)
            .map(|i| range_nm[0] + (range_nm[1] - range_nm[0]) * f64::from(i) / f64::from(steps))
            .find(|&nm| {
                let reflectance = match (&self.tissue, &contents) {
                    (LeafTissue::Measured { reflectance, .. }, _) => {
                        f64::from(reflectance.at(nm as f32))
                    }
                    (_, Some(contents)) => {
                        ProspectD::coefficients_extrapolated(nm)
                            .reflectance_transmittance(contents)
                            .reflectance
                    }
                    (_, None) => return false,
                };
                reflectance < coat - 1e-4
            })
    }

    /// The BSDF at texture coordinates `uv`.
    pub fn bsdf<const N: usize>(&self, uv: Vec2, spectra: &mut PathSpectra<N>) -> LeafBsdf<'_, N> {
        let (reflectance, transmittance) = match &self.tissue {
            LeafTissue::Uniform(contents) => spectra.optics().reflectance_transmittance(contents),
            LeafTissue::Map(map) => spectra.optics().reflectance_transmittance(&map.at(uv)),
            LeafTissue::Measured {
                reflectance,
                transmittance,
            } => (
                reflectance.lanes(&spectra.wavelengths),
                transmittance.lanes(&spectra.wavelengths),
            ),
        };
        let ratio = self.abaxial_ratio.lanes(&spectra.wavelengths);
        LeafBsdf::new(&self.coats, reflectance, transmittance, ratio)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn along_a_path_prospect_gives_what_the_exact_model_gives() {
        let green = Contents::new(1.6, 45.0, 10.0, 0.5, 0.1, 0.011, 0.006).expect("a leaf");
        for step in 0..1000 {
            let nm = 395.0 + 2.13 * step as f32;
            let optics = LeafOptics::<4>::new(&Wavelengths {
                nm: [nm; 4],
                pdf: [1.0; 4],
            });
            let (r, t) = optics.reflectance_transmittance(&green);
            let exact = ProspectD::coefficients_extrapolated(f64::from(nm))
                .reflectance_transmittance(&green);
            assert!(
                (f64::from(r.0[0]) - exact.reflectance).abs() < 1e-6,
                "R at {nm} nm"
            );
            assert!(
                (f64::from(t.0[3]) - exact.transmittance).abs() < 1e-6,
                "T at {nm} nm"
            );
        }
    }
}
