//! Carotenoids, one by one.

use super::bands::Bands;
use super::shares;
use document::declared::{Declared, Words};
use document::keys::Keys;

/// A carotenoid for which there is a spectrum.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Words)]
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

/// Single carotenoids from their bands in solution.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct CarotenoidMix {
    /// Shift of the bands from solution to leaf.
    #[key("shift_per_cm", -3000.0..=3000.0)]
    pub shift_per_cm: f64,
    /// Absorptivity in the leaf over that in solution.
    #[key("packaging", above(0.0, 1.0))]
    pub packaging: f64,
    /// Shares by mass.
    ///
    /// In the order of [`Carotenoid::WORDS`], ≥ 0, sum 1.
    #[key("shares", required, block, with = carotenoids)]
    pub shares: [f64; 5],
}

fn carotenoids(of: &mut [f64; 5], keys: &mut Keys<'_>) {
    shares::<Carotenoid, 5>(of, "carotenoids", keys);
}

impl Default for CarotenoidMix {
    fn default() -> Self {
        Self::bands([0.0; 5])
    }
}

impl CarotenoidMix {
    /// About 20 nm at 450 nm, the lower end of the 20 to 30 nm said of carotenoids bound to protein
    /// (unverified).
    pub const SHIFT_PER_CM: f64 = -950.0;
    /// PROSPECT-D's 0.1699 cm² µg⁻¹ at 444 nm over that of lutein in solution: an assumption.
    pub const PACKAGING: f64 = 0.29;

    /// With the default shift and packaging.
    pub fn bands(shares: [f64; 5]) -> Self {
        Self {
            shares,
            shift_per_cm: Self::SHIFT_PER_CM,
            packaging: Self::PACKAGING,
        }
    }

    /// Specific absorption, cm² µg⁻¹.
    pub(crate) fn specific(&self, nm: f64) -> f64 {
        let each = Carotenoid::WORDS.iter().zip(self.shares);
        each.map(|((_, carotenoid), share)| {
            let bands = carotenoid.in_solution();
            share * bands.specific(nm, self.shift_per_cm, self.packaging)
        })
        .sum()
    }
}
