use std::process::Command;

use super::super::error::{ImageError, MOST_TEXTURE_BYTES};
use super::super::picture::{Attribute, Layer, Picture, REC709};
use super::{decode, decode_within, encode, read, spectral_attributes, write};
use crate::spectrum::recorded::spectral_channel_name;

fn bits(seed: u64) -> u64 {
    let bits = (seed ^ (seed >> 31)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    (bits ^ (bits >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9) ^ bits
}

/// Layers and attributes of every kind, in the order of their names; values of every kind, NaN with
/// a payload included.
fn picture() -> Picture {
    let (width, height) = (37, 21);
    let layer = |name: &str, seed: u64| {
        let mut data: Vec<_> = (0..width * height)
            .map(|i| f32::from_bits(bits(u64::from(i) ^ seed) as u32))
            .collect();
        data[..4].copy_from_slice(&[
            f32::INFINITY,
            -0.0,
            f32::from_bits(0x7fc1_2345),
            f32::MIN_POSITIVE / 4.0,
        ]);
        Layer::new(name, data)
    };
    let mut attributes = vec![
        ("chromaticities".to_owned(), REC709),
        ("laminaSeed".to_owned(), Attribute::Int(-7)),
        ("laminaSpp".to_owned(), Attribute::Double(1e300)),
        (
            "scene".to_owned(),
            Attribute::Text("format = 1 # Blätter\n".repeat(5000)),
        ),
        (
            "software".to_owned(),
            Attribute::Text("lamina 0.1.0".to_owned()),
        ),
        ("whiteLuminance".to_owned(), Attribute::Float(80.0)),
        (
            "worldToCamera".to_owned(),
            Attribute::Matrix4(
                [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15].map(|i: u8| f32::from(i)),
            ),
        ),
        ("worldToNDC".to_owned(), Attribute::Matrix4([0.5; 16])),
    ];
    attributes.extend(spectral_attributes());
    attributes.sort_by(|a, b| a.0.cmp(&b.0));
    let mut layers = vec![
        layer("A", 1),
        layer("B", 2),
        layer("G", 3),
        layer("R", 4),
        layer(&spectral_channel_name(550.0), 5),
        layer("a layer with a name far longer than thirty-one bytes.R", 6),
        layer("albedo.R", 7),
    ];
    layers.sort_by(|a, b| a.name.cmp(&b.name));
    Picture {
        width,
        height,
        layers,
        attributes,
    }
}

fn data_bits(picture: &Picture) -> Vec<(String, Vec<u32>)> {
    let bits = |layer: &Layer| layer.data.iter().map(|value| value.to_bits()).collect();
    picture
        .layers
        .iter()
        .map(|layer| (layer.name.clone(), bits(layer)))
        .collect()
}

#[test]
fn a_picture_comes_back_bit_for_bit() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("picture.exr");
    let picture = picture();
    write(&picture, &path).expect("the folder can be written");
    let back = read(&path).expect("it was just written");
    assert_eq!((back.width, back.height), (picture.width, picture.height));
    assert_eq!(data_bits(&back), data_bits(&picture));
    assert_eq!(back.attributes, picture.attributes);
}

#[test]
fn the_same_picture_gives_the_same_bytes_in_any_order_and_any_process() {
    let mut picture = picture();
    let bytes = encode(&picture).expect("the picture is sound");
    picture.layers.reverse();
    picture.attributes.reverse();
    assert_eq!(encode(&picture).expect("the picture is sound"), bytes);
    // The seed of the hash that orders attributes is drawn once per process, so a child process has
    // another one.
    let checksum = bytes
        .iter()
        .fold(0, |sum, &byte| bits(sum ^ u64::from(byte)));
    assert!(
        std::env::var_os("LAMINA_TEST_CHECKSUM").is_none(),
        "checksum {checksum}"
    );
    let child = Command::new(std::env::current_exe().expect("this program has a path"))
        .args(["the_same_picture_gives_the_same_bytes", "--nocapture"])
        .env("LAMINA_TEST_CHECKSUM", "1")
        .output()
        .expect("this program can be started");
    let said = String::from_utf8_lossy(&child.stderr);
    assert!(said.contains(&format!("checksum {checksum}")), "{said}");
}

#[test]
fn half_floats_whole_numbers_and_tiles_are_read() {
    use exr::prelude::*;

    let halves = (0..35_u8)
        .map(|i| f16::from_f32(f32::from(i) / 8.0))
        .collect();
    let channels = [
        AnyChannel::new("H", FlatSamples::F16(halves)),
        AnyChannel::new("I", FlatSamples::U32((0..35).collect())),
    ];
    let encoding = Encoding {
        compression: Compression::PIZ,
        blocks: Blocks::Tiles(Vec2(4, 4)),
        line_order: LineOrder::Increasing,
    };
    let channels = AnyChannels::sort(channels.into_iter().collect());
    let layer = exr::image::Layer::new(
        Vec2(7, 5),
        LayerAttributes::named("part"),
        encoding,
        channels,
    );
    let mut bytes = std::io::Cursor::new(Vec::new());
    Image::from_layer(layer)
        .write()
        .to_buffered(&mut bytes)
        .expect("memory can be written");
    let picture = decode(bytes.get_ref()).expect("the file is whole");
    assert_eq!((picture.width, picture.height), (7, 5));
    let expected: Vec<f32> = (0..35_u8).map(f32::from).collect();
    assert_eq!(picture.layer("I").map(|layer| &layer.data), Some(&expected));
    let eighths: Vec<f32> = expected.iter().map(|value| value / 8.0).collect();
    assert_eq!(picture.layer("H").map(|layer| &layer.data), Some(&eighths));
}

#[test]
fn spectral_channels_are_named_as_the_layout_says() {
    assert_eq!(spectral_channel_name(550.0), "S0.550,000000nm");
    assert_eq!(spectral_channel_name(1234.5), "S0.1234,500000nm");
}

#[test]
fn contradictions_are_refused() {
    let edit = |change: &dyn Fn(&mut Picture)| {
        let mut picture = picture();
        change(&mut picture);
        encode(&picture)
            .map(|_| ())
            .expect_err("this contradicts itself")
            .to_string()
    };
    let again = |picture: &mut Picture| picture.layers[1].name = picture.layers[0].name.clone();
    for (message, word) in [
        (
            edit(&|picture| picture.layers[2].data.truncate(5)),
            "5 values",
        ),
        (edit(&again), "twice"),
        (edit(&|picture| picture.layers[0].name.clear()), "1 to 255"),
        (
            edit(&|picture| picture.layers[0].name = "x".repeat(256)),
            "1 to 255",
        ),
        (edit(&|picture| picture.layers.clear()), "0 channels"),
        (
            edit(&|picture| picture.attributes[0].0 = "dataWindow".to_owned()),
            "dataWindow",
        ),
        (
            edit(&|picture| picture.attributes[1].0 = picture.attributes[0].0.clone()),
            "twice",
        ),
    ] {
        assert!(message.contains(word), "{message:?} does not say {word:?}");
    }
}

#[test]
fn a_failing_write_keeps_the_old_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("picture.exr");
    write(&picture(), &path).expect("the folder can be written");
    let before = std::fs::read(&path).expect("it is there");
    let mut broken = picture();
    broken.layers[0].data.pop();
    assert!(write(&broken, &path).is_err());
    assert_eq!(std::fs::read(&path).expect("it is there"), before);
    let error = read(&folder.path().join("missing.exr"))
        .map(|_| ())
        .expect_err("there is no such file");
    assert!(error.to_string().contains("missing.exr"), "{error}");
}

/// A small file with the size in its windows changed.
fn claiming(width: i32, height: i32) -> Vec<u8> {
    let mut bytes = encode(&picture()).expect("the picture is sound");
    for window in [&b"dataWindow\0box2i\0"[..], b"displayWindow\0box2i\0"] {
        let at = bytes
            .windows(window.len())
            .position(|part| part == window)
            .expect("it is in every file");
        let max = at + window.len() + 4 + 8;
        bytes[max..max + 4].copy_from_slice(&(width - 1).to_le_bytes());
        bytes[max + 4..max + 8].copy_from_slice(&(height - 1).to_le_bytes());
    }
    // The number of blocks must agree, or the file would be refused for that reason.
    let count = b"chunkCount\0int\0";
    if let Some(at) = bytes.windows(count.len()).position(|part| part == count) {
        let at = at + count.len() + 4;
        bytes[at..at + 4].copy_from_slice(&((height + 15) / 16).to_le_bytes());
    }
    bytes
}

#[test]
fn a_header_that_claims_too_much_is_refused_unread() {
    for (width, height) in [
        (60_000, 60_000),
        (2_000_000_000, 2_000_000_000),
        (16_384, 16_384),
    ] {
        let error = decode(&claiming(width, height))
            .map(|_| ())
            .expect_err("nobody wants that");
        assert!(
            matches!(
                error,
                ImageError::TooLarge { .. } | ImageError::Malformed { .. }
            ),
            "{error}"
        );
        // 2²⁸ pixels of seven channels are within the pixels but beyond the bytes.
        assert!(
            width > 60_000 || error.to_string().contains(&width.to_string()),
            "{error}"
        );
    }
}

#[test]
fn a_texture_may_take_less_memory_than_a_picture() {
    // 9,000² pixels of seven channels are 2.3 GB.
    let bytes = claiming(9_000, 9_000);
    let refused = decode_within(&bytes, MOST_TEXTURE_BYTES).map(|_| ());
    assert!(matches!(
        refused,
        Err(ImageError::TooLarge { width: 9_000, .. })
    ));
}

#[test]
fn damaged_files_give_a_picture_or_an_error() {
    let mut small = picture();
    small.attributes.retain(|(name, _)| name != "scene");
    let whole = encode(&small).expect("the picture is sound");
    let (mut read, mut refused) = (0, 0);
    for seed in 0..2000_u64 {
        let mut bytes = whole.clone();
        for change in 0..=seed % 4 {
            let bits = bits(seed << 8 | change);
            // Half of the changes are in the header, where they have the most effect.
            let range = if bits & 1 == 0 {
                bytes.len()
            } else {
                bytes.len().min(1200)
            };
            let at = (bits >> 8) as usize % range;
            match bits >> 1 & 3 {
                0 => bytes[at] = (bits >> 40) as u8,
                1 => bytes[at] ^= 1 << (bits >> 40 & 7),
                2 if bits >> 50 & 7 < 2 => bytes.truncate(at.max(1)),
                _ => bytes[at] = [0, 255, 127, 128][(bits >> 40 & 3) as usize],
            }
        }
        match decode(&bytes) {
            Ok(_) => read += 1,
            Err(_) => refused += 1,
        }
    }
    assert!(
        read > 100 && refused > 500,
        "{read} read, {refused} refused"
    );
}

#[test]
fn pictures_compressed_by_dwaa_and_dwab_are_read() {
    // Written by OpenImageIO 3.2 as halves, 40 × 24 pixels.
    for bytes in [
        &include_bytes!("dwaa.exr")[..],
        &include_bytes!("dwab.exr")[..],
    ] {
        let picture = decode(bytes).expect("it is a picture");
        assert_eq!((picture.width, picture.height), (40, 24));
        for (name, first, across, down) in [
            ("R", 1.0, 0.02, 0.0),
            ("G", 0.5, 0.0, 0.01),
            ("B", 2.0, -0.03, 0.02),
        ] {
            let layer = picture.layer(name).expect("it has three channels");
            for (place, value) in layer.data.iter().enumerate() {
                let (x, y) = ((place % 40) as f32, (place / 40) as f32);
                let expected = first + across * x + down * y;
                // OpenImageIO reads its own file as far off.
                assert!((value - expected).abs() < 0.008, "{name} {x} {y}: {value}");
            }
        }
    }
}

#[test]
fn a_compression_that_is_not_read_is_reported_with_what_to_do() {
    let mut bytes = include_bytes!("dwaa.exr").to_vec();
    let name = b"compression\0compression\0";
    let at = bytes.windows(name.len()).position(|window| window == name);
    // Behind the name come four bytes of size, then the kind.
    let kind = at.expect("each file tells its compression") + name.len() + 4;
    assert_eq!(bytes[kind], 8, "DWAA");
    bytes[kind] = 10;
    let error = decode(&bytes).expect_err("HTJ2K is not read").to_string();
    assert!(
        error.contains("HTJ2K") && error.contains("oiiotool"),
        "{error}"
    );
}

/// A file of parts with these names, positions and sizes, in a display window; channels R, G and B
/// hold 1, 2, 3, … row by row.
fn parts(window: [i32; 4], parts: &[(&str, [i32; 2], [usize; 2])]) -> Vec<u8> {
    use exr::prelude::*;

    let [left, top, width, height] = window;
    let layers = parts.iter().map(|(name, [x, y], [across, down])| {
        let channel = |name: &str| {
            let values = (1..=across * down).map(|value| value as f32);
            AnyChannel::new(name, FlatSamples::F32(values.collect()))
        };
        let channels = ["R", "G", "B"].map(channel);
        let attributes = LayerAttributes {
            layer_position: Vec2(*x, *y),
            ..LayerAttributes::named(*name)
        };
        let channels = AnyChannels::sort(channels.into_iter().collect());
        exr::image::Layer::new(
            (*across, *down),
            attributes,
            Encoding::UNCOMPRESSED,
            channels,
        )
    });
    let window = IntegerBounds::new((left, top), (width as usize, height as usize));
    let image = Image::from_layers(ImageAttributes::new(window), layers.collect::<Vec<_>>());
    let mut bytes = std::io::Cursor::new(Vec::new());
    let written = image.write().to_buffered(&mut bytes);
    written.expect("memory can be written");
    bytes.into_inner()
}

#[test]
fn a_picture_is_the_display_window_black_outside_of_the_data_window() {
    let shown = |window, position, size| {
        let picture = decode(&parts(window, &[("", position, size)])).expect("a picture");
        let red = picture.layer("R").expect("colours").data.clone();
        assert_eq!(picture.layer("B").expect("colours").data, red);
        (picture.width, picture.height, red)
    };
    // Cropped.
    assert_eq!(
        shown([0, 0, 4, 3], [1, 1], [2, 1]),
        (4, 3, vec![0., 0., 0., 0., 0., 1., 2., 0., 0., 0., 0., 0.])
    );
    // More than is shown on each side, and windows that do not begin at 0.
    assert_eq!(shown([0, 0, 2, 1], [-1, -1], [4, 3]), (2, 1, vec![6., 7.]));
    assert_eq!(
        shown([10, 20, 2, 2], [9, 21], [2, 5]),
        (2, 2, vec![0., 0., 2., 0.])
    );
    // Beside each other.
    assert_eq!(shown([0, 0, 2, 1], [5, 5], [2, 2]), (2, 1, vec![0., 0.]));
    assert_eq!(shown([0, 0, 2, 1], [-5, 0], [2, 2]), (2, 1, vec![0., 0.]));
    let far = shown([0, 0, 2, 1], [1_000_000_000, -1_000_000_000], [2, 1]);
    assert_eq!(far, (2, 1, vec![0., 0.]));
}

#[test]
fn a_display_window_that_claims_too_much_is_refused_unread() {
    let bytes = parts([0, 0, 60_000, 60_000], &[("", [0, 0], [1, 1])]);
    let refused = decode(&bytes).map(|_| ()).expect_err("nobody wants that");
    assert!(
        matches!(refused, ImageError::TooLarge { width: 60_000, .. }),
        "{refused}"
    );
    assert!(decode(&parts([0, 0, 2048, 1024], &[("", [0, 0], [1, 1])])).is_ok());
    let bytes = parts([0, 0, 8192, 4096], &[("", [0, 0], [1, 1])]);
    let refused = decode(&bytes).map(|_| ()).expect_err("a pixel of as many");
    assert!(
        refused
            .to_string()
            .contains("display window of 8192 × 4096"),
        "{refused}"
    );
}

#[test]
fn further_parts_are_layers_of_their_names() {
    let bytes = parts(
        [0, 0, 2, 1],
        &[("beauty", [0, 0], [2, 1]), ("sky", [1, 0], [1, 1])],
    );
    let picture = decode(&bytes).expect("a picture");
    let names: Vec<_> = picture
        .layers
        .iter()
        .map(|layer| layer.name.as_str())
        .collect();
    assert_eq!(names, ["B", "G", "R", "sky.B", "sky.G", "sky.R"]);
    assert_eq!(picture.layer("sky.R").expect("a part").data, [0.0, 1.0]);
    for (part, green) in [("beauty", [1.0, 2.0]), ("sky", [0.0, 1.0])] {
        let picture = super::super::colours::decode(&bytes, Some(part)).expect("a layer");
        assert_eq!(picture.layer("G").expect("colours").data, green);
    }
}
