//! Rows of cells: how fast they grow, along which curve, and where they end (Eqs. 1–4 of
//! \[young2010\]).

use glam::DVec2;

use super::error::{FormPart, GrowthFormError, GrowthFormProblem, Side};
use super::form::{
    Axis, GrowthForm, HalfForm, LateralGrowth, MATURITY, RowGrowth, SecondaryAxis, VeinRow,
};
use super::row_curve::RowCurve;
use crate::shape::outer_boundary::outer_boundary;

/// Longest row, in lengths of its axis; longer ones are refused.
const LONGEST: f64 = 50.0;

/// Number of points of a vein's line.
#[cfg(test)]
const LINE: usize = 24;

/// How an axis grows.
#[derive(Clone, Copy, Debug)]
pub(super) struct AxisGrowth {
    /// Growth of the midrib per step.
    main_rate: f64,
    /// Growth of the axis per step.
    axial_rate: f64,
    /// Steps to maturity, `T`.
    steps: f64,
    /// Length at maturity over that of the primordium.
    enlargement: f64,
    /// The same of the midrib.
    maturity: f64,
}

impl AxisGrowth {
    pub(super) fn of_midrib(form: &GrowthForm) -> Self {
        let axial_rate = form.axial_rate;
        Self {
            main_rate: axial_rate,
            axial_rate,
            steps: libm::log(form.maturity) / libm::log(1.0 + axial_rate),
            enlargement: form.maturity,
            maturity: form.maturity,
        }
    }

    /// How long an axis of the leaf is at maturity, in lengths of the midrib.
    pub(super) fn length_of(self, axis: &SecondaryAxis) -> f64 {
        // Its length over that of the midrib rises exponentially, from 1 in the primordium.
        libm::pow(axis.length, libm::log(self.maturity) / libm::log(MATURITY))
    }

    /// An axis on the same leaf.
    pub(super) fn of_secondary(self, axis: &SecondaryAxis) -> Self {
        Self {
            axial_rate: axis.axial_rate(self.main_rate),
            enlargement: self.length_of(axis) * self.maturity,
            ..self
        }
    }
}

/// The row, from 0, at a place along an axis. The paper's `j / N` would treat the two ends of the
/// midrib differently; `j = 1 + round(y (N − 1))` makes `yd` and `1 − yd` exact mirror images.
pub(super) fn row_at(rows: usize, position: f64) -> usize {
    // Halves are rounded to the even row, so that y and 1 − y stay mirror images with an odd number
    // of gaps too.
    (position * (rows - 1) as f64).round_ties_even() as usize
}

/// The checked rows on one side of an axis. Lengths are in units of the axis at maturity.
#[derive(Debug)]
pub(super) struct Rows<'a> {
    count: usize,
    half: &'a HalfForm,
    growth: AxisGrowth,
    part: FormPart,
    /// Each vein with the number of its row, from 0.
    pub(super) veins: Vec<(usize, VeinRow)>,
}

impl<'a> Rows<'a> {
    /// The rows on the side that `part` names.
    pub(super) fn new(axis: &'a Axis, growth: AxisGrowth, part: FormPart) -> Self {
        let half = match part.side {
            Side::Right => &axis.right,
            Side::Left => axis.left.as_ref().unwrap_or(&axis.right),
        };
        let row = |vein: &VeinRow| (row_at(axis.rows, vein.position), *vein);
        Self {
            count: axis.rows,
            half,
            growth,
            part,
            veins: half.veins.iter().map(row).collect(),
        }
    }

    /// The margin from base to tip, both included, on the side of positive x.
    pub(super) fn margin(&self) -> Result<Vec<DVec2>, GrowthFormError> {
        let mut points = Vec::with_capacity(self.count + 2);
        points.push(DVec2::ZERO);
        for j in 0..self.count {
            let (curve, x) = self.row(j)?;
            points.push(DVec2::new(x, self.start(j) + curve.rise(x)));
        }
        points.push(DVec2::Y);
        Ok(if self.veins_are_alike() {
            points
        } else {
            outer_boundary(&points)
        })
    }

    /// Whether all veins have one slope and bend: then rows are the same curve moved along the axis
    /// and cannot cross.
    pub(super) fn veins_are_alike(&self) -> bool {
        let curves = |pair: &[(usize, VeinRow)]| pair[0].1.curve() == pair[1].1.curve();
        self.veins.windows(2).all(curves)
    }

    /// The lines of the veins, from the axis outwards.
    #[cfg(test)]
    pub(super) fn vein_lines(&self) -> Result<Vec<Vec<DVec2>>, GrowthFormError> {
        let line = |&(j, _): &(usize, VeinRow)| {
            let (curve, end) = self.row(j)?;
            let point = |i: usize| {
                let x = end * i as f64 / LINE as f64;
                DVec2::new(x, self.start(j) + curve.rise(x))
            };
            Ok((0..=LINE).map(point).collect())
        };
        self.veins.iter().map(line).collect()
    }

    /// Growth of every row.
    pub(super) fn growth(&self) -> Result<Vec<RowGrowth>, GrowthFormError> {
        let row = |j: usize| {
            Ok(RowGrowth {
                place: self.start(j),
                rate: self.rate(j),
                half_width: self.row(j)?.1,
            })
        };
        (0..self.count).map(row).collect()
    }

    /// An error that names these rows' part of the form.
    pub(super) fn error(&self, problem: GrowthFormProblem) -> GrowthFormError {
        self.part.clone().error(problem)
    }

    /// Where row `j` (from 0) starts along the axis.
    pub(super) fn start(&self, j: usize) -> f64 {
        j as f64 / (self.count - 1) as f64
    }

    /// By how much the length of row `j` has grown relative to that of the axis.
    pub(super) fn allometry(&self, j: usize) -> f64 {
        libm::exp(self.growth.steps * libm::log1p(self.rate(j))) / self.growth.enlargement
    }

    /// The same when the axis had a fraction of its length.
    pub(super) fn earlier_allometry(&self, j: usize, fraction: f64) -> f64 {
        let enlargement = self.growth.enlargement * fraction;
        let steps = libm::log(enlargement) / libm::log1p(self.growth.axial_rate);
        libm::exp(steps * libm::log1p(self.rate(j))) / enlargement
    }

    /// The curve of row `j`.
    pub(super) fn curve(&self, j: usize) -> RowCurve {
        curve(&self.veins, j)
    }

    /// The curve of row `j` and how far from the axis it ends.
    fn row(&self, j: usize) -> Result<(RowCurve, f64), GrowthFormError> {
        let curve = self.curve(j);
        // In the primordium every row ends at a distance of one axis' length from the axis (Eq. 2,
        // in closed form).
        let length = curve.length(1.0) * self.allometry(j);
        if length > LONGEST * libm::hypot(1.0, curve.slope) {
            return Err(self.error(GrowthFormProblem::TooWide {
                row: j + 1,
                lengths: length,
            }));
        }
        Ok((curve, curve.reach(length)))
    }

    /// `gL` of row `j`: Eq. 3 or the curve, times Eq. 4 where there are veins.
    fn rate(&self, j: usize) -> f64 {
        let last = self.count - 1;
        let entire = match &self.half.lateral {
            LateralGrowth::Curve(curve) => curve.at(self.start(j)),
            LateralGrowth::Peak {
                rate_ratio,
                widest_at,
                falloff,
            } => {
                // Growth is 0 in the first and the last row, so the fastest row lies between them.
                let peak = row_at(self.count, *widest_at).clamp(1, last - 1);
                let away = if j <= peak {
                    (peak - j) as f64 / peak as f64
                } else {
                    (j - peak) as f64 / (last - peak) as f64
                };
                self.growth.axial_rate / rate_ratio * (1.0 - libm::pow(away, *falloff))
            }
        };
        if self.half.lobe_decay == 0.0 {
            return entire;
        }
        let nearest = self.veins.iter().map(|(row, _)| row.abs_diff(j)).min();
        nearest.map_or(entire, |rows| {
            let fall = self.half.lobe_decay * libm::pow(rows as f64, self.half.lobe_exponent);
            entire * libm::exp(-fall)
        })
    }
}

/// Curve of row `j`: slope and bend linear between veins, constant outside the outermost ones.
fn curve(veins: &[(usize, VeinRow)], j: usize) -> RowCurve {
    let after = veins.partition_point(|(row, _)| *row < j);
    let before = after.checked_sub(1).map(|i| &veins[i]);
    match (before, veins.get(after)) {
        (Some((r0, v0)), Some((r1, v1))) => {
            let share = (j - r0) as f64 / (r1 - r0) as f64;
            let (a, b) = (v0.curve(), v1.curve());
            RowCurve {
                slope: a.slope + (b.slope - a.slope) * share,
                bend: a.bend + (b.bend - a.bend) * share,
            }
        }
        (Some((_, vein)), None) | (None, Some((_, vein))) => vein.curve(),
        (None, None) => RowCurve {
            slope: 0.0,
            bend: 0.0,
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_one_by_one_end_where_the_closed_form_does() {
        // Eqs. 1 and 2 step by step, as in the paper; the last step is a fraction of one.
        let half = HalfForm {
            lobe_decay: 0.0003,
            veins: [14, 44, 74, 104, 134]
                .map(|row| VeinRow::straight(f64::from(row) / 149.0, 0.7))
                .to_vec(),
            ..HalfForm::entire(1.2, 0.3, 3.0)
        };
        let axis = Axis::from(half);
        let growth = AxisGrowth::of_midrib(&axis.clone().into());
        let rows = Rows::new(&axis, growth, FormPart::default());
        assert!((rows.growth.steps - 72.48).abs() < 0.01);
        let mut midrib: Vec<f64> = (0..150).map(|j| rows.start(j)).collect();
        let mut half_widths = vec![1.0; 150];
        let mut length = 1.0;
        let mut steps = 0;
        while length * 1.1 <= 1000.0 {
            length *= 1.1;
            steps += 1;
            for (j, x) in half_widths.iter_mut().enumerate() {
                midrib[j] *= 1.1;
                *x *= 1.0 + rows.rate(j);
            }
        }
        assert_eq!(steps, 72);
        let rest = libm::log(1000.0 / length) / libm::log(1.1);
        let margin = rows.margin().expect("rates in range");
        for (j, p) in margin[1..151].iter().enumerate() {
            let x = half_widths[j] * libm::pow(1.0 + rows.rate(j), rest);
            let y = midrib[j] * 1000.0 / length + 0.7 * x;
            assert!((p.x * 1000.0 - x).abs() <= 1e-9 * x, "row {j}: {p}, {x}");
            assert!((p.y * 1000.0 - y).abs() <= 1e-9 * y, "row {j}: {p}, {y}");
        }
    }

    #[test]
    fn slopes_are_linear_between_veins_and_constant_outside() {
        let veins = [(2, -1.0), (6, 3.0)].map(|(row, slope)| (row, VeinRow::straight(0.0, slope)));
        let slopes: Vec<f64> = (0..9).map(|j| curve(&veins, j).slope).collect();
        assert_eq!(slopes, [-1.0, -1.0, -1.0, 0.0, 1.0, 2.0, 3.0, 3.0, 3.0]);
        assert_eq!(curve(&[], 4).slope, 0.0);
    }
}
