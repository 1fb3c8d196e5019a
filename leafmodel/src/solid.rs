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
//! let fruit = Solid::grow(&plan)?;
//! let highest = fruit.positions.iter().map(|p| p.z).fold(0.0, f64::max);
//! assert!((highest - 30.0).abs() < 0.5, "{highest} mm");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod raised;
mod shape;

use glam::{DVec2, DVec3};
use rayon::prelude::*;

pub use self::raised::Raised;
use self::raised::Relief;
pub use self::shape::{SolidMesh, SolidShape};
use crate::blade::contents_map::ContentsMap;
use crate::document::{Declared, Keys};
use crate::grow_options::GrowOptions;
use crate::mosaic::atlas::Atlas;
use crate::mosaic::pattern::MosaicPattern;
use crate::mosaic::shapes::Shape;
use crate::mosaic::{Mosaic, Surface, SurfacePoint};
use crate::not_grown::NotGrown;
use crate::optics::contents_keys::{changed_contents, refuse_unknown_absorption, warn_of_mixture};
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
const OF_A_TEXEL: f64 = 144.0;

/// The plan of a body.
#[derive(Clone, Debug, Declared, PartialEq)]
#[key(last = check_contents)]
pub struct SolidPlan {
    /// Same plan and seed, same body, bit for bit.
    #[key("seed")]
    pub seed: u64,
    /// Texels of the map of contents along a side; a body without a mosaic needs none.
    #[key("map_size", 16..=8192)]
    pub map_size: u32,
    /// Its shape.
    #[key("shape", required, block, about = "See below.")]
    pub shape: SolidShape,
    /// What the outer tissue holds per area of the surface, see below.
    #[key("contents", required, block, with = held_contents)]
    pub contents: Contents,
    /// Its cells, if it has some.
    #[key(with = skin)]
    pub mosaic: Option<MosaicPattern>,
    /// Tissue of cells that stands out, or lies below.
    #[key(with = raised)]
    pub raised: Option<Raised>,
    /// What its constituents absorb.
    #[key("pigments", block)]
    pub pigments: Pigments,
}

impl Default for SolidPlan {
    fn default() -> Self {
        Self {
            seed: 0,
            map_size: 1024,
            shape: SolidShape::Sphere { radius_mm: 1.0 },
            contents: Contents::NOTHING,
            mosaic: None,
            raised: None,
            pigments: Pigments::default(),
        }
    }
}

fn skin(plan: &mut SolidPlan, keys: &mut Keys<'_>) {
    let (base, mosaic) = (plan.contents, &mut plan.mosaic);
    let about = "Cells of several types.";
    keys.optional_block(
        "mosaic",
        mosaic,
        Default::default,
        about,
        |pattern, keys| {
            pattern.keys(keys, base);
        },
    );
    if keys.has_path(&["mosaic", "faces"]) {
        let problem = "a body of solid tissue has one skin, not two faces".to_owned();
        keys.refuse(&["mosaic", "faces"], problem, "leave `faces` out");
    }
}

fn raised(plan: &mut SolidPlan, keys: &mut Keys<'_>) {
    let types = plan.mosaic.iter().flat_map(|mosaic| &mosaic.plan.types);
    let names: Vec<String> = types.map(|one| one.name.clone()).collect();
    let about = "Cells whose tissue stands out from the shape, as warts do, or lies below it.";
    let raised = &mut plan.raised;
    keys.optional_block("raised", raised, Default::default, about, |raised, keys| {
        raised.keys(keys, &names);
    });
}

/// The keys of what solid tissue holds; a key that is left out means none.
pub fn held_contents(contents: &mut Contents, keys: &mut Keys<'_>) {
    changed_contents(contents, keys);
    warn_of_mixture(contents, keys, "this tissue holds");
}

/// Refuses what the model does not have, and warns of anthocyanins and betalains in unlike cells of
/// one body; those of the body itself are reported with its contents.
fn check_contents(plan: &mut SolidPlan, keys: &mut Keys<'_>) {
    if !keys.is_sound() {
        return;
    }
    refuse_unknown_absorption(&plan.pigments, &plan.contents, keys);
    let cells = plan.mosaic.iter().flat_map(|mosaic| &mosaic.contents);
    // Under a mosaic the body itself shows only where no cell may be.
    let shows = |mosaic: &MosaicPattern| mosaic.may_leave_bare();
    let own = plan.mosaic.as_ref().is_none_or(shows);
    let parts = own.then_some(&plan.contents).into_iter().chain(cells);
    if plan.contents.mixes_betalains_and_anthocyanins() {
        return;
    }
    let most = parts.fold(Contents::NOTHING, |most, part| {
        Contents(most.zip_with(part.0, f64::max))
    });
    warn_of_mixture(&most, keys, "cells of this body hold");
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

/// An error of a part of the plan.
fn of(part: &str) -> impl Fn(NotGrown) -> NotGrown {
    move |error| NotGrown::of(part, error)
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
    fn validate(&self) -> Result<(), NotGrown> {
        if let Some(pattern) = &self.mosaic {
            pattern.validate().map_err(of("mosaic"))?;
        }
        let Some(raised) = &self.raised else {
            return Ok(());
        };
        let types = self.mosaic.as_ref().map(|pattern| pattern.plan.types.len());
        raised.validate(types).map_err(of("raised"))
    }

    /// Estimates the memory that the body takes, bytes, and refuses what [`Solid::grow`] would
    /// refuse for its size.
    ///
    /// # Errors
    ///
    /// [`NotGrown`] if it is too fine, and errors of the numbers of shape and mosaic.
    pub fn memory_bytes(&self) -> Result<f64, NotGrown> {
        self.validate()?;
        let area = self.shape.area().map_err(of("shape"))?;
        let slopes_mm = self.raised.as_ref().map_or(f64::INFINITY, Raised::edge_mm);
        let edge_mm = self.edge_mm(area).min(slopes_mm);
        let triangles = self.shape.count_of_triangles(edge_mm, area);
        let triangles = triangles.map_err(of("shape"))?;
        let texels = f64::from(self.map_size) * f64::from(self.map_size);
        let painted = self.mosaic.as_ref().map_or(0.0, |pattern| {
            pattern.plan.memory_bytes() + texels * OF_A_TEXEL
        });
        Ok(triangles * OF_A_TRIANGLE + painted)
    }
}

impl GrowOptions<'_> {
    /// The body of a plan.
    ///
    /// # Errors
    ///
    /// As [`Solid::grow`]; one that [is a stop](NotGrown::is_stop).
    pub fn solid(self, plan: &SolidPlan) -> Result<Solid, NotGrown> {
        Solid::grow_with(plan, self)
    }
}

impl Solid {
    /// Grows the body of a plan with default [`GrowOptions`].
    ///
    /// # Errors
    ///
    /// [`NotGrown`] for the first stage whose numbers are out of range.
    pub fn grow(plan: &SolidPlan) -> Result<Self, NotGrown> {
        Self::grow_with(plan, GrowOptions::default())
    }

    fn grow_with(plan: &SolidPlan, options: GrowOptions<'_>) -> Result<Self, NotGrown> {
        plan.validate()?;
        let area = plan.shape.area().map_err(of("shape"))?;
        let edge_mm = plan.edge_mm(area);
        let shape = plan.shape.triangles(edge_mm).map_err(of("shape"))?;
        let Some(pattern) = &plan.mosaic else {
            return Ok(Self::plain(shape, plan.contents));
        };
        // Imported meshes may be coarse, and faces that hold many cells take long.
        let coarse = Surface::new(shape.positions.clone(), shape.faces.clone());
        let coarse = coarse.map_err(of("shape"))?;
        let (surface, ancestry) = coarse
            .subdivided(pattern.edge_mm(area))
            .map_err(of("shape"))?;
        let (mosaic, field) = pattern
            .grow(&surface, plan.seed, options)
            .map_err(|error| error.in_part("mosaic"))?;
        let atlas = Atlas::new(&surface, plan.map_size, GUTTER).map_err(of("map_size"))?;
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
        let (fine, within_surface) =
            raised::fine(&surface, plan.raised.as_ref()).map_err(of("shape"))?;
        let relief = plan.raised.as_ref().map(|raised| {
            let field = pattern
                .field(&mosaic, 2.0 * raised.over_mm)
                .map_err(of("mosaic"))?;
            Ok::<_, NotGrown>(Relief::new(raised, &field, (&fine, &within_surface)))
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
