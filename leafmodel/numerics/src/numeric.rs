//! Numbers: roots by bisection, smooth steps, and sets of numbers that join.

/// Halves the interval from `low` to `high` so many times; `is_low` holds at `low`, not at `high`, and
/// of each new end.
#[inline]
pub fn bisect(
    mut low: f64,
    mut high: f64,
    halvings: usize,
    mut is_low: impl FnMut(f64) -> bool,
) -> (f64, f64) {
    for _ in 0..halvings {
        let middle = f64::midpoint(low, high);
        if is_low(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    (low, high)
}

/// 0 below 0, 1 above 1, `3x² − 2x³` between.
#[inline]
pub fn smooth_step(x: f64) -> f64 {
    let x = x.clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

/// Weights of the value before, at and behind the nearest of even places, for a smooth curve through
/// the middles between them; `t` is the way from that place, −½ to ½.
#[inline]
pub fn spline_weights(t: f64) -> [f64; 3] {
    [
        0.5 * (0.5 - t) * (0.5 - t),
        0.75 - t * t,
        0.5 * (0.5 + t) * (0.5 + t),
    ]
}

/// The number at a share of the way from one to another.
#[inline]
pub fn between(from: f64, to: f64, share: f64) -> f64 {
    from + (to - from) * share
}

/// Disjoint sets of numbers from 0.
pub struct Sets(Vec<u32>);

impl Sets {
    /// Each number is a set of its own.
    #[inline]
    pub fn new(count: usize) -> Self {
        Self((0..count as u32).collect())
    }

    /// The number that represents the set of another.
    #[inline]
    pub fn leader(&mut self, mut of: u32) -> u32 {
        while self.0[of as usize] != of {
            self.0[of as usize] = self.0[self.0[of as usize] as usize];
            of = self.0[of as usize];
        }
        of
    }

    /// Joins two sets; returns the leader that remains, the smaller one, and the one that does not,
    /// or `None` if they were the same set.
    #[inline]
    pub fn join(&mut self, a: u32, b: u32) -> Option<(u32, u32)> {
        let (a, b) = (self.leader(a), self.leader(b));
        let (stays, goes) = (a.min(b), a.max(b));
        self.0[goes as usize] = stays;
        (stays != goes).then_some((stays, goes))
    }

    /// Puts the set of the leader `under` below the leader `above`.
    #[inline]
    pub fn attach(&mut self, under: u32, above: u32) {
        self.0[under as usize] = above;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_interval_closes_in_on_the_root() {
        let (low, high) = bisect(1.0, 2.0, 60, |x| x * x < 2.0);
        assert!(low * low < 2.0 && high * high >= 2.0 && high - low < 1e-15);
    }

    #[test]
    fn a_step_is_level_at_its_ends_and_odd_about_its_middle() {
        assert_eq!(
            [-1.0, 0.0, 0.5, 1.0, 3.0].map(smooth_step),
            [0.0, 0.0, 0.5, 1.0, 1.0]
        );
        assert!((smooth_step(0.3) + smooth_step(0.7) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn sets_join_under_their_smallest_number() {
        let mut sets = Sets::new(5);
        assert_eq!(sets.join(3, 1), Some((1, 3)));
        assert_eq!(sets.join(4, 3), Some((1, 4)));
        assert_eq!(sets.join(1, 4), None);
        assert_eq!([0, 1, 2, 3, 4].map(|of| sets.leader(of)), [0, 1, 2, 1, 1]);
        sets.attach(0, 2);
        assert_eq!(sets.leader(0), 2);
    }
}
