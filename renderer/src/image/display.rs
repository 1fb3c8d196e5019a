//! How a picture is shown: from the radiance of its layers to the pixels of a PNG or JPEG.
//!
//! Colours are those of the layers `R`, `G` and `B`; of a spectral picture, those that its bands
//! have together. With [`Display::alpha`] what lies behind everything is taken out of them.

use std::io::Write as _;
use std::path::Path;

use glam::DVec3;
use leafmodel::document::declared::{Declared, Defaults};
use leafmodel::document::keys::Keys;
use leafmodel::document::value_kind::{Flag, Text, Word};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::colours::{mapped, to_rec709};
use super::error::ImageError;
use super::picture::{Picture, luminance};
use super::pixels::{Depth, Pixels};
use super::tone::Tone;
use super::white::{White, WhiteKind, neutralised};
use super::{atomic, card, jpeg, light_colour, portable_network};
use crate::spectrum::observer::Observer;
use crate::spectrum::{Share, WavelengthSampler};

/// Settings of `[picture]`.
#[derive(Clone, Debug, Declared, Defaults, Deserialize, PartialEq, Serialize)]
#[key(last = Self::one_alone)]
pub struct Display {
    /// Radiance is multiplied by 2 to this power.
    #[key("exposure_ev", -30.0..=30.0)]
    pub exposure_ev: f64,
    /// Whether light is brought to middle grey (0.18) first, by the mean logarithm of the picture's
    /// luminance; `exposure_ev` is then more or less than that.
    #[key("auto_exposure")]
    pub auto_exposure: bool,
    /// An object that is brought to middle grey (0.18) first, such as a grey card, instead of the whole
    /// picture; `exposure_ev` is then more or less than that.
    #[key("grey_object", OBJECT)]
    pub grey_object: Option<String>,
    /// The light that comes out white: `"d65"`, in which colours are as the film has them, or a colour
    /// temperature in K (daylight from 4000 on, a black body below).
    #[key("white", WhiteKind, default = White::D65)]
    pub white: White,
    /// An object that comes out without colour, such as a grey card, instead of `white`.
    #[key("white_object", OBJECT)]
    pub white_object: Option<String>,
    /// A light whose spectrum comes out white, instead of `white`: the mean of all that it sends out.
    /// Of `daylight` it is sun and sky on level ground; `NAME.sun` and `NAME.sky` are one of them.
    #[key("white_light", Text("the name of a light"))]
    pub white_light: Option<String>,
    /// How light becomes what a display shows: a photograph's curve that keeps hues; no curve, with
    /// colours that no display has brought among those that it has; each channel rolled off as on film;
    /// or neither, each channel clipped (`linear` is its older name), so that colours can be measured in
    /// the picture.
    #[key("tone", Word(&Tone::WORDS), default = Tone::Standard)]
    pub tone: Tone,
    /// Slope of `agx` at middle grey over its usual one, which is low. It has no effect on the other
    /// tones.
    #[key("contrast", within(Tone::CONTRASTS), default = 1.0)]
    pub contrast: f64,
    /// Depth of a PNG.
    #[key(with = Self::declare_depth, default = Depth::Eight)]
    pub depth: Depth,
    /// Whether the PNG has an alpha channel: the share of a pixel that something covers, with colours
    /// from which what lies behind everything is taken out.
    #[key("alpha")]
    pub alpha: bool,
}

/// The name is looked up when the whole scene has been read: a picture that is shown again brings
/// the names of its objects with it.
const OBJECT: Text = Text("the name of an object in the picture");

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
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "png" => Some(Self::Png),
            "jpg" | "jpeg" => Some(Self::Jpeg),
            _ => None,
        }
    }
}

impl Display {
    /// Whether what a picture shows decides how light or dark it becomes.
    pub(crate) fn is_metered(&self) -> bool {
        self.auto_exposure || self.grey_object.is_some()
    }

    fn declare_depth(&mut self, keys: &mut Keys<'_>) {
        let mut is_deep = self.depth == Depth::Sixteen;
        let about = "Whether the PNG has 16 bits a channel instead of 8; a JPEG has 8.";
        keys.key("sixteen_bits", &mut is_deep, Flag, about);
        self.depth = if is_deep {
            Depth::Sixteen
        } else {
            Depth::Eight
        };
    }

    /// An empty name is none, so that a flag can take away what the scene said; with a name another key
    /// has no effect, if it is set.
    fn one_alone(&mut self, keys: &mut Keys<'_>) {
        let names = [
            &mut self.grey_object,
            &mut self.white_object,
            &mut self.white_light,
        ];
        for name in names {
            name.take_if(|name| name.is_empty());
        }
        let [grey, object, light] =
            [&self.grey_object, &self.white_object, &self.white_light].map(Option::is_some);
        let is_white = self.white != White::D65;
        for (key, is_named, other, is_set) in [
            ("grey_object", grey, "auto_exposure", self.auto_exposure),
            ("white_object", object, "white", is_white),
            ("white_light", light, "white", is_white),
            ("white_light", light, "white_object", object),
        ] {
            if is_named && is_set {
                let problem = format!("`{other}` has no effect beside `{key}`");
                keys.refuse(&[other], problem, "leave one of them out");
            }
        }
    }

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
        Err(ImageError::inconsistent(what))
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
        let tone = self.tone.prepared(self.contrast);
        let mut values = vec![0_u16; colours.len() * channels];
        let pixels = values.par_chunks_mut(channels).zip(&colours).enumerate();
        pixels
            .with_min_len(1024)
            .for_each(|(pixel, (values, colour))| {
                let light = colour.map(|value| f64::from(value) * exposure);
                let light = adaptation.map_or(light, |adaptation| {
                    (adaptation * DVec3::from_array(light)).to_array()
                });
                let (shown, rest) = values.split_at_mut(3);
                shown.copy_from_slice(&tone.encoded(light).map(stored));
                if let (Some(alpha), [share]) = (alpha, rest) {
                    *share = stored(f64::from(alpha[pixel]).clamp(0.0, 1.0));
                }
            });
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
    ImageError::inconsistent(format_args!("it has no {what}"))
}

/// Linear sRGB of each pixel.
///
/// # Errors
///
/// [`ImageError::Inconsistent`] if the picture has neither colours nor bands;
/// [`ImageError::Malformed`] if no light has the primaries that it names.
pub fn colours(picture: &Picture) -> Result<Vec<[f32; 3]>, ImageError> {
    let channels = ["R", "G", "B"].map(|name| picture.layer(name));
    if let [Some(red), Some(green), Some(blue)] = channels {
        let map = to_rec709(picture)?;
        let channels = red.data.iter().zip(&green.data).zip(&blue.data);
        return Ok(channels
            .map(|((&red, &green), &blue)| mapped(map, [red, green, blue]))
            .collect());
    }
    let bands: Vec<(f64, &[f32])> = picture
        .layers
        .iter()
        .filter_map(|layer| Some((wavelength(&layer.name)?, layer.data.as_slice())))
        .collect();
    if bands.is_empty() {
        let none = "channels `R`, `G`, `B`, or `Y` alone, nor bands `S0.…nm`";
        let grey = picture.layer("Y").ok_or_else(|| lacks(none))?;
        return Ok(grey.data.iter().map(|&grey| [grey; 3]).collect());
    }
    Ok(colours_of_bands(&bands))
}

/// Linear sRGB in which a film's picture of light of this spectrum, a function of the shares of its
/// range, is shown.
pub fn recorded_colour(film: &WavelengthSampler, spectrum: &dyn Fn(&Share) -> f64) -> [f64; 3] {
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
mod tests;
