//! The traversal of the two levels of trees by a ray.
//!
//! Both traversals are inlined into one function for each instruction level and each kind of
//! search. There are no closures, since these would first be compiled separately, without those
//! instructions.

use std::marker::PhantomData;

use glam::Vec3A;

use super::super::ray::Ray;
use super::super::slab::SlabRay;
use super::super::triangle::ShearRay;
use super::super::wide_tree::Visitor;
use super::{Carrier, Geometry, Hit, TracedMesh};
use crate::simd::{Eight, LANES, Task};

/// What a search is for.
pub(super) trait Found: Default {
    /// The result.
    type Output;
    /// Whether near hits should come first.
    const NEAREST_FIRST: bool;

    /// Records a hit, which may be farther than the limit. Returns the new limit; −∞ ends the
    /// search.
    fn hit(&mut self, hit: Hit, limit: f32) -> f32;

    /// What was found.
    fn output(self) -> Self::Output;
}

/// The nearest hit; of equal distances the smaller (instance, triangle).
#[derive(Default)]
pub(super) struct NearestHit(Option<Hit>);

impl Found for NearestHit {
    type Output = Option<Hit>;
    const NEAREST_FIRST: bool = true;

    #[inline(always)]
    fn hit(&mut self, hit: Hit, limit: f32) -> f32 {
        if hit.t > limit {
            return limit;
        }
        if let Some(best) = self.0 {
            let first = (hit.instance, hit.triangle) < (best.instance, best.triangle);
            if hit.t > best.t || hit.t == best.t && !first {
                return limit;
            }
        }
        self.0 = Some(hit);
        hit.t
    }

    #[inline(always)]
    fn output(self) -> Option<Hit> {
        self.0
    }
}

/// Whether there is a hit.
#[derive(Default)]
pub(super) struct AnyHit(bool);

impl Found for AnyHit {
    type Output = bool;
    const NEAREST_FIRST: bool = false;

    #[inline(always)]
    fn hit(&mut self, hit: Hit, limit: f32) -> f32 {
        if hit.t > limit {
            return limit;
        }
        self.0 = true;
        f32::NEG_INFINITY
    }

    #[inline(always)]
    fn output(self) -> bool {
        self.0
    }
}

/// The search of one ray for `F`.
pub(super) struct Search<'a, F> {
    geometry: &'a Geometry,
    ray: &'a Ray,
    found: PhantomData<F>,
}

impl<'a, F: Found> Search<'a, F> {
    #[inline(always)]
    pub(super) fn new(geometry: &'a Geometry, ray: &'a Ray) -> Self {
        Self {
            geometry,
            ray,
            found: PhantomData,
        }
    }
}

impl<F: Found> Task for Search<'_, F> {
    type Output = F::Output;

    #[inline(always)]
    fn run<E: Eight>(self, e: E) -> F::Output {
        let Self { geometry, ray, .. } = self;
        let mut found = F::default();
        if ray.is_proper() {
            let bounds = geometry.tree.bounds();
            let slab = SlabRay::new(ray.origin.into(), ray.direction.into(), ray.t_min, bounds);
            let mut instances = Instances {
                e,
                geometry,
                ray,
                found: &mut found,
            };
            if F::NEAREST_FIRST {
                (geometry.tree).walk::<true, E>(e, &slab, ray.t_max, &mut instances);
            } else {
                (geometry.tree).walk::<false, E>(e, &slab, ray.t_max, &mut instances);
            }
        }
        found.output()
    }
}

/// Visitor of the leaves of the upper tree: traverses the tree of the instance's mesh.
struct Instances<'a, E, F> {
    e: E,
    geometry: &'a Geometry,
    ray: &'a Ray,
    found: &'a mut F,
}

impl<E: Eight, F: Found> Visitor for Instances<'_, E, F> {
    #[inline(always)]
    fn fetch(&self, leaf: u32) {
        self.e.prefetch(&self.geometry.carriers, leaf as usize);
    }

    #[inline(always)]
    fn visit(&mut self, leaf: u32, enter: f32, limit: f32) -> f32 {
        let carrier = &self.geometry.carriers[leaf as usize];
        let (origin, direction) = carrier.carry(self.ray);
        // The local frame may scale a direction to 0 or to infinity.
        if !origin.is_finite() || !direction.is_finite() || direction == Vec3A::ZERO {
            return limit;
        }
        self.geometry.level.run(InMesh {
            mesh: &self.geometry.meshes[carrier.mesh as usize],
            carrier,
            origin,
            direction,
            t_min: self.ray.t_min,
            enter,
            found: &mut *self.found,
            limit,
        })
    }
}

/// The search in one mesh, a separate function so that more of the traversal stays in registers.
struct InMesh<'a, F> {
    mesh: &'a TracedMesh,
    carrier: &'a Carrier,
    /// The ray in the mesh's frame.
    origin: Vec3A,
    direction: Vec3A,
    t_min: f32,
    /// Where the ray enters the instance's box.
    enter: f32,
    found: &'a mut F,
    limit: f32,
}

impl<F: Found> Task for InMesh<'_, F> {
    /// The new limit.
    type Output = f32;

    #[inline(always)]
    fn run<E: Eight>(self, e: E) -> f32 {
        let (origin, direction, t_min) = (self.origin, self.direction, self.t_min);
        let tree = &self.mesh.tree;
        let slab = SlabRay::new(origin, direction, t_min, tree.bounds());
        let shear = ShearRay::new(origin, direction, t_min);
        let mut triangles = Triangles {
            e,
            mesh: self.mesh,
            carrier: self.carrier,
            enter: self.enter,
            slab: &slab,
            shear: &shear,
            found: self.found,
            limit: self.limit,
        };
        if F::NEAREST_FIRST {
            tree.walk::<true, E>(e, &slab, self.limit, &mut triangles);
        } else {
            tree.walk::<false, E>(e, &slab, self.limit, &mut triangles);
        }
        triangles.limit
    }
}

/// Visitor of the leaves of a mesh's tree: tests the ray against eight triangles.
struct Triangles<'a, E, F> {
    e: E,
    mesh: &'a TracedMesh,
    carrier: &'a Carrier,
    /// Where the ray enters the instance's box.
    enter: f32,
    slab: &'a SlabRay,
    shear: &'a ShearRay,
    found: &'a mut F,
    /// The limit after the last visit.
    limit: f32,
}

impl<E: Eight, F: Found> Visitor for Triangles<'_, E, F> {
    #[inline(always)]
    fn fetch(&self, leaf: u32) {
        self.e.prefetch(&self.mesh.blocks, leaf as usize);
    }

    #[inline(always)]
    fn visit(&mut self, leaf: u32, _: f32, mut limit: f32) -> f32 {
        let block = &self.mesh.blocks[leaf as usize];
        let mut candidates = block.candidates(self.e, self.shear, limit);
        while candidates != 0 {
            let lane = candidates.trailing_zeros() as usize;
            candidates &= candidates - 1;
            if let Some(hit) = block.hit(lane, self.shear, self.slab) {
                let hit = Hit {
                    // Rounding may put a hit before the instance's own box. The distance of the box
                    // is used, so that culling by it stays exact.
                    t: hit.t.max(self.enter),
                    instance: self.carrier.instance,
                    triangle: block.id(lane),
                    b1: hit.b1,
                    b2: hit.b2,
                    place: leaf * LANES as u32 + lane as u32,
                };
                limit = self.found.hit(hit, limit);
            }
        }
        self.limit = limit;
        limit
    }
}
