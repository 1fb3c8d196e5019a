//! The stages of a leaf whose results can be kept between runs: veins, form, contents, faces.
//!
//! - **In**: a plan, and [`GrowOptions::kept`](crate::grow_options::GrowOptions::kept).
//! - **Out**: the result of a stage, from there or made.
//! - **Always true**: a stage sees only the part of the plan that is its key, so what is kept under a key
//!   cannot depend on anything else; what comes back has the same bits as what would be made.
//! - **Left out**: margins, which are made each time, and the cells of transport leaves with them.

use rayon::prelude::*;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::error::LeafError;
use super::lamina::Lamina;
use super::plan::LeafPlan;
use super::settling;
use crate::blade::BladeForm;
use crate::blade::frame::UvFrame;
use crate::blade::hairs::{HairMesh, HairPlan};
use crate::blade::mesh::{BladeMesh, Displacement};
use crate::blade::stalk::StalkMesh;
use crate::blade::surface::SurfacePlan;
use crate::blade::tissue::Tissue;
use crate::grow_options::{GrowOptions, Kept};
use crate::optics::{Constituent, Contents};

/// A stage, named as files of results are.
#[derive(Clone, Copy, Debug)]
pub(super) enum Stage {
    Veins,
    Form,
    Contents,
    Faces,
}

impl Stage {
    const fn name(self) -> &'static str {
        match self {
            Self::Veins => "veins",
            Self::Form => "form",
            Self::Contents => "contents",
            Self::Faces => "faces",
        }
    }

    /// The result for this part of a plan: what is kept, or what `make` makes, which is kept then.
    ///
    /// # Errors
    ///
    /// Those of `make`.
    pub(super) fn take_or_make<T: Serialize + DeserializeOwned, E>(
        self,
        kept: Option<&dyn Kept>,
        part: &LeafPlan,
        make: impl FnOnce() -> Result<T, E>,
    ) -> Result<T, E> {
        let Some(kept) = kept else {
            return make();
        };
        let key = part.key();
        let found = kept.take(self.name(), &key);
        if let Some(value) = found.and_then(|bytes| postcard::from_bytes(&bytes).ok()) {
            return Ok(value);
        }
        let made = make()?;
        let bytes = postcard::to_allocvec(&made);
        kept.keep(self.name(), &key, &bytes.expect("lists know their lengths"));
        Ok(made)
    }
}

/// A blade in space, with what grows on it.
#[derive(Debug, Deserialize, Serialize)]
pub(super) struct Form {
    pub(super) mesh: BladeMesh,
    pub(super) petiole: Option<StalkMesh>,
    pub(super) hairs: Vec<HairMesh>,
}

impl Form {
    /// The form of a lamina by [the part of its plan](LeafPlan::of_form) that decides it.
    pub(super) fn of(plan: &LeafPlan, lamina: &Lamina) -> Result<Self, LeafError> {
        let (outline, network) = (&lamina.outline, &lamina.network);
        let settled = plan.settled(lamina);
        let settled = settled.as_ref();
        let frame = UvFrame::around(lamina.intact().points());
        let lips = |p| {
            let wounds = lamina.wounds.as_ref();
            wounds.map_or(0.0, |wounds| wounds.height(p))
        };
        let bulge = plan.meshed_bulge(lamina, &frame);
        let displaced = Displacement {
            lips: &lips,
            bulge: &|p| bulge.as_ref().map_or(0.0, |bulge| bulge.height(p)),
        };
        let mut petiole = plan
            .petiole
            .map(|petiole| petiole.settled((outline, network), &plan.form, settled, plan.seed))
            .transpose()?;
        let cut = (outline, lamina.holes(), &frame);
        let mut mesh = BladeMesh::build_holed(cut, network, &plan.form, settled, displaced)?;
        if plan.stance.on_ground {
            settling::put_on_ground(&mut mesh, petiole.as_mut());
        }
        let hairs = plan.hairs_of(lamina, &mesh)?;
        Ok(Self {
            mesh,
            petiole,
            hairs,
        })
    }
}

/// Grows the veins that several of these blades share, so that each of them finds them in `kept`.
///
/// Errors are left to the growth of the leaves.
pub fn keep_shared_veins(blades: &[LeafPlan], kept: &dyn Kept) {
    let parts: Vec<LeafPlan> = blades.iter().map(LeafPlan::of_veins).collect();
    let is_first_of_several = |(number, part): &(usize, &LeafPlan)| {
        !parts[..*number].contains(part) && parts[number + 1..].contains(part)
    };
    let shared: Vec<&LeafPlan> = parts
        .iter()
        .enumerate()
        .filter(is_first_of_several)
        .map(|(_, part)| part)
        .collect();
    shared.par_iter().for_each(|part| {
        let options = GrowOptions {
            kept: Some(kept),
            ..GrowOptions::default()
        };
        drop(options.lamina(part));
    });
}

impl LeafPlan {
    /// Every value of the plan with all its digits, those that it has read from files too: a file that changes keeps
    /// its name.
    fn key(&self) -> String {
        format!("{self:?}")
    }

    /// What decides its veins.
    pub(super) fn of_veins(&self) -> Self {
        Self {
            seed: self.seed,
            outline: self.outline.clone(),
            venation: self.venation.clone(),
            ..Self::of_length(self.length_mm)
        }
    }

    /// What decides the blade in space, its stalk and its hairs.
    pub(super) fn of_form(&self) -> Self {
        // Wilting is stiffness against weight.
        let mut weight = Contents::NOTHING;
        let dry = [
            &[Constituent::DryMatter][..],
            &Constituent::DRY_MATTER_PARTS,
        ]
        .concat();
        for constituent in dry.into_iter().chain([Constituent::Water]) {
            weight[constituent] = self.tissue.lamina[constituent];
        }
        let bare = |hairs: &HairPlan| HairPlan {
            contents: Contents::NOTHING,
            ..hairs.clone()
        };
        Self {
            tissue: Tissue {
                full_vein_radius_mm: self.tissue.full_vein_radius_mm,
                ..Tissue::of(weight)
            },
            damage: self.damage,
            form: self.form,
            stance: self.stance,
            surface: self.surface.as_ref().map(SurfacePlan::displacement_alone),
            hairs: self.hairs.iter().map(bare).collect(),
            petiole: self.petiole,
            ..self.of_veins()
        }
    }

    /// What decides the contents of its tissue.
    pub(super) fn of_contents(&self) -> Self {
        Self {
            map_size: self.map_size,
            tissue: self.tissue,
            mosaic: self.mosaic.clone(),
            layers: self.layers.clone(),
            unevenness: self.unevenness,
            senescence: self.senescence,
            damage: self.damage,
            form: BladeForm {
                thickness_mm: self.form.thickness_mm,
                margin: self.form.margin,
                ..BladeForm::nearly_flat(self.length_mm)
            },
            ..self.of_veins()
        }
    }

    /// What decides the slopes of its faces.
    pub(super) fn of_faces(&self) -> Self {
        let ages = self
            .surface
            .as_ref()
            .is_some_and(|plan| plan.dead_roughness > 0.0);
        Self {
            map_size: self.map_size,
            senescence: self.senescence.filter(|_| ages),
            surface: self.surface,
            hairs: Vec::new(),
            ..self.of_form()
        }
    }
}
