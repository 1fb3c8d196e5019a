//! Memory that a leaf takes, estimated from its plan.

use super::error::LeafError;
use super::plan::LeafPlan;
use crate::blade::surface::SlopeMoments;
use crate::optics::Texel;
use crate::venation::plan::AuxinPlan;

/// Memory of a node of veins while they grow, bytes; measured with nets of 136 000, 418 000 and
/// 1 004 000 nodes, which took 254, 250 and 165 bytes a node.
const OF_A_NODE: f64 = 260.0;

/// Nodes over the square of the leaf's length in segments and over the distance of birth; measured
/// in the same nets: 0.16 to 0.28.
const NODES: f64 = 0.28;

/// Least distance of birth with which veins still get denser, segments: nodes of one vein are a
/// segment apart.
const LEAST_DISTANCE: f64 = 0.5;

/// Memory of a texel while a map is painted, bytes, over the square of the map's longer side;
/// measured with maps of 1024, 2048 and 4096 texels of a poplar: 77 to 133.
const OF_A_PAINTED_TEXEL: f64 = 140.0;

/// Width of a leaf's map over its length, as leaves mostly are.
const WIDTH: f64 = 0.7;

/// What a blade takes besides, bytes; measured with the same poplar.
const OF_A_BLADE: f64 = 120e6;

/// Memory that a plan takes, bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LeafMemory {
    /// While its veins grow.
    pub veins: f64,
    /// While its blade is made and painted, a mosaic included.
    pub blade: f64,
    /// What is kept of it: its maps.
    pub kept: f64,
}

impl LeafPlan {
    /// Estimates the memory that the plan takes, all different leaflets included. Counts of veins
    /// are known to a factor of 2.
    ///
    /// # Errors
    ///
    /// [`LeafError::Mosaic`] for a mosaic that would be refused when it grows.
    pub fn memory(&self) -> Result<LeafMemory, LeafError> {
        let variants = self.compound.as_ref().map_or(1, |form| form.variants);
        let count = f64::from(variants);
        // Veins of other kinds have limits of their own, at which they take tens of megabytes.
        let nodes = self.venation.auxin().map_or(0.0, nodes);
        let texels = f64::from(self.map_size) * f64::from(self.map_size);
        let surface = self
            .surface
            .as_ref()
            .map_or(0, |_| 2 * size_of::<SlopeMoments>());
        // Each face of a closed blade has maps of its own.
        let faces = if self.form.closed { 2.0 } else { 1.0 };
        let mut mosaic = 0.0;
        if let Some(pattern) = &self.mosaic {
            pattern.validate().map_err(LeafError::Mosaic)?;
            mosaic = pattern.plan.memory_bytes();
        }
        Ok(LeafMemory {
            veins: count * nodes * OF_A_NODE,
            blade: OF_A_BLADE + texels * OF_A_PAINTED_TEXEL + mosaic,
            kept: faces * count * WIDTH * texels * (size_of::<Texel>() + surface) as f64,
        })
    }
}

/// About how many nodes grow: veins fill the blade up to the distance at which no source is born.
fn nodes(plan: &AuxinPlan) -> f64 {
    let born = plan.vein_birth_distance.min(plan.source_birth_distance);
    let distance = born.max(plan.kill_distance).max(LEAST_DISTANCE);
    NODES * plan.final_length * plan.final_length / distance
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::leaf::venation_plan::VenationPlan;
    use crate::species::find;

    #[test]
    fn the_estimate_of_veins_is_within_twice_of_what_grows() {
        for name in ["poplar", "cottonwood"] {
            let plan = find(name).expect("a preset").plan();
            let VenationPlan::Auxin(auxin) = &plan.venation else {
                panic!("{name} has veins that grow towards auxin");
            };
            let grown = plan.grow_lamina().expect("a preset").network.nodes().len() as f64;
            let ratio = nodes(auxin) / grown;
            assert!((0.5..2.5).contains(&ratio), "{name}: {ratio}");
        }
    }

    #[test]
    fn a_plan_of_more_veins_or_texels_takes_more() {
        let plan = find("poplar").expect("a preset").plan();
        let mut larger = plan.clone();
        larger.map_size *= 4;
        let memory = |plan: &LeafPlan| plan.memory().expect("a good plan");
        assert!(memory(&larger).kept > 15.0 * memory(&plan).kept);
        let VenationPlan::Auxin(auxin) = &mut larger.venation else {
            panic!("the poplar has veins that grow towards auxin");
        };
        auxin.final_length *= 10.0;
        assert!(memory(&larger).veins > 50.0 * memory(&plan).veins);
    }
}
