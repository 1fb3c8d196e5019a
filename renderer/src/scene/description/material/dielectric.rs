//! The boundary of a transparent medium.

use leafmodel::document::declared::{Declared, Defaults};
use leafmodel::document::keys::Keys;
use leafmodel::document::names::NameIn;

use crate::bsdf::dielectric::Dielectric;
use crate::plugin::element::Element;

/// A smooth or rough (GGX) boundary of a transparent medium.
#[derive(Clone, Debug, Declared, Defaults)]
#[key(last = Self::refuse_roughness)]
pub struct Boundary {
    /// Refractive index inside over outside; the normal points outside. 1 is no boundary: light goes straight on.
    #[key("eta", 0.25..=4.0, default = 1.5)]
    pub eta: f64,
    /// GGX roughness; 0 is smooth.
    #[key("roughness", 0.0..=1.0)]
    pub roughness: f64,
    /// What fills the body, whose mesh is closed; left out, it is clear.
    ///
    /// Index into [`Description::media`](crate::scene::description::Description::media).
    #[key("interior", NameIn("media", "the name of a medium"))]
    pub interior: Option<usize>,
}

impl Boundary {
    pub(super) fn built(&self) -> Dielectric {
        Dielectric {
            eta: self.eta as f32,
            alpha: self.roughness as f32,
        }
    }

    pub(super) fn plugin(&self, id: &str) -> Element {
        if self.eta == 1.0 {
            // Mitsuba's boundary without a change of index; it is no event on a path either.
            return Element::plugin("bsdf", "null").called(id);
        }
        let is_rough = self.roughness > 0.0;
        let kind = if is_rough {
            "roughdielectric"
        } else {
            "dielectric"
        };
        let bsdf = Element::plugin("bsdf", kind)
            .called(id)
            .float("int_ior", self.eta)
            .float("ext_ior", 1.0);
        if is_rough {
            bsdf.string("distribution", "ggx")
                .float("alpha", self.roughness)
        } else {
            bsdf
        }
    }

    fn refuse_roughness(&mut self, keys: &mut Keys<'_>) {
        if keys.is_sound() && self.eta == 1.0 && self.roughness > 0.0 {
            let problem = "a boundary with the same index on both sides cannot be rough".to_owned();
            let help = "leave `roughness` out, or write another `eta`";
            keys.refuse(&["roughness"], problem, help);
        }
    }
}
