//! Straight walks over a surface.

use glam::DVec2;

use super::surface::Surface;

/// Greatest number of edges crossed or followed. A step is shorter than the repulsion radius, which
/// spans few faces.
const MOST_EDGES: usize = 256;

/// The end of a walk of length and direction `step` (in the frame of `face`, mm) from `at`: the
/// face and the place in it.
///
/// It continues straight across edges, as on unfolded faces. At a margin the rest of the step
/// follows the margin, so that the walk never leaves the surface.
pub(super) fn walk(
    surface: &Surface,
    mut face: u32,
    mut at: DVec2,
    mut step: DVec2,
) -> (u32, DVec2) {
    // The edge over which the face was entered, which cannot be the next one crossed.
    let mut entered = 3;
    for _ in 0..MOST_EDGES {
        let corners = surface.corners(face);
        let (mut share, mut across) = (1.0, 3);
        for edge in (0..3).filter(|&edge| edge != entered) {
            let along = corners[(edge + 1) % 3] - corners[edge];
            // Inside lies to the left of each edge.
            let (height, speed) = (along.perp_dot(at - corners[edge]), along.perp_dot(step));
            if speed < 0.0 {
                let reach = height.max(0.0) / -speed;
                if reach < share {
                    (share, across) = (reach, edge);
                }
            }
        }
        if across == 3 {
            at += step;
            break;
        }
        at += step * share;
        step *= 1.0 - share;
        let next = (
            surface.neighbour(face, across),
            surface.unfold(face, across),
            surface.neighbour_edge(face, across),
        );
        if let (Some(neighbour), Some(unfold), Some(edge)) = next {
            at = unfold.apply_inverse(at);
            step = unfold.turn_back(step);
            (face, entered) = (neighbour, edge);
        } else {
            let along = (corners[(across + 1) % 3] - corners[across]).normalize();
            step = along * step.dot(along);
            entered = across;
        }
    }
    // Rounding may have moved the place slightly outside.
    (face, surface.flat(&surface.point(face, at)))
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::mosaic::testing::{octahedron, square};

    #[test]
    fn on_a_flat_sheet_a_walk_is_a_straight_line() {
        let sheet = square(4.0, 0.3);
        let start = sheet.sample([0.5, 0.5, 0.5]);
        let from = sheet.position(&start);
        let mut farthest: f64 = 0.0;
        for k in 0..24 {
            let step = DVec2::from_angle(f64::from(k) * 0.26) * 0.9;
            let (face, at) = walk(&sheet, start.face, sheet.flat(&start), step);
            let to = sheet.position(&sheet.point(face, at));
            let inside = (0.1..3.9).contains(&to.x) && (0.1..3.9).contains(&to.y);
            if inside {
                assert!((from.distance(to) - 0.9).abs() < 1e-12);
            }
            farthest = farthest.max(from.distance(to));
        }
        assert!(farthest > 0.89);
    }

    #[test]
    fn at_a_margin_a_walk_slides_and_never_leaves() {
        let sheet = square(1.0, 0.4);
        for k in 0..200 {
            let u = f64::from(k) / 200.0;
            let start = sheet.sample([u, (7.3 * u).fract(), (3.1 * u).fract()]);
            let step = DVec2::from_angle(f64::from(k)) * 3.0;
            let (face, at) = walk(&sheet, start.face, sheet.flat(&start), step);
            let to = sheet.position(&sheet.point(face, at));
            assert!(
                to.cmpge(DVec3::splat(-1e-12)).all() && to.cmple(DVec3::splat(1.0 + 1e-12)).all(),
                "{to}"
            );
        }
    }

    #[test]
    fn round_a_closed_surface_a_walk_comes_home() {
        // A walk around an octahedron, over its upper and lower faces, that returns to its start.
        let surface = octahedron(1.0);
        let start = surface.centre(0);
        let from = surface.flat(&start);
        for k in 0..36 {
            let step = DVec2::from_angle(f64::from(k) * 0.17) * 2.0;
            let (face, at) = walk(&surface, 0, from, step);
            // Back the same way: the direction of arrival is that of a walk twice as short.
            let (before, near) = walk(&surface, 0, from, step * (1.0 - 1e-6));
            if before != face {
                continue;
            }
            let back = (near - at).normalize() * 2.0;
            let (home, there) = walk(&surface, face, at, back);
            let gap = surface
                .position(&surface.point(home, there))
                .distance(surface.position(&start));
            assert!(gap < 1e-5, "{gap} mm from home");
        }
    }
}
