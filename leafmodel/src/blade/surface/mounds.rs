//! Grooves and ridges along veins.

use std::f64::consts::PI;

use crate::blade::frame::UvFrame;
use crate::blade::mesh::BladeMesh;
use crate::blade::senescence::Withering;
use crate::blade::tissue::Tissue;
use crate::venation::network::VeinSegment;

use glam::DVec2;

use super::super::relief::HALF_WIDTH;
use super::super::vein_grid::VeinGrid;
use super::super::vein_profile::strength;
use super::plan::SurfacePlan;

/// Bounds are taken by this factor higher, for rounding.
const SPARE: f64 = 1.0 + 1e-9;

/// The mounds of all veins.
#[derive(Debug)]
pub(super) struct Mounds {
    /// Height over diameter towards −z, of the adaxial and the abaxial face.
    heights: [f64; 2],
    /// Variance of slope that the coat has more over a fully developed vein.
    roughness: f64,
    full_radius: f64,
    veins: VeinGrid,
}

/// The mound at a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mound {
    /// Slopes of the adaxial and the abaxial face.
    pub(super) slopes: [DVec2; 2],
    /// Variance of slope along each axis that the coat has here beside its own.
    pub(super) roughness: f64,
}

impl Mounds {
    pub(super) fn new(plan: &SurfacePlan, blade: &SurfaceOf<'_>, texel: f64) -> Self {
        let heights = [plan.impressed, plan.raised];
        let is_smooth = heights == [0.0; 2] && plan.vein_roughness == 0.0;
        let veins = if is_smooth { &[] } else { blade.veins };
        // A texel asks at its centre for all veins that reach into it.
        let reach = |s: &crate::venation::network::VeinSegment| {
            HALF_WIDTH * s.radius_from.max(s.radius_to) + texel
        };
        Self {
            heights,
            // As the renderer has it, a variance σ² of slopes adds 3 σ² to the square of a roughness.
            roughness: plan.vein_roughness * plan.vein_roughness / 3.0,
            full_radius: blade.tissue.full_vein_radius_mm,
            veins: VeinGrid::new(veins.to_vec(), reach),
        }
    }

    /// Puts into `near` the veins whose mounds come within the distance `reach` of a point, the
    /// centre of a texel and half its diagonal, in the order of their numbers.
    pub(super) fn reaching(&self, centre: DVec2, reach: f64, near: &mut Vec<u32>) {
        near.clear();
        let members = self.veins.members(centre).iter().copied();
        near.extend(members.filter(|&number| {
            let width = HALF_WIDTH * self.veins.widest(number);
            self.veins.nearest(number, centre).distance <= (width + reach) * SPARE
        }));
    }

    /// The slopes at `p` of the highest of these veins' mounds, `2r (1 + cos(π d / 1.5 r)) / 2` at
    /// the distance `d` from the axis of a vein of radius `r`, times its height on each face.
    pub(super) fn slopes(&self, veins: &[u32], p: DVec2) -> Mound {
        let mut highest = 0.0;
        let mut mound = Mound {
            slopes: [DVec2::ZERO; 2],
            roughness: 0.0,
        };
        for &number in veins {
            // The profile is at most 1, so that this mound cannot be higher.
            if 2.0 * self.veins.widest(number) * SPARE <= highest {
                continue;
            }
            let near = self.veins.nearest(number, p);
            let width = HALF_WIDTH * near.radius;
            let away = near.distance / width;
            // Nor does the profile exceed 1 − away².
            if away >= 1.0 || 2.0 * near.radius * (1.0 - away * away) * SPARE <= highest {
                continue;
            }
            let (sine, cosine) = libm::sincos(PI * away);
            let profile = f64::midpoint(1.0, cosine);
            let height = 2.0 * near.radius * profile;
            if height <= highest {
                continue;
            }
            highest = height;
            // Downwards over the distance; the mound itself points to −z.
            let steepness = near.radius * PI / width * sine;
            let outward = (p - near.foot).normalize_or_zero();
            mound = Mound {
                slopes: self.heights.map(|own| outward * (own * steepness)),
                roughness: self.roughness * profile * strength(near.radius, self.full_radius),
            };
        }
        mound
    }
}

/// What the relief of a blade is made from.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceOf<'a> {
    /// Where the map lies.
    pub frame: &'a UvFrame,
    /// The margin, mm; without one the whole frame is covered.
    pub margin: &'a [DVec2],
    /// The veins.
    pub veins: &'a [VeinSegment],
    /// The tissue, for the radius of a fully developed vein.
    pub tissue: &'a Tissue,
    /// The blade's mesh, whose relief is not repeated; without one the map has all of it.
    pub mesh: Option<&'a BladeMesh>,
    /// How the tissue has aged.
    pub withering: Option<&'a Withering>,
    /// Decides where dust lies.
    pub seed: u64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_profile_exceeds_the_bound_by_which_mounds_are_left_out() {
        for step in 0..=10_000 {
            let away = f64::from(step) / 10_000.0;
            let profile = f64::midpoint(1.0, libm::cos(PI * away));
            assert!(profile <= (1.0 - away * away) * SPARE, "{away}");
        }
    }
}
