//! What veins are made from: one of several kinds of venation.

use crate::development::MainVeinStyle;
use crate::document::declared::{Declared, Kinds};
use crate::document::keys::{Keys, Variant};
use crate::transport::{FilledPlan, VeinStyle};
use crate::venation::arcuate::ArcuatePlan;
use crate::venation::plan::{AuxinPlan, Pattern};
use document::variant;

/// How the veins of a leaf come to be. Each kind goes with every contour, but that
/// [`VenationPlan::Cells`] needs the cells of a transport leaf, and
/// [`VenationPlan::Development`] a leaf that develops from its margin.
#[derive(Clone, Debug, PartialEq)]
#[allow(
    clippy::large_enum_variant,
    reason = "a leaf has one, and most are the largest"
)]
pub enum VenationPlan {
    /// They grow towards sources of auxin.
    Auxin(AuxinPlan),
    /// They are splines from the midrib to the margin.
    Arcuate(ArcuatePlan),
    /// They are the transport network that the contour was grown with.
    Cells(VeinStyle),
    /// They are the cheapest transport network that supplies the blade.
    Transport(FilledPlan),
    /// They are the main veins with which the contour developed.
    Development(MainVeinStyle),
}

impl Kinds for VenationPlan {
    const KINDS: &'static [Variant<Self>] = &[
        Variant {
            new: || AuxinPlan::default().into(),
            is: |plan| {
                let plan = plan.auxin();
                plan.is_some_and(|plan| matches!(plan.pattern, Pattern::Closed(_)))
            },
            ..variant!(
                "closed",
                Self::Auxin,
                Declared::declare,
                "Veins grow towards auxin and meet."
            )
        },
        Variant {
            new: || {
                let pattern = Pattern::Open;
                Self::Auxin(AuxinPlan {
                    pattern,
                    ..AuxinPlan::default()
                })
            },
            is: |plan| {
                let plan = plan.auxin();
                plan.is_some_and(|plan| plan.pattern == Pattern::Open)
            },
            ..variant!(
                "open",
                Self::Auxin,
                Declared::declare,
                "Veins grow towards auxin and never meet."
            )
        },
        variant!(
            "arcuate",
            Self::Arcuate,
            Declared::declare,
            "Veins are splines."
        ),
        variant!(
            "cells",
            Self::Cells,
            Declared::declare,
            "The network that the outline of a transport leaf was grown with."
        ),
        variant!(
            "transport",
            Self::Transport,
            Declared::declare,
            "The cheapest transport network that supplies the blade."
        ),
        variant!(
            "development",
            Self::Development,
            Declared::declare,
            "The main veins alone of a leaf that develops from its margin."
        ),
    ];
}

impl Declared for VenationPlan {
    fn declare(&mut self, keys: &mut Keys<'_>) {
        keys.kind(self, Self::KINDS);
    }

    fn kinds() -> Vec<&'static str> {
        Self::KINDS.iter().map(|kind| kind.name).collect()
    }
}

impl From<FilledPlan> for VenationPlan {
    fn from(plan: FilledPlan) -> Self {
        Self::Transport(plan)
    }
}

impl From<AuxinPlan> for VenationPlan {
    fn from(plan: AuxinPlan) -> Self {
        Self::Auxin(plan)
    }
}

impl From<ArcuatePlan> for VenationPlan {
    fn from(plan: ArcuatePlan) -> Self {
        Self::Arcuate(plan)
    }
}

impl VenationPlan {
    /// The plan of veins that grow towards auxin, if these do.
    pub fn auxin(&self) -> Option<&AuxinPlan> {
        match self {
            Self::Auxin(plan) => Some(plan),
            Self::Arcuate(_) | Self::Cells(_) | Self::Transport(_) | Self::Development(_) => None,
        }
    }

    /// The exponent of Murray's law that its veins keep to: the plan's own, or 2 (areas add up)
    /// where there is none.
    pub fn murray_exponent(&self) -> f64 {
        match self {
            Self::Auxin(plan) => plan.murray_exponent,
            Self::Development(style) => style.murray_exponent,
            Self::Arcuate(_) | Self::Cells(_) | Self::Transport(_) => 2.0,
        }
    }
}
