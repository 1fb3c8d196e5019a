//! JPEG: pictures for screens.

use std::io::Cursor;
use std::path::Path;

use image::codecs::jpeg::JpegEncoder;
use image::{ExtendedColorType, ImageEncoder, ImageFormat, ImageReader, Limits};

use super::pixels::{Depth, Pixels};
use super::tone::from_srgb;
use super::{ImageError, MOST_BYTES, MOST_TEXTURE_BYTES, Picture, check_size};

/// Quality of 1 to 100 at which fine veins show no blocks.
const QUALITY: u8 = 93;

/// Length of the marker with which a file begins.
const AFTER_START: usize = 2;

/// A comment segment (COM) that says what has written the file.
fn comment() -> Vec<u8> {
    const TEXT: &[u8] = concat!("Lamina ", env!("CARGO_PKG_VERSION")).as_bytes();
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
    let inconsistent = |what: String| ImageError::Inconsistent { what };
    let (width, height) = (pixels.width, pixels.height);
    check_size(u64::from(width), u64::from(height), 3, 12, MOST_BYTES)?;
    if pixels.depth != Depth::Eight || pixels.channels != 3 {
        return Err(inconsistent("a JPEG has 8 bits and no alpha".to_owned()));
    }
    let values: Vec<u8> = pixels.values.iter().map(|&value| value as u8).collect();
    if values.len() as u64 != u64::from(width) * u64::from(height) * 3 {
        let count = values.len();
        return Err(inconsistent(format!(
            "{count} values for {width} × {height} pixels"
        )));
    }
    let mut bytes = Vec::new();
    JpegEncoder::new_with_quality(&mut bytes, QUALITY)
        .write_image(&values, width, height, ExtendedColorType::Rgb8)
        .map_err(|error| inconsistent(error.to_string()))?;
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
    super::read_file(path, decode)
}

/// Reads the bytes of a JPEG file: layers R, G and B in linear light, 0 to 1, of values that are
/// taken as sRGB. Grey becomes three equal layers; profiles and the camera's turn are left out.
///
/// # Errors
///
/// [`ImageError::TooLarge`] from the header alone; [`ImageError::Malformed`].
pub fn decode(bytes: &[u8]) -> Result<Picture, ImageError> {
    let malformed = |error: image::ImageError| ImageError::Malformed {
        what: error.to_string(),
    };
    let reader = || ImageReader::with_format(Cursor::new(bytes), ImageFormat::Jpeg);
    let (width, height) = reader().into_dimensions().map_err(malformed)?;
    let (across, down) = (u64::from(width), u64::from(height));
    check_size(across, down, 3, 12, MOST_TEXTURE_BYTES)?;
    // A block of 8 × 8 pixels takes a bit at least, and scans end before the file does.
    let scan = |marker: &[u8; 2]| bytes.windows(2).rposition(|pair| pair == marker);
    if across * down / 64 / 8 > bytes.len() as u64 || scan(&[0xff, 0xd9]) < scan(&[0xff, 0xda]) {
        let length = bytes.len();
        return Err(ImageError::Malformed {
            what: format!("{width} × {height} pixels in {length} bytes: it is cut short"),
        });
    }
    let mut reader = reader();
    let mut limits = Limits::default();
    limits.max_alloc = Some(MOST_BYTES);
    reader.limits(limits);
    let pixels = reader.decode().map_err(malformed)?.into_rgb16();
    Ok(super::linear(&pixels, from_srgb))
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
