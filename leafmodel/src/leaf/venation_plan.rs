//! What veins are made from: one of several kinds of venation.

use crate::development::MainVeinStyle;
use crate::transport::{FilledPlan, VeinStyle};
use crate::venation::arcuate::ArcuatePlan;
use crate::venation::plan::AuxinPlan;

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
