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
mod pictures;
mod plan;
mod settling;
mod stages;
pub mod venation_plan;

pub use self::error::LeafError;
pub use self::fields::Fields;
pub use self::lamina::Lamina;
pub use self::memory::LeafMemory;
pub use self::plan::LeafPlan;
pub use self::stages::LeafStage;
use crate::blade::contents_map::ContentsMap;
use crate::blade::frame::UvFrame;
use crate::blade::hairs::{HairMesh, HairPlan};
use crate::blade::mesh::{BladeMesh, Displacement};
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
        let Lamina {
            outline, network, ..
        } = &lamina;
        // Before the mesh and the map, which would tell it after all their work.
        VeinField::check(network.segments())?;
        let settled = plan.settled(&lamina);
        let settled = settled.as_ref();
        let frame = UvFrame::around(lamina.intact().points());
        let holes = lamina.holes();
        let lips = |p| {
            lamina
                .wounds
                .as_ref()
                .map_or(0.0, |wounds| wounds.height(p))
        };
        let cut = (outline, holes, &frame);
        let bulge = plan.meshed_bulge(&lamina, &frame);
        let displaced = Displacement {
            lips: &lips,
            bulge: &|p| bulge.as_ref().map_or(0.0, |bulge| bulge.height(p)),
        };
        let mut petiole = plan
            .petiole
            .map(|petiole| petiole.settled((outline, network), &plan.form, settled, plan.seed))
            .transpose()?;
        // The mesh is mostly the work of one thread, the map of all.
        let mut mesh = None;
        let contents = rayon::in_place_scope(|scope| {
            let mesh = &mut mesh;
            scope.spawn(move |_| {
                *mesh = Some(BladeMesh::build_holed(
                    cut, network, &plan.form, settled, displaced,
                ));
            });
            self.contents(plan, &lamina)
        });
        let mut mesh = mesh.expect("the scope has ended")?;
        let contents = contents?;
        if plan.stance.on_ground {
            settling::put_on_ground(&mut mesh, petiole.as_mut());
        }
        let size = [contents.width, contents.height];
        let surface = plan.surface_of(&lamina, &mesh, &frame, size)?;
        let hairs = plan.hairs_of(&lamina, &mesh)?;
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
