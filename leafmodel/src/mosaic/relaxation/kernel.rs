//! The repulsion of a cell by many others: the innermost loop.
//!
//! It uses single precision, with places relative to the block and in units of the radius. Seven
//! digits are enough for a force whose direction is partly random, and twice as many numbers fit
//! into a register. Only sums, products, a root and a quotient occur, each rounded by IEEE 754 and
//! in a fixed order, so the bits are the same on every machine.

/// Number of cells processed in parallel.
const LANES: usize = 8;

/// A distance greater than that of any cell.
const FAR: f32 = 1e9;

/// Squared distance, in radii, below which two cells do not push each other, which also excludes
/// the cell itself.
const NEAREST: f32 = 1e-20;

/// Places of cells, padded to whole lanes.
#[derive(Debug, Default)]
pub(super) struct Places {
    xs: Vec<f32>,
    ys: Vec<f32>,
}

impl Places {
    pub(super) fn clear(&mut self) {
        self.xs.clear();
        self.ys.clear();
    }

    pub(super) fn push(&mut self, x: f32, y: f32) {
        self.xs.push(x);
        self.ys.push(y);
    }

    pub(super) fn pad(&mut self) {
        while !self.xs.len().is_multiple_of(LANES) {
            self.push(FAR, FAR);
        }
    }

    /// `Σ (1 − d) e` over the cells nearer than 1, with `d` their distance and `e` the unit vector
    /// away from them.
    pub(super) fn repulsion(&self, x: f32, y: f32) -> (f32, f32) {
        let (mut fx, mut fy) = ([0.0_f32; LANES], [0.0_f32; LANES]);
        let (xs, _) = self.xs.as_chunks::<LANES>();
        let (ys, _) = self.ys.as_chunks::<LANES>();
        for (xs, ys) in xs.iter().zip(ys) {
            for lane in 0..LANES {
                let (dx, dy) = (x - xs[lane], y - ys[lane]);
                let squared = (dx * dx + dy * dy).max(NEAREST);
                // (1 − d)/d, and 0 beyond 1.
                let push = (1.0 / squared.sqrt() - 1.0).max(0.0);
                fx[lane] += dx * push;
                fy[lane] += dy * push;
            }
        }
        (sum(fx), sum(fy))
    }

    /// `Σ (1 − d)²/2` over the cells nearer than 1, the cell itself (at distance 0) included.
    #[cfg(test)]
    pub(super) fn energy(&self, x: f32, y: f32) -> f64 {
        let pairs = self.xs.iter().zip(&self.ys);
        let energy = pairs.map(|(&other_x, &other_y)| {
            let (dx, dy) = (f64::from(x - other_x), f64::from(y - other_y));
            let overlap = (1.0 - (dx * dx + dy * dy).sqrt()).max(0.0);
            0.5 * overlap * overlap
        });
        energy.sum()
    }
}

/// The sum by halves, as vector units compute it.
fn sum(lanes: [f32; LANES]) -> f32 {
    let [a, b, c, d, e, f, g, h] = lanes;
    ((a + e) + (c + g)) + ((b + f) + (d + h))
}
