//! Triangle meshes, checked and cleaned for tracing.

mod closed;

use std::fmt;

use glam::{DVec3, Vec2, Vec3};
use thiserror::Error;

use super::bounds::Bounds;
use crate::sampling::mixer::scramble;

/// Greatest coordinate, m. Beyond it `f32` resolves no useful detail, and squares approach
/// overflow.
const FARTHEST: f32 = 1e9;

/// Size of a mesh over its distance from its origin below which lost faces are laid to that: a
/// hundred steps of `f32`.
const LEAST_DETAIL: f32 = 1e-5;

/// Largest coordinate below which lost faces are not laid to distance, m.
const FAR: f32 = 100.0;

/// Face numbers and tree nodes share 32 bits.
const MOST_FACES: usize = 1 << 29;

/// Greatest fraction of faces, per cent, that may be dropped because they are not finite or
/// duplicate; a mesh that loses more is refused. Faces without area are never missed.
const MOST_DROPPED_PERCENT: usize = 1;

/// Triangles over shared vertices. All are finite and have an area above 0, and no two have the
/// same three positions.
#[derive(Clone, Debug)]
pub struct TriangleMesh {
    positions: Vec<Vec3>,
    normals: Option<Vec<Vec3>>,
    uvs: Option<Vec<Vec2>>,
    colours: Option<Vec<[f32; 3]>>,
    tangents: Option<Vec<[f32; 4]>>,
    triangles: Vec<[u32; 3]>,
    dropped: DroppedFaces,
    crossing: usize,
    bounds: Bounds,
}

/// Why a face was left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DropCause {
    /// One of its positions or uvs is NaN or infinite.
    NotFinite,
    /// Its three positions lie on a line.
    Degenerate,
    /// An earlier face has the same three positions, in whatever order.
    Duplicate,
}

/// How many faces were left out of a mesh, and why.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DroppedFaces {
    /// Faces with a NaN or infinite position or uv.
    pub not_finite: usize,
    /// Faces without area.
    pub degenerate: usize,
    /// Faces on the three positions of an earlier face.
    pub duplicate: usize,
    /// Free-form surfaces of its file, which are not read.
    pub free_form: usize,
    /// Number of the first face that was left out, in the order given, and why. One without area
    /// counts only if there are no others.
    pub first: Option<(usize, DropCause)>,
}

impl fmt::Display for DroppedFaces {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} {} left out ({} not finite, {} without area, {} duplicate",
            self.total(),
            if self.total() == 1 { "face" } else { "faces" },
            self.not_finite,
            self.degenerate,
            self.duplicate
        )?;
        if self.free_form > 0 {
            write!(
                f,
                ", {} free-form surfaces, which are not read",
                self.free_form
            )?;
        }
        f.write_str(")")
    }
}

impl DroppedFaces {
    /// Number of dropped faces.
    pub fn total(&self) -> usize {
        self.not_finite + self.degenerate + self.duplicate + self.free_form
    }

    /// Number of dropped faces that should not be in a file: without those that have no area.
    fn damaged(&self) -> usize {
        self.not_finite + self.duplicate
    }

    fn record(&mut self, face: usize, cause: DropCause) {
        match cause {
            DropCause::NotFinite => self.not_finite += 1,
            DropCause::Degenerate => self.degenerate += 1,
            DropCause::Duplicate => self.duplicate += 1,
        }
        let rank = |face: usize, cause: DropCause| (cause == DropCause::Degenerate, face);
        if self
            .first
            .is_none_or(|(first, of)| rank(face, cause) < rank(first, of))
        {
            self.first = Some((face, cause));
        }
    }
}

/// Why a mesh was refused.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum MeshError {
    /// There are no faces, or none are left.
    #[error(
        "the mesh has no face that can be rendered ({} given: {} not finite, {} without area, {} duplicate)",
        .given, .dropped.not_finite, .dropped.degenerate, .dropped.duplicate
    )]
    Empty {
        /// Number of faces given.
        given: usize,
        /// The dropped faces.
        dropped: DroppedFaces,
    },
    /// More than 1 % of the faces are not finite or duplicate.
    #[error(
        "{} of {given} faces cannot be rendered, more than 1 % ({} not finite, {} without area, {} duplicate; \
         the first is face {})",
        .dropped.total(), .dropped.not_finite, .dropped.degenerate, .dropped.duplicate,
        .dropped.first.map_or(0, |(face, _)| face)
    )]
    TooManyDropped {
        /// Number of faces given.
        given: usize,
        /// The dropped faces.
        dropped: DroppedFaces,
    },
    /// A face refers to a vertex that does not exist.
    #[error("face {face} names vertex {index}, but there are {vertices} vertices (counted from 0)")]
    IndexOutOfRange {
        /// Number of the face.
        face: usize,
        /// The missing vertex.
        index: u32,
        /// Number of vertices.
        vertices: usize,
    },
    /// The number of normals or uvs differs from that of vertices.
    #[error("the mesh has {count} {attribute} for {vertices} vertices")]
    AttributeCount {
        /// "normals" or "uvs".
        attribute: &'static str,
        /// How many there are.
        count: usize,
        /// Number of vertices.
        vertices: usize,
    },
    /// A face reaches beyond 10⁹ m.
    #[error(
        "face {face} reaches {reach:e} m from the origin; at most 1e9 m keeps detail in 32-bit numbers"
    )]
    TooFar {
        /// Number of the face.
        face: usize,
        /// Largest coordinate in it.
        reach: f32,
    },
    /// Most of its detail is lost in `f32`, since it is small and far from its origin.
    #[error(
        "the mesh reaches {reach:e} m from its origin and is small: 32-bit numbers keep no detail of it \
         there, move it to its origin"
    )]
    DetailLost {
        /// Largest coordinate, m.
        reach: f32,
    },
    /// There are more faces than can be numbered.
    #[error("the mesh has {given} faces; the most is {MOST_FACES}")]
    TooLarge {
        /// Number of faces given.
        given: usize,
    },
}

impl TriangleMesh {
    /// Checks and cleans a mesh. Faces are counter-clockwise seen from their + side.
    ///
    /// Positions are in metres. There is one normal and one uv per vertex, if given. Normals may
    /// have any length; one that is zero or not finite is replaced by that of the face. Faces that
    /// are not finite, have no area or repeat an earlier face's three positions are left out and
    /// counted in [`TriangleMesh::dropped`].
    ///
    /// # Errors
    ///
    /// [`MeshError`]: for an index out of range, attributes that do not match, more than 1 % of the
    /// faces not finite or duplicate, no face left, coordinates beyond 10⁹ m, too many faces.
    pub fn new(
        positions: Vec<Vec3>,
        normals: Option<Vec<Vec3>>,
        uvs: Option<Vec<Vec2>>,
        mut triangles: Vec<[u32; 3]>,
    ) -> Result<Self, MeshError> {
        let given = triangles.len();
        let vertices = positions.len();
        let counts = [
            ("normals", normals.as_ref().map(Vec::len)),
            ("uvs", uvs.as_ref().map(Vec::len)),
        ];
        for (attribute, count) in counts {
            if let Some(count) = count.filter(|&count| count != vertices) {
                return Err(MeshError::AttributeCount {
                    attribute,
                    count,
                    vertices,
                });
            }
        }
        if given > MOST_FACES {
            return Err(MeshError::TooLarge { given });
        }

        let mut dropped = DroppedFaces::default();
        let mut kept = Vec::with_capacity(given);
        for (face, triangle) in triangles.iter().enumerate() {
            if let Some(&index) = triangle.iter().find(|&&index| index as usize >= vertices) {
                return Err(MeshError::IndexOutOfRange {
                    face,
                    index,
                    vertices,
                });
            }
            let corners = triangle.map(|index| positions[index as usize]);
            let uv_finite = |index: &u32| {
                uvs.as_ref()
                    .is_none_or(|uvs| uvs[*index as usize].is_finite())
            };
            if !corners.iter().all(|corner| corner.is_finite()) || !triangle.iter().all(uv_finite) {
                dropped.record(face, DropCause::NotFinite);
                continue;
            }
            let reach = corners
                .iter()
                .fold(0.0, |reach: f32, c| reach.max(c.abs().max_element()));
            if reach > FARTHEST {
                return Err(MeshError::TooFar { face, reach });
            }
            if double_area(corners) == 0.0 {
                dropped.record(face, DropCause::Degenerate);
                continue;
            }
            kept.push(face as u32);
        }
        let duplicates = duplicates(&kept, &triangles, &positions);
        for &face in &duplicates {
            dropped.record(face as usize, DropCause::Duplicate);
        }
        kept.retain(|face| duplicates.binary_search(face).is_err());

        let is_many = |faces: usize| faces * 100 > given * MOST_DROPPED_PERCENT;
        if dropped.degenerate > 0 && (kept.is_empty() || is_many(dropped.degenerate)) {
            let corners = triangles.iter().flatten();
            let corners = corners.map(|&index| positions[index as usize]);
            let bounds = Bounds::around(corners.filter(|corner| corner.is_finite()));
            let extent = (bounds.max - bounds.min).max_element();
            let reach = bounds.max.abs().max(bounds.min.abs()).max_element();
            if reach > FAR && extent < LEAST_DETAIL * reach {
                return Err(MeshError::DetailLost { reach });
            }
        }
        if kept.is_empty() {
            return Err(MeshError::Empty { given, dropped });
        }
        if is_many(dropped.damaged()) {
            return Err(MeshError::TooManyDropped { given, dropped });
        }
        let mut faces = 0_u32..;
        let mut kept = kept.into_iter().peekable();
        triangles.retain(|_| {
            faces
                .next()
                .is_some_and(|face| kept.next_if_eq(&face).is_some())
        });
        let bounds = Bounds::around(
            triangles
                .iter()
                .flatten()
                .map(|&index| positions[index as usize]),
        );
        Ok(Self {
            positions,
            normals,
            uvs,
            colours: None,
            tangents: None,
            triangles,
            dropped,
            crossing: 0,
            bounds,
        })
    }

    /// The same mesh with a colour for each vertex.
    ///
    /// # Panics
    ///
    /// If there are not as many colours as vertices.
    #[must_use]
    pub fn with_colours(self, colours: Vec<[f32; 3]>) -> Self {
        assert_eq!(colours.len(), self.positions.len(), "one for each vertex");
        Self {
            colours: Some(colours),
            ..self
        }
    }

    /// Vertices, m. Vertices that no face uses may hold any value.
    pub fn positions(&self) -> &[Vec3] {
        &self.positions
    }

    /// Normals as given, one per vertex, of any length; one that is zero or not finite is replaced
    /// by that of the face.
    pub fn normals(&self) -> Option<&[Vec3]> {
        self.normals.as_deref()
    }

    /// Texture coordinates, one per vertex.
    pub fn uvs(&self) -> Option<&[Vec2]> {
        self.uvs.as_deref()
    }

    /// Colours, one per vertex: factors on the colours of a material, linear sRGB in [0, 1].
    pub fn colours(&self) -> Option<&[[f32; 3]]> {
        self.colours.as_deref()
    }

    /// Tangents, one per vertex: the direction of a map's x axis, of any length, and the sign with which
    /// the normal times that direction is its y axis. Zero where the texture coordinates have to do.
    pub fn tangents(&self) -> Option<&[[f32; 4]]> {
        self.tangents.as_deref()
    }

    /// Faces as vertex numbers, counter-clockwise seen from the + side.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// The mesh of a file that has so many free-form surfaces too.
    pub(super) fn beside_free_form(mut self, surfaces: usize) -> Self {
        self.dropped.free_form = surfaces;
        self
    }

    /// Faces that were left out.
    pub fn dropped(&self) -> DroppedFaces {
        self.dropped
    }

    /// The same mesh with a tangent for each vertex.
    ///
    /// # Panics
    ///
    /// If there are not as many tangents as vertices.
    #[must_use]
    pub fn with_tangents(self, tangents: Vec<[f32; 4]>) -> Self {
        assert_eq!(tangents.len(), self.positions.len(), "one for each vertex");
        Self {
            tangents: Some(tangents),
            ..self
        }
    }

    /// The same mesh from a file in which so many faces cross themselves.
    #[must_use]
    pub(super) fn with_crossing(self, crossing: usize) -> Self {
        Self { crossing, ..self }
    }

    /// What a user should know of its faces: those that were left out, and those that cross
    /// themselves.
    pub fn remarks(&self) -> Vec<String> {
        let dropped = (self.dropped.total() > 0).then(|| self.dropped.to_string());
        let crossing = match self.crossing {
            0 => None,
            1 => Some("1 face crosses itself, and is a fan of triangles".to_owned()),
            more => Some(format!(
                "{more} faces cross themselves, and are fans of triangles"
            )),
        };
        dropped.into_iter().chain(crossing).collect()
    }

    /// Smallest and largest coordinates of the faces, m.
    pub fn bounds(&self) -> (Vec3, Vec3) {
        (self.bounds.min, self.bounds.max)
    }

    /// Positions of a face.
    pub(super) fn corners(&self, triangle: u32) -> [Vec3; 3] {
        self.triangles[triangle as usize].map(|index| self.positions[index as usize])
    }

    pub(super) fn memory_bytes(&self) -> usize {
        fn bytes<T>(of_vertices: Option<&Vec<T>>) -> usize {
            of_vertices.map_or(0, |own| own.capacity() * size_of::<T>())
        }
        bytes(Some(&self.positions))
            + bytes(self.normals.as_ref())
            + bytes(self.uvs.as_ref())
            + bytes(self.colours.as_ref())
            + bytes(self.tangents.as_ref())
            + bytes(Some(&self.triangles))
    }
}

/// Twice the area of a triangle. Differences of `f32` numbers and their products are exact in `f64`
/// unless their magnitudes differ widely, so this is 0 for collinear points and only for them.
fn double_area(corners: [Vec3; 3]) -> f64 {
    let [a, b, c] = corners.map(Vec3::as_dvec3);
    DVec3::cross(b - a, c - a).length()
}

/// The faces among `faces` (in rising order) whose three positions an earlier face has too, in
/// rising order.
fn duplicates(faces: &[u32], triangles: &[[u32; 3]], positions: &[Vec3]) -> Vec<u32> {
    // Adding 0 makes −0 and 0 the same bits.
    let key = |face: u32| {
        let mut corners = triangles[face as usize].map(|index| {
            (positions[index as usize] + Vec3::ZERO)
                .to_array()
                .map(f32::to_bits)
        });
        corners.sort_unstable();
        corners
    };
    let mut hashed: Vec<(u64, u32)> = faces
        .iter()
        .map(|&face| {
            let words = key(face).into_iter().flatten();
            (
                words.fold(0, |hash, word| scramble(hash ^ u64::from(word))),
                face,
            )
        })
        .collect();
    hashed.sort_unstable();
    let mut found = Vec::new();
    for run in hashed
        .chunk_by(|a, b| a.0 == b.0)
        .filter(|run| run.len() > 1)
    {
        let mut keyed: Vec<_> = run.iter().map(|&(_, face)| (key(face), face)).collect();
        keyed.sort_unstable();
        for same in keyed.chunk_by(|a, b| a.0 == b.0) {
            found.extend(same[1..].iter().map(|&(_, face)| face));
        }
    }
    found.sort_unstable();
    found
}

#[cfg(test)]
mod tests;
