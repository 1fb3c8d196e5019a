//! How a given lamina expands from primordium to maturity: growth at rates that differ from place
//! to place.
//!
//! Relative elementary rates of growth across and along the leaf depend on where tissue lies along
//! the axis at the start, and on nothing else. A point that starts at `(x0, y0)` is then, `t` steps
//! later, at
//!
//! `x = x0 RERGx(y0)^t`, `y = ∫₀^y0 RERGy(η)^t dη`, with `RERG = 1 + g`.
//!
//! - **In**: two [`RateCurve`]s, the length at the start, and that at the end.
//! - **Out**: where given tissue lies at any time, and which tissue lies at a given place.
//! - **Always true**: the two maps are inverse to each other up to rounding, since both read the
//!   same table.
//!
//! # Source
//!
//! \[runions2005\], Appendix A, Eq. 4 and Fig. 5.

use crate::numeric::bisect;
use glam::DVec2;

use crate::not_grown::{NotGrown, not_grown};

/// Number of cells of the table of heights.
const CELLS: usize = 512;

/// Steps after which growth counts as never reaching the final length.
const LONGEST: f64 = 1e6;

/// A growth rate per step as a function of where tissue lies at the start, 0 at the base, 1 at the
/// apex: a monotone cubic through its knots. Between two knots its value stays between theirs.
#[derive(Clone, Debug, PartialEq)]
pub struct RateCurve {
    /// Place and rate of each knot, in the order of rising places.
    knots: Vec<[f64; 2]>,
    /// Slope at each knot.
    slopes: Vec<f64>,
}

impl RateCurve {
    /// A curve through `[place, rate]`, places rising from 0 to 1, rates above −1 and at most 1 per
    /// step. Before the first knot and after the last the rate is constant.
    ///
    /// # Errors
    ///
    /// [`NotGrown`], naming the knot.
    ///
    /// # Source
    ///
    /// \[fritsch1984\], Eq. 5 (three-point harmonic slopes), for the interpolation.
    pub fn new(knots: Vec<[f64; 2]>) -> Result<Self, NotGrown> {
        if !(1..=1000).contains(&knots.len()) {
            let knots = knots.len();
            return Err(not_grown!(
                "a growth function needs 1 to 1000 knots, it has {knots}"
            ));
        }
        for (index, &[at, rate]) in knots.iter().enumerate() {
            let rises = index == 0 || at > knots[index - 1][0];
            if !(rises && (0.0..=1.0).contains(&at)) {
                return Err(not_grown!(
                    "knot {index} of a growth function lies at {at}; knots go from 0 at the base to 1 at the apex, rising"
                ));
            }
            if !(rate > -1.0 && rate <= 1.0) {
                return Err(not_grown!(
                    "knot {index} of a growth function is {rate}; 1 + g must stay above 0, and g at most 1 per step"
                ));
            }
        }
        let chord = |i: usize| (knots[i + 1][1] - knots[i][1]) / (knots[i + 1][0] - knots[i][0]);
        let slope = |i: usize| {
            if i == 0 || i + 1 == knots.len() {
                return 0.0; // The curve goes on as a constant.
            }
            let (before, after) = (chord(i - 1), chord(i));
            if before * after <= 0.0 {
                return 0.0;
            }
            let (left, right) = (knots[i][0] - knots[i - 1][0], knots[i + 1][0] - knots[i][0]);
            let share = (left + 2.0 * right) / (3.0 * (left + right));
            before * after / (share * after + (1.0 - share) * before)
        };
        let slopes = (0..knots.len()).map(slope).collect();
        Ok(Self { knots, slopes })
    }

    /// The same rate everywhere.
    ///
    /// # Errors
    ///
    /// [`NotGrown`] unless it is above −1 and at most 1.
    #[cfg(test)]
    pub(crate) fn constant(rate: f64) -> Result<Self, NotGrown> {
        Self::new(vec![[0.0, rate]])
    }

    /// Its knots, `[place, rate]`.
    pub fn knots(&self) -> &[[f64; 2]] {
        &self.knots
    }

    /// The rate `g` at a place, per step.
    pub fn at(&self, place: f64) -> f64 {
        let last = self.knots.len() - 1;
        if place <= self.knots[0][0] {
            return self.knots[0][1];
        }
        if place >= self.knots[last][0] {
            return self.knots[last][1];
        }
        let i = self.knots.partition_point(|&[at, _]| at <= place) - 1;
        let ([x0, y0], [x1, y1]) = (self.knots[i], self.knots[i + 1]);
        let width = x1 - x0;
        let u = (place - x0) / width;
        // Cubic Hermite polynomial.
        let (m0, m1) = (self.slopes[i] * width, self.slopes[i + 1] * width);
        let rise = y1 - y0;
        let (c, d) = (3.0 * rise - 2.0 * m0 - m1, m0 + m1 - 2.0 * rise);
        y0 + (m0 + (c + d * u) * u) * u
    }
}

/// The map from where tissue starts to where it lies `t` steps later, in segments.
#[derive(Clone, Debug)]
pub(crate) struct TissueMap {
    initial_length: f64,
    /// Stretch across the leaf, `(1 + gx)^t`, at each grid line.
    widths: Vec<f64>,
    /// Height over the base of each grid line.
    heights: Vec<f64>,
}

impl TissueMap {
    /// The map at time `t` ≥ 0 for a leaf that starts `initial_length` long.
    pub(crate) fn new(initial_length: f64, across: &RateCurve, along: &RateCurve, t: f64) -> Self {
        let rerg = |curve: &RateCurve, place: f64| libm::pow(1.0 + curve.at(place), t);
        let cell = initial_length / CELLS as f64;
        let mut heights = Vec::with_capacity(CELLS + 1);
        let mut height = 0.0;
        heights.push(0.0);
        let mut below = rerg(along, 0.0);
        for i in 0..CELLS {
            let middle = rerg(along, (i as f64 + 0.5) / CELLS as f64);
            let above = rerg(along, (i + 1) as f64 / CELLS as f64);
            // Simpson's rule.
            height += cell * (below + 4.0 * middle + above) / 6.0;
            heights.push(height);
            below = above;
        }
        let widths = (0..=CELLS)
            .map(|i| rerg(across, i as f64 / CELLS as f64))
            .collect();
        Self {
            initial_length,
            widths,
            heights,
        }
    }

    /// Length of the leaf at that time.
    pub(crate) fn length(&self) -> f64 {
        self.heights[CELLS]
    }

    /// The present place of the tissue that started at `start`.
    pub(crate) fn forward(&self, start: DVec2) -> DVec2 {
        let place = start.y / self.initial_length * CELLS as f64;
        let cell = (place.floor().max(0.0) as usize).min(CELLS - 1);
        let share = place - cell as f64;
        let (low, high) = (self.heights[cell], self.heights[cell + 1]);
        DVec2::new(
            start.x * self.width(cell, share),
            low + share * (high - low),
        )
    }

    /// The place at which the tissue now at `now` started.
    pub(crate) fn back(&self, now: DVec2) -> DVec2 {
        let cell = self
            .heights
            .partition_point(|&height| height <= now.y)
            .clamp(1, CELLS)
            - 1;
        let (low, high) = (self.heights[cell], self.heights[cell + 1]);
        let share = (now.y - low) / (high - low);
        let y = (cell as f64 + share) / CELLS as f64 * self.initial_length;
        DVec2::new(now.x / self.width(cell, share), y)
    }

    /// Stretch across the leaf; constant beyond base and apex.
    fn width(&self, cell: usize, share: f64) -> f64 {
        let share = share.clamp(0.0, 1.0);
        self.widths[cell] + share * (self.widths[cell + 1] - self.widths[cell])
    }
}

/// The time, in steps, at which a leaf that starts `initial` long is `last` long.
///
/// # Errors
///
/// [`NotGrown`] if that takes more than 1 000 000 steps.
pub(crate) fn arrival(initial: f64, along: &RateCurve, last: f64) -> Result<f64, NotGrown> {
    // Only the length matters.
    let still = RateCurve {
        knots: vec![[0.0, 0.0]],
        slopes: vec![0.0],
    };
    let length = |t: f64| TissueMap::new(initial, &still, along, t).length();
    let mut high = 1.0;
    while length(high) < last {
        high *= 2.0;
        if high > LONGEST {
            return Err(not_grown!(
                "with these growth functions the leaf does not come from {initial} to {last} segments in 1000000 steps"
            ));
        }
    }
    let low = if high <= 1.0 { 0.0 } else { high * 0.5 };
    Ok(bisect(low, high, 80, |t| length(t) < last).1)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(knots: &[[f64; 2]]) -> RateCurve {
        RateCurve::new(knots.to_vec()).expect("a good curve")
    }

    #[test]
    fn uniform_growth_is_a_power_in_both_directions() {
        let (across, along) = (curve(&[[0.0, 0.02]]), curve(&[[0.5, 0.05]]));
        let map = TissueMap::new(23.0, &across, &along, 40.0);
        let p = map.forward(DVec2::new(3.0, 7.0));
        let expected = DVec2::new(3.0 * libm::pow(1.02, 40.0), 7.0 * libm::pow(1.05, 40.0));
        assert!((p - expected).length() < 1e-9, "{p} {expected}");
        // Places beyond base and apex are tested too.
        for y in [-2.0, 25.0] {
            let p = map.forward(DVec2::new(1.0, y));
            assert!((p.y - y * libm::pow(1.05, 40.0)).abs() < 1e-9);
        }
    }

    #[test]
    fn the_height_is_the_integral_of_equation_4() {
        let along = curve(&[[0.0, 0.02], [0.4, 0.08], [1.0, 0.01]]);
        let map = TissueMap::new(10.0, &curve(&[[0.0, 0.0]]), &along, 30.0);
        for y0 in [1.0_f64, 3.7, 9.9] {
            let n = 200_000;
            let sum: f64 = (0..n)
                .map(|i| {
                    let y = y0 * (f64::from(i) + 0.5) / f64::from(n);
                    libm::pow(1.0 + along.at(y / 10.0), 30.0)
                })
                .sum();
            let integral = sum * y0 / f64::from(n);
            let height = map.forward(DVec2::new(0.0, y0)).y;
            // Linear interpolation in the table is off by at most h²/8 times the slope of the
            // integrand.
            let h = 10.0 / CELLS as f64;
            let rerg = |i: i32| libm::pow(1.0 + along.at(f64::from(i) * 1e-4), 30.0);
            let steepest = (0..10_000)
                .map(|i| (rerg(i + 1) - rerg(i)).abs() / 1e-3)
                .fold(0.0, f64::max);
            assert!(
                (height - integral).abs() < h * h / 8.0 * steepest,
                "{height} {integral}"
            );
        }
    }

    #[test]
    fn there_and_back_is_the_identity() {
        let across = curve(&[[0.0, 0.01], [0.3, 0.07], [1.0, -0.005]]);
        let along = curve(&[[0.0, 0.06], [1.0, 0.02]]);
        let map = TissueMap::new(23.0, &across, &along, 55.5);
        for i in 0..200 {
            let start = DVec2::new(f64::from(i % 7) - 3.0, f64::from(i) * 0.13 - 1.0);
            let there = map.back(map.forward(start));
            assert!((there - start).length() < 1e-12, "{start} {there}");
        }
    }

    #[test]
    fn curves_keep_between_their_knots_and_pass_through_them() {
        let knots = [
            [0.1, 0.0],
            [0.3, 0.09],
            [0.35, 0.09],
            [0.6, 0.01],
            [0.9, 0.05],
        ];
        let curve = curve(&knots);
        for pair in knots.windows(2) {
            assert_eq!(curve.at(pair[0][0]), pair[0][1]);
            let (low, high) = (pair[0][1].min(pair[1][1]), pair[0][1].max(pair[1][1]));
            for i in 0..=50 {
                let at = pair[0][0] + (pair[1][0] - pair[0][0]) * f64::from(i) / 50.0;
                let rate = curve.at(at);
                assert!((low - 1e-15..=high + 1e-15).contains(&rate), "{at}: {rate}");
            }
        }
        assert_eq!((curve.at(0.0), curve.at(1.0)), (0.0, 0.05));
    }

    #[test]
    fn growth_ends_at_the_final_length() {
        let along = curve(&[[0.0, 0.05], [1.0, 0.02]]);
        let t = arrival(23.0, &along, 184.0).expect("it grows");
        let length = TissueMap::new(23.0, &along, &along, t).length();
        assert!((length - 184.0).abs() < 1e-9, "{length}");
        let uniform = RateCurve::constant(0.05).expect("good");
        let t = arrival(23.0, &uniform, 184.0).expect("it grows");
        assert!((t - libm::log(8.0) / libm::log(1.05)).abs() < 1e-9);
    }

    #[test]
    fn bad_growth_functions_are_refused() {
        let refused = |knots: &[[f64; 2]]| match RateCurve::new(knots.to_vec()) {
            Ok(_) => String::new(),
            Err(error) => error.to_string(),
        };
        assert!(refused(&[]).ends_with("it has 0"));
        for bad in [-1.0, -1.5, f64::NAN, 2.0] {
            let said = refused(&[[0.0, 0.1], [1.0, bad]]);
            let expected = format!("knot 1 of a growth function is {bad};");
            assert!(said.starts_with(&expected), "{said}");
        }
        for bad in [0.2, 1.2, f64::NAN] {
            let said = refused(&[[0.2, 0.1], [bad, 0.1]]);
            let expected = format!("knot 1 of a growth function lies at {bad};");
            assert!(said.starts_with(&expected), "{said}");
        }
        let still = RateCurve::constant(0.0).expect("allowed");
        let never = arrival(10.0, &still, 20.0).expect_err("it does not grow");
        assert!(never.to_string().contains("from 10 to 20 segments"));
    }
}
