//! Ranges in which numbers of a scene file must lie.

use std::fmt;

/// A range of real numbers, each end in or out of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    low: f64,
    low_included: bool,
    high: f64,
    high_included: bool,
}

impl Limits {
    /// From `low` to `high`, both included.
    pub const fn closed(low: f64, high: f64) -> Self {
        Self {
            low,
            low_included: true,
            high,
            high_included: true,
        }
    }

    /// Above `low` and up to `high`.
    pub const fn above(low: f64, high: f64) -> Self {
        Self {
            low_included: false,
            ..Self::closed(low, high)
        }
    }

    /// From `low` up to below `high`.
    pub const fn below(low: f64, high: f64) -> Self {
        Self {
            high_included: false,
            ..Self::closed(low, high)
        }
    }

    /// Above `low` and below `high`.
    pub const fn open(low: f64, high: f64) -> Self {
        Self {
            low_included: false,
            ..Self::below(low, high)
        }
    }

    /// Both ends, each with whether it belongs to the range.
    pub const fn ends(&self) -> [(f64, bool); 2] {
        [
            (self.low, self.low_included),
            (self.high, self.high_included),
        ]
    }

    /// Whether a number lies in the range; NaN never does.
    pub fn contain(&self, value: f64) -> bool {
        let above = value > self.low || (self.low_included && value == self.low);
        let below = value < self.high || (self.high_included && value == self.high);
        above && below
    }

    /// What to write instead of a number that lies outside.
    pub fn advice(&self, value: f64) -> String {
        if value <= self.low {
            if self.low_included {
                format!("the least allowed value is {}", Plain(self.low))
            } else {
                format!("use a value above {}", Plain(self.low))
            }
        } else if self.high_included {
            format!("the greatest allowed value is {}", Plain(self.high))
        } else {
            format!("use a value below {}", Plain(self.high))
        }
    }
}

impl fmt::Display for Limits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (low, high) = (Plain(self.low), Plain(self.high));
        match (self.low_included, self.high_included) {
            (true, true) => write!(f, "{low} to {high}"),
            (false, true) => write!(f, "the values above {low} and up to {high}"),
            (true, false) => write!(f, "{low} to below {high}"),
            (false, false) => write!(f, "the values between {low} and {high}"),
        }
    }
}

/// A number as somebody would write it: powers of ten only where zeros would be counted.
pub struct Plain(pub f64);

impl fmt::Display for Plain {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let size = self.0.abs();
        if size != 0.0 && !(1e-4..1e7).contains(&size) {
            write!(f, "{:e}", self.0)
        } else {
            write!(f, "{}", self.0)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ends_belong_to_a_range_as_it_says() {
        assert!(Limits::closed(0.0, 1.0).contain(0.0) && Limits::closed(0.0, 1.0).contain(1.0));
        assert!(!Limits::above(0.0, 1.0).contain(0.0) && Limits::above(0.0, 1.0).contain(1.0));
        assert!(!Limits::closed(0.0, 1.0).contain(f64::NAN));
    }

    #[test]
    fn the_advice_names_the_end_that_was_passed() {
        let limits = Limits::closed(0.01, 170.0);
        assert_eq!(limits.advice(200.0), "the greatest allowed value is 170");
        assert_eq!(limits.advice(-1.0), "the least allowed value is 0.01");
        assert_eq!(Limits::above(0.0, 1e9).advice(0.0), "use a value above 0");
        assert_eq!(
            Limits::above(0.0, 1e9).to_string(),
            "the values above 0 and up to 1e9"
        );
    }
}
