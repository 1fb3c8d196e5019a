//! Latin hypercubes: many keys covered by few tasks.

use super::range::Range;

/// `count` rows, each with a value of every range: of the `count` equal parts of each range every
/// part has exactly one row, at a random place in it. Which row that is is a random permutation,
/// another one for each range (`McKay`, Beckman and Conover, Technometrics 21(2), 1979).
///
/// A range of integers is cut where integers end, so that each of them is as likely as the others.
pub(super) fn hypercube(ranges: &[Range], count: usize, seed: u64) -> Vec<Vec<String>> {
    let mut columns = Vec::with_capacity(ranges.len());
    for (number, range) in ranges.iter().enumerate() {
        let mut random = SplitMix64::of(seed, number as u64);
        let mut parts: Vec<usize> = (0..count).collect();
        // Fisher and Yates' shuffle.
        for last in (1..count).rev() {
            parts.swap(last, random.below(last as u64 + 1) as usize);
        }
        let shares = parts
            .into_iter()
            .map(|part| (part as f64 + random.share()) / count as f64);
        let column: Vec<String> = shares.map(|share| value(range, share)).collect();
        columns.push(column);
    }
    let row = |index: usize| columns.iter().map(|column| column[index].clone()).collect();
    (0..count).map(row).collect()
}

fn value(range: &Range, share: f64) -> String {
    if !range.whole {
        return range.text(range.at(share));
    }
    let (low, high) = (range.from.min(range.to), range.from.max(range.to));
    let wider = if range.logarithmic {
        Range {
            from: low,
            to: high + 1.0,
            ..*range
        }
    } else {
        Range {
            from: low.ceil(),
            to: high.floor() + 1.0,
            ..*range
        }
    };
    let value = wider.at(share).floor();
    range.text(value.clamp(low.ceil(), high.floor()))
}

/// The generator `SplitMix64` (\[steele2014\]).
struct SplitMix64(u64);

impl SplitMix64 {
    /// A sequence of its own for each number of a seed.
    fn of(seed: u64, number: u64) -> Self {
        let mut first = Self(seed);
        let key = first.next();
        Self(key ^ number.wrapping_mul(0xd1b5_4a32_d192_ed03))
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// In [0, 1).
    fn share(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// From 0 to `bound` − 1; the bias is below `bound` / 2⁶⁴.
    fn below(&mut self, bound: u64) -> u64 {
        ((u128::from(self.next()) * u128::from(bound)) >> 64) as u64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn range(from: f64, to: f64) -> Range {
        Range {
            from,
            to,
            logarithmic: false,
            whole: false,
        }
    }

    fn numbers(rows: &[Vec<String>], column: usize) -> Vec<f64> {
        let texts = rows.iter().map(|row| &row[column]);
        texts.map(|text| text.parse().expect("a number")).collect()
    }

    #[test]
    fn every_part_of_every_range_has_one_row() {
        let ratios = Range {
            logarithmic: true,
            ..range(1.0, 1000.0)
        };
        let rows = hypercube(&[range(-2.0, 3.0), ratios], 50, 9);
        for (column, part) in [
            (0, (|x: f64| (x + 2.0) / 5.0) as fn(f64) -> f64),
            (1, |x: f64| libm::log10(x) / 3.0),
        ] {
            let mut parts: Vec<usize> = numbers(&rows, column)
                .into_iter()
                .map(|x| (part(x) * 50.0) as usize)
                .collect();
            parts.sort_unstable();
            assert_eq!(parts, (0..50).collect::<Vec<_>>());
        }
    }

    #[test]
    fn keys_are_independent_and_seeds_differ() {
        let ranges = [range(0.0, 1.0), range(0.0, 1.0)];
        let rows = hypercube(&ranges, 2000, 1);
        assert_eq!(rows, hypercube(&ranges, 2000, 1));
        assert_ne!(rows, hypercube(&ranges, 2000, 2));
        let (x, y) = (numbers(&rows, 0), numbers(&rows, 1));
        let covariance = x.iter().zip(&y).map(|(x, y)| (x - 0.5) * (y - 0.5));
        let correlation = 12.0 * covariance.sum::<f64>() / 2000.0;
        // Its standard deviation is 1/√2000 = 0.022.
        assert!(correlation.abs() < 0.09, "{correlation}");
    }

    #[test]
    fn integers_are_equally_likely_and_stay_within_the_range() {
        let dice = Range {
            whole: true,
            ..range(1.0, 6.0)
        };
        let rows = hypercube(&[dice], 600, 4);
        for side in 1..=6 {
            let count = rows.iter().filter(|row| row[0] == side.to_string()).count();
            assert_eq!(count, 100, "{side}");
        }
    }
}
