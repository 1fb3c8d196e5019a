//! Placing of shapes: instances of meshes, with the object, material and light of each.

use std::collections::BTreeMap;
use std::ops::Index;

use glam::{DAffine3, DMat4};

use crate::geometry::Instance;
use crate::medium::{Body, BodyPlace};
use crate::scene::description::{Description, InstancePlace, ObjectShape};
use crate::scene::plants::Piece;

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

/// The object, material and light of an instance.
#[derive(Clone, Copy, Debug)]
pub struct WorldObject {
    /// Number of the object in the scene.
    pub object: usize,
    /// Number of its material.
    pub material: usize,
    /// Number of its light, if it emits light.
    pub light: Option<usize>,
    /// What it is to a ray, if it is a transparent body in a scene with media.
    pub body: Option<Body>,
    /// Refractive index of its water over that outside, if it is a drop, which has no base.
    pub drop: Option<f32>,
}

/// The object, material and light of each instance. All places of an object share an entry for each
/// of its parts, so an instance takes eight bytes here.
#[derive(Clone, Debug, Default)]
pub struct WorldObjects {
    parts: Vec<WorldObject>,
    instances: Vec<Standing>,
    have_drops: bool,
}

#[derive(Clone, Copy, Debug)]
struct Standing {
    /// Number of the part.
    part: u32,
    /// Number of the place within its object, from 0.
    place: u32,
}

impl WorldObjects {
    /// Number of instances.
    pub fn len(&self) -> usize {
        self.instances.len()
    }

    /// Whether there are no instances.
    pub fn is_empty(&self) -> bool {
        self.instances.is_empty()
    }

    /// Number of an instance's place within its object, from 0: the row of the object's file, or 0
    /// if the object has one place. Parts of a leaf share it.
    pub fn place_of(&self, instance: u32) -> u32 {
        self.instances[instance as usize].place
    }

    /// Which body an instance is, if it is one.
    pub fn body_place(&self, instance: u32) -> BodyPlace {
        let Standing { part, place } = self.instances[instance as usize];
        BodyPlace { part, place }
    }

    /// Number of the object of a body.
    pub fn object_of(&self, body: BodyPlace) -> usize {
        self.parts[body.part as usize].object
    }

    /// The objects of some of the instances, in the order given.
    #[must_use]
    pub fn pick(&self, instances: impl IntoIterator<Item = u32>) -> Self {
        let instances = instances.into_iter();
        Self {
            parts: self.parts.clone(),
            instances: instances
                .map(|number| self.instances[number as usize])
                .collect(),
            have_drops: self.have_drops,
        }
    }

    /// Makes an instance emit light. It must be the only instance of its part.
    pub(super) fn shine(&mut self, instance: usize, light: usize) {
        self.parts[self.instances[instance].part as usize].light = Some(light);
    }

    /// Whether there are drops.
    pub fn have_drops(&self) -> bool {
        self.have_drops
    }

    /// Says of each part what body it is, given the number of an instance of it.
    pub(super) fn set_bodies<E>(
        &mut self,
        body: impl Fn(usize, WorldObject) -> Result<Option<Body>, E>,
    ) -> Result<(), E> {
        self.for_each_part(|instance, part| {
            part.body = body(instance, *part)?;
            Ok(())
        })
    }

    /// Says of each part whether it is a drop, given the number of an instance of it.
    pub(super) fn set_drops(&mut self, drop: impl Fn(usize, WorldObject) -> Option<f32>) {
        let mut some = false;
        let set: Result<(), std::convert::Infallible> = self.for_each_part(|instance, part| {
            part.drop = drop(instance, *part);
            some |= part.drop.is_some();
            Ok(())
        });
        match set {
            Ok(()) => self.have_drops = some,
        }
    }

    fn for_each_part<E>(
        &mut self,
        mut set: impl FnMut(usize, &mut WorldObject) -> Result<(), E>,
    ) -> Result<(), E> {
        let mut is_known = vec![false; self.parts.len()];
        for (instance, standing) in self.instances.iter().enumerate() {
            let part = standing.part as usize;
            if !std::mem::replace(&mut is_known[part], true) {
                set(instance, &mut self.parts[part])?;
            }
        }
        Ok(())
    }

    fn add_part(&mut self, object: usize, material: usize) -> u32 {
        self.parts.push(WorldObject {
            object,
            material,
            light: None,
            body: None,
            drop: None,
        });
        self.parts.len() as u32 - 1
    }
}

impl Index<usize> for WorldObjects {
    type Output = WorldObject;

    fn index(&self, instance: usize) -> &WorldObject {
        &self.parts[self.instances[instance].part as usize]
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
        self.objects.instances.push(Standing { part, place });
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
    placed.objects.instances.reserve(count);
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
    placed
}

/// The transform from a part's mesh to the scene, given that of its shape.
fn carried(to_world: DMat4, piece: &Piece) -> DAffine3 {
    DAffine3::from_mat4(to_world * DMat4::from(piece.to_leaf))
}
