//! What a file of a mesh holds before it is cleaned, and why it is no mesh.

use std::ops::Range;

use document::source::escaped;
use glam::{Vec2, Vec3};
use thiserror::Error;

use super::polygon::{self, Cover};
use crate::geometry::mesh::MeshError;

/// Greatest number of corners of a face.
pub(super) const MOST_CORNERS: usize = 1 << 16;

/// Why a file is not a mesh.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ImportError {
    /// The file's name does not end in `ply` or `obj`.
    #[error("cannot read meshes from .{extension} files; .ply and .obj can be read")]
    UnknownFormat {
        /// The end of the name.
        extension: String,
    },
    /// A line of text that cannot be understood.
    #[error("line {line}: {what}")]
    Line {
        /// Counted from 1.
        line: usize,
        /// What is wrong.
        what: String,
    },
    /// Binary data that cannot be understood.
    #[error("byte {byte}: {what}")]
    Byte {
        /// Counted from 0.
        byte: usize,
        /// What is wrong.
        what: String,
    },
    /// Nothing of the file can be read.
    #[error(
        "it has no polygons, only {surfaces} free-form surfaces, which are not read: convert them to \
         polygons in the program that made them"
    )]
    FreeForm {
        /// How many.
        surfaces: usize,
    },
    /// The file was read, but what it holds cannot be rendered.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}

/// A piece of the file for messages: quoted, safe to print, at most one line long.
pub(super) fn shown(text: &str) -> String {
    const MOST: usize = 60;
    format!("\"{}\"", escaped(text, MOST))
}

/// The contents of a file, before they are cleaned.
#[derive(Debug, Default)]
pub(super) struct RawMesh {
    pub(super) positions: Vec<Vec3>,
    pub(super) normals: Option<Vec<Vec3>>,
    pub(super) uvs: Option<Vec<Vec2>>,
    pub(super) triangles: Vec<[u32; 3]>,
    /// Those of the triangles that are the fan of a face with more corners.
    pub(super) fans: Vec<Range<usize>>,
    /// Number of faces that cross themselves.
    pub(super) crossing: usize,
    /// Free-form surfaces, which are left out.
    pub(super) free_form: usize,
}

impl RawMesh {
    /// Adds a face: as a fan of triangles around its first corner, until all positions are known.
    pub(super) fn push_face(&mut self, corners: &[u32]) {
        let first = self.triangles.len();
        for pair in corners[1..].windows(2) {
            self.triangles.push([corners[0], pair[0], pair[1]]);
        }
        if corners.len() > 3 {
            self.fans.push(first..self.triangles.len());
        }
    }

    /// Replaces the fans that do not cover their polygons.
    pub(super) fn triangulate(&mut self) {
        let mut covered: Vec<[u32; 3]> = Vec::new();
        let mut taken = 0;
        for fan in std::mem::take(&mut self.fans) {
            let own = &self.triangles[fan.clone()];
            let corners = own.iter().map(|triangle| triangle[2]);
            let corners: Vec<u32> = own[0][..2].iter().copied().chain(corners).collect();
            let places = corners
                .iter()
                .map(|&corner| self.positions.get(corner as usize));
            // A corner that is not there is an error later.
            let Some(places) = places
                .map(Option::<&Vec3>::copied)
                .collect::<Option<Vec<_>>>()
            else {
                continue;
            };
            let cover = polygon::cover(&places);
            self.crossing += usize::from(cover == Cover::Nothing);
            if let Cover::Triangles(better) = cover {
                covered.extend(&self.triangles[taken..fan.start]);
                let numbered = better.iter();
                covered.extend(numbered.map(|places| places.map(|place| corners[place])));
                taken = fan.end;
            }
        }
        if taken > 0 {
            covered.extend(&self.triangles[taken..]);
            self.triangles = covered;
        }
    }
}
