//! The traversal of the two levels of trees by a ray.
//!
//! Both traversals are inlined into one function for each instruction level and each kind of
//! search. There are no closures, since these would first be compiled separately, without those
//! instructions.

use std::marker::PhantomData;

use glam::Vec3A;

use super::super::ray::Ray;
use super::super::slab::SlabRay;
use super::super::triangle::{Candidates, ShearRay};
use super::super::wide_tree::Visitor;
use super::triangle_tree::TriangleTree;
use super::{Geometry, Hit};
use crate::simd::{self, Eight, LANES, Level, Sixteen, Task};

impl Geometry {
    /// The nearest hit with `t_min ≤ t ≤ t_max`; of equal distances the smaller (instance,
    /// triangle).
    ///
    /// `None` also for a ray that is not finite or has no direction.
    pub fn intersect(&self, ray: &Ray) -> Option<Hit> {
        self.level.run(Search::<NearestHit>::new(self, ray))
    }

    /// Whether anything is hit with `t_min ≤ t ≤ t_max`, that is, whether [`Geometry::intersect`]
    /// finds a hit.
    pub fn occluded(&self, ray: &Ray) -> bool {
        self.level.run(Search::<AnyHit>::new(self, ray))
    }
}

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
    fn run<E: Sixteen>(self, e: E) -> F::Output {
        let Self { geometry, ray, .. } = self;
        let mut found = F::default();
        if geometry.carriers.len() == 1 {
            // No tree over one instance. What is not finite in the world is not so in the mesh's
            // frame either.
            if ray.t_min() <= ray.t_max()
                && let Some(task) = in_mesh::<F>(geometry, ray, 0, ray.t_max())
                && let Some(hit) = task.run(e)
            {
                found.hit(hit, ray.t_max());
            }
        } else if ray.is_proper() {
            let slab = SlabRay::among_widened(
                ray.origin().into(),
                ray.direction().into(),
                ray.t_min(),
                geometry.farthest,
            );
            let mut instances = Instances {
                geometry,
                ray,
                slab: &slab,
                found: &mut found,
            };
            if F::NEAREST_FIRST {
                (geometry.tree).walk_nearest(e, &slab, ray.t_max(), &mut instances);
            } else {
                (geometry.tree).walk_any(e, &slab, ray.t_max(), &mut instances);
            }
        }
        found.output()
    }
}

/// Visitor of the leaves of the upper tree: traverses the tree of the instance's mesh.
struct Instances<'a, F> {
    geometry: &'a Geometry,
    ray: &'a Ray,
    slab: &'a SlabRay,
    found: &'a mut F,
}

impl<F: Found> Visitor for Instances<'_, F> {
    #[inline(always)]
    fn fetch(&self, leaf: u32) {
        simd::prefetch(&self.geometry.carriers, leaf as usize);
    }

    #[inline(always)]
    fn visit(&mut self, leaf: u32, limit: f32) -> f32 {
        let Some(task) = in_mesh::<F>(self.geometry, self.ray, leaf, limit) else {
            return limit;
        };
        let Some(mut hit) = self.geometry.level.run(task) else {
            return limit;
        };
        // Rounding may put a hit before the instance's own box, or beside it. The box decides, so
        // that culling by it stays exact.
        let Some(enter) = self.slab.one(&self.geometry.boxes[leaf as usize]) else {
            return limit;
        };
        hit.t = hit.t.max(enter);
        self.found.hit(hit, limit)
    }
}

/// The search in the mesh of an instance; `None` if its frame scales the direction to 0 or to
/// infinity, or the ray is not finite.
#[inline(always)]
fn in_mesh<'a, F: Found>(
    geometry: &'a Geometry,
    ray: &Ray,
    leaf: u32,
    limit: f32,
) -> Option<InMesh<'a, F>> {
    let carrier = &geometry.carriers[leaf as usize];
    let (origin, direction) = carrier.carry(ray);
    if !origin.is_finite() || !direction.is_finite() || direction == Vec3A::ZERO {
        return None;
    }
    Some(InMesh {
        tree: &geometry.trees[carrier.tree as usize],
        level: geometry.level,
        instance: carrier.instance,
        origin,
        direction,
        t_min: ray.t_min(),
        limit,
        found: PhantomData,
    })
}

/// The search in one mesh, a separate function so that more of the traversal stays in registers.
struct InMesh<'a, F> {
    tree: &'a TriangleTree,
    level: Level,
    /// The instance, where the tree does not know it.
    instance: u32,
    /// The ray in the mesh's frame.
    origin: Vec3A,
    direction: Vec3A,
    t_min: f32,
    limit: f32,
    found: PhantomData<F>,
}

impl<F: Found> Task for InMesh<'_, F> {
    /// A hit no farther than the limit: the nearest, and of equal distances the smaller triangle, or
    /// any.
    type Output = Option<Hit>;

    #[inline(always)]
    fn run<E: Sixteen>(self, e: E) -> Option<Hit> {
        let (origin, direction, t_min) = (self.origin, self.direction, self.t_min);
        let tree = &self.tree.tree;
        let slab = SlabRay::new(origin, direction, t_min, tree.bounds());
        let shear = ShearRay::new(origin, direction, t_min);
        let mut triangles = Triangles::<E, F> {
            e,
            tree: self.tree,
            slab: &slab,
            shear: &shear,
            hit: None,
            found: PhantomData,
        };
        if F::NEAREST_FIRST {
            tree.walk_nearest(e, &slab, self.limit, &mut triangles);
        } else {
            tree.walk_any(e, &slab, self.limit, &mut triangles);
        }
        let mut hit = triangles.hit;
        if (F::NEAREST_FIRST || hit.is_none())
            && !self.tree.wall_bounds.is_behind(origin, direction)
        {
            let limit = hit.map_or(self.limit, |hit| hit.t);
            if !self.tree.wall_bounds.is_beyond(origin, direction, limit) {
                hit = self.level.run(Walls { search: &self, hit });
            }
        }
        let mut hit = hit?;
        hit.instance = match self.tree.owner(hit.place) {
            Some(owner) => owner,
            None => self.instance,
        };
        Some(hit)
    }
}

/// The search in the blocks beside the tree: apart, so that the walk through the tree stays small.
struct Walls<'a, 'b, F> {
    search: &'b InMesh<'a, F>,
    /// What was found in the tree.
    hit: Option<Hit>,
}

impl<F: Found> Task for Walls<'_, '_, F> {
    type Output = Option<Hit>;

    #[inline(always)]
    fn run<E: Sixteen>(self, e: E) -> Option<Hit> {
        let Self { search, hit } = self;
        let (origin, direction, t_min) = (search.origin, search.direction, search.t_min);
        let slab = SlabRay::new(origin, direction, t_min, &search.tree.wall_bounds);
        let shear = ShearRay::new(origin, direction, t_min);
        let mut triangles = Triangles::<E, F> {
            e,
            tree: search.tree,
            slab: &slab,
            shear: &shear,
            hit,
            found: PhantomData,
        };
        let mut limit = hit.map_or(search.limit, |hit| hit.t);
        for (wall, bounds) in search.tree.walls() {
            if bounds.is_behind(origin, direction) {
                continue;
            }
            limit = triangles.visit(wall, limit);
            if limit == f32::NEG_INFINITY {
                break;
            }
        }
        triangles.hit
    }
}

/// Visitor of the leaves of a mesh's tree: tests the ray against eight triangles.
struct Triangles<'a, E, F> {
    e: E,
    tree: &'a TriangleTree,
    slab: &'a SlabRay,
    shear: &'a ShearRay,
    /// What was found so far; its instance is looked up at the end.
    hit: Option<Hit>,
    found: PhantomData<F>,
}

impl<E: Eight, F: Found> Triangles<'_, E, F> {
    /// Tests some triangles of a block; returns the new limit.
    #[inline(always)]
    fn test(&mut self, leaf: u32, candidates: &Candidates, mut limit: f32) -> f32 {
        let block = &self.tree.blocks[leaf as usize];
        let mut lanes = candidates.lanes;
        while lanes != 0 {
            let lane = lanes.trailing_zeros() as usize % LANES;
            lanes &= lanes - 1;
            let Some(found) = block.hit(lane, candidates, self.shear, self.slab) else {
                continue;
            };
            if found.t > limit {
                continue;
            }
            let (triangle, place) = (block.id(lane), leaf * LANES as u32 + lane as u32);
            // At the limit there may be a hit of another instance, which the caller compares, or
            // one of this tree.
            if let Some(best) = &self.hit
                && found.t == best.t
                && !self.is_before(place, triangle, best)
            {
                continue;
            }
            self.hit = Some(Hit {
                t: found.t,
                instance: u32::MAX,
                triangle,
                b1: found.b1,
                b2: found.b2,
                place,
            });
            if !F::NEAREST_FIRST {
                return f32::NEG_INFINITY;
            }
            limit = found.t;
        }
        limit
    }

    /// Whether a triangle comes before the best one at the same distance.
    #[inline(never)]
    fn is_before(&self, place: u32, triangle: u32, best: &Hit) -> bool {
        let owner = |place| self.tree.owner(place);
        (owner(place), triangle) < (owner(best.place), best.triangle)
    }
}

impl<E: Eight, F: Found> Visitor for Triangles<'_, E, F> {
    #[inline(always)]
    fn fetch(&self, leaf: u32) {
        simd::prefetch(&self.tree.blocks, leaf as usize);
    }

    #[inline(always)]
    fn visit(&mut self, leaf: u32, limit: f32) -> f32 {
        let block = &self.tree.blocks[leaf as usize];
        match block.candidates(self.e, self.shear, limit) {
            Some(candidates) => self.test(leaf, &candidates, limit),
            None => limit,
        }
    }
}
