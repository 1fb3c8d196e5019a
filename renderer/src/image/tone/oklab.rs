//! The colour space Oklab, in which a colour of one hue lies on one ray.
//!
//! Linear sRGB times `k` has its coordinates times `k^(1/3)`, so hue and the ratio of chroma to
//! lightness do not depend on exposure.
//!
//! # Source
//!
//! \[ottosson2020\], matrices between linear sRGB and Oklab of 2021-01-25.

/// Lightness, and the two axes of chroma: green to red and blue to yellow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Oklab {
    /// Lightness; white has 1.
    pub(super) l: f64,
    /// Green to red.
    pub(super) a: f64,
    /// Blue to yellow.
    pub(super) b: f64,
}

const TO_CONES: [[f64; 3]; 3] = [
    [0.4122214708, 0.5363325363, 0.0514459929],
    [0.2119034982, 0.6806995451, 0.1073969566],
    [0.0883024619, 0.2817188376, 0.6299787005],
];

const FROM_CONES: [[f64; 3]; 3] = [
    [4.0767416621, -3.3077115913, 0.2309699292],
    [-1.2684380046, 2.6097574011, -0.3413193965],
    [-0.0041960863, -0.7034186147, 1.7076147010],
];

const CONES_TO_LAB: [[f64; 3]; 3] = [
    [0.2104542553, 0.7936177850, -0.0040720468],
    [1.9779984951, -2.4285922050, 0.4505937099],
    [0.0259040371, 0.7827717662, -0.8086757660],
];

const LAB_TO_CONES: [[f64; 3]; 3] = [
    [1.0, 0.3963377774, 0.2158037573],
    [1.0, -0.1055613458, -0.0638541728],
    [1.0, -0.0894841775, -1.2914855480],
];

/// A matrix times a column.
pub(super) fn times(matrix: &[[f64; 3]; 3], column: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row[0] * column[0] + row[1] * column[1] + row[2] * column[2])
}

impl Oklab {
    /// The coordinates of linear sRGB, whose channels may be negative.
    pub(super) fn of(rgb: [f64; 3]) -> Self {
        let [l, a, b] = times(&CONES_TO_LAB, times(&TO_CONES, rgb).map(libm::cbrt));
        Self { l, a, b }
    }

    /// Linear sRGB, with negative channels outside of its gamut.
    pub(super) fn rgb(self) -> [f64; 3] {
        let cones = times(&LAB_TO_CONES, [self.l, self.a, self.b]);
        times(&FROM_CONES, cones.map(|cone| cone * cone * cone))
    }

    /// Distance from grey.
    pub(super) fn chroma(self) -> f64 {
        libm::hypot(self.a, self.b)
    }

    /// The same lightness and hue with the chroma times a factor.
    pub(super) fn with_chroma_times(self, factor: f64) -> Self {
        Self {
            l: self.l,
            a: self.a * factor,
            b: self.b * factor,
        }
    }

    /// The same lightness and chroma with the hue of another colour; without any if that is grey.
    pub(super) fn with_hue_of(self, other: Self) -> Self {
        let share = self.chroma() / other.chroma().max(f64::MIN_POSITIVE);
        // A colour that is nearly grey has no hue to speak of: what is left of it fades with it.
        Self {
            l: self.l,
            a: other.a * share,
            b: other.b * share,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_primaries_have_their_published_coordinates() {
        // L, chroma, hue (degrees) of sRGB's primaries and white in the CSS Color 4 samples.
        for (rgb, [l, chroma, hue]) in [
            ([1.0, 0.0, 0.0], [0.62796, 0.25768, 29.234]),
            ([0.0, 1.0, 0.0], [0.86644, 0.29483, 142.495]),
            ([0.0, 0.0, 1.0], [0.45201, 0.31321, 264.052]),
        ] {
            let lab = Oklab::of(rgb);
            assert!((lab.l - l).abs() < 1e-4, "{lab:?}");
            assert!((lab.chroma() - chroma).abs() < 1e-4, "{lab:?}");
            let found = libm::atan2(lab.b, lab.a).to_degrees().rem_euclid(360.0);
            assert!((found - hue).abs() < 0.02, "{found} is not {hue}");
        }
        let white = Oklab::of([1.0; 3]);
        assert!((white.l - 1.0).abs() < 1e-6 && white.chroma() < 1e-6);
    }

    #[test]
    fn there_and_back_is_the_same_colour_even_if_a_channel_is_negative() {
        for rgb in [[0.3, 0.5, -0.04], [0.0, 0.0, 0.0], [7.0, 2.0, 0.1]] {
            let back = Oklab::of(rgb).rgb();
            for (one, other) in rgb.into_iter().zip(back) {
                assert!((one - other).abs() < 1e-6, "{rgb:?} came back as {back:?}");
            }
        }
    }
}
