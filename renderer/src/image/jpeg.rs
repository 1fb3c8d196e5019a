//! JPEG: pictures for screens.

use std::io::Cursor;
use std::path::Path;

use image::codecs::jpeg::JpegEncoder;
use image::metadata::Orientation;
use image::{
    DynamicImage, ExtendedColorType, ImageDecoder, ImageEncoder, ImageFormat, ImageReader, Limits,
};

use super::encoding::{Encoding, Stored};
use super::error::{ImageError, MOST_BYTES, MOST_TEXTURE_BYTES, check_size};
use super::picture::Picture;
use super::pixels::{Depth, Pixels};
use super::portable_network::SOFTWARE;

/// Quality of 1 to 100 at which fine veins show no blocks.
const QUALITY: u8 = 93;

/// Length of the marker with which a file begins.
const AFTER_START: usize = 2;

/// A comment segment (COM) that says what has written the file.
fn comment() -> Vec<u8> {
    const TEXT: &[u8] = SOFTWARE.as_bytes();
    let mut segment = vec![0xff, 0xfe];
    // The length counts itself.
    segment.extend((TEXT.len() as u16 + 2).to_be_bytes());
    segment.extend(TEXT);
    segment
}

/// The bytes of a JPEG file (JFIF) of sRGB values, which is what JPEG without a profile means.
///
/// # Errors
///
/// [`ImageError::Inconsistent`] unless the pixels have 8 bits and no alpha, and for more than
/// 65535 pixels a side.
pub fn encoded(pixels: &Pixels) -> Result<Vec<u8>, ImageError> {
    let (width, height) = (pixels.width, pixels.height);
    check_size(width, height, 3, 12, MOST_BYTES)?;
    if pixels.depth != Depth::Eight || pixels.channels != 3 {
        return Err(ImageError::inconsistent("a JPEG has 8 bits and no alpha"));
    }
    let values: Vec<u8> = pixels.values.iter().map(|&value| value as u8).collect();
    if values.len() as u64 != u64::from(width) * u64::from(height) * 3 {
        let count = values.len();
        return Err(ImageError::inconsistent(format_args!(
            "{count} values for {width} × {height} pixels"
        )));
    }
    let mut bytes = Vec::new();
    JpegEncoder::new_with_quality(&mut bytes, QUALITY)
        .write_image(&values, width, height, ExtendedColorType::Rgb8)
        .map_err(ImageError::inconsistent)?;
    bytes.splice(AFTER_START..AFTER_START, comment());
    Ok(bytes)
}

/// Reads a JPEG file as linear light.
///
/// # Errors
///
/// As [`decode`], with the path; [`ImageError::File`] if there is no such file or it is larger than
/// 4 GiB.
pub fn read(path: &Path) -> Result<Picture, ImageError> {
    super::error::read_file(path, decode)
}

/// Reads the bytes of a JPEG file, upright: layers R, G and B in linear light, 0 to 1, and their
/// primaries as an attribute. Values are sRGB unless a profile says otherwise. Grey becomes three
/// equal layers.
///
/// # Errors
///
/// [`ImageError::TooLarge`] from the header alone; [`ImageError::Malformed`], also for colours that
/// cannot be converted.
pub fn decode(bytes: &[u8]) -> Result<Picture, ImageError> {
    let (mut pixels, orientation, profile) = decode_stored(bytes)?;
    pixels.apply_orientation(orientation);
    let encoding = match profile {
        Some(profile) => Encoding::of_profile(&profile)?,
        None => Encoding::srgb(),
    };
    Ok(encoding.linear(&pixels.into_rgb16()))
}

/// As [`decode`], of values whose meaning the format lays down that carries the picture, unturned.
///
/// # Errors
///
/// [`ImageError::TooLarge`] from the header alone; [`ImageError::Malformed`].
pub fn decode_as(bytes: &[u8], stored: Stored) -> Result<Picture, ImageError> {
    let (pixels, _, _) = decode_stored(bytes)?;
    Ok(Encoding::of(stored).linear(&pixels.into_rgb16()))
}

/// Pixels as stored, how they have to be turned to be upright, and the profile of their colours.
fn decode_stored(bytes: &[u8]) -> Result<(DynamicImage, Orientation, Option<Vec<u8>>), ImageError> {
    let reader = || ImageReader::with_format(Cursor::new(bytes), ImageFormat::Jpeg);
    let (width, height) = reader().into_dimensions().map_err(ImageError::malformed)?;
    check_size(width, height, 3, 12, MOST_TEXTURE_BYTES)?;
    check_scans(bytes, width, height)?;
    // Those colours depend on the inks.
    if components(bytes) == Some(4) {
        return Err(ImageError::malformed(
            "its colours are CMYK, which is not read: convert it to sRGB",
        ));
    }
    let mut limited = reader();
    let mut limits = Limits::default();
    limits.max_alloc = Some(MOST_BYTES);
    limited.limits(limits);
    let (pixels, orientation) = super::error::turned(limited).map_err(ImageError::malformed)?;
    let profile = reader().into_decoder().and_then(|mut of| of.icc_profile());
    Ok((pixels, orientation, profile.map_err(ImageError::malformed)?))
}

/// Refuses a file that is cut short or claims more pixels than its bytes can hold, before memory is
/// taken for them.
pub(super) fn check_scans(bytes: &[u8], width: u32, height: u32) -> Result<(), ImageError> {
    // A block of 8 × 8 pixels takes a bit at least, and scans end before the file does.
    let scan = |marker: &[u8; 2]| bytes.windows(2).rposition(|pair| pair == marker);
    let blocks = u64::from(width) * u64::from(height) / 64;
    if blocks / 8 > bytes.len() as u64 || scan(&[0xff, 0xd9]) < scan(&[0xff, 0xda]) {
        let length = bytes.len();
        return Err(ImageError::malformed(format_args!(
            "{width} × {height} pixels in {length} bytes: it is cut short"
        )));
    }
    Ok(())
}

/// Number of the components of a pixel, as the header of the frame (SOF) says.
fn components(bytes: &[u8]) -> Option<u8> {
    let mut at = AFTER_START;
    loop {
        let &[0xff, marker, high, low] = bytes.get(at..at + 4)? else {
            return None;
        };
        match marker {
            // Filling before a marker.
            0xff => at += 1,
            0xc0..=0xc3 | 0xc5..=0xc7 | 0xc9..=0xcb | 0xcd..=0xcf => {
                return bytes.get(at + 9).copied();
            }
            _ => at += 2 + usize::from(u16::from_be_bytes([high, low])),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_come_back_nearly_as_they_were() {
        let mut pixels = Pixels {
            width: 16,
            height: 16,
            depth: Depth::Eight,
            channels: 3,
            values: [70, 120, 30].repeat(256),
        };
        let bytes = encoded(&pixels).expect("it is a small picture");
        let reader = ImageReader::new(std::io::Cursor::new(&bytes));
        let reader = reader.with_guessed_format().expect("bytes can be read");
        let back = reader.decode().expect("it is a JPEG").into_rgb8();
        assert_eq!(back.dimensions(), (16, 16));
        for (value, written) in back.into_raw().into_iter().zip(&pixels.values) {
            assert!(
                u16::from(value).abs_diff(*written) <= 3,
                "{value}, not {written}"
            );
        }
        let light = decode(&bytes).expect("it is a JPEG");
        assert_eq!((light.width, light.height), (16, 16));
        for (layer, written) in light.layers.iter().zip([70.0, 120.0, 30.0]) {
            for value in &layer.data {
                let value = 255.0 * crate::image::tone::to_srgb(f64::from(*value));
                assert!((value - written).abs() <= 3.0, "{value}, not {written}");
            }
        }
        for length in 0..bytes.len() {
            assert!(decode(&bytes[..length]).is_err(), "{length} bytes");
        }
        pixels.depth = Depth::Sixteen;
        assert!(encoded(&pixels).is_err());
    }
}
