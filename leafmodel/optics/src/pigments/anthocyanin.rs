//! Anthocyanins by aglycone.

use super::bands::window;
use super::{PigmentsError, shares, within};

/// An anthocyanin by what remains of it without its sugar.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Aglycone {
    /// Orange-red.
    Pelargonidin,
    /// Red, that of most leaves.
    Cyanidin,
    /// Red-pink.
    Peonidin,
    /// Purple.
    Delphinidin,
    /// Purple.
    Petunidin,
    /// Purple-blue.
    Malvidin,
}

impl Aglycone {
    /// All of them, in the order of shares.
    pub const ALL: [Self; 6] = [
        Self::Pelargonidin,
        Self::Cyanidin,
        Self::Peonidin,
        Self::Delphinidin,
        Self::Petunidin,
        Self::Malvidin,
    ];

    /// As scenes spell it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Pelargonidin => "pelargonidin",
            Self::Cyanidin => "cyanidin",
            Self::Peonidin => "peonidin",
            Self::Delphinidin => "delphinidin",
            Self::Petunidin => "petunidin",
            Self::Malvidin => "malvidin",
        }
    }

    /// Peak in nm: Belitz, Grosch and Schieberle, Food Chemistry, table 18.22. Cyanidin's is that
    /// of PROSPECT-D's column.
    pub fn peak_nm(self) -> f64 {
        match self {
            Self::Pelargonidin => 520.0,
            Self::Cyanidin => PROSPECT_PEAK_NM,
            Self::Peonidin => 532.0,
            Self::Delphinidin => 544.0,
            Self::Petunidin => 543.0,
            Self::Malvidin => 542.0,
        }
    }

    /// Molar absorptivity of the 3-glucoside, L mol⁻¹ cm⁻¹; authors differ by a factor of up to
    /// 2.3.
    pub(super) fn epsilon(self) -> f64 {
        match self {
            Self::Pelargonidin => 25_800.0,
            Self::Cyanidin => 26_900.0,
            Self::Peonidin => 12_700.0,
            Self::Delphinidin => 29_000.0,
            Self::Petunidin => 15_900.0,
            Self::Malvidin => 28_000.0,
        }
    }

    /// Molar mass of the 3-glucoside (cation), g mol⁻¹.
    pub(super) fn molar_mass(self) -> f64 {
        match self {
            Self::Pelargonidin => 433.4,
            Self::Cyanidin => 449.4,
            Self::Peonidin => 463.4,
            Self::Delphinidin => 465.4,
            Self::Petunidin => 479.4,
            Self::Malvidin => 493.4,
        }
    }

    /// Height of the band over that of cyanidin; packaging is the same and cancels.
    fn height(self) -> f64 {
        self.epsilon()
            / self.molar_mass()
            / (Self::Cyanidin.epsilon() / Self::Cyanidin.molar_mass())
    }
}

/// Peak of PROSPECT-D's anthocyanin column, nm.
const PROSPECT_PEAK_NM: f64 = 535.0;

/// What the anthocyanin column consists of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AnthocyaninMix {
    /// PROSPECT-D's column.
    Prospect,
    /// PROSPECT-D's band, moved in wavenumber to each aglycone's peak and scaled by `ε / M`.
    Aglycones {
        /// Shares by mass in the order of [`Aglycone::ALL`], ≥ 0, sum 1.
        shares: [f64; 6],
        /// How far stacking and co-pigments move the peaks towards the red, nm, 0 to 45.
        shift_nm: f64,
        /// Share in the blue, quinonoidal form, 0 to 1.
        blue_fraction: f64,
    },
}

impl AnthocyaninMix {
    /// Peak of the quinonoidal form, nm: the middle of the 570 to 600 nm that are given for it.
    pub const BLUE_PEAK_NM: f64 = 585.0;

    /// Specific absorption, cm² µg⁻¹, where the column is not PROSPECT's own, from that column by
    /// wavelength. The blue form is taken to have the band's height: an assumption.
    pub(crate) fn specific(&self, nm: f64, prospect: impl Fn(f64) -> f64) -> Option<f64> {
        match self {
            Self::Prospect => None,
            Self::Aglycones {
                shares,
                shift_nm,
                blue_fraction,
            } => {
                let moved = |peak_nm: f64| {
                    if peak_nm == PROSPECT_PEAK_NM {
                        return prospect(nm);
                    }
                    let source = 1e7 / (1e7 / nm + 1e7 / PROSPECT_PEAK_NM - 1e7 / peak_nm);
                    prospect(source) * window(source, [400.0, 689.0])
                };
                let blue = if *blue_fraction > 0.0 {
                    moved(Self::BLUE_PEAK_NM)
                } else {
                    0.0
                };
                let sum = Aglycone::ALL
                    .iter()
                    .zip(shares)
                    .filter(|(_, share)| **share > 0.0)
                    .map(|(aglycone, share)| {
                        let red = moved(aglycone.peak_nm() + shift_nm);
                        let both = (1.0 - blue_fraction) * red + blue_fraction * blue;
                        share * aglycone.height() * both
                    })
                    .sum();
                Some(sum)
            }
        }
    }

    pub(super) fn check(&self) -> Result<(), PigmentsError> {
        match self {
            Self::Prospect => Ok(()),
            Self::Aglycones {
                shares: of,
                shift_nm,
                blue_fraction,
            } => {
                shares("anthocyanin shares", of)?;
                let shift_good = (0.0..=45.0).contains(shift_nm);
                within(
                    "anthocyanin shift_nm",
                    *shift_nm,
                    shift_good,
                    "from 0 to 45",
                )?;
                let blue_good = (0.0..=1.0).contains(blue_fraction);
                within(
                    "anthocyanin blue_fraction",
                    *blue_fraction,
                    blue_good,
                    "from 0 to 1",
                )
            }
        }
    }
}
