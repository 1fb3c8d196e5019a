//! Whether the numbers of a plant are in range, and fit together.

use std::f64::consts::PI;

use super::{Climbing, PlantError, PlantPlan};

impl PlantPlan {
    /// Checks every number.
    ///
    /// # Errors
    ///
    /// [`PlantError::OutOfRange`] for the first field out of range, [`PlantError::NoRoom`].
    pub fn validate(&self) -> Result<(), PlantError> {
        let (axis, posture) = (&self.axis, &self.posture);
        let within = |field, value: f64, [least, most]: [f64; 2], range| {
            let is_good = (least..=most).contains(&value);
            is_good.then_some(()).ok_or(PlantError::OutOfRange {
                field,
                value,
                range,
            })
        };
        let each = |field, values: &[f64], limits, range| {
            values
                .iter()
                .try_for_each(|&value| within(field, value, limits, range))
        };
        let many = f64::from(self.individuals);
        within("individuals", many, [1.0, 1000.0], "1 to 1000")?;
        within("length_mm", axis.length_mm, [1.0, 1e5], "1 to 100000")?;
        within("nodes", f64::from(axis.nodes), [1.0, 1000.0], "1 to 1000")?;
        within("bare", axis.bare, [0.0, 0.99], "0 to 0.99")?;
        within("shortening", axis.shortening, [0.5, 1.5], "0.5 to 1.5")?;
        each("radius_mm", &axis.radius_mm, [0.05, 1000.0], "0.05 to 1000")?;
        within("swelling", axis.swelling, [0.0, 1.0], "0 to 1")?;
        let leaves = axis.phyllotaxis;
        within(
            "per_node",
            f64::from(leaves.per_node),
            [1.0, 12.0],
            "1 to 12",
        )?;
        within(
            "divergence_deg",
            leaves.divergence,
            [-PI, PI],
            "-180° to 180°",
        )?;
        within("zigzag_deg", axis.zigzag, [0.0, 0.6], "0 to 34°")?;
        within("inclination_deg", axis.inclination, [0.0, PI], "0 to 180°")?;
        within("upward_deg", axis.upward, [-3.0, 3.0], "-171° to 171°")?;
        within("stray_deg", axis.stray, [0.0, 0.5], "0 to 28°")?;
        each(
            "posture.angle_deg",
            &posture.angle,
            [0.05, 3.0],
            "3° to 171°",
        )?;
        each("posture.size", &posture.size, [0.02, 2.0], "0.02 to 2")?;
        within("posture.to_light", posture.to_light, [0.0, 1.0], "0 to 1")?;
        let length = posture.light.length();
        within("posture.light", length, [0.999, 1.001], "a unit vector")?;
        within("posture.stray_deg", posture.stray, [0.0, 0.7], "0 to 40°")?;
        let cluster = f64::from(posture.cluster);
        within("posture.cluster", cluster, [1.0, 12.0], "1 to 12")?;
        within(
            "posture.spur_mm",
            posture.spur_mm,
            [0.5, 200.0],
            "0.5 to 200",
        )?;
        let evasions = f64::from(self.evasions);
        within("evasions", evasions, [0.0, 1000.0], "0 to 1000")?;
        if let Some(branches) = &self.branching {
            let order = f64::from(branches.order);
            within("branches.order", order, [1.0, 4.0], "1 to 4")?;
            each("branches.between", &branches.between, [0.0, 1.0], "0 to 1")?;
            each(
                "branches.length",
                &branches.length,
                [0.02, 1.0],
                "0.02 to 1",
            )?;
            within(
                "branches.angle_deg",
                branches.angle,
                [0.1, 2.0],
                "6° to 114°",
            )?;
            let thickness = branches.thickness;
            within("branches.thickness", thickness, [0.1, 1.0], "0.1 to 1")?;
            within("branches.share", branches.share, [0.0, 1.0], "0 to 1")?;
        }
        if let Some(buds) = &self.buds {
            within("buds.length_mm", buds.length_mm, [0.2, 50.0], "0.2 to 50")?;
            within("buds.radius_mm", buds.radius_mm, [0.1, 20.0], "0.1 to 20")?;
        }
        self.validate_parts()?;
        axis.has_room()
    }

    /// Checks the numbers of what only some plants have.
    fn validate_parts(&self) -> Result<(), PlantError> {
        let within = |field, value: f64, [least, most]: [f64; 2], range| {
            let is_good = (least..=most).contains(&value);
            is_good.then_some(()).ok_or(PlantError::OutOfRange {
                field,
                value,
                range,
            })
        };
        if let Some(relief) = &self.relief {
            within("relief.ridges_mm", relief.ridges_mm, [0.0, 20.0], "0 to 20")?;
            let width = relief.ridge_width_mm;
            within("relief.ridge_width_mm", width, [0.1, 100.0], "0.1 to 100")?;
            let many = relief.lenticels_per_cm2;
            within("relief.lenticels_per_cm2", many, [0.0, 200.0], "0 to 200")?;
            for length in relief.lenticel_mm {
                within("relief.lenticel_mm", length, [0.1, 50.0], "0.1 to 50")?;
            }
            let height = relief.lenticel_height_mm;
            within("relief.lenticel_height_mm", height, [0.0, 5.0], "0 to 5")?;
            within("relief.edge_mm", relief.edge_mm, [0.02, 20.0], "0.02 to 20")?;
            if relief.is_crowded() {
                return Err(PlantError::OutOfRange {
                    field: "relief.lenticels_per_cm2",
                    value: many,
                    range: "so few that they leave some bark free",
                });
            }
        }
        let stems = &self.stems;
        within(
            "stems.count",
            f64::from(stems.count),
            [1.0, 100.0],
            "1 to 100",
        )?;
        within("stems.spread_mm", stems.spread_mm, [0.0, 1e4], "0 to 10000")?;
        within("stems.fan_deg", stems.fan, [0.0, 1.4], "0 to 80°")?;
        if let Some(flower) = &self.flower {
            let parts = f64::from(flower.parts);
            within("flower.parts", parts, [2.0, 12.0], "2 to 12")?;
            within(
                "flower.peduncle_mm",
                flower.peduncle_mm,
                [1.0, 1000.0],
                "1 to 1000",
            )?;
            let radius = flower.peduncle_radius_mm;
            within(
                "flower.peduncle_radius_mm",
                radius,
                [0.1, 20.0],
                "0.1 to 20",
            )?;
            within("flower.nod_deg", flower.nod, [0.0, 2.5], "0 to 143°")?;
            for angle in flower.angles {
                within("flower.angles_deg", angle, [0.05, 3.0], "3° to 171°")?;
            }
            for length in flower.stamens_mm {
                within("flower.stamens_mm", length, [0.2, 100.0], "0.2 to 100")?;
            }
            for length in flower.pistil_mm {
                within("flower.pistil_mm", length, [0.2, 100.0], "0.2 to 100")?;
            }
        }
        if let Some((field, value, range)) = self.climbing.as_ref().and_then(Climbing::fault) {
            return Err(PlantError::OutOfRange {
                field,
                value,
                range,
            });
        }
        if let Some(pot) = &self.pot {
            within(
                "pot.diameter_mm",
                pot.diameter_mm,
                [20.0, 2000.0],
                "20 to 2000",
            )?;
            within("pot.height_mm", pot.height_mm, [20.0, 2000.0], "20 to 2000")?;
            within("pot.taper", pot.taper, [0.3, 1.0], "0.3 to 1")?;
            within("pot.wall_mm", pot.wall_mm, [1.0, 100.0], "1 to 100")?;
            for number in pot.rim_mm {
                within("pot.rim_mm", number, [0.0, 500.0], "0 to 500")?;
            }
            within("pot.fill", pot.fill, [0.2, 1.0], "0.2 to 1")?;
            let crumbs = pot.crumbs_per_cm2;
            within("pot.crumbs_per_cm2", crumbs, [0.0, 100.0], "0 to 100")?;
            within("pot.crumb_mm", pot.crumb_mm, [0.1, 50.0], "0.1 to 50")?;
            within("pot.moisture", pot.moisture, [0.0, 1.0], "0 to 1")?;
            if !pot.is_hollow() {
                return Err(PlantError::NoPot);
            }
        }
        Ok(())
    }
}
