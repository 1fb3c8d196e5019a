//! Places for objects that are strewn on others, or float in a box.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};

use glam::{DAffine3, DMat4};

use super::error::WorldError;
use super::needs::Memory;
use super::placing::Pieces;
use crate::geometry::TriangleMesh;
use crate::geometry::scatter::{
    Amount, Body, Ground, Most, Rest, Scatter, ScatterError, Strewn, Volume, VolumeError,
    seed_of_draw, triangles,
};
use crate::scene::description::{InstancePlace, Named, Object, ObjectShape, StrewnOn};

/// The shape of each copy of an object, and its place in the scene's frame.
type Copies = Vec<(u32, DMat4)>;

/// The copies of each object, by its number.
pub type Places = BTreeMap<usize, Copies>;

/// The same places as those of files.
pub(super) fn as_places(places: &Places) -> BTreeMap<usize, Vec<InstancePlace>> {
    let all = places.iter().map(|(object, places)| {
        let places = places.iter();
        let places = places.map(|(shape, place)| InstancePlace::new(*shape, *place));
        (*object, places.collect())
    });
    all.collect()
}

/// What the places of strewn objects depend on, in double precision.
#[derive(Debug)]
pub(super) struct Strewing<'a> {
    meshes: &'a [TriangleMesh],
    pieces: &'a Pieces,
    objects: &'a [Named<Object>],
    /// Which of several independent draws is made, from 0.
    draw: u32,
    memory: Memory,
    /// Counts what has come to rest, and of how many things it has.
    at_rest: Option<&'a [AtomicUsize; 2]>,
    /// Places found so far.
    found: Places,
}

/// Height of a heap over the radius of the largest thing in it from which on it is told: litter is
/// lower than a leaf is long.
const HEAP: f64 = 4.0;

impl<'a> Strewing<'a> {
    pub(super) fn new(
        meshes: &'a [TriangleMesh],
        pieces: &'a Pieces,
        objects: &'a [Named<Object>],
        draw: u32,
        (most_bytes, at_rest): (Option<f64>, Option<&'a [AtomicUsize; 2]>),
    ) -> Result<Self, WorldError> {
        let mut memory = Memory::new(most_bytes);
        memory.take_meshes(meshes)?;
        Ok(Self {
            meshes,
            pieces,
            objects,
            draw,
            memory,
            at_rest,
            found: BTreeMap::new(),
        })
    }

    /// The places of each object that is strewn or floats, by its number, and notes on them.
    pub(super) fn all(mut self, notes: &mut Vec<String>) -> Result<Places, WorldError> {
        let scatter = |name: &str| WorldError::of(format!("objects.{name}.scatter"));
        // Things take long to come to rest; what cannot be strewn on them is told before.
        for object in self.objects {
            if let Some(strewn) = &object.value.strewn {
                self.check_fineness(strewn).map_err(scatter(&object.name))?;
            }
        }
        for (number, object) in self.objects.iter().enumerate() {
            if let Some(strewn) = &object.value.strewn {
                let (places, heap) = self
                    .strew(&object.value, strewn)
                    .map_err(scatter(&object.name))?;
                notes.extend(heap.map(|height| {
                    format!(
                        "objects.{}: its things are heaped {height:.2} m high: strew fewer, or \
                         over a wider `within_m`",
                        object.name
                    )
                }));
                self.keep(number, places);
            }
            if let Some(volume) = &object.value.volume {
                let places = self.fill(&object.value, volume);
                let place = format!("objects.{}.volume", object.name);
                self.keep(number, places.map_err(WorldError::of(place))?);
            }
        }
        Ok(self.found)
    }

    /// Keeps the places of an object.
    fn keep(&mut self, number: usize, places: Copies) {
        let parts = self.most_parts(&self.objects[number].value);
        self.memory.take_instances(places.len() * parts);
        self.found.insert(number, places);
    }

    /// How many instances a place of an object takes at most.
    fn most_parts(&self, object: &Object) -> usize {
        let parts = |shape: &ObjectShape| self.pieces.of(*shape).len();
        object.shapes.iter().map(parts).max().unwrap_or(1)
    }

    /// Refuses to strew on things that will be too many for their triangles, whichever are drawn.
    fn check_fineness(&self, strewn: &StrewnOn) -> Result<(), ScatterError> {
        let below = &self.objects[strewn.on].value;
        let Some(StrewnOn { plan, .. }) = below.strewn.as_deref() else {
            return Ok(());
        };
        // How many a density comes to depends on what lies below.
        let Amount::Count(count) = plan.amount else {
            return Ok(());
        };
        let of_shape = |shape: ObjectShape| -> usize {
            let parts = self.parts(shape, DMat4::IDENTITY);
            parts.map(|(mesh, _)| mesh.triangles().len()).sum()
        };
        let least = if let Some(group) = &below.instances {
            let parts = group.iter();
            parts
                .map(|part| of_shape(below.shapes[part.shape as usize]))
                .sum()
        } else {
            let shapes = below.shapes.iter();
            shapes.map(|shape| of_shape(*shape)).min().unwrap_or(0)
        };
        Ground::check_size(least.saturating_mul(count as usize))
    }

    /// Places of things on an object, and how high they are heaped if that is more than one would
    /// expect, m.
    fn strew(
        &self,
        object: &Object,
        strewn: &StrewnOn,
    ) -> Result<(Copies, Option<f64>), ScatterError> {
        let ground = Ground::of(self.standing(strewn.on))?;
        let others = strewn.over.iter();
        let others = others.flat_map(|over| triangles(self.standing(*over)));
        // A plant is strewn as a whole.
        let group = object.instances.as_deref();
        let shapes = match group {
            Some(_) => &object.shapes[..1],
            None => &object.shapes[..],
        };
        let body = |shape: &ObjectShape| Body::of(self.parts(*shape, object.to_world));
        let bodies: Vec<Body> = shapes.iter().map(body).collect();
        let before = self
            .at_rest
            .map_or(0, |[at_rest, _]| at_rest.load(Ordering::Relaxed));
        let count = |wanted: usize| {
            if let Some([at_rest, all]) = self.at_rest {
                all.store(before + wanted, Ordering::Relaxed);
                at_rest.fetch_add(1, Ordering::Relaxed);
            }
        };
        let parts = group.map_or(1, <[_]>::len);
        let most = self.memory.most(parts * self.most_parts(object));
        let plan = Scatter {
            seed: seed_of_draw(strewn.plan.seed, self.draw),
            ..strewn.plan.clone()
        };
        let places = plan.places_up_to(&ground, others, &bodies, most, &count)?;
        let most = Most::UNBOUND;
        if places.len() * parts > most.things() {
            let wanted = (places.len() * parts) as f64;
            return Err(ScatterError::TooMany { wanted, most });
        }
        let heap = heap(strewn, &ground, &bodies, &places);
        let found = places.iter().flat_map(|place| {
            let stand = DMat4::from(place.to_world);
            let own = (place.body, stand * object.to_world);
            let group = group.into_iter().flatten();
            let parts = group.map(move |part| (part.shape, stand * part.matrix()));
            let alone = object.instances.is_none().then_some(own);
            alone.into_iter().chain(parts)
        });
        Ok((found.collect(), heap))
    }

    fn fill(&self, object: &Object, volume: &Volume) -> Result<Copies, VolumeError> {
        let area = |shape: &ObjectShape| -> f64 {
            triangles(self.parts(*shape, object.to_world))
                .map(|[a, b, c]| 0.5 * (b - a).cross(c - a).length())
                .sum()
        };
        let areas: Vec<f64> = object.shapes.iter().map(area).collect();
        let most = self.memory.most(self.most_parts(object));
        let volume = Volume {
            seed: seed_of_draw(volume.seed, self.draw),
            ..volume.clone()
        };
        let places = volume.places(&areas, most)?.into_iter();
        let places = places.map(|place| {
            let to_world = DMat4::from(place.to_world) * object.to_world;
            (place.body, to_world)
        });
        Ok(places.collect())
    }

    /// The meshes of a shape in their places.
    fn parts(
        &self,
        shape: ObjectShape,
        to_world: DMat4,
    ) -> impl Iterator<Item = (&'a TriangleMesh, DAffine3)> {
        let to_world = DAffine3::from_mat4(to_world);
        let (meshes, pieces) = (self.meshes, self.pieces.of(shape).into_iter());
        pieces.map(move |piece| (&meshes[piece.mesh], to_world * piece.to_leaf))
    }

    /// The meshes of an object in all of its places.
    fn standing(&self, number: usize) -> impl Iterator<Item = (&'a TriangleMesh, DAffine3)> {
        let object = &self.objects[number].value;
        let shape = |number: u32| object.shapes[number as usize];
        let places: Vec<(ObjectShape, DMat4)> = match (self.found.get(&number), &object.instances) {
            (Some(places), _) => places.iter().map(|(own, at)| (shape(*own), *at)).collect(),
            (None, Some(places)) => places
                .iter()
                .map(|place| (shape(place.shape), place.matrix()))
                .collect(),
            (None, None) => vec![(shape(0), object.to_world)],
        };
        let parts = places
            .into_iter()
            .map(|(shape, to_world)| self.parts(shape, to_world).collect::<Vec<_>>());
        parts.collect::<Vec<_>>().into_iter().flatten()
    }
}

/// How high things that have come to rest are heaped above the top of what they lie on, m, if that
/// is more than a litter is.
fn heap(strewn: &StrewnOn, ground: &Ground, bodies: &[Body], places: &[Strewn]) -> Option<f64> {
    let Rest::Settled { .. } = strewn.plan.rest else {
        return None;
    };
    let largest = bodies.iter().map(Body::radius).fold(0.0, f64::max) * strewn.plan.scale[1];
    let heights = places.iter().map(|place| place.to_world.translation.z);
    let height = heights.fold(f64::NEG_INFINITY, f64::max) - ground.top();
    (height > HEAP * largest).then_some(height)
}

#[cfg(test)]
mod tests;
