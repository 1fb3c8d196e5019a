//! Differences between colours as eyes see them: CIELAB and CIEDE2000.

use std::f64::consts::{PI, TAU};

/// CIELAB L*, a*, b* of XYZ beside a white of XYZ.
///
/// # Source
///
/// ISO/CIE 11664-4.
pub fn lab(xyz: [f64; 3], white: [f64; 3]) -> [f64; 3] {
    let bent: [f64; 3] = std::array::from_fn(|i| {
        let t = xyz[i] / white[i];
        let knee = 6.0_f64 / 29.0;
        if t > knee * knee * knee {
            libm::cbrt(t)
        } else {
            t / (3.0 * knee * knee) + 4.0 / 29.0
        }
    });
    let [x, y, z] = bent;
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// CIEDE2000 between two colours of CIELAB, with all parametric factors 1.
///
/// # Source
///
/// ISO/CIE 11664-6; \[sharma2005\] has the formula with its cases and the pairs that test it.
pub(crate) fn ciede2000(one: [f64; 3], other: [f64; 3]) -> f64 {
    let seventh = |c: f64| {
        let c7 = libm::pow(c, 7.0);
        libm::sqrt(c7 / (c7 + libm::pow(25.0, 7.0)))
    };
    let mean_chroma = 0.5 * (libm::hypot(one[1], one[2]) + libm::hypot(other[1], other[2]));
    let stretch = 1.0 + 0.5 * (1.0 - seventh(mean_chroma));
    let polar = |[l, a, b]: [f64; 3]| {
        let a = stretch * a;
        let hue = if a == 0.0 && b == 0.0 {
            0.0
        } else {
            libm::atan2(b, a).rem_euclid(TAU)
        };
        (l, libm::hypot(a, b), hue)
    };
    let ((l1, c1, h1), (l2, c2, h2)) = (polar(one), polar(other));
    let is_grey = c1 * c2 == 0.0;
    let mut turn = h2 - h1;
    if is_grey {
        turn = 0.0;
    } else if turn > PI {
        turn -= TAU;
    } else if turn < -PI {
        turn += TAU;
    }
    let by_hue = 2.0 * libm::sqrt(c1 * c2) * libm::sin(0.5 * turn);
    let (lightness, chroma) = (0.5 * (l1 + l2), 0.5 * (c1 + c2));
    let hue = if is_grey {
        h1 + h2
    } else if (h1 - h2).abs() <= PI {
        0.5 * (h1 + h2)
    } else if h1 + h2 < TAU {
        0.5 * (h1 + h2) + PI
    } else {
        0.5 * (h1 + h2) - PI
    };
    let cos_deg = |factor: f64, less: f64| libm::cos(factor * hue - less.to_radians());
    let t = 1.0 - 0.17 * cos_deg(1.0, 30.0) + 0.24 * cos_deg(2.0, 0.0) + 0.32 * cos_deg(3.0, -6.0)
        - 0.20 * cos_deg(4.0, 63.0);
    let from_blue = (hue.to_degrees() - 275.0) / 25.0;
    let rotation = -libm::sin(60.0_f64.to_radians() * libm::exp(-from_blue * from_blue))
        * 2.0
        * seventh(chroma);
    let from_middle = (lightness - 50.0) * (lightness - 50.0);
    let by_l = (l2 - l1) / (1.0 + 0.015 * from_middle / libm::sqrt(20.0 + from_middle));
    let by_c = (c2 - c1) / (1.0 + 0.045 * chroma);
    let by_h = by_hue / (1.0 + 0.015 * chroma * t);
    let square = by_l * by_l + by_c * by_c + by_h * by_h + rotation * by_c * by_h;
    libm::sqrt(square.max(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_are_those_of_the_published_pairs() {
        // Of the 34 pairs those that reach every case of the formula.
        for (one, other, expected) in [
            ([50.0, 2.6772, -79.7751], [50.0, 0.0, -82.7485], 2.0425),
            ([50.0, 0.0, 0.0], [50.0, -1.0, 2.0], 2.3669),
            ([50.0, 2.49, -0.001], [50.0, -2.49, 0.0009], 7.1792),
            ([50.0, 2.49, -0.001], [50.0, -2.49, 0.0011], 7.2195),
            ([50.0, 2.5, 0.0], [50.0, 0.0, -2.5], 4.3065),
            ([50.0, 2.5, 0.0], [73.0, 25.0, -18.0], 27.1492),
            ([50.0, 2.5, 0.0], [61.0, -5.0, 29.0], 22.8977),
            (
                [60.2574, -34.0099, 36.2677],
                [60.4626, -34.1751, 39.4387],
                1.2644,
            ),
            ([2.0776, 0.0795, -1.135], [0.9033, -0.0636, -0.5514], 0.9082),
        ] {
            for (one, other) in [(one, other), (other, one)] {
                let found = ciede2000(one, other);
                assert!(
                    (found - expected).abs() < 5e-5,
                    "{one:?} {other:?}: {found}"
                );
            }
        }
    }

    #[test]
    fn white_is_100_and_dark_colours_are_linear() {
        let white = [0.95, 1.0, 1.09];
        let of = |share: f64| lab(white.map(|value| share * value), white);
        assert_eq!(of(1.0)[0], 100.0);
        assert!((of(0.18)[0] - 49.496).abs() < 1e-3);
        assert!((of(0.002)[0] - 2.0 * of(0.001)[0]).abs() < 1e-12);
        assert!(of(0.18)[1].abs() < 1e-12 && of(0.18)[2].abs() < 1e-12);
    }
}
