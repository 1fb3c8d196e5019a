//! Pictures that come from scanners and cameras, as grey values.

use std::io::Cursor;
use std::path::Path;

use image::{ImageFormat, ImageReader, Limits};
use tiff::decoder::Decoder as TiffDecoder;

use super::error::{ImageError, MOST_BYTES, MOST_PIXELS, check_held, check_size, read_file};
use super::jpeg::check_scans;
use super::picture::{Attribute, Layer, Picture};

/// Formats by what files begin with.
const KNOWN: &str = "PNG, TIFF and JPEG can be read";

/// Bytes that a decoded pixel takes while grey is made of it: four channels of 16 bits and their
/// copy.
const BYTES_A_PIXEL: u64 = 16;

/// The attribute of a picture whose file has further pages.
pub const MORE_PAGES: &str = "morePages";

/// Reads a PNG, TIFF or JPEG file as grey values, whatever its ending is.
///
/// The picture has one layer `grey`, 0 to 1, as stored: the luma of colours (Rec. 709) without
/// undoing the curve of sRGB. Where a picture is transparent it is white. Of a TIFF the first page is
/// read; if there are more, [`MORE_PAGES`] is an attribute.
///
/// # Errors
///
/// [`ImageError::File`]; [`ImageError::Contents`] with [`ImageError::TooLarge`] from the header
/// alone or [`ImageError::Malformed`].
pub fn read_grey(path: &Path) -> Result<Picture, ImageError> {
    read_file(path, decode_grey)
}

/// The width and the height of the picture in such a file, as its header has them.
///
/// # Errors
///
/// As [`read_grey`].
pub fn size(path: &Path) -> Result<(u32, u32), ImageError> {
    let mut size = (0, 0);
    read_file(path, |bytes| {
        size = size_of_picture(bytes)?;
        Ok(Picture::default())
    })?;
    Ok(size)
}

/// The same of a file's bytes.
///
/// # Errors
///
/// [`ImageError::TooLarge`], [`ImageError::Malformed`].
pub fn decode_grey(bytes: &[u8]) -> Result<Picture, ImageError> {
    size_of_picture(bytes)?;
    let mut reader = reader(bytes)?;
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(MOST_PIXELS * BYTES_A_PIXEL);
    reader.limits(limits);
    let (mut decoded, orientation) = super::error::turned(reader).map_err(ImageError::malformed)?;
    decoded.apply_orientation(orientation);
    let pixels = decoded.into_luma_alpha16();
    let (width, height) = pixels.dimensions();
    let grey = pixels.pixels().map(|pixel| {
        let [grey, alpha] = pixel.0.map(|value| f32::from(value) / 65535.0);
        1.0 - alpha * (1.0 - grey)
    });
    let grey = Layer::new("grey", grey.collect());
    let mut picture = Picture::new([width, height], [grey]);
    if has_more_pages(bytes) {
        let more = (MORE_PAGES.to_owned(), Attribute::Int(1));
        picture.attributes.push(more);
    }
    Ok(picture)
}

/// Whether a file is a TIFF with more than one page.
fn has_more_pages(bytes: &[u8]) -> bool {
    TiffDecoder::new(Cursor::new(bytes)).is_ok_and(|decoder| decoder.more_images())
}

/// A reader of a file whose first bytes say that it is known.
fn reader(bytes: &[u8]) -> Result<ImageReader<Cursor<&[u8]>>, ImageError> {
    let reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format();
    let reader = reader.map_err(ImageError::malformed)?;
    let what = match reader.format() {
        Some(ImageFormat::Png | ImageFormat::Tiff | ImageFormat::Jpeg) => return Ok(reader),
        Some(other) => format!("it is of the kind {other:?}; {KNOWN}"),
        None => format!("its format is not known; {KNOWN}"),
    };
    Err(ImageError::malformed(what))
}

/// Width and height, if the bytes can hold so many pixels.
fn size_of_picture(bytes: &[u8]) -> Result<(u32, u32), ImageError> {
    let is_jpeg = reader(bytes)?.format() == Some(ImageFormat::Jpeg);
    let size = reader(bytes)?.into_dimensions();
    let (width, height) = size.map_err(ImageError::malformed)?;
    check_size(width, height, 1, BYTES_A_PIXEL, MOST_BYTES)?;
    if is_jpeg {
        check_scans(bytes, width, height)?;
    } else {
        // A pixel takes a bit at least before it is compressed.
        check_held(u64::from(width) * u64::from(height) / 8, bytes.len())?;
    }
    Ok((width, height))
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
    fn of_a_tiff_with_several_pages_the_first_is_read_and_the_others_are_reported() {
        use tiff::encoder::{TiffEncoder, colortype::Gray8};

        for pages in [1_u8, 3] {
            let mut bytes = Cursor::new(Vec::new());
            let mut encoder = TiffEncoder::new(&mut bytes).expect("a TIFF");
            for page in 0..pages {
                let grey = [51 * (page + 1); 4];
                encoder
                    .write_image::<Gray8>(2, 2, &grey)
                    .expect("a small page");
            }
            let picture = decode_grey(&bytes.into_inner()).expect("a picture");
            assert!((picture.layers[0].data[0] - 0.2).abs() < 1e-3);
            assert_eq!(picture.attribute(MORE_PAGES).is_some(), pages > 1);
        }
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

    #[test]
    fn a_small_file_that_claims_many_pixels_is_refused_before_it_is_decoded() {
        let grey = DynamicImage::from(GrayImage::from_pixel(64, 64, image::Luma([90])));
        let mut jpeg = encoded(&grey, ImageFormat::Jpeg);
        let frame = jpeg.windows(2).position(|pair| pair == [0xff, 0xc0]);
        let frame = frame.expect("each file has a frame");
        jpeg[frame + 5..frame + 9].copy_from_slice(&[0x0f, 0xa0, 0xff, 0xff]);
        let refused = decode_grey(&jpeg).map(|_| ()).expect_err("it holds less");
        assert!(refused.to_string().contains("65535 × 4000"), "{refused}");
        let mut png = encoded(&grey, ImageFormat::Png);
        png[16..24].copy_from_slice(&[0, 0, 0xff, 0xff, 0, 0, 0x0f, 0xa0]);
        let sum = crc32fast::hash(&png[12..29]);
        png[29..33].copy_from_slice(&sum.to_be_bytes());
        let refused = decode_grey(&png).map(|_| ()).expect_err("it holds less");
        assert!(refused.to_string().contains("claims"), "{refused}");
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("small.jpg");
        std::fs::write(&path, encoded(&grey, ImageFormat::Jpeg)).expect("it can be written");
        assert_eq!(size(&path).expect("a picture"), (64, 64));
    }

    #[test]
    fn a_photograph_is_upright() {
        let grey = DynamicImage::from(GrayImage::from_fn(16, 8, |x, _| {
            image::Luma([if x < 8 { 20 } else { 230 }])
        }));
        let mut jpeg = encoded(&grey, ImageFormat::Jpeg);
        // Exif in big-endian order with one entry: orientation 6, a quarter turn clockwise.
        let exif = b"Exif\0\0MM\0\x2a\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x06\0\0\0\0\0\0";
        let mut segment = vec![0xff, 0xe1, 0, exif.len() as u8 + 2];
        segment.extend(exif);
        jpeg.splice(2..2, segment);
        let picture = decode_grey(&jpeg).expect("a picture");
        assert_eq!((picture.width, picture.height), (8, 16));
        let values = &picture.layers[0].data;
        assert!(values[0] < 0.2 && values[8 * 15] > 0.8, "its left is above");
    }
}
