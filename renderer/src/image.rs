//! Pictures and their files: `OpenEXR` for data, PNG and JPEG for looking at; Radiance HDR is read.
//!
//! [`colours`] is the one reader of pictures that emit light or are textures.
//!
//! - **In**: [`Picture`]s, layers of `f32` with names and attributes; or untrusted bytes.
//! - **Out**: complete files, with the same bytes for the same picture; or a [`Picture`].
//! - **Always true**: a file is replaced by renaming a finished one, so a failure leaves the old
//!   one. A header that claims more than 2²⁸ pixels or 4 GiB is refused before anything is
//!   allocated for it.
//! - **Left out**: deep data, mip levels (the largest is read).
//!
//! ```
//! use renderer::image::{Attribute, Layer, Picture, compare, openexr};
//!
//! let picture = Picture {
//!     width: 2,
//!     height: 1,
//!     layers: vec![Layer { name: "Y".to_owned(), data: vec![0.25, 4.0] }],
//!     attributes: vec![("comments".to_owned(), Attribute::Text("two pixels".to_owned()))],
//! };
//! let bytes = openexr::encode(&picture)?;
//! let again = openexr::decode(&bytes)?;
//! assert_eq!(again.layer("Y"), picture.layer("Y"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod animation;
pub mod atomic;
pub mod card;
pub mod claimed;
pub mod colours;
pub mod compare;
pub mod display;
mod encoding;
pub mod jpeg;
pub mod light_colour;
pub mod openexr;
pub mod pixels;
pub mod portable_network;
mod primaries;
pub mod radiance;
pub mod scan;
pub mod tone;
pub mod white;

use std::io;
use std::path::{Path, PathBuf};

use image::ImageDecoder as _;
use image::metadata::Orientation;
use leafmodel::document::whole_file;
use thiserror::Error;

pub use compare::{ChannelComparison, Comparison, compare};
pub use encoding::Stored;

/// Greatest number of pixels of a picture.
pub const MOST_PIXELS: u64 = 1 << 28;

/// Greatest memory of a picture, bytes.
pub const MOST_BYTES: u64 = 4 << 30;

/// Greatest memory of a picture that a scene reads, bytes: 13,377 × 13,377 pixels of colour. A file
/// of a few kilobytes may claim as much.
pub const MOST_TEXTURE_BYTES: u64 = 2 << 30;

/// One channel.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    /// The whole channel name: `R`, `albedo.R`, `S0.550,000000nm`.
    pub name: String,
    /// Values by row, from the top, and column.
    pub data: Vec<f32>,
}

/// Channels of one size, with attributes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Picture {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Channels. Files hold them in the order of their names.
    pub layers: Vec<Layer>,
    /// Names and values of attributes. Files hold them in the order of their names.
    pub attributes: Vec<(String, Attribute)>,
}

impl Picture {
    /// The channel with a name.
    pub fn layer(&self, name: &str) -> Option<&Layer> {
        self.layers.iter().find(|layer| layer.name == name)
    }

    /// The attribute with a name.
    pub fn attribute(&self, name: &str) -> Option<&Attribute> {
        self.attributes
            .iter()
            .find(|(known, _)| known == name)
            .map(|(_, value)| value)
    }
}

/// The value of an attribute.
#[derive(Clone, Debug, PartialEq)]
pub enum Attribute {
    /// Text of any length.
    Text(String),
    /// A 32-bit number.
    Float(f32),
    /// A 64-bit number.
    Double(f64),
    /// A whole number.
    Int(i32),
    /// A 4 × 4 matrix, row by row, for row vectors (the convention of `OpenEXR`).
    Matrix4([f32; 16]),
    /// CIE 1931 x, y of red, green, blue and white.
    Chromaticities([[f32; 2]; 4]),
}

/// Rec. 709 primaries and D65: what linear sRGB means.
pub const REC709: Attribute = Attribute::Chromaticities(REC709_POINTS);

/// x and y of red, green, blue and white of Rec. 709.
const REC709_POINTS: [[f32; 2]; 4] = [[0.64, 0.33], [0.30, 0.60], [0.15, 0.06], [0.3127, 0.3290]];

/// Why a picture could not be read or written.
#[derive(Debug, Error)]
pub enum ImageError {
    /// The operating system reported an error.
    #[error("{}: {source}", .path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The file was read but its contents are not valid.
    #[error("{}: {source}", .path.display())]
    Contents {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        source: Box<ImageError>,
    },
    /// The bytes are not a picture of this format, or a damaged one.
    #[error("not a picture that can be read: {what}")]
    Malformed {
        /// What is wrong.
        what: String,
    },
    /// The picture has too many pixels or bytes.
    #[error(
        "a picture of {width} × {height} pixels with {channels} channels; \
         the most is {MOST_PIXELS} pixels and {most} bytes"
    )]
    TooLarge {
        /// Pixels across.
        width: u64,
        /// Pixels down.
        height: u64,
        /// Number of channels.
        channels: u64,
        /// Greatest memory that is allowed here, bytes.
        most: u64,
    },
    /// The picture contradicts itself.
    #[error("the picture cannot be written: {what}")]
    Inconsistent {
        /// What is wrong.
        what: String,
    },
}

/// Refuses sizes beyond [`MOST_PIXELS`] or `most` bytes, and empty pictures.
fn check_size(
    width: u64,
    height: u64,
    channels: u64,
    bytes_a_pixel: u64,
    most: u64,
) -> Result<(), ImageError> {
    if width == 0 || height == 0 || channels == 0 {
        return Err(ImageError::Malformed {
            what: format!("{width} × {height} pixels with {channels} channels hold nothing"),
        });
    }
    let pixels = width.saturating_mul(height);
    if pixels > MOST_PIXELS || pixels.saturating_mul(bytes_a_pixel) > most {
        return Err(ImageError::TooLarge {
            width,
            height,
            channels,
            most,
        });
    }
    Ok(())
}

/// Most that compression makes data smaller: DEFLATE 1032 times, PXR24 a third more.
const MOST_EXPANSION: u64 = 1500;

/// Refuses a header that claims more bytes of pixels than the file's bytes can hold, before memory
/// is taken for them.
fn check_held(claimed: u64, held: usize) -> Result<(), ImageError> {
    if claimed / MOST_EXPANSION > held as u64 {
        return Err(ImageError::Malformed {
            what: format!(
                "its header claims {claimed} bytes of pixels, more than {held} bytes can hold: \
                 the file is damaged or cut short"
            ),
        });
    }
    Ok(())
}

/// Reads a file and passes its bytes to `decode`; adds the path to errors.
fn read_file(
    path: &Path,
    decode: impl FnOnce(&[u8]) -> Result<Picture, ImageError>,
) -> Result<Picture, ImageError> {
    let refuse = |source| ImageError::File {
        path: path.to_owned(),
        source,
    };
    let bytes = whole_file::read(path, MOST_BYTES).map_err(refuse)?;
    decode(&bytes).map_err(|source| ImageError::Contents {
        path: path.to_owned(),
        source: Box::new(source),
    })
}

/// Pixels as a file has them, and how they have to be turned to be upright.
fn turned<R: io::BufRead + io::Seek>(
    reader: image::ImageReader<R>,
) -> image::ImageResult<(image::DynamicImage, Orientation)> {
    let mut decoder = reader.into_decoder()?;
    let orientation = decoder.orientation()?;
    Ok((image::DynamicImage::from_decoder(decoder)?, orientation))
}
