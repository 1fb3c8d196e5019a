//! `[media.NAME]`: what fills bodies.

use leafmodel::document::keys::Keys;
use leafmodel::document::limits::Limits;
use leafmodel::document::value_kind::{Number, Word};

use super::spectrum::SpectrumOf;
use crate::scene::description::{Medium, MediumPhase, Spectrum};

impl Medium {
    /// A clear medium.
    pub(super) fn clear() -> Self {
        Self {
            absorption: Spectrum::Constant(0.0),
            scattering: Spectrum::Constant(0.0),
            phase: MediumPhase::HenyeyGreenstein,
            g: 0.0,
        }
    }
}

/// Millimetres per metre.
const PER_MM: f64 = 1000.0;

/// The keys of one of `[media]`.
pub(super) fn medium(medium: &mut Medium, keys: &mut Keys<'_>) {
    let about = "Absorption coefficient: light is weakened e-fold over its inverse. None if neither \
        of the keys is there.";
    let names = ["absorption_per_mm", "absorption_per_m"];
    coefficient(&mut medium.absorption, names, about, keys);
    let about = "Scattering coefficient: its inverse is the mean way between two events. None if \
        neither of the keys is there.";
    let names = ["scattering_per_mm", "scattering_per_m"];
    coefficient(&mut medium.scattering, names, about, keys);
    let about = "Where scattered light goes.";
    keys.key("phase", &mut medium.phase, Word(&MediumPhase::WORDS), about);
    let about = "Mean cosine of the angle of scattering, for `henyey-greenstein`: 0 is even, 1 \
        straight on.";
    let limits = Number(Limits::closed(-0.999, 0.999));
    keys.key("g", &mut medium.g, limits, about);
    if keys.is_sound() && keys.has("g") && medium.phase == MediumPhase::Rayleigh {
        let problem = "the phase `rayleigh` has no mean cosine to set".to_owned();
        let help = "leave `g` out, or write `phase = \"henyey-greenstein\"`";
        keys.refuse(&["g"], problem, help);
    }
}

/// A coefficient by one of two keys, per millimetre or per metre.
fn coefficient(
    coefficient: &mut Spectrum,
    [per_mm, per_m]: [&'static str; 2],
    about: &'static str,
    keys: &mut Keys<'_>,
) {
    for chosen in keys.one_of_or_none(&[per_mm, per_m], None) {
        let mut written = None;
        if chosen == per_mm {
            keys.optional(per_mm, &mut written, SpectrumOf::PerMillimetre, about);
        } else {
            let about = "The same per metre.";
            keys.optional(per_m, &mut written, SpectrumOf::PerMetre, about);
        }
        let factor = if chosen == per_mm { PER_MM } else { 1.0 };
        if let Some(written) = written {
            *coefficient = written.scaled(factor);
        }
    }
}
