//! Tissue that stands out from the surface of a body: warts of a cap, ribs of a fruit.
//!
//! - **In**: the surface on which the mosaic grew, its cells, a height for each type of cell.
//! - **Out**: a finer surface, and how high each of its points stands and how steeply.
//! - **Always true**: heights are continuous from face to face, 0 along the borders between raised
//!   and other tissue, and the full height from the width of the slope on.
//! - **Left out**: overhangs. Points move along the normal alone.

use glam::DVec3;

use crate::document::{Declared, Keys, Limits, MapOf, Number};
use crate::mosaic::paint::TypeField;
use crate::mosaic::{Ancestry, Surface, SurfacePoint};
use crate::not_grown::{NotGrown, not_grown};

/// Edges of the surface's triangles over the width of the slope.
const EDGE_OVER_SLOPE: f64 = 1.0 / 3.0;

/// Types of cells whose tissue stands out from the surface.
#[derive(Clone, Debug, Declared, PartialEq)]
pub struct Raised {
    /// How high tissue of each type stands, mm, in the order of the types; furrows are below 0.
    pub heights_mm: Vec<f64>,
    /// Width over which it rises, from the border of the tissue inwards.
    #[key("over_mm", above(0.0, MOST_MM))]
    pub over_mm: f64,
}

/// Greatest height and greatest depth, mm.
const MOST_MM: f64 = 1000.0;

impl Default for Raised {
    fn default() -> Self {
        Self {
            heights_mm: Vec::new(),
            over_mm: 1.0,
        }
    }
}

impl Raised {
    /// Its keys; `types` are the names of the cell types.
    pub(super) fn keys(&mut self, keys: &mut Keys<'_>, types: &[String]) {
        let of_types = types.iter().cloned().zip(self.heights_mm.iter().copied());
        let mut heights: Vec<(String, f64)> = of_types.filter(|(_, mm)| *mm != 0.0).collect();
        let limits = Number(Limits::closed(-MOST_MM, MOST_MM));
        let about = "A table from types of cells to how high their tissue stands; others have 0.";
        keys.required("heights_mm", &mut heights, MapOf(limits), about);
        self.declare(keys);
        self.heights_mm = vec![0.0; types.len()];
        for (name, mm) in heights {
            if let Some(kind) = types.iter().position(|one| *one == name) {
                self.heights_mm[kind] = mm;
                continue;
            }
            let problem = format!("`{name}` is no type of cell of the mosaic");
            let help = if types.is_empty() {
                "give the body a `mosaic`".to_owned()
            } else {
                format!("write one of {}", types.join(", "))
            };
            keys.refuse(&["heights_mm", &name], problem, &help);
        }
    }

    /// Checks the numbers, for a mosaic of so many types, if there is one.
    ///
    /// # Errors
    ///
    /// [`NotGrown`] for the first that is out of range.
    pub(super) fn validate(&self, types: Option<usize>) -> Result<(), NotGrown> {
        let Some(types) = types else {
            let problem = "the body has no mosaic, whose cells could stand out";
            return Err(NotGrown::because(problem));
        };
        let given = self.heights_mm.len();
        if given != types {
            return Err(not_grown!(
                "there are {types} cell types and heights for {given}"
            ));
        }
        let high = |height: &&f64| !(-MOST_MM..=MOST_MM).contains(*height);
        if let Some(height_mm) = self.heights_mm.iter().find(high) {
            return Err(not_grown!(
                "a height is {height_mm} mm, it must be from -1000 to 1000"
            ));
        }
        Ok(self.in_range()?)
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
) -> Result<(Surface, Ancestry), NotGrown> {
    let whole = 2.0 * surface.longest_edge();
    surface.subdivided(raised.map_or(whole, Raised::edge_mm))
}
