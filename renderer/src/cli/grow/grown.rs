//! A leaf as far as its outputs need it.

use std::sync::atomic::{AtomicBool, Ordering};

use leafmodel::compound::{CompoundLeaf, FlatLeaf, WholeLeaf, leaflet_plans};
use leafmodel::grow_options::GrowOptions;
use leafmodel::leaf::{Lamina, Leaf, LeafError, LeafPlan};

use crate::cli::signals;
use crate::cli::terminal::Failure;
use crate::export::blade::{LengthUnit, Parts};
use crate::report::warnings;

/// The parts of a leaf that the outputs need.
pub(super) enum Grown {
    /// The different laminas; a simple leaf has one.
    Flat {
        laminas: Vec<Lamina>,
        compound: Option<CompoundLeaf>,
    },
    Whole(Box<WholeLeaf>),
}

impl Grown {
    pub(super) fn new(plan: &LeafPlan, blade: bool, stop: &AtomicBool) -> Result<Self, Failure> {
        if blade {
            plan.tissue.validate().map_err(Failure::bad)?;
            plan.form.validate().map_err(Failure::bad)?;
            plan.check_senescence().map_err(Failure::bad)?;
        }
        // Overlapping leaflets are found before any veins are grown.
        let compound = plan.compound.as_ref().map(|form| form.arrange(plan));
        let compound = compound.transpose().map_err(Failure::bad)?;
        let plans = match &plan.compound {
            Some(form) => leaflet_plans(plan, form),
            None => vec![plan.clone()],
        };
        let laminas: Result<Vec<Lamina>, Failure> =
            plans.iter().map(|plan| lamina(plan, stop)).collect();
        let laminas = laminas?;
        if !blade {
            return Ok(Self::Flat { laminas, compound });
        }
        let is_stopped = || stop.load(Ordering::Relaxed);
        let options = GrowOptions::stopped_by(&is_stopped);
        let blades = plans.iter().zip(laminas);
        let blades: Result<Vec<Leaf>, LeafError> = blades
            .map(|(plan, lamina)| options.leaf_of(plan, lamina))
            .collect();
        let mut blades = blades.map_err(|error| signals::failure(stop, error))?;
        let mut whole = match (&plan.compound, compound) {
            (Some(form), Some(flat)) => WholeLeaf::assembled(plan, form, flat, blades),
            _ => WholeLeaf::simple(blades.remove(0)),
        };
        if plan.form.closed {
            for blade in &mut whole.blades {
                let frame = &blade.frame;
                blade.mesh = blade.mesh.body(|place| frame.uv(place));
            }
        }
        Ok(Self::Whole(Box::new(whole)))
    }

    /// The lamina; for a compound leaf that of the first leaflet.
    pub(super) fn lamina(&self) -> &Lamina {
        match self {
            Self::Flat { laminas, .. } => &laminas[0],
            Self::Whole(leaf) => &leaf.blades[0].lamina,
        }
    }

    pub(super) fn compound(&self) -> Option<&CompoundLeaf> {
        match self {
            Self::Flat { compound, .. } => compound.as_ref(),
            Self::Whole(leaf) => leaf.flat.as_ref(),
        }
    }

    /// The whole leaf in the plane, if it consists of more than one lamina.
    pub(super) fn flat(&self, plan: &LeafPlan) -> Result<Option<FlatLeaf>, Failure> {
        let laminas: Vec<&Lamina> = match self {
            Self::Flat { laminas, .. } => laminas.iter().collect(),
            Self::Whole(leaf) => leaf.blades.iter().map(|blade| &blade.lamina).collect(),
        };
        let Some(compound) = self.compound() else {
            return Ok(FlatLeaf::with_petiole(plan, laminas[0]));
        };
        let flat = FlatLeaf::compound(compound, &laminas);
        let vanished = || bad!("the smallest leaflets are too small to be drawn");
        flat.ok_or_else(vanished).map(Some)
    }

    pub(super) fn triangles(&self) -> Option<usize> {
        match self {
            Self::Flat { .. } => None,
            Self::Whole(leaf) => Some(Parts::of(leaf, LengthUnit::default()).triangles()),
        }
    }
}

/// Margin and veins of one blade.
fn lamina(plan: &LeafPlan, stop: &AtomicBool) -> Result<Lamina, Failure> {
    let is_stopped = || stop.load(Ordering::Relaxed);
    let lamina = GrowOptions::stopped_by(&is_stopped).lamina(plan);
    let lamina = lamina.map_err(|error| {
        if error.is_stop() {
            Failure::Interrupted
        } else {
            Failure::bad(error)
        }
    })?;
    for warning in warnings::of(plan, &lamina) {
        eprintln!("warning: {warning}");
    }
    Ok(lamina)
}
