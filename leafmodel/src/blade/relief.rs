//! Veins that stand out on the abaxial side.
//!
//! The sheet is displaced towards −z along major veins: a ridge on the abaxial side, a groove on
//! the adaxial one. The profile across a vein is one period of a cosine, so that it starts and ends
//! flat.

use std::f64::consts::PI;

use glam::DVec2;

use super::plan::BladeForm;
use super::vein_grid::VeinGrid;
use crate::numeric::smooth_step;
use crate::venation::network::VeinSegment;

/// Half-width of the mound in radii of the vein: the bundle sheath reaches beyond the vein itself.
pub(super) const HALF_WIDTH: f64 = 1.5;
/// Ratio of a vein's radius to the least meshed one at which it has its full height.
const FULL_AT: f64 = 1.5;
/// More than rounding can change in the bound of a mound.
const ROUNDING: f64 = 1e-9;

/// Height of the veins over the lamina.
#[derive(Debug)]
pub(super) struct Relief {
    /// Height over diameter.
    height: f64,
    least_radius: f64,
    veins: VeinGrid,
}

impl Relief {
    /// The relief that `form` gives to these veins.
    pub(super) fn new(form: &BladeForm, veins: &[VeinSegment]) -> Self {
        let raised = if form.relief > 0.0 { veins } else { &[] };
        let reach = |s: &VeinSegment| HALF_WIDTH * s.radius_from.max(s.radius_to);
        Self {
            height: form.relief,
            least_radius: form.meshed_vein_radius_mm,
            veins: VeinGrid::new(raised.to_vec(), reach),
        }
    }

    /// Displacement towards −z, mm, ≥ 0: the highest of the mounds at this point,
    /// `relief · 2r · (1 + cos(π d / 1.5 r)) / 2` for a vein of radius `r` at distance `d`.
    pub(super) fn height(&self, p: DVec2) -> f64 {
        self.veins.near(p).fold(0.0, |highest, vein| {
            let away = vein.distance / (HALF_WIDTH * vein.radius);
            if away >= 1.0 {
                return highest;
            }
            let top = self.height * 2.0 * vein.radius * developed(vein.radius, self.least_radius);
            // At least the mound, and cheaper: the first terms of the cosine's series.
            let squared = (PI * away) * (PI * away);
            let most = 1.0 + ROUNDING - squared * (0.25 - squared / 48.0);
            if top * most <= highest {
                return highest;
            }
            let mound = f64::midpoint(1.0, libm::cos(PI * away));
            f64::max(highest, top * mound)
        })
    }
}

/// Share of its height that the mound of a vein of this radius has in a mesh whose least meshed
/// radius is `least`.
pub(super) fn developed(radius: f64, least: f64) -> f64 {
    smooth_step((radius / least - 1.0) / (FULL_AT - 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::blade::tests::flat;

    fn relief(height: f64) -> Relief {
        let form = BladeForm {
            relief: height,
            meshed_vein_radius_mm: 0.1,
            ..flat()
        };
        let vein = VeinSegment {
            from: DVec2::ZERO,
            to: DVec2::new(0.0, 20.0),
            radius_from: 0.6,
            radius_to: 0.1,
            order: 1,
        };
        Relief::new(&form, &[vein])
    }

    #[test]
    fn a_vein_is_highest_on_its_axis_and_ends_flat() {
        let relief = relief(0.5);
        let top = relief.height(DVec2::new(0.0, 0.0));
        assert!((top - 0.6).abs() < 1e-12, "{top}");
        assert_eq!(relief.height(DVec2::new(0.9, 0.0)), 0.0);
        let edge = relief.height(DVec2::new(0.88, 0.0));
        assert!(edge > 0.0 && edge < 0.001, "{edge}");
    }

    #[test]
    fn a_vein_that_gets_too_fine_to_mesh_sinks_into_the_lamina() {
        assert_eq!(relief(0.5).height(DVec2::new(0.0, 20.0)), 0.0);
    }

    #[test]
    fn no_relief_is_flat() {
        assert_eq!(relief(0.0).height(DVec2::ZERO), 0.0);
    }
}
