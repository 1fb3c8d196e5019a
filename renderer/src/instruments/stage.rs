//! The part of a scene that an instrument sees.

use std::sync::atomic::{AtomicU64, Ordering};

use glam::DVec3;

use super::row::{CutPaths, Reading, Row};
use crate::geometry::{Geometry, GeometryError, origin_near};
use crate::material::Material;
use crate::spectrum::Lanes;
use trace::world::{World, WorldObjects};

/// Counts paths that a limit cuts; sums of integers are the same on any number of threads.
#[derive(Debug)]
pub(super) struct Cuts {
    paths: AtomicU64,
    /// What they carried, in units of 2⁻³² of a ray's light.
    carried: AtomicU64,
    /// Fewest rays of a figure.
    rays: AtomicU64,
}

impl Cuts {
    const ONE: f64 = 4_294_967_296.0;

    fn new() -> Self {
        Self {
            paths: AtomicU64::new(0),
            carried: AtomicU64::new(0),
            rays: AtomicU64::new(u64::MAX),
        }
    }

    /// A path is cut that carries this much.
    pub(super) fn add<const N: usize>(&self, weight: Lanes<N>) {
        let weight = weight.max_lane();
        if weight > 0.0 {
            let units = (f64::from(weight) * Self::ONE).ceil() as u64;
            self.paths.fetch_add(1, Ordering::Relaxed);
            self.carried.fetch_add(units, Ordering::Relaxed);
        }
    }

    /// A figure was measured with so many rays.
    pub(super) fn measured(&self, rays: u64) {
        self.rays.fetch_min(rays, Ordering::Relaxed);
    }

    /// What was cut.
    pub(super) fn paths(&self) -> CutPaths {
        let [paths, carried, rays] =
            [&self.paths, &self.carried, &self.rays].map(|count| count.load(Ordering::Relaxed));
        CutPaths {
            paths,
            at_most: carried as f64 / Self::ONE / rays as f64,
        }
    }
}

/// Some instances of a world, each perhaps in several places.
pub(super) struct Stage<'w> {
    pub(super) world: &'w World,
    pub(super) geometry: Geometry,
    pub(super) objects: WorldObjects,
    /// Number of each of its instances in the world.
    pub(super) numbers: Vec<u32>,
    /// Paths in it that were cut.
    pub(super) cuts: Cuts,
}

impl<'w> Stage<'w> {
    /// These instances of a world, each moved by an offset, m. Rays are traced around a point near
    /// the given one, which is in their midst.
    pub(super) fn new(
        world: &'w World,
        places: &[(u32, DVec3)],
        middle: DVec3,
    ) -> Result<Self, GeometryError> {
        Ok(Self {
            world,
            cuts: Cuts::new(),
            geometry: world.geometry.with_places(places, origin_near(middle))?,
            numbers: places.iter().map(|(number, _)| *number).collect(),
            objects: world.objects.pick(places.iter().map(|(number, _)| *number)),
        })
    }

    /// All parts of one object.
    pub(super) fn of_object(world: &'w World, object: usize) -> Result<Self, GeometryError> {
        let numbers = 0..world.objects.len() as u32;
        let own = numbers.filter(|&number| world.objects[number as usize].object == object);
        let own: Vec<(u32, DVec3)> = own.map(|number| (number, DVec3::ZERO)).collect();
        let boxes = own
            .iter()
            .map(|(number, _)| world.geometry.bounds_of(*number));
        let nowhere = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (least, most) = boxes.fold(nowhere, |(least, most), (low, high)| {
            (least.min(low), most.max(high))
        });
        Self::new(world, &own, 0.5 * (least + most))
    }

    /// The first object that a medium fills.
    pub(super) fn filled(&self) -> Option<usize> {
        self.first(|number| {
            let body = self.objects[number].body;
            body.is_some_and(|body| body.medium.is_some())
        })
    }

    /// The first object that light passes straight through, changed by nothing.
    pub(super) fn passed(&self) -> Option<usize> {
        let body = |number: usize| self.objects[number].body;
        self.first(|number| body(number).is_some_and(|body| body.is_matched))
    }

    /// The first object that is a leaf of layers.
    pub(super) fn layered(&self) -> Option<usize> {
        self.first(|number| self.material_of(number as u32).inside().is_some())
    }

    /// The object of the first instance of a kind.
    fn first(&self, is_it: impl Fn(usize) -> bool) -> Option<usize> {
        let number = (0..self.objects.len()).find(|&number| is_it(number));
        number.map(|number| self.objects[number].object)
    }

    /// The rows that were measured on it, with what was cut.
    pub(super) fn reading(&self, rows: Vec<Row>) -> Reading {
        let cut = self.cuts.paths();
        let draws = 1;
        Reading { rows, cut, draws }
    }

    /// The material of an instance.
    pub(super) fn material_of(&self, instance: u32) -> &'w Material {
        &self.world.materials[self.objects[instance as usize].material]
    }
}
