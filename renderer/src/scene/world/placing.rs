//! Placing of shapes: instances of meshes, with the object, material and light of each.

use std::collections::BTreeMap;

use glam::{DAffine3, DMat4};

use crate::geometry::Instance;
use crate::scene::description::{Description, InstancePlace, ObjectShape};
use crate::scene::plants::Piece;
use trace::world::WorldObjects;

/// The owner of a material.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MaterialOwner {
    /// The scene's material with this number.
    Scene(usize),
    /// A material of the leaf with the number `leaf`. Its different blades come first, then
    /// its stalks, then its hairs by kind.
    Leaf {
        /// Index into [`Description::leaves`].
        leaf: usize,
        /// Index of the material within the leaf.
        part: usize,
    },
    /// The body of solid tissue with this number.
    Solid(usize),
}

/// The parts of every shape, with meshes and materials as numbers in the world.
#[derive(Clone, Debug, Default)]
pub struct Pieces {
    /// The parts of each grown leaf; at least one.
    pub leaves: Vec<Vec<Piece>>,
    /// Each grown body.
    pub solids: Vec<Piece>,
}

impl Pieces {
    /// The parts of a shape; at least one.
    pub fn of(&self, shape: ObjectShape) -> Vec<Piece> {
        match shape {
            ObjectShape::Mesh { mesh, material } => vec![Piece {
                mesh,
                material,
                to_leaf: DAffine3::IDENTITY,
            }],
            ObjectShape::Leaf { leaf } => self.leaves[leaf].clone(),
            ObjectShape::Solid { solid } => vec![self.solids[solid]],
        }
    }
}

/// All instances, placed.
#[derive(Debug, Default)]
pub(super) struct Placed {
    pub(super) instances: Vec<Instance>,
    pub(super) objects: WorldObjects,
    /// The number of each object's first instance.
    pub(super) first: Vec<usize>,
}

impl Placed {
    fn put(&mut self, part: u32, place: u32, mesh: usize, to_world: &DAffine3) {
        self.instances.push(Instance::new(mesh as u32, to_world));
        self.objects.add(part, place);
    }

    /// Places a part of an object with one place.
    fn put_alone(&mut self, object: usize, piece: &Piece, to_world: DMat4) {
        let part = self.objects.add_part(object, piece.material);
        self.put(part, 0, piece.mesh, &carried(to_world, piece));
    }
}

/// Instances of every shape of the scene.
///
/// Their order is: the first part of each object with one place, the other parts of these objects,
/// then objects with instances. Of equally near hits the smaller number wins, so the order affects
/// the picture.
pub(super) fn place(
    scene: &Description,
    pieces: &Pieces,
    strewn: &BTreeMap<usize, Vec<InstancePlace>>,
) -> Placed {
    let mut placed = Placed {
        first: vec![0; scene.objects.len()],
        ..Placed::default()
    };
    // The number is exact unless leaves have several parts.
    let places_of = |number: usize| {
        let own = &scene.objects[number].value.instances;
        strewn.get(&number).or(own.as_ref())
    };
    let numbers = 0..scene.objects.len();
    let count = numbers.map(|number| places_of(number).map_or(1, Vec::len));
    let count = count.sum();
    placed.instances.reserve(count);
    placed.objects.reserve(count);
    let mut rest = Vec::new();
    let mut repeated = Vec::new();
    for (number, object) in scene.objects.iter().enumerate() {
        if let Some(places) = places_of(number) {
            repeated.push((number, places));
            continue;
        }
        placed.first[number] = placed.instances.len();
        let mut parts = pieces.of(object.value.shapes[0]).into_iter();
        let first = parts.next().expect("a shape has a part");
        placed.put_alone(number, &first, object.value.to_world);
        rest.extend(parts.map(|piece| (number, piece)));
    }
    for (number, piece) in rest {
        placed.put_alone(number, &piece, scene.objects[number].value.to_world);
    }
    for (number, places) in repeated {
        placed.first[number] = placed.instances.len();
        let shapes = &scene.objects[number].value.shapes;
        let shapes: Vec<Vec<(u32, Piece)>> = shapes
            .iter()
            .map(|shape| {
                let pieces = pieces.of(*shape).into_iter();
                pieces
                    .map(|piece| (placed.objects.add_part(number, piece.material), piece))
                    .collect()
            })
            .collect();
        for (place, at) in places.iter().enumerate() {
            let to_world = at.matrix();
            for (part, piece) in &shapes[at.shape as usize] {
                placed.put(*part, place as u32, piece.mesh, &carried(to_world, piece));
            }
        }
    }
    let objects = &scene.objects;
    placed
        .objects
        .hold_out(|number| objects[number].value.holdout);
    placed
}

/// The transform from a part's mesh to the scene, given that of its shape.
fn carried(to_world: DMat4, piece: &Piece) -> DAffine3 {
    DAffine3::from_mat4(to_world * DMat4::from(piece.to_leaf))
}
