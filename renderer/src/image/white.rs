//! White balance: what colour of light comes out white.
//!
//! - **In**: linear sRGB as the film has it, in which light like D65 is neutral.
//! - **Out**: linear sRGB in which the light of [`White`] is neutral.

use glam::{DMat3, DVec3};
use leafmodel::document::context::Context;
use leafmodel::document::limits::Limits;
use leafmodel::document::schema::Type;
use leafmodel::document::tree::{Node, Value};
use leafmodel::document::value_kind::{Kind, Number, Word};
use leafmodel::document::values::wrong_type;
use serde::{Deserialize, Serialize};

use crate::spectrum::cie::{XYZ_TO_SRGB, xyz_of};
use crate::spectrum::planck;

/// The light that comes out white.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub enum White {
    /// CIE illuminant D65, in which nothing is changed.
    D65,
    /// Light of this correlated colour temperature, K, from [`White::LEAST`] to [`White::MOST`]:
    /// daylight from 4000 K on, a black body below.
    Kelvin(f64),
}

impl White {
    /// The least temperature, K.
    pub const LEAST: f64 = 1500.0;
    /// The greatest temperature, K.
    pub const MOST: f64 = 25_000.0;

    /// The linear map of linear sRGB that makes this light white: von Kries' scaling of cone
    /// responses, the responses those of the Bradford transform.
    ///
    /// # Source
    ///
    /// \[lindbloom2017\], chromatic adaptation; ICC.1:2022, annex E.
    pub fn adaptation(self) -> DMat3 {
        match self {
            Self::D65 => DMat3::IDENTITY,
            Self::Kelvin(kelvin) => adaptation_to(white_of(kelvin)),
        }
    }
}

/// A word or a temperature.
#[derive(Clone, Copy, Debug)]
pub(super) struct WhiteKind;

const WORDS: [(&str, White); 1] = [("d65", White::D65)];
const WANTED: &str = "\"d65\", or a number: the colour temperature in K";
const KELVIN: Limits = Limits::closed(White::LEAST, White::MOST);

impl Kind for WhiteKind {
    type Of = White;

    fn read(&self, cx: &Context, node: &Node, key: &str) -> Option<White> {
        match &node.value {
            Value::Integer(_) | Value::Number(_) => {
                Number(KELVIN).read(cx, node, key).map(White::Kelvin)
            }
            Value::Text(text) if text == "d65" => Some(White::D65),
            Value::Text(_)
            | Value::Flag(_)
            | Value::Other(..)
            | Value::List(_)
            | Value::Table(_) => {
                wrong_type(cx, node, key, WANTED);
                None
            }
        }
    }

    fn write(&self, value: &White) -> Value {
        match value {
            White::D65 => Word(&WORDS).write(value),
            White::Kelvin(kelvin) => Number(KELVIN).write(kelvin),
        }
    }

    fn describe(&self) -> Type {
        let types = vec![Word(&WORDS).describe(), Number(KELVIN).describe()];
        Type::AnyOf(types, WANTED)
    }
}

/// The linear map of linear sRGB that makes a colour neutral and keeps its luminance.
pub fn neutralised([r, g, b]: [f64; 3]) -> DMat3 {
    let xyz = from_rows(XYZ_TO_SRGB).inverse() * DVec3::new(r, g, b);
    adaptation_to(xyz / xyz.y)
}

/// Least response of a cone to light that can come out white, as a share of its luminance. A black
/// body of [`White::LEAST`] has 0.045, light of a sodium lamp less than nothing.
const LEAST_RESPONSE: f64 = 0.01;

/// Whether a colour of linear sRGB can be made neutral: each cone responds to it.
pub fn is_balanceable([r, g, b]: [f64; 3]) -> bool {
    let xyz = from_rows(XYZ_TO_SRGB).inverse() * DVec3::new(r, g, b);
    let seen = from_rows(TO_CONES) * xyz;
    xyz.y > 0.0 && seen.is_finite() && seen.min_element() >= LEAST_RESPONSE * xyz.y
}

/// Responses of cones to XYZ by the Bradford transform.
const TO_CONES: [[f64; 3]; 3] = [
    [0.8951, 0.2664, -0.1614],
    [-0.7502, 1.7135, 0.0367],
    [0.0389, -0.0685, 1.0296],
];

/// The linear map of linear sRGB that makes light of this XYZ white; see [`White::adaptation`].
fn adaptation_to(white: DVec3) -> DMat3 {
    srgb_seen_under(white) * from_rows(XYZ_TO_SRGB).inverse()
}

/// The linear map of XYZ, seen by an eye that is adapted to this white, to linear sRGB, seen under
/// D65: it makes the white neutral.
pub(super) fn srgb_seen_under(white: DVec3) -> DMat3 {
    let to_cones = from_rows(TO_CONES);
    let to_xyz = from_rows(XYZ_TO_SRGB).inverse();
    let seen = to_cones * white;
    let shown = to_cones * to_xyz * DVec3::ONE;
    let adapted = to_cones.inverse() * DMat3::from_diagonal(shown / seen) * to_cones;
    to_xyz.inverse() * adapted
}

fn from_rows(rows: [[f64; 3]; 3]) -> DMat3 {
    DMat3::from_cols_array_2d(&rows).transpose()
}

/// XYZ of light of a temperature, Y = 1.
///
/// # Source
///
/// From 4000 K on CIE 015:2018, equations 4.7 to 4.9, daylight; below, Planck's law under the CIE
/// 1931 observer.
fn white_of(kelvin: f64) -> DVec3 {
    if kelvin < 4000.0 {
        let xyz = DVec3::from_array(xyz_of(|nm| planck::radiance(nm, kelvin)));
        return xyz / xyz.y;
    }
    let t = 1000.0 / kelvin;
    let [a, b, c, d] = if kelvin <= 7000.0 {
        [0.244_063, 0.099_11, 2.967_8, -4.607_0]
    } else {
        [0.237_040, 0.247_48, 1.901_8, -2.006_4]
    };
    let x = a + t * (b + t * (c + t * d));
    let y = -3.0 * x * x + 2.870 * x - 0.275;
    DVec3::new(x / y, 1.0, (1.0 - x - y) / y)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(found: DVec3, expected: [f64; 3], slack: f64) {
        let off = (found - DVec3::from_array(expected)).abs().max_element();
        assert!(off < slack, "{found} {expected:?}");
    }

    /// By colour-science 0.4: `matrix_chromatic_adaptation_VonKries(…, "Bradford")` between the
    /// chromaticities of `CCT_to_xy_CIE_D`, or of `sd_blackbody`, and of D65.
    #[test]
    fn colours_are_adapted_as_colour_science_does() {
        let colour = DVec3::new(0.4, 0.3, 0.1);
        for (kelvin, expected) in [
            (3000.0, [0.176_550_17, 0.350_707_87, 0.354_814_87]),
            (4000.0, [0.283_751_58, 0.321_140_64, 0.212_187_29]),
            (5000.0, [0.345_731_97, 0.308_373_67, 0.145_559_29]),
            (7500.0, [0.423_001_82, 0.297_254_04, 0.084_331]),
        ] {
            close(White::Kelvin(kelvin).adaptation() * colour, expected, 3e-4);
        }
    }

    #[test]
    fn a_colour_that_is_to_be_neutral_is_and_keeps_its_luminance() {
        for colour in [[0.4, 0.3, 0.1], [0.02, 0.03, 0.05], [7.0; 3]] {
            let found = neutralised(colour) * DVec3::from_array(colour);
            let expected = crate::spectrum::rgb::luminance(colour);
            close(found / expected, [1.0; 3], 1e-3);
        }
    }

    #[test]
    fn every_temperature_can_be_white_and_light_of_a_sodium_lamp_cannot() {
        let to_srgb = from_rows(XYZ_TO_SRGB);
        let response = (from_rows(TO_CONES) * white_of(White::LEAST)).z;
        assert!((response - 0.045).abs() < 1e-3, "{response}");
        for kelvin in [White::LEAST, 3000.0, 6500.0, White::MOST] {
            assert!(is_balanceable((to_srgb * white_of(kelvin)).to_array()));
        }
        for nm in [450.0, 560.0, 589.0, 650.0] {
            let light = to_srgb * DVec3::from_array(crate::spectrum::cie::observer(nm));
            assert!(!is_balanceable(light.to_array()), "{nm} nm");
        }
    }

    #[test]
    fn light_of_the_temperature_is_neutral_and_d65_leaves_all_as_it_is() {
        let to_srgb = from_rows(XYZ_TO_SRGB);
        for kelvin in [1500.0, 2856.0, 3999.0, 4000.0, 5200.0, 7001.0, 25_000.0] {
            let light = to_srgb * white_of(kelvin);
            close(White::Kelvin(kelvin).adaptation() * light, [1.0; 3], 1e-6);
        }
        assert_eq!(White::D65.adaptation(), DMat3::IDENTITY);
        // The illuminant's own temperature, nearly.
        let colour = DVec3::new(0.4, 0.3, 0.1);
        close(
            White::Kelvin(6504.0).adaptation() * colour,
            [0.4, 0.3, 0.1],
            5e-4,
        );
    }
}
