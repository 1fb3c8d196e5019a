//! Bodies of solid tissue: fruits, stems, caps of mushrooms.
//!
//! - **In**: a shape, the contents of its outer tissue, and a mosaic if it has one.
//! - **Out**: a mesh with texture coordinates, and a map of contents over them.
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
//!     pigments: Pigments::default(),
//!     map_size: 16,
//! };
//! let fruit = Solid::grow(&plan, &|| false)?;
//! let highest = fruit.positions.iter().map(|p| p.z).fold(0.0, f64::max);
//! assert!((highest - 30.0).abs() < 0.5, "{highest} mm");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod shape;

use glam::{DVec2, DVec3};
use rayon::prelude::*;
use thiserror::Error;

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
    /// The body is too slender, or has too many cells, for the allowed number of triangles.
    #[error(
        "shape: it would take about {triangles:.0} triangles, too many: make the body less slender, or give its mosaic fewer cells"
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

    /// Estimates the memory that the body takes, bytes, and refuses what [`Solid::grow`] would
    /// refuse for its size.
    ///
    /// # Errors
    ///
    /// [`SolidError::TooFine`], and errors of the numbers of shape and mosaic.
    pub fn memory_bytes(&self) -> Result<f64, SolidError> {
        if let Some(pattern) = &self.mosaic {
            pattern.validate()?;
        }
        let area = self.shape.area()?;
        let triangles = self.shape.count_of_triangles(self.edge_mm(area), area)?;
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
        if let Some(pattern) = &plan.mosaic {
            pattern.validate()?;
        }
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
        let normal = |face: u32, corner: usize| {
            let mut barycentric = [0.0; 3];
            barycentric[corner] = 1.0;
            let within = ancestry.carry_back(&SurfacePoint { face, barycentric });
            let of_corners = shape.faces[within.face as usize];
            let [a, b, c] = of_corners.map(|vertex| shape.normals[vertex as usize]);
            let [u, v, w] = within.barycentric;
            let between = a * u + b * v + c * w;
            between.try_normalize().unwrap_or(surface.normal(face))
        };
        let (mut positions, mut normals, mut uvs) = (Vec::new(), Vec::new(), Vec::new());
        let mut triangles = Vec::with_capacity(surface.faces().len());
        // A point has one vertex for each combination of chart and normal that meets in it.
        let mut vertices: Vec<Vec<(DVec2, DVec3, u32)>> =
            vec![Vec::new(); surface.positions().len()];
        for (face, (points, corners)) in (0..).zip(surface.faces().iter().zip(atlas.uvs())) {
            let mut triangle = [0; 3];
            for corner in 0..3 {
                let (point, uv) = (points[corner] as usize, corners[corner]);
                let normal = normal(face, corner);
                let known = &mut vertices[point];
                let found = known
                    .iter()
                    .find(|(other_uv, other, _)| *other_uv == uv && *other == normal);
                triangle[corner] = if let Some(&(.., vertex)) = found {
                    vertex
                } else {
                    let vertex = positions.len() as u32;
                    positions.push(surface.positions()[point]);
                    normals.push(normal);
                    uvs.push(uv);
                    known.push((uv, normal, vertex));
                    vertex
                };
            }
            triangles.push(triangle);
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
