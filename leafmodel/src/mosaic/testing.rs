//! Surfaces and patterns for tests.

use glam::DVec3;

use super::noise_pattern::NoisePattern;
use super::surface::Surface;

/// A square sheet with edges no longer than `max_edge`.
pub(super) fn square(side: f64, max_edge: f64) -> Surface {
    let corners = [(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)];
    let corners = corners.map(|(x, y)| DVec3::new(x, y, 0.0)).to_vec();
    let sheet = Surface::new(corners, vec![[0, 1, 2], [0, 2, 3]]).expect("a good sheet");
    sheet.subdivided(max_edge).expect("a good length").0
}

/// An octahedron with corners at a distance from the origin.
pub(super) fn octahedron(radius: f64) -> Surface {
    let corners = [
        DVec3::X,
        DVec3::Y,
        DVec3::NEG_X,
        DVec3::NEG_Y,
        DVec3::Z,
        DVec3::NEG_Z,
    ];
    let corners = corners.map(|corner| corner * radius).to_vec();
    let faces = (0..4).flat_map(|k| [[k, (k + 1) % 4, 4], [(k + 1) % 4, k, 5]]);
    Surface::new(corners, faces.collect()).expect("an octahedron")
}

/// A sphere: an octahedron, subdivided and projected outwards.
pub(super) fn sphere(radius: f64, max_edge: f64) -> Surface {
    let fine = octahedron(radius)
        .subdivided(max_edge)
        .expect("a good length")
        .0;
    let round = fine
        .positions()
        .iter()
        .map(|at| at.normalize() * radius)
        .collect();
    fine.moved(round).expect("a good sphere")
}

/// Noise of two octaves as labels of places: 1 for the share with the highest values.
pub(super) fn noise_labels(scale_mm: f64, share: f64, places: &[DVec3], seed: u64) -> Vec<u32> {
    let pattern = NoisePattern {
        scale_mm,
        octaves: 2,
        gain: 0.5,
        share,
    };
    let kinds = pattern.kinds(places, seed);
    kinds.into_iter().map(u32::from).collect()
}
