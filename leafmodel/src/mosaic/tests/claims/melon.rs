//! Figs. 10 to 12: watermelons, whose stripes start from a striped image around the fruit.

use std::f64::consts::TAU;

use glam::DVec3;

use super::super::statistics::{PatternClass, element_count, mean_width_mm, ring};
use super::{FOREGROUND, Row, Seen, grown, surface};
use crate::mosaic::shapes::{rounded_cube, sphere};
use crate::mosaic::{ControlImage, CylinderControl, MosaicPlan, Steered, Surface};

/// Figs. 10 and 11; Fig. 12 has `w_r` of 1, 2 and 3.
const MELON: Row = Row {
    cells: 10_000,
    days: 20.0,
    radius_weight: 0.5,
    adhesion: [0.5, 0.9],
    division: [5.0, 10.0],
    foreground: 0.3,
    switching: 0.0,
};

/// Number of stripes of the image, and their share of it.
const STRIPES: u32 = 11;
const SHARE: f64 = 0.2;

/// mm.
const RADIUS: f64 = 115.0;
const HEIGHTS: [f64; 5] = [-50.0, -25.0, 0.0, 25.0, 50.0];

fn striped(radius_weight: f64) -> MosaicPlan {
    let row = Row {
        radius_weight,
        ..MELON
    };
    MosaicPlan {
        controls: vec![CylinderControl {
            from: DVec3::Z * -120.0,
            to: DVec3::Z * 120.0,
            radius_mm: None,
            image: ControlImage::Stripes {
                count: STRIPES,
                share: SHARE,
                waviness: 0.0,
                bends: 0.0,
                seed: 1,
            },
            steers: Steered::InitialType(0),
        }],
        ..row.plan()
    }
}

/// Foreground around the body at each height: the number of stripes and their share of the girth.
fn around(body: &Surface, seen: &Seen) -> (Vec<u32>, Vec<f64>) {
    let at = HEIGHTS.map(|height| seen.at(body, &ring(body, height, 1440)));
    let counts = at.iter().map(|round| element_count(round, FOREGROUND, 12));
    let share = |round: &Vec<u32>| round.iter().sum::<u32>() as f64 / round.len() as f64;
    (counts.collect(), at.iter().map(share).collect())
}

#[test]
#[ignore = "deep: 8 s"]
fn round_and_square_watermelons_have_the_stripes_of_their_image() {
    let ball = surface(sphere(RADIUS, 3.0).expect("good sizes"));
    let cube = surface(rounded_cube(190.0, 34.0, 3.0).expect("good sizes"));
    let structured = PatternClass::Structured { count: STRIPES };
    for (name, body) in [("ball", &ball), ("cube", &cube)] {
        for seed in [1, 2] {
            let melon = grown(body, &striped(0.5), seed);
            let counts = around(body, &melon).0;
            let class = PatternClass::of_counts(&counts);
            assert_eq!(class, structured, "{name}, seed {seed}: {counts:?}");
        }
    }
}

#[test]
#[ignore = "deep: 12 s"]
fn a_greater_radius_gives_broader_stripes_of_as_many_cells() {
    let ball = surface(sphere(RADIUS, 3.0).expect("good sizes"));
    let melons: Vec<Seen> = [1.0, 2.0, 3.0]
        .iter()
        .map(|&weight| grown(&ball, &striped(weight), 1))
        .collect();
    let (mut breadths, mut frays, mut cells) = (Vec::new(), Vec::new(), Vec::new());
    for melon in &melons {
        let (counts, shares) = around(&ball, melon);
        let class = PatternClass::of_counts(&counts);
        assert_eq!(class, PatternClass::Structured { count: STRIPES });
        // Width of a stripe, on average over the heights.
        let across = shares.iter().zip(HEIGHTS).map(|(share, height)| {
            let round = TAU * (RADIUS * RADIUS - height * height).sqrt();
            share * round / f64::from(STRIPES)
        });
        let breadth = across.sum::<f64>() / HEIGHTS.len() as f64;
        breadths.push(breadth);
        // Area over half of the border is smaller than the width by the factor by which frayed
        // edges are longer than straight ones.
        frays.push(breadth / mean_width_mm(&melon.voronoi, &melon.kinds, FOREGROUND));
        cells.push(
            melon
                .kinds
                .iter()
                .filter(|kind| **kind == FOREGROUND)
                .count(),
        );
    }
    // The number of cells does not depend on the radius, and the image sets the number of stripes.
    // So a stripe broadens because its cells take more room from the others, and the share of the
    // foreground rises in proportion.
    assert!(cells[0] == cells[1] && cells[1] == cells[2], "{cells:?}");
    let rises = |list: &[f64]| list.windows(2).all(|two| two[0] < two[1]);
    let shares: Vec<f64> = melons.iter().map(Seen::share).collect();
    assert!(
        rises(&breadths) && breadths[2] > 1.5 * breadths[0],
        "{breadths:?} mm"
    );
    assert!(rises(&shares), "{shares:?}");
    // Edges become smoother too.
    frays.reverse();
    assert!(rises(&frays), "{frays:?}");
}
