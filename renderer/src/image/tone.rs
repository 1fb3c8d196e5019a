//! From linear light to the values of a display.
//!
//! - **In**: linear sRGB of any strength and sign.
//! - **Out**: sRGB values from 0 to 1.
//! - **Always true**: each [`Tone`] is continuous in the light; with [`Tone::Agx`] and
//!   [`Tone::Standard`] the hue in Oklab stays and no channel of a colour is 0.

mod agx;
mod gamut;
mod oklab;
use leafmodel::document::limits::Limits;
use serde::{Deserialize, Serialize};

use self::gamut::Gamut;
use self::oklab::Oklab;

/// How light becomes what a display shows.
#[derive(Clone, Copy, Debug, Deserialize, Eq, PartialEq, Serialize)]
pub enum Tone {
    /// A photograph's curve over 16.5 stops, with the hue kept: `agx.rs`.
    Agx,
    /// No curve; colours that no display has are brought among those that it has with their hue:
    /// `gamut.rs`.
    Standard,
    /// Highlights of each channel roll off as on film.
    Filmic,
    /// No curve, each channel clipped, so that colours can be measured in the picture.
    Linear,
}

/// Strongest light that is told from stronger, so that no product overflows.
const MOST_LIGHT: f64 = 1e9;

impl Tone {
    /// Least and most contrast.
    pub(super) const CONTRASTS: Limits = Limits::closed(0.6, 2.0);
    /// Its words; of `none` the second is the older one.
    pub(super) const WORDS: [(&str, Self); 5] = [
        ("agx", Self::Agx),
        ("standard", Self::Standard),
        ("filmic", Self::Filmic),
        ("none", Self::Linear),
        ("linear", Self::Linear),
    ];

    /// Prepares for many colours; `contrast`, within its limits, is that of [`Tone::Agx`].
    pub fn prepared(self, contrast: f64) -> PreparedTone {
        PreparedTone {
            tone: self,
            agx: agx::Curve::new(contrast),
        }
    }
}

/// A tone with its contrast.
#[derive(Clone, Copy, Debug)]
pub struct PreparedTone {
    tone: Tone,
    agx: agx::Curve,
}

impl PreparedTone {
    /// The sRGB values, each 0 to 1, of linear sRGB light. A channel that is NaN counts as 0.
    pub fn encoded(&self, light: [f64; 3]) -> [f64; 3] {
        let light = light.map(|value| match value {
            value if value.is_nan() => 0.0,
            value => value.clamp(-MOST_LIGHT, MOST_LIGHT),
        });
        let shown = match self.tone {
            Tone::Agx => self.agx.formed(Oklab::of(light)),
            Tone::Standard => Gamut::Display.hold(Oklab::of(light)),
            Tone::Filmic => light.map(filmic),
            Tone::Linear => light,
        };
        shown.map(|value| to_srgb(value.clamp(0.0, 1.0)))
    }
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
fn filmic(light: f64) -> f64 {
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

    fn bytes(tone: Tone, light: [f64; 3]) -> [u8; 3] {
        tone.prepared(1.0)
            .encoded(light)
            .map(|value| libm::round(value * 255.0) as u8)
    }

    #[test]
    fn known_values_are_encoded_as_known() {
        for (light, expected) in [
            ([0.0, 0.0031308, 0.18], [0, 10, 118]),
            ([0.5, 1.0, 7.0], [188, 255, 255]),
            ([-1.0, f64::NAN, f64::INFINITY], [0, 0, 255]),
            ([f64::NEG_INFINITY, 0.0, 0.0], [0; 3]),
        ] {
            assert_eq!(bytes(Tone::Linear, light), expected);
        }
    }

    #[test]
    fn white_paper_is_neutral_and_as_bright_as_it_is() {
        for tone in [Tone::Agx, Tone::Standard, Tone::Filmic, Tone::Linear] {
            let [red, green, blue] = bytes(tone, [0.8; 3]);
            assert!(
                red == green && green == blue,
                "{tone:?}: {red} {green} {blue}"
            );
        }
        // Without a curve 0.8 of the light; with one, 0.8 of the scale half a stop brighter.
        let paper = from_srgb(Tone::Standard.prepared(1.0).encoded([0.8; 3])[1]);
        assert!((paper - 0.8).abs() < 1e-4, "{paper}");
        let paper = Tone::Agx.prepared(1.0).encoded([0.8 * 2.0_f64.sqrt(); 3])[1];
        assert!((paper - 0.8).abs() < 0.02, "{paper}");
    }

    #[test]
    fn a_colour_beyond_the_display_loses_its_blue_only_where_channels_are_bent_alone() {
        let leaf = [0.21, 0.3, -0.006];
        for (tone, has_blue) in [
            (Tone::Agx, true),
            (Tone::Standard, true),
            (Tone::Filmic, false),
            (Tone::Linear, false),
        ] {
            assert_eq!(bytes(tone, leaf)[2] > 0, has_blue, "{tone:?}");
        }
    }

    #[test]
    fn tones_are_continuous_where_a_channel_changes_its_sign() {
        for tone in [Tone::Agx, Tone::Standard, Tone::Filmic, Tone::Linear] {
            let mut last: Option<[f64; 3]> = None;
            for step in -2000..2000 {
                let now = tone
                    .prepared(1.0)
                    .encoded([0.4, 0.5, 5e-5 * f64::from(step)]);
                if let Some(last) = last {
                    for (one, other) in now.into_iter().zip(last) {
                        assert!(
                            (one - other).abs() < 2e-3,
                            "{tone:?} at {step}: {now:?} {last:?}"
                        );
                    }
                }
                last = Some(now);
            }
        }
    }

    #[test]
    fn no_light_is_too_strange() {
        for tone in [Tone::Agx, Tone::Standard, Tone::Filmic, Tone::Linear] {
            for red in [
                f64::NAN,
                f64::INFINITY,
                f64::NEG_INFINITY,
                1e300,
                -1e300,
                1e-300,
            ] {
                for green in [0.0, 1.0, f64::INFINITY, -1.0] {
                    let shown = tone.prepared(1.0).encoded([red, green, 1e-9]);
                    let is_shown = shown.iter().all(|value| (0.0..=1.0).contains(value));
                    assert!(is_shown, "{tone:?} of {red} {green}: {shown:?}");
                }
            }
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
