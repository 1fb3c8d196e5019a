//! Sixteen numbers at a time, for bounds that leave room for roundings: the tests of boxes.
//!
//! Results need not have the same bits at every level: each takes its quickest instructions.

use super::eight::{Eight, LANES, Row};

/// Number of lanes of a wide row.
pub(crate) const WIDE: usize = 2 * LANES;

/// Two rows, aligned for the widest unit.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub(crate) struct WideRow([Row; 2]);

impl WideRow {
    /// The same number in every lane.
    pub(crate) fn splat(value: f32) -> Self {
        Self([Row([value; LANES]); 2])
    }

    /// The number in a lane.
    #[inline(always)]
    pub(crate) fn get(&self, lane: usize) -> f32 {
        self.0[lane / LANES].0[lane % LANES]
    }

    /// Sets the number in a lane.
    pub(crate) fn set(&mut self, lane: usize, value: f32) {
        self.0[lane / LANES].0[lane % LANES] = value;
    }
}

/// The operations on wide rows, by the instructions of one level. The order of −0 among other
/// numbers depends on the level.
pub(crate) trait Sixteen: Eight {
    /// Sixteen numbers in registers.
    type W: Copy;

    /// The same number in every lane.
    fn splat_wide(self, value: f32) -> Self::W;
    /// A wide row from memory.
    fn load_wide(self, row: &WideRow) -> Self::W;
    /// The wide row in memory.
    fn store_wide(self, row: Self::W) -> WideRow;
    /// `a · b + c`, rounded once where the level has such an instruction, else twice.
    fn mul_add_roughly(self, a: Self::W, b: Self::W, c: Self::W) -> Self::W;
    /// The greater number. Where both are negative, or one is NaN, either.
    fn greater_roughly(self, a: Self::W, b: Self::W) -> Self::W;
    /// The lesser number. Where one is negative, a negative one; where one is NaN, either.
    fn less_roughly(self, a: Self::W, b: Self::W) -> Self::W;
    /// Bit `i` is set where `a ≤ b` in lane `i`. `a` is not negative there, and neither is NaN.
    fn at_most_roughly(self, a: Self::W, b: Self::W) -> u32;
}

/// A level whose unit has no more than eight lanes: wide rows are two halves.
pub(super) trait Halves: Eight {
    /// As [`Sixteen::mul_add_roughly`].
    #[inline(always)]
    fn mul_add_half(self, a: Self::F, b: Self::F, c: Self::F) -> Self::F {
        self.add(self.mul(a, b), c)
    }

    /// As [`Sixteen::greater_roughly`].
    #[inline(always)]
    fn greater_half(self, a: Self::F, b: Self::F) -> Self::F {
        self.greater(a, b)
    }

    /// As [`Sixteen::less_roughly`].
    #[inline(always)]
    fn less_half(self, a: Self::F, b: Self::F) -> Self::F {
        self.less(a, b)
    }

    /// As [`Sixteen::at_most_roughly`].
    #[inline(always)]
    fn at_most_half(self, a: Self::F, b: Self::F) -> u32 {
        self.at_most(a, b)
    }
}

impl<E: Halves> Sixteen for E {
    type W = [E::F; 2];

    #[inline(always)]
    fn splat_wide(self, value: f32) -> Self::W {
        [self.splat(value); 2]
    }

    #[inline(always)]
    fn load_wide(self, row: &WideRow) -> Self::W {
        [self.load(&row.0[0]), self.load(&row.0[1])]
    }

    #[inline(always)]
    fn store_wide(self, row: Self::W) -> WideRow {
        WideRow([self.store(row[0]), self.store(row[1])])
    }

    #[inline(always)]
    fn mul_add_roughly(self, a: Self::W, b: Self::W, c: Self::W) -> Self::W {
        [
            self.mul_add_half(a[0], b[0], c[0]),
            self.mul_add_half(a[1], b[1], c[1]),
        ]
    }

    #[inline(always)]
    fn greater_roughly(self, a: Self::W, b: Self::W) -> Self::W {
        [self.greater_half(a[0], b[0]), self.greater_half(a[1], b[1])]
    }

    #[inline(always)]
    fn less_roughly(self, a: Self::W, b: Self::W) -> Self::W {
        [self.less_half(a[0], b[0]), self.less_half(a[1], b[1])]
    }

    #[inline(always)]
    fn at_most_roughly(self, a: Self::W, b: Self::W) -> u32 {
        self.at_most_half(a[0], b[0]) | self.at_most_half(a[1], b[1]) << LANES
    }
}

/// A computation that can be run at any level.
pub(crate) trait Task {
    /// Its result.
    type Output;

    /// Runs it. Implementations must be `#[inline(always)]`, and so must all functions that they
    /// call with `eight`.
    fn run<E: Sixteen>(self, eight: E) -> Self::Output;
}

#[cfg(test)]
mod tests {
    use super::super::Level;
    use super::*;

    /// `a · b + c`, the greater and the lesser of `a` and `b`, and where `a ≤ b`.
    struct Operations([WideRow; 3]);

    impl Task for Operations {
        type Output = ([WideRow; 3], u32);

        #[inline(always)]
        fn run<E: Sixteen>(self, e: E) -> Self::Output {
            let [a, b, c] = [
                e.load_wide(&self.0[0]),
                e.load_wide(&self.0[1]),
                e.load_wide(&self.0[2]),
            ];
            let rows = [
                e.store_wide(e.mul_add_roughly(a, b, c)),
                e.store_wide(e.greater_roughly(a, b)),
                e.store_wide(e.less_roughly(a, b)),
            ];
            (rows, e.at_most_roughly(a, b))
        }
    }

    fn row(of_lane: impl Fn(usize) -> f32) -> WideRow {
        let mut row = WideRow::splat(0.0);
        for lane in 0..WIDE {
            row.set(lane, of_lane(lane));
        }
        row
    }

    #[test]
    fn a_rough_sum_is_off_by_one_rounding_of_product_and_sum_at_most() {
        for step in 1..200 {
            let seed = step as f32 * 0.37;
            let of = |seed: f32| row(|lane| libm::sinf(seed * (1 + lane) as f32) * 3.0);
            let rows = [of(seed), of(seed + 1.1), of(seed + 2.3)];
            for level in Level::all() {
                let ([sum, ..], _) = level.run(Operations(rows));
                for lane in 0..WIDE {
                    let [x, y, z] = rows.map(|row| f64::from(row.get(lane)));
                    let exact = x * y + z;
                    let allowed = (x * y).abs().max(exact.abs()) * 2.0 * 2.0_f64.powi(-24);
                    let off = (f64::from(sum.get(lane)) - exact).abs();
                    assert!(
                        off <= allowed,
                        "{}: off by {off:e} of {exact}",
                        level.name()
                    );
                }
            }
        }
    }

    #[test]
    fn numbers_are_ordered_at_every_level_as_far_as_is_promised() {
        let odd = [
            0.0,
            -0.0,
            1.0,
            -3.5,
            f32::INFINITY,
            f32::NEG_INFINITY,
            1e-42,
            -1e-42,
            f32::MAX,
            0.1,
            -0.1,
        ];
        let mut orders = 0;
        for (shift, level) in
            (0..odd.len()).flat_map(|shift| Level::all().into_iter().map(move |l| (shift, l)))
        {
            let a = row(|lane| odd[lane % odd.len()]);
            let b = row(|lane| odd[(lane * 3 + shift) % odd.len()]);
            let ([_, greater, less], at_most) = level.run(Operations([a, b, b]));
            for lane in 0..WIDE {
                let [a, b, greater, less] = [a, b, greater, less].map(|row| row.get(lane));
                let of = format!("{} on {a} and {b}", level.name());
                if [a, b].iter().any(|number| number.to_bits() == 1 << 31) {
                    continue;
                }
                orders += 1;
                if a < 0.0 && b < 0.0 {
                    assert!(greater == a || greater == b, "{of}");
                } else {
                    assert_eq!(greater, a.max(b), "{of}");
                }
                if a < 0.0 || b < 0.0 {
                    assert!(less < 0.0 && (less == a || less == b), "{of}");
                } else {
                    assert_eq!(less, a.min(b), "{of}");
                }
                if a >= 0.0 {
                    assert_eq!(at_most >> lane & 1 == 1, a <= b, "{of}");
                }
            }
        }
        assert!(orders > 100, "{orders} pairs in order");
    }
}
