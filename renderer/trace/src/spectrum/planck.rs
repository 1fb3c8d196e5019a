//! Thermal radiation.

/// Planck's spectral radiance of a black body, W m⁻² sr⁻¹ nm⁻¹.
///
/// `nm` is the vacuum wavelength, `kelvin` the temperature, both > 0. Constants: CODATA 2018
/// (exact).
pub fn radiance(nm: f64, kelvin: f64) -> f64 {
    const PLANCK: f64 = 6.626_070_15e-34;
    const LIGHT: f64 = 2.997_924_58e8;
    const BOLTZMANN: f64 = 1.380_649e-23;
    let metres = nm * 1e-9;
    let exponent = PLANCK * LIGHT / (metres * BOLTZMANN * kelvin);
    let per_metre = 2.0 * PLANCK * LIGHT * LIGHT / libm::pow(metres, 5.0) / libm::expm1(exponent);
    per_metre * 1e-9
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_integral_over_all_wavelengths_is_stefan_and_boltzmanns() {
        let kelvin = 5772.0;
        let total: f64 = (0..200_000)
            .map(|i| radiance(50.0 + f64::from(i), kelvin))
            .sum::<f64>()
            * std::f64::consts::PI;
        let expected = 5.670_374_419e-8 * libm::pow(kelvin, 4.0);
        assert!(
            (total / expected - 1.0).abs() < 1e-4,
            "{total} against {expected}"
        );
    }

    #[test]
    fn the_peak_lies_where_wien_says() {
        let kelvin = 5000.0;
        let peak = (300..2000)
            .max_by(|&a, &b| {
                radiance(f64::from(a), kelvin).total_cmp(&radiance(f64::from(b), kelvin))
            })
            .map(f64::from);
        assert!(
            (peak.unwrap_or(0.0) - 2.897_771_955e6 / kelvin).abs() <= 1.0,
            "{peak:?}"
        );
    }
}
