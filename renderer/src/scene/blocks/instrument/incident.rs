//! `incident`: how much light there is, so that absorbed photons can be told.

use leafmodel::document::keys::Keys;
use leafmodel::document::limits::Limits;
use leafmodel::document::names::NameIn;
use leafmodel::document::value_kind::Number;

use crate::scene::authored::{self, Authored};
use crate::scene::blocks::spectrum::SpectrumOf;
use crate::scene::description::{Amount, Incident, Instrument, Spectrum};
use crate::spectrum::Curve;

impl Incident {
    fn usual() -> Self {
        Self {
            spectrum: Spectrum::D65 { scale: 1.0 },
            light: None,
            amount: Amount::Irradiance(500.0),
        }
    }
}

/// The block of an instrument.
pub(super) fn incident(instrument: &mut Instrument, keys: &mut Keys<'_>) {
    let about = "How much light there is on a level plane, for absorbed photons.";
    let declare = |incident: &mut Incident, keys: &mut Keys<'_>| declare(incident, keys);
    keys.optional_block(
        "incident",
        &mut instrument.incident,
        Incident::usual,
        about,
        declare,
    );
}

fn declare(incident: &mut Incident, keys: &mut Keys<'_>) {
    let about = "Its spectrum, of which only the form counts.";
    keys.key(
        "spectrum",
        &mut incident.spectrum,
        SpectrumOf::Emission,
        about,
    );
    let about = "The light of the scene whose spectrum it has, instead of `spectrum`.";
    let kind = NameIn("lights", "the name of a light");
    keys.optional("light", &mut incident.light, kind, about);
    keys.exclude("light", "spectrum");
    let current = match incident.amount {
        Amount::Irradiance(_) => "irradiance_w_m2",
        Amount::Photons(_) => "par_umol_m2_s",
    };
    for chosen in keys.one_of(&["irradiance_w_m2", "par_umol_m2_s"], Some(current)) {
        let limits = Number(Limits::above(0.0, 1e6));
        let mut amount = 500.0;
        if chosen == "irradiance_w_m2" {
            let about = "Irradiance from 400 to 700 nm.";
            keys.needed("irradiance_w_m2", &mut amount, limits, about);
            incident.amount = Amount::Irradiance(amount);
        } else {
            let about = "Photon flux from 400 to 700 nm (PAR).";
            keys.needed("par_umol_m2_s", &mut amount, limits, about);
            incident.amount = Amount::Photons(amount);
        }
    }
    if !covers_par(&incident.spectrum) {
        let problem = "the table does not cover 400 to 700 nm".to_owned();
        keys.refuse(&["spectrum"], problem, "add wavelengths");
    }
    if is_dark(&incident.spectrum) {
        let problem = "there is no light from 400 to 700 nm".to_owned();
        keys.refuse(&["spectrum"], problem, "use a spectrum with visible light");
    }
}

/// Whether a spectrum is told from 400 to 700 nm.
fn covers_par(spectrum: &Spectrum) -> bool {
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
fn is_dark(spectrum: &Spectrum) -> bool {
    let curve = Curve::from_description(spectrum);
    Incident::nodes_nm().all(|nm| curve.at(nm as f32) <= 0.0)
}

/// A light whose spectrum an instrument takes has one, with light in it.
pub(in crate::scene::blocks) fn check_lights(scene: &Authored, keys: &Keys<'_>) {
    for instrument in &scene.instruments {
        let incident = instrument.value.incident.as_ref();
        let light = incident.and_then(|incident| scene.lights.get(incident.light?));
        let Some(light) = light else { continue };
        let name = &light.name;
        let spectrum = match &light.value {
            authored::Light::Single(light) => Some(light.relative_spectrum()),
            authored::Light::Rig(_) => None,
        };
        let problem = match spectrum {
            None => format!("`{name}` is a rig of several lights"),
            Some(spectrum) if !covers_par(&spectrum) => {
                format!("the spectrum of `{name}` does not cover 400 to 700 nm")
            }
            Some(spectrum) if is_dark(&spectrum) => {
                format!("`{name}` has no light from 400 to 700 nm")
            }
            Some(_) => continue,
        };
        let kind = instrument.value.kind.word();
        let path = ["instruments", &instrument.name, kind, "incident", "light"];
        keys.refuse(&path, problem, "write a `spectrum` instead");
    }
}
