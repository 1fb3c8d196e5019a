use std::f64::consts::PI;

use super::*;
use crate::mosaic::shapes::sphere;
use crate::mosaic::testing::noise_labels;
use crate::mosaic::voronoi::tests::{scattered, surface};

const STRIPES: u32 = 6;

/// A ball of radius 20 mm with 3000 cells, tessellated, and for each cell whether it lies in one of
/// six upright stripes.
fn striped() -> (Surface, Vec<SurfacePoint>, Voronoi, Vec<u32>) {
    let ball = surface(sphere(20.0, 1.5).expect("good sizes"));
    let sites = scattered(&ball, 3000, 5);
    let labels = sites
        .iter()
        .map(|site| {
            let p = ball.position(site);
            let turn = libm::atan2(p.y, p.x) / (2.0 * PI) + 0.51;
            u32::from((turn * f64::from(STRIPES)).fract() < 0.5)
        })
        .collect();
    let voronoi = Voronoi::new(&ball, &sites);
    (ball, sites, voronoi, labels)
}

#[test]
fn stripes_are_measured_as_they_were_made() {
    let (ball, _, voronoi, labels) = striped();
    let shares = area_shares(&voronoi, &labels, 2);
    assert!((shares[1] - 0.5).abs() < 0.03 && (shares[0] + shares[1] - 1.0).abs() < 1e-12);
    let found = neighbourhood(&voronoi, &labels, 20, 1);
    assert!(
        found.alike > 0.75 && (found.by_chance - 0.5).abs() < 0.02,
        "{found:?}"
    );
    assert!(found.alike > found.by_chance + 10.0 * found.deviation);
    // Twelve half great circles bound stripes of a twelfth of the sphere; frayed by cells they are
    // up to a third longer.
    let exact = 2.0 * 2.0 * PI * 400.0 / (12.0 * PI * 20.0);
    let width = mean_width_mm(&voronoi, &labels, 1);
    assert!(
        width < 1.05 * exact && width > 0.7 * exact,
        "{width} against {exact}"
    );
    let counts: Vec<u32> = [-8.0, -4.0, 0.0, 4.0, 8.0]
        .iter()
        .map(|&height| {
            let points = ring(&ball, height, 360);
            assert_eq!(points.len(), 360);
            assert!(
                points
                    .iter()
                    .all(|p| (ball.position(p).z - height).abs() < 1e-9)
            );
            element_count(&labels_at(&ball, &voronoi, &labels, &points), 1, 12)
        })
        .collect();
    assert_eq!(
        PatternClass::of_counts(&counts),
        PatternClass::Structured { count: STRIPES }
    );
}

#[test]
fn noise_is_unstructured() {
    let (ball, sites, voronoi, _) = striped();
    let places: Vec<_> = sites.iter().map(|site| ball.position(site)).collect();
    let counts: Vec<u32> = (0..4)
        .flat_map(|seed| {
            let labels = noise_labels(10.0, 0.5, &places, seed);
            [-8.0, 0.0, 8.0].map(|height| {
                let points = ring(&ball, height, 360);
                element_count(&labels_at(&ball, &voronoi, &labels, &points), 1, 12)
            })
        })
        .collect();
    assert_eq!(
        PatternClass::of_counts(&counts),
        PatternClass::Unstructured,
        "{counts:?}"
    );
}

#[test]
fn patches_that_a_noise_of_greater_scale_shows_do_not_hold_the_old_ones() {
    let ball = surface(sphere(20.0, 1.5).expect("good sizes"));
    let places: Vec<_> = ball
        .probes(4000, 1)
        .iter()
        .map(|point| ball.position(point))
        .collect();
    let marked = |scale_mm, share| noise_labels(scale_mm, share, &places, 3);
    let (young, old) = (marked(4.0, 0.3), marked(8.0, 0.6));
    // Independent patterns would keep 0.6 of the old area.
    assert!(
        contained(&young, &old, 1) < 0.75,
        "{}",
        contained(&young, &old, 1)
    );
    assert!(kappa(&young, &old).abs() < 0.2);
    assert!((kappa(&old, &old) - 1.0).abs() < 1e-9);
    assert_eq!(contained(&old, &old, 1), 1.0);
    assert!((kappa(&[0, 0, 1, 1], &[0, 1, 0, 1])).abs() < 1e-12);
}

#[test]
fn patches_partition_cells_and_areas() {
    let (ball, _, voronoi, labels) = striped();
    let found = patches(&voronoi, &labels);
    assert_eq!(found.iter().map(|patch| patch.cells).sum::<usize>(), 3000);
    let area: f64 = found.iter().map(|patch| patch.area_mm2).sum();
    assert!((area / ball.total_area() - 1.0).abs() < 1e-9);
    let whole = patches(&voronoi, &vec![4; 3000]);
    assert_eq!((whole.len(), whole[0].label, whole[0].cells), (1, 4, 3000));
    assert_eq!(contiguity(&voronoi, &vec![4; 3000]), 1.0);
    let alone: Vec<u32> = (0..3000).collect();
    assert_eq!(contiguity(&voronoi, &alone), 1.0, "no clone has two cells");
    let far = contiguity(
        &voronoi,
        &alone.iter().map(|cell| cell % 1500).collect::<Vec<_>>(),
    );
    assert!(far < 0.05, "two random cells are seldom neighbours: {far}");
}

#[test]
fn specks_and_gaps_are_no_elements() {
    let ring = [1, 1, 1, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
    assert_eq!(element_count(&ring, 1, 3), 1);
    assert_eq!(element_count(&ring, 1, 1), 3);
    assert_eq!(element_count(&[1, 1, 1], 1, 2), 1);
    assert_eq!(element_count(&[0, 0, 0], 1, 2), 0);
    assert_eq!(
        PatternClass::of_counts(&[7, 7, 7, 8]),
        PatternClass::Structured { count: 7 }
    );
    assert_eq!(
        PatternClass::of_counts(&[7, 8, 9, 7]),
        PatternClass::Unstructured
    );
    assert_eq!(PatternClass::of_counts(&[0, 0]), PatternClass::Unstructured);
}
