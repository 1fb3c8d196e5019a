//! Edges by length, to find those longer than a limit that falls in time.
//!
//! Nearly all edges wait for a long time. So they are sorted only roughly, by the leading digits of
//! their lengths, until the limit falls below them. The few edges that it has passed are kept in
//! exact order.

use std::collections::BinaryHeap;

/// Low bits of a squared length that the rough order ignores: 128 steps per octave.
const FINE_BITS: u32 = 45;

/// Number of steps; lengths beyond the last share it.
const STEPS: usize = 128 * 24;

/// A queue of edges, the longest first and among equals the oldest.
#[derive(Clone, Debug)]
pub(crate) struct LengthQueue {
    /// Edges with this squared length or less are never asked for.
    least: f64,
    /// The lowest limit so far; longer edges are in `due`.
    limit: f64,
    /// Bits of the squared length, which sort as it does, and the complement of the edge's number.
    due: BinaryHeap<(u64, u32)>,
    /// The same for edges that are not due, by rough length.
    waiting: Vec<Vec<(u64, u32)>>,
}

impl LengthQueue {
    /// An empty queue that will never be asked for edges with a squared length of `least` or less.
    pub(crate) fn new(least: f64) -> Self {
        Self {
            least,
            limit: f64::INFINITY,
            due: BinaryHeap::new(),
            waiting: Vec::new(),
        }
    }

    /// Adds an edge.
    pub(crate) fn push(&mut self, edge: u32, length_squared: f64) {
        if length_squared <= self.least {
            return;
        }
        let item = (length_squared.to_bits(), !edge);
        if length_squared > self.limit {
            self.due.push(item);
            return;
        }
        let step = self.step(length_squared);
        if step >= self.waiting.len() {
            self.waiting.resize_with(step + 1, Vec::new);
        }
        self.waiting[step].push(item);
    }

    /// Removes the longest edge if its squared length is above `limit`; returns its number and its
    /// squared length.
    pub(crate) fn pop_above(&mut self, limit: f64) -> Option<(u32, f64)> {
        debug_assert!(limit >= self.least, "{limit} is less than said at first");
        if limit < self.limit {
            self.limit = limit;
            let last = self.step(limit);
            while self.waiting.len() > last + 1 {
                self.due.extend(self.waiting.pop().unwrap_or_default());
            }
            if let Some(mixed) = self.waiting.get_mut(last) {
                let is_due = |item: &mut (u64, u32)| f64::from_bits(item.0) > limit;
                self.due.extend(mixed.extract_if(.., is_due));
            }
        }
        let length_squared = f64::from_bits(self.due.peek()?.0);
        if length_squared <= limit {
            return None;
        }
        let (_, complement) = self.due.pop()?;
        Some((!complement, length_squared))
    }

    /// The step of the rough order of a squared length.
    fn step(&self, length_squared: f64) -> usize {
        let above = (length_squared.to_bits() >> FINE_BITS) - (self.least.to_bits() >> FINE_BITS);
        (above as usize).min(STEPS - 1)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use properties::fixed;

    proptest! {
        #![proptest_config(fixed(256))]

        #[test]
        fn edges_come_as_from_a_sorted_list(
            rounds in proptest::collection::vec(
                (proptest::collection::vec((0_u8..3, -1.0..30.0_f64), 0..40), 0.0..25.0_f64), 1..12,
            ),
        ) {
            let mut queue = LengthQueue::new(2.25);
            let mut list: Vec<(f64, u32)> = Vec::new();
            let mut edge = 0;
            for (lengths, limit) in rounds {
                for (kind, exponent) in lengths {
                    // Some lengths equal, some below anything asked for, some far above.
                    let squared = match kind {
                        0 => exponent.round(),
                        _ => libm::exp2(exponent),
                    };
                    queue.push(edge, squared.max(0.0));
                    list.push((squared.max(0.0), edge));
                    edge += 1;
                }
                let limit = libm::exp2(limit).max(2.25);
                list.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
                let count = list.partition_point(|item| item.0 > limit);
                let mut popped = Vec::new();
                while let Some((edge, squared)) = queue.pop_above(limit) {
                    popped.push((squared, edge));
                }
                prop_assert_eq!(popped, list.drain(..count).collect::<Vec<_>>());
            }
        }
    }
}
