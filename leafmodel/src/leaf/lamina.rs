//! The flat leaf: margin and veins, and the cells of a transport leaf.

use glam::DVec2;

use super::damage::Wounds;
use super::outline_plan::Origin;
use super::{LeafError, LeafPlan};
use crate::development::{DevelopedLeaf, MainVeinStyle};
use crate::document::declared::Declared;
use crate::leaf::venation_plan::VenationPlan;
use crate::shape::outline::Outline;
use crate::transport::{FilledBlade, TransportLeaf};
use crate::venation::network::VenationNetwork;
use crate::venation::{self, grow_around};

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
    /// The leaf that has developed from this margin, if it did.
    pub developed: Option<DevelopedLeaf>,
    /// The cells that its veins supply, if they are the cheapest network that fills the margin.
    pub filled: Option<FilledBlade>,
    /// What damage has left of it, if there is any.
    pub wounds: Option<Wounds>,
}

impl LeafPlan {
    /// The margin alone.
    ///
    /// # Errors
    ///
    /// [`LeafError::Outline`].
    pub fn grow_outline(&self) -> Result<Outline, LeafError> {
        self.outline
            .grow(self.length_mm, self.seed)
            .map_err(LeafError::Outline)
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
        let grown = self.outline.grow_with_origin(self.length_mm, self.seed);
        let (outline, origin) = grown.map_err(LeafError::Outline)?;
        match &self.venation {
            VenationPlan::Auxin(plan) => venation::check(&outline, plan)?,
            VenationPlan::Arcuate(plan) => plan.validate()?,
            VenationPlan::Cells(style) => {
                style.in_range()?;
                origin.cells().ok_or(LeafError::NoCells)?;
            }
            VenationPlan::Transport(plan) => plan.check(&outline).map_err(LeafError::Cells)?,
            VenationPlan::Development(style) => {
                style.in_range()?;
                origin.developed().ok_or(LeafError::NotDeveloped)?;
            }
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
        if let Some(damage) = &self.damage {
            damage.in_range().map_err(LeafError::Damage)?;
        }
        let grown = self.outline.grow_with_origin(self.length_mm, self.seed);
        let (outline, origin) = grown.map_err(LeafError::Outline)?;
        let mut filled = None;
        let network = match &self.venation {
            VenationPlan::Auxin(plan) => {
                let of_leaf =
                    |leaf: &DevelopedLeaf| leaf.network(self.length_mm, MainVeinStyle::default());
                let main = origin
                    .developed()
                    .map(of_leaf)
                    .transpose()
                    .map_err(LeafError::Cells)?;
                grow_around(&outline, plan, main.as_ref(), self.seed, is_stopped)?
            }
            VenationPlan::Arcuate(plan) => match self.outline.plain_cubic() {
                Some(margin) => plan.network_within(margin, self.length_mm)?,
                None => plan.network(&outline)?,
            },
            VenationPlan::Cells(style) => {
                let Origin::Cells(cells) = &origin else {
                    return Err(LeafError::NoCells);
                };
                cells
                    .network(self.length_mm, *style)
                    .map_err(LeafError::Cells)?
            }
            VenationPlan::Transport(plan) => {
                let blade = plan.fill(&outline).map_err(LeafError::Cells)?;
                let network = blade
                    .network(&outline, plan.style)
                    .map_err(LeafError::Cells)?;
                filled = Some(blade);
                network
            }
            VenationPlan::Development(style) => {
                let leaf = origin.developed().ok_or(LeafError::NotDeveloped)?;
                leaf.network(self.length_mm, *style)
                    .map_err(LeafError::Cells)?
            }
        };
        let mut lamina = Lamina {
            outline,
            network,
            developed: origin.developed().cloned(),
            cells: origin.cells(),
            filled,
            wounds: None,
        };
        if let Some(damage) = &self.damage {
            let (bitten, wounds) = damage.done_to(&lamina.outline, &mut lamina.network, self.seed);
            lamina.outline = bitten;
            lamina.wounds = Some(wounds);
        }
        Ok(lamina)
    }
}

impl Lamina {
    /// The margin before any damage: what texture coordinates and patterns are measured from.
    pub fn intact(&self) -> &Outline {
        let wounds = self.wounds.as_ref();
        wounds.map_or(&self.outline, |wounds| &wounds.intact)
    }

    /// The margins of its holes, mm.
    pub fn holes(&self) -> &[Vec<DVec2>] {
        self.wounds.as_ref().map_or(&[], |wounds| &wounds.holes)
    }

    /// Area of the blade without its holes, mm².
    pub fn area(&self) -> f64 {
        let wounds = self.wounds.as_ref();
        self.outline.area() - wounds.map_or(0.0, Wounds::holes_area)
    }
}
