//! Chlorophyll a and b.

use super::bands::Bands;
use super::{PigmentsError, packaging, shift_per_cm, within};

/// In diethyl ether, `PhotochemCAD` (Du et al. 1998; Dixon et al. 2005); the fit is ours, rms 0.26
/// % of the peak.
pub(super) const A: Bands = Bands {
    gaussians: &[
        [0.3017, 26375.0, 488.0],
        [0.6409, 24527.0, 895.0],
        [0.6552, 23376.0, 335.0],
        [0.1440, 23157.0, 172.0],
        [0.0298, 18030.0, 1988.0],
        [0.0369, 17433.0, 251.0],
        [0.1005, 16285.0, 355.0],
        [0.2558, 15257.0, 236.0],
        [0.5252, 15133.0, 140.0],
    ],
    range_nm: [380.0, 720.0],
    epsilon: 111_160.0,
    molar_mass: 893.5,
};

/// As [`A`], rms 0.42 % of the peak.
pub(super) const B: Bands = Bands {
    gaussians: &[
        [0.1067, 26802.0, 2500.0],
        [0.3127, 23284.0, 587.0],
        [0.6165, 22111.0, 355.0],
        [0.3660, 21861.0, 449.0],
        [0.0451, 17785.0, 1605.0],
        [0.0314, 16755.0, 355.0],
        [0.0754, 15661.0, 281.0],
        [0.2708, 15558.0, 142.0],
    ],
    range_nm: [380.0, 700.0],
    epsilon: 159_100.0,
    molar_mass: 907.5,
};

/// What the chlorophyll column consists of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ChlorophyllMix {
    /// PROSPECT-D's column of a + b.
    Prospect,
    /// PROSPECT-D's column with another a/b than the usual: times the absorption of this mix over
    /// that of [`ChlorophyllMix::A_TO_B`], both from the bands in solution shifted by
    /// [`ChlorophyllMix::SHIFT_PER_CM`]. Bands keep the width that they have in leaves.
    Apportioned {
        /// Mass of a over mass of b, ≥ 0.
        a_to_b: f64,
    },
    /// Chlorophyll a and b from their bands in solution, which are narrower than in leaves.
    Bands {
        /// Mass of a over mass of b, ≥ 0.
        a_to_b: f64,
        /// Shift of all bands from ether to leaf, cm⁻¹, −3000 to 3000.
        shift_per_cm: f64,
        /// In-leaf over in-solution absorptivity, in (0, 1].
        packaging: f64,
    },
}

impl ChlorophyllMix {
    /// Shift that carries the red peak from 661 to 679 nm: an estimate from these two.
    pub const SHIFT_PER_CM: f64 = -400.0;
    /// PROSPECT-D's red peak over the solution's: an assumption, 0.3 to 0.45 are as likely.
    pub const PACKAGING: f64 = 0.41;
    /// Median a/b of the 276 leaves of ANGERS.
    pub const A_TO_B: f64 = 3.1;

    /// With the usual shift and packaging.
    pub fn bands(a_to_b: f64) -> Self {
        Self::Bands {
            a_to_b,
            shift_per_cm: Self::SHIFT_PER_CM,
            packaging: Self::PACKAGING,
        }
    }

    /// Specific absorption, cm² µg⁻¹, where the column is not PROSPECT's own, from that column by
    /// wavelength.
    pub(crate) fn specific(&self, nm: f64, prospect: impl Fn(f64) -> f64) -> Option<f64> {
        match *self {
            Self::Prospect => None,
            Self::Apportioned { a_to_b } => {
                let of = |bands: Bands| bands.unbounded(nm, Self::SHIFT_PER_CM);
                let mixed = |a_to_b: f64| (a_to_b * of(A) + of(B)) / (1.0 + a_to_b);
                // The widest Gaussians reach over the whole column, so this is never 0.
                Some(prospect(nm) * (mixed(a_to_b) / mixed(Self::A_TO_B)))
            }
            Self::Bands {
                a_to_b,
                shift_per_cm,
                packaging,
            } => {
                let of = |bands: Bands| bands.specific(nm, shift_per_cm, packaging);
                Some((a_to_b * of(A) + of(B)) / (1.0 + a_to_b))
            }
        }
    }

    pub(super) fn check(&self) -> Result<(), PigmentsError> {
        let ratio = |a_to_b: f64| {
            within(
                "chlorophyll a_to_b",
                a_to_b,
                (0.0..=1e6).contains(&a_to_b),
                "from 0 to 1e6",
            )
        };
        match *self {
            Self::Prospect => Ok(()),
            Self::Apportioned { a_to_b } => ratio(a_to_b),
            Self::Bands {
                a_to_b,
                shift_per_cm: shift,
                packaging: factor,
            } => {
                ratio(a_to_b)?;
                shift_per_cm("chlorophyll shift_per_cm", shift)?;
                packaging("chlorophyll packaging", factor)
            }
        }
    }
}
