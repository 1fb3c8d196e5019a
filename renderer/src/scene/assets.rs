//! Files of a scene: read once, checked before they are decoded.

use std::collections::BTreeMap;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

use glam::DMat3;
use thiserror::Error;

use leafmodel::document::assets::{Assets, Raster, Triangles};
use leafmodel::document::whole_file;
use leafmodel::memory;
use leafmodel::optics::{Constituent, Texel};

use crate::geometry;
use crate::image::{ImageError, Picture, colours, openexr, portable_network};
use crate::material::contents_texture::ContentsTexture;
use crate::scene::model::{self, Claims, Container, Files, Model, ModelError, ModelFile, Wanted};

/// Largest file that is read, bytes.
const MOST_BYTES: u64 = 4 << 30;

/// Why a file cannot be used.
#[derive(Debug, Error)]
pub enum AssetError {
    /// It cannot be read.
    #[error("{file}: {source}")]
    Read {
        /// The file.
        file: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// It is not a valid picture.
    #[error(transparent)]
    Image(#[from] ImageError),
    /// It is not a valid model.
    #[error("{file}: {source}")]
    Model {
        /// The file.
        file: PathBuf,
        /// What is wrong with it.
        source: ModelError,
    },
    /// A channel is missing.
    #[error("{file} has no channel \"{channel}\"")]
    NoChannel {
        /// The file.
        file: PathBuf,
        /// The channel.
        channel: &'static str,
    },
    /// A picture that is to shine holds no light.
    #[error("{file} is black, so it gives no light")]
    Dark {
        /// The file.
        file: PathBuf,
    },
    /// A value is out of range.
    #[error("{file}: channel \"{channel}\" holds {value} at pixel ({x}, {y}), allowed is {range}")]
    Value {
        /// The file.
        file: PathBuf,
        /// The channel.
        channel: &'static str,
        /// What it holds.
        value: f32,
        /// Column.
        x: usize,
        /// Row.
        y: usize,
        /// What is allowed.
        range: &'static str,
    },
}

/// A picture as linear sRGB.
#[derive(Debug)]
pub struct RgbPicture {
    /// Pixels across.
    pub width: usize,
    /// Row by row from the top.
    pub texels: Vec<[f32; 3]>,
    /// Fraction of the pixels of which a channel was below 0 in the file and is 0 here.
    pub below: f64,
    /// Fraction of the pixels whose colour lies outside of Rec. 709.
    pub outside: f64,
}

/// The bytes of a regular file.
///
/// # Errors
///
/// [`AssetError::Read`] if it cannot be read, also because it is too large.
pub fn read(file: &Path) -> Result<Vec<u8>, AssetError> {
    whole_file::read(file, MOST_BYTES).map_err(|source| AssetError::Read {
        file: file.to_owned(),
        source,
    })
}

/// What a channel may hold.
struct Allowed {
    of: RangeInclusive<f32>,
    /// The same in words.
    range: &'static str,
}

const LIGHT: Allowed = Allowed {
    of: 0.0..=f32::MAX,
    range: "0 and above",
};

const FINITE: Allowed = Allowed {
    of: f32::MIN..=f32::MAX,
    range: "0 and above",
};

const SHARES: Allowed = Allowed {
    of: 0.0..=1.0,
    range: "0 to 1",
};

fn channel<'p>(
    file: &Path,
    picture: &'p Picture,
    name: &'static str,
    allowed: &Allowed,
) -> Result<&'p [f32], AssetError> {
    let layer = picture
        .layers
        .iter()
        .find(|layer| layer.name == name)
        .ok_or_else(|| AssetError::NoChannel {
            file: file.to_owned(),
            channel: name,
        })?;
    if let Some(place) = layer
        .data
        .iter()
        .position(|value| !value.is_finite() || !allowed.of.contains(value))
    {
        let width = picture.width as usize;
        return Err(AssetError::Value {
            file: file.to_owned(),
            channel: name,
            value: layer.data[place],
            x: place % width,
            y: place / width,
            range: allowed.range,
        });
    }
    Ok(&layer.data)
}

/// A contents map: an EXR with a channel for each [`Constituent`]; its first row is v = 0.
///
/// # Errors
///
/// [`AssetError`] if a channel is missing or holds a value out of range.
pub fn contents_map(file: &Path) -> Result<ContentsTexture, AssetError> {
    let picture = openexr::read_texture(file)?;
    let (width, height) = (picture.width as usize, picture.height as usize);
    let mut texels = memory::filled(Texel::splat(0.0), width * height);
    for constituent in Constituent::ALL {
        let name = constituent.channel();
        let is_there = |name: &str| picture.layers.iter().any(|layer| layer.name == name);
        let has_parts = Constituent::DRY_MATTER_PARTS.map(|part| is_there(part.channel()));
        let may_be_left_out = constituent.if_left_out().is_some()
            || (constituent == Constituent::DryMatter && has_parts.contains(&true));
        if may_be_left_out && !is_there(name) {
            continue;
        }
        let least = constituent.least() as f32;
        let allowed = Allowed {
            of: least..=f32::MAX,
            range: if least > 0.0 {
                "1 and above"
            } else {
                LIGHT.range
            },
        };
        let values = channel(file, &picture, name, &allowed)?;
        for (row, line) in values.chunks(width).enumerate() {
            for (column, value) in line.iter().enumerate() {
                texels[row * width + column][constituent] = *value;
            }
        }
    }
    Ok(ContentsTexture::new(width, height, texels))
}

/// The weights of a mask: number of pixels across, and values row by row from v = 0.
///
/// In an EXR the first row is v = 0, as in maps; in a PNG the last, so that it shows the leaf with
/// its apex up. From an EXR the named channel is used, or the only one; from a PNG the grey value
/// or, for `"A"`, alpha, both as stored, 0 to 1.
///
/// # Errors
///
/// A message about the file without its name.
pub fn mask(file: &Path, channel: Option<&str>) -> Result<(usize, Vec<f32>), String> {
    let is_png = file
        .extension()
        .is_some_and(|ending| ending.eq_ignore_ascii_case("png"));
    if is_png {
        let alpha = match channel {
            None | Some("grey") => false,
            Some("A") => true,
            Some(other) => {
                return Err(format!(
                    "has no channel \"{}\": a PNG has \"grey\" and \"A\"",
                    other.escape_debug()
                ));
            }
        };
        let picture =
            portable_network::read_weights(file, alpha).map_err(|error| said(file, &error))?;
        let width = picture.width as usize;
        let layers = picture.layers.into_iter();
        let values: Vec<f32> = layers.flat_map(|layer| layer.data).collect();
        let upwards = values.chunks(width.max(1)).rev();
        return Ok((width, upwards.flatten().copied().collect()));
    }
    let picture = openexr::read_texture(file).map_err(|error| said(file, &error))?;
    let found = match channel {
        Some(name) => picture.layers.iter().find(|layer| layer.name == name),
        None if picture.layers.len() == 1 => picture.layers.first(),
        None => None,
    };
    let Some(layer) = found else {
        let names: Vec<String> = picture
            .layers
            .iter()
            .take(20)
            .map(|layer| format!("\"{}\"", layer.name.escape_debug()))
            .collect();
        let names = names.join(", ");
        return Err(match channel {
            Some(name) => format!("has no channel \"{}\", but {names}", name.escape_debug()),
            None => format!("has several channels, {names}: name one"),
        });
    };
    if layer.data.iter().any(|value| !value.is_finite()) {
        return Err("holds values that are not finite".to_owned());
    }
    Ok((picture.width as usize, layer.data.clone()))
}

/// The message of an error without the leading path, since a report gives the path as written.
fn said(file: &Path, error: &dyn std::fmt::Display) -> String {
    let text = error.to_string();
    let path = file.display().to_string();
    let rest = text.strip_prefix(&path).unwrap_or(&text);
    rest.trim_start_matches([':', ' ']).to_owned()
}

impl AssetError {
    /// The message without the leading path of the file.
    pub fn without_path(&self, file: &Path) -> String {
        said(file, self)
    }
}

/// Greatest share of pixels below 0 that a picture may have which shines. Skies that were scaled
/// have one or two in a hundred; more look like a picture that is not light.
const MOST_BELOW: f64 = 0.05;

/// Greatest share of a picture's light that may be missing below 0.
const MOST_MISSING: f64 = 0.01;

/// A picture that shines: of an EXR the layer of this name.
///
/// Scaling with a sharp filter leaves values below 0 beside bright edges, which no light has. They
/// are 0 here, if they are few, and [`RgbPicture::below`] is their fraction. Colours of other
/// primaries are converted after that: those outside of Rec. 709 then have channels below 0, which
/// are right for all that mixes with them, and [`RgbPicture::outside`] is their fraction.
///
/// # Errors
///
/// [`AssetError`] if it is not such a picture, holds values that are not finite or many negative
/// ones, or is dark everywhere.
pub fn shining(file: &Path, layer: Option<&str>) -> Result<RgbPicture, AssetError> {
    let (mut picture, map) = stored(file, layer, &FINITE)?;
    let texels = || picture.texels.iter();
    let below = texels().filter(|texel| texel.iter().any(|value| *value < 0.0));
    let share = below.count() as f64 / picture.texels.len().max(1) as f64;
    if share > 0.0 {
        let values = || texels().flatten().map(|value| f64::from(*value));
        let missing: f64 = values().filter(|value| *value < 0.0).map(f64::abs).sum();
        let light: f64 = values().map(f64::abs).sum();
        if share > MOST_BELOW || missing > MOST_MISSING * light {
            // The error names the first of them.
            stored(file, layer, &LIGHT)?;
        }
        for value in picture.texels.iter_mut().flatten() {
            *value = value.max(0.0);
        }
        picture.below = share;
    }
    if picture.texels.iter().flatten().all(|value| *value == 0.0) {
        return Err(AssetError::Dark {
            file: file.to_owned(),
        });
    }
    picture.convert(map, f32::MAX);
    if let Some(place) = picture
        .texels
        .iter()
        .flatten()
        .position(|value| !value.is_finite())
    {
        let pixel = place / 3;
        return Err(AssetError::Value {
            file: file.to_owned(),
            channel: colours::CHANNELS[place % 3],
            value: picture.texels[pixel][place % 3],
            x: pixel % picture.width,
            y: pixel / picture.width,
            range: LIGHT.range,
        });
    }
    Ok(picture)
}

/// A picture of reflectances, each in [0, 1]: of an EXR the layer of this name. Colours of other
/// primaries are converted; what lies outside of Rec. 709 comes to its border, and
/// [`RgbPicture::outside`] is the fraction of such pixels.
///
/// # Errors
///
/// [`AssetError`] if it is not such a picture or holds other values.
pub fn reflectances(file: &Path, layer: Option<&str>) -> Result<RgbPicture, AssetError> {
    let (mut picture, map) = stored(file, layer, &SHARES)?;
    picture.convert(map, 1.0);
    for value in picture.texels.iter_mut().flatten() {
        *value = value.clamp(0.0, 1.0);
    }
    Ok(picture)
}

impl RgbPicture {
    /// Converts the colours by a map; those with a channel below 0 or above `most` are counted.
    fn convert(&mut self, map: Option<DMat3>, most: f32) {
        /// Conversions of colours on the border of Rec. 709 may end so far beyond it.
        const ROUNDING: f32 = 1e-4;
        if map.is_none() {
            return;
        }
        let mut outside = 0_usize;
        for texel in &mut self.texels {
            *texel = colours::mapped(map, *texel);
            let greatest = texel
                .iter()
                .fold(0.0_f32, |most, value| most.max(value.abs()));
            let slack = ROUNDING * greatest;
            let is_outside = |value: &f32| *value < -slack || *value > most + slack;
            outside += usize::from(texel.iter().any(is_outside));
            for value in texel.iter_mut().filter(|value| **value >= -slack) {
                *value = value.max(0.0);
            }
        }
        self.outside = outside as f64 / self.texels.len().max(1) as f64;
    }
}

/// A picture with its colours as stored, and the map from them to linear sRGB.
fn stored(
    file: &Path,
    layer: Option<&str>,
    allowed: &Allowed,
) -> Result<(RgbPicture, Option<DMat3>), AssetError> {
    let picture = colours::read(file, layer)?;
    let [red, green, blue] = colours::CHANNELS.map(|name| channel(file, &picture, name, allowed));
    let (red, green, blue) = (red?, green?, blue?);
    let map = colours::to_rec709(&picture).map_err(|source| ImageError::Contents {
        path: file.to_owned(),
        source: Box::new(source),
    })?;
    let texels = red.iter().zip(green).zip(blue);
    let picture = RgbPicture {
        width: picture.width as usize,
        texels: texels.map(|((r, g), b)| [*r, *g, *b]).collect(),
        below: 0.0,
        outside: 0.0,
    };
    Ok((picture, map))
}

/// The model of a glTF file. Only what is `wanted` of its pictures is read.
///
/// # Errors
///
/// [`AssetError`] if a file cannot be read or the model is not valid.
pub fn model(named: &ModelFile, wanted: Wanted) -> Result<Model, AssetError> {
    opened(named, |container, files| {
        model::read(container, files, named.scale, wanted)
    })
}

/// What such a model claims to have.
///
/// # Errors
///
/// As [`model()`].
pub fn claims_of_model(named: &ModelFile, wanted: Wanted) -> Result<Claims, AssetError> {
    opened(named, |container, files| {
        model::claims(container, files, wanted)
    })
}

/// What `read_model` makes of a glTF file and the files beside it.
fn opened<T>(
    named: &ModelFile,
    read_model: impl for<'a> FnOnce(&Container<'a>, Files<'a>) -> Result<T, ModelError>,
) -> Result<T, AssetError> {
    let bytes = read(&named.path.file)?;
    let others = named.beside.iter();
    let others = others.map(|(name, file)| Ok((name, read(file)?)));
    let others = others.collect::<Result<BTreeMap<_, _>, AssetError>>()?;
    let bytes_of = |name: &str| others.get(&name.to_owned()).map(Vec::as_slice);
    let found = Container::open(&bytes).and_then(|container| read_model(&container, &bytes_of));
    found.map_err(|source| AssetError::Model {
        file: named.path.file.clone(),
        source,
    })
}

/// Decodes the files that leaves and bodies name.
#[derive(Debug)]
pub struct Decoder;

/// The one decoder.
pub static DECODER: Decoder = Decoder;

impl Assets for Decoder {
    fn grey(&self, file: &Path, channel: Option<&str>) -> Result<Raster, String> {
        mask(file, channel).map(|(width, values)| Raster { width, values })
    }

    fn weights(&self, file: &Path) -> Result<Raster, String> {
        let picture =
            portable_network::read_weights(file, false).map_err(|error| error.to_string())?;
        let values = picture.layers.into_iter().flat_map(|layer| layer.data);
        Ok(Raster {
            width: picture.width as usize,
            values: values.collect(),
        })
    }

    fn contents(&self, file: &Path) -> Result<Raster, String> {
        let map = contents_map(file).map_err(|error| error.without_path(file))?;
        Ok(Raster {
            width: map.size().0,
            values: map
                .texels()
                .iter()
                .flat_map(|texel| *texel.as_array())
                .collect(),
        })
    }

    fn mesh(&self, file: &Path, scale: f64) -> Result<Triangles, (String, &'static str)> {
        let bytes =
            read(file).map_err(|error| (error.without_path(file), "make the file readable"))?;
        let extension = file.extension().and_then(|ending| ending.to_str());
        let mesh = geometry::import(&bytes, extension.unwrap_or(""), scale as f32)
            .map_err(|error| (error.to_string(), "save the mesh anew as PLY or OBJ"))?;
        Ok(Triangles {
            positions: mesh.positions().iter().map(|p| p.as_dvec3()).collect(),
            faces: mesh.triangles().to_vec(),
            normals: mesh
                .normals()
                .map(|normals| normals.iter().map(|normal| normal.as_dvec3()).collect()),
            dropped: Some(mesh.remarks().join("; ")).filter(|remarks| !remarks.is_empty()),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image::{Attribute, Layer};

    /// One pixel in the primaries of Rec. 2020, as a file.
    fn wide(folder: &Path, colour: [f32; 3]) -> PathBuf {
        let file = folder.join("wide.exr");
        let layers = colours::CHANNELS
            .into_iter()
            .zip(colour)
            .map(|(name, value)| Layer {
                name: name.to_owned(),
                data: vec![value],
            });
        let points = [
            [0.708, 0.292],
            [0.170, 0.797],
            [0.131, 0.046],
            [0.3127, 0.3290],
        ];
        let picture = Picture {
            width: 1,
            height: 1,
            layers: layers.collect(),
            attributes: vec![(
                "chromaticities".to_owned(),
                Attribute::Chromaticities(points),
            )],
        };
        openexr::write(&picture, &file).expect("a folder");
        file
    }

    #[test]
    fn reflectances_come_to_the_border_of_rec_709_and_are_counted() {
        let folder = tempfile::tempdir().expect("a folder");
        let red = wide(folder.path(), [0.5, 0.0, 0.0]);
        let red = reflectances(&red, None).expect("reflectances");
        assert_eq!(
            (red.texels[0][1], red.texels[0][2], red.outside),
            (0.0, 0.0, 1.0)
        );
        assert!((red.texels[0][0] - 0.830).abs() < 1e-3, "{:?}", red.texels);
        let grey = wide(folder.path(), [1.0; 3]);
        let grey = reflectances(&grey, None).expect("reflectances");
        assert_eq!(grey.outside, 0.0);
        assert!(
            grey.texels[0]
                .iter()
                .all(|value| (*value - 1.0).abs() < 1e-5)
        );
    }

    #[test]
    fn lights_keep_colours_outside_of_rec_709_but_no_values_below_0_of_the_file() {
        let folder = tempfile::tempdir().expect("a folder");
        let green = wide(folder.path(), [0.0, 2.0, 0.0]);
        let green = shining(&green, None).expect("light");
        assert_eq!((green.below, green.outside), (0.0, 1.0));
        assert!(
            (green.texels[0][0] + 1.1753).abs() < 1e-3,
            "{:?}",
            green.texels
        );
        let negative = wide(folder.path(), [-1.0, 2.0, 0.0]);
        let refused = shining(&negative, None).map(|_| ()).expect_err("no light");
        assert!(refused.to_string().contains("holds -1"), "{refused}");
    }
}
