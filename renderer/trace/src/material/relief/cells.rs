//! The bulging outer walls of epidermal cells.
//!
//! Cells are the Voronoi cells of a jittered grid, each a paraboloid. Their slopes are part of what
//! the coat's roughness is made of: where a ray is finer than a cell its slope is seen and the
//! roughness is less, where it is wider all of it is roughness.

use glam::{IVec2, Vec2};

use crate::sampling::mixer;

/// By how much the square of a GGX roughness grows with the variance of slopes.
///
/// For Beckmann's distribution it is 2. GGX has a sharper core and an infinite variance: the peak of
/// its convolution with normally distributed slopes asks for 4 where these are small beside the
/// coat's own and for 2.9 at `σ² = α²/2`.
pub(super) const SPREAD: f32 = 3.0;

/// 0 below 0, 1 above 1, `3x² − 2x³` between.
pub(super) fn smooth(x: f32) -> f32 {
    let x = x.clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

/// How far a cell's middle strays within its place of the grid.
const JITTER: f32 = 0.7;
/// Variance of a coordinate within such a cell, of side 1 on average.
const VARIANCE: f32 = 0.098;
/// Width of a ray in cells up to which cells are seen whole, and from which they are not.
const SEEN: [f32; 2] = [0.3, 1.2];

/// The cells of an epidermis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cells {
    /// Cells along u and v.
    count: Vec2,
    /// Slope over the coat's roughness, for a distance of one cell from its middle.
    steepness: Vec2,
    /// Share of the square of the coat's roughness across and along that is theirs.
    shares: [f32; 2],
}

/// Cells at a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Resolved {
    /// Slope over the coat's roughness across and along.
    pub(super) slope: Vec2,
    /// Share of the square of that roughness that is seen as slope.
    pub(super) resolved: [f32; 2],
}

impl Cells {
    /// Cells of this width (µm), length over width and share of the coat's roughness, on a map of
    /// this size (mm); `None` if there are none.
    pub(super) fn new([width_um, elongation, share]: [f32; 3], size_mm: [f32; 2]) -> Option<Self> {
        if width_um == 0.0 || share == 0.0 {
            return None;
        }
        // Long cells are domes across and nearly level along.
        let shares = [share, share / (elongation * elongation)];
        let cell = Vec2::new(width_um, width_um * elongation);
        Some(Self {
            count: Vec2::from(size_mm) * 1e3 / cell,
            steepness: Vec2::from(shares.map(|share| (share / (SPREAD * VARIANCE)).sqrt())),
            shares,
        })
    }

    /// The cell at `uv` for a ray that is `width` wide in units of v; `None` if it is not seen.
    pub(super) fn at(&self, uv: Vec2, width: f32) -> Option<Resolved> {
        let wide = width * self.count.y;
        let [least, most] = SEEN;
        let seen = smooth((most - wide) / (most - least));
        if seen == 0.0 {
            return None;
        }
        let from_middle = way_from_middle(uv * self.count);
        Some(Resolved {
            // Outwards convex: the height falls away from the middle.
            slope: -seen * self.steepness * from_middle,
            resolved: self.shares.map(|share| seen * seen * share),
        })
    }
}

/// The way to a place from the nearest middle of a cell.
fn way_from_middle(place: Vec2) -> Vec2 {
    let home = place.floor().as_ivec2();
    let mut nearest = Vec2::splat(f32::INFINITY);
    for dy in -1..=1 {
        for dx in -1..=1 {
            let away = place - middle(home + IVec2::new(dx, dy));
            if away.length_squared() < nearest.length_squared() {
                nearest = away;
            }
        }
    }
    nearest
}

/// The middle of the cell at a place of the grid. Rows are staggered, as bricks are.
fn middle(cell: IVec2) -> Vec2 {
    let bits = mixer::of_cell(cell.to_array(), 0);
    let unit = |bits: u64| (bits & 0xff_ffff) as f32 / 16_777_216.0;
    let strayed = Vec2::new(unit(bits), unit(bits >> 32)) - 0.5;
    cell.as_vec2() + 0.5 + JITTER * strayed
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_have_the_share_of_the_roughness_that_they_take_from_it() {
        for elongation in [1.0, 4.0] {
            let cells = Cells::new([40.0, elongation, 0.5], [20.0, 20.0]).expect("there are cells");
            let (mut sum, mut squares) = (Vec2::ZERO, Vec2::ZERO);
            let count = 300;
            for i in 0..count * count {
                let uv = Vec2::new((i % count) as f32 + 0.31, (i / count) as f32 + 0.77);
                let at = cells.at(uv / count as f32, 0.0).expect("a fine ray");
                sum += at.slope;
                squares += at.slope * at.slope;
            }
            let n = (count * count) as f32;
            let mean = sum / n;
            let variance = squares / n - mean * mean;
            let expected = Vec2::new(0.5, 0.5 / (elongation * elongation)) / SPREAD;
            assert!(mean.length() < 0.01, "{mean}");
            let ratio = variance / expected;
            assert!((ratio - 1.0).abs().max_element() < 0.08, "{ratio}");
        }
    }

    #[test]
    fn a_wide_ray_sees_no_cells() {
        let cells = Cells::new([40.0, 1.0, 0.5], [20.0, 20.0]).expect("there are cells");
        assert!(cells.at(Vec2::splat(0.3), 0.1).is_none());
        assert!(Cells::new([0.0, 1.0, 0.5], [20.0, 20.0]).is_none());
    }
}
