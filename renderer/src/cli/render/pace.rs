//! How often something is done beside a render, and what it has cost.

use std::time::{Duration, Instant};

/// It may take one part in so many of the time.
const FRACTION: u32 = 50;

/// Time for some blocks of pixels in between, however often it is asked for.
const SHORTEST: Duration = Duration::from_millis(50);

/// The pace of what is done beside a render.
#[derive(Debug)]
pub(super) struct Pace {
    every: Duration,
    /// See [`SHORTEST`]; tests are less patient.
    pub(super) shortest: Duration,
    /// When it was last tried.
    pub(super) last: Instant,
    /// What it took then.
    cost: Duration,
    /// What it took in all.
    pub(super) seconds: f64,
}

impl Pace {
    pub(super) fn new(every: Duration) -> Self {
        Self {
            every,
            shortest: SHORTEST,
            last: Instant::now(),
            cost: Duration::ZERO,
            seconds: 0.0,
        }
    }

    /// Whether it is time, which comes sooner if somebody asks for it.
    pub(super) fn is_due(&self, is_asked_for: bool) -> bool {
        let since = self.last.elapsed();
        since >= self.shortest && (is_asked_for || since >= self.every.max(self.cost * FRACTION))
    }

    /// It was done, begun at a time.
    pub(super) fn add(&mut self, started: Instant) {
        self.cost = started.elapsed();
        self.last = Instant::now();
        self.seconds += self.cost.as_secs_f64();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_takes_at_most_a_fiftieth_of_the_time() {
        let ago = |millis: u64| Instant::now().checked_sub(Duration::from_millis(millis));
        let is_due = |cost: u64, since: u64, every: u64| {
            let mut pace = Pace::new(Duration::from_millis(every));
            pace.cost = Duration::from_millis(cost);
            pace.last = ago(since).expect("the machine has been up for a minute");
            pace.is_due(false)
        };
        assert!(is_due(0, 5100, 5000));
        assert!(!is_due(0, 4000, 5000));
        // 200 ms every ten seconds, however often it is asked for.
        assert!(!is_due(200, 9000, 5000));
        assert!(!is_due(200, 9000, 0));
        assert!(is_due(200, 10_100, 0));
    }
}
