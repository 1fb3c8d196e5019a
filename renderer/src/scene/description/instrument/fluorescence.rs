//! `[instruments.NAME.KIND.fluorescence]`.

use leafmodel::document::declared::{Declared, Defaults};
use leafmodel::document::keys::Keys;
use leafmodel::document::limits::Limits;
use leafmodel::document::number_lists::Rising;
use leafmodel::optics::fluorescence::{EMITTED_NM, EXCITED_NM};

use super::wavelengths::{MOST_WAVELENGTHS, every};
use crate::scene::blocks::spectrum::SpectrumOf;
use crate::spectrum::written::Spectrum;

/// Most excitations, each of which is a measurement of its own.
const MOST_EXCITATIONS: usize = 400;

/// What an instrument measures of fluorescence.
#[derive(Clone, Debug, Declared, Defaults)]
pub struct FluorescenceReading {
    /// The light that excites.
    #[key(
        with = Self::declare_light,
        default = ExcitationLight::Spectrum(Spectrum::Constant(0.0))
    )]
    pub light: ExcitationLight,
    /// Wavelengths of emission; left out, 640 to 850 nm by 10 nm.
    #[key("emission_nm", EMISSION, default = every(EMITTED_NM, 10.0))]
    pub emission_nm: Vec<f64>,
}

const EMISSION: Rising = Rising {
    limits: Limits::closed(EMITTED_NM[0], EMITTED_NM[1]),
    most: MOST_WAVELENGTHS,
    wanted: "a list of 1 to 4096 wavelengths, rising",
};

/// Light that excites fluorescence.
#[derive(Clone, Debug)]
pub enum ExcitationLight {
    /// Monochromatic light of these wavelengths, nm, one after the other.
    Monochromatic(Vec<f64>),
    /// Light of a spectral irradiance, W m⁻² nm⁻¹.
    Spectrum(Spectrum),
}

impl FluorescenceReading {
    fn declare_light(&mut self, keys: &mut Keys<'_>) {
        let current = match self.light {
            ExcitationLight::Monochromatic(_) => "excitation_nm",
            ExcitationLight::Spectrum(_) => "spectrum",
        };
        for chosen in keys.one_of(&["excitation_nm", "spectrum"], Some(current)) {
            if chosen == "excitation_nm" {
                let mut list = match &self.light {
                    ExcitationLight::Monochromatic(list) => list.clone(),
                    ExcitationLight::Spectrum(_) => Vec::new(),
                };
                let kind = Rising {
                    limits: Limits::closed(EXCITED_NM[0], EXCITED_NM[1]),
                    most: MOST_EXCITATIONS,
                    wanted: "a list of 1 to 400 wavelengths, rising",
                };
                let about = "Wavelengths of monochromatic light, one after the other; figures are \
                photons for each incident photon and nanometre of emission.";
                keys.needed("excitation_nm", &mut list, kind, about);
                self.light = ExcitationLight::Monochromatic(list);
            } else {
                let mut spectrum = match &self.light {
                    ExcitationLight::Spectrum(spectrum) => spectrum.clone(),
                    ExcitationLight::Monochromatic(_) => Spectrum::Constant(0.0),
                };
                let about = "Irradiance of the light, W m⁻² nm⁻¹, of which 400 to 750 nm excite; figures \
                are W m⁻² nm⁻¹ of emission.";
                let needed = keys.reader().map(|block| {
                    let range = block.cx.range_nm.replace(Some(EXCITED_NM));
                    (range, block.cx.needed_by.replace("fluorescence"))
                });
                keys.needed("spectrum", &mut spectrum, SpectrumOf::Emission, about);
                if let (Some((range, by)), Some(block)) = (needed, keys.reader()) {
                    block.cx.range_nm.set(range);
                    block.cx.needed_by.set(by);
                }
                self.light = ExcitationLight::Spectrum(spectrum);
            }
        }
    }
}
