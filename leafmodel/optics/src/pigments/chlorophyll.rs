//! Chlorophyll a and b.

use super::bands::Bands;
use document::declared::{Declared, Words};
use document::keys::Keys;

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

/// Chlorophyll a and b apart.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
#[key(last = only_in_solution)]
pub struct ChlorophyllMix {
    /// Mass of a over mass of b; the median of the leaves of ANGERS is 3.1.
    #[key("a_to_b", required, 0.0..=1e6)]
    pub a_to_b: f64,
    /// `"leaf"`: PROSPECT-D's column times what the ratio changes, as wide as in leaves; at 3.1 it
    /// is PROSPECT-D's to the bit. `"solution"`: the bands in diethyl ether alone, which are
    /// narrower: with 45 µg cm⁻² a sun leaf turns from green `#485f33` to olive `#77732e`.
    #[key("bands", word)]
    pub bands: ChlorophyllBands,
    /// Shift of the bands from solution to leaf.
    #[key("shift_per_cm", -3000.0..=3000.0, when = self.are_in_solution(keys))]
    pub shift_per_cm: f64,
    /// Absorptivity in the leaf over that in solution.
    #[key("packaging", above(0.0, 1.0), when = self.are_in_solution(keys))]
    pub packaging: f64,
}

/// The bands of chlorophyll a and b.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Words)]
pub enum ChlorophyllBands {
    /// PROSPECT-D's column with another a/b than the usual: times the absorption of this mix over
    /// that of [`ChlorophyllMix::A_TO_B`], both from the bands in solution shifted by
    /// [`ChlorophyllMix::SHIFT_PER_CM`]. Bands keep the width that they have in leaves.
    #[default]
    Leaf,
    /// Those in solution, which are narrower than in leaves, shifted and packed.
    Solution,
}

impl Default for ChlorophyllMix {
    fn default() -> Self {
        Self {
            a_to_b: Self::A_TO_B,
            bands: ChlorophyllBands::Leaf,
            shift_per_cm: Self::SHIFT_PER_CM,
            packaging: Self::PACKAGING,
        }
    }
}

/// Reports keys that only bands in solution have.
fn only_in_solution(mix: &mut ChlorophyllMix, keys: &mut Keys<'_>) {
    if mix.bands == ChlorophyllBands::Solution || keys.reader().is_none() {
        return;
    }
    if keys.is_sound() {
        for key in ["shift_per_cm", "packaging"] {
            if keys.has(key) {
                let problem =
                    "only bands in solution are shifted and packed; those of leaves are so already";
                let help = "write bands = \"solution\" beside it, or leave it out";
                keys.refuse(&[key], problem.to_owned(), help);
            }
        }
    }
    *mix = ChlorophyllMix {
        a_to_b: mix.a_to_b,
        ..ChlorophyllMix::default()
    };
}

impl ChlorophyllMix {
    /// Shift that carries the red peak from 661 to 679 nm: an estimate from these two.
    pub const SHIFT_PER_CM: f64 = -400.0;
    /// PROSPECT-D's red peak over the solution's: an assumption, 0.3 to 0.45 are as likely.
    pub const PACKAGING: f64 = 0.41;
    /// Median a/b of the 276 leaves of ANGERS.
    pub const A_TO_B: f64 = 3.1;

    /// From bands in solution, with the default shift and packaging.
    pub fn bands(a_to_b: f64) -> Self {
        Self {
            a_to_b,
            bands: ChlorophyllBands::Solution,
            ..Self::default()
        }
    }

    /// Whether the keys of bands in solution belong here; where the block has errors, nobody knows.
    fn are_in_solution(&self, keys: &Keys<'_>) -> bool {
        let is_unknown = keys.is_description() || keys.reader().is_some() && !keys.is_sound();
        self.bands == ChlorophyllBands::Solution || is_unknown
    }

    /// Specific absorption, cm² µg⁻¹, from PROSPECT's own column by wavelength.
    pub(crate) fn specific(&self, nm: f64, prospect: impl Fn(f64) -> f64) -> f64 {
        let a_to_b = self.a_to_b;
        match self.bands {
            ChlorophyllBands::Leaf => {
                let of = |bands: Bands| bands.unbounded(nm, Self::SHIFT_PER_CM);
                let mixed = |a_to_b: f64| (a_to_b * of(A) + of(B)) / (1.0 + a_to_b);
                // The widest Gaussians reach over the whole column, so this is never 0.
                prospect(nm) * (mixed(a_to_b) / mixed(Self::A_TO_B))
            }
            ChlorophyllBands::Solution => {
                let of = |bands: Bands| bands.specific(nm, self.shift_per_cm, self.packaging);
                (a_to_b * of(A) + of(B)) / (1.0 + a_to_b)
            }
        }
    }
}
