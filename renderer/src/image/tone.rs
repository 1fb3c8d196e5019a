//! From linear light to 8-bit display values.

/// Curve before the sRGB encoding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tone {
    /// No curve, so that colours can be measured in the PNG.
    Linear,
    /// Highlights roll off as on film.
    Filmic,
}

/// Encodes linear sRGB as 8-bit values: exposure 2^EV, the curve, the sRGB encoding, rounding.
///
/// Values may be interleaved in any way, since each is encoded separately. NaN becomes 0.
pub fn to_bytes(linear: &[f32], exposure_ev: f64, tone: Tone) -> Vec<u8> {
    let encoded = encoded(linear, exposure_ev, tone);
    encoded
        .map(|value| libm::round(value * 255.0) as u8)
        .collect()
}

fn encoded(linear: &[f32], exposure_ev: f64, tone: Tone) -> impl Iterator<Item = f64> + '_ {
    let exposure = libm::exp2(exposure_ev);
    linear.iter().map(move |&value| {
        let light = f64::from(value) * exposure;
        let light = match tone {
            Tone::Linear => light,
            Tone::Filmic => filmic(light),
        };
        if light.is_nan() {
            0.0
        } else {
            to_srgb(light.clamp(0.0, 1.0))
        }
    })
}

/// A curve with the toe and shoulder of film: darks become a little darker, lights roll off towards
/// 1 instead of clipping.
///
/// `y = x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14)` for x ≥ 0, with x = 0.6 times the light.
/// Rises strictly up to where it reaches 1 (light about 12); 0.18 becomes 0.14. Works on each
/// channel alone, so very bright colours lose saturation, as on film.
///
/// # Source
///
/// \[narkowicz2016\], his rational fit to the ACES reference transform, with the factor 0.6 that he
/// gives for the original's exposure.
pub fn filmic(light: f64) -> f64 {
    let x = 0.6 * light.max(0.0);
    if x > 1e6 {
        return 1.0;
    }
    (x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14)).min(1.0)
}

/// The sRGB encoding of linear light in [0, 1].
///
/// # Source
///
/// IEC 61966-2-1: 12.92 c up to 0.0031308, above that 1.055 c^(1/2.4) − 0.055.
pub fn to_srgb(light: f64) -> f64 {
    if light <= 0.0031308 {
        12.92 * light
    } else {
        1.055 * libm::pow(light, 1.0 / 2.4) - 0.055
    }
}

/// The linear light that an sRGB value in [0, 1] stands for: the inverse of [`to_srgb`].
pub fn from_srgb(value: f64) -> f64 {
    if value <= 0.04045 {
        value / 12.92
    } else {
        libm::pow((value + 0.055) / 1.055, 2.4)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_values_are_encoded_as_known() {
        let light = [
            0.0,
            0.0031308,
            0.18,
            0.5,
            1.0,
            7.0,
            -1.0,
            f32::NAN,
            f32::INFINITY,
            f32::NEG_INFINITY,
        ];
        let expected = [0, 10, 118, 188, 255, 255, 0, 0, 255, 0];
        assert_eq!(to_bytes(&light, 0.0, Tone::Linear), expected);
    }

    #[test]
    fn one_stop_is_a_factor_of_two() {
        let light: Vec<f32> = (0..100).map(|i| i as f32 / 100.0).collect();
        let half: Vec<f32> = light.iter().map(|value| value / 2.0).collect();
        for tone in [Tone::Linear, Tone::Filmic] {
            assert_eq!(to_bytes(&half, 1.0, tone), to_bytes(&light, 0.0, tone));
            assert_eq!(to_bytes(&light, -1.0, tone), to_bytes(&half, 0.0, tone));
        }
    }

    #[test]
    fn encoding_and_decoding_are_inverse_and_meet_at_the_knee() {
        for i in 0..=1000 {
            let value = f64::from(i) / 1000.0;
            assert!((to_srgb(from_srgb(value)) - value).abs() < 1e-6, "{value}");
        }
        assert!((to_srgb(0.0031308) - to_srgb(0.0031309)).abs() < 1e-5);
    }

    #[test]
    fn the_filmic_curve_rises_from_black_to_white() {
        assert_eq!(filmic(0.0), 0.0);
        assert_eq!(filmic(f64::MAX), 1.0);
        assert!((filmic(0.18) - 0.14).abs() < 0.005);
        let mut last = 0.0;
        for i in 1..1100 {
            let now = filmic(f64::from(i) / 100.0);
            assert!(now > last && now <= 1.0, "{i}");
            last = now;
        }
        // Light at twice the clipping level is still distinguished.
        assert!(filmic(2.0) < 0.96 && filmic(4.0) > filmic(2.0) + 0.02);
    }
}
