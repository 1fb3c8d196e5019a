//! Contents of stalks.

use super::whole::WholeLeaf;
use crate::blade::vein_cover::VeinCover;
use crate::leaf::{Leaf, LeafError, LeafPlan};
use crate::optics::{Contents, PerConstituent};
use crate::venation::network::VeinSegment;

impl WholeLeaf {
    /// Contents of petiole and rachis, uniform along them: those of a fully developed vein at a
    /// blade's base. With a [`VeinBody`](crate::blade::vein_body::VeinBody) they are those of the
    /// wall of a tube, half of what light meets along the stalk's diameter. They age like the tissue there; stalks of a compound leaf age like the mean of
    /// its different blades.
    ///
    /// # Errors
    ///
    /// [`LeafError`] if the plan's ageing needs cells that this leaf, grown from another plan,
    /// lacks.
    pub fn stalk_contents(&self, plan: &LeafPlan) -> Result<Contents, LeafError> {
        let living = plan.tissue.lamina;
        let mut lamina = living;
        if plan.senescence.is_some() {
            let mut mean = PerConstituent::splat(0.0);
            for blade in &self.blades {
                let at_base =
                    withered(blade, plan, living)?.map(|value| value / self.blades.len() as f64);
                mean = mean.zip_with(at_base, |sum, value| sum + value);
            }
            lamina = Contents(mean);
        }
        let vein = VeinCover::of(1.0, 0.0);
        let Some(mut body) = plan.tissue.vein_body else {
            return Ok(plan.tissue.contents_of(lamina, vein, 0.0));
        };
        body.blade_mm = plan.form.thickness_mm;
        let excess = body.layers(0.0, self.stalk_radius_mm(plan));
        let whole = plan
            .tissue
            .contents_of(lamina, VeinCover { excess, ..vein }, 0.0);
        Ok(Contents(PerConstituent::from_fn(|constituent| {
            (0.5 * whole[constituent]).max(constituent.least())
        })))
    }

    /// Radius of the petiole, mm: the plan's, or that of the thickest vein.
    fn stalk_radius_mm(&self, plan: &LeafPlan) -> f64 {
        let own = plan.petiole.and_then(|petiole| petiole.radius_mm);
        let shared = plan.compound.as_ref().map(|form| form.stalk_radius_mm);
        own.or(shared).unwrap_or_else(|| {
            let veins = self
                .blades
                .iter()
                .flat_map(|blade| blade.lamina.network.segments());
            veins.fold(0.0, |most, vein| {
                vein.radius_from.max(vein.radius_to).max(most)
            })
        })
    }
}

/// Contents of the tissue between veins at the base of a blade.
fn withered(blade: &Leaf, plan: &LeafPlan, living: Contents) -> Result<Contents, LeafError> {
    let lamina = &blade.lamina;
    let veins: Vec<VeinSegment> = lamina.network.segments().collect();
    let withering = plan.withering(lamina, &lamina.place(&blade.frame, &veins))?;
    Ok(withering.map_or(living, |withering| {
        withering.contents(living, lamina.outline.base())
    }))
}
