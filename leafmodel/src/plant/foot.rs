//! How a leaf is held: the foot of its petiole in the leaf's own frame.

use glam::{DMat3, DVec3};

use crate::leaf::LeafPlan;
use crate::leaf::outline_plan::Contour;
use crate::not_grown::NotGrown;
use crate::shape::specimen::BaseShape;

/// The foot of a leaf's petiole, in the leaf's frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Foot {
    /// Its place, mm.
    pub at: DVec3,
    /// Directions across the petiole, along it towards the blade, and to its adaxial side.
    pub frame: DMat3,
    /// Length of the blade, mm.
    pub length_mm: f64,
    /// The blade as a coarse sheet, which others keep clear of: rows from its base to its tip of
    /// places on its left margin, its midrib and its right margin, mm. Empty for a blade in
    /// nobody's way.
    pub blade: Vec<[DVec3; 3]>,
}

/// What to do about a leaf that no plant bears.
pub(super) const ANOTHER: &str = "let it bear another leaf";

/// Places of a blade, across it and along it, over its length: base, tip, sides.
const PLACES: [[f64; 2]; 8] = [
    [0.0, 0.0],
    [0.0, 1.0],
    [0.5, 0.4],
    [-0.5, 0.4],
    [0.4, -0.1],
    [-0.4, -0.1],
    [0.3, 0.75],
    [-0.3, 0.75],
];

/// Rows of a coarse sheet.
const ROWS: usize = 8;

impl Foot {
    /// Places of the flat blade, about as wide as it is long, from the petiole's foot, mm.
    pub(super) fn reach(&self) -> [DVec3; 8] {
        PLACES.map(|[x, y]| DVec3::new(x, y, 0.0) * self.length_mm - self.at)
    }

    /// The foot of the leaf of this plan.
    ///
    /// # Errors
    ///
    /// [`NotGrown`], naming what it is in the leaf that no plant can bear.
    pub fn of(plan: &LeafPlan) -> Result<Self, NotGrown> {
        let is_peltate = matches!(plan.outline.specimen.base, Some(BaseShape::Peltate { .. }));
        let problems = [
            (
                plan.stance.on_ground,
                "a leaf that rests on the ground is borne by no plant",
            ),
            // By how much it sags is known only when it has grown.
            (
                plan.stance.wilting.is_some(),
                "where the petiole of a wilting leaf ends is known only when it has grown",
            ),
            (
                is_peltate,
                "the petiole of a peltate leaf stands on its blade: no plant can bear that yet",
            ),
        ];
        if let Some((_, problem)) = problems.iter().find(|(is_so, _)| *is_so) {
            return Err(NotGrown::because(problem).mend("leaf", ANOTHER));
        }
        // A compound leaf has the foot of its petiole at the origin.
        let held = plan.petiole.filter(|_| plan.compound.is_none());
        let (at, frame) = held.map_or((DVec3::ZERO, DMat3::IDENTITY), |petiole| {
            petiole.foot(plan.length_mm, plan.seed)
        });
        Ok(Self {
            at,
            frame,
            length_mm: plan.length_mm,
            blade: coarse(plan),
        })
    }
}

/// The coarse sheet of a leaf's blade as its form has it. Empty for a compound leaf, for a margin
/// that only grows with the veins, and for one that cannot be grown.
fn coarse(plan: &LeafPlan) -> Vec<[DVec3; 3]> {
    let with_veins = matches!(
        plan.outline.contour,
        Contour::Transport(_) | Contour::Development(_)
    );
    if plan.compound.is_some() || with_veins {
        return Vec::new();
    }
    let outline = plan.grow_outline();
    outline.map_or_else(|_| Vec::new(), |outline| plan.form.rows(&outline, ROWS))
}
