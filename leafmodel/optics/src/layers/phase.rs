//! How a scatterer spreads light over directions.

use std::f64::consts::PI;

/// A phase function `p` of the cosine `x` of the angle between the directions before and after,
/// with `½ ∫ p dx = 1`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Phase {
    /// `(1 − g²) / (1 + g² − 2 g x)^{3/2}`; `g = 0` is isotropic.
    HenyeyGreenstein {
        /// `g`, the mean cosine, in (−1, 1).
        g: f64,
    },
    /// A sum of two of that kind.
    Double {
        /// `g` of the one.
        first: f64,
        /// `g` of the other.
        second: f64,
        /// Share of the first, in [0, 1].
        share: f64,
    },
    /// `¾ (1 + x²)`: what is small against the wavelength.
    Rayleigh,
}

impl Phase {
    /// The same to all directions.
    pub const ISOTROPIC: Self = Self::HenyeyGreenstein { g: 0.0 };

    /// Whether the parameters are in range.
    pub(super) fn is_valid(self) -> bool {
        let within = |g: f64| g.abs() < 1.0;
        match self {
            Self::HenyeyGreenstein { g } => within(g),
            Self::Double {
                first,
                second,
                share,
            } => within(first) && within(second) && (0.0..=1.0).contains(&share),
            Self::Rayleigh => true,
        }
    }

    /// `p(x)`.
    ///
    /// # Source
    ///
    /// \[henyey1941\].
    pub fn value(self, x: f64) -> f64 {
        match self {
            Self::HenyeyGreenstein { g } => henyey_greenstein(g, x),
            Self::Double {
                first,
                second,
                share,
            } => share * henyey_greenstein(first, x) + (1.0 - share) * henyey_greenstein(second, x),
            Self::Rayleigh => 0.75 * (1.0 + x * x),
        }
    }

    /// `g`, the mean cosine.
    pub fn mean_cosine(self) -> f64 {
        self.moments(2)[1]
    }

    /// The first `count` moments `χₗ = ½ ∫ p Pₗ dx`, from `χ₀ = 1`.
    pub fn moments(self, count: usize) -> Vec<f64> {
        let powers = |g: f64| std::iter::successors(Some(1.0), move |power| Some(power * g));
        match self {
            Self::HenyeyGreenstein { g } => powers(g).take(count).collect(),
            Self::Double {
                first,
                second,
                share,
            } => powers(first)
                .zip(powers(second))
                .map(|(one, other)| share * one + (1.0 - share) * other)
                .take(count)
                .collect(),
            Self::Rayleigh => [1.0, 0.0, 0.1]
                .into_iter()
                .chain(std::iter::repeat(0.0))
                .take(count)
                .collect(),
        }
    }

    /// The cosine below which a share `u` in [0, 1) of the light goes. A second number `v` chooses
    /// between parts of a sum.
    pub(super) fn sample(self, u: f64, v: f64) -> f64 {
        match self {
            Self::HenyeyGreenstein { g } => sample_henyey_greenstein(g, u),
            Self::Double {
                first,
                second,
                share,
            } => sample_henyey_greenstein(if v < share { first } else { second }, u),
            Self::Rayleigh => {
                // x³ + 3 x = 8 u − 4, by Cardano.
                let half = 4.0 * u - 2.0;
                let root = libm::cbrt(half + (half * half + 1.0).sqrt());
                root - 1.0 / root
            }
        }
        .clamp(-1.0, 1.0)
    }
}

fn henyey_greenstein(g: f64, x: f64) -> f64 {
    let base = 1.0 + g * g - 2.0 * g * x;
    (1.0 - g * g) / (base * base.sqrt())
}

fn sample_henyey_greenstein(g: f64, u: f64) -> f64 {
    let x = 2.0 * u - 1.0;
    if g.abs() < 1e-4 {
        // The closed form divides by g; this is its series, off by less than 1e-8.
        return x + 1.5 * g * (1.0 - x * x);
    }
    let root = (1.0 - g * g) / (1.0 + g * x);
    (1.0 + g * g - root * root) / (2.0 * g)
}

/// The mean cosine of light that a large clear ball scatters by its surface, diffraction left out.
///
/// `relative_index` is the ball's refractive index over that of what surrounds it, > 1. Rays that
/// are reflected, refracted and any number of times reflected inside are added up, unpolarised.
///
/// # Source
///
/// The sum over internal reflections is that of \[ashkin1992\] for the part of the momentum that
/// goes on forwards; quadrature over the place where the ray meets the ball. A test follows rays.
pub(crate) fn mean_cosine_of_ball(relative_index: f64) -> f64 {
    over_incidence(|cosine| {
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
        let inside = sine / relative_index;
        let refracted = (1.0 - inside * inside).sqrt();
        let twice = 2.0 * (libm::acos(cosine));
        let twice_inside = 2.0 * libm::acos(refracted);
        let forward = |r: f64| {
            let t = 1.0 - r;
            let series = 1.0 + r * r + 2.0 * r * libm::cos(twice_inside);
            -r * libm::cos(twice)
                + t * t * (libm::cos(twice - twice_inside) + r * libm::cos(twice)) / series
        };
        let (s, p) = super::boundary::polarised(1.0, relative_index, cosine, refracted);
        f64::midpoint(forward(s), forward(p))
    })
}

/// What one thin clear wall of any orientation does, in air: the share of light that it reflects,
/// and the mean cosine of what is reflected. What is let through keeps its direction.
///
/// Both faces of the wall reflect, any number of times, without interference.
pub fn wall(relative_index: f64) -> (f64, f64) {
    let reflected = |cosine: f64| {
        let sine2 = 1.0 - cosine * cosine;
        let refracted = (1.0 - sine2 / (relative_index * relative_index)).sqrt();
        let (s, p) = super::boundary::polarised(1.0, relative_index, cosine, refracted);
        f64::midpoint(2.0 * s / (1.0 + s), 2.0 * p / (1.0 + p))
    };
    let share = over_incidence(reflected);
    // A ray that meets the wall at θ is turned by π − 2 θ.
    let turned = over_incidence(|cosine| reflected(cosine) * (1.0 - 2.0 * cosine * cosine));
    (share, turned / share)
}

/// `∫ f(θ) sin 2θ dθ` over the angle of incidence, as a function of its cosine.
fn over_incidence(f: impl Fn(f64) -> f64) -> f64 {
    let nodes = crate::quadrature::gauss(64);
    let half = PI / 2.0;
    nodes
        .iter()
        .map(|(x, weight)| {
            let (sine, cosine) = libm::sincos(half * x);
            f(cosine) * 2.0 * sine * cosine * half * weight
        })
        .sum()
}

#[cfg(test)]
mod tests;
