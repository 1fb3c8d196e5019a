//! Leaves whose veins are splines.

use super::super::{PlanOf, Preset, arcuate};

pub(super) static SPLINES: &[Preset] = &[
    Preset {
        name: "arcuate-default",
        about: "every parameter of the article's shader at its default",
        source: "the article's defaults, outline too",
        row: None,
        plan: PlanOf::Function(arcuate::defaults),
    },
    Preset {
        name: "pinnate",
        about: "straight secondary veins all along the midrib, as splines",
        source: "by eye; the article prints no numbers for its pictures",
        row: None,
        plan: PlanOf::Function(arcuate::pinnate),
    },
    Preset {
        name: "pinnate-to-arcuate-1",
        about: "a quarter of the way from pinnate to arcuate",
        source: "by eye, even steps between `pinnate` and `arcuate`",
        row: None,
        plan: PlanOf::Function(|| arcuate::between(0.25)),
    },
    Preset {
        name: "pinnate-to-arcuate-2",
        about: "half of the way from pinnate to arcuate",
        source: "by eye, even steps between `pinnate` and `arcuate`",
        row: None,
        plan: PlanOf::Function(|| arcuate::between(0.5)),
    },
    Preset {
        name: "pinnate-to-arcuate-3",
        about: "three quarters of the way from pinnate to arcuate",
        source: "by eye, even steps between `pinnate` and `arcuate`",
        row: None,
        plan: PlanOf::Function(|| arcuate::between(0.75)),
    },
    Preset {
        name: "arcuate",
        about: "secondary veins that sweep along the margin to the tip, as in dogwood or plantain",
        source: "by eye; the article prints no numbers for its pictures",
        row: None,
        plan: PlanOf::Function(arcuate::arcuate),
    },
    Preset {
        name: "palmate-splines",
        about: "five primaries from the petiole, each with laterals: what the article wishes for",
        source: "by eye",
        row: None,
        plan: PlanOf::Function(arcuate::palmate),
    },
];
