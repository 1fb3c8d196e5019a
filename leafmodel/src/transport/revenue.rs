//! The revenue of a cell: `ε`, the same everywhere or varied by uneven light (Remark 3.6 of
//! \[xia2007\]).

use super::cells::Cell;
use crate::numeric::smooth_step;
use crate::random::{Use, uniform};

/// The revenue of each cell, as a factor on `ε`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Revenue {
    /// Greatest deviation from 1, at least 0, below 1.
    pub(crate) noise: f64,
    /// Width of patches of light and shadow in cells, ≥ 1.
    pub(crate) patch: f64,
    pub(crate) seed: u64,
}

impl Revenue {
    /// Whether every cell has the same revenue.
    pub(crate) fn is_uniform(&self) -> bool {
        self.noise == 0.0
    }

    /// Upper bound of the factor.
    pub(crate) fn greatest(&self) -> f64 {
        1.0 + self.noise
    }

    /// The factor of one cell: value noise, that is, random numbers on a lattice with spacing
    /// `patch`, smoothly interpolated.
    pub(crate) fn of(&self, cell: Cell) -> f64 {
        if self.is_uniform() {
            return 1.0;
        }
        let (m, n) = (
            f64::from(cell.m) / self.patch,
            f64::from(cell.n) / self.patch,
        );
        let (left, low) = (m.floor(), n.floor());
        let (right, up) = (smooth_step(m - left), smooth_step(n - low));
        let corner = |dm: i32, dn: i32| {
            let (m, n) = (left as i32 + dm, low as i32 + dn);
            let counter = u64::from(m as u32) << 32 | u64::from(n as u32);
            2.0 * uniform(self.seed, Use::Light, counter) - 1.0
        };
        let along = |dn: i32| corner(0, dn) * (1.0 - right) + corner(1, dn) * right;
        1.0 + self.noise * (along(0) * (1.0 - up) + along(1) * up)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_stays_within_its_bounds_averages_to_one_and_varies_over_patches() {
        let revenue = Revenue {
            noise: 0.4,
            patch: 5.0,
            seed: 2005,
        };
        let cells = || (-100..100).flat_map(|m| (-100..100).map(move |n| Cell::new(m, n)));
        let (mut sum, mut steepest) = (0.0, 0.0_f64);
        for cell in cells() {
            let factor = revenue.of(cell);
            assert!((0.6..=1.4).contains(&factor));
            sum += factor;
            let next = revenue.of(cell + Cell::UP);
            steepest = steepest.max((next - factor).abs());
        }
        // 1600 patches; the interpolated noise of one has a standard deviation below 0.4/√3.
        assert!((sum / 40_000.0 - 1.0).abs() < 3.0 * 0.231 / 40.0);
        // Two corners differ by at most 2 · 0.4, over five cells, 1.5 times as steep in the middle.
        assert!(steepest <= 0.8 * 1.5 / 5.0 + 1e-12, "{steepest}");
        let even = Revenue {
            noise: 0.0,
            ..revenue
        };
        assert!(cells().all(|cell| even.of(cell) == 1.0));
    }
}
