//! The relief of a leaf's faces: slopes from a map, filtered to the width of a ray, the cells of the
//! epidermis with its stomata, and the dust on it.
//!
//! Each level of the map halves the one before and averages slopes and squares of slopes. What a
//! level no longer resolves is the variance of slopes, mean square less square of the mean; it makes
//! the coat rougher, `α'² = α² + 3 σ²` on each axis, so that a leaf far away sends out what it does
//! from nearby and nothing flickers (LEAN mapping, \[olano2010\]).

mod cells;
mod levels;
mod stomata;

use std::sync::Arc;

use glam::Vec2;
use optics::dust::grain_albedo;

use self::cells::{Cells, SPREAD};
use self::levels::Levels;
pub use self::stomata::StomataNumbers;
use self::stomata::{Place, Stomata};
use crate::bsdf::coat_table::{Bloom, CoatTable};
use crate::bsdf::dust::DustTable;
use crate::bsdf::leaf::Coat;
use crate::bsdf::relief::ReliefFace;
use crate::geometry::TextureScale;
use crate::spectrum::{Curve, Lanes, Wavelengths, library};

/// The relief of a leaf's faces.
#[derive(Clone, Debug)]
pub struct Relief {
    /// Of the adaxial and then the abaxial face the means of ∂z/∂x and ∂z/∂y and of their squares.
    moments: Levels<8>,
    /// Dust and the distance to veins.
    cover: Option<Levels<3>>,
    faces: [FaceCoat; 2],
    cells: Option<Cells>,
    /// Of the adaxial and the abaxial face.
    stomata: [Option<Stomata>; 2],
    /// Albedo of a grain of dust.
    grains: Option<Curve>,
    size_mm: Vec2,
    /// The side that is a cut through the tissue and no face.
    cut: Option<usize>,
}

/// How a ray sees the faces at a point.
#[derive(Clone, Copy, Debug)]
pub struct Seen {
    uv: Vec2,
    /// Level of the map.
    level: f32,
    /// Width of the ray in units of v.
    width: f32,
    is_mirrored: bool,
}

/// The coat of a face where it is smooth.
#[derive(Clone, Debug)]
struct FaceCoat {
    eta: f32,
    /// Roughness across and along.
    alphas: [f32; 2],
    table: Arc<CoatTable>,
    bloom: Bloom,
    dust: Option<DustTable>,
}

/// What a leaf's relief is made from.
#[derive(Clone, Debug)]
pub struct ReliefMap {
    /// Texels along u and v.
    pub size: [usize; 2],
    /// Row by row from v = 0, of the adaxial and the abaxial face: means of ∂z/∂x and ∂z/∂y and of
    /// their squares.
    pub texels: Vec<[[f32; 4]; 2]>,
    /// As many texels of the optical thickness of dust on either face and of the distance to the
    /// nearest vein's axis, mm; empty if there is neither dust nor stoma.
    pub cover: Vec<[f32; 3]>,
    /// Sides of the map, mm.
    pub size_mm: [f32; 2],
    /// Width of epidermal cells, µm, 0 for none; their length over it; and their share of the
    /// square of the coat's roughness.
    pub cells: [f32; 3],
    /// Optical thickness of the bloom on the adaxial and the abaxial face.
    pub bloom: [f32; 2],
    /// The stomata of both faces.
    pub stomata: StomataNumbers,
    /// Factor on the reflectance of the soil that dust comes from; `None` if the faces are clean.
    pub dust_brightness: Option<f64>,
}

impl Relief {
    /// The relief of a map under an adaxial and an abaxial coat.
    pub fn new(map: ReliefMap, coats: &[Coat; 2]) -> Self {
        let is_dusty = map.dust_brightness.is_some();
        let face = |side: usize| {
            let (eta, alphas) = coats[side].numbers();
            let table = CoatTable::of(eta);
            let bloom = Bloom::new(map.bloom[side], &table);
            FaceCoat {
                eta,
                alphas,
                dust: is_dusty.then(|| DustTable::new(&table, &bloom)),
                bloom,
                table,
            }
        };
        let faces = [face(0), face(1)];
        let flat = map.texels.into_flattened().into_flattened();
        let dry_soil = Curve::from_points(&library::soil(0.0));
        let grains = |brightness: f64| {
            Curve::uniform(350.0, 50.0, 43, |nm| {
                grain_albedo(brightness * f64::from(dry_soil.at(nm as f32)))
            })
        };
        Self {
            moments: Levels::new(map.size, flat),
            cover: (!map.cover.is_empty())
                .then(|| Levels::new(map.size, map.cover.into_flattened())),
            faces,
            cells: Cells::new(map.cells, map.size_mm),
            stomata: [0, 1].map(|face| Stomata::new(&map.stomata, face)),
            grains: map.dust_brightness.map(grains),
            size_mm: Vec2::from(map.size_mm),
            cut: None,
        }
    }

    /// The same with one side smooth and clean; that it has no coat is in what it was made with.
    #[must_use]
    pub fn without(mut self, side: usize) -> Self {
        let face = &mut self.faces[side];
        face.bloom = Bloom::new(0.0, &face.table);
        self.cut = Some(side);
        self
    }

    /// Texels along u and v, and of the adaxial and then the abaxial face the means of ∂z/∂x and
    /// ∂z/∂y and of their squares, row by row from v = 0.
    pub fn finest(&self) -> ([usize; 2], &[[f32; 8]]) {
        (self.moments.size(), self.moments.finest())
    }

    /// Albedo of a grain of dust at a path's wavelengths.
    #[inline]
    pub fn grains<const N: usize>(&self, wavelengths: &Wavelengths<N>) -> Lanes<N> {
        let grains = self.grains.as_ref();
        grains.map_or(Lanes::ZERO, |grains| grains.lanes(wavelengths))
    }

    /// The faces at `uv` as a ray of this width on the surface, m, sees them; their slopes are on
    /// their way from memory.
    pub fn seen(&self, uv: Vec2, scale: Option<TextureScale>, footprint: f32) -> Seen {
        let metres_per_v = scale.map_or(1.0, |scale| scale.metres_per_v);
        let texel = metres_per_v / self.moments.size()[1] as f32;
        let level = (footprint / texel).log2();
        self.moments.prefetch(uv, level);
        Seen {
            uv,
            level,
            width: footprint / metres_per_v,
            is_mirrored: scale.is_some_and(|scale| scale.is_mirrored),
        }
    }

    /// The adaxial and the abaxial face as they are seen.
    pub fn faces(&self, seen: &Seen) -> [ReliefFace<'_>; 2] {
        let Seen {
            uv,
            level,
            width,
            is_mirrored,
        } = *seen;
        let moments = self.moments.at(uv, level);
        // Of a clean leaf it tells of veins alone, which stomata ask for themselves.
        let cover = self.cover.as_ref().filter(|_| self.grains.is_some());
        let cover = cover.map(|cover| cover.at(uv, level));
        let cells = self.cells.as_ref();
        let cells = cells.and_then(|cells| cells.at(uv, width));
        let face = |side: usize| {
            let [x, y, xx, yy] = [0, 1, 2, 3].map(|i| moments[4 * side + i]);
            let coat = &self.faces[side];
            if self.cut == Some(side) {
                return ReliefFace {
                    slope: Vec2::ZERO,
                    coat: coat.table.coat(coat.eta, coat.alphas, &coat.bloom),
                    dust: None,
                };
            }
            let mut slope = Vec2::new(x, y);
            let mut squares = [
                coat.alphas[0] * coat.alphas[0] + SPREAD * (xx - x * x).max(0.0),
                coat.alphas[1] * coat.alphas[1] + SPREAD * (yy - y * y).max(0.0),
            ];
            // Cells bulge outwards on either face, and stomata are sunk.
            let outward = if side == 0 { 1.0 } else { -1.0 };
            if let Some(cells) = &cells {
                let alphas = Vec2::from(coat.alphas);
                slope += outward * cells.slope * alphas;
                for axis in 0..2 {
                    squares[axis] -= cells.resolved[axis] * alphas[axis] * alphas[axis];
                }
            }
            let stomata = &self.stomata[side];
            if let Some(stomata) = stomata.filter(|s| s.are_seen(width * self.size_mm.y)) {
                let pit = stomata.at(&self.place(uv, width), squares);
                slope += outward * pit.slope;
                for (axis, square) in squares.iter_mut().enumerate() {
                    *square -= pit.resolved[axis];
                }
            }
            if is_mirrored {
                slope.x = -slope.x;
            }
            let alphas = squares.map(|square| square.max(0.0).sqrt());
            let dust = cover.map_or(0.0, |cover| cover[side]);
            let coated = coat.table.coat(coat.eta, alphas, &coat.bloom);
            let table = coat.dust.as_ref().filter(|_| dust > 0.0);
            ReliefFace {
                slope,
                dust: table.map(|table| table.dust(dust, &coated)),
                coat: coated,
            }
        };
        [face(0), face(1)]
    }

    /// The place at `uv` as stomata see it, for a ray that is `width` wide in units of v.
    fn place(&self, uv: Vec2, width: f32) -> Place {
        let [columns, rows] = self.moments.size().map(|count| count as f32);
        let away = |uv: Vec2| {
            let cover = self.cover.as_ref();
            cover.map_or(f32::INFINITY, |cover| cover.at(uv, 0.0)[2])
        };
        let texel = Vec2::new(columns, rows).recip();
        let difference = |step: Vec2| away(uv + step) - away(uv - step);
        let rise = Vec2::new(
            difference(Vec2::new(texel.x, 0.0)) / (texel.x * self.size_mm.x),
            difference(Vec2::new(0.0, texel.y)) / (texel.y * self.size_mm.y),
        );
        Place {
            mm: uv * self.size_mm,
            from_vein_mm: away(uv),
            // Without a vein, NaN: any direction is as good.
            away: rise.try_normalize().unwrap_or(Vec2::X),
            width_mm: width * self.size_mm.y,
        }
    }
}

#[cfg(test)]
mod tests;
