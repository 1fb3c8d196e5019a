//! Outlines that local growth rates bring forth by themselves (growth-algorithm model).
//!
//! Half a leaf is `N` rows of cells between midrib and margin. The midrib grows at one rate along
//! its whole length, each row at its own rate along its own direction; exponential growth over three orders
//! of magnitude turns small differences of rate into the shape of the leaf.
//!
//! - **In**: growth rates, where they peak, how they fall off, and rows that are veins.
//! - **Out**: an [`Outline`], base at the origin, midrib along +y.
//! - **Always true**: the outline is mirror symmetric and never crosses itself.
//! - **Left out**: unlike halves, curved veins and other growth laws, which [`super::growth_form`] has; palmate leaves
//!   ([`super::palmate`]) and compound ones ([`crate::compound`]).

use glam::DVec2;
use thiserror::Error;

use super::cell_rows::ENLARGEMENT;
use super::outer_boundary::outer_boundary;
use super::outline::{Outline, OutlineError};

/// A row of cells that is a secondary vein: it sets the direction of growth and bears a lobe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VeinRow {
    /// Place along the midrib, 0 at the petiole, 1 at the tip.
    pub position: f64,
    /// Slope `s` of the row: rise along the midrib per unit away from it, constant in growth.
    pub slope: f64,
}

/// Parameters of the growth algorithm; the letters are the paper's.
///
/// # Source
///
/// \[young2010\], Eqs. 1–4. `docs/src/theory/growth-shape.md` says where this departs from it.
#[derive(Clone, Debug, PartialEq)]
pub struct GrowthShape {
    /// `N`, rows of cells along the midrib, 3 to 10 000. The paper's typical value is 150.
    pub rows: usize,
    /// `gy`, growth of the midrib per step, 0.001 to 1. The paper's value is 0.1.
    pub axial_rate: f64,
    /// `R = gy / gL0`, axial over greatest lateral growth rate, 0.5 to 100.
    pub rate_ratio: f64,
    /// `yd`, where along the midrib lateral growth is fastest, in (0, 1).
    pub widest_at: f64,
    /// `k`, how late lateral growth falls off away from there, > 0 up to 100 (Eq. 3).
    pub falloff: f64,
    /// `a`, how fast growth falls off away from a vein, 0 to 100; 0 gives an entire leaf (Eq. 4).
    /// It counts distance in rows, so a value belongs to its number of rows.
    pub lobe_decay: f64,
    /// `n`, shape of that fall, > 0 up to 10: 1 pointed lobes, 2 rounded ones (Eq. 4).
    pub lobe_exponent: f64,
    /// Secondary veins, from base to tip; none means slope 0 and no lobes.
    pub veins: Vec<VeinRow>,
}

/// Why no outline grows.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum GrowthShapeError {
    /// A number outside the range in which the model holds.
    #[error("{key} is {value}, outside {range}")]
    OutOfRange {
        /// Which parameter.
        key: &'static str,
        /// What it was.
        value: f64,
        /// What it may be.
        range: &'static str,
    },
    /// Veins that are not in order from base to tip, or share a row.
    #[error("vein {index} lies in row {row}, not above the row of the vein before it")]
    VeinOrder {
        /// Which vein, from 0.
        index: usize,
        /// Its row, from 1 at the petiole.
        row: usize,
    },
    /// The rows sweep over something that is no blade.
    #[error("these growth rates and slopes bring forth no margin")]
    NoMargin(#[from] OutlineError),
}

impl GrowthShape {
    /// Grows the primordium until the midrib is a thousand times longer, and scales the outcome
    /// so that the midrib measures `length_mm`.
    ///
    /// The outline starts at the base (0, 0), goes up the right margin, over the apex
    /// (0, `length_mm`), and down the left one. Growth ends in the middle of a step, so that the
    /// enlargement is exactly 1000 (the paper: "about 1000").
    ///
    /// # Errors
    ///
    /// [`GrowthShapeError`], naming the parameter and its range.
    ///
    /// # Source
    ///
    /// \[young2010\], section III.
    pub fn grow(&self, length_mm: f64) -> Result<Outline, GrowthShapeError> {
        in_range(
            "length_mm",
            length_mm,
            1e-3..=1e5,
            "0.001 to 100000 (millimetres)",
        )?;
        let veins = self.checked_veins()?;
        let scale = length_mm / ENLARGEMENT;
        let margin = self.margin(&veins);
        let (base, apex) = (DVec2::ZERO, DVec2::new(0.0, ENLARGEMENT));
        let mut half: Vec<DVec2> = std::iter::once(base).chain(margin).chain([apex]).collect();
        // With one slope for all rows the margin is the sheared graph of a function and cannot
        // cross itself; only rows of unlike slope can pass over each other.
        if veins.windows(2).any(|pair| pair[0].1 != pair[1].1) {
            half = outer_boundary(&half);
        }
        let mirrored = half[1..half.len() - 1]
            .iter()
            .rev()
            .map(|p| DVec2::new(-p.x, p.y));
        let points = half.iter().copied().chain(mirrored).map(|p| p * scale);
        Ok(Outline::new(
            points.collect(),
            base * scale,
            DVec2::new(0.0, length_mm),
        )?)
    }

    /// Checks every parameter; gives the veins as (row, slope), rows counted from 0.
    pub(super) fn checked_veins(&self) -> Result<Vec<(usize, f64)>, GrowthShapeError> {
        in_range("rows", self.rows as f64, 3.0..=1e4, "3 to 10000")?;
        in_range("axial_rate", self.axial_rate, 1e-3..=1.0, "0.001 to 1")?;
        in_range("rate_ratio", self.rate_ratio, 0.5..=100.0, "0.5 to 100")?;
        in_range(
            "widest_at",
            self.widest_at,
            ABOVE_0..=BELOW_1,
            "0 to 1, both excluded",
        )?;
        in_range(
            "falloff",
            self.falloff,
            ABOVE_0..=100.0,
            "0 (excluded) to 100",
        )?;
        in_range("lobe_decay", self.lobe_decay, 0.0..=100.0, "0 to 100")?;
        in_range(
            "lobe_exponent",
            self.lobe_exponent,
            ABOVE_0..=10.0,
            "0 (excluded) to 10",
        )?;
        let mut rows: Vec<(usize, f64)> = Vec::with_capacity(self.veins.len());
        for (index, vein) in self.veins.iter().enumerate() {
            in_range("veins.position", vein.position, 0.0..=1.0, "0 to 1")?;
            in_range("veins.slope", vein.slope, -20.0..=20.0, "-20 to 20")?;
            let row = self.row_at(vein.position);
            if rows.last().is_some_and(|&(before, _)| row <= before) {
                return Err(GrowthShapeError::VeinOrder {
                    index,
                    row: row + 1,
                });
            }
            rows.push((row, vein.slope));
        }
        Ok(rows)
    }

    /// The row, from 0, at a place along the midrib. The paper's `j / N` would give the two ends of the midrib
    /// unlike treatment; `j = 1 + round(y (N − 1))` makes `yd` and `1 − yd` exact mirror images.
    pub(super) fn row_at(&self, position: f64) -> usize {
        // Halves go to the even row, so that y and 1 − y round alike for an odd number of gaps too.
        (position * (self.rows - 1) as f64).round_ties_even() as usize
    }
}

/// The least number above 0 that a parameter which excludes 0 may take, and the like below 1.
const ABOVE_0: f64 = 1e-6;
const BELOW_1: f64 = 1.0 - 1e-6;

/// `value` must lie in `range`, which NaN never does.
fn in_range(
    key: &'static str,
    value: f64,
    range: std::ops::RangeInclusive<f64>,
    words: &'static str,
) -> Result<(), GrowthShapeError> {
    if range.contains(&value) {
        Ok(())
    } else {
        Err(GrowthShapeError::OutOfRange {
            key,
            value,
            range: words,
        })
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use proptest::test_runner::RngSeed;

    use super::*;

    /// Spoils one parameter.
    type Break = fn(&mut GrowthShape);

    /// Fig. 3b.
    fn ovate() -> GrowthShape {
        GrowthShape {
            rows: 150,
            axial_rate: 0.1,
            rate_ratio: 1.2,
            widest_at: 0.3,
            falloff: 2.5,
            lobe_decay: 0.0,
            lobe_exponent: 1.0,
            veins: Vec::new(),
        }
    }

    fn grown(shape: &GrowthShape) -> Outline {
        shape.grow(100.0).expect("a shape of the paper")
    }

    fn size(shape: &GrowthShape) -> DVec2 {
        let (low, high) = grown(shape).bounds();
        high - low
    }

    /// Five veins a side, as the paper's paired values of `a` for its Figs. 7 and 8 suggest.
    fn five_veins(slope: f64) -> Vec<VeinRow> {
        [14, 44, 74, 104, 134]
            .map(|row| VeinRow {
                position: f64::from(row) / 149.0,
                slope,
            })
            .to_vec()
    }

    /// Share of its convex hull that the outline fills.
    fn solidity(outline: &Outline) -> f64 {
        let measures = crate::measure::shape(outline);
        measures.number("solidity").expect("every outline has one")
    }

    #[test]
    fn a_larger_ratio_of_rates_makes_a_narrower_leaf() {
        // Fig. 3: width over height, from the closed form 2 · 1000^(ln(1 + gy/R) / ln(1 + gy) − 1).
        for (ratio, expected) in [(1.07, 1.298), (1.2, 0.661), (1.5, 0.215), (1.71, 0.123)] {
            let size = size(&GrowthShape {
                rate_ratio: ratio,
                ..ovate()
            });
            let aspect = size.x / size.y;
            assert!((aspect - expected).abs() < 0.0006, "R = {ratio}: {aspect}");
        }
    }

    #[test]
    fn the_margin_turns_from_concave_to_convex_as_growth_falls_off_later() {
        // Fig. 5, area over that of the convex hull.
        for (falloff, expected) in [(1.0, 0.352), (1.5, 0.565), (3.0, 0.849), (9.0, 0.970)] {
            let filled = solidity(&grown(&GrowthShape {
                widest_at: 0.5,
                falloff,
                ..ovate()
            }));
            assert!((filled - expected).abs() < 0.003, "k = {falloff}: {filled}");
        }
    }

    #[test]
    fn lobes_deepen_with_the_decay_and_vanish_without_it() {
        // Fig. 7: circularity 4πA/P² of the four oaks.
        for (decay, expected) in [
            (0.0, 0.633),
            (0.0001, 0.592),
            (0.0003, 0.450),
            (0.0008, 0.248),
        ] {
            let outline = grown(&GrowthShape {
                falloff: 3.0,
                lobe_decay: decay,
                lobe_exponent: 2.0,
                veins: five_veins(0.7),
                ..ovate()
            });
            let round = 4.0 * std::f64::consts::PI * outline.area() / outline.perimeter().powi(2);
            assert!((round - expected).abs() < 0.01, "a = {decay}: {round}");
        }
    }

    #[test]
    fn lobes_of_an_obcordate_leaf_pass_its_tip() {
        // Fig. 6d: 1.55 of the midrib's length.
        let vein = VeinRow {
            position: 0.5,
            slope: 3.0,
        };
        let height = size(&GrowthShape {
            widest_at: 0.5,
            falloff: 3.0,
            veins: vec![vein],
            ..ovate()
        })
        .y;
        assert!((height / 100.0 - 1.55).abs() < 0.01, "{height}");
    }

    #[test]
    fn deltoid_and_obdeltoid_are_mirror_images() {
        // Figs. 4a and 4d.
        let at = |widest_at| {
            grown(&GrowthShape {
                widest_at,
                ..ovate()
            })
        };
        let (low, high) = (at(0.1), at(0.9));
        let turned = low.points().iter().map(|p| DVec2::new(p.x, 100.0 - p.y));
        for p in turned {
            let nearest = high
                .points()
                .iter()
                .map(|q| (*q - p).length())
                .fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-9, "{p} has no partner");
        }
    }

    #[test]
    fn rows_that_pass_over_each_other_are_merged() {
        let shape = GrowthShape {
            rate_ratio: 1.1,
            veins: vec![
                VeinRow {
                    position: 0.2,
                    slope: 2.0,
                },
                VeinRow {
                    position: 0.6,
                    slope: -2.0,
                },
            ],
            ..ovate()
        };
        let veins = shape.checked_veins().expect("in range");
        let raw: Vec<DVec2> = std::iter::once(DVec2::ZERO)
            .chain(shape.margin(&veins))
            .chain([DVec2::new(0.0, 1000.0)])
            .collect();
        let crossed = Outline::new(raw, DVec2::ZERO, DVec2::new(0.0, 1000.0));
        assert!(
            matches!(crossed, Err(OutlineError::SelfCrossing { .. })),
            "this test needs rows that cross"
        );
        assert!(grown(&shape).area() > 0.0);
    }

    #[test]
    fn every_bad_parameter_is_named() {
        let break_one: [(&str, Break); 9] = [
            ("rows", |s| s.rows = 2),
            ("axial_rate", |s| s.axial_rate = 0.0),
            ("rate_ratio", |s| s.rate_ratio = f64::NAN),
            ("widest_at", |s| s.widest_at = 1.0),
            ("falloff", |s| s.falloff = 0.0),
            ("lobe_decay", |s| s.lobe_decay = -0.1),
            ("lobe_exponent", |s| s.lobe_exponent = f64::INFINITY),
            ("veins.position", |s| s.veins[0].position = -0.1),
            ("veins.slope", |s| s.veins[1].slope = 21.0),
        ];
        for (expected, change) in break_one {
            let mut shape = GrowthShape {
                veins: five_veins(0.7),
                ..ovate()
            };
            change(&mut shape);
            match shape.grow(80.0) {
                Err(GrowthShapeError::OutOfRange { key, .. }) => assert_eq!(key, expected),
                other => panic!("{expected}: {other:?}"),
            }
        }
        assert!(ovate().grow(0.0).is_err());
        let mut shape = GrowthShape {
            veins: five_veins(0.7),
            ..ovate()
        };
        shape.veins.swap(0, 1);
        assert!(matches!(
            shape.grow(80.0),
            Err(GrowthShapeError::VeinOrder { index: 1, .. })
        ));
    }

    proptest! {
        #![proptest_config(ProptestConfig { rng_seed: RngSeed::Fixed(2005), failure_persistence: None, ..ProptestConfig::with_cases(256) })]

        #[test]
        fn no_parameters_bring_forth_a_crossing_margin(
            rate_ratio in 0.9..2.0, widest_at in 0.05..0.95, falloff in 0.5..9.0,
            lobe_decay in 0.0..0.02, lobe_exponent in 0.5..2.0,
            veins in proptest::collection::vec((0.0..1.0, -4.0..4.0), 0..6),
        ) {
            let mut veins: Vec<VeinRow> = veins
                .into_iter()
                .map(|(position, slope)| VeinRow { position, slope })
                .collect();
            veins.sort_by(|p, q| p.position.total_cmp(&q.position));
            veins.dedup_by(|p, q| (p.position - q.position).abs() < 0.02);
            let shape = GrowthShape {
                rate_ratio, widest_at, falloff, lobe_decay, lobe_exponent, veins, ..ovate()
            };
            // `Outline::new` refuses every crossing, so an outline is the proof.
            let outline = shape.grow(80.0);
            prop_assert!(outline.is_ok(), "{outline:?}");
        }
    }
}
