//! Pictures that come from scanners and cameras, as grey values.

use std::io::Cursor;
use std::path::Path;

use image::{ImageFormat, ImageReader, Limits};

use super::{ImageError, MOST_BYTES, MOST_PIXELS, check_size, read_file};
use super::{Layer, Picture};

/// Formats by what files begin with.
const KNOWN: &str = "PNG, TIFF and JPEG can be read";

/// Bytes that a decoded pixel takes while grey is made of it: four channels of 16 bits and their
/// copy.
const BYTES_A_PIXEL: u64 = 16;

/// Reads a PNG, TIFF or JPEG file as grey values, whatever its ending is.
///
/// The picture has one layer `grey`, 0 to 1, as stored: the luma of colours (Rec. 709) without
/// undoing the curve of sRGB. Where a picture is transparent it is white.
///
/// # Errors
///
/// [`ImageError::File`]; [`ImageError::Contents`] with [`ImageError::TooLarge`] from the header
/// alone or [`ImageError::Malformed`].
pub fn read_grey(path: &Path) -> Result<Picture, ImageError> {
    read_file(path, decode_grey)
}

/// The same of a file's bytes.
///
/// # Errors
///
/// [`ImageError::TooLarge`], [`ImageError::Malformed`].
pub fn decode_grey(bytes: &[u8]) -> Result<Picture, ImageError> {
    let malformed = |what: String| ImageError::Malformed { what };
    let reader = || {
        ImageReader::new(Cursor::new(bytes))
            .with_guessed_format()
            .map_err(|error| malformed(error.to_string()))
    };
    match reader()?.format() {
        Some(ImageFormat::Png | ImageFormat::Tiff | ImageFormat::Jpeg) => {}
        Some(other) => return Err(malformed(format!("it is of the kind {other:?}; {KNOWN}"))),
        None => return Err(malformed(format!("its format is not known; {KNOWN}"))),
    }
    let (width, height) = reader()?
        .into_dimensions()
        .map_err(|error| malformed(error.to_string()))?;
    check_size(
        u64::from(width),
        u64::from(height),
        1,
        BYTES_A_PIXEL,
        MOST_BYTES,
    )?;
    let mut reader = reader()?;
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(MOST_PIXELS * BYTES_A_PIXEL);
    reader.limits(limits);
    let decoded = reader
        .decode()
        .map_err(|error| malformed(error.to_string()))?;
    let pixels = decoded.into_luma_alpha16();
    let grey = pixels.pixels().map(|pixel| {
        let [grey, alpha] = pixel.0.map(|value| f32::from(value) / 65535.0);
        1.0 - alpha * (1.0 - grey)
    });
    Ok(Picture {
        width,
        height,
        layers: vec![Layer {
            name: "grey".to_owned(),
            data: grey.collect(),
        }],
        attributes: Vec::new(),
    })
}

#[cfg(test)]
mod tests {
    use image::{DynamicImage, GrayImage, LumaA, Rgb, RgbImage};

    use super::*;

    fn encoded(picture: &DynamicImage, format: ImageFormat) -> Vec<u8> {
        let mut bytes = Cursor::new(Vec::new());
        picture.write_to(&mut bytes, format).expect("it is small");
        bytes.into_inner()
    }

    #[test]
    fn grey_comes_from_every_format_and_transparency_is_white() {
        let grey = GrayImage::from_fn(40, 30, |x, _| image::Luma([if x < 20 { 51 } else { 204 }]));
        let grey = DynamicImage::from(grey);
        for format in [ImageFormat::Png, ImageFormat::Tiff, ImageFormat::Jpeg] {
            let picture = decode_grey(&encoded(&grey, format)).expect("a picture");
            assert_eq!((picture.width, picture.height), (40, 30));
            let values = &picture.layers[0].data;
            assert!((values[5] - 0.2).abs() < 0.02 && (values[35] - 0.8).abs() < 0.02);
        }
        let colour = DynamicImage::from(RgbImage::from_pixel(4, 4, Rgb([255, 255, 255])));
        let picture = decode_grey(&encoded(&colour, ImageFormat::Tiff)).expect("a picture");
        assert_eq!(picture.layers[0].data, [1.0; 16]);
        let clear = image::ImageBuffer::from_pixel(4, 4, LumaA([0_u8, 0]));
        let picture = decode_grey(&encoded(&DynamicImage::from(clear), ImageFormat::Png));
        assert_eq!(picture.expect("a picture").layers[0].data, [1.0; 16]);
    }

    #[test]
    fn what_is_cut_short_or_none_is_refused() {
        let grey = DynamicImage::from(GrayImage::from_fn(64, 64, |x, y| {
            image::Luma([(x * 7 + y * 13) as u8])
        }));
        for format in [ImageFormat::Png, ImageFormat::Tiff] {
            let bytes = encoded(&grey, format);
            for length in [0, 3, 20, bytes.len() / 2] {
                let error = decode_grey(&bytes[..length]).expect_err("cut short");
                assert!(matches!(error, ImageError::Malformed { .. }), "{error}");
            }
        }
        assert!(decode_grey(b"format = 1").is_err());
    }
}
