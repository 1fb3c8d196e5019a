//! Conversion of tissue from the description, for materials and for grown leaves and bodies.

use std::sync::Arc;

use leafmodel::optics::fluorescence::EmissionSpectrum;
use leafmodel::optics::solid::ReflectanceTable;

use super::description::tissue::{self, Fluorescence, LeafFaces, LeafOptics, SolidOptics};
use crate::bsdf::leaf::Coat;
use crate::material::held::Held;
use crate::material::leaf::{Abaxial, LeafMaterial, LeafTissue};
use crate::material::palette::Palette;
use crate::material::solid::SolidMaterial;
use crate::spectrum::Curve;

/// Leaf tissue between its faces.
pub(super) fn leaf(
    tissue: LeafTissue,
    palette: Palette,
    faces: &LeafFaces,
    fluorescence: Option<Fluorescence>,
) -> LeafMaterial {
    let curve = |spectrum: &Option<_>| spectrum.as_ref().map(Curve::from_description);
    let abaxial = match curve(&faces.abaxial_reflectance) {
        Some(reflectance) => Some(Abaxial::Reflectance(reflectance.into())),
        None => curve(&faces.abaxial_ratio).map(|ratio| Abaxial::Ratio(ratio.into())),
    };
    let leaf = LeafMaterial::new(tissue, palette, abaxial, faces.coats.map(coat_of));
    let leaf = match fluorescence {
        Some(own) => leaf.fluorescing(
            own.quantum_efficiency,
            EmissionSpectrum::new(own.red_over_far_red),
        ),
        None => leaf,
    };
    match faces.optics {
        LeafOptics::Plates => leaf,
        LeafOptics::Layers => leaf.layered(),
    }
}

/// Solid tissue below its skin; `table` is that of its refractive index.
pub(super) fn solid(
    held: Held,
    palette: Palette,
    optics: &SolidOptics,
    table: Arc<ReflectanceTable>,
) -> SolidMaterial {
    SolidMaterial::new(held, palette, optics.tissue, table, coat_of(optics.coat))
}

/// A coat with its tables.
fn coat_of(coat: tissue::Coat) -> Coat {
    Coat::new(
        coat.eta as f32,
        coat.alpha_across as f32,
        coat.alpha_along as f32,
    )
}
