//! Ink is area; colours tell orders and ages.

use leafmodel::venation::network::VeinNode;

use super::*;

/// A square blade of 96 mm, drawn at a hundred pixels with its border: one pixel a millimetre.
fn blade() -> Outline {
    let corners = [(0.0, 0.0), (96.0, 0.0), (96.0, 96.0), (0.0, 96.0)];
    let corners = corners.map(DVec2::from).to_vec();
    Outline::new(corners, DVec2::new(48.0, 0.0), DVec2::new(48.0, 96.0)).expect("a square")
}

fn line(ends: [(f64, f64); 2], pieces: u32, radius: f64) -> VenationNetwork {
    let [a, b] = ends.map(DVec2::from);
    let nodes = (0..=pieces).map(|i| VeinNode {
        position: a + (b - a) * (f64::from(i) / f64::from(pieces)),
        born: i,
    });
    let edges = (0..pieces).map(|i| VeinEdge {
        from: i,
        to: i + 1,
        radius_from: radius,
        radius_to: radius,
        order: 1,
    });
    VenationNetwork::from_parts(nodes.collect(), edges.collect(), 1.0).expect("a line")
}

fn draw(veins: &VenationNetwork, pixels: u32, style: Style) -> Result<Drawing, ImageError> {
    let blade = blade();
    let page = blade.bounds();
    let subject = Subject {
        outlines: std::slice::from_ref(&blade),
        network: veins,
        sources: &[],
    };
    draw_within(page, subject, pixels, style)
}

/// How many pixels the ink of veins would cover.
fn inked(veins: &VenationNetwork, style: Style) -> f64 {
    let bare = line([(40.0, 1.0), (40.0, 2.0)], 1, 1e-9);
    let pixels = (100.0 * 1.04) as u32;
    let without = draw(&bare, pixels, style).expect("small");
    let with = draw(veins, pixels, style).expect("small");
    let paler = without
        .rgb
        .iter()
        .zip(&with.rgb)
        .map(|(a, b)| f64::from(*a) - f64::from(*b));
    let full = match style {
        Style::OnPaper => 238.0 - 60.0 + 243.0 - 90.0 + 226.0 - 42.0,
        Style::Orders | Style::Ages { .. } => 246.0 + 246.0 + 242.0,
    };
    let scale = f64::from(pixels) / (96.0 * 1.04);
    paler.sum::<f64>() / full / (scale * scale)
}

#[test]
fn a_straight_vein_covers_its_length_times_its_width() {
    for style in [Style::OnPaper, Style::Orders] {
        for (width, tolerance) in [(0.2, 0.08), (0.6, 0.05), (2.0, 0.02), (7.3, 0.01)] {
            for ends in [[(10.0, 10.0), (81.0, 33.0)], [(20.0, 11.0), (57.0, 88.0)]] {
                for pieces in [1, 40, 400] {
                    let veins = line(ends, pieces, 0.5 * width);
                    let length = veins.vein_length_mm();
                    // The end is half a disc, if wide enough to be seen.
                    let cap = if width > 1.2 {
                        std::f64::consts::PI * width * width / 8.0
                    } else {
                        0.0
                    };
                    let expected = length * width + cap;
                    let ink = inked(&veins, style);
                    assert!(
                        (ink / expected - 1.0).abs() < tolerance,
                        "{ink} is not {expected}: {width} {pieces}"
                    );
                }
            }
        }
    }
}

#[test]
fn the_apex_is_up_and_the_blade_pale() {
    let veins = line([(48.0, 80.0), (48.0, 90.0)], 3, 4.0);
    let drawing = draw(&veins, 104, Style::OnPaper).expect("small");
    assert_eq!((drawing.width, drawing.height), (104, 104));
    let pixel = |x: usize, y: usize| &drawing.rgb[3 * (104 * y + x)..][..3];
    assert_eq!(pixel(52, 12), [60, 90, 42]);
    assert_eq!(pixel(52, 90), [238, 243, 226]);
    assert_eq!(pixel(0, 0), [255, 255, 255]);
}

#[test]
fn sizes_that_cannot_be_drawn_are_refused() {
    let veins = line([(48.0, 80.0), (48.0, 90.0)], 3, 4.0);
    for pixels in [0, 20_000, 40_000, u32::MAX] {
        assert!(draw(&veins, pixels, Style::Orders).is_err());
    }
    assert!(draw(&veins, 1, Style::Orders).is_ok());
}

#[test]
fn pieces_have_the_colour_of_their_step_and_sources_lie_on_top() {
    // Along the vein each millimetre is a step later.
    let veins = line([(48.0, 2.0), (48.0, 92.0)], 90, 4.0);
    let blade = blade();
    let page = blade.bounds();
    let subject = Subject {
        outlines: std::slice::from_ref(&blade),
        network: &veins,
        sources: &[DVec2::new(48.0, 47.0), DVec2::new(20.0, 20.0)],
    };
    let drawing = draw_within(page, subject, 1040, Style::Ages { last: 90 });
    let drawing = drawing.expect("small");
    let scale = pixels_per_mm(page, 1040);
    let pixel = |x: f64, y: f64| {
        let border = BORDER * 96.0;
        let column = ((x + border) * scale) as usize;
        let row = ((96.0 + border - y) * scale) as usize;
        let start = 3 * (row * drawing.width as usize + column);
        [0, 1, 2].map(|i| drawing.rgb[start + i])
    };
    for y in [10.5, 30.5, 60.5, 85.5] {
        let expected = age_colour((y - 2.0) / 90.0);
        for (found, expected) in pixel(48.0, y).into_iter().zip(expected) {
            assert!(found.abs_diff(expected) <= 4, "{y}: {found} {expected}");
        }
    }
    assert_eq!(pixel(48.0, 47.0), SOURCE_COLOUR);
    assert_eq!(pixel(20.0, 20.0), SOURCE_COLOUR);
    assert_eq!(pixel(20.0, 25.0), [246, 246, 242]);
}
