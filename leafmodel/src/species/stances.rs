//! How the leaves of species lie: undulation of their margin, folds, drying, and their stalks.
//!
//! All of it is by eye. The figures of Runions et al. 2005 keep their blades: they only get a
//! petiole.

use crate::blade::petiole::{Course, PetiolePlan, Section};
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
    /// Slope, degrees, of folds along its secondary veins.
    pleat: f64,
    /// Degrees: sag, neck, sway, twist and how far these stray from leaf to leaf.
    course: [f64; 5],
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
        pleat: 0.0,
        course: [0.0; 5],
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

    const fn pleated(mut self, slope: f64) -> Self {
        self.pleat = slope;
        self
    }

    /// See [`Lie::course`].
    const fn runs(mut self, course: [f64; 5]) -> Self {
        self.course = course;
        self
    }

    const fn sessile(preset: &'static str) -> Self {
        Self {
            petiole: None,
            ..lie(preset, [0.0; 2])
        }
    }
}

impl Lie {
    fn course_plan(&self) -> Course {
        let [sag, neck, sway, twist, stray] = self.course.map(f64::to_radians);
        Course {
            sag,
            neck,
            sway,
            twist,
            stray,
            ..Course::STRAIGHT
        }
    }
}

/// All of them, in the order of the book.
static LIES: &[Lie] = &[
    lie("poplar", [0.75, 25.0])
        .runs([12.0, -15.0, 8.0, 20.0, 7.0])
        .with(FLATTENED),
    lie("cottonwood", [0.85, 25.0])
        .runs([18.0, -20.0, -10.0, 25.0, 8.0])
        .with(FLATTENED)
        .undulate(0.03, 0.06),
    lie("aspen", [0.95, 22.0])
        .runs([14.0, -12.0, 9.0, 30.0, 8.0])
        .with(FLATTENED)
        .undulate(0.02, 0.05),
    lie("maple", [0.9, 30.0])
        .runs([20.0, 25.0, 10.0, 12.0, 8.0])
        .with(TERETE)
        .undulate(0.02, 0.04),
    lie("white-oak", [0.13, 20.0])
        .runs([4.0, 8.0, 5.0, 6.0, 4.0])
        .pleated(4.0)
        .undulate(0.04, 0.05),
    lie("red-oak", [0.25, 20.0])
        .runs([8.0, 10.0, -7.0, 8.0, 5.0])
        .pleated(4.0)
        .undulate(0.03, 0.05),
    lie("ginkgo", [0.9, 25.0]).runs([22.0, -12.0, 12.0, 15.0, 8.0]),
    lie("birch", [0.35, 20.0])
        .runs([10.0, 15.0, -8.0, 10.0, 6.0])
        .pleated(9.0)
        .undulate(0.03, 0.05),
    lie("willow", [0.05, 15.0])
        .runs([3.0, 6.0, -3.0, 10.0, 4.0])
        .undulate(0.015, 0.03),
    lie("cherry", [0.1, 20.0]).runs([9.0, 10.0, 6.0, 8.0, 5.0]),
    lie("sweetgum", [0.85, 25.0]).runs([24.0, 18.0, -10.0, 14.0, 8.0]),
    lie("alchemilla", [1.4, 30.0]).runs([30.0, -20.0, 14.0, 10.0, 9.0]),
    lie("ginkgo-leaf", [0.9, 25.0])
        .runs([22.0, -12.0, 12.0, 15.0, 8.0])
        .undulate(0.03, 0.06),
    lie("cherry-leaf", [0.1, 20.0])
        .runs([9.0, 10.0, 6.0, 8.0, 5.0])
        .undulate(0.02, 0.05),
    lie("sweetgum-leaf", [0.85, 25.0])
        .runs([24.0, 18.0, -10.0, 14.0, 8.0])
        .undulate(0.02, 0.05),
    lie("alchemilla-leaf", [2.3, 30.0])
        .runs([30.0, -20.0, 14.0, 10.0, 9.0])
        .pleated(16.0)
        .undulate(0.03, 0.05),
    Lie::sessile("orchid-leaf").undulate(0.02, 0.06),
    lie("ivy", [0.7, 30.0])
        .runs([14.0, 30.0, -16.0, 30.0, 9.0])
        .with(TERETE)
        .undulate(0.02, 0.05),
    lie("magnolia", [0.12, 15.0])
        .runs([5.0, 8.0, 3.0, 4.0, 3.0])
        .with(TERETE)
        .undulate(0.015, 0.06),
    lie("croton", [0.15, 20.0])
        .runs([8.0, 12.0, -5.0, 8.0, 4.0])
        .with(TERETE)
        .undulate(0.05, 0.05),
    lie("ginkgo-autumn", [0.9, 25.0])
        .runs([26.0, -18.0, 16.0, 20.0, 9.0])
        .undulate(0.03, 0.06),
    lie("birch-autumn", [0.35, 20.0])
        .runs([14.0, 18.0, -12.0, 14.0, 8.0])
        .pleated(6.0)
        .dry(0.15),
    lie("poplar-autumn", [0.85, 25.0])
        .runs([18.0, -22.0, 14.0, 30.0, 9.0])
        .with(FLATTENED)
        .dry(0.15),
    lie("sugar-maple-autumn", [0.8, 30.0])
        .runs([26.0, -18.0, 22.0, 24.0, 10.0])
        .with(TERETE)
        .dry(0.15),
    lie("red-maple-autumn", [0.8, 30.0])
        .runs([22.0, -24.0, -20.0, 22.0, 10.0])
        .with(TERETE)
        .dry(0.15),
    lie("sweetgum-autumn", [0.85, 25.0])
        .runs([28.0, -16.0, 18.0, 20.0, 10.0])
        .dry(0.15),
    lie("oak-litter", [0.13, 20.0])
        .runs([10.0, -14.0, 16.0, 22.0, 8.0])
        .dry(1.0),
    lie("cotinus", [0.45, 20.0])
        .runs([12.0, 14.0, 7.0, 9.0, 6.0])
        .undulate(0.02, 0.05),
    Lie::sessile("acer-variegated").undulate(0.03, 0.05),
    lie("ivy-variegated", [0.7, 30.0])
        .runs([16.0, 26.0, 14.0, -28.0, 9.0])
        .with(TERETE)
        .undulate(0.02, 0.05),
    lie("croton-variegated", [0.15, 20.0])
        .runs([9.0, 10.0, 6.0, -9.0, 4.0])
        .with(TERETE)
        .undulate(0.05, 0.05),
    lie("amaranth", [0.45, 20.0])
        .runs([14.0, 12.0, 8.0, 6.0, 6.0])
        .undulate(0.05, 0.06),
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
            course: lie.course_plan(),
            section: lie.section,
        });
    }
    if lie.pleat > 0.0 {
        plan.form.pleat = lie.pleat.to_radians();
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
