//! Radiance HDR (`.hdr`, RGBE): pictures of surroundings as they are shared most.

use std::io::Cursor;
use std::path::Path;

use image::codecs::hdr::HdrDecoder;
use image::{ImageDecoder, ImageError as CodecError};

use super::{ImageError, Layer, MOST_TEXTURE_BYTES, Picture, REC709, check_size};

/// What files begin with.
const SIGNATURES: [&[u8]; 2] = [b"#?RADIANCE\n", b"#?RGBE\n"];

/// Bytes of a pixel in memory while it is read.
const BYTES_A_PIXEL: u64 = 12;

/// Most pixels that a byte of a file can stand for: a run of 127 pixels takes two bytes in each of
/// four channels.
const MOST_PIXELS_A_BYTE: u64 = 16;

/// Reads a Radiance file as light.
///
/// # Errors
///
/// As [`decode`], with the path; [`ImageError::File`] if there is no such file or it is larger than
/// 4 GiB.
pub fn read(path: &Path) -> Result<Picture, ImageError> {
    super::read_file(path, decode)
}

/// Reads the bytes of a Radiance file: layers R, G and B as the file has them, with its exposure
/// taken out, so that they are the light of the place. Primaries are taken as Rec. 709; a
/// correction of colours (COLORCORR) is left out.
///
/// # Errors
///
/// [`ImageError::TooLarge`] from the header alone; [`ImageError::Malformed`], also for a file of
/// XYZE or one that is not stored row by row from the top.
pub fn decode(bytes: &[u8]) -> Result<Picture, ImageError> {
    let malformed = |what: String| ImageError::Malformed { what };
    let refused = |error: CodecError| malformed(error.to_string());
    if !SIGNATURES.iter().any(|first| bytes.starts_with(first)) {
        return Err(malformed(
            "it does not begin with #?RADIANCE or #?RGBE".to_owned(),
        ));
    }
    // The decoder's strict mode knows one of the two signatures alone.
    let decoder = HdrDecoder::new_nonstrict(Cursor::new(bytes)).map_err(refused)?;
    let header = decoder.metadata();
    let other = header.custom_attributes.iter();
    let mut other = other.filter(|(name, _)| name == "FORMAT");
    if let Some((_, format)) = other.find(|(_, format)| format != "32-bit_rle_rgbe") {
        return Err(malformed(format!(
            "its format is `{format}`; only 32-bit_rle_rgbe is read"
        )));
    }
    let (width, height) = (header.width, header.height);
    let (across, down) = (u64::from(width), u64::from(height));
    check_size(across, down, 3, BYTES_A_PIXEL, MOST_TEXTURE_BYTES)?;
    if across * down > bytes.len() as u64 * MOST_PIXELS_A_BYTE {
        let length = bytes.len();
        return Err(malformed(format!(
            "{width} × {height} pixels in {length} bytes: it is cut short"
        )));
    }
    let exposure = header.exposure.unwrap_or(1.0);
    if !(exposure.is_finite() && exposure > 0.0) {
        return Err(malformed(format!("its EXPOSURE is {exposure}")));
    }
    let mut values = vec![0_u8; (across * down * BYTES_A_PIXEL) as usize];
    decoder.read_image(&mut values).map_err(refused)?;
    let values: Vec<f32> = values
        .chunks_exact(size_of::<f32>())
        .map(|bytes| f32::from_ne_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]) / exposure)
        .collect();
    let layer = |number: usize, name: &str| Layer {
        name: name.to_owned(),
        data: values.iter().skip(number).step_by(3).copied().collect(),
    };
    Ok(Picture {
        width,
        height,
        layers: vec![layer(0, "R"), layer(1, "G"), layer(2, "B")],
        attributes: vec![("chromaticities".to_owned(), REC709)],
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A file of two flat pixels a row, three rows, with this line in its header.
    fn file(line: &str) -> Vec<u8> {
        let mut bytes =
            format!("#?RADIANCE\n{line}\nFORMAT=32-bit_rle_rgbe\n\n-Y 3 +X 2\n").into_bytes();
        for row in 0..3 {
            // Mantissas over 256, times two to the exponent less 128.
            bytes.extend([128, 64, 32, 129 + row]);
            bytes.extend([255, 0, 1, 120]);
        }
        bytes
    }

    #[test]
    fn pixels_are_mantissas_times_powers_of_two_from_the_top() {
        let picture = decode(&file("SOFTWARE=by hand")).expect("it is a picture");
        assert_eq!((picture.width, picture.height), (2, 3));
        let red = &picture.layer("R").expect("red is there").data;
        let blue = &picture.layer("B").expect("blue is there").data;
        // Half a mantissa step is added by no one: 128 / 256 · 2¹ = 1.
        assert_eq!([red[0], red[2], red[4]], [1.0, 2.0, 4.0]);
        assert_eq!(blue[0], 0.25);
        assert!((red[1] - 255.0 / 65536.0).abs() < 1e-8);
    }

    #[test]
    fn exposure_is_taken_out() {
        let picture = decode(&file("EXPOSURE=0.5")).expect("it is a picture");
        assert_eq!(picture.layer("R").expect("red is there").data[0], 2.0);
        assert!(decode(&file("EXPOSURE=0")).is_err());
        assert!(decode(&file("EXPOSURE=-2")).is_err());
    }

    #[test]
    fn what_is_cut_short_or_too_large_is_refused() {
        let whole = file("SOFTWARE=by hand");
        for length in 0..whole.len() {
            assert!(decode(&whole[..length]).is_err(), "{length} bytes");
        }
        let sized = |size: &str| {
            let given = b"-Y 3 +X 2";
            let at = whole.windows(given.len()).position(|part| part == given);
            let (before, after) = whole.split_at(at.expect("the size is there"));
            [before, size.as_bytes(), &after[given.len()..]].concat()
        };
        assert_eq!(sized("-Y 3 +X 2"), whole);
        assert!(decode(&sized("-Y 2 +X 3")).is_ok());
        for other in ["-Y 400000 +X 400000", "+Y 3 +X 2", "-Y 3 -X 2", "+X 2 -Y 3"] {
            assert!(decode(&sized(other)).is_err(), "{other}");
        }
        assert!(decode(&whole[1..]).is_err());
        let short = [b"#?RGBE", &whole["#?RADIANCE".len()..]].concat();
        assert!(decode(&short).is_ok());
        assert!(
            decode(b"#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n\x01\x01\x01\x80").is_err()
        );
    }
}
