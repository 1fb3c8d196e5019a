//! What each instance is: its object, material and light.

use std::ops::Index;

use crate::medium::{Body, BodyPlace};

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
    /// Whether the camera sees a hole in its place.
    pub holdout: bool,
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
    pub fn shine(&mut self, instance: usize, light: usize) {
        self.parts[self.instances[instance].part as usize].light = Some(light);
    }

    /// Whether there are drops.
    pub fn have_drops(&self) -> bool {
        self.have_drops
    }

    /// Says of each part what body it is, given the number of an instance of it.
    ///
    /// # Errors
    ///
    /// The first one that `body` returns.
    pub fn set_bodies<E>(
        &mut self,
        body: impl Fn(usize, WorldObject) -> Result<Option<Body>, E>,
    ) -> Result<(), E> {
        self.for_each_part(|instance, part| {
            part.body = body(instance, *part)?;
            Ok(())
        })
    }

    /// Says of each part whether it is a drop, given the number of an instance of it.
    pub fn set_drops(&mut self, drop: impl Fn(usize, WorldObject) -> Option<f32>) {
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

    /// Makes holes, to the camera, of the objects with these numbers.
    pub fn hold_out(&mut self, is_held_out: impl Fn(usize) -> bool) {
        for part in &mut self.parts {
            part.holdout = is_held_out(part.object);
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

    /// Makes room for so many more instances.
    pub fn reserve(&mut self, count: usize) {
        self.instances.reserve(count);
    }

    /// Adds an instance of a part, with the number of its place within its object.
    pub fn add(&mut self, part: u32, place: u32) {
        self.instances.push(Standing { part, place });
    }

    /// Adds a part of an object, which has a material, and returns its number.
    pub fn add_part(&mut self, object: usize, material: usize) -> u32 {
        self.parts.push(WorldObject {
            object,
            material,
            light: None,
            body: None,
            drop: None,
            holdout: false,
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
