//! The CIE 1931 2° standard observer, illuminant D65, and linear sRGB.

use std::sync::OnceLock;

use crate::spectrum::table::parse_shipped;

/// XYZ to linear sRGB (Rec. 709 primaries, D65 white), IEC 61966-2-1 with the primaries' exact
/// inverse.
pub const XYZ_TO_SRGB: [[f64; 3]; 3] = [
    [
        3.240_969_941_904_522,
        -1.537_383_177_570_094,
        -0.498_610_760_293_003_4,
    ],
    [
        -0.969_243_636_280_879_6,
        1.875_967_501_507_720_2,
        0.041_555_057_407_175_59,
    ],
    [
        0.055_630_079_696_993_66,
        -0.203_976_958_888_976_52,
        1.056_971_514_242_878_6,
    ],
];

fn observer_table() -> &'static [(f64, [f64; 3])] {
    static TABLE: OnceLock<Vec<(f64, [f64; 3])>> = OnceLock::new();
    TABLE.get_or_init(|| parse_shipped(include_str!("cie_1931_2deg.csv")))
}

fn d65_table() -> &'static [(f64, [f64; 1])] {
    static TABLE: OnceLock<Vec<(f64, [f64; 1])>> = OnceLock::new();
    TABLE.get_or_init(|| parse_shipped(include_str!("cie_d65.csv")))
}

fn interpolate<const C: usize>(table: &[(f64, [f64; C])], nm: f64) -> Option<[f64; C]> {
    let above = table.partition_point(|row| row.0 <= nm);
    let high = table
        .get(above)
        .or_else(|| table.last().filter(|row| row.0 == nm))?;
    let low = above.checked_sub(1).map(|below| &table[below])?;
    let share = if high.0 > low.0 {
        (nm - low.0) / (high.0 - low.0)
    } else {
        0.0
    };
    Some(std::array::from_fn(|i| {
        low.1[i] * (1.0 - share) + high.1[i] * share
    }))
}

/// Colour-matching functions x̄, ȳ, z̄ at a wavelength in nm; 0 outside 360–830 nm.
pub fn observer(nm: f64) -> [f64; 3] {
    interpolate(observer_table(), nm).unwrap_or([0.0; 3])
}

/// Relative power of illuminant D65 (100 at 560 nm); the end values hold outside 300–830 nm.
pub fn d65(nm: f64) -> f64 {
    interpolate(d65_table(), nm.clamp(300.0, 830.0)).map_or(0.0, |value| value[0])
}

/// Integral of ȳ over the observer's table, nm: radiance 1 at every wavelength has Y = 1 when
/// divided by it.
pub(crate) fn luminance_integral() -> f64 {
    static INTEGRAL: OnceLock<f64> = OnceLock::new();
    *INTEGRAL.get_or_init(|| {
        let table = observer_table();
        table
            .windows(2)
            .map(|w| 0.5 * (w[0].1[1] + w[1].1[1]) * (w[1].0 - w[0].0))
            .sum()
    })
}

/// Linear sRGB of XYZ.
pub fn srgb_from_xyz(xyz: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|row| {
        (0..3)
            .map(|column| XYZ_TO_SRGB[row][column] * xyz[column])
            .sum()
    })
}

/// XYZ of a spectral radiance given as a function of nm; equal energy of 1 gives Y = 1.
pub fn xyz_of(radiance: impl Fn(f64) -> f64) -> [f64; 3] {
    let mut xyz = [0.0; 3];
    for step in 0..=470 {
        let nm = 360.0 + f64::from(step);
        let weight = if step == 0 || step == 470 { 0.5 } else { 1.0 };
        let value = weight * radiance(nm) / luminance_integral();
        for (sum, matching) in xyz.iter_mut().zip(observer(nm)) {
            *sum += value * matching;
        }
    }
    xyz
}

/// XYZ under D65 of a surface that reflects or transmits this share of the light at each wavelength
/// in nm; a share of 1 everywhere gives Y = 1. Sums over 360–830 nm by 1 nm, D65 linear between the
/// 5 nm of its table.
pub fn xyz_under_d65(share: impl Fn(f64) -> f64) -> [f64; 3] {
    static WHITE: OnceLock<f64> = OnceLock::new();
    let white = *WHITE.get_or_init(|| xyz_of(d65)[1]);
    xyz_of(|nm| share(nm) * d65(nm)).map(|component| component / white)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_energy_has_the_chromaticity_of_illuminant_e() {
        let [x, y, z] = xyz_of(|_| 1.0);
        assert!((y - 1.0).abs() < 1e-9);
        assert!(
            (x / (x + y + z) - 1.0 / 3.0).abs() < 2e-4,
            "x = {}",
            x / (x + y + z)
        );
        assert!(
            (y / (x + y + z) - 1.0 / 3.0).abs() < 2e-4,
            "y = {}",
            y / (x + y + z)
        );
    }

    #[test]
    fn d65_has_its_published_chromaticity_and_is_neutral_in_srgb() {
        let xyz = xyz_of(d65);
        let sum: f64 = xyz.iter().sum();
        assert!(
            (xyz[0] / sum - 0.31272).abs() < 1e-4,
            "x = {}",
            xyz[0] / sum
        );
        assert!(
            (xyz[1] / sum - 0.32903).abs() < 1e-4,
            "y = {}",
            xyz[1] / sum
        );
        let rgb = srgb_from_xyz(xyz.map(|component| component / xyz[1]));
        for component in rgb {
            assert!((component - 1.0).abs() < 1e-3, "{rgb:?}");
        }
    }

    #[test]
    fn a_grey_surface_under_d65_is_grey_in_srgb() {
        let rgb = srgb_from_xyz(xyz_under_d65(|_| 0.25));
        for component in rgb {
            assert!((component - 0.25).abs() < 2.5e-4, "{rgb:?}");
        }
    }

    #[test]
    fn what_lies_outside_the_default_range_hardly_moves_white() {
        let all = xyz_of(d65);
        let cut = xyz_of(|nm| {
            if (400.0..=780.0).contains(&nm) {
                d65(nm)
            } else {
                0.0
            }
        });
        let chromaticity = |xyz: [f64; 3]| {
            let sum: f64 = xyz.iter().sum();
            [xyz[0] / sum, xyz[1] / sum]
        };
        let (a, b) = (chromaticity(all), chromaticity(cut));
        assert!(
            (a[0] - b[0]).abs() < 3e-4 && (a[1] - b[1]).abs() < 5e-4,
            "{a:?} against {b:?}"
        );
    }
}
