//! A surface that scatters evenly.

use leafmodel::document::declared::Declared;
use leafmodel::document::keys::Keys;

use crate::plugin::element::{Element, Layout};
use crate::plugin::surface::Exported;
use crate::scene::description::reflectance::Reflectance;

/// Lambertian.
#[derive(Clone, Debug, Declared, Default)]
pub struct Diffuse {
    /// Its reflectance.
    #[key(flat, with = declare_reflectance)]
    pub reflectance: Reflectance,
}

impl Diffuse {
    pub(super) fn plugin(&self, surface: &mut Exported<'_>) -> Element {
        let one_side = Element::plugin("bsdf", "diffuse");
        Element::plugin("bsdf", "twosided")
            .called(surface.id)
            .holding(one_side.holding(self.reflectance.parameter(surface)))
            .laid_out(Layout::Inline)
    }
}

fn declare_reflectance(own: &mut Reflectance, keys: &mut Keys<'_>) {
    own.declare("Share of light that is reflected.", keys);
}
