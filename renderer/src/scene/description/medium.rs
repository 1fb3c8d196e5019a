//! What fills bodies.

use leafmodel::document::declared::{Declared, Defaults, Words};
use leafmodel::document::keys::Keys;

use crate::geometry::scatter::Inclination;
use crate::scene::blocks::spectrum::SpectrumOf;
use crate::scene::blocks::volume::inclination;
use crate::spectrum::Curve;
use crate::spectrum::written::Spectrum;

/// Millimetres per metre.
const PER_MM: f64 = 1000.0;

/// A homogeneous medium that absorbs and scatters light.
#[derive(Clone, Debug, Declared, Default)]
#[key(last = refuse_g)]
pub struct Medium {
    /// Absorption coefficient, m⁻¹.
    #[key(with = absorption)]
    pub absorption: Spectrum,
    /// Scattering coefficient, m⁻¹.
    #[key(with = scattering)]
    pub scattering: Spectrum,
    /// Where scattered light goes.
    #[key("phase", word)]
    pub phase: MediumPhase,
    /// Mean cosine of the angle of scattering, for `henyey-greenstein`: 0 is even, 1 straight on.
    #[key("g", -0.999..=0.999)]
    pub g: f64,
    /// Leaves without extent, instead of all the other keys.
    #[key("leaves", block)]
    pub leaves: Option<Foliage>,
}

/// Leaves without extent that fill a body. Both faces are Lambertian.
#[derive(Clone, Debug, Declared, Defaults)]
#[key(last = Self::check)]
pub struct Foliage {
    /// Area of leaves, one side, in each volume: leaf area index over the height of the layer.
    #[key("area_m2_per_m3", required, above(0.0, 1e4), default = 1.0)]
    pub area: f64,
    /// How they are inclined from the scene's +z.
    #[key(with = inclined, default = Inclination::Spherical)]
    pub inclination: Inclination,
    /// Reflectance of both faces.
    #[key("reflectance", required, SpectrumOf::Share, default = Spectrum::Constant(0.0))]
    pub reflectance: Spectrum,
    /// Transmittance, by which no wavelength may get more than all of its light.
    #[key("transmittance", required, SpectrumOf::Share, default = Spectrum::Constant(0.0))]
    pub transmittance: Spectrum,
}

impl Foliage {
    fn check(&mut self, keys: &mut Keys<'_>) {
        if !keys.is_sound() {
            return;
        }
        let [back, forth] = [&self.reflectance, &self.transmittance].map(Curve::from_description);
        let steps = (0..=428_u16).map(|step| 360.0 + 5.0 * f32::from(step));
        let most = steps.map(|nm| (back.at(nm) + forth.at(nm), nm));
        let most = most.max_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((sum, nm)) = most.filter(|(sum, _)| *sum > 1.0 + 1e-6) {
            let problem =
                format!("leaves would send on {sum:.3} of the light that they get at {nm} nm");
            let help = "let `reflectance` and `transmittance` add up to 1 at most";
            keys.refuse(&["transmittance"], problem, help);
        }
    }
}

fn inclined(foliage: &mut Foliage, keys: &mut Keys<'_>) {
    inclination::declare(&mut foliage.inclination, keys);
}

/// The phase functions of media, a closed set.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Words)]
pub enum MediumPhase {
    /// Henyey and Greenstein's function.
    #[default]
    #[word("henyey-greenstein")]
    HenyeyGreenstein,
    /// Particles far smaller than the wavelength.
    Rayleigh,
}

fn absorption(medium: &mut Medium, keys: &mut Keys<'_>) {
    let about = "Absorption coefficient: light is weakened e-fold over its inverse. None if neither \
        of the keys is there.";
    let names = ["absorption_per_mm", "absorption_per_m"];
    coefficient(&mut medium.absorption, names, about, keys);
}

fn scattering(medium: &mut Medium, keys: &mut Keys<'_>) {
    let about = "Scattering coefficient: its inverse is the mean way between two events. None if \
        neither of the keys is there.";
    let names = ["scattering_per_mm", "scattering_per_m"];
    coefficient(&mut medium.scattering, names, about, keys);
}

/// A coefficient by one of two keys, per millimetre or per metre.
fn coefficient(
    coefficient: &mut Spectrum,
    [per_mm, per_m]: [&'static str; 2],
    about: &'static str,
    keys: &mut Keys<'_>,
) {
    for chosen in keys.one_of_or_none(&[per_mm, per_m], None) {
        let (kind, about, factor) = if chosen == per_mm {
            (SpectrumOf::PerMillimetre, about, PER_MM)
        } else {
            (SpectrumOf::PerMetre, "The same per metre.", 1.0)
        };
        let mut written = None;
        keys.optional(chosen, &mut written, kind, about);
        if let Some(written) = written {
            *coefficient = written.scaled(factor);
        }
    }
}

fn refuse_g(medium: &mut Medium, keys: &mut Keys<'_>) {
    let others = [
        "absorption_per_mm",
        "absorption_per_m",
        "scattering_per_mm",
        "scattering_per_m",
        "phase",
        "g",
    ];
    for other in others {
        keys.exclude("leaves", other);
    }
    if keys.is_sound() && keys.has("g") && medium.phase == MediumPhase::Rayleigh {
        let problem = "the phase `rayleigh` has no mean cosine to set".to_owned();
        let help = "leave `g` out, or write `phase = \"henyey-greenstein\"`";
        keys.refuse(&["g"], problem, help);
    }
}
