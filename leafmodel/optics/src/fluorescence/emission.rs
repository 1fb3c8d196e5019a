//! The spectrum of what chlorophyll emits within a leaf, before any of it is absorbed again.

/// First and last wavelength at which chlorophyll is taken to emit, nm.
pub const EMITTED_NM: [f64; 2] = [640.0, 850.0];

/// A band of Gauss's shape.
struct Band {
    /// Middle, nm.
    middle: f64,
    /// Full width at half maximum, nm.
    width: f64,
    /// Height over that of the first band.
    height: f64,
}

/// The bands near 685 nm, of photosystem II, and near 740 nm, of both photosystems.
///
/// # Source
///
/// Middles: \[palombi2011\], abstract. Widths: 30 and 52 nm, \[zarcotejada2002\], figure 2. Height:
/// such that the spectrum at 685 nm is twice that at 737 nm, as \[cordon2006\] found with both
/// physical corrections for re-absorption (abstract). None of them is fitted to what this module
/// computes.
const BANDS: [Band; 2] = [
    Band {
        middle: 685.0,
        width: 30.0,
        height: 1.0,
    },
    Band {
        middle: 740.0,
        width: 52.0,
        height: 0.516,
    },
];

/// `1 / (2 √(2 ln 2))`, standard deviation over full width at half maximum.
const DEVIATION_OVER_WIDTH: f64 = 0.424_660_900_144_009_5;

/// `φ(λ)`, share of the emitted photons for each nanometre, nm⁻¹: two bands of Gauss's shape within
/// [`EMITTED_NM`], over which it integrates to 1; 0 outside.
pub fn emission_spectrum(nm: f64) -> f64 {
    let [first, last] = EMITTED_NM;
    if !(first..=last).contains(&nm) {
        return 0.0;
    }
    let (mut value, mut whole) = (0.0, 0.0);
    for band in &BANDS {
        let deviation = band.width * DEVIATION_OVER_WIDTH;
        let off = |nm: f64| (nm - band.middle) / deviation;
        value += band.height * libm::exp(-0.5 * off(nm) * off(nm));
        let below = |nm: f64| libm::erf(off(nm) * std::f64::consts::FRAC_1_SQRT_2);
        let area = (std::f64::consts::PI / 2.0).sqrt() * (below(last) - below(first));
        whole += band.height * deviation * area;
    }
    value / whole
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_photons_are_emitted_somewhere_and_none_outside() {
        // Simpson's rule, of step 0.1 nm.
        let steps = 2100;
        let sum: f64 = (0..=steps)
            .map(|i| {
                let factor = match i {
                    0 | 2100 => 1.0,
                    i if i % 2 == 1 => 4.0,
                    _ => 2.0,
                };
                factor * emission_spectrum(640.0 + 0.1 * f64::from(i))
            })
            .sum();
        assert!((sum * 0.1 / 3.0 - 1.0).abs() < 1e-9, "{sum}");
        assert_eq!(emission_spectrum(639.9), 0.0);
        assert_eq!(emission_spectrum(850.1), 0.0);
    }

    #[test]
    fn the_peaks_have_a_ratio_of_two_to_one_where_they_were_published() {
        let ratio = emission_spectrum(685.0) / emission_spectrum(737.0);
        assert!((ratio - 2.0).abs() < 0.005, "{ratio}");
    }
}
