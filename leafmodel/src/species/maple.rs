//! A maple of five lobes, each on its own axis. (Fig. 9 of Young 2010 splays the veins of one
//! midrib instead.)

use super::green_leaf;
use crate::leaf::LeafPlan;
use crate::leaf::outline_plan::Contour;
use crate::shape::growth_form::{Axis, GrowthForm, HalfForm, SecondaryAxis, VeinRow};
use crate::venation::plan::{AuxinPlan, Growth};

/// Directions of the secondary axes, degrees from the midrib.
const DIRECTIONS: [f64; 2] = [50.0, 101.0];

/// A lobe.
fn lobe(rate_ratio: f64, widest_at: f64) -> Axis {
    let vein = |position, slope| VeinRow {
        position,
        slope,
        bend: 1.0,
    };
    let half = HalfForm {
        lobe_decay: 0.0065,
        lobe_exponent: 1.0,
        veins: vec![
            vein(0.12, 0.2),
            vein(0.3, 0.45),
            vein(0.52, 0.9),
            vein(0.75, 1.1),
        ],
        ..HalfForm::entire(rate_ratio, widest_at, 3.0)
    };
    Axis {
        rows: 120,
        ..half.into()
    }
}

/// A pair of lobes at the petiole, each `length` midribs long.
fn pair(degrees: f64, length: f64, axis: Axis) -> SecondaryAxis {
    SecondaryAxis {
        position: 0.0,
        angle: degrees.to_radians(),
        paired: true,
        length,
        axis,
    }
}

/// A maple leaf, by eye: a middle lobe, two beside it nearly as long, two small ones at the base.
pub fn maple() -> GrowthForm {
    let midrib = Axis {
        axes: vec![
            pair(DIRECTIONS[0], 0.86, lobe(1.27, 0.33)),
            pair(DIRECTIONS[1], 0.52, lobe(1.28, 0.33)),
        ],
        ..lobe(1.25, 0.33)
    };
    midrib.into()
}

/// The leaf with a primary vein along each axis: veins start beside the petiole, each in the
/// direction of its lobe.
pub(super) fn plan() -> LeafPlan {
    let mut origins = vec![[0.0, 0.022]];
    for degrees in DIRECTIONS {
        let (sin, cos) = libm::sincos(degrees.to_radians());
        origins.extend([1.0, -1.0].map(|side| [0.015 * side * sin, 0.015 * cos]));
    }
    let venation = AuxinPlan {
        origins,
        joined_origins: true,
        final_length: 620.0,
        source_birth_distance: 4.0,
        vein_birth_distance: 4.0,
        darts_per_area: 0.01,
        growth: Growth::Isogonic {
            initial_length: 150.0,
            length_step: 2.5,
        },
        murray_exponent: 2.3,
        veinlet_radius_mm: 0.016,
        ..AuxinPlan::default()
    };
    let outline = Contour::GrowthAlgorithm(maple()).into();
    green_leaf(110.0, 3, outline, venation)
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
            // The farthest point of the margin within 15 degrees of the axis.
            let near = margin.iter().filter(|p| (p.0 - direction).abs() < 15.0);
            let farthest = near.map(|p| p.1).fold(0.0, f64::max);
            // The last row keeps its width of a thousandth and slopes up.
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
