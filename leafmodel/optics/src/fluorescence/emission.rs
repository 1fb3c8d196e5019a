//! The spectrum of what chlorophyll emits within a leaf, before any of it is absorbed again.

use std::f64::consts::{FRAC_1_SQRT_2, PI};

/// First and last wavelength at which chlorophyll is taken to emit, nm.
pub const EMITTED_NM: [f64; 2] = [640.0, 850.0];

/// The wavelengths of [`EmissionSpectrum::new`]'s ratio, nm.
pub const RATIO_NM: [f64; 2] = [685.0, 737.0];

/// That ratio of leaves, found with both physical corrections for re-absorption: \[cordon2006\], abstract.
pub const RED_OVER_FAR_RED: f64 = 2.0;

/// A band of Gauss's shape and of height 1.
struct Band {
    /// Middle, nm.
    middle: f64,
    /// Full width at half maximum, nm.
    width: f64,
}

/// The bands near 685 nm, of photosystem II, and near 740 nm, of both photosystems.
///
/// # Source
///
/// Middles: \[palombi2011\], abstract. Widths: 30 and 52 nm, \[zarcotejada2002\], figure 2. None of them is fitted to
/// what this module computes.
const BANDS: [Band; 2] = [
    Band {
        middle: 685.0,
        width: 30.0,
    },
    Band {
        middle: 740.0,
        width: 52.0,
    },
];

/// `1 / (2 √(2 ln 2))`, standard deviation over full width at half maximum.
const DEVIATION_OVER_WIDTH: f64 = 0.424_660_900_144_009_5;

impl Band {
    /// Distance from the middle in standard deviations.
    fn off(&self, nm: f64) -> f64 {
        (nm - self.middle) / (self.width * DEVIATION_OVER_WIDTH)
    }

    fn at(&self, nm: f64) -> f64 {
        libm::exp(-0.5 * self.off(nm) * self.off(nm))
    }

    /// Its integral over [`EMITTED_NM`], nm.
    fn area(&self) -> f64 {
        let [first, last] = EMITTED_NM.map(|nm| libm::erf(self.off(nm) * FRAC_1_SQRT_2));
        self.width * DEVIATION_OVER_WIDTH * (PI / 2.0).sqrt() * (last - first)
    }
}

/// `φ(λ)`: two bands of Gauss's shape, in photons, whose integral over [`EMITTED_NM`] is 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EmissionSpectrum {
    /// Heights of both bands, nm⁻¹.
    heights: [f64; 2],
}

impl EmissionSpectrum {
    /// With `φ(685 nm) / φ(737 nm)`, in [0.2, 50]. The more of the light photosystem I emits, the lower it is.
    pub fn new(red_over_far_red: f64) -> Self {
        let [red, far_red] = &BANDS;
        let above = |band: &Band| band.at(RATIO_NM[0]) - red_over_far_red * band.at(RATIO_NM[1]);
        let second = (above(red) / -above(far_red)).max(0.0);
        let whole = red.area() + second * far_red.area();
        Self {
            heights: [1.0 / whole, second / whole],
        }
    }

    /// Fraction of the emitted photons for each nanometre, nm⁻¹; 0 outside of [`EMITTED_NM`].
    pub fn at(&self, nm: f64) -> f64 {
        let [first, last] = EMITTED_NM;
        if !(first..=last).contains(&nm) {
            return 0.0;
        }
        let bands = BANDS.iter().zip(self.heights);
        bands.map(|(band, height)| height * band.at(nm)).sum()
    }
}

impl Default for EmissionSpectrum {
    fn default() -> Self {
        Self::new(RED_OVER_FAR_RED)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_photons_are_emitted_somewhere_and_none_outside() {
        for ratio in [0.2, RED_OVER_FAR_RED, 6.0, 50.0] {
            let spectrum = EmissionSpectrum::new(ratio);
            // Simpson's rule, of step 0.1 nm.
            let steps = 2100;
            let sum: f64 = (0..=steps)
                .map(|i| {
                    let factor = match i {
                        0 | 2100 => 1.0,
                        i if i % 2 == 1 => 4.0,
                        _ => 2.0,
                    };
                    factor * spectrum.at(640.0 + 0.1 * f64::from(i))
                })
                .sum();
            assert!((sum * 0.1 / 3.0 - 1.0).abs() < 1e-9, "{sum}");
            assert_eq!(spectrum.at(639.9), 0.0);
            assert_eq!(spectrum.at(850.1), 0.0);
        }
    }

    #[test]
    fn the_bands_have_the_ratio_that_was_asked_for() {
        for ratio in [0.2, RED_OVER_FAR_RED, 6.0, 50.0] {
            let [red, far_red] = RATIO_NM.map(|nm| EmissionSpectrum::new(ratio).at(nm));
            assert!((red / far_red / ratio - 1.0).abs() < 1e-12, "{ratio}");
        }
    }
}
