//! The rows of Table 1 of Runions et al. 2005.
//!
//! The table gives leaf lengths in a unit that it does not name; it cannot be the vein segment
//! (`docs/src/theory/venation.md` says why). [`Row::leaf_unit`] is our reading: the number of table
//! units per segment.

use crate::shape::growth::RateCurve;
use crate::venation::plan::{AuxinPlan, Growth, Pattern};

/// Growth type of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RowGrowth {
    /// "no growth".
    None,
    /// "marginal", with the length increase per step in the table's unit.
    Marginal(f64),
    /// "isogonic", likewise.
    Isogonic(f64),
    /// "nonuniform": knots of the growth functions across and along the leaf, taken from the
    /// description of Fig. 5.
    Nonuniform(&'static [[f64; 2]], &'static [[f64; 2]]),
}

/// A row of the table: its figures as printed, and how we read them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// Open, or closed with exact or Urquhart's neighbours.
    pub pattern: Pattern,
    /// `d_k`, segments.
    pub kill_distance: f64,
    /// `b_s = b_v`, segments.
    pub birth_distance: f64,
    /// `L_i`, the table's unit; 0 without growth.
    pub initial_length: f64,
    /// `L_f`, the table's unit.
    pub final_length: f64,
    /// Growth type and `ΔL`.
    pub growth: RowGrowth,
    /// `ρ × 10⁶`; `ρ` is in darts per square segment and step.
    pub darts: f64,
    /// `n` of Murray's law.
    pub murray_exponent: f64,
    /// Table units per segment.
    pub leaf_unit: f64,
}

impl Row {
    /// The plan of this row with `leaf_unit` table units per segment. `veinlet_radius_mm` is the
    /// radius of the finest veins.
    pub fn plan(&self, leaf_unit: f64, veinlet_radius_mm: f64) -> AuxinPlan {
        let initial_length = self.initial_length / leaf_unit;
        AuxinPlan {
            pattern: self.pattern,
            final_length: self.final_length / leaf_unit,
            kill_distance: self.kill_distance,
            source_birth_distance: self.birth_distance,
            vein_birth_distance: self.birth_distance,
            darts_per_area: self.darts / 1e6,
            growth: match self.growth {
                RowGrowth::None => Growth::None,
                RowGrowth::Marginal(step) => Growth::Marginal {
                    initial_length,
                    length_step: step / leaf_unit,
                },
                RowGrowth::Isogonic(step) => Growth::Isogonic {
                    initial_length,
                    length_step: step / leaf_unit,
                },
                RowGrowth::Nonuniform(across, along) => {
                    let curve = |knots: &[[f64; 2]]| {
                        RateCurve::new(knots.to_vec()).expect("the knots of a preset are in order")
                    };
                    Growth::Anisotropic {
                        initial_length,
                        across: curve(across),
                        along: curve(along),
                    }
                }
            },
            murray_exponent: self.murray_exponent,
            veinlet_radius_mm,
            ..AuxinPlan::default()
        }
    }
}
