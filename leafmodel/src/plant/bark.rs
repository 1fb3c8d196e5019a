//! Relief of bark: ridges along an axis, and lenticels, the pores through which it breathes.
//!
//! Heights stand on the round axis. Ridges are noise over the unrolled surface, eight times as long
//! as wide, folded at its middle into crests; lenticels are oval mounds at random places, one at most
//! in each cell of a lattice. By eye: nothing here grows.
//!
//! - **In**: the numbers of the relief; length and greatest radius of an axis.
//! - **Out**: the height at each way along it and turn about it.
//! - **Always true**: heights are at least 0, the same at a turn and one full turn farther, and 0 at
//!   both ends of an axis; together they are at most [`MOST_OF_RADIUS`] of the radius.

use std::f64::consts::{PI, TAU};

use crate::document::{Declared, Keys};
use crate::numeric::{between, smooth_step};
use crate::random::{Use, uniform};

/// Greatest height over the radius of the axis there, so that thin twigs keep their form.
const MOST_OF_RADIUS: f64 = 0.3;
/// How much longer ridges are than wide.
const ELONGATION: f64 = 8.0;
/// Share of cells over which lenticels come and go as the radius changes.
const FADE: f64 = 0.05;
/// Fewest ridges around an axis.
const FEWEST_RIDGES: f64 = 3.0;

/// The relief of the axes of a plant.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
#[key(last = not_crowded)]
pub struct BarkRelief {
    /// Height of the ridges along an axis over the furrows between them.
    #[key("ridges_mm", 0.0..=20.0)]
    pub ridges_mm: f64,
    /// Distance from ridge to ridge around the thickest part of an axis; they are eight times as
    /// long.
    #[key("ridge_width_mm", 0.1..=100.0)]
    pub ridge_width_mm: f64,
    /// Lenticels, the pores of bark, on a square centimetre.
    #[key("lenticels_per_cm2", 0.0..=200.0)]
    pub lenticels_per_cm2: f64,
    /// Their lengths across and along the axis.
    #[key("lenticel_mm", 0.1..=50.0)]
    pub lenticel_mm: [f64; 2],
    /// Their height.
    #[key("lenticel_height_mm", 0.0..=5.0)]
    pub lenticel_height_mm: f64,
    /// About the longest edge of the mesh along and around an axis.
    #[key("edge_mm", 0.02..=20.0)]
    pub edge_mm: f64,
}

/// Reports lenticels that would cover all of the bark.
fn not_crowded(relief: &BarkRelief, keys: &Keys<'_>) {
    if keys.is_sound() && relief.is_crowded() {
        let problem = "so many of that size would cover all of the bark".to_owned();
        let help = "use fewer, or smaller ones by `lenticel_mm`";
        keys.refuse(&["lenticels_per_cm2"], problem, help);
    }
}

impl BarkRelief {
    /// A smooth twig with lenticels across, as of birch and cherry.
    pub const USUAL: Self = Self {
        ridges_mm: 0.08,
        ridge_width_mm: 0.8,
        lenticels_per_cm2: 14.0,
        lenticel_mm: [1.1, 0.6],
        lenticel_height_mm: 0.16,
        edge_mm: 0.15,
    };

    /// Whether lenticels would cover all of the bark if none lay on another.
    pub(crate) fn is_crowded(&self) -> bool {
        let [across, along] = self.lenticel_mm;
        self.lenticels_per_cm2 * 0.25 * PI * across * along >= 100.0
    }
}

/// The relief of one axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct AxisRelief {
    relief: BarkRelief,
    seed: u64,
    /// Number of the axis within the plant.
    number: u64,
    length: f64,
    widest: f64,
}

impl AxisRelief {
    pub(super) fn new(
        relief: BarkRelief,
        (seed, number): (u64, u64),
        (length, widest): (f64, f64),
    ) -> Self {
        Self {
            relief,
            seed,
            number,
            length,
            widest,
        }
    }

    /// Height over the round axis at a way from its foot, mm, and a turn about it, radians, where it
    /// has this radius.
    pub(super) fn height(&self, way: f64, turn: f64, radius: f64) -> f64 {
        let relief = &self.relief;
        let has_lenticels = f64::from(u8::from(relief.lenticels_per_cm2 > 0.0));
        let most = relief.ridges_mm + has_lenticels * relief.lenticel_height_mm;
        if most <= 0.0 {
            return 0.0;
        }
        let to_end = way.min(self.length - way).max(0.0);
        let ramp = smooth_step((to_end / (2.0 * self.widest)).min(1.0));
        let fits = (MOST_OF_RADIUS * radius / most).min(1.0);
        ramp * fits * (self.ridge(way, turn) + self.lenticel(way, turn, radius))
    }

    /// A number of a cell of a lattice, in [0, 1).
    fn chance(&self, kind: u64, row: i64, column: i64) -> f64 {
        let cell = (row as u64 & 0xff_ffff) << 16 | (column as u64 & 0xffff);
        uniform(
            self.seed,
            Use::Bark,
            (self.number << 44) ^ (kind << 40) ^ cell,
        )
    }

    fn ridge(&self, way: f64, turn: f64) -> f64 {
        let relief = &self.relief;
        if relief.ridges_mm <= 0.0 {
            return 0.0;
        }
        // A crest and a furrow to each pair of cells.
        let count = (TAU * self.widest / relief.ridge_width_mm).round();
        let around = (2.0 * count.max(FEWEST_RIDGES)) as i64;
        let across = turn.rem_euclid(TAU) / TAU * around as f64;
        let along = way / (ELONGATION * relief.ridge_width_mm);
        let (row, column) = (along.floor(), across.floor());
        let at =
            |row: f64, column: f64| self.chance(0, row as i64, (column as i64).rem_euclid(around));
        let [up, aside] = [along - row, across - column].map(smooth_step);
        let near = between(at(row, column), at(row, column + 1.0), aside);
        let far = between(at(row + 1.0, column), at(row + 1.0, column + 1.0), aside);
        relief.ridges_mm * (1.0 - (2.0 * between(near, far, up) - 1.0).abs())
    }

    fn lenticel(&self, way: f64, turn: f64, radius: f64) -> f64 {
        let relief = &self.relief;
        if relief.lenticels_per_cm2 <= 0.0 || relief.lenticel_height_mm <= 0.0 {
            return 0.0;
        }
        let cell = 10.0 / relief.lenticels_per_cm2.sqrt();
        let around = (TAU * self.widest / cell).ceil().max(1.0);
        // Where an axis tapers cells are narrower, and fewer of them have one.
        let width = TAU * radius / around;
        let share = width / cell;
        let half = relief.lenticel_mm.map(|length| 0.5 * length);
        let [aside, up] = [half[0] / width, half[1] / cell].map(|cells| cells.ceil() as i64);
        // No farther than to the other side of the axis.
        let aside = aside.min(around as i64 / 2);
        let (row, column) = (
            (way / cell).floor() as i64,
            (turn.rem_euclid(TAU) / TAU * around).floor() as i64,
        );
        let mut most = 0.0_f64;
        for row in row - up..=row + up {
            for column in column - aside..=column + aside {
                let column = column.rem_euclid(around as i64);
                let ready = share - self.chance(1, row, column);
                if ready <= 0.0 {
                    continue;
                }
                // Where the radius changes lenticels fade instead of breaking off.
                let grown = (ready / FADE).min(1.0);
                let middle = (row as f64 + self.chance(2, row, column)) * cell;
                let aim = (column as f64 + self.chance(3, row, column)) / around * TAU;
                let apart = (turn - aim + PI).rem_euclid(TAU) - PI;
                let across = apart * radius / half[0];
                let along = (way - middle) / half[1];
                let inside = 1.0 - across * across - along * along;
                most = most.max(grown * inside.max(0.0));
            }
        }
        relief.lenticel_height_mm * most * (2.0 - most)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LENGTH: f64 = 1000.0;

    fn of(relief: BarkRelief, widest: f64) -> AxisRelief {
        AxisRelief::new(relief, (3, 1), (LENGTH, widest))
    }

    #[test]
    fn heights_close_around_the_axis_and_stay_within_its_radius() {
        // One cell of the lattice around the axis, two, and more; short lenticels and long ones.
        for (widest, lenticel_mm) in [
            (0.3, [1.1, 0.6]),
            (0.8, [1.1, 0.6]),
            (2.0, [1.1, 0.6]),
            (2.0, [8.0, 0.5]),
        ] {
            let relief = BarkRelief {
                ridges_mm: 1.0,
                lenticel_height_mm: 1.0,
                lenticel_mm,
                ..BarkRelief::USUAL
            };
            let axis = of(relief, widest);
            let radius = |way: f64| widest * (1.0 - 0.0025 * way);
            let mut highest = 0.0_f64;
            for step in 0..20_000 {
                let (way, turn) = (0.01 * f64::from(step), 0.37 * f64::from(step));
                let height = axis.height(way, turn, radius(way));
                let most = MOST_OF_RADIUS * radius(way);
                assert!((0.0..=most).contains(&height), "{height}");
                let around = axis.height(way, turn + TAU, radius(way));
                assert!((around - height).abs() < 1e-9);
                for (on, aside) in [(0.0, 1e-6), (1e-6, 0.0)] {
                    let near = axis.height(way + on, turn + aside, radius(way + on));
                    assert!((near - height).abs() < 1e-3, "a step at {way} {turn}");
                }
                highest = highest.max(height);
            }
            assert!(highest > 0.1 * widest, "{highest}");
            let ends = [0.0, LENGTH].map(|way| axis.height(way, 1.0, widest));
            assert_eq!(ends, [0.0; 2]);
        }
    }

    #[test]
    fn there_are_as_many_lenticels_as_is_asked() {
        let relief = BarkRelief {
            ridges_mm: 0.0,
            lenticels_per_cm2: 20.0,
            lenticel_mm: [0.4, 0.4],
            ..BarkRelief::USUAL
        };
        for (widest, radius) in [(2.0, 2.0), (2.0, 1.0), (0.85, 0.85)] {
            let axis = of(relief, widest);
            // Share of the surface that lies on one, of middles 0.4 mm wide: π 0.2² each.
            let (steps, sides) = (6000, 100);
            let mut covered = 0;
            for step in 0..steps {
                let way = 10.0 + 980.0 * f64::from(step) / f64::from(steps);
                for side in 0..sides {
                    let turn = TAU * f64::from(side) / f64::from(sides);
                    covered += u32::from(axis.height(way, turn, radius) > 0.0);
                }
            }
            let share = f64::from(covered) / f64::from(steps * sides);
            let expected = 0.2 * PI * 0.2 * 0.2;
            assert!(
                (share / expected - 1.0).abs() < 0.15,
                "{widest} {radius}: {share} {expected}"
            );
        }
    }
}
