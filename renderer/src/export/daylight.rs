//! The colour of a flat leaf in daylight.

use glam::DVec2;
use leafmodel::blade::UvFrame;
use leafmodel::blade::contents_map::ContentsMap;
use leafmodel::optics::fast::PileLanes;
use leafmodel::optics::{Contents, Pigments, ProspectD};
use leafmodel::shape::outline::Outline;
use rayon::prelude::*;

use crate::image::tone::to_srgb;
use crate::spectrum::cie::{d65, observer, srgb_from_xyz};

/// Step between wavelengths, nm; the reflectance of leaves is smooth.
const STEP_NM: usize = 10;
/// The background, as in other drawings.
const PAPER: u8 = 255;

/// The conversion of contents, with one palette of pigments, to linear sRGB under D65.
struct Daylight(Vec<(PileLanes<1>, [f64; 3])>);

impl Daylight {
    fn new(pigments: &Pigments) -> Self {
        let wavelengths = || (400..=720).step_by(STEP_NM).map(f64::from);
        let white: f64 = wavelengths().map(|nm| d65(nm) * observer(nm)[1]).sum();
        let lane = |nm: f64| {
            let at = ProspectD::coefficients_of(pigments, nm);
            let xyz = observer(nm).map(|matching| matching * d65(nm) / white);
            (PileLanes::new(&[at]), srgb_from_xyz(xyz))
        };
        Self(wavelengths().map(lane).collect())
    }

    /// sRGB of the light reflected by a leaf with these contents; white paper is 255.
    fn colour(&self, contents: &Contents) -> [u8; 3] {
        let contents = contents.to_texel();
        let mut rgb = [0.0; 3];
        for (lane, weights) in &self.0 {
            let ([reflectance], _) = lane.reflectance_transmittance(&contents);
            for (sum, weight) in rgb.iter_mut().zip(weights) {
                *sum += weight * f64::from(reflectance);
            }
        }
        rgb.map(encoded)
    }
}

/// A linear value as sRGB byte.
fn encoded(linear: f64) -> u8 {
    (255.0 * to_srgb(linear.clamp(0.0, 1.0))).round() as u8
}

/// sRGB of the light that tissue of these contents reflects under D65.
pub(crate) fn colour_in_daylight(contents: &Contents, pigments: &Pigments) -> [u8; 3] {
    Daylight::new(pigments).colour(contents)
}

/// The reflectance of each texel under D65 as sRGB, apex up; outside of an outline there is white paper.
pub(crate) fn in_daylight(
    map: &ContentsMap,
    pigments: &Pigments,
    outline: Option<&Outline>,
) -> Vec<u8> {
    let daylight = Daylight::new(pigments);
    let within = outline.map(|outline| (outline, UvFrame::around(outline.points())));
    let (width, height) = (map.width as usize, map.height as usize);
    let mut picture = vec![PAPER; 3 * width * height];
    let rows = picture.par_chunks_mut(3 * width).enumerate();
    rows.for_each(|(from_top, pixels)| {
        let row = height - 1 - from_top;
        let v = (row as f64 + 0.5) / height as f64;
        for (column, pixel) in pixels.chunks_exact_mut(3).enumerate() {
            let u = (column as f64 + 0.5) / width as f64;
            let is_outside = within
                .as_ref()
                .is_some_and(|(outline, frame)| !outline.contains(frame.point(DVec2::new(u, v))));
            if !is_outside {
                let texel = map.texels[row * width + column];
                let contents = Contents::from_texel(texel);
                pixel.copy_from_slice(&daylight.colour(&contents));
            }
        }
    });
    picture
}

#[cfg(test)]
mod tests {
    use leafmodel::optics::pigments::AnthocyaninMix;
    use leafmodel::optics::presets::by_name;

    use super::*;

    /// Hue in degrees: 0 red, 60 yellow, 120 green.
    fn hue([r, g, b]: [u8; 3]) -> f64 {
        let [r, g, b] = [r, g, b].map(f64::from);
        let x = r - 0.5 * (g + b);
        let y = 0.75_f64.sqrt() * (g - b);
        libm::atan2(y, x).to_degrees()
    }

    #[test]
    fn contents_have_the_colours_that_were_computed_from_the_whole_spectrum() {
        // Values from the table by which these contents were chosen. The tolerance of two steps
        // allows for its wavelengths of 1 nm.
        let daylight = Daylight::new(&Pigments::default());
        for (name, expected) in [
            ("sun-green", [0x48, 0x5f, 0x33]),
            ("ginkgo-yellow", [0xc5, 0x95, 0x28]),
            ("sugar-maple-orange", [0xa5, 0x6e, 0x38]),
            ("red-maple-scarlet", [0x8b, 0x4a, 0x3d]),
        ] {
            let contents = by_name(name).expect("a preset").contents;
            let found = daylight.colour(&contents);
            for (found, expected) in found.into_iter().zip(expected) {
                assert!(
                    found.abs_diff(expected) <= 2,
                    "{name}: {found:02x} {expected:02x}"
                );
            }
        }
    }

    #[test]
    fn anthocyanins_in_their_blue_form_turn_a_red_leaf_purple() {
        let blue = Pigments {
            anthocyanins: Some(AnthocyaninMix {
                shares: [0.0, 1.0, 0.0, 0.0, 0.0, 0.0],
                shift_nm: 0.0,
                blue_fraction: 1.0,
            }),
            ..Pigments::default()
        };
        let contents = by_name("red-maple-scarlet").expect("a preset").contents;
        let [red, purple] =
            [Pigments::default(), blue].map(|pigments| Daylight::new(&pigments).colour(&contents));
        assert!(
            purple[0] < red[0] && purple[2] > red[2],
            "{red:?} {purple:?}"
        );
    }

    #[test]
    fn hues_run_from_green_over_yellow_and_orange_to_red() {
        let daylight = Daylight::new(&Pigments::default());
        let hues = [
            "sun-green",
            "poplar-yellow",
            "sugar-maple-orange",
            "red-maple-scarlet",
        ]
        .map(|name| hue(daylight.colour(&by_name(name).expect("a preset").contents)));
        assert!(
            hues.windows(2).all(|pair| pair[0] > pair[1] + 5.0),
            "{hues:?}"
        );
    }
}
