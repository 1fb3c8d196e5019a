//! Fields over the lamina: what splines and cells tell about points, for textures.

use glam::DVec2;

use super::error::LeafError;
use super::lamina::Lamina;
use super::plan::LeafPlan;
use crate::transport::DeathField;
use crate::venation::arcuate::ArcuateVeins;

/// Numbers at every point of the plane.
#[derive(Clone, Debug)]
pub enum Fields {
    /// `Vein`, `Net` and `Fac` of veins that are splines: 0 or 1, 0 or 1, and 0 to 1.
    Arcuate(ArcuateVeins),
    /// `death`: at which share of the full-grown leaf's revenue the cells there die as it falls, 1
    /// first, 0 last.
    Deaths(DeathField),
}

impl LeafPlan {
    /// The fields of a lamina that this plan has brought forth, if its veins or its margin have
    /// any.
    ///
    /// # Errors
    ///
    /// As [`LeafPlan::grow_lamina`].
    pub fn fields(&self, lamina: &Lamina) -> Result<Option<Fields>, LeafError> {
        let Some(veins) = self.venation.arcuate() else {
            return Ok(self.death_field(lamina)?.map(Fields::Deaths));
        };
        let veins = match self.outline.plain_cubic() {
            Some(margin) => veins.veins_within(margin, self.length_mm),
            None => veins.veins_on(lamina.intact()),
        };
        let veins = veins.map_err(LeafError::Venation)?;
        Ok(Some(Fields::Arcuate(veins)))
    }

    /// Whether its laminas have fields, as far as can be known before they grow.
    pub fn has_fields(&self) -> bool {
        self.venation.arcuate().is_some() || self.has_cells()
    }

    /// Where the cells of a lamina die first, if it has any; those that its veins supply come
    /// before those of its margin.
    pub(super) fn death_field(&self, lamina: &Lamina) -> Result<Option<DeathField>, LeafError> {
        Ok(match (&lamina.filled, &lamina.cells) {
            (Some(blade), _) => Some(blade.death_field()),
            (None, Some(leaf)) => Some(
                leaf.death_field(self.length_mm)
                    .map_err(LeafError::Venation)?,
            ),
            (None, None) => None,
        })
    }
}

impl Fields {
    /// Their names.
    pub fn names(&self) -> &'static [&'static str] {
        match self {
            Self::Arcuate(_) => &["vein", "net", "fac"],
            Self::Deaths(_) => &["death"],
        }
    }

    /// Their values at a point (mm), in the order of [`Fields::names`], as many as there are names.
    pub fn at(&self, point: DVec2, values: &mut Vec<f64>) {
        values.clear();
        match self {
            Self::Arcuate(veins) => {
                let fields = veins.fields_at(point);
                let flag = |is: bool| if is { 1.0 } else { 0.0 };
                values.extend([flag(fields.vein), flag(fields.net), fields.fac]);
            }
            Self::Deaths(field) => values.push(field.at(point)),
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use crate::species::find;

    #[test]
    fn fields_of_splines_are_those_of_the_veins_in_the_net() {
        let plan = find("arcuate").expect("a preset").plan();
        let lamina = plan.grow_lamina().expect("a good plan");
        let fields = plan.fields(&lamina).expect("a good plan");
        let fields = fields.expect("splines have them");
        let mut values = Vec::new();
        for segment in lamina.network.segments() {
            let middle = segment.from.lerp(segment.to, 0.5);
            fields.at(middle, &mut values);
            assert_eq!(values[1], 1.0, "near a vein at {middle}");
            // Chords lie within a hundredth of a millimetre of their splines, and finest ends are
            // thinner. Where a lateral leaves the midrib, it is the midrib's height that counts.
            if segment.radius_from > 0.05 && segment.radius_to > 0.05 {
                assert!(values[0] == 1.0 && values[2] > 0.0, "{middle}: {values:?}");
            }
        }
        fields.at(DVec2::new(0.0, 0.5 * plan.length_mm), &mut values);
        assert_eq!(values, [1.0, 1.0, 1.0], "on the midrib");
        let poplar = find("poplar").expect("a preset").plan();
        assert!(poplar.fields(&lamina).expect("none").is_none());
    }
}
