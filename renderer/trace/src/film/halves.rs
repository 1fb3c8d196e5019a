//! Halves: sums over the earlier and the later half of the samples, for each row of a block. By how
//! much both differ shows what is left of the error when later samples fill the gaps of earlier ones.
//!
//! - **In**: sums of channels over runs of samples, by number, in any order and grouping.
//! - **Out**: for each row the difference of the means of both halves.
//! - **Always true**: only integers are stored, so parts merge to the same bits in any order.
//! - **Left out**: single pixels. Their errors are independent, so a row's error is that of all of its
//!   pixels, and takes an eighth of the memory.

/// Number of samples of the first octave.
const FIRST: u32 = 8;
/// The last octave, the one before it, and all that are before that.
const RANGES: usize = 3;
/// Memory of a row of a block for each channel, bytes.
pub(super) const BYTES: usize = RANGES * size_of::<i64>();

/// Number of the octave of a sample: 0 for samples 0 to 7, `k` for 2^(k + 2) to 2^(k + 3) − 1.
#[inline]
pub(super) fn octave_of(number: u32) -> u32 {
    let octave = (number / FIRST).checked_ilog2();
    octave.map_or(0, |octave| octave + 1)
}

/// Sums over ranges of the samples of a block's pixels.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Halves {
    /// Number of the last octave of which there are samples.
    pub(super) last: u32,
    /// Number of samples of a pixel in each range, rejected ones included.
    pub(super) counts: [u32; RANGES],
    /// For each row of the block and each channel the sum over each range; empty without samples.
    ///
    /// Sums of very bright pixels wrap around. Whoever reads them knows how bright pixels are.
    pub(super) sums: Vec<[i64; RANGES]>,
}

/// Samples of one octave that are added.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Stretch {
    pub(super) octave: u32,
    pub(super) count: u32,
}

impl Halves {
    /// Adds a stretch of one pixel, whose sums these are, to a row of a block with so many sums.
    /// Samples are counted once for all pixels of a block, by the first one.
    pub(super) fn add(
        &mut self,
        stretch: Stretch,
        sums: &[i64],
        (within, row): (usize, usize),
        count: usize,
    ) {
        self.sums.resize(count, [0; RANGES]);
        self.rise_to(stretch.octave);
        let range = range_of(self.last - stretch.octave);
        let own = &mut self.sums[row * sums.len()..][..sums.len()];
        for (own, sum) in own.iter_mut().zip(sums) {
            own[range] = own[range].wrapping_add(*sum);
        }
        if within == 0 {
            self.counts[range] += stretch.count;
        }
    }

    /// Adds those of another film's block.
    pub(super) fn merge(&mut self, other: &Self) {
        if other.sums.is_empty() {
            return;
        }
        self.sums.resize(other.sums.len(), [0; RANGES]);
        self.rise_to(other.last);
        for range in 0..RANGES {
            let target = range_of(self.last - other.last + range as u32);
            // Bytes from a file may hold anything.
            self.counts[target] = self.counts[target].saturating_add(other.counts[range]);
            for (own, other) in self.sums.iter_mut().zip(&other.sums) {
                own[target] = own[target].wrapping_add(other[range]);
            }
        }
    }

    /// Number of samples of a pixel.
    pub(super) fn samples(&self) -> u64 {
        self.counts.iter().map(|&count| u64::from(count)).sum()
    }

    /// Makes this octave the last one, if it is later.
    fn rise_to(&mut self, octave: u32) {
        let by = octave.saturating_sub(self.last);
        if by == 0 {
            return;
        }
        self.last = octave;
        let counts = std::mem::take(&mut self.counts);
        for (range, count) in (0..).zip(counts) {
            let target = &mut self.counts[range_of(range + by)];
            *target = target.saturating_add(count);
        }
        for sums in &mut self.sums {
            for (range, sum) in (0..).zip(std::mem::take(sums)) {
                let target = &mut sums[range_of(range + by)];
                *target = target.wrapping_add(sum);
            }
        }
    }

    /// The greatest halves of which all samples are there: the number of samples of a pixel in each, and
    /// for each row and channel by how much their sums differ. `None` with fewer than sixteen samples.
    pub(super) fn differences(&self) -> Option<(u32, impl Iterator<Item = i64>)> {
        let [last, middle, first] = self.counts;
        let last_is_whole = last == first.saturating_add(middle);
        if last == 0 || !last_is_whole && (first == 0 || first != middle) {
            return None;
        }
        let difference = move |&[last, middle, first]: &[i64; RANGES]| {
            if last_is_whole {
                last.wrapping_sub(middle).wrapping_sub(first)
            } else {
                middle.wrapping_sub(first)
            }
        };
        let count = if last_is_whole { last } else { first };
        Some((count, self.sums.iter().map(difference)))
    }
}

/// The range of an octave that is so far before the last one.
fn range_of(before: u32) -> usize {
    (before as usize).min(RANGES - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Halves of one pixel with these samples, each its own number.
    fn of(numbers: impl IntoIterator<Item = u32>) -> Halves {
        let mut halves = Halves::default();
        for number in numbers {
            let stretch = Stretch {
                octave: octave_of(number),
                count: 1,
            };
            halves.add(stretch, &[i64::from(number)], (0, 0), 1);
        }
        halves
    }

    #[test]
    fn halves_are_the_greatest_that_are_whole() {
        for (samples, expected) in [(16, 8), (17, 8), (31, 8), (32, 16), (100, 32), (1024, 512)] {
            let halves = of(0..samples);
            let (count, mut differences) = halves.differences().expect("there are sixteen");
            // Each number of the later half is greater by its length.
            let length = i64::from(expected);
            assert_eq!(
                (count, differences.next()),
                (expected, Some(length * length))
            );
            assert_eq!(halves.samples(), u64::from(samples));
        }
        for samples in [0, 1, 8, 9, 15] {
            assert!(of(0..samples).differences().is_none(), "{samples}");
        }
        assert!(
            of(64..100).differences().is_none(),
            "the earlier half is missing"
        );
    }

    #[test]
    fn parts_in_any_order_are_the_whole() {
        let whole = of(0..200);
        assert_eq!(of((0..200).rev()), whole);
        for order in [[0, 1, 2], [2, 0, 1], [1, 2, 0], [2, 1, 0]] {
            let parts = [0..3, 3..70, 70..200];
            let mut merged = Halves::default();
            for part in order {
                merged.merge(&of(parts[part].clone()));
            }
            assert_eq!(merged, whole, "{order:?}");
        }
    }
}
