//! The blade as triangles.

mod smoothing;
#[cfg(test)]
mod testing;

use glam::{DVec2, DVec3};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

pub use super::error::BladeError;

use super::frame::UvFrame;
use super::plan::BladeForm;
use super::relief::Relief;
use super::size_field::SizeField;
use super::skeleton::Skeleton;
use super::stance::{Posture, Settled};
use super::triangulate::{Triangulation, triangulate};
use crate::plane::{polygon, segment};
use crate::shape::outline::Outline;
use crate::venation::network::{VeinSegment, VenationNetwork};

/// Greatest number of triangles of one blade.
pub(super) const MOST_TRIANGLES: usize = 4_000_000;

/// A sheet of triangles in space, with properties at each vertex.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct BladeMesh {
    /// Places, mm; base of the leaf at the origin, midrib along +y, adaxial side +z.
    pub positions: Vec<DVec3>,
    /// Unit normals on the adaxial side.
    pub normals: Vec<DVec3>,
    /// Texture coordinates, 0 to 1 over the box around the flat outline.
    pub uvs: Vec<DVec2>,
    /// Thickness of the sheet, mm, > 0.
    pub thickness_mm: Vec<f64>,
    /// Places on the flat lamina, mm, in the frame of the outline.
    pub lamina: Vec<DVec2>,
    /// How far each vertex is displaced along the blade's normal, mm: by veins (≤ 0) and by the
    /// bulge of the lamina between them.
    pub relief_mm: Vec<[f64; 2]>,
    /// Unit directions through the blade from the abaxial to the adaxial face, whatever its relief;
    /// none unless its form is closed.
    pub across: Vec<DVec3>,
    /// Vertices of each triangle, counter-clockwise seen from the adaxial side.
    pub triangles: Vec<[u32; 3]>,
}

/// What displaces the blade's points along its normal, mm.
#[derive(Clone, Copy)]
pub struct Displacement<'a> {
    /// The lips of tears: continuous but across cuts.
    pub lips: &'a (dyn Fn(DVec2) -> f64 + Sync),
    /// The bulge of the lamina, as smooth as the mesh's edges are long.
    pub bulge: &'a (dyn Fn(DVec2) -> f64 + Sync),
}

impl Displacement<'_> {
    /// None.
    pub const NONE: Self = Self {
        lips: &|_| 0.0,
        bulge: &|_| 0.0,
    };
}

/// A point of the flat lamina in space.
struct Raised {
    position: DVec3,
    across: Option<DVec3>,
    thickness: f64,
    relief: [f64; 2],
}

impl BladeMesh {
    /// Makes the blade of a leaf: cuts the lamina within `outline` into triangles with the major
    /// veins of `network` as edges, raises those veins, and bends the whole.
    ///
    /// # Errors
    ///
    /// [`BladeError`] if a field of `form` is out of range, if the mesh would be too large, or if
    /// the form turns the blade inside out.
    pub fn build(
        outline: &Outline,
        network: &VenationNetwork,
        form: &BladeForm,
    ) -> Result<Self, BladeError> {
        let frame = UvFrame::around(outline.points());
        let cut = (outline, &[][..], &frame);
        Self::build_holed(cut, network, form, None, Displacement::NONE)
    }

    /// As [`BladeMesh::build`], with holes: simple counter-clockwise polygons inside the margin, mm,
    /// that neither touch it nor each other. Texture coordinates are those of a frame, the blade
    /// has come to lie as `settled` says, and each flat point is `displaced` from that place.
    ///
    /// # Errors
    ///
    /// As [`BladeMesh::build`].
    pub(crate) fn build_holed(
        (outline, holes, frame): (&Outline, &[Vec<DVec2>], &UvFrame),
        network: &VenationNetwork,
        form: &BladeForm,
        settled: Option<&Settled>,
        displaced: Displacement<'_>,
    ) -> Result<Self, BladeError> {
        let veins: Vec<VeinSegment> = network.segments().collect();
        let posture = Posture::new(form, outline, (network.map(), &veins), settled);
        Self::within(
            (outline, holes, frame),
            &veins,
            form,
            &posture,
            settled.is_some(),
            displaced,
        )
    }

    fn within(
        (outline, holes, frame): (&Outline, &[Vec<DVec2>], &UvFrame),
        veins: &[VeinSegment],
        form: &BladeForm,
        posture: &Posture<'_>,
        is_settled: bool,
        displaced: Displacement<'_>,
    ) -> Result<Self, BladeError> {
        form.validate()?;
        let major = form.major(veins);
        let size = SizeField::new(form, &major);
        let skeleton = if holes.is_empty() {
            Skeleton::new(outline, &size, &major)
        } else {
            let clear = clear_of(holes, &major, &size);
            Skeleton::new(outline, &size, &clear)
        };
        let flat = triangulate(outline, holes, &size, &skeleton, MOST_TRIANGLES)?;
        let relief = Relief::new(form, &major);
        let mut mesh = Self::raised(flat, frame, |p| {
            let height = relief.height(p);
            let bulge = (displaced.bulge)(p);
            let thinner = if form.margin.is_even() {
                1.0
            } else {
                form.margin.at(outline.distance_to_margin(p))
            };
            let raised = (displaced.lips)(p) + bulge - height;
            let thickness = form.thickness_mm * thinner + height;
            let across = form.closed.then(|| {
                let [above, below] =
                    [0.5, -0.5].map(|side| posture.place(p, raised + side * thickness));
                (above - below).normalize_or(DVec3::Z)
            });
            Raised {
                position: posture.place(p, raised),
                across,
                thickness,
                relief: [-height, bulge],
            }
        });
        if is_settled {
            mesh.smooth_turned_over();
        }
        let faces = mesh.turned_over().count();
        if faces > 0 {
            return Err(BladeError::TurnedOver(faces));
        }
        Ok(mesh)
    }

    /// A flat triangulation brought into space by `place`.
    fn raised(
        flat: Triangulation,
        frame: &UvFrame,
        place: impl Fn(DVec2) -> Raised + Sync,
    ) -> Self {
        let raised: Vec<Raised> = flat.points.par_iter().map(|&p| place(p)).collect();
        let positions: Vec<DVec3> = raised.iter().map(|raised| raised.position).collect();
        let normals = vertex_normals(&positions, &flat.triangles);
        Self {
            normals,
            positions,
            thickness_mm: raised.iter().map(|raised| raised.thickness).collect(),
            uvs: flat.points.iter().map(|&p| frame.uv(p)).collect(),
            lamina: flat.points,
            relief_mm: raised.iter().map(|raised| raised.relief).collect(),
            across: raised.iter().filter_map(|raised| raised.across).collect(),
            triangles: flat.triangles,
        }
    }

    /// The triangles that face away from a normal of their corners.
    pub(super) fn turned_over(&self) -> impl Iterator<Item = &[u32; 3]> {
        self.triangles.iter().filter(|t| !self.faces_out(t))
    }

    /// Whether a triangle faces the same way as its vertices' normals.
    fn faces_out(&self, triangle: &[u32; 3]) -> bool {
        let normal = face_normal(triangle.map(|v| self.positions[v as usize]));
        triangle
            .iter()
            .all(|&v| normal.dot(self.normals[v as usize]) > 0.0)
    }
}

/// Veins that keep clear of holes, so that the mesh has no slivers there.
fn clear_of(holes: &[Vec<DVec2>], veins: &[VeinSegment], size: &SizeField) -> Vec<VeinSegment> {
    let is_clear = |p: DVec2| {
        let near = 0.8 * size.at(p);
        let mut sides = holes.iter().flat_map(|hole| polygon::sides(hole));
        sides.all(|(a, b)| segment::distance(a, b, p) > near)
    };
    let veins = veins.iter().copied();
    veins
        .filter(|vein| is_clear(vein.from) && is_clear(vein.to))
        .collect()
}

fn face_normal([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a)
}

/// Mean of the normals of the faces at each vertex, weighted by their angles there: independent of
/// how a flat part is cut into triangles.
pub(super) fn vertex_normals(positions: &[DVec3], triangles: &[[u32; 3]]) -> Vec<DVec3> {
    let mut sums = vec![DVec3::ZERO; positions.len()];
    for triangle in triangles {
        let corners = triangle.map(|v| positions[v as usize]);
        let normal = face_normal(corners).normalize_or_zero();
        for i in 0..3 {
            let [at, next, last] = [0, 1, 2].map(|j| corners[(i + j) % 3]);
            let (u, v) = (next - at, last - at);
            let angle = libm::atan2(u.cross(v).length(), u.dot(v));
            sums[triangle[i] as usize] += normal * angle;
        }
    }
    sums.iter().map(|sum| sum.normalize_or(DVec3::Z)).collect()
}
