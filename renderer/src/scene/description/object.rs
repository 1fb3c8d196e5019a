//! What stands in a scene, and where.

use glam::{DMat4, DVec3, Mat3};

use crate::geometry::scatter::{Scatter, Volume};

/// Meshes, leaves or bodies placed in the scene: one shape in one place, or any number of
/// instances.
#[derive(Clone, Debug)]
pub struct Object {
    /// Its shapes, at least one. Without instances there is exactly one.
    pub shapes: Vec<ObjectShape>,
    /// Local to world, metres, affine and invertible. For instances, the frame in which their
    /// places are given; for what is strewn, what is done with the shape before.
    pub to_world: DMat4,
    /// The places of instances; `None` means the single place `to_world`.
    pub instances: Option<Vec<InstancePlace>>,
    /// Where it is strewn; its places follow when the world is built. The parts of a plant then
    /// have their places in the plant's frame.
    pub strewn: Option<Box<StrewnOn>>,
    /// The box in which copies of it float; their places follow when the world is built.
    pub volume: Option<Box<Volume>>,
}

impl Object {
    /// The mesh of its first shape, index into [`Description::meshes`](super::Description::meshes).
    pub fn first_mesh(&self) -> Option<usize> {
        match self.shapes.first()? {
            ObjectShape::Mesh { mesh, .. } => Some(*mesh),
            ObjectShape::Leaf { .. } | ObjectShape::Solid { .. } => None,
        }
    }

    /// Whether its places are found when the world is built.
    pub fn is_spread(&self) -> bool {
        self.strewn.is_some() || self.volume.is_some()
    }
}

/// Where copies of an object are strewn.
#[derive(Clone, Debug)]
pub struct StrewnOn {
    /// The object on which they lie.
    pub on: usize,
    /// Further objects that what comes to rest does not fall through.
    pub over: Vec<usize>,
    /// How many and how.
    pub plan: Scatter,
    /// Different leaves of each kind that are grown.
    pub individuals: u32,
    /// The days of ageing of the first and the last of these; `None` leaves them as they are.
    pub days: Option<[f64; 2]>,
}

/// The place and shape of one instance of an object.
///
/// It takes 64 bytes, since a scene may have millions. Directions and sizes are in single precision,
/// the place itself in double precision, so that it is exact anywhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InstancePlace {
    /// Index into [`Object::shapes`].
    pub shape: u32,
    /// Linear part of the transform from the shape's frame to the scene's, [`Object::to_world`]
    /// included.
    pub linear: Mat3,
    /// Where the origin of the shape's frame lies in the scene, m.
    pub translation: DVec3,
}

impl InstancePlace {
    /// A shape in the scene.
    pub fn new(shape: u32, to_world: DMat4) -> Self {
        Self {
            shape,
            linear: Mat3::from_mat4(to_world.as_mat4()),
            translation: to_world.w_axis.truncate(),
        }
    }

    /// Local to world.
    pub fn matrix(&self) -> DMat4 {
        DMat4::from_mat3_translation(self.linear.as_dmat3(), self.translation)
    }
}

/// The shape of an object.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ObjectShape {
    /// A mesh with a material.
    Mesh {
        /// Index into [`Description::meshes`](super::Description::meshes).
        mesh: usize,
        /// Index into [`Description::materials`](super::Description::materials).
        material: usize,
    },
    /// A grown leaf (base at the origin, midrib along +y, adaxial side +z).
    Leaf {
        /// Index into [`Description::leaves`](super::Description::leaves).
        leaf: usize,
    },
    /// A grown body of solid tissue, in the frame of its shape.
    Solid {
        /// Index into [`Description::solids`](super::Description::solids).
        solid: usize,
    },
}
