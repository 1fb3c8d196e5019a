//! Radiance HDR (`.hdr`, RGBE): pictures of surroundings as they are shared most.
//!
//! The header is read here, since the decoder knows neither the primaries, nor the correction of
//! colours, nor the orders of pixels, nor lines that end in CR LF; pixels are decoded by the crate.

use std::io::{Cursor, Read};
use std::path::Path;

use image::ImageDecoder;
use image::codecs::hdr::HdrDecoder;
use leafmodel::document::source::escaped;

use super::error::{ImageError, MOST_TEXTURE_BYTES, check_size};
use super::picture::{Picture, REC709_POINTS};

/// What files begin with.
const SIGNATURES: [&str; 2] = ["#?RADIANCE", "#?RGBE"];

/// Bytes of a pixel in memory while it is read.
const BYTES_A_PIXEL: u64 = 12;

/// Most pixels that a byte of a file can stand for: a run of 127 pixels takes two bytes in each of
/// four channels.
const MOST_PIXELS_A_BYTE: u64 = 16;

/// Most bytes of a line of a header.
const MOST_LINE: usize = 1 << 16;

/// What the header says.
struct RadianceHeader {
    /// What each channel is divided by: exposures and corrections of colours.
    factors: [f32; 3],
    points: [[f32; 2]; 4],
    order: Order,
    /// Where the pixels begin.
    pixels: usize,
}

/// In which order pixels are stored.
#[derive(Clone, Copy)]
struct Order {
    /// Lines that are stored, and pixels in each.
    lines: u32,
    length: u32,
    /// Whether a line that is stored is a column.
    is_column: bool,
    /// Whether lines begin on the right or below, and whether pixels do.
    reversed: [bool; 2],
}

impl Order {
    /// By the two axes of the resolution line, such as `-Y 512 +X 1024`.
    fn parse(line: &str) -> Option<Self> {
        let words: Vec<&str> = line.split_ascii_whitespace().collect();
        let &[first, lines, second, length] = words.as_slice() else {
            return None;
        };
        let (is_column, reversed) = match (first, second) {
            ("-Y", "+X") => (false, [false, false]),
            ("-Y", "-X") => (false, [false, true]),
            ("+Y", "+X") => (false, [true, false]),
            ("+Y", "-X") => (false, [true, true]),
            ("+X", "-Y") => (true, [false, false]),
            ("+X", "+Y") => (true, [false, true]),
            ("-X", "-Y") => (true, [true, false]),
            ("-X", "+Y") => (true, [true, true]),
            _ => return None,
        };
        Some(Self {
            lines: lines.parse().ok()?,
            length: length.parse().ok()?,
            is_column,
            reversed,
        })
    }

    /// Width and height of the upright picture.
    fn size(self) -> (u32, u32) {
        if self.is_column {
            (self.lines, self.length)
        } else {
            (self.length, self.lines)
        }
    }

    /// Which pixel of the file each of the upright picture is, row by row from the top.
    fn upright(self) -> impl Iterator<Item = usize> {
        let (width, height) = self.size();
        let from = |place: u32, count: u32, reversed: bool| {
            let place = if reversed { count - 1 - place } else { place };
            place as usize
        };
        (0..height).flat_map(move |row| {
            (0..width).map(move |column| {
                let (line, place) = if self.is_column {
                    (column, row)
                } else {
                    (row, column)
                };
                let line = from(line, self.lines, self.reversed[0]);
                line * self.length as usize + from(place, self.length, self.reversed[1])
            })
        })
    }
}

/// Reads a Radiance file as light.
///
/// # Errors
///
/// As [`decode`], with the path; [`ImageError::File`] if there is no such file or it is larger than
/// 4 GiB.
pub fn read(path: &Path) -> Result<Picture, ImageError> {
    super::error::read_file(path, decode)
}

/// Reads the bytes of a Radiance file, upright: layers R, G and B as the file has them, with its
/// exposure and its correction of colours taken out, so that they are the light of the place. Their
/// primaries are an attribute; those of Rec. 709 if the file gives none.
///
/// # Errors
///
/// [`ImageError::TooLarge`] from the header alone; [`ImageError::Malformed`], also for a file of
/// XYZE.
pub fn decode(bytes: &[u8]) -> Result<Picture, ImageError> {
    let RadianceHeader {
        factors,
        points,
        order,
        pixels,
    } = header(bytes)?;
    let (width, height) = order.size();
    let (across, down) = (u64::from(width), u64::from(height));
    check_size(across, down, 3, BYTES_A_PIXEL, MOST_TEXTURE_BYTES)?;
    if across * down > bytes.len() as u64 * MOST_PIXELS_A_BYTE {
        let length = bytes.len();
        return Err(ImageError::malformed(format_args!(
            "{width} × {height} pixels in {length} bytes: it is cut short"
        )));
    }
    let Order { lines, length, .. } = order;
    let plain = format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {lines} +X {length}\n");
    let mut values = vec![0_u8; (across * down * BYTES_A_PIXEL) as usize];
    HdrDecoder::new(Cursor::new(plain).chain(&bytes[pixels..]))
        .and_then(|decoder| decoder.read_image(&mut values))
        .map_err(ImageError::malformed)?;
    let (values, _) = values.as_chunks::<4>();
    let channel = |number: usize| {
        let value = |pixel: usize| f32::from_ne_bytes(values[3 * pixel + number]) / factors[number];
        order.upright().map(value).collect()
    };
    let channels = [0, 1, 2].map(channel);
    Ok(Picture::of_colours([width, height], channels, points))
}

/// Reads the header.
fn header(bytes: &[u8]) -> Result<RadianceHeader, ImageError> {
    let mut at = 0;
    let mut line = || {
        let rest = &bytes[at..];
        let end = rest.iter().take(MOST_LINE).position(|&byte| byte == b'\n');
        let end = end.ok_or_else(|| ImageError::malformed("its header is cut short"))?;
        at += end + 1;
        let text = String::from_utf8_lossy(&rest[..end]);
        Ok((text.trim_end_matches('\r').to_owned(), at))
    };
    if !SIGNATURES.contains(&line()?.0.as_str()) {
        return Err(ImageError::malformed(
            "it does not begin with #?RADIANCE or #?RGBE",
        ));
    }
    let (mut factors, mut points) = ([1.0_f32; 3], REC709_POINTS);
    loop {
        let (text, _) = line()?;
        if text.is_empty() {
            break;
        }
        let Some((name, value)) = text.split_once('=').filter(|_| !text.starts_with('#')) else {
            continue;
        };
        let (name, value) = (name.trim(), value.trim());
        let wrong = || ImageError::malformed(format_args!("its {name} is {}", escaped(value, 60)));
        match name {
            "FORMAT" if value != "32-bit_rle_rgbe" => {
                let shown = escaped(value, 60);
                return Err(ImageError::malformed(format_args!(
                    "its format is `{shown}`; only 32-bit_rle_rgbe is read: convert it, for example \
                     by `ra_xyze -r`"
                )));
            }
            // Each program that changes a picture adds a line.
            "EXPOSURE" => {
                let [exposure] = numbers(value).ok_or_else(wrong)?;
                factors = factors.map(|factor| factor * exposure);
            }
            "COLORCORR" => {
                let correction: [f32; 3] = numbers(value).ok_or_else(wrong)?;
                factors = std::array::from_fn(|channel| factors[channel] * correction[channel]);
            }
            "PRIMARIES" => {
                let given: [f32; 8] = numbers(value).ok_or_else(wrong)?;
                // Some programs write zeros where they know nothing.
                if given != [0.0; 8] {
                    points = std::array::from_fn(|i| [given[2 * i], given[2 * i + 1]]);
                }
            }
            "GAMMA" if numbers::<1>(value) != Some([1.0]) => {
                let shown = escaped(value, 60);
                return Err(ImageError::malformed(format_args!(
                    "its GAMMA is {shown}: only light itself, 1, is read"
                )));
            }
            _ => {}
        }
        if !factors
            .iter()
            .all(|factor| factor.is_finite() && *factor > 0.0)
        {
            return Err(wrong());
        }
    }
    let (size, pixels) = line()?;
    let order = Order::parse(&size).ok_or_else(|| {
        let shown = escaped(&size, 60);
        ImageError::malformed(format_args!(
            "`{shown}` is no size such as `-Y 512 +X 1024`"
        ))
    })?;
    Ok(RadianceHeader {
        factors,
        points,
        order,
        pixels,
    })
}

/// So many numbers, all finite.
fn numbers<const N: usize>(text: &str) -> Option<[f32; N]> {
    let words = text.split_ascii_whitespace().map(|word| word.parse().ok());
    let numbers: Vec<f32> = words.collect::<Option<_>>()?;
    let numbers: [f32; N] = numbers.try_into().ok()?;
    numbers
        .iter()
        .all(|number| number.is_finite())
        .then_some(numbers)
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
        for other in [
            "-Y 400000 +X 400000",
            "-Y 0 +X 2",
            "-Y 3 -Y 2",
            "-Y 3",
            "-Y 4294967296 +X 2",
        ] {
            assert!(decode(&sized(other)).is_err(), "{other}");
        }
        assert!(decode(&whole[1..]).is_err());
        let short = [b"#?RGBE", &whole["#?RADIANCE".len()..]].concat();
        assert!(decode(&short).is_ok());
        assert!(
            decode(b"#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n\x01\x01\x01\x80").is_err()
        );
    }

    /// Red of each pixel of the file of [`file`] in another order, row by row, and the width.
    fn ordered(size: &str) -> (u32, Vec<f32>) {
        let text = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";
        let mut bytes = format!("{text}{size}\n").into_bytes();
        for exponent in 129..135_u8 {
            bytes.extend([128, 128, 128, exponent]);
        }
        let picture = decode(&bytes).expect("it is a picture");
        let red = picture.layer("R").expect("red is there");
        // As the numbers of the pixels in the file.
        (
            picture.width,
            red.data.iter().map(|red| red.log2()).collect(),
        )
    }

    #[test]
    fn pictures_stored_in_any_order_are_upright() {
        for (size, width, expected) in [
            ("-Y 3 +X 2", 2, [0, 1, 2, 3, 4, 5]),
            ("-Y 3 -X 2", 2, [1, 0, 3, 2, 5, 4]),
            ("+Y 3 +X 2", 2, [4, 5, 2, 3, 0, 1]),
            ("+Y 3 -X 2", 2, [5, 4, 3, 2, 1, 0]),
            ("+X 3 -Y 2", 3, [0, 2, 4, 1, 3, 5]),
            ("+X 3 +Y 2", 3, [1, 3, 5, 0, 2, 4]),
            ("-X 3 -Y 2", 3, [4, 2, 0, 5, 3, 1]),
            ("-X 3 +Y 2", 3, [5, 3, 1, 4, 2, 0]),
        ] {
            let expected = expected.map(|number: u8| f32::from(number)).to_vec();
            assert_eq!(ordered(size), (width, expected), "{size}");
        }
    }

    #[test]
    fn headers_may_end_their_lines_as_windows_does() {
        let unix = file("EXPOSURE=0.5");
        let end = unix
            .windows(4)
            .position(|part| part == b"X 2\n")
            .expect("the size")
            + 4;
        let mut windows = Vec::new();
        for byte in &unix[..end] {
            if *byte == b'\n' {
                windows.push(b'\r');
            }
            windows.push(*byte);
        }
        windows.extend(&unix[end..]);
        let windows = decode(&windows).expect("it is a picture");
        assert_eq!(windows, decode(&unix).expect("it is a picture"));
    }

    #[test]
    fn corrections_of_colours_and_exposures_multiply_and_are_taken_out() {
        let file = file("EXPOSURE=0.5\nCOLORCORR= 2 4 0.5\nEXPOSURE=4\nCOLORCORR=1 1 2");
        let picture = decode(&file).expect("it is a picture");
        let first = ["R", "G", "B"].map(|name| picture.layer(name).expect("colours").data[0]);
        // 1, 1/2 and 1/4, over 2 · (2, 4, 1).
        assert_eq!(first, [0.25, 0.0625, 0.125]);
    }

    #[test]
    fn primaries_of_the_header_are_those_of_the_colours() {
        let points = |line: &str| {
            let picture = decode(&file(line)).expect("it is a picture");
            match picture.attribute("chromaticities") {
                Some(crate::image::Attribute::Chromaticities(points)) => *points,
                other => panic!("{other:?}"),
            }
        };
        let given = points("PRIMARIES= .708 .292 .170 .797 .131 .046 .3127 .3290");
        assert_eq!(given, super::super::primaries::REC2020);
        assert_eq!(points("SOFTWARE=by hand"), REC709_POINTS);
        assert_eq!(points("PRIMARIES=0 0 0 0 0 0 0 0"), REC709_POINTS);
        for line in [
            "PRIMARIES=0.6 0.3",
            "COLORCORR=1 -1 1",
            "GAMMA=2.2",
            "EXPOSURE=x",
        ] {
            let refused = decode(&file(line))
                .map(|_| ())
                .expect_err("it is not valid");
            let name = line.split('=').next().expect("a name");
            assert!(refused.to_string().contains(name), "{refused}");
        }
    }
}
