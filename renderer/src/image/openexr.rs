//! `OpenEXR`: 32-bit float channels with names and attributes.

mod deflate;

use std::any::Any;
use std::io::{BufRead, Cursor, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use exr::block::writer::{ChunksWriter, write_chunks_with};
use exr::image::FlatSamples;
use exr::meta::attribute::{
    AttributeValue, ChannelDescription, Chromaticities, IntegerBounds, LineOrder, SampleType, Text,
};
use exr::meta::header::{Header, LayerAttributes};
use exr::meta::{BlockDescription, MetaData, magic_number};
use exr::prelude::{Compression, ReadChannels, ReadLayers, Vec2};

use super::atomic;
use super::error::{
    ImageError, MOST_BYTES, MOST_EXPANSION, MOST_TEXTURE_BYTES, check_held, check_size,
};
use super::picture::{Attribute, Layer, Picture};

/// The first bytes of each file.
pub(super) const MAGIC: &[u8] = &magic_number::BYTES;

/// Attributes that describe the structure of the file. They cannot be set and are not reported.
const STRUCTURAL: [&str; 15] = [
    "channels",
    "chunkCount",
    "compression",
    "dataWindow",
    "displayWindow",
    "dwaCompressionLevel",
    "lineOrder",
    "maxSamplesPerPixel",
    "name",
    "pixelAspectRatio",
    "screenWindowCenter",
    "screenWindowWidth",
    "tiles",
    "type",
    "version",
];

/// Most bytes of pixels in a display window that is larger than the data window, however small the
/// file is: those of a sky of 2048 × 1024 pixels.
const MOST_EMPTY: u64 = 24 << 20;

/// The attributes that mark a file of spectral radiance in W m⁻² sr⁻¹ nm⁻¹.
///
/// # Source
///
/// \[fichet2021\].
pub fn spectral_attributes() -> [(String, Attribute); 2] {
    [
        ("spectralLayoutVersion", "1.0"),
        ("emissiveUnits", "W.m^-2.sr^-1.nm^-1"),
    ]
    .map(|(name, value)| (name.to_owned(), Attribute::Text(value.to_owned())))
}

/// Writes a picture: one part, `f32` channels, ZIP over 16 rows. The same picture always gives the
/// same bytes.
///
/// # Errors
///
/// [`ImageError::Inconsistent`] for a layer of another size, a name twice, empty or longer than 255
/// bytes, or an attribute that belongs to the file format; [`ImageError::TooLarge`];
/// [`ImageError::File`] if the file cannot be written, in which case an old one is untouched.
pub fn write(picture: &Picture, path: &Path) -> Result<(), ImageError> {
    let bytes = encode(picture)?;
    atomic::replace(path, |file| file.write_all(&bytes))
}

/// The bytes of the file that [`write()`] writes.
///
/// # Errors
///
/// As [`write()`], except for errors of the file.
pub fn encode(picture: &Picture) -> Result<Vec<u8>, ImageError> {
    check(picture)?;
    let size = Vec2(picture.width as usize, picture.height as usize);
    let mut layers: Vec<&Layer> = picture.layers.iter().collect();
    layers.sort_by(|a, b| a.name.cmp(&b.name));
    let channels = layers.iter().map(|layer| {
        let name = text(&layer.name);
        ChannelDescription::named(name, SampleType::F32)
    });
    let mut attributes = LayerAttributes::default();
    let mut shared = exr::meta::header::ImageAttributes::with_size(size);
    for (name, value) in &picture.attributes {
        let value = match value {
            Attribute::Text(words) => AttributeValue::Text(text(words)),
            Attribute::Float(number) => AttributeValue::F32(*number),
            Attribute::Double(number) => AttributeValue::F64(*number),
            Attribute::Int(number) => AttributeValue::I32(*number),
            Attribute::Matrix4(matrix) => AttributeValue::Matrix4x4(*matrix),
            Attribute::Chromaticities([red, green, blue, white]) => {
                let point = |[x, y]: [f32; 2]| Vec2(x, y);
                AttributeValue::Chromaticities(Chromaticities {
                    red: point(*red),
                    green: point(*green),
                    blue: point(*blue),
                    white: point(*white),
                })
            }
        };
        attributes.other.insert(text(name), value);
    }
    shared.display_window.position = Vec2(0, 0);
    let header = Header::new(Text::default(), size, channels.collect())
        .with_encoding(
            Compression::ZIP16,
            BlockDescription::ScanLines,
            LineOrder::Increasing,
        )
        .with_attributes(attributes)
        .with_shared_attributes(shared);
    let chunks = deflate::blocks(&layers, size.0, size.1);
    let mut bytes = Cursor::new(Vec::new());
    // Our own check replaces the crate's, which refuses standard attributes for which it has
    // fields.
    let written = guard(|| {
        let headers = std::iter::once(header).collect();
        write_chunks_with(&mut bytes, headers, false, |_, writer| {
            chunks
                .into_iter()
                .enumerate()
                .try_for_each(|(place, chunk)| writer.write_chunk(place, chunk))
        })
    });
    written.map_err(ImageError::inconsistent)?;
    let mut bytes = bytes.into_inner();
    sort_attributes(&mut bytes);
    Ok(bytes)
}

/// Refuses pictures that would not read back unchanged.
fn check(picture: &Picture) -> Result<(), ImageError> {
    let refuse = |what: String| Err(ImageError::inconsistent(what));
    let count = picture.layers.len() as u64;
    let (width, height) = (picture.width, picture.height);
    check_size(width, height, count, 4 * count, MOST_BYTES)?;
    let pixels = u64::from(width) * u64::from(height);
    for Layer { name, data } in &picture.layers {
        if data.len() as u64 != pixels {
            let count = data.len();
            return refuse(format!(
                "channel {name:?} has {count} values for {pixels} pixels"
            ));
        }
    }
    let channels = picture.layers.iter().map(|layer| layer.name.as_str());
    let mut channels: Vec<&str> = channels.collect();
    let attributes = picture.attributes.iter().map(|(name, _)| name.as_str());
    let mut attributes: Vec<&str> = attributes.collect();
    let is_bad = |name: &&&str| name.is_empty() || name.len() > 255 || name.contains('\0');
    for (kind, names) in [("channel", &mut channels), ("attribute", &mut attributes)] {
        names.sort_unstable();
        if let Some([twice, _]) = names.windows(2).find(|pair| pair[0] == pair[1]) {
            return refuse(format!("the {kind} {twice:?} is there twice"));
        }
        if let Some(name) = names.iter().find(is_bad) {
            return refuse(format!(
                "{name:?} cannot name a {kind}: 1 to 255 bytes without a zero"
            ));
        }
    }
    if let Some(name) = attributes.iter().find(|name| STRUCTURAL.contains(name)) {
        return refuse(format!("the attribute {name:?} belongs to the file format"));
    }
    Ok(())
}

fn text(words: &str) -> Text {
    Text::from_slice_unchecked(words.as_bytes())
}

/// Puts the attributes of a single-part file into the order of their names: the crate writes them
/// in the order of a hash map, which differs from run to run. Nothing else moves, so all offsets in
/// the file stay valid.
fn sort_attributes(file: &mut [u8]) {
    // Magic number and version come first; then name 0, type 0, size, value for each, and 0 at the
    // end.
    let start = 8;
    let mut records = Vec::new();
    let mut at = start;
    while file[at] != 0 {
        let word = |from: usize| {
            from + file[from..]
                .iter()
                .position(|&byte| byte == 0)
                .expect("the crate ends words")
        };
        let name = word(at);
        let kind = word(name + 1);
        let size = file[kind + 1..kind + 5]
            .try_into()
            .map(u32::from_le_bytes)
            .expect("four bytes");
        let end = kind + 5 + size as usize;
        records.push((file[at..name].to_vec(), file[at..end].to_vec()));
        at = end;
    }
    records.sort();
    let sorted: Vec<u8> = records.into_iter().flat_map(|(_, record)| record).collect();
    file[start..at].copy_from_slice(&sorted);
}

/// Reads an `OpenEXR` file.
///
/// # Errors
///
/// As [`decode`], with the path; [`ImageError::File`] if there is no such file or it is larger than
/// 4 GiB.
pub fn read(path: &Path) -> Result<Picture, ImageError> {
    super::error::read_file(path, decode)
}

/// Reads an `OpenEXR` file that a scene names, as [`read()`].
///
/// # Errors
///
/// As [`read()`], and [`ImageError::TooLarge`] beyond [`MOST_TEXTURE_BYTES`].
pub fn read_texture(path: &Path) -> Result<Picture, ImageError> {
    read_within(path, MOST_TEXTURE_BYTES)
}

/// Reads an `OpenEXR` file whose pixels take no more than so many bytes of memory, as [`read()`].
///
/// # Errors
///
/// As [`read()`].
pub fn read_within(path: &Path, most: u64) -> Result<Picture, ImageError> {
    super::error::read_file(path, |bytes| decode_within(bytes, most.min(MOST_BYTES)))
}

/// Reads the bytes of an `OpenEXR` file: its display window, all channels as `f32` (16-bit floats
/// exactly, integers rounded) at their largest level, and the attributes of the types in
/// [`Attribute`].
///
/// Pixels outside of the data window are 0, those outside of the display window are left out. Of a
/// file of several parts, the channels of the first keep their names; those of others begin with
/// the name of their part and a dot, if they do not anyway.
///
/// # Errors
///
/// [`ImageError::TooLarge`] from the header alone; [`ImageError::Malformed`] for everything else,
/// including input on which the decoder panics.
pub fn decode(bytes: &[u8]) -> Result<Picture, ImageError> {
    decode_within(bytes, MOST_BYTES)
}

/// As [`decode`], within so many bytes of memory.
pub(super) fn decode_within(bytes: &[u8], most: u64) -> Result<Picture, ImageError> {
    if !bytes.starts_with(MAGIC) {
        return Err(ImageError::malformed("it is no EXR"));
    }
    let meta = guard(|| MetaData::read_from_buffered(Cursor::new(bytes), false))
        .map_err(ImageError::malformed)?;
    check_headers(&meta, bytes.len(), most)?;
    let has_deep = meta.headers.iter().any(|header| header.deep);
    let read = || {
        exr::prelude::read()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels()
    };
    // A panic in a thread of the decoder could not be caught, so that it has none.
    let (window, parts) = if has_deep {
        let read = || {
            let read = read().first_valid_layer().all_attributes();
            read.non_parallel().from_buffered(Cursor::new(bytes))
        };
        let image = guard(read).map_err(ImageError::malformed)?;
        (image.attributes.display_window, vec![image.layer_data])
    } else {
        let read = || {
            let read = read().all_layers().all_attributes();
            read.non_parallel().from_buffered(Cursor::new(bytes))
        };
        let image = guard(read).map_err(ImageError::malformed)?;
        (image.attributes.display_window, image.layer_data.into_vec())
    };
    let mut layers: Vec<Layer> = Vec::new();
    for (number, part) in parts.into_iter().enumerate() {
        let data = IntegerBounds::new(part.attributes.layer_position, part.size);
        let own = part.attributes.layer_name.as_ref();
        let own = own.map(|name| String::from_utf8_lossy(name.as_slice()).into_owned());
        let prefix = own.filter(|name| !name.is_empty());
        let prefix = prefix.unwrap_or_else(|| format!("part{}", number + 1)) + ".";
        for channel in part.channel_data.list {
            let mut name = String::from_utf8_lossy(channel.name.as_slice()).into_owned();
            if channel.sampling != Vec2(1, 1) || channel.sample_data.len() != part.size.area() {
                return Err(ImageError::malformed(format_args!(
                    "channel {name:?} is subsampled (as in files of luminance and chroma), which is \
                     not read: save the picture with channels R, G and B"
                )));
            }
            if number > 0 && !name.starts_with(&prefix) {
                name.insert_str(0, &prefix);
            }
            if layers.iter().any(|layer| layer.name == name) {
                return Err(ImageError::malformed(format_args!(
                    "two parts have the channel {name:?}"
                )));
            }
            let values = match channel.sample_data {
                FlatSamples::F32(data) => data,
                FlatSamples::F16(data) => data.into_iter().map(exr::prelude::f16::to_f32).collect(),
                FlatSamples::U32(data) => data.into_iter().map(|value| value as f32).collect(),
            };
            layers.push(Layer {
                name,
                data: shown_in(window, data, values),
            });
        }
    }
    let header = meta.headers.iter().find(|header| !header.deep);
    Ok(Picture {
        width: window.size.0 as u32,
        height: window.size.1 as u32,
        layers,
        attributes: header.map(attributes).unwrap_or_default(),
    })
}

/// Bytes that a file takes while its colours are made: the values of all channels, and a map of
/// three; 0 of a damaged one.
pub(super) fn claimed_bytes(file: impl BufRead) -> f64 {
    let meta = guard(|| MetaData::read_from_buffered(file, false));
    let headers = meta.map(|meta| meta.headers).unwrap_or_default();
    let of_header = headers.iter().map(|header| {
        let pixels = header.layer_size.0 as f64 * header.layer_size.1 as f64;
        pixels * 4.0 * (header.channels.list.len() as f64 + 3.0)
    });
    of_header.sum()
}

/// The name of the first part of a file, whose channels keep their names.
pub(super) fn first_part(bytes: &[u8]) -> Option<String> {
    let meta = guard(|| MetaData::read_from_buffered(Cursor::new(bytes), false)).ok()?;
    let name = meta.headers.first()?.own_attributes.layer_name.as_ref()?;
    Some(String::from_utf8_lossy(name.as_slice()).into_owned())
}

/// Refuses headers that claim more than there may be, before memory is taken for it.
fn check_headers(meta: &MetaData, held: usize, most: u64) -> Result<(), ImageError> {
    let (mut total, mut claimed) = (0_u64, 0_u64);
    for header in &meta.headers {
        if matches!(
            header.compression,
            Compression::HTJ2K32 | Compression::HTJ2K256
        ) {
            return Err(ImageError::malformed(
                "its compression is HTJ2K, which is not read: save it with ZIP, PIZ or DWAA, for \
                       example by `oiiotool IN.exr --compression zip -o OUT.exr`",
            ));
        }
        let channels = header.channels.list.len() as u64;
        let stored = header.channels.bytes_per_pixel as u64;
        // Memory of the file's values plus that of ours.
        let of_a_pixel = stored.max(channels.saturating_mul(4));
        for size in [
            header.layer_size,
            header.shared_attributes.display_window.size,
        ] {
            let (width, height) = (size.0 as u64, size.1 as u64);
            check_size(width, height, channels, of_a_pixel, most)?;
            total = total.saturating_add((width * height).saturating_mul(of_a_pixel));
        }
        let size = header.shared_attributes.display_window.size;
        let shown = (size.0 as u64 * size.1 as u64).saturating_mul(channels * 4);
        if size != header.layer_size && shown > MOST_EMPTY.max(held as u64 * MOST_EXPANSION) {
            let (width, height) = (size.0, size.1);
            return Err(ImageError::malformed(format_args!(
                "its display window of {width} × {height} pixels is too large for {held} bytes: save it \
                     with a smaller one, or with pixels in all of it"
            )));
        }
        // The values of the file become those of the picture where both have one size.
        let size = header.layer_size;
        let pixels = size.0 as u64 * size.1 as u64;
        if size == header.shared_attributes.display_window.size {
            total -= pixels * of_a_pixel;
        }
        if total > most {
            return Err(ImageError::TooLarge {
                width: size.0 as u64,
                height: size.1 as u64,
                channels,
                most,
            });
        }
        // Pixels of deep data may hold nothing.
        if !header.deep {
            claimed = claimed.saturating_add(pixels.saturating_mul(stored));
        }
    }
    check_held(claimed, held)
}

/// What a window shows of the values of another one: 0 where there are none.
fn shown_in(window: IntegerBounds, data: IntegerBounds, values: Vec<f32>) -> Vec<f32> {
    if window == data {
        return values;
    }
    // Where the data begin within the window, and which of its columns and rows the window shows.
    let overlap = |start: i32, size: usize, data_start: i32, data_size: usize| {
        let offset = i64::from(data_start) - i64::from(start);
        let first = (-offset).clamp(0, data_size as i64);
        let last = (size as i64 - offset).clamp(first, data_size as i64);
        (offset, first as usize..last as usize)
    };
    let (position, size) = (window.position, window.size);
    let (left, columns) = overlap(position.0, size.0, data.position.0, data.size.0);
    let (top, rows) = overlap(position.1, size.1, data.position.1, data.size.1);
    let mut shown = vec![0.0; size.area()];
    for row in rows.filter(|_| !columns.is_empty()) {
        let from = &values[row * data.size.0..][columns.clone()];
        let to = (row as i64 + top) as usize * size.0 + (columns.start as i64 + left) as usize;
        shown[to..][..from.len()].copy_from_slice(from);
    }
    shown
}

/// The attributes that are reported, by name.
fn attributes(header: &Header) -> Vec<(String, Attribute)> {
    let mut found: Vec<_> = header
        .all_named_attributes()
        .filter_map(|(name, value)| {
            let name = String::from_utf8_lossy(name).into_owned();
            if STRUCTURAL.contains(&name.as_str()) {
                return None;
            }
            attribute(value).map(|value| (name, value))
        })
        .collect();
    found.sort_by(|a, b| a.0.cmp(&b.0));
    found
}

fn attribute(value: AttributeValue) -> Option<Attribute> {
    #[expect(
        clippy::wildcard_enum_match_arm,
        reason = "the crate's list of kinds grows, and those that we have no use for are passed over"
    )]
    Some(match value {
        AttributeValue::Text(words) => {
            Attribute::Text(String::from_utf8_lossy(words.as_slice()).into_owned())
        }
        AttributeValue::F32(number) => Attribute::Float(number),
        AttributeValue::F64(number) => Attribute::Double(number),
        AttributeValue::I32(number) => Attribute::Int(number),
        AttributeValue::Matrix4x4(matrix) => Attribute::Matrix4(matrix),
        AttributeValue::Chromaticities(points) => Attribute::Chromaticities(
            [points.red, points.green, points.blue, points.white].map(|p| [p.0, p.1]),
        ),
        _ => return None,
    })
}

/// Runs the crate's code; turns an error or a panic into a message.
fn guard<T>(run: impl FnOnce() -> exr::error::Result<T>) -> Result<T, String> {
    let words = |panic: Box<dyn Any + Send>| {
        let text = panic.downcast_ref::<String>().cloned();
        text.or_else(|| panic.downcast_ref::<&str>().map(|&text| text.to_owned()))
            .unwrap_or_default()
    };
    match catch_unwind(AssertUnwindSafe(run)) {
        Ok(result) => result.map_err(|error| error.to_string()),
        Err(panic) => Err(format!("the decoder gave up: {}", words(panic))),
    }
}

#[cfg(test)]
mod tests;
