//! Tissue that stands out from the surface of a body: warts of a cap, ribs of a fruit.
//!
//! - **In**: the surface on which the mosaic grew, its cells, a height for each type of cell.
//! - **Out**: a finer surface, and how high each of its points stands and how steeply.
//! - **Always true**: heights are continuous from face to face, 0 along the borders between raised
//!   and other tissue, and the full height from the width of the slope on.
//! - **Left out**: overhangs. Points move along the normal alone.

use glam::DVec3;
use thiserror::Error;

use crate::mosaic::paint::TypeField;
use crate::mosaic::{Ancestry, Surface, SurfaceError, SurfacePoint};

/// Edges of the surface's triangles over the width of the slope.
const EDGE_OVER_SLOPE: f64 = 1.0 / 3.0;

/// Types of cells whose tissue stands out from the surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Raised {
    /// How high tissue of each type stands, mm, in the order of the types; furrows are below 0.
    pub heights_mm: Vec<f64>,
    /// Width over which it rises, from the border inwards, mm, above 0.
    pub over_mm: f64,
}

/// Greatest height and greatest depth, mm.
const MOST_MM: f64 = 1000.0;

impl Raised {
    /// Checks the numbers, for a mosaic of so many types.
    ///
    /// # Errors
    ///
    /// [`RaisedError`] for the first that is out of range.
    pub(super) fn validate(&self, types: usize) -> Result<(), RaisedError> {
        if self.heights_mm.len() != types {
            let given = self.heights_mm.len();
            return Err(RaisedError::Heights { types, given });
        }
        let high = |height: &&f64| !(-MOST_MM..=MOST_MM).contains(*height);
        if let Some(&height_mm) = self.heights_mm.iter().find(high) {
            return Err(RaisedError::Height { height_mm });
        }
        if !(self.over_mm > 0.0 && self.over_mm <= MOST_MM) {
            let over_mm = self.over_mm;
            return Err(RaisedError::Slope { over_mm });
        }
        Ok(())
    }

    /// Longest edge of the triangles that show it, mm.
    pub(super) fn edge_mm(&self) -> f64 {
        EDGE_OVER_SLOPE * self.over_mm
    }

    /// The height over a point, mm; `weights` is a buffer.
    ///
    /// `field` blends types over twice the width of the slope, so that the weight of the tissue's
    /// own type is ½ at its border and 1 from the width of the slope on.
    fn height(&self, field: &TypeField, point: &SurfacePoint, weights: &mut [f64]) -> f64 {
        if field.is_bare(point) {
            return 0.0;
        }
        field.type_weights(point, weights);
        let rise = |(height, weight): (&f64, &f64)| height * (2.0 * weight - 1.0).max(0.0);
        self.heights_mm.iter().zip(&*weights).map(rise).sum()
    }
}

/// Why tissue cannot be raised.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum RaisedError {
    /// There is no mosaic whose cells it could be.
    #[error("the body has no mosaic, whose cells could stand out")]
    NoMosaic,
    /// The number of heights differs from that of types.
    #[error("there are {types} cell types and heights for {given}")]
    Heights {
        /// How many types there are.
        types: usize,
        /// For how many there are heights.
        given: usize,
    },
    /// A height is out of range.
    #[error("a height is {height_mm} mm, it must be from -1000 to 1000")]
    Height {
        /// The height, mm.
        height_mm: f64,
    },
    /// The width of the slope is out of range.
    #[error("over_mm is {over_mm}, it must be above 0 and at most 1000")]
    Slope {
        /// The width, mm.
        over_mm: f64,
    },
}

/// A surface whose points have moved along their normals.
pub(super) struct Relief {
    /// How far each point has moved, mm.
    heights: Vec<f64>,
    /// The slope at each point, along the surface.
    slopes: Vec<DVec3>,
}

impl Relief {
    /// The relief of a surface that was subdivided, as `ancestry` says, from that of `field`, whose
    /// blend is twice the width of the slope.
    pub(super) fn new(
        raised: &Raised,
        field: &TypeField,
        (surface, ancestry): (&Surface, &Ancestry),
    ) -> Self {
        let points = surface.positions().len();
        let mut weights = vec![0.0; field.types()];
        let mut heights = vec![f64::NAN; points];
        for (face, corners) in (0..).zip(surface.faces()) {
            for (corner, &point) in corners.iter().enumerate() {
                let height = &mut heights[point as usize];
                // A point has one height, whichever face it is asked from.
                if height.is_nan() {
                    let place = ancestry.carry_back(&SurfacePoint::corner(face, corner));
                    *height = raised.height(field, &place, &mut weights);
                }
            }
        }
        let mut slopes = vec![DVec3::ZERO; points];
        let mut areas = vec![0.0; points];
        for corners in surface.faces() {
            let [a, b, c] = corners.map(|point| surface.positions()[point as usize]);
            let [of_a, of_b, of_c] = corners.map(|point| heights[point as usize]);
            let normal = (b - a).cross(c - a);
            // The gradient of a linear function, times twice the area.
            let around = (c - b) * of_a + (a - c) * of_b + (b - a) * of_c;
            let area = normal.length();
            for point in corners.map(|point| point as usize) {
                slopes[point] += normal.cross(around) / area.max(f64::MIN_POSITIVE);
                areas[point] += area;
            }
        }
        for (slope, area) in slopes.iter_mut().zip(areas) {
            *slope /= area.max(f64::MIN_POSITIVE);
        }
        Self { heights, slopes }
    }

    /// Where a point of the surface, with its mean normal, has moved.
    pub(super) fn moved(&self, point: u32, position: DVec3, normal: DVec3) -> DVec3 {
        position + normal * self.heights[point as usize]
    }

    /// One of the normals of a point as it is after the move.
    pub(super) fn turned(&self, point: u32, normal: DVec3) -> DVec3 {
        let slope = self.slopes[point as usize];
        let along = slope - normal * normal.dot(slope);
        (normal - along).normalize()
    }
}

/// The surface with triangles fine enough for the slopes, and where its faces lie on this one; the
/// surface itself without raised tissue.
pub(super) fn fine(
    surface: &Surface,
    raised: Option<&Raised>,
) -> Result<(Surface, Ancestry), SurfaceError> {
    let whole = 2.0 * surface.longest_edge();
    surface.subdivided(raised.map_or(whole, Raised::edge_mm))
}
