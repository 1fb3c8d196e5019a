//! `[instruments.NAME.KIND.fluorescence]`.

use leafmodel::document::keys::Keys;
use leafmodel::document::limits::Limits;
use leafmodel::optics::fluorescence::{EMITTED_NM, EXCITED_NM};

use super::{MOST_WAVELENGTHS, Rising, every};
use crate::scene::blocks::spectrum::SpectrumOf;
use crate::scene::description::{ExcitationLight, FluorescenceReading, Spectrum};

/// Most excitations, each of which is a measurement of its own.
const MOST_EXCITATIONS: usize = 400;

impl FluorescenceReading {
    fn usual() -> Self {
        Self {
            light: ExcitationLight::Spectrum(Spectrum::Constant(0.0)),
            emission_nm: every(EMITTED_NM, 10.0),
        }
    }
}

/// The optional block.
pub(super) fn fluorescence(reading: &mut Option<FluorescenceReading>, keys: &mut Keys<'_>) {
    let about = "What leaves that fluoresce emit, besides the figures of this instrument.";
    let new = FluorescenceReading::usual;
    keys.optional_block("fluorescence", reading, new, about, own);
}

fn own(reading: &mut FluorescenceReading, keys: &mut Keys<'_>) {
    let current = match reading.light {
        ExcitationLight::Monochromatic(_) => "excitation_nm",
        ExcitationLight::Spectrum(_) => "spectrum",
    };
    for chosen in keys.one_of(&["excitation_nm", "spectrum"], Some(current)) {
        if chosen == "excitation_nm" {
            let mut list = match &reading.light {
                ExcitationLight::Monochromatic(list) => list.clone(),
                ExcitationLight::Spectrum(_) => Vec::new(),
            };
            let kind = Rising {
                limits: Limits::closed(EXCITED_NM[0], EXCITED_NM[1]),
                most: MOST_EXCITATIONS,
                what: "a list of 1 to 400 wavelengths, rising",
            };
            let about = "Wavelengths of monochromatic light, one after the other; figures are \
                photons for each incident photon and nanometre of emission.";
            keys.needed("excitation_nm", &mut list, kind, about);
            reading.light = ExcitationLight::Monochromatic(list);
        } else {
            let mut spectrum = match &reading.light {
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
            reading.light = ExcitationLight::Spectrum(spectrum);
        }
    }
    let kind = Rising {
        limits: Limits::closed(EMITTED_NM[0], EMITTED_NM[1]),
        most: MOST_WAVELENGTHS,
        what: "a list of 1 to 4096 wavelengths, rising",
    };
    let about = "Wavelengths of emission; left out, 640 to 850 nm by 10 nm.";
    keys.key("emission_nm", &mut reading.emission_nm, kind, about);
}
