//! A surface that scatters evenly.

use leafmodel::document::declared::Declared;
use leafmodel::document::keys::Keys;

use crate::scene::description::reflectance::Reflectance;

/// Lambertian.
#[derive(Clone, Debug, Declared, Default)]
pub struct Diffuse {
    /// Its reflectance.
    #[key(flat, with = declare_reflectance)]
    pub reflectance: Reflectance,
}

fn declare_reflectance(own: &mut Reflectance, keys: &mut Keys<'_>) {
    own.declare("Share of light that is reflected.", keys);
}
