//! How leaves are inclined: distributions of the angle between their normals and the vertical.

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2};

use numerics::numeric::bisect;

use crate::sampling::beta::Beta;

/// Distributions of the angle θ between leaf normals and the vertical, from 0 to π/2. Azimuths are
/// even.
///
/// # Source
///
/// \[dewit1965\], in the trigonometric forms of \[bunnik1978\]; the two-parameter Beta of
/// \[goel1984\]. The density g is over θ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Inclination {
    /// As the surface of a sphere: g = sin θ.
    Spherical,
    /// All angles alike: g = 2/π.
    Uniform,
    /// Mostly level: g = 2/π (1 + cos 2θ).
    Planophile,
    /// Mostly upright: g = 2/π (1 − cos 2θ).
    Erectophile,
    /// Mostly at 45°: g = 2/π (1 − cos 4θ).
    Plagiophile,
    /// Level or upright: g = 2/π (1 + cos 4θ).
    Extremophile,
    /// g = 2/π (1 − t)^(μ−1) t^(ν−1) / B(μ, ν) with t = 2θ/π; the mean is π/2 · ν/(μ + ν).
    Beta {
        /// μ, > 0: greater, more level.
        mu: f64,
        /// ν, > 0: greater, more upright.
        nu: f64,
    },
}

impl Inclination {
    /// The density over θ, rad⁻¹.
    pub fn density(self, theta: f64) -> f64 {
        match self {
            Self::Spherical => libm::sin(theta),
            Self::Uniform => FRAC_2_PI,
            Self::Planophile => FRAC_2_PI * (1.0 + libm::cos(2.0 * theta)),
            Self::Erectophile => FRAC_2_PI * (1.0 - libm::cos(2.0 * theta)),
            Self::Plagiophile => FRAC_2_PI * (1.0 - libm::cos(4.0 * theta)),
            Self::Extremophile => FRAC_2_PI * (1.0 + libm::cos(4.0 * theta)),
            Self::Beta { mu, nu } => FRAC_2_PI * Beta::new(nu, mu).density(FRAC_2_PI * theta),
        }
    }

    /// The angle below which a share `u` in [0, 1] of the leaves is inclined, rad.
    pub fn angle(self, u: f64) -> f64 {
        if let Self::Beta { mu, nu } = self {
            return FRAC_PI_2 * Beta::new(nu, mu).quantile(u);
        }
        let share = |theta: f64| {
            let (double, fourfold) = (libm::sin(2.0 * theta) / 2.0, libm::sin(4.0 * theta) / 4.0);
            match self {
                Self::Spherical => 1.0 - libm::cos(theta),
                Self::Uniform | Self::Beta { .. } => FRAC_2_PI * theta,
                Self::Planophile => FRAC_2_PI * (theta + double),
                Self::Erectophile => FRAC_2_PI * (theta - double),
                Self::Plagiophile => FRAC_2_PI * (theta - fourfold),
                Self::Extremophile => FRAC_2_PI * (theta + fourfold),
            }
        };
        // Each share rises from 0 to 1; 44 halvings leave 1e-13.
        let (low, high) = bisect(0.0, FRAC_PI_2, 44, |theta| share(theta) < u);
        0.5 * (low + high)
    }
}
