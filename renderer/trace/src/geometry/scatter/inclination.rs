//! How leaves are inclined: distributions of the angle between their normals and the vertical.

mod table;

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2};

use numerics::numeric::bisect;

pub use self::table::{BadInclinations, InclinationTable};
use crate::sampling::beta::Beta;

/// Distributions of the angle θ between leaf normals and the vertical, from 0 to π/2. Azimuths are
/// even.
///
/// # Source
///
/// \[dewit1965\], in the trigonometric forms of \[bunnik1978\]; the two-parameter Beta of
/// \[goel1984\]; the ellipsoidal of \[campbell1990\]. The density g is over θ.
#[derive(Clone, Debug, PartialEq)]
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
    /// As the surface of an ellipsoid of revolution: g ∝ sin θ / (cos² θ + χ² sin² θ)².
    Ellipsoidal {
        /// χ, > 0: its horizontal over its vertical axis; 1 is spherical, greater is more level.
        chi: f64,
    },
    /// Linear between densities of a table.
    Table(InclinationTable),
}

impl Inclination {
    /// The density over θ, rad⁻¹.
    pub fn density(&self, theta: f64) -> f64 {
        match self {
            Self::Spherical => libm::sin(theta),
            Self::Uniform => FRAC_2_PI,
            Self::Planophile => FRAC_2_PI * (1.0 + libm::cos(2.0 * theta)),
            Self::Erectophile => FRAC_2_PI * (1.0 - libm::cos(2.0 * theta)),
            Self::Plagiophile => FRAC_2_PI * (1.0 - libm::cos(4.0 * theta)),
            Self::Extremophile => FRAC_2_PI * (1.0 + libm::cos(4.0 * theta)),
            Self::Beta { mu, nu } => FRAC_2_PI * Beta::new(*nu, *mu).density(FRAC_2_PI * theta),
            Self::Ellipsoidal { chi } => {
                let (sin, cos) = libm::sincos(theta);
                let radius = cos * cos + chi * chi * sin * sin;
                sin / (radius * radius) / below_cosine(*chi, 1.0)
            }
            Self::Table(table) => table.density(theta),
        }
    }

    /// The angle below which a share `u` in [0, 1] of the leaves is inclined, rad.
    pub fn angle(&self, u: f64) -> f64 {
        let whole = match self {
            Self::Beta { mu, nu } => return FRAC_PI_2 * Beta::new(*nu, *mu).quantile(u),
            Self::Ellipsoidal { chi } => below_cosine(*chi, 1.0),
            Self::Spherical
            | Self::Uniform
            | Self::Planophile
            | Self::Erectophile
            | Self::Plagiophile
            | Self::Extremophile
            | Self::Table(_) => 1.0,
        };
        let share = |theta: f64| {
            let (double, fourfold) = (libm::sin(2.0 * theta) / 2.0, libm::sin(4.0 * theta) / 4.0);
            match self {
                Self::Spherical => 1.0 - libm::cos(theta),
                Self::Uniform => FRAC_2_PI * theta,
                Self::Planophile => FRAC_2_PI * (theta + double),
                Self::Erectophile => FRAC_2_PI * (theta - double),
                Self::Plagiophile => FRAC_2_PI * (theta - fourfold),
                Self::Extremophile => FRAC_2_PI * (theta + fourfold),
                Self::Ellipsoidal { chi } => whole - below_cosine(*chi, libm::cos(theta)),
                Self::Beta { mu, nu } => Beta::new(*nu, *mu).share_below(FRAC_2_PI * theta),
                Self::Table(table) => table.share_below(theta),
            }
        };
        let u = u * whole;
        // Each share rises from 0 to the whole; 44 halvings leave 1e-13.
        let (low, high) = bisect(0.0, FRAC_PI_2, 44, |theta| share(theta) < u);
        0.5 * (low + high)
    }
}

/// `∫ dc / (c² + χ² (1 − c²))²` from 0 to a cosine: in proportion to the share of an ellipsoid's leaves
/// that are steeper.
fn below_cosine(chi: f64, cosine: f64) -> f64 {
    let square = chi * chi;
    let bend = (1.0 - square).abs().sqrt();
    // ∫ dc / (χ² + (1 − χ²) c²).
    let first = if bend == 0.0 {
        cosine
    } else if chi < 1.0 {
        libm::atan(bend * cosine / chi) / (bend * chi)
    } else {
        libm::atanh(bend * cosine / chi) / (bend * chi)
    };
    (cosine / (square + (1.0 - square) * cosine * cosine) + first) / (2.0 * square)
}
