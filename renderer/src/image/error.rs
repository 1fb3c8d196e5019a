//! Why pictures cannot be read or written, and how large they may be.

use std::fmt::Display;
use std::io;
use std::path::{Path, PathBuf};

use image::ImageDecoder as _;
use image::metadata::Orientation;
use leafmodel::document::whole_file;
use thiserror::Error;

use super::picture::Picture;

/// Greatest number of pixels of a picture.
pub const MOST_PIXELS: u64 = 1 << 28;

/// Greatest memory of a picture, bytes.
pub const MOST_BYTES: u64 = 4 << 30;

/// Greatest memory of a picture that a scene reads, bytes: 13,377 × 13,377 pixels of colour. A file
/// of a few kilobytes may claim as much.
pub const MOST_TEXTURE_BYTES: u64 = 2 << 30;

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
    #[error("not a picture that can be read: {0}")]
    Malformed(String),
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
    #[error("the picture cannot be written: {0}")]
    Inconsistent(String),
}

impl ImageError {
    /// The bytes are no picture, for this reason.
    pub(crate) fn malformed(what: impl Display) -> Self {
        Self::Malformed(what.to_string())
    }

    /// The picture cannot be written, for this reason.
    pub(crate) fn inconsistent(what: impl Display) -> Self {
        Self::Inconsistent(what.to_string())
    }
}

/// Refuses sizes beyond [`MOST_PIXELS`] or `most` bytes, and empty pictures.
pub(super) fn check_size(
    width: impl Into<u64>,
    height: impl Into<u64>,
    channels: u64,
    bytes_per_pixel: u64,
    most: u64,
) -> Result<(), ImageError> {
    let (width, height) = (width.into(), height.into());
    if width == 0 || height == 0 || channels == 0 {
        return Err(ImageError::malformed(format_args!(
            "{width} × {height} pixels with {channels} channels hold nothing"
        )));
    }
    let pixels = width.saturating_mul(height);
    if pixels > MOST_PIXELS || pixels.saturating_mul(bytes_per_pixel) > most {
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
pub(super) const MOST_EXPANSION: u64 = 1500;

/// Refuses a header that claims more bytes of pixels than the file's bytes can hold, before memory
/// is taken for them.
pub(super) fn check_held(claimed: u64, held: usize) -> Result<(), ImageError> {
    if claimed / MOST_EXPANSION > held as u64 {
        return Err(ImageError::malformed(format_args!(
            "its header claims {claimed} bytes of pixels, more than {held} bytes can hold: \
                 the file is damaged or cut short"
        )));
    }
    Ok(())
}

/// Reads a file and passes its bytes to `decode`; adds the path to errors.
pub(super) fn read_file(
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
pub(super) fn turned<R: io::BufRead + io::Seek>(
    reader: image::ImageReader<R>,
) -> image::ImageResult<(image::DynamicImage, Orientation)> {
    let mut decoder = reader.into_decoder()?;
    let orientation = decoder.orientation()?;
    Ok((image::DynamicImage::from_decoder(decoder)?, orientation))
}
