//! Leaves that use extensions named by the growth-algorithm paper: unequal halves and bent veins.
//! All numbers are by eye.

use super::green_leaf;
use crate::leaf::LeafPlan;
use crate::leaf::outline_plan::Contour;
use crate::shape::growth_form::{Axis, GrowthForm, HalfForm, VeinRow};
use crate::venation::arcuate::ArcuatePlan;
use crate::venation::plan::{AuxinPlan, Growth};

/// A begonia's outline: the broad half hangs down beside the petiole, the narrow one does not.
fn oblique() -> GrowthForm {
    let half = |rate_ratio, widest_at, falloff, veins: &[(f64, f64)]| HalfForm {
        veins: veins
            .iter()
            .map(|&(position, slope)| VeinRow::straight(position, slope))
            .collect(),
        ..HalfForm::entire(rate_ratio, widest_at, falloff)
    };
    let broad = half(1.16, 0.36, 3.2, &[(0.0, -2.2), (0.3, -0.5), (0.7, 0.2)]);
    let narrow = half(1.36, 0.45, 3.2, &[(0.2, 0.3), (0.7, 0.5)]);
    let midrib = Axis {
        left: Some(narrow),
        ..broad.into()
    };
    midrib.into()
}

/// A dogwood's outline: rows follow the veins, which bend towards the tip.
fn bent() -> GrowthForm {
    let vein = |position, slope| VeinRow {
        position,
        slope,
        bend: 1.5,
    };
    let half = HalfForm {
        veins: vec![vein(0.1, -0.3), vein(0.9, 0.1)],
        ..HalfForm::entire(1.27, 0.42, 4.0)
    };
    half.into()
}

pub(super) fn begonia() -> LeafPlan {
    let venation = AuxinPlan {
        final_length: 520.0,
        source_birth_distance: 4.0,
        vein_birth_distance: 4.0,
        darts_per_area: 0.01,
        growth: Growth::Isogonic {
            initial_length: 60.0,
            length_step: 2.5,
        },
        murray_exponent: 2.3,
        ..AuxinPlan::default()
    };
    let outline = Contour::GrowthAlgorithm(oblique()).into();
    green_leaf(120.0, 0, outline, venation)
}

pub(super) fn dogwood() -> LeafPlan {
    let outline = Contour::GrowthAlgorithm(bent()).into();
    let mut leaf = green_leaf(80.0, 0, outline, AuxinPlan::default());
    leaf.venation = ArcuatePlan {
        veins: 4,
        width: 0.004,
        squish: 0.3,
        squish2: 0.75,
        squish3: 0.6,
        up: 1.0,
        tip_width: 0.3,
        ..ArcuatePlan::default()
    }
    .into();
    leaf
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::leaf::Fields;
    use crate::shape::growth_form::Side;

    #[test]
    fn a_begonia_is_broad_and_hangs_down_on_one_side_only() {
        let outline = oblique().grow(1.0).expect("a good form");
        let (low, high) = outline.bounds();
        assert!(high.x > 1.4 * -low.x, "{low} {high}");
        let depth = |side: f64| {
            let points = outline.points().iter().filter(|p| side * p.x > 0.0);
            points.map(|p| p.y).fold(0.0, f64::min)
        };
        assert!(depth(1.0) < -0.05 && depth(-1.0) > -0.01);
    }

    #[test]
    fn a_dogwoods_veins_steepen_outwards() {
        let plan = dogwood();
        let lamina = plan.grow_lamina().expect("a good plan");
        let Some(Fields::Arcuate(veins)) = plan.fields(&lamina).expect("a good plan") else {
            panic!("splines have fields");
        };
        for i in 0..veins.laterals() {
            let [a, b, c] = veins.lateral(i).expect("there are so many");
            let turn = (b - a).angle_to(c - b) * c.x.signum();
            assert!(turn > 0.2, "vein {i} turns by {turn}");
        }
        for line in bent().vein_lines(1.0).expect("a good form") {
            let rise = |i: usize| (line[i + 1] - line[i]).y / (line[i + 1] - line[i]).x.abs();
            assert!((1..line.len() - 1).all(|i| rise(i) > rise(i - 1)));
        }
        let widest = bent().row_growth(Side::Right).expect("a good form");
        let widest = widest.iter().map(|row| row.half_width).fold(0.0, f64::max);
        assert!((0.2..0.35).contains(&widest), "{widest}");
    }
}
