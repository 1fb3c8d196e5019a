//! A diffuse body below a rough clear coat.

use leafmodel::document::declared::{Declared, Defaults};
use leafmodel::document::keys::Keys;

use super::sources::Sources;
use crate::bsdf::coat::Coat;
use crate::material::plastic::PlasticMaterial;
use crate::plugin::element::Element;
use crate::plugin::surface::Exported;
use crate::scene::assets::AssetError;
use crate::scene::description::reflectance::Reflectance;

/// A diffuse body below a rough dielectric coat.
#[derive(Clone, Debug, Declared, Defaults)]
pub struct Plastic {
    /// Reflectance of the body, for light that has passed the coat.
    #[key(flat, with = declare_reflectance)]
    pub reflectance: Reflectance,
    /// Refractive index of the coat; 1 is none.
    #[key("eta", 1.0..=2.5, default = 1.5)]
    pub eta: f64,
    /// GGX roughness of the coat: glaze 0.05, satin 0.3, matt 0.6 (our estimates).
    #[key("roughness", 0.02..=1.0, default = 0.2)]
    pub roughness: f64,
}

impl Plastic {
    pub(super) fn built(&self, sources: &mut Sources<'_>) -> Result<PlasticMaterial, AssetError> {
        let alpha = self.roughness as f32;
        let coat = Coat::new(self.eta as f32, alpha, alpha);
        let reflectance = sources.reflectance(&self.reflectance)?;
        Ok(PlasticMaterial::new(reflectance, coat))
    }

    pub(super) fn plugin(&self, surface: &mut Exported<'_>) -> Element {
        // In `reference/`.
        Element::plugin("bsdf", "lamina_plastic")
            .called(surface.id)
            .float("eta", self.eta)
            .float("alpha", self.roughness)
            .holding(self.reflectance.parameter(surface))
    }
}

fn declare_reflectance(own: &mut Reflectance, keys: &mut Keys<'_>) {
    own.declare(
        "Share of the light that passes the coat which the body sends back.",
        keys,
    );
}
