//! One leaf from plan to data: outline → veins → blade and contents.

use thiserror::Error;

use crate::blade::BladeForm;
use crate::blade::contents_map::ContentsMap;
use crate::blade::frame::UvFrame;
use crate::blade::mesh::{BladeError, BladeMesh};
use crate::blade::tissue::{Tissue, TissueError};
use crate::shape::growth_shape::{GrowthShape, GrowthShapeError};
use crate::shape::outline::Outline;
use crate::venation;
use crate::venation::VenationError;
use crate::venation::network::{VeinSegment, VenationNetwork};
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

/// A grown leaf. Lengths are millimetres.
#[derive(Clone, Debug, PartialEq)]
pub struct Leaf {
    /// The margin of the flat lamina.
    pub outline: Outline,
    /// Its veins.
    pub network: VenationNetwork,
    /// The blade in space.
    pub mesh: BladeMesh,
    /// Where texture coordinates are measured.
    pub frame: UvFrame,
    /// Contents over them.
    pub contents: ContentsMap,
}

/// Why a plan cannot be carried out.
#[derive(Debug, Error)]
pub enum LeafError {
    /// The outline.
    #[error("outline: {0}")]
    Outline(#[from] GrowthShapeError),
    /// The veins.
    #[error("venation: {0}")]
    Venation(#[from] VenationError),
    /// The blade.
    #[error("blade: {0}")]
    Blade(#[from] BladeError),
    /// The tissue.
    #[error("tissue: {0}")]
    Tissue(#[from] TissueError),
}

impl Leaf {
    /// Grows the leaf of a plan.
    ///
    /// # Errors
    ///
    /// [`LeafError`] of the first stage whose numbers are out of range.
    pub fn grow(plan: &LeafPlan) -> Result<Self, LeafError> {
        // Cheap checks first: a bad number should not cost the time of growing the veins.
        plan.tissue.validate()?;
        plan.form.validate()?;
        let outline = plan.outline.grow(plan.length_mm)?;
        let network = venation::grow(&outline, &plan.venation, plan.seed)?;
        let mesh = BladeMesh::build(&outline, &network, &plan.form)?;
        let frame = UvFrame::around(outline.points());
        let veins: Vec<VeinSegment> = network.segments().collect();
        let contents = ContentsMap::paint(&frame, &veins, &plan.tissue, plan.map_size, plan.seed)?;
        Ok(Self {
            outline,
            network,
            mesh,
            frame,
            contents,
        })
    }
}
