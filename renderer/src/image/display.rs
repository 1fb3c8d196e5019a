//! How a picture is shown: from the radiance of its layers to the pixels of a PNG or JPEG.
//!
//! Colours are those of the layers `R`, `G` and `B`; of a spectral picture, those that its bands
//! have together. With [`Display::alpha`] what lies behind everything is taken out of them.

use std::io::Write as _;
use std::path::Path;

use glam::DVec3;

use super::card;
use super::light_colour;
use super::pixels::{Depth, Pixels};
use super::tone::Tone;
use super::white::{White, neutralised};
use super::{Attribute, ImageError, Picture, REC709, atomic, jpeg, luminance, portable_network};
use crate::spectrum::WavelengthSampler;
use crate::spectrum::observer::Observer;

/// Settings of `[picture]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Display {
    /// Exposure: a factor of 2^EV on radiance.
    pub exposure_ev: f64,
    /// Whether light is brought to a middle grey first, by its mean logarithm.
    pub auto_exposure: bool,
    /// An object that is brought to a middle grey first, as a grey card.
    pub grey_object: Option<String>,
    /// The light that comes out white.
    pub white: White,
    /// An object that comes out without colour, instead.
    pub white_object: Option<String>,
    /// A light of the scene whose spectrum comes out white, instead.
    pub white_light: Option<String>,
    /// How light becomes what a display shows.
    pub tone: Tone,
    /// Depth of a PNG.
    pub depth: Depth,
    /// Whether a PNG has an alpha channel, and nothing behind what is partly there.
    pub alpha: bool,
}

impl Default for Display {
    fn default() -> Self {
        Self {
            exposure_ev: 0.0,
            auto_exposure: false,
            grey_object: None,
            white: White::D65,
            white_object: None,
            white_light: None,
            tone: Tone::Standard,
            depth: Depth::Eight,
            alpha: false,
        }
    }
}

/// Kinds of files that are looked at, by their ending.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// `.png`.
    Png,
    /// `.jpg` or `.jpeg`: 8 bits, without alpha.
    Jpeg,
}

impl FileKind {
    /// The kind of a file with this ending, if it is one.
    pub fn of(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()? {
            "png" => Some(Self::Png),
            "jpg" | "jpeg" => Some(Self::Jpeg),
            _ => None,
        }
    }
}

impl Display {
    /// Refuses settings that a file of this kind cannot have.
    ///
    /// # Errors
    ///
    /// [`ImageError::Inconsistent`] for a JPEG of 16 bits or with alpha.
    pub fn check(&self, kind: FileKind) -> Result<(), ImageError> {
        let cannot = match (kind, self.depth, self.alpha) {
            (FileKind::Jpeg, Depth::Sixteen, _) => "16 bits a channel",
            (FileKind::Jpeg, Depth::Eight, true) => "an alpha channel",
            (FileKind::Jpeg, Depth::Eight, false) | (FileKind::Png, ..) => return Ok(()),
        };
        let what = format!("a JPEG cannot have {cannot}: write a PNG, or leave that out");
        Err(ImageError::Inconsistent { what })
    }

    /// Writes a picture as a file of a kind.
    ///
    /// # Errors
    ///
    /// Those of [`Display::check`] and [`Display::pixels`]; [`ImageError::File`].
    pub fn write(&self, picture: &Picture, kind: FileKind, path: &Path) -> Result<(), ImageError> {
        self.check(kind)?;
        let pixels = self.pixels(picture)?;
        let bytes = match kind {
            FileKind::Png => portable_network::encoded_pixels(&pixels)?,
            FileKind::Jpeg => jpeg::encoded(&pixels)?,
        };
        atomic::replace(path, |file| file.write_all(&bytes))
    }

    /// The pixels that show a picture.
    ///
    /// # Errors
    ///
    /// [`ImageError::Inconsistent`] if it has neither colours nor bands, colours of other
    /// primaries than those of Rec. 709, no layer `A` where alpha is wanted, does not show an
    /// object by which it is balanced or exposed, or does not tell the light by which it is
    /// balanced.
    pub fn pixels(&self, picture: &Picture) -> Result<Pixels, ImageError> {
        let mut colours = colours(picture)?;
        let alpha = if self.alpha {
            let missing = || lacks("channel `A`, which alpha is made of");
            let alpha = &picture.layer("A").ok_or_else(missing)?.data;
            take_background_out(&mut colours, alpha, picture.width as usize);
            Some(alpha)
        } else {
            None
        };
        let mut exposure = libm::exp2(self.exposure_ev);
        if self.auto_exposure {
            exposure *= meter(&colours);
        }
        let neutral = match (&self.white_object, &self.white_light) {
            (Some(object), _) => Some(card::colour_of(picture, &colours, object)?),
            (None, Some(light)) => Some(light_colour::colour_of(picture, light)?),
            (None, None) => None,
        };
        let adaptation = match neutral {
            Some(colour) => Some(neutralised(colour)),
            None if self.white == White::D65 => None,
            None => Some(self.white.adaptation()),
        };
        if let Some(object) = &self.grey_object {
            let card = DVec3::from_array(card::colour_of(picture, &colours, object)?);
            let shown = adaptation.map_or(card, |adaptation| adaptation * card);
            exposure *= MIDDLE_GREY / luminance(shown.to_array());
        }
        let most = f64::from(self.depth.most());
        let stored = |value: f64| libm::round(value * most) as u16;
        let channels = if alpha.is_some() { 4 } else { 3 };
        let mut values = Vec::with_capacity(colours.len() * channels);
        for (pixel, colour) in colours.iter().enumerate() {
            let light = colour.map(|value| f64::from(value) * exposure);
            let light = adaptation.map_or(light, |adaptation| {
                (adaptation * DVec3::from_array(light)).to_array()
            });
            values.extend(self.tone.encoded(light).map(stored));
            if let Some(alpha) = alpha {
                values.push(stored(f64::from(alpha[pixel]).clamp(0.0, 1.0)));
            }
        }
        Ok(Pixels {
            width: picture.width,
            height: picture.height,
            depth: self.depth,
            channels: channels as u8,
            values,
        })
    }
}

/// Luminance of middle grey, on a scale where that of white is 1.
const MIDDLE_GREY: f64 = 0.18;

/// The factor that brings the mean logarithm of luminance to that of middle grey. Pixels without
/// light do not count; a picture without any keeps its exposure.
///
/// # Source
///
/// \[reinhard2002\], equations 1 and 2.
fn meter(colours: &[[f32; 3]]) -> f64 {
    let lit = colours
        .iter()
        .map(|colour| luminance(colour.map(f64::from)))
        .filter(|y| *y > 0.0 && y.is_finite());
    let (sum, count) = lit.fold((0.0, 0_u32), |(sum, count), y| {
        (sum + libm::log(y), count + 1)
    });
    if count == 0 {
        return 1.0;
    }
    MIDDLE_GREY / libm::exp(sum / f64::from(count))
}

fn lacks(what: &str) -> ImageError {
    ImageError::Inconsistent {
        what: format!("it has no {what}"),
    }
}

/// Linear sRGB of each pixel.
///
/// # Errors
///
/// [`ImageError::Inconsistent`] if the picture has neither colours nor bands, or colours of other
/// primaries than those of Rec. 709.
pub fn colours(picture: &Picture) -> Result<Vec<[f32; 3]>, ImageError> {
    let channels = ["R", "G", "B"].map(|name| picture.layer(name));
    if let [Some(red), Some(green), Some(blue)] = channels {
        if let Some(primaries @ Attribute::Chromaticities(_)) = picture.attribute("chromaticities")
            && *primaries != REC709
        {
            return Err(lacks("colours of the primaries of Rec. 709"));
        }
        let channels = red.data.iter().zip(&green.data).zip(&blue.data);
        return Ok(channels
            .map(|((&red, &green), &blue)| [red, green, blue])
            .collect());
    }
    let bands: Vec<(f64, &[f32])> = picture
        .layers
        .iter()
        .filter_map(|layer| Some((wavelength(&layer.name)?, layer.data.as_slice())))
        .collect();
    if bands.is_empty() {
        return Err(lacks("channels `R`, `G`, `B`, nor bands `S0.…nm`"));
    }
    Ok(colours_of_bands(&bands))
}

/// Linear sRGB in which a film's picture of light of this spectrum, a function of nm, is shown.
pub fn recorded_colour(film: &WavelengthSampler, spectrum: &dyn Fn(f32) -> f64) -> [f64; 3] {
    let recorded = film.recorded(spectrum);
    let Some(bands) = film.as_bands() else {
        return std::array::from_fn(|channel| recorded[channel]);
    };
    // Values beyond the range of floats are those of lights in an unusual unit.
    let most = recorded
        .iter()
        .fold(f64::MIN_POSITIVE, |most, value| most.max(*value));
    let values: Vec<[f32; 1]> = recorded
        .iter()
        .map(|value| [(value / most) as f32])
        .collect();
    let bands: Vec<(f64, &[f32])> = bands
        .iter()
        .zip(&values)
        .map(|(band, value)| (band.center_nm, &value[..]))
        .collect();
    colours_of_bands(&bands)[0].map(f64::from)
}

/// The wavelength, nm, in the name of a spectral channel: `S0.550,000000nm`.
fn wavelength(name: &str) -> Option<f64> {
    let nm = name.strip_prefix("S0.")?.strip_suffix("nm")?;
    nm.replace(',', ".")
        .parse()
        .ok()
        .filter(|nm: &f64| nm.is_finite())
}

/// The light that is seen, nm. Beyond it the eye has some thousandths of its sensitivity left,
/// which would tint a picture of the near infrared in red.
const SEEN_NM: std::ops::RangeInclusive<f64> = 400.0..=700.0;

/// Bands stand for the wavelengths around them; without any in sight they are shown in grey.
fn colours_of_bands(bands: &[(f64, &[f32])]) -> Vec<[f32; 3]> {
    let nearest = |nm: f64| {
        let distance = |i: &usize| (bands[*i].0 - nm).abs();
        let nearest = (0..bands.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        nearest.unwrap_or(0)
    };
    let mut weights = vec![[0.0_f32; 3]; bands.len()];
    if bands.iter().any(|band| SEEN_NM.contains(&band.0)) {
        for nm in (400..780).map(|nm| f64::from(nm) + 0.5) {
            for (sum, value) in weights[nearest(nm)]
                .iter_mut()
                .zip(Observer::Cie1931.srgb_at(nm))
            {
                *sum += value as f32;
            }
        }
    } else {
        weights.fill([1.0 / bands.len() as f32; 3]);
    }
    let mut colours = vec![[0.0; 3]; bands[0].1.len()];
    for (weight, (_, values)) in weights.iter().zip(bands) {
        for (colour, value) in colours.iter_mut().zip(*values) {
            for (sum, weight) in colour.iter_mut().zip(weight) {
                *sum += weight * value;
            }
        }
    }
    colours
}

/// Farthest pixel that is asked for the background of one at an edge.
const REACH: usize = 4;

/// What pixels show apart from what lies behind everything: (C − (1 − α) B) / α.
///
/// B is the mean of the nearest pixels in which nothing stands before it; a pixel with none near
/// stays as it is. Where nothing stands at all there is no colour.
fn take_background_out(colours: &mut [[f32; 3]], alpha: &[f32], width: usize) {
    let seen = colours.to_vec();
    let height = seen.len() / width;
    for (pixel, colour) in colours.iter_mut().enumerate() {
        let share = alpha[pixel];
        if share <= 0.0 {
            *colour = [0.0; 3];
        } else if share < 1.0
            && let Some(behind) = background(&seen, alpha, [width, height], pixel)
        {
            for (value, behind) in colour.iter_mut().zip(behind) {
                *value = ((*value - (1.0 - share) * behind) / share).max(0.0);
            }
        }
    }
}

/// Mean of the uncovered pixels on the smallest square around a pixel that has any.
fn background(
    seen: &[[f32; 3]],
    alpha: &[f32],
    [width, height]: [usize; 2],
    pixel: usize,
) -> Option<[f32; 3]> {
    let (x, y) = (pixel % width, pixel / width);
    (1..=REACH).find_map(|reach| {
        let (mut sum, mut count) = ([0.0; 3], 0.0);
        for row in y.saturating_sub(reach)..=(y + reach).min(height - 1) {
            for column in x.saturating_sub(reach)..=(x + reach).min(width - 1) {
                let other = row * width + column;
                if alpha[other] == 0.0 {
                    for (sum, value) in sum.iter_mut().zip(seen[other]) {
                        *sum += value;
                    }
                    count += 1.0;
                }
            }
        }
        (count > 0.0).then(|| sum.map(|sum: f32| sum / count))
    })
}

#[cfg(test)]
mod tests {
    use super::super::Layer;
    use super::*;
    use crate::image::tone::from_srgb;
    use crate::spectrum::cie::{srgb_from_xyz, xyz_of};
    use crate::spectrum::planck;

    fn picture(width: u32, layers: &[(&str, &[f32])]) -> Picture {
        Picture {
            width,
            height: layers[0].1.len() as u32 / width,
            layers: layers
                .iter()
                .map(|(name, data)| Layer {
                    name: (*name).to_owned(),
                    data: data.to_vec(),
                })
                .collect(),
            attributes: Vec::new(),
        }
    }

    #[test]
    fn one_stop_is_a_factor_of_two() {
        let grey = [0.1, 0.3, 0.45];
        let double = grey.map(|value| 2.0 * value);
        let once = picture(3, &[("R", &grey), ("G", &grey), ("B", &grey)]);
        let twice = picture(3, &[("R", &double), ("G", &double), ("B", &double)]);
        for tone in [Tone::Agx, Tone::Standard, Tone::Filmic, Tone::Linear] {
            let show = |exposure_ev, picture| {
                let display = Display {
                    exposure_ev,
                    tone,
                    ..Display::default()
                };
                display.pixels(picture).expect("it has colours").values
            };
            assert_eq!(show(1.0, &once), show(0.0, &twice), "{tone:?}");
            assert_eq!(show(0.0, &once), show(-1.0, &twice), "{tone:?}");
        }
    }

    #[test]
    fn the_meter_brings_any_light_to_middle_grey_and_stops_are_added() {
        let dim = [0.001, 0.004, 0.0, f32::NAN];
        let grey = picture(4, &[("R", &dim), ("G", &dim), ("B", &dim)]);
        let metered = |exposure_ev| {
            let display = Display {
                exposure_ev,
                auto_exposure: true,
                tone: Tone::Linear,
                depth: Depth::Sixteen,
                ..Display::default()
            };
            let values = display.pixels(&grey).expect("it has colours").values;
            from_srgb(f64::from(values[0]) / 65535.0)
        };
        // The geometric mean is 0.002.
        assert!((metered(0.0) - 0.09).abs() < 1e-4, "{}", metered(0.0));
        assert!((metered(1.0) - 0.18).abs() < 1e-4, "{}", metered(1.0));
        let black = picture(1, &[("R", &[0.0]), ("G", &[0.0]), ("B", &[0.0])]);
        let auto = Display {
            auto_exposure: true,
            ..Display::default()
        };
        assert_eq!(auto.pixels(&black).expect("it has colours").values, [0; 3]);
    }

    #[test]
    fn a_grey_card_comes_out_grey_at_the_same_light_as_any_other() {
        // A card that fills the lower two rows, below a sky that is not to count.
        let card = [0.05_f32, 0.03, 0.01];
        let layers: Vec<(&str, Vec<f32>)> = ["R", "G", "B"]
            .into_iter()
            .zip(card)
            .map(|(name, value)| (name, [vec![3.0; 2], vec![value; 4]].concat()))
            .chain([("id.object", vec![0.0, 0.0, 1.0, 1.0, 1.0, 1.0])])
            .collect();
        let layers: Vec<(&str, &[f32])> = layers
            .iter()
            .map(|(name, data)| (*name, data.as_slice()))
            .collect();
        let mut picture = picture(2, &layers);
        let names = Attribute::Text("1 card".to_owned());
        picture.attributes = vec![("lamina:objects".to_owned(), names)];
        let display = Display {
            white_object: Some("card".to_owned()),
            grey_object: Some("card".to_owned()),
            tone: Tone::Linear,
            depth: Depth::Sixteen,
            ..Display::default()
        };
        let pixels = display.pixels(&picture).expect("it shows the card");
        for value in &pixels.values[6..] {
            let linear = from_srgb(f64::from(*value) / 65535.0);
            assert!((linear - 0.18).abs() < 1e-3, "{linear}");
        }
        let other = Display {
            grey_object: Some("leaf".to_owned()),
            ..Display::default()
        };
        let error = other.pixels(&picture).expect_err("there is no leaf");
        assert!(error.to_string().contains("`leaf`"), "{error}");
    }

    #[test]
    fn a_white_that_is_set_makes_its_light_grey() {
        // Light of 3000 K, as linear sRGB.
        let [x, y, z] = xyz_of(|nm| planck::radiance(nm, 3000.0));
        let warm = srgb_from_xyz([0.5 * x / y, 0.5, 0.5 * z / y]).map(|value| [value as f32]);
        let lamp = picture(1, &[("R", &warm[0]), ("G", &warm[1]), ("B", &warm[2])]);
        let show = |white| {
            let display = Display {
                white,
                tone: Tone::Linear,
                ..Display::default()
            };
            display.pixels(&lamp).expect("it has colours").values
        };
        let [red, green, blue] = show(White::Kelvin(3000.0))[..] else {
            panic!("three channels");
        };
        assert!(
            red.abs_diff(green) <= 1 && green.abs_diff(blue) <= 1,
            "{red} {green} {blue}"
        );
        let seen = show(White::D65);
        assert!(seen[0] > seen[1] + 20 && seen[1] > seen[2] + 20, "{seen:?}");
    }

    #[test]
    fn an_edge_before_a_bright_sky_has_the_leafs_own_colour() {
        // Sky of 4, a leaf of 0.5, and pixels of both between them.
        let alpha = [0.0, 0.25, 0.75, 1.0, 1.0];
        let seen = alpha.map(|share| 0.5 * share + 4.0 * (1.0 - share));
        let picture = picture(
            5,
            &[("R", &seen), ("G", &seen), ("B", &seen), ("A", &alpha)],
        );
        let display = Display {
            tone: Tone::Linear,
            depth: Depth::Sixteen,
            alpha: true,
            ..Display::default()
        };
        let pixels = display.pixels(&picture).expect("it has alpha");
        assert_eq!((pixels.channels, pixels.values.len()), (4, 20));
        let leaf = pixels.values[16];
        for (pixel, share) in pixels.values.chunks(4).zip(alpha) {
            assert_eq!(pixel[3], (f64::from(share) * 65535.0).round() as u16);
            let expected = if share > 0.0 { leaf } else { 0 };
            assert!(pixel[0].abs_diff(expected) <= 1, "{pixel:?} at {share}");
        }
    }

    #[test]
    fn bands_stand_for_what_lies_around_them_and_infrared_is_grey() {
        let one = [1.0];
        let bands = |names: &[&str]| {
            let layers: Vec<(&str, &[f32])> = names.iter().map(|name| (*name, &one[..])).collect();
            colours(&picture(1, &layers)).expect("it has bands")[0]
        };
        let all = bands(&["S0.450,000000nm", "S0.550,000000nm", "S0.650,000000nm"]);
        let green = bands(&["S0.550,000000nm"]);
        // Any one band alone stands for all wavelengths.
        for (one, other) in all.into_iter().zip(green) {
            assert!((one - other).abs() < 1e-4, "{all:?} {green:?}");
        }
        assert_eq!(bands(&["S0.900,000000nm", "S0.1600,000000nm"]), [1.0; 3]);
        assert_eq!(bands(&["S0.725,000000nm", "S0.875,000000nm"]), [1.0; 3]);
    }

    #[test]
    fn what_cannot_be_shown_is_refused() {
        let grey = picture(1, &[("Y", &[0.5])]);
        assert!(Display::default().pixels(&grey).is_err());
        let mut colour = picture(1, &[("R", &[0.5]), ("G", &[0.5]), ("B", &[0.5])]);
        let with_alpha = Display {
            alpha: true,
            ..Display::default()
        };
        assert!(with_alpha.pixels(&colour).is_err());
        assert!(with_alpha.check(FileKind::Jpeg).is_err());
        let primaries = Attribute::Chromaticities([[0.3; 2]; 4]);
        colour.attributes = vec![("chromaticities".to_owned(), primaries)];
        assert!(Display::default().pixels(&colour).is_err());
    }
}
