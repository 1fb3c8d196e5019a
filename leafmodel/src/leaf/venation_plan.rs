//! What veins are made from: one of several kinds of venation, and what depends on the kind.

use document::variant;

use super::error::LeafError;
use super::outline_plan::{Contour, GrownOutline, Origin, OutlinePlan};
use crate::development::MainVeinStyle;
use crate::document::{Declared, Keys, Kinds, Variant};
use crate::grow_options::GrowOptions;
use crate::not_grown::NotGrown;
use crate::shape::outline::Outline;
use crate::transport::{FilledBlade, FilledPlan, VeinStyle};
use crate::venation::arcuate::ArcuatePlan;
use crate::venation::network::VenationNetwork;
use crate::venation::plan::{AuxinPlan, Pattern};
use crate::venation::{self, VeinGrowth};

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

/// Veins that have grown.
pub(super) struct GrownVeins {
    pub(super) network: VenationNetwork,
    /// The cells that they supply, if they are the cheapest network that fills the blade.
    pub(super) filled: Option<FilledBlade>,
}

/// What a leaf grows by from step to step.
pub(super) enum Growing<'a> {
    /// Veins that grow towards auxin.
    Auxin(&'a AuxinPlan),
    /// The cells with which the contour grows.
    Cells(VeinStyle),
    /// The margin, and the main veins with it.
    Developed(MainVeinStyle),
    /// Main veins with the margin, then finer ones on the blade that has developed.
    DevelopedThenAuxin(&'a AuxinPlan),
    /// The revenue of cells on a margin that is there from the start.
    Filled(VeinStyle),
}

impl VenationPlan {
    /// Whether the veins can grow, as far as can be known without growing them; without the
    /// `grown` outline only whether they go with this kind of contour.
    pub(crate) fn check(
        &self,
        plan: &OutlinePlan,
        grown: Option<&Outline>,
    ) -> Result<(), NotGrown> {
        match self {
            Self::Auxin(veins) => grown.map_or(Ok(()), |outline| venation::check(outline, veins)),
            Self::Arcuate(veins) => Ok(veins.in_range()?),
            Self::Cells(style) => {
                style.in_range()?;
                let is_there = matches!(plan.contour, Contour::Transport(_));
                is_there.then_some(()).ok_or_else(|| {
                    let problem = "the outline has no cells: it is not that of a transport leaf";
                    let help = "write [leaves.NAME.outline.transport], or choose another venation";
                    NotGrown::because(problem).mend("venation.cells", help)
                })
            }
            Self::Transport(veins) => grown.map_or(Ok(()), |outline| {
                let checked = veins.check(outline);
                checked.map_err(|error| error.within("venation.transport"))
            }),
            Self::Development(style) => {
                style.in_range()?;
                let is_there = matches!(plan.contour, Contour::Development(_));
                is_there.then_some(()).ok_or_else(|| {
                    let problem =
                        "the outline has no main veins: it does not develop from its margin";
                    let help =
                        "write [leaves.NAME.outline.development], or choose another venation";
                    NotGrown::because(problem).mend("venation.development", help)
                })
            }
        }
    }

    /// Grows the veins within an outline that `plan` has brought forth.
    pub(super) fn grow(
        &self,
        plan: &OutlinePlan,
        grown: &GrownOutline,
        length_mm: f64,
        seed: u64,
        options: GrowOptions<'_>,
    ) -> Result<GrownVeins, NotGrown> {
        let GrownOutline { outline, origin } = grown;
        let network = match self {
            Self::Auxin(veins) => {
                let main = match origin {
                    Origin::Developed(leaf) => {
                        Some(leaf.network(length_mm, MainVeinStyle::default())?)
                    }
                    Origin::Curve | Origin::Cells(_) => None,
                };
                VeinGrowth {
                    main: main.as_ref(),
                    is_stopped: options.is_stopped,
                    ..VeinGrowth::new(outline, veins, seed)
                }
                .network()?
            }
            Self::Arcuate(veins) => match plan.plain_cubic() {
                Some(margin) => veins.network_within(margin, length_mm),
                None => veins.network(outline),
            }?,
            Self::Cells(style) => match origin {
                Origin::Cells(cells) => cells.network(length_mm, *style)?,
                Origin::Curve | Origin::Developed(_) => {
                    let problem = "veins of the cells need the outline of a transport leaf";
                    return Err(NotGrown::because(problem));
                }
            },
            Self::Transport(veins) => {
                let blade = veins.fill(outline)?;
                return Ok(GrownVeins {
                    network: blade.network(outline, veins.style)?,
                    filled: Some(blade),
                });
            }
            Self::Development(style) => match origin {
                Origin::Developed(leaf) => leaf.network(length_mm, *style)?,
                Origin::Curve | Origin::Cells(_) => {
                    let problem =
                        "main veins that develop need the outline of a leaf that develops";
                    return Err(NotGrown::because(problem));
                }
            },
        };
        let filled = None;
        Ok(GrownVeins { network, filled })
    }

    /// What the leaf grows by from step to step, or why there are no steps.
    pub(super) fn growing(&self, plan: &OutlinePlan) -> Result<Growing<'_>, LeafError> {
        let develops = matches!(plan.contour, Contour::Development(_));
        match self {
            Self::Auxin(veins) if develops && plan.is_contour() => {
                Ok(Growing::DevelopedThenAuxin(veins))
            }
            Self::Auxin(veins) => Ok(Growing::Auxin(veins)),
            Self::Arcuate(_) => Err(LeafError::NoStages("arcuate veins are there all at once")),
            Self::Cells(style) if plan.is_contour() => Ok(Growing::Cells(*style)),
            Self::Cells(_) => Err(LeafError::NoStages(
                "teeth belong to the full-grown margin of a transport leaf",
            )),
            Self::Transport(veins) => Ok(Growing::Filled(veins.style)),
            Self::Development(style) if plan.is_contour() => Ok(Growing::Developed(*style)),
            Self::Development(_) => Err(LeafError::NoStages(
                "teeth belong to the full-grown margin of a leaf that develops",
            )),
        }
    }

    /// The plan of veins that grow towards auxin, if these do.
    pub fn auxin(&self) -> Option<&AuxinPlan> {
        if let Self::Auxin(plan) = self {
            Some(plan)
        } else {
            None
        }
    }

    /// The plan of veins that are splines, if these are.
    pub fn arcuate(&self) -> Option<&ArcuatePlan> {
        if let Self::Arcuate(plan) = self {
            Some(plan)
        } else {
            None
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

    /// The key that decides how wide the widest vein is.
    pub fn width_key(&self) -> &'static str {
        match self {
            Self::Auxin(_) => "veinlet_radius_mm",
            Self::Cells(_) | Self::Transport(_) | Self::Development(_) => "base_radius_mm",
            Self::Arcuate(_) => "width",
        }
    }

    /// What lets veins appear on a blade where none has grown.
    pub fn advice_without_veins(&self) -> &'static str {
        match self {
            Self::Auxin(_) => "more darts or smaller birth distances let sources appear",
            Self::Cells(_) | Self::Transport(_) => {
                "a smaller least_cells lets thinner veins appear"
            }
            Self::Development(_) | Self::Arcuate(_) => {
                "they go from base to apex as far as there is blade: move base or apex"
            }
        }
    }
}
