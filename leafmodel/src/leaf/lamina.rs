//! The flat leaf: margin and veins, and the cells of a transport leaf.

use super::{LeafError, LeafPlan};
use crate::leaf::venation_plan::VenationPlan;
use crate::shape::outline::Outline;
use crate::transport::{FilledBlade, TransportLeaf};
use crate::venation::network::VenationNetwork;
use crate::venation::{self, grow_unless};

/// A leaf before it is bent. Lengths are millimetres; the base is the origin, the midrib goes along
/// +y.
#[derive(Clone, Debug, PartialEq)]
pub struct Lamina {
    /// The margin.
    pub outline: Outline,
    /// The veins.
    pub network: VenationNetwork,
    /// The transport leaf whose margin this is, if it is one.
    pub cells: Option<TransportLeaf>,
    /// The cells that its veins supply, if they are the cheapest network that fills the margin.
    pub filled: Option<FilledBlade>,
}

impl LeafPlan {
    /// The margin alone.
    ///
    /// # Errors
    ///
    /// [`LeafError::Outline`].
    pub fn grow_outline(&self) -> Result<Outline, LeafError> {
        Ok(self.outline.grow(self.length_mm, self.seed)?)
    }

    /// Margin and veins.
    ///
    /// # Errors
    ///
    /// [`LeafError`] of the outline or the veins.
    pub fn grow_lamina(&self) -> Result<Lamina, LeafError> {
        self.grow_lamina_unless(&|| false)
    }

    /// Whether margin and veins can be grown, as far as can be told without growing the veins.
    ///
    /// # Errors
    ///
    /// [`LeafError`] of the outline or the veins.
    pub fn check_lamina(&self) -> Result<(), LeafError> {
        let (outline, cells) = self.outline.grow_with_cells(self.length_mm, self.seed)?;
        match &self.venation {
            VenationPlan::Auxin(plan) => venation::check(&outline, plan)?,
            VenationPlan::Arcuate(plan) => plan.validate()?,
            VenationPlan::Cells(style) => {
                style.validate()?;
                cells.ok_or(LeafError::NoCells)?;
            }
            VenationPlan::Transport(plan) => plan.check(&outline)?,
        }
        Ok(())
    }

    /// As [`LeafPlan::grow_lamina`], but gives up when `is_stopped` says so.
    ///
    /// # Errors
    ///
    /// As [`LeafPlan::grow_lamina`], and
    /// [`VenationError::Stopped`](crate::venation::VenationError::Stopped).
    pub fn grow_lamina_unless(&self, is_stopped: &dyn Fn() -> bool) -> Result<Lamina, LeafError> {
        let (outline, cells) = self.outline.grow_with_cells(self.length_mm, self.seed)?;
        let mut filled = None;
        let network = match &self.venation {
            VenationPlan::Auxin(plan) => grow_unless(&outline, plan, self.seed, is_stopped)?,
            VenationPlan::Arcuate(plan) => match self.outline.plain_cubic() {
                Some(margin) => plan.network_within(margin, self.length_mm)?,
                None => plan.network(&outline)?,
            },
            VenationPlan::Cells(style) => {
                let cells = cells.as_ref().ok_or(LeafError::NoCells)?;
                cells.network(self.length_mm, *style)?
            }
            VenationPlan::Transport(plan) => {
                let blade = plan.fill(&outline)?;
                let network = blade.network(&outline, plan.style)?;
                filled = Some(blade);
                network
            }
        };
        Ok(Lamina {
            outline,
            network,
            cells,
            filled,
        })
    }
}
