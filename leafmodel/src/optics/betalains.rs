//! What betalains absorb, which PROSPECT-D does not separate.
//!
//! Vacuolar pigments of the Caryophyllales in place of anthocyanins. The bands are Gaussians in
//! wavelength: betacyanins those of betanin (peak 538 nm; the widths follow from the ratios of absorbance
//! that Nilsson's photometric method of 1970 rests on, unverified), betaxanthins those of the class
//! (peak 480 nm, width unverified). Absorptivities in solution become absorptivities in leaves by a packaging
//! factor of 0.5, by analogy with anthocyanin, whose PROSPECT-D column is 0.41 to 0.53 of the solution's: an assumption.

/// In-leaf over in-solution absorptivity of vacuolar pigments: an assumption, 0.4 to 0.55 are as likely.
pub const PACKAGING: f64 = 0.5;

/// Molar absorptivity of betanin in water at its peak, L mol⁻¹ cm⁻¹ (60 000 to 65 000).
const BETANIN_EPSILON: f64 = 62_500.0;
/// Molar mass of betanin, g mol⁻¹.
const BETANIN_MOLAR_MASS: f64 = 550.5;
/// Molar absorptivity of indicaxanthin and vulgaxanthin I, L mol⁻¹ cm⁻¹ (unverified).
const BETAXANTHIN_EPSILON: f64 = 48_000.0;
/// Molar mass of indicaxanthin, g mol⁻¹.
const INDICAXANTHIN_MOLAR_MASS: f64 = 308.3;

/// Specific absorption of betacyanins in a leaf at a wavelength in nm, cm² µg⁻¹.
pub fn betacyanin(wavelength_nm: f64) -> f64 {
    let width = if wavelength_nm < 538.0 { 41.0 } else { 28.0 };
    let peak = PACKAGING * in_solution(BETANIN_EPSILON, BETANIN_MOLAR_MASS);
    peak * gaussian(wavelength_nm - 538.0, width)
}

/// Specific absorption of betaxanthins in a leaf at a wavelength in nm, cm² µg⁻¹.
pub fn betaxanthin(wavelength_nm: f64) -> f64 {
    let peak = PACKAGING * in_solution(BETAXANTHIN_EPSILON, INDICAXANTHIN_MOLAR_MASS);
    peak * gaussian(wavelength_nm - 480.0, 32.0)
}

/// Specific absorption (Napierian, cm² µg⁻¹) in solution from a molar absorptivity (decadic, L mol⁻¹ cm⁻¹) and a molar mass (g mol⁻¹).
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

    #[test]
    fn absorptivities_in_solution_are_those_worked_out_by_hand() {
        // Cyanidin-3-glucoside: 26 900 L mol⁻¹ cm⁻¹ and 449.4 g mol⁻¹ are 0.1378 cm² µg⁻¹.
        assert!((in_solution(26_900.0, 449.4) - 0.1378).abs() < 5e-5);
        assert!((betacyanin(538.0) - 0.1307).abs() < 5e-4);
        assert!((betaxanthin(480.0) - 0.179).abs() < 5e-4);
    }

    #[test]
    fn betanin_has_the_ratios_that_its_photometry_rests_on() {
        let peak = betacyanin(538.0);
        assert!((peak / betacyanin(476.0) - 3.1).abs() < 0.1);
        assert!((betacyanin(600.0) / peak - 0.087).abs() < 0.005);
    }
}
