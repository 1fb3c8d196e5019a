//! Colours of spectra under an illuminant.

use glam::{DMat3, DVec3};

use crate::image::tone::to_srgb;
use crate::spectrum::cie::{XYZ_TO_SRGB, d65, observer};
use crate::spectrum::{Lanes, WavelengthSampler};

/// Wavelengths at which materials are evaluated: the middles of as many steps.
pub(super) const WAVELENGTHS: usize = 32;
/// Where the first step begins, nm, and how wide each is. Spectra of leaves are smooth; what lies
/// outside is less than a thousandth of what the observer sees.
const FIRST_NM: u32 = 400;
const STEP_NM: u32 = 10;

/// The light under which colours are seen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Illuminant {
    /// Daylight, CIE illuminant D65
    #[default]
    D65,
    /// Incandescent light, CIE illuminant A
    A,
    /// Equal power at all wavelengths, CIE illuminant E
    E,
}

impl Illuminant {
    /// Relative power at a wavelength in nm.
    fn power(self, nm: f64) -> f64 {
        match self {
            Self::D65 => d65(nm),
            // CIE 15: the black body of 2848 K with the second radiation constant of 1.435e7 nm K.
            Self::A => libm::pow(560.0 / nm, 5.0) / libm::expm1(1.435e7 / (2848.0 * nm)),
            Self::E => 1.0,
        }
    }
}

/// Response of cones to XYZ for adaptation to a white (Bradford), row by row.
const CONES: [[f64; 3]; 3] = [
    [0.8951, 0.2664, -0.1614],
    [-0.7502, 1.7135, 0.0367],
    [0.0389, -0.0685, 1.0296],
];

/// From reflectance or transmittance at the [`WAVELENGTHS`] to linear sRGB under an illuminant, to
/// which the eye has adapted: 1 at all wavelengths is white, 1 1 1.
#[derive(Clone, Debug)]
pub(super) struct Colorimetry([[f32; 3]; WAVELENGTHS]);

impl Colorimetry {
    pub(super) fn under(illuminant: Illuminant) -> Self {
        let steps: [DVec3; WAVELENGTHS] = std::array::from_fn(|step| {
            let first = FIRST_NM + step as u32 * STEP_NM;
            let each = (0..STEP_NM).map(|nm| f64::from(first + nm) + 0.5);
            each.map(|nm| DVec3::from(observer(nm)) * illuminant.power(nm))
                .sum()
        });
        let rows = |rows: [[f64; 3]; 3]| DMat3::from_cols_array_2d(&rows).transpose();
        let (cones, to_rgb) = (rows(CONES), rows(XYZ_TO_SRGB));
        let white: DVec3 = steps.iter().sum();
        let target = to_rgb.inverse() * DVec3::ONE;
        let gains = (cones * target) / (cones * white);
        let adapted = to_rgb * cones.inverse() * DMat3::from_diagonal(gains) * cones;
        Self(steps.map(|xyz| (adapted * xyz).as_vec3().to_array()))
    }

    /// Linear sRGB.
    pub(super) fn linear(&self, spectrum: &Lanes<WAVELENGTHS>) -> [f32; 3] {
        let mut rgb = [0.0; 3];
        for (weights, value) in self.0.iter().zip(spectrum.0) {
            for (sum, weight) in rgb.iter_mut().zip(weights) {
                *sum += weight * value;
            }
        }
        rgb
    }
}

/// The wavelengths with which a world has to be built for the export.
pub fn wavelengths() -> WavelengthSampler {
    let middle = |step| f64::from(FIRST_NM + step * STEP_NM) + 0.5 * f64::from(STEP_NM);
    let nm: Vec<f64> = (0..WAVELENGTHS as u32).map(middle).collect();
    WavelengthSampler::of_lists(WAVELENGTHS, &[&nm]).0
}

/// A linear value in [0, 1] as stored in a texture of colours; others are clipped.
pub(super) fn stored(linear: f32) -> u16 {
    stored_number(to_srgb(f64::from(linear.clamp(0.0, 1.0))) as f32)
}

/// A number in [0, 1] as stored in a texture; others are clipped.
pub(super) fn stored_number(number: f32) -> u16 {
    (255.0 * number.clamp(0.0, 1.0)).round() as u16
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::cie::{srgb_from_xyz, xyz_under_d65};

    #[test]
    fn a_leafs_colour_under_d65_is_that_of_the_whole_sum_and_white_is_white_under_all() {
        let curve = |nm: f64| 0.05 + 0.4 / (1.0 + libm::exp(-(nm - 600.0) / 15.0));
        let at = |of: &dyn Fn(f64) -> f64| {
            let sampler = wavelengths();
            Lanes(
                sampler
                    .grid()
                    .set::<WAVELENGTHS>(0)
                    .nm
                    .map(|nm| of(f64::from(nm)) as f32),
            )
        };
        let found = Colorimetry::under(Illuminant::D65).linear(&at(&curve));
        let exact = srgb_from_xyz(xyz_under_d65(curve));
        for (found, exact) in found.into_iter().zip(exact) {
            // 0.001 is a quarter of a step of a texture at its darkest here.
            assert!((f64::from(found) - exact).abs() < 1e-3, "{found} {exact}");
        }
        for illuminant in [Illuminant::D65, Illuminant::A, Illuminant::E] {
            let white = Colorimetry::under(illuminant).linear(&at(&|_| 1.0));
            assert!(
                white.iter().all(|value| (value - 1.0).abs() < 1e-5),
                "{white:?}"
            );
        }
    }
}
