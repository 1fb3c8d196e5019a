//! The one reader of pictures that emit light or are textures.
//!
//! - **In**: files of `OpenEXR`, Radiance HDR, PNG or JPEG; their first bytes say which. Of an EXR
//!   with several layers one can be chosen by its name.
//! - **Out**: a [`Picture`] with the channels `R`, `G` and `B` of linear light, upright, and the
//!   linear map from its primaries to those of Rec. 709.
//! - **Always true**: what a file says of its colours is used, or the file is refused.

use std::path::Path;

use glam::DMat3;
use leafmodel::document::source::escaped;

use super::error::{ImageError, MOST_TEXTURE_BYTES, read_file};
use super::picture::{Attribute, Layer, Picture, REC709};
use super::{jpeg, openexr, portable_network, primaries, radiance};
use crate::spectrum::cie::srgb_from_xyz;

/// The channels of colours.
pub const CHANNELS: [&str; 3] = ["R", "G", "B"];

/// Most layers that a message names.
const MOST_NAMED: usize = 12;

/// Reads a picture; of an EXR the layer of this name, or the one without a name.
///
/// # Errors
///
/// [`ImageError`], with the path, for files that are no such pictures, lack the layer, or have
/// colours that cannot be converted.
pub fn read(path: &Path, layer: Option<&str>) -> Result<Picture, ImageError> {
    read_file(path, |bytes| decode(bytes, layer))
}

/// As [`read`], of a file's bytes.
///
/// # Errors
///
/// As [`read`], without the path.
pub fn decode(bytes: &[u8], layer: Option<&str>) -> Result<Picture, ImageError> {
    let is_exr = bytes.starts_with(openexr::MAGIC);
    if layer.is_some() && !is_exr {
        return Err(ImageError::malformed(
            "only an EXR has layers: leave `layer` out",
        ));
    }
    if is_exr {
        let picture = openexr::decode_within(bytes, MOST_TEXTURE_BYTES)?;
        let is_first = |name: &&str| openexr::first_part(bytes).as_deref() == Some(name);
        return of_layer(picture, layer.filter(|name| !is_first(name)));
    }
    if bytes.starts_with(b"\x89PNG") {
        portable_network::decode(bytes)
    } else if bytes.starts_with(b"\xff\xd8") {
        jpeg::decode(bytes)
    } else if bytes.starts_with(b"#?") {
        radiance::decode(bytes)
    } else {
        Err(ImageError::malformed(
            "it is no EXR, Radiance HDR, PNG or JPEG",
        ))
    }
}

/// The map from a picture's colours to linear sRGB; `None` if that is what they are.
///
/// # Errors
///
/// [`ImageError::Malformed`] if no light has the primaries that the picture names.
pub fn to_rec709(picture: &Picture) -> Result<Option<DMat3>, ImageError> {
    match picture.attribute("chromaticities") {
        Some(Attribute::Chromaticities(points)) => primaries::to_rec709(*points),
        _ => Ok(None),
    }
}

/// A colour through a map, if there is one.
pub fn mapped(map: Option<DMat3>, colour: [f32; 3]) -> [f32; 3] {
    map.map_or(colour, |map| primaries::mapped(map, colour))
}

/// A picture with its channels `R`, `G` and `B` in linear sRGB.
///
/// # Errors
///
/// As [`to_rec709`].
pub fn in_rec709(mut picture: Picture) -> Result<Picture, ImageError> {
    let Some(map) = to_rec709(&picture)? else {
        return Ok(picture);
    };
    let place = |name| picture.layers.iter().position(|layer| layer.name == name);
    if let [Some(red), Some(green), Some(blue)] = CHANNELS.map(place) {
        for pixel in 0..picture.layers[red].data.len() {
            let places = [red, green, blue];
            let colour = places.map(|layer| picture.layers[layer].data[pixel]);
            for (layer, value) in places.into_iter().zip(primaries::mapped(map, colour)) {
                picture.layers[layer].data[pixel] = value;
            }
        }
    }
    for (name, value) in &mut picture.attributes {
        if name == "chromaticities" {
            *value = REC709;
        }
    }
    Ok(picture)
}

/// The colours of a layer: those of its channels `R`, `G` and `B`, or `X`, `Y` and `Z`, or grey if it
/// has luminance `Y` alone.
fn of_layer(mut picture: Picture, layer: Option<&str>) -> Result<Picture, ImageError> {
    let prefix = layer.map_or_else(String::new, |name| format!("{name}."));
    let mut take = |channel: &str| {
        let name = format!("{prefix}{channel}");
        let place = picture.layers.iter().position(|known| known.name == name)?;
        Some(picture.layers.swap_remove(place).data)
    };
    let mut is_xyz = false;
    let colours = match CHANNELS.map(&mut take) {
        [Some(red), Some(green), Some(blue)] => [red, green, blue],
        [None, None, None] => match ["X", "Y", "Z"].map(take) {
            [Some(x), Some(y), Some(z)] => {
                is_xyz = true;
                from_xyz([x, y, z])
            }
            [None, Some(grey), None] => [grey.clone(), grey.clone(), grey],
            _ => return Err(lacking(&picture, layer)),
        },
        _ => return Err(lacking(&picture, layer)),
    };
    if is_xyz {
        // Whatever primaries the file names, they are not those of these channels.
        picture
            .attributes
            .retain(|(name, _)| name != "chromaticities");
    }
    let layers = CHANNELS.into_iter().zip(colours);
    picture.layers = layers.map(|(name, data)| Layer::new(name, data)).collect();
    Ok(picture)
}

/// Linear sRGB of CIE XYZ, channel by channel.
fn from_xyz(mut channels: [Vec<f32>; 3]) -> [Vec<f32>; 3] {
    for pixel in 0..channels[0].len() {
        let xyz = channels.each_ref().map(|channel| f64::from(channel[pixel]));
        for (channel, value) in channels.iter_mut().zip(srgb_from_xyz(xyz)) {
            channel[pixel] = value as f32;
        }
    }
    channels
}

/// What is said of a picture without the colours of a layer: which layers it has.
fn lacking(picture: &Picture, layer: Option<&str>) -> ImageError {
    let mut known: Vec<&str> = Vec::new();
    for channel in &picture.layers {
        if let Some((name, "R" | "Y")) = channel.name.rsplit_once('.')
            && !known.contains(&name)
        {
            known.push(name);
        }
    }
    let wanted = match layer {
        Some(name) => format!(
            "no layer `{}` with channels R, G and B, X, Y and Z, or Y",
            escaped(name, 60)
        ),
        None => "no channels R, G and B, X, Y and Z, or Y".to_owned(),
    };
    let names = known
        .iter()
        .take(MOST_NAMED)
        .map(|name| format!("`{}`", escaped(name, 60)));
    let names: Vec<String> = names.collect();
    let what = if names.is_empty() {
        format!("it has {wanted}")
    } else {
        format!(
            "it has {wanted}; choose one of its layers by `layer`: {}",
            names.join(", ")
        )
    };
    ImageError::malformed(what)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn layered(names: &[&str]) -> Vec<u8> {
        let layers = names
            .iter()
            .zip(1_u8..)
            .map(|(name, value)| Layer::new(*name, vec![f32::from(value)]));
        let picture = Picture::new([1, 1], layers);
        openexr::encode(&picture).expect("one pixel")
    }

    fn colour(bytes: &[u8], layer: Option<&str>) -> [f32; 3] {
        let picture = decode(bytes, layer).expect("it has this layer");
        CHANNELS.map(|name| picture.layer(name).expect("colours").data[0])
    }

    #[test]
    fn layers_are_chosen_by_name_and_luminance_alone_is_grey() {
        let many = layered(&["R", "G", "B", "sky.R", "sky.G", "sky.B", "view.fog.Y"]);
        assert_eq!(colour(&many, None), [1.0, 2.0, 3.0]);
        assert_eq!(colour(&many, Some("sky")), [4.0, 5.0, 6.0]);
        assert_eq!(colour(&many, Some("view.fog")), [7.0; 3]);
        assert_eq!(colour(&layered(&["Y"]), None), [1.0; 3]);
    }

    #[test]
    fn channels_of_xyz_are_colours_and_not_the_grey_of_their_luminance() {
        let xyz = |prefix: &str, colour: [f32; 3]| {
            let channels = ["X", "Y", "Z"].into_iter().zip(colour);
            let layers =
                channels.map(|(name, value)| Layer::new(format!("{prefix}{name}"), vec![value]));
            let primaries = Attribute::Chromaticities(primaries::REC2020);
            let picture = Picture {
                width: 1,
                height: 1,
                layers: layers.collect(),
                attributes: vec![("chromaticities".to_owned(), primaries)],
            };
            openexr::encode(&picture).expect("one pixel")
        };
        let red = [0.4124, 0.2126, 0.0193];
        for (bytes, layer, expected) in [
            (xyz("", red), None, [1.0, 0.0, 0.0]),
            (xyz("sky.", red), Some("sky"), [1.0, 0.0, 0.0]),
            (xyz("", [0.9505, 1.0, 1.089]), None, [1.0; 3]),
        ] {
            let picture = decode(&bytes, layer).expect("it has this layer");
            assert_eq!(to_rec709(&picture).expect("no other primaries"), None);
            let found = CHANNELS.map(|name| picture.layer(name).expect("colours").data[0]);
            for (found, expected) in found.into_iter().zip(expected) {
                assert!((found - expected).abs() < 1e-3, "{found}, not {expected}");
            }
        }
        let part = decode(&layered(&["X", "Y"]), None).map(|_| ());
        let said = part.expect_err("Z is missing").to_string();
        assert!(
            said.contains("no channels R, G and B, X, Y and Z"),
            "{said}"
        );
    }

    #[test]
    fn colours_of_rec_2020_are_compared_as_those_of_rec_709() {
        let layer = |name: &str, value: f32| Layer::new(name, vec![value]);
        let primaries = Attribute::Chromaticities(primaries::REC2020);
        let picture = Picture {
            width: 1,
            height: 1,
            layers: vec![
                layer("B", 0.0),
                layer("G", 0.0),
                layer("N.R", 1.0),
                layer("R", 1.0),
            ],
            attributes: vec![("chromaticities".to_owned(), primaries)],
        };
        let picture = in_rec709(picture).expect("real primaries");
        let found: Vec<f32> = picture.layers.iter().map(|layer| layer.data[0]).collect();
        for (found, expected) in found.into_iter().zip([-0.0182, -0.1246, 1.0, 1.6605]) {
            assert!((found - expected).abs() < 1e-3, "{found}, not {expected}");
        }
        assert_eq!(picture.attribute("chromaticities"), Some(&REC709));
    }

    #[test]
    fn a_layer_that_is_not_there_is_refused_with_the_names_of_those_that_are() {
        let refused = |bytes: &[u8], layer| {
            let refused = decode(bytes, layer).map(|_| ());
            refused.expect_err("it lacks colours").to_string()
        };
        let only = layered(&["sky.R", "sky.G", "sky.B", "depth.Z"]);
        assert!(refused(&only, None).contains("choose one of its layers by `layer`: `sky`"));
        assert!(refused(&only, Some("sk")).contains("no layer `sk`"));
        assert!(refused(&layered(&["R", "G"]), None).contains("no channels R, G and B"));
        let png = portable_network::encoded(1, 1, &[1, 2, 3]).expect("one pixel");
        assert!(refused(&png, Some("sky")).contains("only an EXR has layers"));
        assert!(refused(b"GIF89a", None).contains("no EXR, Radiance HDR, PNG or JPEG"));
    }
}
