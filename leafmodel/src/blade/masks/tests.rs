use super::*;
use crate::venation::network::VeinSegment;

const FRAME: UvFrame = UvFrame {
    min: DVec2::new(-10.0, 0.0),
    size: DVec2::new(20.0, 40.0),
};
const MARGIN: [DVec2; 4] = [
    DVec2::new(-10.0, 0.0),
    DVec2::new(10.0, 0.0),
    DVec2::new(10.0, 40.0),
    DVec2::new(-10.0, 40.0),
];

fn weight(mask: &Mask, x: f64, y: f64) -> f64 {
    let vein = |order, x: f64| VeinSegment {
        from: DVec2::new(x, 0.0),
        to: DVec2::new(x, 40.0),
        radius_from: 0.2,
        radius_to: 0.1,
        order,
    };
    let veins = [vein(1, 0.0), vein(2, 5.0), vein(3, -5.0)];
    let place = Place {
        frame: &FRAME,
        margin: &MARGIN,
        veins: &veins,
        base: DVec2::ZERO,
        apex: DVec2::new(0.0, 40.0),
    };
    assert_eq!(mask.validate(), Ok(()));
    MaskField::new(mask, &place, 7).at(DVec2::new(x, y))
}

#[test]
fn a_rim_lies_along_the_margin_by_millimetres_or_by_half_widths() {
    for width in [RimWidth::Mm(3.0), RimWidth::HalfWidths(0.3)] {
        let rim = Mask::Margin {
            width,
            softness_mm: 1.0,
            wander: 0.0,
            wander_scale_mm: 5.0,
        };
        assert_eq!(weight(&rim, 0.0, 1.0), 1.0);
        assert!((weight(&rim, 7.0, 20.0) - 0.5).abs() < 1e-9);
        assert_eq!(weight(&rim, 0.0, 20.0), 0.0);
    }
}

#[test]
fn veins_of_the_orders_asked_for_count_and_no_others() {
    let veins = |orders, outside| Mask::Veins {
        orders,
        width_mm: 1.0,
        softness_mm: 0.5,
        outside,
    };
    for (orders, at) in [([1, 1], 0.0), ([2, 2], 5.0), ([3, 20], -5.0)] {
        for x in [0.0, 5.0, -5.0] {
            let inside = if x == at { 1.0 } else { 0.0 };
            assert_eq!(weight(&veins(orders, false), x, 20.0), inside);
            assert_eq!(weight(&veins(orders, true), x, 20.0), 1.0 - inside);
        }
    }
    // There are no such veins, so no point is near them.
    assert_eq!(weight(&veins([7, 9], false), 0.0, 20.0), 0.0);
}

#[test]
fn the_midrib_and_the_way_along_it_count_from_the_base() {
    let midrib = Mask::Midrib {
        width_mm: 2.0,
        softness_mm: 0.1,
    };
    assert_eq!(weight(&midrib, 1.0, 10.0), 1.0);
    assert_eq!(weight(&midrib, 3.0, 10.0), 0.0);
    let (up, down) = (
        Mask::BaseToTip { from: 0.0, to: 1.0 },
        Mask::BaseToTip { from: 1.0, to: 0.0 },
    );
    for y in [0.0, 10.0, 20.0, 40.0] {
        let sum = weight(&up, 3.0, y) + weight(&down, 3.0, y);
        assert!((sum - 1.0).abs() < 1e-12);
    }
    assert_eq!(weight(&up, 0.0, 0.0), 0.0);
    assert_eq!(weight(&up, 0.0, 40.0), 1.0);
}

#[test]
fn noise_covers_less_the_higher_its_threshold() {
    let covered = |threshold: f64| {
        let noise = Mask::Noise {
            scale_mm: 2.0,
            threshold,
            softness: 0.2,
            repeat_cells: None,
        };
        (0..200)
            .map(|i| weight(&noise, f64::from(i % 20) - 10.0, f64::from(i / 5)))
            .sum::<f64>()
    };
    let [all, half, none] = [-1.0, 0.0, 1.0].map(covered);
    assert!(all > 190.0 && (60.0..140.0).contains(&half) && none < 10.0);
}

#[test]
fn a_picture_lies_over_the_box_with_row_0_at_the_base() {
    let picture = Picture {
        file: "rim.png".to_owned(),
        channel: None,
        width: 2,
        texels: vec![[0.0], [0.25], [0.5], [3.0]],
    };
    let mask = Mask::Picture(Arc::new(picture));
    assert_eq!(weight(&mask, -10.0, 0.0), 0.0);
    assert_eq!(weight(&mask, 10.0, 0.0), 0.25);
    assert_eq!(weight(&mask, -10.0, 40.0), 0.5);
    assert_eq!(weight(&mask, 10.0, 40.0), 1.0);
    assert_eq!(weight(&mask, 0.0, 0.0), 0.125);
}
