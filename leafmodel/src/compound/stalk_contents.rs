//! What stalks hold.

use super::WholeLeaf;
use crate::blade::senescence::{AgeSource, Senescence, Withering};
use crate::blade::vein_field::VeinCover;
use crate::leaf::{Leaf, LeafError, LeafPlan};
use crate::optics::Contents;

impl WholeLeaf {
    /// What petiole and rachis hold, the same everywhere: what a fully developed vein at a blade's base does. They age as the tissue
    /// there, those of a compound leaf as the mean of its different blades.
    ///
    /// # Errors
    ///
    /// [`LeafError`] if the leaf is not of this plan and its cells earn nothing.
    pub fn stalk_contents(&self, plan: &LeafPlan) -> Result<Contents, LeafError> {
        let living = plan.tissue.lamina;
        let mut lamina = living.to_array();
        if let Some(senescence) = &plan.senescence {
            lamina = [0.0; Contents::COUNT];
            for blade in &self.blades {
                let at_base = withered(blade, plan.length_mm, senescence, living)?.to_array();
                for (sum, value) in lamina.iter_mut().zip(at_base) {
                    *sum += value / self.blades.len() as f64;
                }
            }
        }
        let vein = VeinCover {
            weight: 1.0,
            excess: 0.0,
        };
        let lamina = Contents::from_array(lamina);
        Ok(plan.tissue.contents_of(lamina, vein, 0.0))
    }
}

/// What the tissue at the base of a blade holds between veins.
fn withered(
    blade: &Leaf,
    length_mm: f64,
    senescence: &Senescence,
    living: Contents,
) -> Result<Contents, LeafError> {
    let Senescence {
        source: AgeSource::Revenue { share },
        blend,
        contents,
    } = *senescence;
    let lamina = &blade.lamina;
    // As for the blade itself: the cells that its veins supply decide before those of its margin.
    let field = match (&lamina.filled, &lamina.cells) {
        (Some(filled), _) => filled.death_field(),
        (None, Some(cells)) => cells.death_field(length_mm)?,
        (None, None) => return Err(LeafError::NoRevenue),
    };
    let withering = Withering::by_revenue(field, share, blend, contents);
    Ok(withering.contents(living, lamina.outline.base()))
}
