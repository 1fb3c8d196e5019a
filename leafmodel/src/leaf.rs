//! One leaf from plan to data: outline → veins → blade and contents.

use crate::blade::BladeForm;
use crate::blade::tissue::Tissue;
use crate::shape::growth_shape::GrowthShape;
use crate::venation::plan::VenationPlan;

/// Everything that decides a leaf.
#[derive(Clone, Debug, PartialEq)]
pub struct LeafPlan {
    /// Length of the midrib, mm, > 0.
    pub length_mm: f64,
    /// Same plan and seed, same leaf, bit for bit.
    pub seed: u64,
    /// The margin.
    pub outline: GrowthShape,
    /// The veins.
    pub venation: VenationPlan,
    /// What the tissue holds, and how veins change it.
    pub tissue: Tissue,
    /// How the blade lies in space.
    pub form: BladeForm,
    /// Texels of the content maps along the longer side of the leaf, 16 to 8192.
    pub map_size: u32,
}
