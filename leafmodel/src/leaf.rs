//! One leaf from plan to data: outline → veins → blade and contents.
//!
//! ```
//! use leafmodel::leaf::Leaf;
//! use leafmodel::species;
//!
//! let mut plan = species::find("poplar").ok_or("the poplar is a preset")?.plan();
//! plan.map_size = 64;
//! let leaf = Leaf::grow(&plan)?;
//! // The same plan and seed give the same leaf; another seed another one of the kind.
//! assert_eq!(Leaf::grow(&plan)?, leaf);
//! plan.seed += 1;
//! assert_ne!(Leaf::grow(&plan)?.lamina.network, leaf.lamina.network);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod damage;
mod error;
mod fields;
mod flat_growth;
mod holders;
mod lamina;
mod memory;
pub mod outline_plan;
mod painting;
mod plan;
mod settling;
mod stages;
mod stages_kept;
pub mod venation_plan;

pub use self::error::LeafError;
pub use self::fields::Fields;
pub use self::lamina::Lamina;
pub use self::memory::LeafMemory;
pub use self::plan::LeafPlan;
pub use self::stages::LeafStage;
pub use self::stages_kept::keep_shared_veins;
use self::stages_kept::{Form, Stage};
use crate::blade::contents_map::ContentsMap;
use crate::blade::frame::UvFrame;
use crate::blade::hairs::{HairMesh, HairPlan};
use crate::blade::mesh::BladeMesh;
use crate::blade::stalk::StalkMesh;
use crate::blade::surface::SurfaceMap;
use crate::blade::vein_field::VeinField;
use crate::document::Declared;
use crate::grow_options::GrowOptions;

/// A grown leaf. Lengths are millimetres.
#[derive(Clone, Debug, PartialEq)]
pub struct Leaf {
    /// Margin and veins.
    pub lamina: Lamina,
    /// The blade in space.
    pub mesh: BladeMesh,
    /// Its petiole in space, if it has one.
    pub petiole: Option<StalkMesh>,
    /// Where texture coordinates are measured.
    pub frame: UvFrame,
    /// Contents over them.
    pub contents: ContentsMap,
    /// Slopes of its faces over them, if the plan has a surface.
    pub surface: Option<SurfaceMap>,
    /// Its hairs in space, by kind.
    pub hairs: Vec<HairMesh>,
}

impl Leaf {
    /// Grows the leaf of a plan with default [`GrowOptions`].
    ///
    /// # Errors
    ///
    /// [`LeafError`] of the first stage whose numbers are out of range.
    pub fn grow(plan: &LeafPlan) -> Result<Self, LeafError> {
        GrowOptions::default().leaf(plan)
    }
}

impl GrowOptions<'_> {
    /// The leaf of a plan.
    ///
    /// # Errors
    ///
    /// As [`Leaf::grow`]; one that [is a stop](LeafError::is_stop).
    pub fn leaf(self, plan: &LeafPlan) -> Result<Leaf, LeafError> {
        // Cheap checks first: a bad number should not cost the time of growing the veins.
        plan.validate_tissue()?;
        plan.form.validate()?;
        plan.stance.validate()?;
        plan.hairs.iter().try_for_each(HairPlan::in_range)?;
        if let Some(petiole) = &plan.petiole {
            petiole.validate()?;
        }
        self.leaf_of(plan, self.lamina(plan)?)
    }

    /// Blade and contents of a lamina that the plan has brought forth.
    ///
    /// # Errors
    ///
    /// [`LeafError::Blade`], [`LeafError::Mosaic`], [`LeafError::Tissue`].
    pub fn leaf_of(self, plan: &LeafPlan, lamina: Lamina) -> Result<Leaf, LeafError> {
        // Before the mesh and the map, which would report it after all their work.
        VeinField::check(lamina.network.segments())?;
        let (kept, of_form) = (self.kept, plan.of_form());
        // The mesh is mostly the work of one thread, the map of all.
        let mut form = None;
        let formed = || Stage::Form.take_or_make(kept, &of_form, || Form::of(&of_form, &lamina));
        // A blade narrower than its veins can mostly not be built, and painting so many veins takes minutes.
        if lamina.is_narrower_than_its_veins() {
            form = Some(Ok(formed()?));
        }
        let contents = rayon::in_place_scope(|scope| {
            let (form, formed, lamina) = (&mut form, &formed, &lamina);
            scope.spawn(move |_| {
                if form.is_none() {
                    *form = Some(formed());
                }
            });
            let part = plan.of_contents();
            Stage::Contents.take_or_make(kept, &part, || self.contents(&part, lamina))
        });
        let Form {
            mesh,
            petiole,
            hairs,
        } = form.expect("the scope has ended")?;
        let contents = contents?;
        let frame = UvFrame::around(lamina.intact().points());
        let size = [contents.width, contents.height];
        let part = plan.of_faces();
        let surface = Stage::Faces.take_or_make(kept, &part, || {
            part.surface_of(&lamina, &mesh, &frame, size)
        })?;
        Ok(Leaf {
            lamina,
            mesh,
            petiole,
            frame,
            contents,
            surface,
            hairs,
        })
    }
}

#[cfg(test)]
mod tests;
