//! How the leaves of species lie: undulation of their margin, drying, and their stalks.
//!
//! All of it is by eye. The figures of Runions et al. 2005 keep their blades: they only get a
//! petiole.

use crate::blade::petiole::{PetiolePlan, Section};
use crate::blade::stance::{Drying, MarginGrowth};
use crate::leaf::LeafPlan;

/// A preset's stalk and stance.
struct Lie {
    preset: &'static str,
    /// Length of the petiole over the blade's, and the angle, degrees, by which it is bent at its
    /// foot; nothing for a sessile leaf, and for one whose leaflets have stalks of their own.
    petiole: Option<[f64; 2]>,
    /// Excess growth at the margin, and its width over the leaf's length.
    margin: Option<[f64; 2]>,
    /// How dry it is; only litter lies on the ground.
    drying: Option<f64>,
    section: Section,
}

/// A petiole with a shallow groove, as most have.
const GROOVED: Section = Section {
    groove: 0.35,
    flatness: 0.0,
    foot: 0.5,
    head: 0.0,
};
/// Flattened from side to side, so that it flutters.
const FLATTENED: Section = Section {
    groove: 0.0,
    flatness: 0.55,
    foot: 0.4,
    head: 0.0,
};
/// Round, with a swollen foot.
const TERETE: Section = Section {
    groove: 0.1,
    flatness: 0.0,
    foot: 0.6,
    head: 0.2,
};

const fn lie(preset: &'static str, petiole: [f64; 2]) -> Lie {
    Lie {
        preset,
        petiole: Some(petiole),
        margin: None,
        drying: None,
        section: GROOVED,
    }
}

impl Lie {
    const fn undulate(mut self, excess: f64, width: f64) -> Self {
        self.margin = Some([excess, width]);
        self
    }

    const fn dry(mut self, share: f64) -> Self {
        self.drying = Some(share);
        self
    }

    const fn with(mut self, section: Section) -> Self {
        self.section = section;
        self
    }

    const fn sessile(preset: &'static str) -> Self {
        Self {
            petiole: None,
            ..lie(preset, [0.0; 2])
        }
    }
}

/// All of them, in the order of the book.
static LIES: &[Lie] = &[
    lie("poplar", [0.75, 25.0]).with(FLATTENED),
    lie("cottonwood", [0.85, 25.0])
        .with(FLATTENED)
        .undulate(0.03, 0.06),
    lie("maple", [0.9, 30.0]).with(TERETE).undulate(0.02, 0.04),
    lie("white-oak", [0.13, 20.0]).undulate(0.04, 0.05),
    lie("red-oak", [0.25, 20.0]).undulate(0.03, 0.05),
    lie("ginkgo", [0.9, 25.0]),
    lie("birch", [0.35, 20.0]).undulate(0.03, 0.05),
    lie("willow", [0.08, 15.0]).undulate(0.015, 0.03),
    lie("cherry", [0.15, 20.0]),
    lie("sweetgum", [0.85, 25.0]),
    lie("alchemilla", [1.4, 30.0]),
    lie("ginkgo-leaf", [0.9, 25.0]).undulate(0.03, 0.06),
    lie("cherry-leaf", [0.15, 20.0]).undulate(0.02, 0.05),
    lie("sweetgum-leaf", [0.85, 25.0]).undulate(0.02, 0.05),
    lie("alchemilla-leaf", [1.4, 30.0]).undulate(0.03, 0.05),
    Lie::sessile("orchid-leaf").undulate(0.02, 0.06),
    lie("ivy", [0.7, 30.0]).with(TERETE).undulate(0.02, 0.05),
    lie("magnolia", [0.12, 15.0])
        .with(TERETE)
        .undulate(0.015, 0.06),
    lie("croton", [0.2, 20.0]).with(TERETE).undulate(0.05, 0.05),
    lie("ginkgo-autumn", [0.9, 25.0]).undulate(0.03, 0.06),
    lie("birch-autumn", [0.35, 20.0]).dry(0.15),
    lie("poplar-autumn", [0.85, 25.0]).with(FLATTENED).dry(0.15),
    lie("sugar-maple-autumn", [0.8, 30.0])
        .with(TERETE)
        .dry(0.15),
    lie("red-maple-autumn", [0.8, 30.0]).with(TERETE).dry(0.15),
    lie("sweetgum-autumn", [0.85, 25.0]).dry(0.15),
    lie("oak-litter", [0.13, 20.0]).dry(1.0),
    lie("cotinus", [0.45, 20.0]).undulate(0.02, 0.05),
    Lie::sessile("acer-variegated").undulate(0.03, 0.05),
    lie("ivy-variegated", [0.7, 30.0])
        .with(TERETE)
        .undulate(0.02, 0.05),
    lie("croton-variegated", [0.2, 20.0])
        .with(TERETE)
        .undulate(0.05, 0.05),
    lie("amaranth", [0.45, 20.0]).undulate(0.05, 0.06),
];

/// Gives the plan of a preset its stalk and stance.
pub(super) fn apply(preset: &str, plan: &mut LeafPlan) {
    let Some(lie) = LIES.iter().find(|lie| lie.preset == preset) else {
        return;
    };
    if let Some([length, curl]) = lie.petiole {
        plan.petiole = Some(PetiolePlan {
            length,
            radius_mm: None,
            curl: curl.to_radians(),
            section: lie.section,
        });
    }
    plan.stance.margin_growth = lie
        .margin
        .map(|[excess, width]| MarginGrowth { excess, width });
    plan.stance.drying = lie.drying.map(|share| Drying {
        share,
        ..Drying::USUAL
    });
    plan.stance.on_ground = lie.drying == Some(1.0);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_is_a_preset_of_its_own_with_a_good_stance() {
        for (i, lie) in LIES.iter().enumerate() {
            let preset = super::super::find(lie.preset).expect(lie.preset);
            assert_eq!(preset.plan().stance.validate(), Ok(()));
            let again = LIES[..i].iter().any(|other| other.preset == lie.preset);
            assert!(!again, "{}", lie.preset);
        }
    }
}
