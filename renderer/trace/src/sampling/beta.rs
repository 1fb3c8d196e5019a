//! The Beta distribution: density, share below a value, and the value below which a share lies.
//!
//! # Source
//!
//! The continued fraction of the incomplete Beta function, \[dlmf\] 8.17.22, by Lentz's method.

/// Most terms of the fraction; it converges in about the root of the greater parameter.
const MOST_TERMS: u32 = 400;
/// Relative change at which the fraction is taken as found.
const CLOSE: f64 = 1e-15;

/// What stands for 0 in a denominator.
const TINY: f64 = 1e-300;

/// A distribution over 0 to 1 with the density x^(a−1) (1−x)^(b−1) / B(a, b).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beta {
    a: f64,
    b: f64,
    /// ln B(a, b).
    log_norm: f64,
}

impl Beta {
    /// That with exponents `a − 1` and `b − 1`, both parameters > 0.
    pub fn new(a: f64, b: f64) -> Self {
        let log_norm = libm::lgamma(a) + libm::lgamma(b) - libm::lgamma(a + b);
        Self { a, b, log_norm }
    }

    /// The density at `x` in 0 to 1; infinite at an end where the exponent is below 0.
    pub fn density(&self, x: f64) -> f64 {
        // Rounding may have carried it beyond an end.
        let x = x.clamp(0.0, 1.0);
        libm::pow(x, self.a - 1.0) * libm::pow(1.0 - x, self.b - 1.0) * libm::exp(-self.log_norm)
    }

    /// The share below `x`: the regularised incomplete Beta function.
    pub fn share_below(&self, x: f64) -> f64 {
        if x <= 0.0 {
            return 0.0;
        }
        if x >= 1.0 {
            return 1.0;
        }
        // The fraction converges fast below the mean; above it the other tail is small.
        if x < (self.a + 1.0) / (self.a + self.b + 2.0) {
            self.lower_tail(x)
        } else {
            let mirrored = Self {
                a: self.b,
                b: self.a,
                log_norm: self.log_norm,
            };
            1.0 - mirrored.lower_tail(1.0 - x)
        }
    }

    fn lower_tail(&self, x: f64) -> f64 {
        let (a, b) = (self.a, self.b);
        let log_front = a * libm::log(x) + b * libm::log(1.0 - x) - self.log_norm;
        // 1 / (1 + d₁ / (1 + d₂ / (1 + …))).
        let term = |k: u32| {
            let m = f64::from(k / 2);
            let n = a + 2.0 * m;
            if k.is_multiple_of(2) {
                m * (b - m) * x / ((n - 1.0) * n)
            } else {
                -(a + m) * (a + b + m) * x / (n * (n + 1.0))
            }
        };
        let nonzero = |value: f64| if value.abs() < TINY { TINY } else { value };
        let (mut value, mut c, mut d) = (1.0, 1.0, 0.0);
        for k in 1..=MOST_TERMS {
            let factor = term(k);
            d = 1.0 / nonzero(1.0 + factor * d);
            c = nonzero(1.0 + factor / c);
            value *= c * d;
            if (c * d - 1.0).abs() < CLOSE {
                break;
            }
        }
        libm::exp(log_front) / (a * value)
    }

    /// The value below which a share `u` in [0, 1] lies, within 1e-12.
    pub fn quantile(&self, u: f64) -> f64 {
        let (mut low, mut high) = (0.0, 1.0);
        let mut x = 0.5;
        for step in 0..60 {
            let off = self.share_below(x) - u;
            if off < 0.0 {
                low = x;
            } else {
                high = x;
            }
            if high - low < 1e-12 {
                break;
            }
            // Newton's step where it stays within what is known; the first halvings find its basin.
            let newton = x - off / self.density(x);
            let is_within = step >= 8 && newton > low && newton < high;
            let next = if is_within {
                newton
            } else {
                0.5 * (low + high)
            };
            if is_within && (next - x).abs() < 1e-13 {
                return next;
            }
            x = next;
        }
        0.5 * (low + high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_those_of_polynomials_and_of_the_arcsine() {
        for i in 0..=20 {
            let x = f64::from(i) / 20.0;
            for (a, b, expected) in [
                (1.0, 1.0, x),
                (2.0, 1.0, x * x),
                (1.0, 3.0, 1.0 - (1.0 - x).powi(3)),
                (2.0, 2.0, x * x * (3.0 - 2.0 * x)),
                (3.0, 2.0, x.powi(3) * (4.0 - 3.0 * x)),
                (0.5, 0.5, libm::asin(x.sqrt()) * std::f64::consts::FRAC_2_PI),
            ] {
                let found = Beta::new(a, b).share_below(x);
                assert!((found - expected).abs() < 1e-12, "{a} {b} {x}: {found}");
            }
        }
    }

    #[test]
    fn quantiles_undo_shares() {
        for (a, b) in [(1.172, 2.77), (0.433, 0.433), (3.326, 3.326), (40.0, 7.0)] {
            let beta = Beta::new(a, b);
            for i in 1..200 {
                let u = f64::from(i) / 200.0;
                let found = beta.share_below(beta.quantile(u));
                assert!((found - u).abs() < 1e-9, "{a} {b} {u}: {found}");
            }
        }
    }
}
