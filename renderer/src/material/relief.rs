//! The relief of a leaf's faces: slopes from a map, filtered to the width of a ray, and the cells
//! of the epidermis.
//!
//! Each level of the map halves the one before and averages slopes and squares of slopes. What a
//! level no longer resolves is the variance of slopes, mean square less square of the mean; it makes
//! the coat rougher, `α'² = α² + 3 σ²` on each axis, so that a leaf far away sends out what it does
//! from nearby and nothing flickers (LEAN mapping, \[olano2010\]).

mod cells;

use std::sync::Arc;

use glam::Vec2;

use self::cells::Cells;
use crate::bsdf::coat_table::{Bloom, CoatTable};
use crate::bsdf::leaf::Coat;
use crate::bsdf::relief::ReliefFace;
use crate::geometry::TextureScale;

/// By how much the square of a GGX roughness grows with the variance of slopes.
///
/// For Beckmann's distribution it is 2. GGX has a sharper core and an infinite variance: the peak of
/// its convolution with normally distributed slopes asks for 4 where these are small beside the
/// coat's own and for 2.9 at `σ² = α²/2`.
const SPREAD: f32 = 3.0;

/// The moments of both faces: for each the means of ∂z/∂x and ∂z/∂y and of their squares.
type Moments = [[f32; 4]; 2];

/// The relief of a leaf's faces.
#[derive(Clone, Debug)]
pub struct Relief {
    /// From the finest to one texel.
    levels: Vec<Level>,
    faces: [FaceCoat; 2],
    cells: Option<Cells>,
}

/// The coat of a face where it is smooth.
#[derive(Clone, Debug)]
struct FaceCoat {
    eta: f32,
    /// Roughness across and along.
    alphas: [f32; 2],
    table: Arc<CoatTable>,
    bloom: Bloom,
}

#[derive(Clone, Debug)]
struct Level {
    width: usize,
    height: usize,
    texels: Box<[Moments]>,
}

/// What a leaf's relief is made from.
#[derive(Clone, Debug)]
pub struct ReliefMap {
    /// Texels along u and v.
    pub size: [usize; 2],
    /// Row by row from v = 0.
    pub texels: Vec<Moments>,
    /// Sides of the map, mm.
    pub size_mm: [f32; 2],
    /// Width of epidermal cells, µm, 0 for none; their length over it; and their share of the
    /// square of the coat's roughness.
    pub cells: [f32; 3],
    /// Optical thickness of the bloom on the adaxial and the abaxial face.
    pub bloom: [f32; 2],
}

impl Relief {
    /// The relief of a map under an adaxial and an abaxial coat.
    pub fn new(map: ReliefMap, coats: &[Coat; 2]) -> Self {
        let [width, height] = map.size;
        let mut levels = vec![Level {
            width,
            height,
            texels: map.texels.into(),
        }];
        while let Some(next) = levels.last().and_then(Level::half) {
            levels.push(next);
        }
        let face = |side: usize| {
            let (eta, alphas) = coats[side].numbers();
            let table = CoatTable::of(eta);
            FaceCoat {
                eta,
                alphas,
                bloom: Bloom::new(map.bloom[side], &table),
                table,
            }
        };
        let faces = [face(0), face(1)];
        Self {
            levels,
            faces,
            cells: Cells::new(map.cells, map.size_mm),
        }
    }

    /// The adaxial and the abaxial face at `uv`, seen by a ray of this width on the surface, m.
    pub fn at(&self, uv: Vec2, scale: Option<TextureScale>, footprint: f32) -> [ReliefFace<'_>; 2] {
        let metres_per_v = scale.map_or(1.0, |scale| scale.metres_per_v);
        let texel = metres_per_v / self.levels[0].height as f32;
        let level = (footprint / texel).log2();
        let moments = self.moments(uv, level);
        let cells = self.cells.as_ref();
        let cells = cells.and_then(|cells| cells.at(uv, footprint / metres_per_v));
        let mirrored = scale.is_some_and(|scale| scale.is_mirrored);
        let face = |side: usize| {
            let [x, y, xx, yy] = moments[side];
            let coat = &self.faces[side];
            let mut slope = Vec2::new(x, y);
            let mut squares = [
                coat.alphas[0] * coat.alphas[0] + SPREAD * (xx - x * x).max(0.0),
                coat.alphas[1] * coat.alphas[1] + SPREAD * (yy - y * y).max(0.0),
            ];
            if let Some(cells) = &cells {
                // Cells bulge outwards on either face.
                let outward = if side == 0 { 1.0 } else { -1.0 };
                let alphas = Vec2::from(coat.alphas);
                slope += outward * cells.slope * alphas;
                for axis in 0..2 {
                    squares[axis] -= cells.resolved[axis] * alphas[axis] * alphas[axis];
                }
            }
            if mirrored {
                slope.x = -slope.x;
            }
            let alphas = squares.map(|square| square.max(0.0).sqrt());
            ReliefFace {
                slope,
                coat: coat.table.coat(coat.eta, alphas, &coat.bloom),
            }
        };
        [face(0), face(1)]
    }

    /// Moments at a level, linear between levels.
    fn moments(&self, uv: Vec2, level: f32) -> Moments {
        let last = self.levels.len() - 1;
        // Not a number, of a ray without width, is the finest level.
        let level = if level > 0.0 {
            level.min(last as f32)
        } else {
            0.0
        };
        let low = level as usize;
        let share = level - low as f32;
        let fine = self.levels[low].at(uv);
        if share == 0.0 {
            return fine;
        }
        mix(&fine, &self.levels[(low + 1).min(last)].at(uv), share)
    }
}

fn mix(a: &Moments, b: &Moments, share: f32) -> Moments {
    std::array::from_fn(|face| {
        std::array::from_fn(|i| a[face][i] + (b[face][i] - a[face][i]) * share)
    })
}

impl Level {
    /// The level of half as many texels on each side; `None` for one texel.
    fn half(&self) -> Option<Self> {
        if self.width == 1 && self.height == 1 {
            return None;
        }
        let [width, height] = [self.width, self.height].map(|side| side.div_ceil(2));
        let mut texels = vec![[[0.0; 4]; 2]; width * height];
        for (row, texels) in texels.chunks_mut(width).enumerate() {
            for (column, texel) in texels.iter_mut().enumerate() {
                let pick = |dx: usize, dy: usize| {
                    let x = (2 * column + dx).min(self.width - 1);
                    let y = (2 * row + dy).min(self.height - 1);
                    &self.texels[y * self.width + x]
                };
                let upper = mix(pick(0, 0), pick(1, 0), 0.5);
                let lower = mix(pick(0, 1), pick(1, 1), 0.5);
                *texel = mix(&upper, &lower, 0.5);
            }
        }
        Some(Self {
            width,
            height,
            texels: texels.into(),
        })
    }

    /// Bilinear between texel centres, clamped at the border.
    fn at(&self, uv: Vec2) -> Moments {
        let place = |share: f32, count: usize| {
            let at = (share * count as f32 - 0.5).clamp(0.0, (count - 1) as f32);
            let low = at as usize;
            (low, (low + 1).min(count - 1), at - low as f32)
        };
        let (x0, x1, share_x) = place(uv.x, self.width);
        let (y0, y1, share_y) = place(uv.y, self.height);
        let texel = |x: usize, y: usize| &self.texels[y * self.width + x];
        let below = mix(texel(x0, y0), texel(x1, y0), share_x);
        let above = mix(texel(x0, y1), texel(x1, y1), share_x);
        mix(&below, &above, share_y)
    }
}

#[cfg(test)]
mod tests;
