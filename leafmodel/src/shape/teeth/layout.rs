//! The teeth of a wave along one side.

use super::wave::ToothWave;
use crate::random::{Use, even};

/// A wave laid out along one side of a margin.
pub(super) struct Layout<'a> {
    pub(super) wave: &'a ToothWave,
    /// Where teeth begin, as shares of the side, and where the last one ends; none if they are all
    /// of one length.
    starts: Option<Vec<f64>>,
    /// Factor on the height of each tooth; none if they are all of one height.
    factors: Option<Vec<f64>>,
}

impl<'a> Layout<'a> {
    /// The teeth of a wave. `stream` is another one for each wave and side; `below` is the wave on
    /// whose teeth nested ones stand.
    pub(super) fn new(
        wave: &'a ToothWave,
        below: Option<&Layout<'_>>,
        seed: u64,
        stream: u64,
    ) -> Self {
        let count = wave.per_side as usize;
        let number = |purpose, i: usize| even(seed, purpose, stream * 4096 + i as u64);
        let nested = below.filter(|below| wave.nested && below.starts.is_some());
        let starts = (wave.spacing_cv > 0.0 || nested.is_some()).then(|| {
            let each = nested.map_or(count, |below| count / below.wave.per_side as usize);
            let mut starts = vec![0.0];
            for first in (0..count).step_by(each) {
                let (from, to) = nested.map_or((0.0, 1.0), |below| {
                    let tooth = first / each;
                    (below.start(tooth), below.start(tooth + 1))
                });
                let lengths = (first..first + each)
                    .map(|i| 1.0 + wave.spacing_cv * number(Use::ToothSpacing, i));
                let lengths: Vec<f64> = lengths.collect();
                let total: f64 = lengths.iter().sum();
                let mut sum = 0.0;
                for length in &lengths[..each - 1] {
                    sum += length;
                    starts.push(from + (to - from) * sum / total);
                }
                starts.push(to);
            }
            starts
        });
        let factors = (wave.height_cv > 0.0).then(|| {
            (0..count)
                .map(|i| 1.0 + wave.height_cv * number(Use::ToothHeight, i))
                .collect()
        });
        Self {
            wave,
            starts,
            factors,
        }
    }

    /// Where a tooth begins.
    fn start(&self, tooth: usize) -> f64 {
        self.starts.as_ref().map_or_else(
            || tooth as f64 / f64::from(self.wave.per_side),
            |starts| starts[tooth],
        )
    }

    /// The tooth at a share of the side and the share of it there; where one ends and another
    /// begins the first if `before`.
    fn tooth_at(&self, share: f64, before: bool) -> (f64, f64) {
        let Some(starts) = &self.starts else {
            let along = share * f64::from(self.wave.per_side);
            // Break points from `breaks` are rounded, so a place next to one is snapped to the
            // tooth it belongs to.
            let nearest = along.round();
            return if (along - nearest).abs() < 1e-9 {
                if before {
                    (nearest - 1.0, 1.0)
                } else {
                    (nearest, 0.0)
                }
            } else {
                (along.floor(), along - along.floor())
            };
        };
        let i = starts.partition_point(|&start| start < share - 1e-9);
        // `starts[i]` is the first at or beyond the share.
        match starts.get(i) {
            Some(start) if (start - share).abs() <= 1e-9 => {
                if before {
                    (i as f64 - 1.0, 1.0)
                } else {
                    (i as f64, 0.0)
                }
            }
            Some(end) if i > 0 => {
                let start = starts[i - 1];
                (i as f64 - 1.0, (share - start) / (end - start))
            }
            Some(_) | None => (-1.0, 0.0),
        }
    }

    /// Height at a share of the side, in shares of the midrib's length. Where a side of a tooth is
    /// upright, the height just before the place if `before`, else that just after it.
    pub(super) fn at(&self, share: f64, before: bool) -> f64 {
        let (tooth, within) = self.tooth_at(share, before);
        if !(0.0..f64::from(self.wave.per_side)).contains(&tooth) {
            return 0.0;
        }
        let mut height = self.wave.height * self.wave.profile(within);
        if let Some(factors) = &self.factors {
            height *= factors[tooth as usize];
        }
        self.wave.faded(height, share)
    }

    /// Shares of the side at which the wave bends: notches, summits and points of bent flanks.
    pub(super) fn breaks(&self) -> Vec<f64> {
        let count = self.wave.per_side;
        let bends = self.wave.bends();
        if self.starts.is_none() {
            let teeth = f64::from(count);
            let bends = &bends;
            return (0..count)
                .flat_map(move |i| bends.iter().map(move |bend| (f64::from(i) + bend) / teeth))
                .collect();
        }
        (0..count as usize)
            .flat_map(|i| {
                let (from, to) = (self.start(i), self.start(i + 1));
                bends.iter().map(move |bend| from + (to - from) * bend)
            })
            .collect()
    }

    /// Shares of the side at which teeth are highest.
    pub(super) fn summits(&self) -> impl Iterator<Item = f64> + '_ {
        let summit = self.wave.summit();
        (0..self.wave.per_side as usize).map(move |i| {
            let (from, to) = (self.start(i), self.start(i + 1));
            from + (to - from) * summit
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cv(values: &[f64]) -> f64 {
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let square = values.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / n;
        square.sqrt() / mean
    }

    #[test]
    fn lengths_and_heights_vary_as_they_should() {
        let wave = ToothWave {
            per_side: 1000,
            spacing_cv: 0.3,
            height_cv: 0.2,
            ..ToothWave::default()
        };
        let layout = Layout::new(&wave, None, 5, 0);
        let starts = layout.starts.as_ref().expect("they vary");
        let lengths: Vec<f64> = starts.windows(2).map(|pair| pair[1] - pair[0]).collect();
        // The spread of a standard deviation of 1000 uniform numbers is below 2 %.
        assert!((cv(&lengths) / 0.3 - 1.0).abs() < 0.06, "{}", cv(&lengths));
        assert!(lengths.iter().all(|length| *length > 0.0));
        let factors = layout.factors.as_ref().expect("they vary");
        assert!((cv(factors) / 0.2 - 1.0).abs() < 0.06, "{}", cv(factors));
        assert_eq!(Some(&1.0), starts.last());
        let again = Layout::new(&wave, None, 5, 0);
        assert_eq!(again.starts, layout.starts);
        assert_ne!(Layout::new(&wave, None, 5, 1).starts, layout.starts);
        assert_ne!(Layout::new(&wave, None, 6, 0).starts, layout.starts);
    }

    #[test]
    fn nested_teeth_begin_and_end_with_the_greater_ones() {
        let large = ToothWave {
            per_side: 7,
            spacing_cv: 0.4,
            ..ToothWave::default()
        };
        let small = ToothWave {
            per_side: 28,
            nested: true,
            spacing_cv: 0.2,
            ..ToothWave::default()
        };
        let large = Layout::new(&large, None, 1, 0);
        let small = Layout::new(&small, Some(&large), 1, 1);
        for tooth in 0..=7 {
            assert_eq!(small.start(4 * tooth), large.start(tooth), "{tooth}");
        }
        assert!((0..28).all(|i| small.start(i) < small.start(i + 1)));
    }
}
