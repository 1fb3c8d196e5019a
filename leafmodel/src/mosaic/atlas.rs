//! Texture coordinates for a surface that has none: flat charts, packed into the unit square.
//!
//! Faces are collected into a chart while their normals agree with that of its first face. A chart
//! is projected along that normal, so areas shrink to no less than cos 40° of their size. The boxes
//! around the charts are packed on shelves.
//!
//! - **In**: a [`Surface`], the texels along a side, and the gutter.
//! - **Out**: texture coordinates for each corner of each face, and for each texel the place on the
//!   surface that it shows.
//! - **Always true**: no texel's centre lies in two charts; texels around a chart show the surface
//!   beyond the chart's border, so that bilinear look-ups on both sides of a border agree.
//! - **Left out**: gutters for mip maps beyond the width given.

mod chart;
mod texels;

use glam::DVec2;

use self::chart::{Chart, charts};
use super::surface::{Surface, SurfacePoint};
use crate::not_grown::{NotGrown, not_grown};

/// Least gutter: a bilinear look-up reaches √2 texels beyond a chart.
const LEAST_GUTTER: u32 = 2;
/// Cosine of the greatest angle between faces of a chart and its first.
const AGREE: f64 = 0.766;
/// Number of bisection steps in the search for the scale.
const SCALE_STEPS: u32 = 40;

/// The place that a texel shows; face `u32::MAX` means none.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Texel {
    face: u32,
    /// Weights of the second and third corner.
    weights: [f32; 2],
}

impl Texel {
    const NOTHING: Self = Self {
        face: u32::MAX,
        weights: [0.0; 2],
    };

    fn showing(point: &SurfacePoint) -> Self {
        let [_, v, w] = point.barycentric;
        Self {
            face: point.face,
            weights: [v as f32, w as f32],
        }
    }
}

/// A surface cut into charts and laid into the unit square.
#[derive(Clone, Debug, PartialEq)]
pub struct Atlas {
    texels: u32,
    charts: usize,
    texels_per_mm: f64,
    uvs: Vec<[DVec2; 3]>,
    shown: Vec<Texel>,
}

impl Atlas {
    /// Lays a surface out on `texels`² texels with at least `gutter` texels around each chart; less
    /// than 2 counts as 2.
    ///
    /// # Errors
    ///
    /// [`NotGrown`].
    pub fn new(surface: &Surface, texels: u32, gutter: u32) -> Result<Self, NotGrown> {
        if !(16..=16384).contains(&texels) {
            return Err(not_grown!(
                "an atlas of {texels} texels a side is not possible, it must be 16 to 16384"
            ));
        }
        let gutter = gutter.max(LEAST_GUTTER);
        let side = f64::from(texels);
        let finest = side / surface.total_area().sqrt();
        let charts = charts(surface, AGREE, finest);
        let too_many = || {
            not_grown!(
                "{} charts with gutters of {gutter} texels do not fit into {texels}² texels: raise \
                 the number of texels",
                charts.len()
            )
        };
        // Even charts of size 0 need their gutters: if these do not fit, no scale does.
        let mut places = shelves(&charts, 0.0, texels, gutter).ok_or_else(too_many)?;
        let (mut low, mut high) = (0.0, 2.0 * finest);
        for _ in 0..SCALE_STEPS {
            let scale = 0.5 * (low + high);
            if let Some(fitting) = shelves(&charts, scale, texels, gutter) {
                places = fitting;
                low = scale;
            } else {
                high = scale;
            }
        }
        if low == 0.0 {
            return Err(too_many());
        }
        let mut in_texels = vec![[DVec2::ZERO; 3]; surface.faces().len()];
        for (chart, place) in charts.iter().zip(&places) {
            for (&face, corners) in chart.faces.iter().zip(&chart.corners) {
                in_texels[face as usize] =
                    corners.map(|corner| (corner - chart.low) * low + *place);
            }
        }
        Ok(Self {
            texels,
            charts: charts.len(),
            texels_per_mm: low,
            shown: texels::shown(surface, &charts, &in_texels, texels, gutter),
            uvs: in_texels
                .into_iter()
                .map(|corners| corners.map(|corner| corner / side))
                .collect(),
        })
    }

    /// Texels along a side.
    pub fn texels(&self) -> u32 {
        self.texels
    }

    /// How many charts there are.
    pub fn charts(&self) -> usize {
        self.charts
    }

    /// Texels per millimetre on faces perpendicular to the projection; on others down to 0.766 of
    /// it in one direction.
    pub fn texels_per_mm(&self) -> f64 {
        self.texels_per_mm
    }

    /// Texture coordinates of the corners of each face, in the order of the surface's faces, 0 to
    /// 1.
    pub fn uvs(&self) -> &[[DVec2; 3]] {
        &self.uvs
    }

    /// The place that texel (`column`, `row`) shows, its centre at (column + ½, row + ½) / texels;
    /// `None` where no chart is near.
    pub fn shown(&self, column: u32, row: u32) -> Option<SurfacePoint> {
        let texel = self.shown[(row * self.texels + column) as usize];
        (texel.face != u32::MAX).then(|| {
            let [v, w] = texel.weights.map(f64::from);
            SurfacePoint {
                face: texel.face,
                barycentric: [(1.0 - v - w).max(0.0), v, w],
            }
        })
    }

    /// Share of the texels that show a place.
    pub fn filled(&self) -> f64 {
        let filled = self.shown.iter().filter(|texel| texel.face != u32::MAX);
        filled.count() as f64 / self.shown.len() as f64
    }

    /// Least and greatest number of texels per area of a face, over the mean of all faces.
    pub fn density_range(&self, surface: &Surface) -> [f64; 2] {
        let side = f64::from(self.texels);
        let area = |corners: &[DVec2; 3]| {
            0.5 * (corners[1] - corners[0]).perp_dot(corners[2] - corners[0]) * side * side
        };
        let mean = self.uvs.iter().map(area).sum::<f64>() / surface.total_area();
        self.uvs
            .iter()
            .zip(0..)
            .map(|(corners, face)| area(corners) / surface.area(face) / mean)
            .fold([f64::INFINITY, 0.0], |[low, high], density| {
                [low.min(density), high.max(density)]
            })
    }
}

/// Lower corners of the charts' drawn parts, in texels: boxes on shelves, tallest first. `None` if
/// they do not fit.
fn shelves(charts: &[Chart], scale: f64, texels: u32, gutter: u32) -> Option<Vec<DVec2>> {
    let boxes: Vec<[u64; 2]> = charts
        .iter()
        .map(|chart| {
            let size = (chart.high - chart.low) * scale;
            size.to_array()
                .map(|length| length.ceil() as u64 + 2 * u64::from(gutter))
        })
        .collect();
    let mut order: Vec<usize> = (0..charts.len()).collect();
    order.sort_by_key(|&chart| (std::cmp::Reverse(boxes[chart][1]), chart));
    let side = u64::from(texels);
    let (mut x, mut y, mut height) = (0, 0, 0);
    let mut places = vec![DVec2::ZERO; charts.len()];
    for chart in order {
        let [wide, tall] = boxes[chart];
        if x + wide > side {
            (x, y, height) = (0, y + height, 0);
        }
        if wide > side || y + tall > side {
            return None;
        }
        height = height.max(tall);
        places[chart] = DVec2::new(x as f64, y as f64) + f64::from(gutter);
        x += wide;
    }
    Some(places)
}

#[cfg(test)]
mod tests;
