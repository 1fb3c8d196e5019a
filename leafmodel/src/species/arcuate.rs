//! Veins as splines: from pinnate to arcuate, and palmate (\[oslveins\]).
//!
//! The article gives its parameters and their defaults, but none for its pictures. All other
//! numbers here are by eye.

use super::green_leaf;
use crate::leaf::LeafPlan;
use crate::leaf::outline_plan::Contour;
use crate::shape::cubic_margin::CubicMargin;
use crate::venation::arcuate::{ArcuatePlan, PalmateVeins};
use crate::venation::plan::AuxinPlan;

/// A margin narrower than the article's default, which is as wide as it is long.
const ELLIPTIC: CubicMargin = CubicMargin {
    angle1_deg: 45.0,
    length1: 0.45,
    angle2_deg: 38.0,
    length2: 0.5,
};

/// Straight veins that end all along the margin.
const PINNATE: ArcuatePlan = ArcuatePlan {
    veins: 9,
    seed: 42,
    variation: 0.15,
    width: 0.008,
    net_width: 0.03,
    squish: 0.8,
    squish2: 0.9,
    squish3: 0.85,
    up: 0.52,
    tip_width: 0.25,
    palmate: None,
};

/// Veins that sweep along the margin to the tip.
const ARCUATE: ArcuatePlan = ArcuatePlan {
    veins: 5,
    squish: 0.25,
    squish2: 0.75,
    squish3: 0.65,
    up: 0.95,
    ..PINNATE
};

fn leaf(length_mm: f64, margin: CubicMargin, veins: ArcuatePlan) -> LeafPlan {
    let contour = Contour::Cubic(margin);
    // In contents and relief the thinnest vein is taken for the finest.
    let finest = AuxinPlan {
        veinlet_radius_mm: 0.02 * veins.width * length_mm,
        ..AuxinPlan::default()
    };
    LeafPlan {
        venation: veins.into(),
        ..green_leaf(length_mm, 1, contour.into(), finest)
    }
}

/// The leaf with all of the article's default values.
pub(super) fn defaults() -> LeafPlan {
    leaf(80.0, CubicMargin::default(), ArcuatePlan::default())
}

pub(super) fn pinnate() -> LeafPlan {
    leaf(90.0, ELLIPTIC, PINNATE)
}

pub(super) fn arcuate() -> LeafPlan {
    leaf(90.0, ELLIPTIC, ARCUATE)
}

/// The leaf between pinnate (share 0) and arcuate (share 1).
pub(super) fn between(share: f64) -> LeafPlan {
    let mix = |from: f64, to: f64| from + (to - from) * share;
    let (p, a) = (PINNATE, ARCUATE);
    let veins = ArcuatePlan {
        veins: mix(f64::from(p.veins), f64::from(a.veins)).round() as u32,
        squish: mix(p.squish, a.squish),
        squish2: mix(p.squish2, a.squish2),
        squish3: mix(p.squish3, a.squish3),
        up: mix(p.up, a.up),
        ..p
    };
    leaf(90.0, ELLIPTIC, veins)
}

/// Five primaries with laterals of their own.
pub(super) fn palmate() -> LeafPlan {
    let margin = CubicMargin {
        angle1_deg: 112.0,
        length1: 0.62,
        angle2_deg: 42.0,
        length2: 0.52,
    };
    let veins = ArcuatePlan {
        veins: 4,
        squish2: 0.8,
        squish3: 1.0,
        up: 0.4,
        palmate: Some(PalmateVeins {
            per_side: 2,
            spread: 0.85,
            bow: 0.1,
        }),
        ..PINNATE
    };
    leaf(80.0, margin, veins)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::leaf::Fields;

    /// Mean turn of laterals towards the tip from their first piece to their last, in radians, and
    /// the mean height of their ends, in leaf lengths.
    fn sweep(share: f64) -> (f64, f64) {
        let plan = between(share);
        let lamina = plan.grow_lamina().expect("a good plan");
        let fields = plan.fields(&lamina).expect("a good plan");
        let Some(Fields::Arcuate(veins)) = fields else {
            panic!("splines have fields");
        };
        let count = veins.laterals();
        let of = |i: usize| veins.lateral(i).expect("there are so many");
        let turn = |[a, b, c]: [glam::DVec2; 3]| (b - a).angle_to(c - b) * c.x.signum();
        let turns: f64 = (0..count).map(|i| turn(of(i))).sum();
        let ends: f64 = (0..count).map(|i| of(i)[2].y / plan.length_mm).sum();
        (turns / count as f64, ends / count as f64)
    }

    #[test]
    fn from_pinnate_to_arcuate_veins_bend_more_and_end_nearer_the_tip() {
        let steps: Vec<(f64, f64)> = (0..5).map(|i| sweep(f64::from(i) / 4.0)).collect();
        for pair in steps.windows(2) {
            assert!(pair[1].0 > pair[0].0 && pair[1].1 > pair[0].1, "{steps:?}");
        }
        assert_eq!((between(0.0), between(1.0)), (pinnate(), arcuate()));
    }
}
