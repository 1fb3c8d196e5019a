use super::image::Pixels;
use super::*;

fn about_z(image: ControlImage) -> CylinderControl {
    CylinderControl {
        from: DVec3::ZERO,
        to: DVec3::Z * 10.0,
        radius_mm: Some(5.0),
        image,
        steers: Steered::Blocked,
    }
}

#[test]
fn angle_and_height_say_where_in_the_picture_a_point_lies() {
    let picture = ControlImage::Picture(Pixels {
        file: String::new(),
        width: 4,
        values: vec![0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7],
    });
    let control = about_z(picture);
    // The middle of the first pixel lies an eighth of a turn from +x; the first row is the upper
    // one.
    let at = |eighths: f64, height: f64| {
        let angle = eighths * TAU / 8.0;
        control.value(DVec3::new(
            2.0 * libm::cos(angle),
            2.0 * libm::sin(angle),
            height,
        ))
    };
    for (eighths, height, expected) in [
        (1.0, 9.0, 0.0),
        (3.0, 9.0, 0.1),
        (7.0, 9.0, 0.3),
        (1.0, 1.0, 0.4),
        (5.0, 1.0, 0.6),
    ] {
        let value = at(eighths, height).expect("inside");
        assert!(
            (value - expected).abs() < 1e-12,
            "{value} is not {expected}"
        );
    }
    // Joined at angle 0, blended between rows.
    assert!((at(0.0, 9.0).expect("inside") - 0.15).abs() < 1e-12);
    assert!((at(1.0, 5.0).expect("inside") - 0.2).abs() < 1e-12);
    assert_eq!(at(1.0, 10.5), None);
    assert_eq!(control.value(DVec3::new(5.1, 0.0, 5.0)), None);
}

#[test]
fn stripes_are_as_many_and_as_wide_as_asked_for_however_they_wander() {
    for (waviness, bends) in [(0.0, 0.0), (0.2, 5.0)] {
        let image = ControlImage::Stripes {
            count: 7,
            share: 0.4,
            waviness,
            bends,
            seed: 3,
        };
        image.validate().expect("good");
        for height in [0.0, 0.31, 0.77, 1.0] {
            let n = 7000;
            let values: Vec<f64> = (0..n)
                .map(|i| image.value(f64::from(i) / f64::from(n), height))
                .collect();
            let rises = (0..values.len())
                .filter(|&i| values[i] > values[(i + values.len() - 1) % values.len()]);
            assert_eq!(rises.count(), 7);
            let white: f64 = values.iter().sum::<f64>() / f64::from(n);
            assert!((white - 0.4).abs() < 0.002, "{white}");
        }
    }
    let rings = ControlImage::Rings {
        count: 3,
        share: 0.5,
    };
    assert_eq!(
        [0.1, 0.17, 0.3, 0.5].map(|height| rings.value(0.2, height)),
        [1.0, 1.0, 0.0, 1.0]
    );
}

#[test]
fn noise_is_joined_at_its_edges_and_cut_at_its_threshold() {
    let grey = ControlImage::Noise {
        around: 6,
        octaves: 3,
        threshold: None,
        seed: 1,
    };
    let cut = ControlImage::Noise {
        around: 6,
        octaves: 3,
        threshold: Some(0.5),
        seed: 1,
    };
    let (mut least, mut most) = (1.0_f64, 0.0_f64);
    for i in 0..500 {
        let height = f64::from(i) / 500.0;
        assert!((grey.value(0.0, height) - grey.value(1.0 - 1e-12, height)).abs() < 1e-6);
        let turn = (f64::from(i) * 0.377).fract();
        let value = grey.value(turn, height);
        (least, most) = (least.min(value), most.max(value));
        assert_eq!(cut.value(turn, height), f64::from(u8::from(value > 0.5)));
    }
    assert!(
        (0.0..0.35).contains(&least) && (0.65..1.0).contains(&most),
        "{least} to {most}"
    );
}

#[test]
fn what_a_control_has_wrong_is_named() {
    let refused = |control: CylinderControl| control.validate(2).expect_err("wrong").to_string();
    let good = || about_z(ControlImage::Constant(1.0));
    assert_eq!(
        refused(CylinderControl {
            to: DVec3::ZERO,
            ..good()
        }),
        "the axis runs from [0, 0, 0] mm to [0, 0, 0] mm; it needs two places, finite and apart"
    );
    assert_eq!(
        refused(CylinderControl {
            steers: Steered::InitialType(2),
            ..good()
        }),
        "it steers type 2, but there are 2 types (from 0)"
    );
    assert_eq!(
        refused(about_z(ControlImage::Picture(Pixels {
            file: String::new(),
            width: 3,
            values: vec![0.5; 5]
        }))),
        "its picture of 3 pixels across has 5 values"
    );
    assert_eq!(
        refused(about_z(ControlImage::Constant(2.0))),
        "constant is 2, outside 0 to 1"
    );
}

#[test]
fn the_other_types_share_what_the_image_leaves() {
    let controls = [CylinderControl {
        steers: Steered::InitialType(1),
        ..about_z(ControlImage::Constant(0.6))
    }];
    let mut probabilities = [0.6, 0.2, 0.2];
    Controls(&controls).initial(DVec3::new(1.0, 0.0, 5.0), &mut probabilities);
    for (probability, expected) in probabilities.iter().zip([0.3, 0.6, 0.1]) {
        assert!((probability - expected).abs() < 1e-12);
    }
    let mut outside = [0.6, 0.2, 0.2];
    Controls(&controls).initial(DVec3::new(1.0, 0.0, 50.0), &mut outside);
    assert_eq!(outside, [0.6, 0.2, 0.2]);
}

#[test]
fn adhesion_is_steered_for_its_pair_only() {
    let controls = [CylinderControl {
        steers: Steered::Adhesion {
            pair: [0, 1],
            low: 0.0,
            high: 4.0,
        },
        ..about_z(ControlImage::Constant(0.5))
    }];
    let mut row = [0.5, 0.3];
    Controls(&controls).adhesion(DVec3::new(1.0, 0.0, 5.0), 0, &mut row);
    assert!((row[1] - 0.6).abs() < 1e-12 && row[0] == 0.5);
}
