//! A year: the revenue is a periodic function of time (Remark 3.6 of \[xia2007\]).

use super::leaf::TransportLeaf;
use super::plan::TransportError;

/// A leaf through the year, every year the same: in the half with rising revenue it grows, in the
/// half with falling revenue cells die.
///
/// Time is counted in years. The revenue is `ε (1 − cos 2πt) / 2`: 0 at whole years, that of the
/// full-grown leaf in the middle.
#[derive(Clone, Debug)]
pub struct Year<'a> {
    leaf: &'a TransportLeaf,
    deaths: Vec<f64>,
}

impl TransportLeaf {
    /// The year of the leaf, with autumn in `steps` (1 to 10 000) equal steps of the revenue.
    ///
    /// # Errors
    ///
    /// [`TransportError::Range`] for `steps`.
    pub fn year(&self, steps: u32) -> Result<Year<'_>, TransportError> {
        let deaths = self.deaths(steps)?;
        Ok(Year { leaf: self, deaths })
    }
}

impl Year<'_> {
    /// The revenue at a time in years, as a share of the full-grown leaf's, 0 to 1.
    pub fn revenue_share(time: f64) -> f64 {
        0.5 - 0.5 * libm::cos(std::f64::consts::TAU * time)
    }

    /// The leaf at a finite time in years: its living cells, always including the root.
    ///
    /// In the rising half it is the last stage of growth that the revenue has reached. In the
    /// falling half it lacks the cells that have died; the others keep their places in the network.
    pub fn at(&self, time: f64) -> TransportLeaf {
        let share = Self::revenue_share(time);
        if time - time.floor() > 0.5 {
            return self.leaf.without_dead(&self.deaths, share);
        }
        let epsilon = share * self.leaf.plan().epsilon;
        let stages = self.leaf.stages();
        match stages.partition_point(|stage| stage.epsilon <= epsilon) {
            0 => self.leaf.without_dead(&self.deaths, 0.0),
            reached => self.leaf.at_stage(reached - 1),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transport::{Ladder, TransportPlan, example};

    #[test]
    fn a_year_begins_and_ends_with_the_root_alone_and_in_between_the_leaf_grows_and_dies() {
        let events = TransportPlan {
            ladder: Ladder::Events,
            ..TransportPlan::default()
        };
        for plan in [example(1).expect("there is one"), events] {
            let leaf = plan.grow(1).expect("a good plan");
            let year = leaf.year(500).expect("a good number");
            let times: Vec<f64> = (0..=64).map(|i| f64::from(i) / 64.0).collect();
            let living: Vec<TransportLeaf> = times.iter().map(|&time| year.at(time)).collect();
            assert_eq!((living[0].cells().len(), living[64].cells().len()), (1, 1));
            assert_eq!(living[32].cells(), leaf.cells());
            for (i, pair) in living.windows(2).enumerate() {
                let (some, more) = if i < 32 {
                    (&pair[0], &pair[1])
                } else {
                    (&pair[1], &pair[0])
                };
                assert!(some.cells().iter().all(|cell| more.cells().contains(cell)));
            }
            // In both halves of the year the leaf passes through several sizes.
            for half in [&living[..32], &living[33..]] {
                let partly = |leaf: &&TransportLeaf| (10..540).contains(&leaf.cells().len());
                assert!(half.iter().filter(partly).count() > 2);
            }
        }
    }

    #[test]
    fn every_year_is_like_the_last() {
        let leaf = example(5)
            .expect("there is one")
            .grow(1)
            .expect("a good plan");
        let year = leaf.year(100).expect("a good number");
        for time in [0.125, 0.375, 0.5, 0.625, 0.75] {
            assert_eq!(year.at(time).cells(), year.at(time - 3.0).cells());
            assert_eq!(year.at(time).cells(), year.at(time + 8.0).cells());
        }
    }
}
