//! A true maple: five lobes, each on an axis of its own, where Fig. 9 of Young 2010 splays the veins of one midrib.

use crate::shape::growth_form::{CurvedVein, GrowthForm, HalfForm, LateralGrowth};
use crate::shape::palmate::{PalmateForm, SecondaryAxis};

/// Axial growth of the main axis, the paper's value.
const AXIAL_RATE: f64 = 0.1;

/// A lobe as long as `length` main axes.
fn lobe(length: f64, rate_ratio: f64, widest_at: f64) -> GrowthForm {
    let vein = |position, slope| CurvedVein {
        position,
        slope,
        bend: 1.0,
    };
    GrowthForm {
        rows: 120,
        axial_rate: SecondaryAxis::axial_rate_for(length, AXIAL_RATE),
        right: HalfForm {
            lateral: LateralGrowth::Peak {
                rate_ratio,
                widest_at,
                falloff: 3.0,
            },
            lobe_decay: 0.0065,
            lobe_exponent: 1.0,
            veins: vec![
                vein(0.12, 0.2),
                vein(0.3, 0.45),
                vein(0.52, 0.9),
                vein(0.75, 1.1),
            ],
        },
        left: None,
    }
}

/// A pair of lobes at the petiole.
fn pair(degrees: f64, form: GrowthForm) -> SecondaryAxis {
    SecondaryAxis {
        position: 0.0,
        angle: degrees.to_radians(),
        paired: true,
        form,
        axes: Vec::new(),
    }
}

/// A maple leaf, by eye: a middle lobe, two beside it nearly as long, two small ones at the base.
pub fn maple() -> PalmateForm {
    PalmateForm {
        main: lobe(1.0, 1.25, 0.33),
        axes: vec![
            pair(50.0, lobe(0.86, 1.27, 0.33)),
            pair(101.0, lobe(0.52, 1.28, 0.33)),
        ],
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;
    use crate::measure::shape;

    #[test]
    fn a_maple_has_five_lobes_that_end_where_its_axes_do() {
        let palm = maple();
        let outline = palm.grow(80.0).expect("a good form");
        let polar = |p: &DVec2| (libm::atan2(p.x, p.y).to_degrees(), p.length());
        let margin: Vec<(f64, f64)> = outline.points().iter().map(polar).collect();
        let mut tips = Vec::new();
        for [_, tip] in palm.axis_lines(80.0).expect("a good form") {
            assert!(outline.distance_to_margin(tip) < 1e-6 * 80.0, "{tip}");
            let (direction, length) = polar(&tip);
            // Nothing reaches farther within 15 degrees.
            let near = margin.iter().filter(|p| (p.0 - direction).abs() < 15.0);
            let farthest = near.map(|p| p.1).fold(0.0, f64::max);
            // The last row is as wide as at the start, a thousandth, and slopes up.
            assert!(farthest <= length + 0.2, "{farthest} beyond {length}");
            tips.push((direction, length));
        }
        assert_eq!(tips.len(), 5);
        tips.sort_by(|p, q| p.0.total_cmp(&q.0));
        for pair in tips.windows(2) {
            let between = margin.iter().filter(|p| p.0 > pair[0].0 && p.0 < pair[1].0);
            let bay = between.map(|p| p.1).fold(f64::INFINITY, f64::min);
            assert!(
                bay < 0.85 * pair[0].1.min(pair[1].1),
                "{bay} between {pair:?}"
            );
        }
        let solidity = shape(&outline).number("solidity").expect("it has one");
        assert!((0.5..0.8).contains(&solidity), "{solidity}");
    }
}
