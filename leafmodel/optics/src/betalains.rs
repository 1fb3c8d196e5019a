//! What betalains absorb, which PROSPECT-D does not separate.
//!
//! Vacuolar pigments in place of anthocyanins ([`super::Contents::NEVER_TOGETHER`] says where). The
//! bands are Gaussians in wavelength: betacyanins those of betanin (peak 538 nm; the widths follow
//! from the ratios of absorbance that Nilsson's photometric method of 1970 rests on, unverified),
//! betaxanthins those of the class (peak 480 nm, width unverified). Absorptivities in solution
//! become absorptivities in leaves by a packaging factor of 0.5, by analogy with anthocyanin, whose
//! PROSPECT-D column is 0.41 to 0.53 of the solution's: an assumption.

use document::declared::{Declared, Words};

/// In-leaf over in-solution absorptivity of vacuolar pigments: an assumption, 0.4 to 0.55 are as
/// likely.
pub const PACKAGING: f64 = 0.5;

/// Which betalains there are, and how much they absorb in a leaf.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct Betalains {
    /// That of beet, or of amaranths.
    #[key("betacyanin", word)]
    pub betacyanin: Betacyanin,
    /// That of cacti, or of beet.
    #[key("betaxanthin", word)]
    pub betaxanthin: Betaxanthin,
    /// Absorptivity in the leaf over that in solution.
    ///
    /// 0.4 to 0.55 are likely.
    #[key("packaging", above(0.0, 1.0))]
    pub packaging: f64,
}

impl Default for Betalains {
    fn default() -> Self {
        Self {
            betacyanin: Betacyanin::default(),
            betaxanthin: Betaxanthin::default(),
            packaging: PACKAGING,
        }
    }
}

/// Standard deviations of betanin's band in nm, on its blue and its red side (unverified).
pub(super) const BETACYANIN_WIDTHS_NM: [f64; 2] = [41.0, 28.0];
/// That of betaxanthins' bands (unverified).
pub(super) const BETAXANTHIN_WIDTH_NM: f64 = 32.0;

/// Which betacyanin a leaf holds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Words)]
pub enum Betacyanin {
    /// That of beet and chard: peak 538 nm, 60 000 to 65 000 L mol⁻¹ cm⁻¹ in water.
    #[default]
    Betanin,
    /// That of amaranths: peak 536 nm, 56 600 L mol⁻¹ cm⁻¹ (unverified); betanin's widths.
    Amaranthine,
}

/// Which betaxanthin a leaf holds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Words)]
pub enum Betaxanthin {
    /// That of cacti: taken at 480 nm.
    #[default]
    Indicaxanthin,
    /// Vulgaxanthin I, of beet: taken at 477 nm.
    Vulgaxanthin,
}

impl Betacyanin {
    /// Molar absorptivity at the peak, L mol⁻¹ cm⁻¹.
    pub(super) fn epsilon(self) -> f64 {
        match self {
            Self::Betanin => 62_500.0,
            Self::Amaranthine => 56_600.0,
        }
    }

    /// Specific absorption in a leaf at a wavelength in nm, cm² µg⁻¹, with a packaging factor.
    pub fn specific(self, wavelength_nm: f64, packaging: f64) -> f64 {
        let (peak_nm, molar_mass) = match self {
            Self::Betanin => (538.0, 550.5),
            Self::Amaranthine => (536.0, 726.6),
        };
        let [blue, red] = BETACYANIN_WIDTHS_NM;
        let width = if wavelength_nm < peak_nm { blue } else { red };
        let peak = packaging * in_solution(self.epsilon(), molar_mass);
        peak * gaussian(wavelength_nm - peak_nm, width)
    }
}

impl Betaxanthin {
    /// Molar absorptivity at the peak, L mol⁻¹ cm⁻¹ (unverified).
    pub(super) fn epsilon(self) -> f64 {
        match self {
            Self::Indicaxanthin | Self::Vulgaxanthin => 48_000.0,
        }
    }

    /// Specific absorption in a leaf at a wavelength in nm, cm² µg⁻¹, with a packaging factor.
    pub fn specific(self, wavelength_nm: f64, packaging: f64) -> f64 {
        let (peak_nm, molar_mass) = match self {
            Self::Indicaxanthin => (480.0, 308.3),
            Self::Vulgaxanthin => (477.0, 339.3),
        };
        let peak = packaging * in_solution(self.epsilon(), molar_mass);
        peak * gaussian(wavelength_nm - peak_nm, BETAXANTHIN_WIDTH_NM)
    }
}

/// Specific absorption (Napierian, cm² µg⁻¹) in solution from a molar absorptivity (decadic, L
/// mol⁻¹ cm⁻¹) and a molar mass (g mol⁻¹).
pub fn in_solution(epsilon: f64, molar_mass: f64) -> f64 {
    epsilon * 1000.0 * std::f64::consts::LN_10 / molar_mass * 1e-6
}

fn gaussian(distance: f64, width: f64) -> f64 {
    let z = distance / width;
    libm::exp(-0.5 * z * z)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn betacyanin(nm: f64) -> f64 {
        Betacyanin::Betanin.specific(nm, PACKAGING)
    }

    #[test]
    fn absorptivities_in_solution_are_those_worked_out_by_hand() {
        // Cyanidin-3-glucoside: 26 900 L mol⁻¹ cm⁻¹ and 449.4 g mol⁻¹ are 0.1378 cm² µg⁻¹.
        assert!((in_solution(26_900.0, 449.4) - 0.1378).abs() < 5e-5);
        assert!((betacyanin(538.0) - 0.1307).abs() < 5e-4);
        assert!((Betaxanthin::Indicaxanthin.specific(480.0, PACKAGING) - 0.179).abs() < 5e-4);
    }

    #[test]
    fn betanin_has_the_ratios_that_its_photometry_rests_on() {
        let peak = betacyanin(538.0);
        assert!((peak / betacyanin(476.0) - 3.1).abs() < 0.1);
        assert!((betacyanin(600.0) / peak - 0.087).abs() < 0.005);
    }
}
