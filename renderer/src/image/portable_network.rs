//! PNG: pictures for viewing, and low-range textures.

use std::io::{Cursor, Write};
use std::path::Path;

use image::metadata::Orientation;
use image::{DynamicImage, ImageFormat, ImageReader, Limits};
use png::{BitDepth, ColorType, ScaledFloat, SourceChromaticities};

use super::atomic;
use super::encoding::{Encoding, Stored};
use super::error::{ImageError, MOST_BYTES, MOST_TEXTURE_BYTES, check_held, check_size};
use super::picture::{Layer, Picture, REC709_POINTS};
use super::pixels::{Depth, Pixels};
use super::tone::from_srgb;

/// The exponent 1/2.2 times 100 000, which stands for the curve of sRGB where it is not known.
const GAMMA: u32 = 45455;

/// Greatest size of a profile of colours, bytes.
pub(super) const MOST_PROFILE: u64 = 64 << 20;

/// Writes 8-bit sRGB values, interleaved, by row from the top.
///
/// # Errors
///
/// [`ImageError::Inconsistent`] unless there are 3 · width · height of them; [`ImageError::File`].
pub fn write(path: &Path, width: u32, height: u32, rgb: &[u8]) -> Result<(), ImageError> {
    let bytes = encoded(width, height, rgb)?;
    atomic::replace(path, |file| file.write_all(&bytes))
}

/// The bytes of the file that [`write()`] writes.
///
/// # Errors
///
/// [`ImageError::Inconsistent`] unless there are 3 · width · height values.
pub fn encoded(width: u32, height: u32, rgb: &[u8]) -> Result<Vec<u8>, ImageError> {
    let kind = (ColorType::Rgb, BitDepth::Eight);
    encode([width, height], rgb, rgb.len() as u64, kind)
}

/// The bytes of a file with the pixels of a display: 8 or 16 bits, with or without alpha.
///
/// # Errors
///
/// [`ImageError::Inconsistent`] unless the number of values is that of the pixels.
pub fn encoded_pixels(pixels: &Pixels) -> Result<Vec<u8>, ImageError> {
    let values = pixels.values.iter();
    let (bytes, depth): (Vec<u8>, _) = match pixels.depth {
        Depth::Eight => (values.map(|&value| value as u8).collect(), BitDepth::Eight),
        Depth::Sixteen => {
            let bytes = values.flat_map(|value| value.to_be_bytes());
            (bytes.collect(), BitDepth::Sixteen)
        }
    };
    let colour = match pixels.channels {
        4 => ColorType::Rgba,
        _ => ColorType::Rgb,
    };
    let size = [pixels.width, pixels.height];
    encode(size, &bytes, pixels.values.len() as u64, (colour, depth))
}

/// What has written a file.
pub(super) const SOFTWARE: &str = concat!("Lamina ", env!("CARGO_PKG_VERSION"));

/// An encoder whose file says that its values are sRGB, and what has written it.
pub(super) fn encoder<W: Write>(
    out: W,
    [width, height]: [u32; 2],
    (colour, depth): (ColorType, BitDepth),
) -> Result<png::Encoder<'static, W>, png::EncodingError> {
    let mut encoder = png::Encoder::new(out, width, height);
    encoder.set_color(colour);
    encoder.set_depth(depth);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    encoder.add_text_chunk("Software".to_owned(), SOFTWARE.to_owned())?;
    Ok(encoder)
}

/// White D65 and the primaries of Rec. 709, which sRGB has.
fn rec709() -> SourceChromaticities {
    let point = |x, y| [x, y].map(ScaledFloat::from_scaled).into();
    SourceChromaticities {
        red: point(64000, 33000),
        green: point(30000, 60000),
        blue: point(15000, 6000),
        white: point(31270, 32900),
    }
}

/// A whole file of `count` values in their bytes.
fn encode(
    [width, height]: [u32; 2],
    values: &[u8],
    count: u64,
    kind: (ColorType, BitDepth),
) -> Result<Vec<u8>, ImageError> {
    check_size(width, height, 3, 12, MOST_BYTES)?;
    let channels = kind.0.samples() as u64;
    if count != u64::from(width) * u64::from(height) * channels {
        return Err(ImageError::inconsistent(format_args!(
            "{count} values for {width} × {height} pixels of {channels}"
        )));
    }
    let mut bytes = Vec::new();
    let written = encoder(&mut bytes, [width, height], kind).and_then(|mut encoder| {
        // For programs that do not know the chunk of sRGB.
        encoder.set_source_gamma(ScaledFloat::from_scaled(GAMMA));
        encoder.set_source_chromaticities(rec709());
        encoder.set_compression(png::Compression::Fast);
        encoder.set_filter(png::Filter::Adaptive);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(values)?;
        writer.finish()
    });
    written.map_err(ImageError::inconsistent)?;
    Ok(bytes)
}

/// Reads a PNG file as linear light.
///
/// # Errors
///
/// As [`decode`], with the path; [`ImageError::File`] if there is no such file or it is larger than
/// 4 GiB.
pub fn read(path: &Path) -> Result<Picture, ImageError> {
    super::error::read_file(path, decode)
}

/// Reads the bytes of a PNG file: layers R, G and B in linear light, 0 to 1, and their primaries as
/// an attribute. Grey becomes three equal layers; alpha is left out.
///
/// What values mean is looked for in the order of the format: code points (`cICP`), a profile
/// (`iCCP`), `sRGB`, then gamma and primaries (`gAMA`, `cHRM`). Without any of them they are sRGB.
///
/// # Errors
///
/// [`ImageError::TooLarge`] from the header alone; [`ImageError::Malformed`], also for colours that
/// cannot be converted.
pub fn decode(bytes: &[u8]) -> Result<Picture, ImageError> {
    let pixels = decode_stored(bytes, 3)?.into_rgb16();
    Ok(encoding(bytes)?.linear(&pixels))
}

/// As [`decode`], of values whose meaning the format lays down that carries the picture, unturned.
///
/// # Errors
///
/// [`ImageError::TooLarge`] from the header alone; [`ImageError::Malformed`].
pub fn decode_as(bytes: &[u8], stored: Stored) -> Result<Picture, ImageError> {
    let (pixels, _) = decode_unturned(bytes, 3)?;
    Ok(Encoding::of(stored).linear(&pixels.into_rgb16()))
}

/// What a file says of its values.
fn encoding(bytes: &[u8]) -> Result<Encoding, ImageError> {
    let limits = png::Limits {
        bytes: MOST_PROFILE as usize,
    };
    let reader = png::Decoder::new_with_limits(Cursor::new(bytes), limits).read_info();
    let reader = reader.map_err(ImageError::malformed)?;
    let info = reader.info();
    if let Some(points) = info.coding_independent_code_points {
        let codes = [
            points.color_primaries,
            points.transfer_function,
            points.matrix_coefficients,
        ];
        return Encoding::of_code_points(codes, points.is_video_full_range_image);
    }
    if let Some(profile) = &info.icc_profile {
        return Encoding::of_profile(profile);
    }
    // The decoder passes over a profile that it cannot use.
    if has_profile(bytes) {
        return Err(ImageError::malformed(format_args!(
            "its profile of colours (iCCP) is damaged or larger than {} MiB: save it without, in sRGB",
            MOST_PROFILE >> 20
        )));
    }
    if info.srgb.is_some() {
        return Ok(Encoding::srgb());
    }
    let points = info.chrm_chunk.map_or(REC709_POINTS, |given| {
        let of = [given.red, given.green, given.blue, given.white];
        of.map(|(x, y)| [x.into_value(), y.into_value()])
    });
    let gamma = info.gama_chunk.map_or(0, png::ScaledFloat::into_scaled);
    // About 1/2.2 is written for the curve of sRGB; 0 has no meaning.
    if gamma == 0 || gamma.abs_diff(GAMMA) < 500 {
        return Ok(Encoding::even(from_srgb, points));
    }
    let power = 100_000.0 / f64::from(gamma);
    Ok(Encoding::even(move |value| libm::pow(value, power), points))
}

/// Whether a chunk `iCCP` stands before the pixels of a valid file.
fn has_profile(mut chunks: &[u8]) -> bool {
    chunks = chunks.get(8..).unwrap_or_default();
    // Length, kind, data, checksum.
    while let Some((length, rest)) = chunks.split_first_chunk::<4>() {
        match rest.get(..4) {
            Some(b"iCCP") => return true,
            None | Some(b"IDAT") => return false,
            Some(_) => {}
        }
        let length = u32::from_be_bytes(*length) as usize;
        chunks = rest.get(length.saturating_add(8)..).unwrap_or_default();
    }
    false
}

/// Reads grey or alpha of a PNG file as written, 0 to 1, as a picture with one layer, `grey` or
/// `A`.
///
/// # Errors
///
/// As [`read`].
pub fn read_weights(path: &Path, alpha: bool) -> Result<Picture, ImageError> {
    super::error::read_file(path, |bytes| Ok(weights(decode_stored(bytes, 4)?, alpha)))
}

/// Grey or alpha of pixels.
fn weights(stored: DynamicImage, alpha: bool) -> Picture {
    let pixels = stored.into_luma_alpha16();
    let (width, height) = pixels.dimensions();
    let share = |pixel: &image::LumaA<u16>| f32::from(pixel.0[usize::from(alpha)]) / 65535.0;
    let name = if alpha { "A" } else { "grey" };
    let shares = pixels.pixels().map(share).collect();
    Picture::new([width, height], [Layer::new(name, shares)])
}

/// Alpha of the bytes of a PNG file as written, 0 to 1, unturned: one layer, `A`.
///
/// # Errors
///
/// [`ImageError::TooLarge`] from the header alone; [`ImageError::Malformed`].
pub fn decode_alpha(bytes: &[u8]) -> Result<Picture, ImageError> {
    let (stored, _) = decode_unturned(bytes, 4)?;
    Ok(weights(stored, true))
}

/// Pixels as stored, upright, with at most `channels` channels.
fn decode_stored(bytes: &[u8], channels: u64) -> Result<DynamicImage, ImageError> {
    let (mut pixels, orientation) = decode_unturned(bytes, channels)?;
    pixels.apply_orientation(orientation);
    Ok(pixels)
}

/// Pixels as stored, and how they have to be turned to be upright.
fn decode_unturned(bytes: &[u8], channels: u64) -> Result<(DynamicImage, Orientation), ImageError> {
    let mut header = png::Decoder::new(Cursor::new(bytes));
    let header = header.read_header_info().map_err(ImageError::malformed)?;
    let (across, down) = (u64::from(header.width), u64::from(header.height));
    check_size(across, down, channels, 12, MOST_TEXTURE_BYTES)?;
    let stored = header.bits_per_pixel() as u64;
    check_held(across * down / 8 * stored, bytes.len())?;
    let mut reader = ImageReader::with_format(Cursor::new(bytes), ImageFormat::Png);
    let mut limits = Limits::default();
    // The decoder holds a row at a time, besides what stands before the pixels.
    limits.max_alloc = Some(8 * across + MOST_PROFILE);
    reader.limits(limits);
    super::error::turned(reader).map_err(ImageError::malformed)
}

#[cfg(test)]
mod tests {
    use super::super::Attribute;
    use super::super::display::Display;
    use super::super::tone::Tone;
    use super::*;

    #[test]
    fn eight_bits_come_back_as_the_light_they_stand_for() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("picture.png");
        let rgb: Vec<u8> = (0..=255)
            .flat_map(|value: u8| [value, 255 - value, 7])
            .collect();
        write(&path, 32, 8, &rgb).expect("the folder can be written");
        let picture = read(&path).expect("it was just written");
        assert_eq!((picture.width, picture.height), (32, 8));
        let display = Display {
            tone: Tone::Linear,
            ..Display::default()
        };
        let pixels = display.pixels(&picture).expect("it has colours");
        assert!(
            pixels
                .values
                .iter()
                .zip(&rgb)
                .all(|(one, other)| *one == u16::from(*other))
        );
        assert_eq!(picture.layers[0].data[255], 1.0);
        // 188 is the well-known encoding of half the light.
        assert!((picture.layers[0].data[188] - 0.5).abs() < 0.004);
    }

    #[test]
    fn sixteen_bits_come_back_as_the_light_they_stand_for() {
        let rgb = [0, 1, 258, 40_000, 65_534, 65_535_u16];
        let bytes = rgb.map(u16::to_be_bytes).concat();
        let kind = (ColorType::Rgb, BitDepth::Sixteen);
        let bytes = encode([2, 1], &bytes, 6, kind).expect("two pixels");
        let picture = decode(&bytes).expect("it was just encoded");
        for (i, value) in rgb.into_iter().enumerate() {
            let expected = from_srgb(f64::from(value) / 65535.0) as f32;
            assert_eq!(picture.layers[i % 3].data[i / 3], expected);
        }
    }

    /// Where the first chunk ends: signature 8, then the header chunk of 13 + 12 bytes.
    const AFTER_HEADER: usize = 8 + 25;

    /// A chunk with its checksum.
    fn chunk(name: [u8; 4], data: &[u8]) -> Vec<u8> {
        let mut chunk = (data.len() as u32).to_be_bytes().to_vec();
        chunk.extend(name);
        chunk.extend(data);
        chunk.extend(crc32fast::hash(&chunk[4..]).to_be_bytes());
        chunk
    }

    /// A file of six grey or coloured values in which these chunks alone say what they mean.
    fn tagged(rgb: [u8; 6], chunks: &[Vec<u8>]) -> Vec<u8> {
        let mut bytes = encoded(2, 1, &rgb).expect("two pixels");
        let pixels = bytes.windows(4).position(|name| name == b"IDAT");
        let pixels = pixels.expect("a picture has pixels") - 4;
        bytes.splice(AFTER_HEADER..pixels, chunks.concat());
        bytes
    }

    fn values(bytes: &[u8]) -> [f64; 6] {
        let picture = decode(bytes).expect("a valid file");
        std::array::from_fn(|i| f64::from(picture.layers[i % 3].data[i / 3]))
    }

    fn points(bytes: &[u8]) -> [[f32; 2]; 4] {
        let picture = decode(bytes).expect("a valid file");
        match picture.attribute("chromaticities") {
            Some(Attribute::Chromaticities(points)) => *points,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn a_gamma_without_a_colour_space_is_the_power_of_light() {
        let rgb = [0, 50, 100, 150, 200, 255];
        for (gamma, power) in [(100_000_u32, Some(1.0)), (50_000, Some(2.0)), (GAMMA, None)] {
            let gamma = chunk(*b"gAMA", &gamma.to_be_bytes());
            let found = values(&tagged(rgb, std::slice::from_ref(&gamma)));
            for (value, found) in rgb.iter().zip(found) {
                let value = f64::from(*value) / 255.0;
                let expected = power.map_or_else(|| from_srgb(value), |p| value.powf(p));
                assert!((found - expected).abs() < 1e-6, "{found} {expected}");
            }
            // A file that says it is sRGB is, whatever its gamma.
            let both = tagged(rgb, &[gamma, chunk(*b"sRGB", &[0])]);
            assert_eq!(values(&both), values(&tagged(rgb, &[])));
        }
    }

    #[test]
    fn primaries_are_those_that_the_file_names() {
        let rgb = [10, 50, 100, 150, 200, 255];
        let wide = [31270, 32900, 70800, 29200, 17000, 79700, 13100, 4600_u32];
        let wide = chunk(*b"cHRM", &wide.map(u32::to_be_bytes).concat());
        let rec2020 = super::super::primaries::REC2020;
        let close = |points: [[f32; 2]; 4]| {
            let mut pairs = points.iter().flatten().zip(rec2020.iter().flatten());
            pairs.all(|(a, b)| (a - b).abs() < 1e-6)
        };
        assert!(close(points(&tagged(rgb, std::slice::from_ref(&wide)))));
        // The space sRGB comes before primaries, code points before it.
        let both = tagged(rgb, &[chunk(*b"sRGB", &[0]), wide]);
        assert_eq!(points(&both), REC709_POINTS);
        let codes = |codes: [u8; 4]| chunk(*b"cICP", &codes);
        let named = tagged(rgb, &[codes([9, 8, 0, 1]), chunk(*b"sRGB", &[0])]);
        assert!(close(points(&named)));
        assert!((values(&named)[5] - 1.0).abs() < 1e-6);
        assert!((values(&named)[1] - 50.0 / 255.0).abs() < 1e-6, "linear");
        let bright = values(&tagged(rgb, &[codes([9, 16, 0, 1])]))[5];
        assert!((bright - 10_000.0 / 203.0).abs() < 0.01, "{bright}");
        let refused = decode(&tagged(rgb, &[codes([9, 18, 0, 1])])).map(|_| ());
        let text = refused.expect_err("it is not read").to_string();
        assert!(text.contains("hybrid log-gamma"), "{text}");
    }

    #[test]
    fn a_profile_of_a_file_is_used() {
        use image::ImageEncoder as _;
        use image::codecs::png::PngEncoder;
        let profile = moxcms::ColorProfile::new_display_p3().encode();
        let mut bytes = Vec::new();
        let mut encoder = PngEncoder::new(&mut bytes);
        let profile = profile.expect("a good profile");
        encoder.set_icc_profile(profile).expect("PNG has profiles");
        let written = encoder.write_image(&[255, 0, 0], 1, 1, image::ExtendedColorType::Rgb8);
        written.expect("one pixel");
        assert!(
            (points(&bytes)[0][0] - 0.68).abs() < 0.01,
            "{:?}",
            points(&bytes)
        );
        assert_eq!(
            decode_as(&bytes, Stored::Srgb)
                .expect("a valid file")
                .attribute("chromaticities"),
            Some(&super::super::REC709)
        );
    }

    #[test]
    fn a_picture_that_lies_on_its_side_is_stood_up() {
        // Exif in big-endian order with one entry: orientation 6, a quarter turn clockwise.
        let exif = b"MM\0\x2a\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x06\0\0\0\0\0\0";
        let bytes = tagged([255, 0, 0, 0, 0, 255], &[chunk(*b"eXIf", exif)]);
        let picture = decode(&bytes).expect("a valid file");
        assert_eq!((picture.width, picture.height), (1, 2));
        // Its left is above.
        assert_eq!(picture.layer("R").expect("colours").data, [1.0, 0.0]);
        let unturned = decode_as(&bytes, Stored::Srgb).expect("a valid file");
        assert_eq!((unturned.width, unturned.height), (2, 1));
    }

    #[test]
    fn the_file_says_that_it_is_srgb_with_right_checksums() {
        let bytes = encoded(1, 1, &[1, 2, 3]).expect("one pixel");
        let points = [31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000_u32];
        let mut at = AFTER_HEADER;
        for (name, data) in [
            (b"sRGB", vec![0_u8]),
            (b"gAMA", 45455_u32.to_be_bytes().to_vec()),
            (b"cHRM", points.map(u32::to_be_bytes).concat()),
        ] {
            let length = bytes[at..at + 4].try_into().map(u32::from_be_bytes);
            let end = at + 8 + length.expect("four bytes") as usize;
            assert_eq!(&bytes[at + 4..at + 8], name);
            assert_eq!(bytes[at + 8..end], data);
            // CRC-32 as the PNG specification defines it, over name and data.
            let mut crc = u32::MAX;
            for &byte in &bytes[at + 4..end] {
                crc ^= u32::from(byte);
                for _ in 0..8 {
                    crc = crc >> 1 ^ if crc & 1 == 1 { 0xedb8_8320 } else { 0 };
                }
            }
            assert_eq!(bytes[end..end + 4], (!crc).to_be_bytes());
            at = end + 4;
        }
        assert!(decode(&bytes).is_ok());
    }

    #[test]
    fn pixels_of_a_display_come_back_with_their_depth_and_alpha() {
        for (depth, channels) in [
            (Depth::Eight, 3_u8),
            (Depth::Eight, 4),
            (Depth::Sixteen, 3),
            (Depth::Sixteen, 4),
        ] {
            let step = depth.most() / 255;
            let values: Vec<u16> = (0..6 * u16::from(channels)).map(|i| 7 * i * step).collect();
            let pixels = Pixels {
                width: 3,
                height: 2,
                depth,
                channels,
                values: values.clone(),
            };
            let bytes = encoded_pixels(&pixels).expect("they are complete");
            let stored = decode_stored(&bytes, 4).expect("it was just encoded");
            assert_eq!(stored.color().has_alpha(), channels == 4);
            assert_eq!(
                stored.color().bits_per_pixel(),
                match depth {
                    Depth::Eight => 8,
                    Depth::Sixteen => 16,
                } * u16::from(channels)
            );
            let most = u32::from(depth.most());
            let back = stored.into_rgba16().into_raw();
            for (pixel, written) in back.chunks(4).zip(values.chunks(usize::from(channels))) {
                for (value, written) in pixel.iter().zip(written) {
                    assert_eq!(u32::from(*value), u32::from(*written) * 65535 / most);
                }
            }
            let short = Pixels {
                height: 3,
                ..pixels
            };
            assert!(encoded_pixels(&short).is_err());
        }
    }

    #[test]
    fn a_header_that_claims_too_much_and_damaged_files_are_refused() {
        let whole = encoded(8, 8, &[90; 192]).expect("a small picture");
        for size in [60_000_u32, 0x7fff_ffff] {
            let mut bomb = whole.clone();
            bomb[16..20].copy_from_slice(&size.to_be_bytes());
            bomb[20..24].copy_from_slice(&size.to_be_bytes());
            let error = decode(&bomb).map(|_| ()).expect_err("nobody wants that");
            assert!(
                matches!(
                    error,
                    ImageError::TooLarge { .. } | ImageError::Malformed { .. }
                ),
                "{error}"
            );
        }
        // A sound header of 16,000² pixels.
        let mut large = whole.clone();
        large[16..20].copy_from_slice(&16_000_u32.to_be_bytes());
        large[20..24].copy_from_slice(&16_000_u32.to_be_bytes());
        let sum = crc32fast::hash(&large[12..29]);
        large[29..33].copy_from_slice(&sum.to_be_bytes());
        let error = decode(&large).map(|_| ()).expect_err("nobody wants that");
        assert!(error.to_string().contains("16000 × 16000"), "{error}");
        for length in 0..whole.len() - 12 {
            assert!(
                decode(&whole[..length]).is_err(),
                "{length} bytes of {}",
                whole.len()
            );
        }
        assert!(write(Path::new("never-written.png"), 8, 8, &[0; 191]).is_err());
        assert!(!Path::new("never-written.png").exists());
    }
}
