use super::super::picture::{Attribute, Layer};
use super::*;
use crate::image::tone::from_srgb;
use crate::spectrum::cie::{srgb_from_xyz, xyz_of};
use crate::spectrum::planck;

fn picture(width: u32, layers: &[(&str, &[f32])]) -> Picture {
    Picture::new(
        [width, layers[0].1.len() as u32 / width],
        layers
            .iter()
            .map(|(name, data)| Layer::new(*name, data.to_vec())),
    )
}

#[test]
fn one_stop_is_a_factor_of_two() {
    let grey = [0.1, 0.3, 0.45];
    let double = grey.map(|value| 2.0 * value);
    let once = picture(3, &[("R", &grey), ("G", &grey), ("B", &grey)]);
    let twice = picture(3, &[("R", &double), ("G", &double), ("B", &double)]);
    for tone in [Tone::Agx, Tone::Standard, Tone::Filmic, Tone::Linear] {
        let show = |exposure_ev, picture| {
            let display = Display {
                exposure_ev,
                tone,
                ..Display::default()
            };
            display.pixels(picture).expect("it has colours").values
        };
        assert_eq!(show(1.0, &once), show(0.0, &twice), "{tone:?}");
        assert_eq!(show(0.0, &once), show(-1.0, &twice), "{tone:?}");
    }
}

#[test]
fn the_meter_brings_any_light_to_middle_grey_and_stops_are_added() {
    let dim = [0.001, 0.004, 0.0, f32::NAN];
    let grey = picture(4, &[("R", &dim), ("G", &dim), ("B", &dim)]);
    let metered = |exposure_ev| {
        let display = Display {
            exposure_ev,
            auto_exposure: true,
            tone: Tone::Linear,
            depth: Depth::Sixteen,
            ..Display::default()
        };
        let values = display.pixels(&grey).expect("it has colours").values;
        from_srgb(f64::from(values[0]) / 65535.0)
    };
    // The geometric mean is 0.002.
    assert!((metered(0.0) - 0.09).abs() < 1e-4, "{}", metered(0.0));
    assert!((metered(1.0) - 0.18).abs() < 1e-4, "{}", metered(1.0));
    let black = picture(1, &[("R", &[0.0]), ("G", &[0.0]), ("B", &[0.0])]);
    let auto = Display {
        auto_exposure: true,
        ..Display::default()
    };
    assert_eq!(auto.pixels(&black).expect("it has colours").values, [0; 3]);
}

#[test]
fn a_grey_card_comes_out_grey_at_the_same_light_as_any_other() {
    // A card that fills the lower two rows, below a sky that is not to count.
    let card = [0.05_f32, 0.03, 0.01];
    let layers: Vec<(&str, Vec<f32>)> = ["R", "G", "B"]
        .into_iter()
        .zip(card)
        .map(|(name, value)| (name, [vec![3.0; 2], vec![value; 4]].concat()))
        .chain([("id.object", vec![0.0, 0.0, 1.0, 1.0, 1.0, 1.0])])
        .collect();
    let layers: Vec<(&str, &[f32])> = layers
        .iter()
        .map(|(name, data)| (*name, data.as_slice()))
        .collect();
    let mut picture = picture(2, &layers);
    let names = Attribute::Text("1 card".to_owned());
    picture.attributes = vec![("lamina:objects".to_owned(), names)];
    let display = Display {
        white_object: Some("card".to_owned()),
        grey_object: Some("card".to_owned()),
        tone: Tone::Linear,
        depth: Depth::Sixteen,
        ..Display::default()
    };
    let pixels = display.pixels(&picture).expect("it shows the card");
    for value in &pixels.values[6..] {
        let linear = from_srgb(f64::from(*value) / 65535.0);
        assert!((linear - 0.18).abs() < 1e-3, "{linear}");
    }
    let other = Display {
        grey_object: Some("leaf".to_owned()),
        ..Display::default()
    };
    let error = other.pixels(&picture).expect_err("there is no leaf");
    assert!(error.to_string().contains("`leaf`"), "{error}");
}

#[test]
fn a_white_that_is_set_makes_its_light_grey() {
    // Light of 3000 K, as linear sRGB.
    let [x, y, z] = xyz_of(|nm| planck::radiance(nm, 3000.0));
    let warm = srgb_from_xyz([0.5 * x / y, 0.5, 0.5 * z / y]).map(|value| [value as f32]);
    let lamp = picture(1, &[("R", &warm[0]), ("G", &warm[1]), ("B", &warm[2])]);
    let show = |white| {
        let display = Display {
            white,
            tone: Tone::Linear,
            ..Display::default()
        };
        display.pixels(&lamp).expect("it has colours").values
    };
    let [red, green, blue] = show(White::Kelvin(3000.0))[..] else {
        panic!("three channels");
    };
    assert!(
        red.abs_diff(green) <= 1 && green.abs_diff(blue) <= 1,
        "{red} {green} {blue}"
    );
    let seen = show(White::D65);
    assert!(seen[0] > seen[1] + 20 && seen[1] > seen[2] + 20, "{seen:?}");
}

#[test]
fn an_edge_before_a_bright_sky_has_the_leafs_own_colour() {
    // Sky of 4, a leaf of 0.5, and pixels of both between them.
    let alpha = [0.0, 0.25, 0.75, 1.0, 1.0];
    let seen = alpha.map(|share| 0.5 * share + 4.0 * (1.0 - share));
    let picture = picture(
        5,
        &[("R", &seen), ("G", &seen), ("B", &seen), ("A", &alpha)],
    );
    let display = Display {
        tone: Tone::Linear,
        depth: Depth::Sixteen,
        alpha: true,
        ..Display::default()
    };
    let pixels = display.pixels(&picture).expect("it has alpha");
    assert_eq!((pixels.channels, pixels.values.len()), (4, 20));
    let leaf = pixels.values[16];
    for (pixel, share) in pixels.values.chunks(4).zip(alpha) {
        assert_eq!(pixel[3], (f64::from(share) * 65535.0).round() as u16);
        let expected = if share > 0.0 { leaf } else { 0 };
        assert!(pixel[0].abs_diff(expected) <= 1, "{pixel:?} at {share}");
    }
}

#[test]
fn bands_stand_for_what_lies_around_them_and_infrared_is_grey() {
    let one = [1.0];
    let bands = |names: &[&str]| {
        let layers: Vec<(&str, &[f32])> = names.iter().map(|name| (*name, &one[..])).collect();
        colours(&picture(1, &layers)).expect("it has bands")[0]
    };
    let all = bands(&["S0.450,000000nm", "S0.550,000000nm", "S0.650,000000nm"]);
    let green = bands(&["S0.550,000000nm"]);
    // Any one band alone stands for all wavelengths.
    for (one, other) in all.into_iter().zip(green) {
        assert!((one - other).abs() < 1e-4, "{all:?} {green:?}");
    }
    assert_eq!(bands(&["S0.900,000000nm", "S0.1600,000000nm"]), [1.0; 3]);
    assert_eq!(bands(&["S0.725,000000nm", "S0.875,000000nm"]), [1.0; 3]);
}

#[test]
fn what_cannot_be_shown_is_refused() {
    let depth = picture(1, &[("depth.Z", &[0.5])]);
    assert!(Display::default().pixels(&depth).is_err());
    let mut colour = picture(1, &[("R", &[0.5]), ("G", &[0.5]), ("B", &[0.5])]);
    let with_alpha = Display {
        alpha: true,
        ..Display::default()
    };
    assert!(with_alpha.pixels(&colour).is_err());
    assert!(with_alpha.check(FileKind::Jpeg).is_err());
    let primaries = Attribute::Chromaticities([[0.3; 2]; 4]);
    colour.attributes = vec![("chromaticities".to_owned(), primaries)];
    assert!(Display::default().pixels(&colour).is_err());
}
