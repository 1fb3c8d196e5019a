//! What the stored values of a PNG or JPEG picture mean: the light of each value, and the primaries.
//!
//! - **In**: what the file says of its colours: an ICC profile, code points (CICP), or nothing.
//! - **Out**: linear light of each value, and the chromaticities of red, green, blue and white.
//! - **Left out**: profiles whose conversion is a table over three colours, and CMYK. They are
//!   refused.

use moxcms::{ColorProfile, DataColorSpace, ToneReprCurve, Xyzd};

use super::error::ImageError;
use super::picture::{Picture, REC709_POINTS};
use super::primaries::REC2020;
use super::tone::from_srgb;

/// Luminance of white in pictures of the curve PQ, cd/m² (ITU-R BT.2408): what is 1 here.
const PQ_WHITE: f64 = 203.0;

/// The light of a value in [0, 1].
type TransferCurve = Box<dyn Fn(f64) -> f64>;

/// What values of a picture mean, whatever its file says of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stored {
    /// Colours, as sRGB stores them.
    Srgb,
    /// Numbers from 0 to 1.
    Numbers,
}

/// What values mean.
pub(super) struct Encoding {
    /// Of red, green and blue; one for all three if there is only one.
    curves: Vec<TransferCurve>,
    points: [[f32; 2]; 4],
}

impl Encoding {
    /// sRGB, which is meant where nothing is said.
    pub(super) fn srgb() -> Self {
        Self::even(from_srgb, REC709_POINTS)
    }

    /// What is meant by values that are stored so.
    pub(super) fn of(stored: Stored) -> Self {
        match stored {
            Stored::Srgb => Self::srgb(),
            Stored::Numbers => Self::even(|value| value, REC709_POINTS),
        }
    }

    /// One curve for all channels, and primaries.
    pub(super) fn even(curve: impl Fn(f64) -> f64 + 'static, points: [[f32; 2]; 4]) -> Self {
        let curves: Vec<TransferCurve> = vec![Box::new(curve)];
        Self { curves, points }
    }

    /// What the code points of ITU-T H.273 say: primaries, transfer, matrix, full range.
    ///
    /// # Errors
    ///
    /// [`ImageError::Malformed`] for those that are not read.
    pub(super) fn of_code_points(
        [primaries, transfer, matrix]: [u8; 3],
        full: bool,
    ) -> Result<Self, ImageError> {
        let unread = |what: String| {
            let help = "save it with sRGB values, or as EXR";
            Err(ImageError::malformed(format_args!(
                "its code points (cICP) name {what}, which is not read: {help}"
            )))
        };
        if matrix != 0 || !full {
            return unread("a narrow range or colour differences".to_owned());
        }
        let d65 = REC709_POINTS[3];
        let points = match primaries {
            1 => REC709_POINTS,
            5 => [[0.64, 0.33], [0.29, 0.60], [0.15, 0.06], d65],
            6 | 7 => [[0.630, 0.340], [0.310, 0.595], [0.155, 0.070], d65],
            9 => REC2020,
            11 => [
                [0.680, 0.320],
                [0.265, 0.690],
                [0.150, 0.060],
                [0.314, 0.351],
            ],
            12 => [[0.680, 0.320], [0.265, 0.690], [0.150, 0.060], d65],
            other => return unread(format!("the primaries {other}")),
        };
        Ok(match transfer {
            1 | 6 | 14 | 15 => Self::even(from_rec709_camera, points),
            4 => Self::even(|value| libm::pow(value, 2.2), points),
            5 => Self::even(|value| libm::pow(value, 2.8), points),
            8 => Self::even(|value| value, points),
            13 => Self::even(from_srgb, points),
            16 => Self::even(|value| from_pq(value) / PQ_WHITE, points),
            18 => return unread("hybrid log-gamma".to_owned()),
            other => return unread(format!("the transfer characteristics {other}")),
        })
    }

    /// What an ICC profile says.
    ///
    /// # Errors
    ///
    /// [`ImageError::Malformed`] if it is damaged, of CMYK, or has a table instead of primaries.
    pub(super) fn of_profile(profile: &[u8]) -> Result<Self, ImageError> {
        let refused = |why: &str| {
            ImageError::malformed(format_args!(
                "its colour profile (ICC) {why}: convert the picture to sRGB"
            ))
        };
        let profile = ColorProfile::new_from_slice(profile)
            .map_err(|error| refused(&format!("cannot be read ({error})")))?;
        let curve = |trc: &Option<ToneReprCurve>| -> Result<TransferCurve, ImageError> {
            let trc = trc.as_ref().ok_or_else(|| refused("has no curves"))?;
            let light = trc.make_linear_evaluator();
            let light = light
                .map_err(|error| refused(&format!("has curves that are not valid ({error})")))?;
            Ok(Box::new(move |value| {
                f64::from(light.evaluate_value(value as f32)).clamp(0.0, 1.0)
            }))
        };
        if profile.color_space == DataColorSpace::Gray {
            let curves = vec![curve(&profile.gray_trc)?];
            return Ok(Self {
                curves,
                points: REC709_POINTS,
            }
            .or_srgb());
        }
        if profile.color_space != DataColorSpace::Rgb {
            return Err(refused("is of CMYK or another space than RGB"));
        }
        let colorants = [
            profile.red_colorant,
            profile.green_colorant,
            profile.blue_colorant,
        ];
        if profile.pcs != DataColorSpace::Xyz
            || colorants.iter().any(|of| of.x + of.y + of.z <= 0.0)
        {
            return Err(refused(
                "has a table instead of primaries, which is not read",
            ));
        }
        // They are relative to D50, the white of profiles.
        let point = |xyz: Xyzd| {
            let sum = xyz.x + xyz.y + xyz.z;
            [(xyz.x / sum) as f32, (xyz.y / sum) as f32]
        };
        let [red, green, blue] = colorants.map(point);
        let white = colorants.into_iter().fold(Xyzd::default(), |sum, of| Xyzd {
            x: sum.x + of.x,
            y: sum.y + of.y,
            z: sum.z + of.z,
        });
        let curves = [&profile.red_trc, &profile.green_trc, &profile.blue_trc];
        let curves = curves.into_iter().map(curve).collect::<Result<_, _>>()?;
        let points = [red, green, blue, point(white)];
        Ok(Self { curves, points }.or_srgb())
    }

    /// sRGB itself if this is sRGB but for rounding, as its profiles are.
    fn or_srgb(self) -> Self {
        const ROUNDING: f64 = 2e-3;
        let is_even = |curve: &TransferCurve| {
            let mut steps = (0..=64).map(|step| f64::from(step) / 64.0);
            steps.all(|value| (curve(value) - from_srgb(value)).abs() < ROUNDING)
        };
        let map = super::primaries::to_rec709(self.points);
        let is_near = match map {
            Ok(None) => true,
            Ok(Some(map)) => map.abs_diff_eq(glam::DMat3::IDENTITY, ROUNDING),
            Err(_) => false,
        };
        if is_near && self.curves.iter().all(is_even) {
            Self::srgb()
        } else {
            self
        }
    }

    /// Colours as linear light, with their primaries as an attribute.
    pub(super) fn linear(&self, pixels: &image::ImageBuffer<image::Rgb<u16>, Vec<u16>>) -> Picture {
        let (width, height) = pixels.dimensions();
        // 8-bit values arrive as 257 times themselves, so one table serves both.
        let tables = self.curves.iter().map(|light| {
            let shares = (0..=u16::MAX).map(|value| f64::from(value) / 65535.0);
            shares.map(|share| light(share) as f32).collect()
        });
        let tables: Vec<Vec<f32>> = tables.collect();
        let channel = |number: usize| {
            let table = &tables[number.min(tables.len() - 1)];
            let values = pixels.pixels().map(|pixel| pixel.0[number]);
            values.map(|value| table[usize::from(value)]).collect()
        };
        Picture::of_colours([width, height], [0, 1, 2].map(channel), self.points)
    }
}

/// The light before a camera that stores by Rec. 709, 601 or 2020.
fn from_rec709_camera(value: f64) -> f64 {
    if value < 0.081 {
        value / 4.5
    } else {
        libm::pow((value + 0.099) / 1.099, 1.0 / 0.45)
    }
}

/// Luminance by the curve PQ (SMPTE ST 2084), cd/m².
fn from_pq(value: f64) -> f64 {
    let power = libm::pow(value, 32.0 / 2523.0);
    let ratio = (power - 0.835_937_5).max(0.0) / (18.851_562_5 - 18.6875 * power);
    10_000.0 * libm::pow(ratio, 8192.0 / 1305.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pq_has_its_published_values() {
        // ITU-R BT.2408: 58.07 % is 203 cd/m², 75.18 % is 1000 cd/m².
        for (value, luminance) in [
            (0.0, 0.0),
            (0.5807, 203.0),
            (0.7518, 1000.0),
            (1.0, 10_000.0),
        ] {
            let found = from_pq(value);
            assert!(
                (found - luminance).abs() <= 5e-3 * luminance,
                "{value}: {found}"
            );
        }
    }

    #[test]
    fn cameras_of_rec_709_store_half_of_the_light_as_0_705() {
        for (value, light) in [(0.0, 0.0), (0.04, 0.04 / 4.5), (0.70552, 0.5), (1.0, 1.0)] {
            assert!((from_rec709_camera(value) - light).abs() < 1e-4, "{value}");
        }
        let below = from_rec709_camera(0.080_999);
        assert!((from_rec709_camera(0.081_001) - below).abs() < 1e-4);
    }

    #[test]
    fn a_profile_of_srgb_is_srgb_and_one_of_display_p3_has_its_primaries() {
        let of = |profile: &ColorProfile| {
            let bytes = profile.encode().expect("a good profile");
            Encoding::of_profile(&bytes).expect("a good profile")
        };
        let srgb = of(&ColorProfile::new_srgb());
        assert_eq!(srgb.points, REC709_POINTS);
        assert_eq!(
            (srgb.curves.len(), (srgb.curves[0])(0.5)),
            (1, from_srgb(0.5))
        );
        let wide = of(&ColorProfile::new_display_p3());
        let map = super::super::primaries::to_rec709(wide.points);
        let map = map.expect("real primaries").expect("other primaries");
        let red = super::super::primaries::mapped(map, [1.0, 0.0, 0.0]);
        // By colour-science 0.4: red of Display P3 in linear sRGB.
        for (found, expected) in red.into_iter().zip([1.2249, -0.0421, -0.0196]) {
            assert!((found - expected).abs() < 2e-3, "{red:?}");
        }
        assert!(((wide.curves[0])(0.5) - from_srgb(0.5)).abs() < 1e-3);
    }

    #[test]
    fn what_is_not_read_is_refused_with_the_reason() {
        for (points, full, word) in [
            ([9, 18, 0], true, "hybrid log-gamma"),
            ([9, 16, 9], true, "colour differences"),
            ([1, 13, 0], false, "narrow range"),
            ([200, 13, 0], true, "primaries 200"),
        ] {
            let refused = Encoding::of_code_points(points, full).map(|_| ());
            let text = refused.expect_err("it is not read").to_string();
            assert!(text.contains(word), "{text}");
        }
        let refused = Encoding::of_profile(b"no profile").map(|_| ());
        assert!(
            refused
                .expect_err("damaged")
                .to_string()
                .contains("convert the picture to sRGB")
        );
    }
}
