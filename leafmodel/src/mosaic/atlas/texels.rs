//! The place on the surface that each texel shows.

use glam::DVec2;

use super::Texel;
use super::chart::{Chart, each_texel};
use crate::mosaic::surface::{Surface, SurfacePoint};
use crate::plane::segment;

/// Least weight that counts as inside, so that centres on an edge do not fall between two faces.
const ON_EDGE: f64 = -1e-9;
/// Greatest number of faces that a walk beyond a border crosses.
const MOST_STEPS: u32 = 256;

/// The places of texels inside faces, and of those within the gutter, which show where a straight
/// line beyond the border leads.
pub(super) fn shown(
    surface: &Surface,
    charts: &[Chart],
    in_texels: &[[DVec2; 3]],
    texels: u32,
    gutter: u32,
) -> Vec<Texel> {
    let side = texels as usize;
    let mut shown = vec![Texel::NOTHING; side * side];
    for (corners, face) in in_texels.iter().zip(0..) {
        each_texel(corners, ON_EDGE, |x, y, [v, w]| {
            let texel = &mut shown[y as usize * side + x as usize];
            if texel.face == u32::MAX {
                let point = SurfacePoint {
                    face,
                    barycentric: [1.0 - v - w, v, w],
                };
                *texel = Texel::showing(&point);
            }
        });
    }
    let mut chart_of = vec![0; in_texels.len()];
    for (number, chart) in charts.iter().enumerate() {
        for &face in &chart.faces {
            chart_of[face as usize] = number;
        }
    }
    let mut nearest = vec![f32::INFINITY; side * side];
    for (corners, face) in in_texels.iter().zip(0..) {
        for edge in 0..3 {
            let same_chart = surface
                .neighbour(face, edge)
                .is_some_and(|beyond| chart_of[beyond as usize] == chart_of[face as usize]);
            if same_chart {
                continue;
            }
            let ends = [corners[edge], corners[(edge + 1) % 3]];
            each_texel_near(ends, gutter, side, |index, middle, distance| {
                let inside = shown[index].face != u32::MAX && nearest[index] == f32::INFINITY;
                if inside || distance as f32 >= nearest[index] {
                    return;
                }
                nearest[index] = distance as f32;
                let point = beyond_border(surface, face, edge, corners, middle);
                shown[index] = Texel::showing(&point);
            });
        }
    }
    shown
}

/// Calls `visit(index, middle, distance)` for texels whose centre is within the gutter's width of a
/// line.
fn each_texel_near(
    [from, to]: [DVec2; 2],
    gutter: u32,
    side: usize,
    mut visit: impl FnMut(usize, DVec2, f64),
) {
    let reach = f64::from(gutter);
    let low = (from.min(to) - reach - 0.5).ceil().max(DVec2::ZERO);
    let high = (from.max(to) + reach - 0.5)
        .floor()
        .min(DVec2::splat(side as f64 - 1.0));
    for y in low.y as i64..=high.y as i64 {
        for x in low.x as i64..=high.x as i64 {
            let middle = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
            let distance = middle.distance(segment::nearest(from, to, middle));
            if distance <= reach {
                visit(y as usize * side + x as usize, middle, distance);
            }
        }
    }
}

/// The place on the surface for a point beyond an edge of a chart: straight on from the nearest
/// point of the edge.
fn beyond_border(
    surface: &Surface,
    face: u32,
    edge: usize,
    corners: &[DVec2; 3],
    middle: DVec2,
) -> SurfacePoint {
    let [a, b, c] = *corners;
    let twice = (b - a).perp_dot(c - a);
    // The drawing is an affine image of the face's own frame.
    let in_frame = |p: DVec2| {
        let v = (p - a).perp_dot(c - a) / twice;
        let w = (b - a).perp_dot(p - a) / twice;
        let flat = surface.corners(face);
        flat[0] + (flat[1] - flat[0]) * v + (flat[2] - flat[0]) * w
    };
    let start = in_frame(segment::nearest(
        corners[edge],
        corners[(edge + 1) % 3],
        middle,
    ));
    let target = in_frame(middle);
    match (surface.neighbour(face, edge), surface.unfold(face, edge)) {
        (Some(beyond), Some(unfold)) => walk(
            surface,
            beyond,
            surface.neighbour_edge(face, edge),
            unfold.apply_inverse(start),
            unfold.apply_inverse(target),
        ),
        _ => surface.point(face, start),
    }
}

/// The end of a straight walk in a face's frame that continues over unfolded neighbours; it stops
/// at a margin.
fn walk(
    surface: &Surface,
    mut face: u32,
    mut entered: Option<usize>,
    mut from: DVec2,
    mut to: DVec2,
) -> SurfacePoint {
    for _ in 0..MOST_STEPS {
        let corners = surface.corners(face);
        let way = to - from;
        let exit = (0..3)
            .filter(|&edge| Some(edge) != entered)
            .filter_map(|edge| {
                let start = corners[edge];
                let along = corners[(edge + 1) % 3] - start;
                let outwards = way.perp_dot(along);
                // Positive where the walk leads out, since corners are anticlockwise.
                (outwards > 0.0).then(|| (edge, (start - from).perp_dot(along) / outwards))
            })
            .min_by(|a, b| a.1.total_cmp(&b.1));
        let Some((edge, share)) = exit.filter(|&(_, share)| share < 1.0) else {
            break;
        };
        let crossing = from + way * share.max(0.0);
        let (Some(beyond), Some(unfold)) =
            (surface.neighbour(face, edge), surface.unfold(face, edge))
        else {
            return surface.point(face, crossing);
        };
        from = unfold.apply_inverse(crossing);
        to = unfold.apply_inverse(to);
        entered = surface.neighbour_edge(face, edge);
        face = beyond;
    }
    surface.point(face, to)
}
