//! A surface of grains, such as bare soil.

use leafmodel::document::declared::{Declared, Defaults};
use leafmodel::document::keys::Keys;

use crate::bsdf::hapke::{Grains, greatest_reflectance};
use crate::material::Material;
use crate::plugin::element::Element;
use crate::plugin::surface::Exported;
use crate::scene::blocks::spectrum::SpectrumOf;
use crate::spectrum::Curve;
use crate::spectrum::written::Spectrum;

/// A surface of grains after Hapke.
#[derive(Clone, Debug, Declared, Defaults)]
#[key(last = Self::check)]
pub struct Hapke {
    /// Single-scattering albedo w of the grains: the share of the light that a grain meets which it scatters.
    #[key("albedo", required, SpectrumOf::Share, default = Spectrum::Constant(0.5))]
    pub albedo: Spectrum,
    /// Asymmetry b of the two lobes into which grains scatter; 0 is even in all directions.
    #[key("asymmetry", 0.0..=0.95)]
    pub asymmetry: f64,
    /// Weight c of the backward lobe: 1 is all of it, -1 is all of the forward one.
    #[key("backward", -1.0..=1.0)]
    pub backward: f64,
    /// Height of the opposition effect: single scattering straight back is one more than this times as bright.
    #[key("opposition", 0.0..=3.0)]
    pub opposition: f64,
    /// Width h of the opposition effect: its half is left where h is the tangent of half the phase angle.
    #[key("opposition_width", 1e-3..=10.0, default = 0.06)]
    pub width: f64,
}

impl Hapke {
    fn grains(&self) -> Grains {
        Grains {
            asymmetry: self.asymmetry as f32,
            backward: self.backward as f32,
            opposition: self.opposition as f32,
            width: self.width as f32,
        }
    }

    pub(super) fn built(&self) -> Material {
        Material::Hapke {
            albedo: Curve::from_description(&self.albedo).into(),
            grains: self.grains(),
        }
    }

    pub(super) fn plugin(&self, surface: &mut Exported<'_>) -> Element {
        // In `reference/`.
        Element::plugin("bsdf", "lamina_hapke")
            .called(surface.id)
            .float("asymmetry", self.asymmetry)
            .float("backward", self.backward)
            .float("opposition", self.opposition)
            .float("width", self.width)
            .holding(surface.spectra.element("albedo", &self.albedo, 1.0))
    }

    /// Refuses grains that would send back more light than they get.
    fn check(&mut self, keys: &mut Keys<'_>) {
        if keys.reader().is_none() || !keys.is_sound() {
            return;
        }
        let points = Curve::from_description(&self.albedo).points();
        let brightest = points.iter().map(|(_, albedo)| *albedo).fold(0.0, f64::max);
        let (reflected, angle) = greatest_reflectance(brightest as f32, self.grains());
        if reflected > 1.0 {
            let problem = format!(
                "with an albedo of {brightest:.4} the surface would reflect {reflected:.3} of the light from {:.0}° off its \
                 normal",
                angle.to_degrees()
            );
            let help = "lower `albedo`, `asymmetry` or `opposition`: the model holds for grains that absorb";
            keys.refuse(&["albedo"], problem, help);
        }
    }
}
