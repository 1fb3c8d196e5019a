//! Drops on a surface: they prefer its furrows, and those that touch run together.

use glam::{DMat3, DVec3};

use super::cells::Cells;

/// Least number of triangles around a place by which its hollowness is told.
const LEAST_AROUND: usize = 3;

/// The triangles of a surface by their middles.
#[derive(Clone, Debug)]
pub(super) struct Nearby<'a>(Cells<&'a [DVec3; 3]>);

impl<'a> Nearby<'a> {
    /// The triangles, in cells of an edge, m.
    pub(super) fn of(triangles: &'a [[DVec3; 3]], edge: f64) -> Self {
        let mut cells = Cells::of_edge(edge);
        for triangle in triangles {
            let [a, b, c] = *triangle;
            cells.add((a + b + c) / 3.0, triangle);
        }
        Self(cells)
    }

    /// How far the surface within a cell's edge of a place rises above the plane there, m: above 0 in
    /// a furrow, below on a ridge, 0 where it is even.
    pub(super) fn hollowness(&self, place: DVec3, normal: DVec3) -> f64 {
        let (mut sum, mut area, mut count) = (0.0, 0.0, 0);
        for [a, b, c] in self.0.around(place) {
            let middle = (*a + *b + *c) / 3.0 - place;
            let own = (*b - *a).cross(*c - *a);
            // The other face of a thin body is no side of the furrow.
            if middle.length() > self.0.edge() || own.dot(normal) <= 0.0 {
                continue;
            }
            sum += own.length() * middle.dot(normal);
            area += own.length();
            count += 1;
        }
        if count < LEAST_AROUND || area <= 0.0 {
            return 0.0;
        }
        sum / area
    }

    /// The point of the surface that is nearest to a place, and the normal there; none if there is
    /// nothing near.
    fn nearest(&self, place: DVec3) -> Option<(DVec3, DVec3)> {
        self.0
            .around(place)
            .map(|triangle| {
                let point = nearest_on(triangle, place);
                let [a, b, c] = *triangle;
                (point, (b - a).cross(c - a))
            })
            .min_by(|a, b| {
                let far = |found: &(DVec3, DVec3)| found.0.distance_squared(place);
                far(a).total_cmp(&far(b))
            })
            .map(|(point, normal)| (point, normal.normalize_or(DVec3::Z)))
    }
}

/// The point of a triangle that is nearest to a place (Ericson 2005, 5.1.5).
fn nearest_on([a, b, c]: &[DVec3; 3], place: DVec3) -> DVec3 {
    let (ab, ac, ap) = (*b - *a, *c - *a, place - *a);
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return *a;
    }
    let bp = place - *b;
    let (d3, d4) = (ab.dot(bp), ac.dot(bp));
    if d3 >= 0.0 && d4 <= d3 {
        return *b;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return *a + ab * (d1 / (d1 - d3));
    }
    let cp = place - *c;
    let (d5, d6) = (ab.dot(cp), ac.dot(cp));
    if d6 >= 0.0 && d5 <= d6 {
        return *c;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return *a + ac * (d2 / (d2 - d6));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        return *b + (*c - *b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    let sum = va + vb + vc;
    *a + ab * (vb / sum) + ac * (vc / sum)
}

/// A drop that stands on a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Standing {
    /// Index of its body.
    pub(super) body: u32,
    /// Where it stands.
    pub(super) point: DVec3,
    /// The surface's normal there, or the vertical.
    pub(super) up: DVec3,
    /// Its turn, without the factor on its size.
    pub(super) turn: DMat3,
    /// Factor on its size.
    pub(super) scale: f64,
}

/// Lets drops that touch run together until none do; `widths` are the radii of the bodies in the
/// plan. A drop of the summed volume stands between the two, nearer to the larger; its shape is
/// that of the larger.
pub(super) fn merged(
    mut drops: Vec<Standing>,
    widths: &[f64],
    surface: &Nearby<'_>,
    turned: impl Fn(DVec3, DVec3, DMat3) -> DMat3,
) -> Vec<Standing> {
    let radius = |drop: &Standing| widths[drop.body as usize] * drop.scale;
    loop {
        let widest = drops.iter().map(radius).fold(0.0, f64::max);
        if widest <= 0.0 {
            return drops;
        }
        let mut cells: Cells<usize> = Cells::of_edge(2.0 * widest);
        let mut gone = vec![false; drops.len()];
        let mut some = false;
        for number in 0..drops.len() {
            let place = drops[number].point;
            let mut own = number;
            for &other in cells.around(place) {
                if gone[other] || other == own {
                    continue;
                }
                let (a, b) = (&drops[own], &drops[other]);
                let touch = radius(a) + radius(b);
                if a.point.distance(b.point) < touch {
                    let (large, small) = if radius(a) >= radius(b) {
                        (own, other)
                    } else {
                        (other, own)
                    };
                    drops[large] = united(
                        &drops[large],
                        &drops[small],
                        [radius(&drops[large]), radius(&drops[small])],
                        surface,
                        &turned,
                    );
                    gone[small] = true;
                    some = true;
                    own = large;
                }
            }
            if own == number {
                cells.add(place, number);
            }
        }
        let mut kept = gone.iter().map(|gone| !gone);
        drops.retain(|_| kept.next().unwrap_or(true));
        if !some {
            return drops;
        }
    }
}

/// Two drops as one of the summed volume.
fn united(
    large: &Standing,
    small: &Standing,
    [wide, narrow]: [f64; 2],
    surface: &Nearby<'_>,
    turned: &impl Fn(DVec3, DVec3, DMat3) -> DMat3,
) -> Standing {
    let [v, w] = [wide, narrow].map(|radius| radius * radius * radius);
    let between = large.point.lerp(small.point, w / (v + w));
    let (point, up) = surface.nearest(between).unwrap_or((large.point, large.up));
    Standing {
        point,
        up,
        turn: turned(large.up, up, large.turn),
        scale: large.scale * libm::cbrt((v + w) / v),
        ..*large
    }
}
