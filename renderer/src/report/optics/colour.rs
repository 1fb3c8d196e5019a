//! The colours of a leaf's R and T under D65.

use leafmodel::optics::ReflectanceTransmittance;
use serde_json::{Value, json};

use crate::image::tone::to_srgb;
use crate::spectrum::cie;

/// The method by which colours are computed, which is written into files.
const METHOD: &str = "XYZ by CIE 1931 2° under D65, 360 to 830 nm by 1 nm, Y of the perfect diffuser 1; R and T below 400 nm as at 400 nm; \
                      sRGB by IEC 61966-2-1, clipped to [0, 1]";

/// Colour of reflected and of transmitted light.
pub(crate) struct Colours {
    reflectance: Colour,
    transmittance: Colour,
}

/// A colour under D65.
struct Colour {
    xyz: [f64; 3],
    /// Encoded, in [0, 1].
    srgb: [f64; 3],
}

impl Colours {
    /// Of R and T by wavelength in nm.
    pub(crate) fn of(optics: impl Fn(f64) -> ReflectanceTransmittance) -> Self {
        Self {
            reflectance: Colour::of(|nm| optics(nm).reflectance),
            transmittance: Colour::of(|nm| optics(nm).transmittance),
        }
    }

    fn both(&self) -> [(&'static str, &Colour); 2] {
        [("R", &self.reflectance), ("T", &self.transmittance)]
    }

    /// A table for human readers.
    pub(crate) fn table(&self) -> String {
        let mut text = String::from("   X       Y       Z       sRGB                     hex");
        for (name, colour) in self.both() {
            let [x, y, z] = colour.xyz;
            let [r, g, b] = colour.srgb;
            text += &format!(
                "\n{name}  {x:.4}  {y:.4}  {z:.4}  {r:.4}  {g:.4}  {b:.4}  {}",
                colour.hex()
            );
        }
        text + "\n" + METHOD
    }

    /// JSON for programs.
    pub(crate) fn json(&self) -> Value {
        let of = |colour: &Colour| json!({ "xyz": colour.xyz, "srgb": colour.srgb, "hex": colour.hex() });
        json!({ "R": of(&self.reflectance), "T": of(&self.transmittance), "method": METHOD })
    }
}

impl Colour {
    fn of(share: impl Fn(f64) -> f64) -> Self {
        let xyz = cie::xyz_under_d65(share);
        let srgb = cie::srgb_from_xyz(xyz).map(|light| to_srgb(light.clamp(0.0, 1.0)));
        Self { xyz, srgb }
    }

    /// Hexadecimal notation.
    fn hex(&self) -> String {
        let bytes = self.srgb.map(|value| (255.0 * value).round() as u8);
        format!("#{:02x}{:02x}{:02x}", bytes[0], bytes[1], bytes[2])
    }
}

#[cfg(test)]
mod tests {
    use leafmodel::optics::{ProspectD, presets};

    use super::*;

    #[test]
    fn presets_have_the_colours_that_were_worked_out_elsewhere() {
        // Computed with another implementation of the model and of colorimetry; rounding may differ
        // by one step.
        for (name, reflected, transmitted) in [
            ("sun-green", 0x48_5f33, 0x3c_5600),
            ("white-sector", 0x9c_ab8d, 0xb6_c0a1),
            ("birch-yellow", 0xa4_803d, 0xa8_8029),
            ("smoke-tree-purple", 0x48_3a39, 0x37_1200),
        ] {
            let contents = presets::by_name(name).expect("a preset").contents;
            let colours = Colours::of(|nm| {
                ProspectD::coefficients_extrapolated(nm).reflectance_transmittance(&contents)
            });
            for (colour, wanted) in [
                (&colours.reflectance, reflected),
                (&colours.transmittance, transmitted),
            ] {
                for (channel, shift) in [16, 8, 0].into_iter().enumerate() {
                    let wanted = f64::from(wanted >> shift & 0xff_u32);
                    let got = 255.0 * colour.srgb[channel];
                    assert!((got - wanted).abs() < 1.6, "{name}: {}", colour.hex());
                }
            }
        }
    }

    #[test]
    fn what_reflects_everything_is_white() {
        let white = Colour::of(|_| 1.0);
        assert_eq!(white.hex(), "#ffffff");
        assert!((white.xyz[1] - 1.0).abs() < 1e-12);
        let black = Colour::of(|_| 0.0);
        assert_eq!(black.hex(), "#000000");
    }
}
