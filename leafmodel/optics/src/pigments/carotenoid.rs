//! Carotenoids, one by one.

use super::bands::Bands;
use super::{PigmentsError, packaging, shares, shift_per_cm};

/// A carotenoid for which there is a spectrum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Carotenoid {
    /// β-carotene.
    BetaCarotene,
    /// Lutein, most of what green leaves hold.
    Lutein,
    /// Zeaxanthin.
    Zeaxanthin,
    /// Violaxanthin, the first to go in autumn.
    Violaxanthin,
    /// Lycopene, of red fruit.
    Lycopene,
}

impl Carotenoid {
    /// All of them, in the order of shares.
    pub const ALL: [Self; 5] = [
        Self::BetaCarotene,
        Self::Lutein,
        Self::Zeaxanthin,
        Self::Violaxanthin,
        Self::Lycopene,
    ];

    /// As scenes spell it.
    pub fn name(self) -> &'static str {
        match self {
            Self::BetaCarotene => "beta_carotene",
            Self::Lutein => "lutein",
            Self::Zeaxanthin => "zeaxanthin",
            Self::Violaxanthin => "violaxanthin",
            Self::Lycopene => "lycopene",
        }
    }

    /// In methanol, from the plots of `LipidBank` as the R package `photobiologyPlants` carries
    /// them; the fit is ours, absolute heights unverified.
    pub(super) fn in_solution(self) -> Bands {
        let (gaussians, epsilon, molar_mass): (&'static [_], _, _) = match self {
            Self::BetaCarotene => (
                &[
                    [0.4140, 23818.0, 1861.0],
                    [0.2147, 23691.0, 567.0],
                    [0.6898, 22215.0, 643.0],
                    [0.6786, 20824.0, 526.0],
                ],
                139_500.0,
                536.9,
            ),
            Self::Lutein => (
                &[
                    [0.1990, 24046.0, 460.0],
                    [0.4420, 24009.0, 1880.0],
                    [0.6622, 22584.0, 582.0],
                    [0.7143, 21188.0, 460.0],
                ],
                144_800.0,
                568.9,
            ),
            Self::Zeaxanthin => (
                &[
                    [0.4509, 23706.0, 1916.0],
                    [0.2002, 23678.0, 473.0],
                    [0.6439, 22259.0, 614.0],
                    [0.6603, 20864.0, 512.0],
                ],
                144_300.0,
                568.9,
            ),
            Self::Violaxanthin => (
                &[
                    [0.2272, 24313.0, 362.0],
                    [0.4309, 24271.0, 1825.0],
                    [0.6842, 22835.0, 533.0],
                    [0.7984, 21443.0, 369.0],
                ],
                153_000.0,
                600.9,
            ),
            Self::Lycopene => (
                &[
                    [0.4151, 22856.0, 1953.0],
                    [0.2735, 22611.0, 463.0],
                    [0.6797, 21329.0, 439.0],
                    [0.7164, 20007.0, 435.0],
                ],
                185_000.0,
                536.9,
            ),
        };
        Bands {
            gaussians,
            range_nm: [370.0, 560.0],
            epsilon,
            molar_mass,
        }
    }
}

/// What the carotenoid column consists of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CarotenoidMix {
    /// PROSPECT-D's column.
    Prospect,
    /// Single carotenoids from their bands in solution.
    Bands {
        /// Shares by mass in the order of [`Carotenoid::ALL`], ≥ 0, sum 1.
        shares: [f64; 5],
        /// Shift of all bands from methanol to leaf, cm⁻¹, −3000 to 3000.
        shift_per_cm: f64,
        /// In-leaf over in-solution absorptivity, in (0, 1].
        packaging: f64,
    },
}

impl CarotenoidMix {
    /// About 20 nm at 450 nm, the lower end of the 20 to 30 nm said of carotenoids bound to protein
    /// (unverified).
    pub const SHIFT_PER_CM: f64 = -950.0;
    /// PROSPECT-D's 0.1699 cm² µg⁻¹ at 444 nm over that of lutein in solution: an assumption.
    pub const PACKAGING: f64 = 0.29;

    /// With the usual shift and packaging.
    pub fn bands(shares: [f64; 5]) -> Self {
        Self::Bands {
            shares,
            shift_per_cm: Self::SHIFT_PER_CM,
            packaging: Self::PACKAGING,
        }
    }

    /// Specific absorption, cm² µg⁻¹, where the column is not PROSPECT's own.
    pub(crate) fn specific(&self, nm: f64) -> Option<f64> {
        match self {
            Self::Prospect => None,
            Self::Bands {
                shares,
                shift_per_cm,
                packaging,
            } => Some(
                Carotenoid::ALL
                    .iter()
                    .zip(shares)
                    .map(|(carotenoid, share)| {
                        share
                            * carotenoid
                                .in_solution()
                                .specific(nm, *shift_per_cm, *packaging)
                    })
                    .sum(),
            ),
        }
    }

    pub(super) fn check(&self) -> Result<(), PigmentsError> {
        match self {
            Self::Prospect => Ok(()),
            Self::Bands {
                shares: of,
                shift_per_cm: shift,
                packaging: factor,
            } => {
                shares("carotenoid shares", of)?;
                shift_per_cm("carotenoid shift_per_cm", *shift)?;
                packaging("carotenoid packaging", *factor)
            }
        }
    }
}
