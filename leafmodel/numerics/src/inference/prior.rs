//! Ranges of parameters, and the scale on which all of them are uniform from 0 to 1.

use thiserror::Error;

/// Ratio of a range's ends above which a positive range is taken by its logarithm.
const LOGARITHMIC_FROM: f64 = 4.0;

/// A parameter that is free between two values, all of which are equally likely at first: equal
/// differences, or equal ratios if the range is positive and its ends differ by more than a factor
/// of 4.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    name: String,
    low: f64,
    high: f64,
    is_whole: bool,
}

/// Not a range.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("{name} is free from {low} to {high}: both must be finite, and the first one smaller")]
pub struct BadRange {
    /// The parameter.
    pub name: String,
    /// Where the range begins.
    pub low: f64,
    /// Where it ends.
    pub high: f64,
}

impl Parameter {
    /// A parameter from `low` to `high`.
    ///
    /// # Errors
    ///
    /// [`BadRange`] unless both are finite and `low < high`.
    pub fn new(name: impl Into<String>, low: f64, high: f64) -> Result<Self, BadRange> {
        let name = name.into();
        let (finite, is_whole) = ((high - low).is_finite(), false);
        if low < high && finite {
            Ok(Self {
                name,
                low,
                high,
                is_whole,
            })
        } else {
            Err(BadRange { name, low, high })
        }
    }

    /// The same for whole numbers: `low` to `high` rounded, each number in between as likely as on
    /// the scale of [`Parameter::is_logarithmic`].
    pub fn whole(mut self) -> Self {
        self.is_whole = true;
        (self.low, self.high) = (self.low.round(), self.high.round());
        self
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Both ends of its range.
    pub fn range(&self) -> [f64; 2] {
        [self.low, self.high]
    }

    /// Whether it takes whole numbers only.
    pub fn is_whole(&self) -> bool {
        self.is_whole
    }

    /// Whether equal ratios are equally likely.
    pub fn is_logarithmic(&self) -> bool {
        self.low > 0.0 && self.high / self.low > LOGARITHMIC_FROM
    }

    /// The range with the room that each whole number has, half a step to both sides.
    fn room(&self) -> (f64, f64) {
        let half = if self.is_whole { 0.5 } else { 0.0 };
        (self.low - half, self.high + half)
    }

    /// The place at which simulations with a value are compared: that of the value itself, which
    /// many places of a whole number share.
    pub(super) fn settled(&self, place: f64) -> f64 {
        if !self.is_whole {
            return place;
        }
        let ((low, high), value) = (self.room(), self.at(place));
        if self.is_logarithmic() {
            libm::log(value / low) / libm::log(high / low)
        } else {
            (value - low) / (high - low)
        }
    }

    /// The value at a place of the prior, 0 to 1.
    pub(super) fn at(&self, place: f64) -> f64 {
        let (low, high) = self.room();
        let value = if self.is_logarithmic() {
            low * libm::pow(high / low, place)
        } else {
            low * (1.0 - place) + high * place
        };
        let value = if self.is_whole { value.round() } else { value };
        value.clamp(self.low, self.high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_lie_within_their_range_and_ratios_are_equal_on_a_wide_positive_one() {
        let wide = Parameter::new("a", 0.5, 8.0).expect("a range");
        assert!(wide.is_logarithmic());
        assert!((wide.at(0.5) - 2.0).abs() < 1e-12);
        let narrow = Parameter::new("b", 2.0, 8.0).expect("a range");
        assert!(!narrow.is_logarithmic());
        assert_eq!(
            [0.0, 0.5, 1.0].map(|share| narrow.at(share)),
            [2.0, 5.0, 8.0]
        );
        for share in [0.0, 1e-300, 0.3, 1.0 - 1e-16, 1.0] {
            assert!((0.5..=8.0).contains(&wide.at(share)));
        }
    }

    #[test]
    fn whole_numbers_are_equally_likely() {
        let rounds = Parameter::new("rounds", 1.0, 4.0).expect("a range").whole();
        let mut counts = [0; 4];
        for step in 0..4000 {
            let value = rounds.at((f64::from(step) + 0.5) / 4000.0);
            assert_eq!(value.fract(), 0.0);
            let settled = rounds.settled((f64::from(step) + 0.5) / 4000.0);
            assert!((settled - (value - 0.5) / 4.0).abs() < 1e-12, "{settled}");
            counts[value as usize - 1] += 1;
        }
        assert_eq!(counts, [1000; 4]);
    }

    #[test]
    fn what_is_no_range_is_refused() {
        let bad = [
            (1.0, 1.0),
            (2.0, 1.0),
            (f64::NAN, 1.0),
            (0.0, f64::INFINITY),
        ];
        for (low, high) in bad {
            assert!(Parameter::new("a", low, high).is_err(), "{low}..{high}");
        }
        // A difference that no number holds.
        assert!(Parameter::new("a", -1e308, 1e308).is_err());
    }
}
