//! Anthocyanins by aglycone.

use super::bands::window;
use super::shares;
use document::declared::{Declared, Words};
use document::keys::Keys;

/// An anthocyanin by what remains of it without its sugar.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Words)]
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
    /// Peak in nm: Belitz, Grosch and Schieberle, Food Chemistry, table 18.22. Cyanidin's is that
    /// of PROSPECT-D's column.
    pub(crate) fn peak_nm(self) -> f64 {
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

/// Shares of anthocyanins where none is named: cyanidin, that of most leaves.
const CYANIDIN: [f64; 6] = [0.0, 1.0, 0.0, 0.0, 0.0, 0.0];

/// PROSPECT-D's band, moved in wavenumber to each aglycone's peak and scaled by `ε / M`.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct AnthocyaninMix {
    /// How far stacking and co-pigments move the peaks towards the red.
    #[key("shift_nm", 0.0..=45.0)]
    pub shift_nm: f64,
    /// Share in the blue form with its peak at 585 nm; its height is assumed to be the red form's.
    #[key("blue_fraction", 0.0..=1.0)]
    pub blue_fraction: f64,
    /// Shares by mass in the order of [`Aglycone::WORDS`], ≥ 0, sum 1.
    #[key(with = named_shares)]
    pub shares: [f64; 6],
}

impl Default for AnthocyaninMix {
    fn default() -> Self {
        Self {
            shift_nm: 0.0,
            blue_fraction: 0.0,
            shares: CYANIDIN,
        }
    }
}

fn named_shares(mix: &mut AnthocyaninMix, keys: &mut Keys<'_>) {
    let mut named = (mix.shares != CYANIDIN).then_some(mix.shares);
    let new = || [0.0; 6];
    keys.optional_block("shares", &mut named, new, "Shares by mass.", |of, keys| {
        shares::<Aglycone, 6>(of, "anthocyanins", keys);
    });
    mix.shares = named.unwrap_or(CYANIDIN);
}

impl AnthocyaninMix {
    /// Peak of the quinonoidal form, nm: the middle of the 570 to 600 nm that are given for it.
    pub const BLUE_PEAK_NM: f64 = 585.0;

    /// Specific absorption, cm² µg⁻¹, from PROSPECT's own column by wavelength. The blue form is
    /// taken to have the band's height: an assumption.
    pub(crate) fn specific(&self, nm: f64, prospect: impl Fn(f64) -> f64) -> f64 {
        let moved = |peak_nm: f64| {
            if peak_nm == PROSPECT_PEAK_NM {
                return prospect(nm);
            }
            let source = 1e7 / (1e7 / nm + 1e7 / PROSPECT_PEAK_NM - 1e7 / peak_nm);
            prospect(source) * window(source, [400.0, 689.0])
        };
        let blue = if self.blue_fraction > 0.0 {
            moved(Self::BLUE_PEAK_NM)
        } else {
            0.0
        };
        let each = Aglycone::WORDS.iter().zip(self.shares);
        each.filter(|(_, share)| *share > 0.0)
            .map(|((_, aglycone), share)| {
                let red = moved(aglycone.peak_nm() + self.shift_nm);
                let both = (1.0 - self.blue_fraction) * red + self.blue_fraction * blue;
                share * aglycone.height() * both
            })
            .sum()
    }
}
