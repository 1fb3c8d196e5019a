//! Bodies of solid tissue: fruits, stems, caps of mushrooms.
//!
//! - **In**: a shape, the contents of its outer tissue, and a mosaic if it has one.
//! - **Out**: a mesh with texture coordinates, and a map of contents over them.
//!   Tissue of some cells may stand out from the shape.
//! - **Always true**: contents are per area of the surface. They are those of the tissue down to
//!   the depth that the optics use.
//! - **Left out**: the inside.
//!
//! ```
//! use glam::DVec3;
//! use leafmodel::optics::{Pigments, presets};
//! use leafmodel::solid::{Solid, SolidPlan, SolidShape};
//!
//! let plan = SolidPlan {
//!     shape: SolidShape::Ellipsoid { semi_axes_mm: DVec3::new(20.0, 20.0, 30.0) },
//!     seed: 1,
//!     contents: presets::by_name("sun-green").ok_or("it is a preset")?.contents,
//!     mosaic: None,
//!     raised: None,
//!     pigments: Pigments::default(),
//!     map_size: 16,
//! };
//! let fruit = Solid::grow(&plan, &|| false)?;
//! let highest = fruit.positions.iter().map(|p| p.z).fold(0.0, f64::max);
//! assert!((highest - 30.0).abs() < 0.5, "{highest} mm");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod raised;
mod shape;

use glam::{DVec2, DVec3};
use rayon::prelude::*;
use thiserror::Error;

use self::raised::Relief;
pub use self::raised::{Raised, RaisedError};
pub use self::shape::{SolidMesh, SolidShape, creased, smooth_normals};
use crate::blade::contents_map::ContentsMap;
use crate::mosaic::atlas::{Atlas, AtlasError};
use crate::mosaic::pattern::{MosaicPattern, PatternError};
use crate::mosaic::shapes::{Shape, ShapeError};
use crate::mosaic::{Mosaic, MosaicError, Surface, SurfaceError, SurfacePoint};
use crate::optics::{Contents, Pigments};

/// Width of the gutter around each chart of the map, texels.
const GUTTER: u32 = 3;
/// Number of rows of the map that are painted at once.
const BAND: usize = 128;
/// Edge length without a mosaic, over the root of the area.
const PLAIN_EDGE: f64 = 0.02;
/// Greatest factor by which edges are made shorter than suits a mosaic, since borders between cells
/// are searched face by face.
const MOST_PER_SPACING: f64 = 3.0;

/// Memory of a triangle of a body and of a texel of its map, bytes: what their arrays hold, twice,
/// since they are made from others.
const OF_A_TRIANGLE: f64 = 300.0;
const OF_A_TEXEL: f64 = 120.0;

/// The parameters of a body.
#[derive(Clone, Debug, PartialEq)]
pub struct SolidPlan {
    /// Its shape.
    pub shape: SolidShape,
    /// The seed; the same plan and seed give the same body, bit for bit.
    pub seed: u64,
    /// Contents of its outer tissue per area of the surface, where no mosaic sets others.
    pub contents: Contents,
    /// Cells with contents of their own.
    pub mosaic: Option<MosaicPattern>,
    /// Cells of the mosaic whose tissue stands out.
    pub raised: Option<Raised>,
    /// The kinds of pigments of its contents.
    pub pigments: Pigments,
    /// Texels of the map of contents along a side, 16 to 8192.
    pub map_size: u32,
}

/// A body as mesh and map. Lengths are millimetres.
#[derive(Clone, Debug)]
pub struct Solid {
    /// Points.
    pub positions: Vec<DVec3>,
    /// Unit normals, outwards.
    pub normals: Vec<DVec3>,
    /// Texture coordinates, 0 to 1.
    pub uvs: Vec<DVec2>,
    /// Points of each triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Contents over the texture coordinates.
    pub contents: ContentsMap,
    /// The mosaic, if the body has one.
    pub mosaic: Option<Mosaic>,
}

/// Why a body cannot be grown.
#[derive(Debug, Error)]
pub enum SolidError {
    /// Its shape.
    #[error("shape: {0}")]
    Shape(#[source] ShapeError),
    /// The body is too slender, or has too many cells or too narrow slopes, for the allowed number
    /// of triangles.
    #[error(
        "shape: it would take about {triangles:.0} triangles, too many: make the body less slender, give its mosaic fewer cells, or raised tissue a wider slope"
    )]
    TooFine {
        /// How many it would take.
        triangles: f64,
    },
    /// Its surface.
    #[error("shape: {0}")]
    Surface(#[from] SurfaceError),
    /// Its mosaic.
    #[error("mosaic: {0}")]
    Mosaic(#[from] PatternError),
    /// Its raised tissue.
    #[error("raised: {0}")]
    Raised(#[from] RaisedError),
    /// Its map.
    #[error("map_size: {0}")]
    Atlas(#[from] AtlasError),
}

impl From<ShapeError> for SolidError {
    fn from(error: ShapeError) -> Self {
        if let ShapeError::TooFine { triangles } = error {
            // A plan has no key for edges, so the error names triangles instead.
            return Self::TooFine { triangles };
        }
        Self::Shape(error)
    }
}

impl SolidError {
    /// Whether growth was stopped by the caller.
    pub fn is_stop(&self) -> bool {
        matches!(
            self,
            Self::Mosaic(PatternError::Mosaic(MosaicError::Stopped))
        )
    }
}

impl SolidPlan {
    /// Longest edge of its triangles, mm.
    fn edge_mm(&self, area: f64) -> f64 {
        let smooth_mm = PLAIN_EDGE * area.sqrt();
        self.mosaic.as_ref().map_or(smooth_mm, |pattern| {
            let suits_mm = pattern.edge_mm(area);
            suits_mm.min(smooth_mm.max(suits_mm / MOST_PER_SPACING))
        })
    }

    /// Checks the numbers of mosaic and raised tissue.
    fn validate(&self) -> Result<(), SolidError> {
        if let Some(pattern) = &self.mosaic {
            pattern.validate()?;
        }
        match (&self.raised, &self.mosaic) {
            (None, _) => Ok(()),
            (Some(raised), Some(pattern)) => Ok(raised.validate(pattern.plan.types.len())?),
            (Some(_), None) => Err(RaisedError::NoMosaic.into()),
        }
    }

    /// Estimates the memory that the body takes, bytes, and refuses what [`Solid::grow`] would
    /// refuse for its size.
    ///
    /// # Errors
    ///
    /// [`SolidError::TooFine`], and errors of the numbers of shape and mosaic.
    pub fn memory_bytes(&self) -> Result<f64, SolidError> {
        self.validate()?;
        let area = self.shape.area()?;
        let slopes_mm = self.raised.as_ref().map_or(f64::INFINITY, Raised::edge_mm);
        let edge_mm = self.edge_mm(area).min(slopes_mm);
        let triangles = self.shape.count_of_triangles(edge_mm, area)?;
        let texels = f64::from(self.map_size) * f64::from(self.map_size);
        let painted = self.mosaic.as_ref().map_or(0.0, |pattern| {
            pattern.plan.memory_bytes() + texels * OF_A_TEXEL
        });
        Ok(triangles * OF_A_TRIANGLE + painted)
    }
}

impl Solid {
    /// Grows the body of a plan, or stops when `is_stopped` returns true.
    ///
    /// # Errors
    ///
    /// [`SolidError`] for the first stage whose numbers are out of range.
    pub fn grow(plan: &SolidPlan, is_stopped: &dyn Fn() -> bool) -> Result<Self, SolidError> {
        plan.validate()?;
        let area = plan.shape.area()?;
        let edge_mm = plan.edge_mm(area);
        let shape = plan.shape.triangles(edge_mm)?;
        let Some(pattern) = &plan.mosaic else {
            return Ok(Self::plain(shape, plan.contents));
        };
        // Imported meshes may be coarse, and faces that hold many cells take long.
        let coarse = Surface::new(shape.positions.clone(), shape.faces.clone())?;
        let (surface, ancestry) = coarse.subdivided(pattern.edge_mm(area))?;
        let (mosaic, field) = pattern.grow(&surface, plan.seed, is_stopped)?;
        let atlas = Atlas::new(&surface, plan.map_size, GUTTER)?;
        let texels = atlas.texels();
        let texel = |contents: Option<Contents>| contents.unwrap_or(plan.contents).to_texel();
        let mut contents = ContentsMap {
            width: texels,
            height: texels,
            texels: Vec::with_capacity(texels as usize * texels as usize),
        };
        // The map is painted band by band; in double precision the whole would take twice the
        // memory of the map.
        for band in (0..texels).step_by(BAND) {
            let rows = band * texels..(band + BAND as u32).min(texels) * texels;
            let shown = rows
                .into_par_iter()
                .map(|texel| atlas.shown(texel % texels, texel / texels));
            let painted = field.paint(shown, &pattern.contents);
            contents.texels.extend(painted.into_iter().map(texel));
        }
        let (fine, within_surface) = raised::fine(&surface, plan.raised.as_ref())?;
        let relief = plan.raised.as_ref().map(|raised| {
            let field = pattern.field(&mosaic, 2.0 * raised.over_mm)?;
            Ok::<_, SolidError>(Relief::new(raised, &field, (&fine, &within_surface)))
        });
        let relief = relief.transpose()?;
        let normal = |place: &SurfacePoint| {
            let within = ancestry.carry_back(place);
            let of_corners = shape.faces[within.face as usize];
            let [a, b, c] = of_corners.map(|vertex| shape.normals[vertex as usize]);
            let [u, v, w] = within.barycentric;
            let between = a * u + b * v + c * w;
            let flat = || surface.normal(place.face);
            between.try_normalize().unwrap_or_else(flat)
        };
        let uv = |place: &SurfacePoint| {
            let [a, b, c] = atlas.uvs()[place.face as usize];
            let [u, v, w] = place.barycentric;
            a * u + b * v + c * w
        };
        let (mut positions, mut normals, mut uvs) = (Vec::new(), Vec::new(), Vec::new());
        let mut triangles = Vec::with_capacity(fine.faces().len());
        // A point has one vertex for each combination of chart and normal that meets in it.
        let mut vertices: Vec<Vec<(DVec2, DVec3, u32)>> = vec![Vec::new(); fine.positions().len()];
        for (face, points) in (0..).zip(fine.faces()) {
            let mut triangle = [0; 3];
            for corner in 0..3 {
                let place = within_surface.carry_back(&SurfacePoint::corner(face, corner));
                let (point, uv, normal) = (points[corner] as usize, uv(&place), normal(&place));
                let known = &mut vertices[point];
                let found = known
                    .iter()
                    .find(|(other_uv, other, _)| *other_uv == uv && *other == normal);
                triangle[corner] = if let Some(&(.., vertex)) = found {
                    vertex
                } else {
                    let vertex = positions.len() as u32;
                    positions.push(fine.positions()[point]);
                    normals.push(normal);
                    uvs.push(uv);
                    known.push((uv, normal, vertex));
                    vertex
                };
            }
            triangles.push(triangle);
        }
        if let Some(relief) = &relief {
            for (point, vertices) in (0..).zip(&vertices) {
                // All vertices of a point move to one place, so that the body stays closed.
                let all: DVec3 = vertices.iter().map(|(_, normal, _)| *normal).sum();
                let mean = all.normalize_or_zero();
                for &(_, normal, vertex) in vertices {
                    let position = &mut positions[vertex as usize];
                    *position = relief.moved(point, *position, mean);
                    normals[vertex as usize] = relief.turned(point, normal);
                }
            }
        }
        Ok(Self {
            positions,
            normals,
            uvs,
            triangles,
            contents,
            mosaic: Some(mosaic),
        })
    }

    fn plain(shape: Shape, contents: Contents) -> Self {
        Self {
            uvs: vec![DVec2::splat(0.5); shape.positions.len()],
            positions: shape.positions,
            normals: shape.normals,
            triangles: shape.faces,
            contents: ContentsMap {
                width: 1,
                height: 1,
                texels: vec![contents.to_texel()],
            },
            mosaic: None,
        }
    }
}

#[cfg(test)]
mod tests;
