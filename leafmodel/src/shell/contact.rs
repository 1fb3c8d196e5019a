//! Contact of a sheet with itself.
//!
//! Parts of the sheet that are not neighbours on it keep a distance: half the thickness of each.
//! Beyond it a barrier rises over a narrow gap, after \[li2020\] (eq. 6, with the distance itself): `B(s) = −(1 − s)² ln s` with the
//! gap `s` over its width. A place that begins too near feels the barrier's parabola instead, so
//! that it can come free. Parts that pass through each other cost more than any step gains, so a
//! search that begins without crossings ends without.
//!
//! The stiffness is that of each side as if the other were held, twice: `(a − b)² ≤ 2a² + 2b²`. So
//! the matrix keeps its narrow band and steps still lead downhill.

use glam::DVec3;

use super::crossings::{Extent, cross, each_near, sweep};
use super::nearest::{of_edges, on_triangle};
use super::skin::Skin;

/// Cells up to so many columns and rows away are neighbours.
const NEIGHBOURS: usize = 2;
/// Width of the gap over which the barrier rises, as a share of a cell's side.
const GAP: f64 = 0.2;
/// Share of the gap below which the barrier is continued by its parabola.
const PARABOLA: f64 = 0.02;
/// Energy of each pair of triangles that pass through each other, N mm.
const CROSSED: f64 = 1e3;
/// The triangles of a piece.
const TRIANGLES: [[usize; 3]; 2] = [[0, 1, 2], [0, 2, 3]];

/// A sheet that keeps clear of itself.
#[derive(Clone, Debug)]
pub(crate) struct Contact {
    skin: Skin,
    /// Stiffness of the barrier, N/mm.
    stiffness: f64,
}

/// Two places of the sheet that are near each other.
#[derive(Clone, Copy, Debug)]
struct Touch {
    pieces: [u32; 2],
    /// Shares of the corners of each piece.
    shares: [[f64; 4]; 2],
    /// From the second place to the first.
    normal: DVec3,
    /// Gap over its width, < 1.
    gap: f64,
}

/// What touches, and how many pairs of triangles pass through each other.
#[derive(Clone, Debug, Default)]
pub(super) struct Touches {
    near: Vec<Touch>,
    crossed: usize,
}

impl Contact {
    pub(super) fn new(skin: Skin, stiffness: f64) -> Self {
        Self { skin, stiffness }
    }

    fn width(&self) -> f64 {
        GAP * self.skin.spacing
    }

    /// What touches with the control points at `x`.
    pub(super) fn touches(&self, x: &[DVec3]) -> Touches {
        let corners = self.skin.corners(x);
        let mut boxes: Vec<(Extent, u32)> = (0..)
            .zip(corners.iter().zip(&self.skin.pieces))
            .map(|(number, (corners, piece))| {
                let by = piece.radius + 0.5 * self.width();
                (Extent::of(corners).widened(by), number)
            })
            .collect();
        sweep(&mut boxes);
        let mut touches = Touches::default();
        each_near(&boxes, |a, b| {
            let [one, other] = [a, b].map(|piece| self.skin.pieces[piece as usize].cell);
            let near = |i: usize| one[i].abs_diff(other[i]) <= NEIGHBOURS;
            if !(near(0) && near(1)) {
                self.pair([a.min(b), a.max(b)], &corners, &mut touches);
            }
        });
        touches
    }

    fn pair(&self, [a, b]: [u32; 2], corners: &[[DVec3; 4]], touches: &mut Touches) {
        let places = [a, b].map(|piece| &corners[piece as usize]);
        let pieces = [a, b].map(|piece| &self.skin.pieces[piece as usize]);
        let extents = places.map(|places| Extent::of(places));
        if extents[0].meets(&extents[1]) {
            touches.crossed += TRIANGLES
                .iter()
                .flat_map(|one| TRIANGLES.iter().map(move |other| (one, other)))
                .filter(|(one, other)| {
                    cross(&one.map(|i| places[0][i]), &other.map(|i| places[1][i]))
                })
                .count();
        }
        let least = pieces[0].radius + pieces[1].radius;
        let reach = least + self.width();
        let mut add = |shares: [[f64; 4]; 2]| {
            let [p, q] = [0, 1].map(|side| {
                let all = places[side].iter().zip(shares[side]);
                all.map(|(&place, share)| place * share).sum::<DVec3>()
            });
            let distance = p.distance(q);
            if distance < reach && distance > 0.0 {
                touches.near.push(Touch {
                    pieces: [a, b],
                    shares,
                    normal: (p - q) / distance,
                    gap: (distance - least) / self.width(),
                });
            }
        };
        for side in 0..2 {
            let other = 1 - side;
            let around = extents[other].widened(reach);
            for corner in (0..4).filter(|&corner| pieces[side].owns[corner]) {
                let p = places[side][corner];
                if !around.meets(&Extent { low: p, high: p }) {
                    continue;
                }
                for triangle in TRIANGLES {
                    let on = on_triangle(p, triangle.map(|i| places[other][i]));
                    let mut shares = [[0.0; 4]; 2];
                    shares[side][corner] = 1.0;
                    for (i, share) in triangle.into_iter().zip(on) {
                        shares[other][i] = share;
                    }
                    add(shares);
                }
            }
        }
        for one in (0..4).filter(|&i| pieces[0].margin[i]) {
            for other in (0..4).filter(|&i| pieces[1].margin[i]) {
                let sides = [one, other].map(|i| [i, (i + 1) % 4]);
                let edges = [0, 1].map(|k| sides[k].map(|i| places[k][i]));
                let along = of_edges(edges[0], edges[1]);
                // An end of an edge is a corner, which has been there already.
                if along.iter().all(|&t| t > 0.0 && t < 1.0) {
                    let mut shares = [[0.0; 4]; 2];
                    for k in 0..2 {
                        shares[k][sides[k][0]] = 1.0 - along[k];
                        shares[k][sides[k][1]] = along[k];
                    }
                    add(shares);
                }
            }
        }
    }

    /// The energy of what touches, N mm; `push` takes each control point and its part of the slope.
    pub(super) fn walk(&self, touches: &Touches, push: &mut impl FnMut(u32, DVec3)) -> f64 {
        let width = self.width();
        let mut energy = CROSSED * touches.crossed as f64;
        for touch in &touches.near {
            let [value, slope, _] = barrier(touch.gap);
            energy += self.stiffness * width * width * value;
            let force = touch.normal * (self.stiffness * width * slope);
            self.each_weight(touch, |side, points, weights| {
                let sign = if side == 0 { 1.0 } else { -1.0 };
                for (&point, weight) in points.iter().zip(weights) {
                    push(point, force * (sign * weight));
                }
            });
        }
        energy
    }

    /// Calls `add` with each two control points of one side, the second not beyond the first, and
    /// the factor and direction of their stiffness.
    pub(super) fn stiffnesses(&self, touches: &Touches, mut add: impl FnMut(u32, u32, f64, DVec3)) {
        for touch in &touches.near {
            let factor = 2.0 * self.stiffness * barrier(touch.gap)[2];
            self.each_weight(touch, |_, points, weights| {
                for (i, &a) in points.iter().enumerate() {
                    for (j, &b) in points.iter().enumerate() {
                        let value = factor * weights[i] * weights[j];
                        if b <= a && value > 0.0 {
                            add(a, b, value, touch.normal);
                        }
                    }
                }
            });
        }
    }

    fn each_weight(&self, touch: &Touch, mut act: impl FnMut(usize, &[u32; 9], [f64; 9])) {
        for (side, shares) in touch.shares.iter().enumerate() {
            let piece = touch.pieces[side];
            let weights = self.skin.weights(piece, shares);
            act(side, &self.skin.pieces[piece as usize].points, weights);
        }
    }
}

/// The barrier at a gap < 1 with its first and second derivative.
fn barrier(gap: f64) -> [f64; 3] {
    if gap >= 1.0 {
        return [0.0; 3];
    }
    let s = gap.max(PARABOLA);
    let (left, log) = (1.0 - s, libm::log(s));
    let value = -left * left * log;
    let first = 2.0 * left * log - left * left / s;
    let second = -2.0 * log + 4.0 * left / s + left * left / (s * s);
    let below = gap - s;
    [
        value + below * (first + 0.5 * below * second),
        first + below * second,
        second,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_barrier_falls_smoothly_to_nothing_at_its_width() {
        assert_eq!(barrier(1.0), [0.0; 3]);
        let [value, slope, _] = barrier(1.0 - 1e-7);
        assert!(value < 1e-18 && slope > -1e-12);
        for i in 0..120 {
            let s = -0.2 + 0.01 * f64::from(i) + 1e-4;
            let [value, slope, bend] = barrier(s);
            assert!(value > 0.0 && slope < 0.0 && bend > 0.0, "{s}");
            let step = 1e-6;
            let [above, below] = [s + step, s - step].map(barrier);
            let found = (above[0] - below[0]) / (2.0 * step);
            assert!((found / slope - 1.0).abs() < 1e-5, "{found} {slope} at {s}");
            let found = (above[1] - below[1]) / (2.0 * step);
            assert!((found / bend - 1.0).abs() < 1e-4, "{found} {bend} at {s}");
        }
    }
}
