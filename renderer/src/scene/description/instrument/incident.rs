//! `incident`: how much light there is, so that absorbed photons can be counted.

use leafmodel::document::declared::{Declared, Defaults};
use leafmodel::document::keys::Keys;
use leafmodel::document::limits::Limits;
use leafmodel::document::names::NameIn;
use leafmodel::document::value_kind::Number;

use crate::scene::blocks::spectrum::SpectrumOf;
use crate::spectrum::Curve;
use crate::spectrum::written::Spectrum;

/// Incident light in absolute terms, on a level plane.
#[derive(Clone, Debug, Declared, Defaults)]
#[key(last = Self::check)]
pub struct Incident {
    /// Its spectrum, of which only the form counts.
    #[key("spectrum", SpectrumOf::Emission, default = Spectrum::D65 { scale: 1.0 })]
    pub spectrum: Spectrum,
    /// The light of the scene whose spectrum it has, instead of `spectrum`.
    ///
    /// Index into the lights as the file has them.
    #[key("light", NameIn("lights", "the name of a light"))]
    pub light: Option<usize>,
    /// How much there is of it.
    #[key(with = Self::declare_amount, default = Amount::Irradiance(500.0))]
    pub amount: Amount,
}

/// How much incident light there is from 400 to 700 nm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Amount {
    /// Irradiance, W m⁻².
    Irradiance(f64),
    /// Photon flux, µmol m⁻² s⁻¹.
    Photons(f64),
}

impl Incident {
    /// First and last wavelength of photosynthetically active light, nm.
    pub const PAR_NM: [f64; 2] = [400.0, 700.0];
    /// From one wavelength to the next at which its absorption is measured, nm.
    pub const STEP_NM: f64 = 10.0;

    /// The wavelengths at which its absorption is measured, nm.
    pub fn nodes_nm() -> impl Iterator<Item = f64> {
        let [first, last] = Self::PAR_NM;
        let steps = ((last - first) / Self::STEP_NM).round() as u32;
        (0..=steps).map(move |i| first + Self::STEP_NM * f64::from(i))
    }

    fn declare_amount(&mut self, keys: &mut Keys<'_>) {
        keys.exclude("light", "spectrum");
        let current = match self.amount {
            Amount::Irradiance(_) => "irradiance_w_m2",
            Amount::Photons(_) => "par_umol_m2_s",
        };
        for chosen in keys.one_of(&["irradiance_w_m2", "par_umol_m2_s"], Some(current)) {
            let limits = Number(Limits::above(0.0, 1e6));
            let mut amount = 500.0;
            if chosen == "irradiance_w_m2" {
                let about = "Irradiance from 400 to 700 nm.";
                keys.needed("irradiance_w_m2", &mut amount, limits, about);
                self.amount = Amount::Irradiance(amount);
            } else {
                let about = "Photon flux from 400 to 700 nm (PAR).";
                keys.needed("par_umol_m2_s", &mut amount, limits, about);
                self.amount = Amount::Photons(amount);
            }
        }
    }

    fn check(&mut self, keys: &mut Keys<'_>) {
        if !covers_par(&self.spectrum) {
            let problem = "the table does not cover 400 to 700 nm".to_owned();
            keys.refuse(&["spectrum"], problem, "add wavelengths");
        }
        if is_dark(&self.spectrum) {
            let problem = "there is no light from 400 to 700 nm".to_owned();
            keys.refuse(&["spectrum"], problem, "use a spectrum with visible light");
        }
    }
}

/// Whether a spectrum is known from 400 to 700 nm.
pub(in crate::scene) fn covers_par(spectrum: &Spectrum) -> bool {
    let [first, last] = Incident::PAR_NM;
    match spectrum {
        Spectrum::Table {
            points,
            extrapolate: false,
        } => {
            points.first().is_some_and(|point| point.0 <= first)
                && points.last().is_some_and(|point| point.0 >= last)
        }
        Spectrum::Table { .. }
        | Spectrum::Constant(_)
        | Spectrum::D65 { .. }
        | Spectrum::Blackbody { .. } => true,
    }
}

/// Whether a spectrum has no light from 400 to 700 nm.
pub(in crate::scene) fn is_dark(spectrum: &Spectrum) -> bool {
    let curve = Curve::from_description(spectrum);
    Incident::nodes_nm().all(|nm| curve.at(nm as f32) <= 0.0)
}
