//! From the plan of a leaf to its margin and veins.

use super::error::LeafError;
use super::lamina::Lamina;
use super::outline_plan::{GrownOutline, Origin};
use super::plan::LeafPlan;
use super::stages_kept::Stage;
use super::venation_plan::GrownVeins;
use crate::document::Declared;
use crate::grow_options::GrowOptions;
use crate::shape::outline::Outline;

impl LeafPlan {
    /// The margin alone.
    ///
    /// # Errors
    ///
    /// [`LeafError::Outline`].
    pub fn grow_outline(&self) -> Result<Outline, LeafError> {
        Ok(self.grown_outline()?.outline)
    }

    /// Margin and veins, grown with default [`GrowOptions`].
    ///
    /// # Errors
    ///
    /// [`LeafError`] of the outline or the veins.
    pub fn grow_lamina(&self) -> Result<Lamina, LeafError> {
        GrowOptions::default().lamina(self)
    }

    /// Whether margin and veins can be grown, as far as can be known without growing the veins.
    ///
    /// # Errors
    ///
    /// [`LeafError`] of the outline or the veins.
    pub fn check_lamina(&self) -> Result<(), LeafError> {
        let grown = self.grow_outline()?;
        let checked = self.venation.check(&self.outline, Some(&grown));
        checked.map_err(LeafError::Venation)
    }

    fn grown_outline(&self) -> Result<GrownOutline, LeafError> {
        let grown = self.outline.grow_with_origin(self.length_mm, self.seed);
        grown.map_err(LeafError::Outline)
    }
}

impl GrowOptions<'_> {
    /// Margin and veins of a plan, with any damage.
    ///
    /// # Errors
    ///
    /// [`LeafError`] of the outline, the veins or the damage; one that [is a stop](LeafError::is_stop).
    pub fn lamina(self, plan: &LeafPlan) -> Result<Lamina, LeafError> {
        if let Some(damage) = &plan.damage {
            damage.in_range().map_err(LeafError::Damage)?;
        }
        let part = plan.of_veins();
        let grown = part.grown_outline()?;
        let grow = || {
            let plan = &part;
            let veins = plan
                .venation
                .grow(&plan.outline, &grown, plan.length_mm, plan.seed, self);
            veins.map_err(LeafError::Venation)
        };
        // The cells that veins fill are part of the leaf and are not kept.
        let GrownVeins { network, filled } = if plan.has_cells() {
            grow()?
        } else {
            let network = || grow().map(|veins| veins.network);
            GrownVeins {
                network: Stage::Veins.take_or_make(self.kept, &part, network)?,
                filled: None,
            }
        };
        let (cells, developed) = match grown.origin {
            Origin::Curve => (None, None),
            Origin::Cells(leaf) => (Some(leaf), None),
            Origin::Developed(leaf) => (None, Some(leaf)),
        };
        let mut lamina = Lamina {
            outline: grown.outline,
            network,
            cells,
            developed,
            filled,
            wounds: None,
        };
        if let Some(damage) = &plan.damage {
            let (bitten, wounds) = damage.done_to(&lamina.outline, &mut lamina.network, plan.seed);
            lamina.outline = bitten;
            lamina.wounds = Some(wounds);
        }
        Ok(lamina)
    }
}
