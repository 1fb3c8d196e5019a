//! Instanced meshes, against which rays are traced.

use std::sync::Arc;

use glam::{Vec2, Vec3, Vec3A};
use rayon::prelude::*;

use super::bounds::Bounds;
pub use super::error::GeometryError;
use super::error::MOST_INSTANCES;
pub use super::hit::Hit;
use super::instance::Instance;
use super::mesh::TriangleMesh;
use super::placement::{Carrier, Placement};
use super::ray::Ray;
use super::surface::{self, SurfacePoint, TextureScale};
use super::wide_tree::{LeafItems, WideTree};
use crate::simd::{LANES, Level};
use joining::{Joined, MOST_REPEATED};
use search::{AnyHit, NearestHit, Search};
use triangle_tree::TriangleTree;

mod joining;
mod search;
mod triangle_tree;

/// Instanced meshes with their trees. Immutable and shared by all threads.
#[derive(Clone, Debug)]
pub struct Geometry {
    /// Shared with geometries of the same meshes in other places.
    meshes: Arc<[TriangleMesh]>,
    /// The tree of each mesh, empty if no instance is traced by it, and at the end that of joined
    /// instances.
    trees: Vec<Arc<TriangleTree>>,
    placements: Vec<Placement>,
    tree: WideTree,
    /// The instance of each leaf of `tree`, or joined ones.
    carriers: Vec<Carrier>,
    /// Its box in the world.
    boxes: Vec<Bounds>,
    level: Level,
}

impl Geometry {
    /// Builds the trees. Without instances nothing is ever hit.
    ///
    /// # Errors
    ///
    /// [`GeometryError`]: for an instance of a mesh that does not exist, or with a transform that
    /// cannot be inverted.
    pub fn build(
        meshes: Vec<TriangleMesh>,
        instances: Vec<Instance>,
    ) -> Result<Self, GeometryError> {
        Self::built(meshes, instances, MOST_REPEATED)
    }

    /// As [`Geometry::build`]; `most_repeated` as in [`joining::choose`].
    pub(super) fn built(
        meshes: Vec<TriangleMesh>,
        instances: Vec<Instance>,
        most_repeated: usize,
    ) -> Result<Self, GeometryError> {
        for (number, instance) in instances.iter().enumerate() {
            if instance.mesh as usize >= meshes.len() {
                return Err(GeometryError::NoSuchMesh {
                    instance: number,
                    mesh: instance.mesh,
                    meshes: meshes.len(),
                });
            }
        }
        Self::placed(meshes.into(), &[], instances, most_repeated)
    }

    /// The same meshes with some of the instances, each moved by an offset, m; in the order given.
    ///
    /// # Errors
    ///
    /// [`GeometryError`] if there are too many, or an offset is not finite.
    pub fn with_places(&self, places: &[(u32, Vec3)]) -> Result<Self, GeometryError> {
        let moved = places.iter().map(|&(number, by)| {
            let mut instance = self.placements[number as usize].instance;
            instance.to_world.translation += Vec3A::from(by);
            instance
        });
        let meshes = Arc::clone(&self.meshes);
        let geometry = Self::placed(meshes, &self.trees, moved.collect(), MOST_REPEATED)?;
        Ok(geometry.at_level(self.level))
    }

    /// Meshes, placed, with their trees as far as these are there already.
    fn placed(
        meshes: Arc<[TriangleMesh]>,
        trees: &[Arc<TriangleTree>],
        instances: Vec<Instance>,
        most_repeated: usize,
    ) -> Result<Self, GeometryError> {
        if instances.len() > MOST_INSTANCES {
            return Err(GeometryError::TooManyInstances {
                given: instances.len(),
            });
        }
        let mut placements = instances
            .into_iter()
            .enumerate()
            .map(|(number, instance)| {
                let center = triangle_tree::center_of(&meshes[instance.mesh as usize]);
                Placement::new(number, instance, center)
            })
            .collect::<Result<Vec<_>, _>>()?;
        let joined = joining::choose(&meshes, &placements, most_repeated);
        let mut trees = trees_of(&meshes, trees, &placements, joined.as_ref());
        let is_joined = |number: u32| {
            let joined = joined.as_ref();
            joined.is_some_and(|joined| joined.contains(number))
        };
        let mut carriers: Vec<_> = placements
            .iter()
            .map(|placement| placement.carrier)
            .filter(|carrier| !is_joined(carrier.instance))
            .collect();
        let mut boxes: Vec<_> = carriers
            .par_iter()
            .map(|carrier| {
                let tree = &trees[carrier.tree as usize];
                placements[carrier.instance as usize].world_bounds(&tree.hull)
            })
            .collect();
        if let Some(joined) = &joined {
            let tree = TriangleTree::joined(&meshes, &placements, joined);
            let first = joined.instances[0];
            let carrier = Carrier::of_joined(trees.len() as u32, first, joined.center);
            for number in joined.all() {
                placements[number as usize].join(carrier, joined.center);
            }
            boxes.push(placements[first as usize].world_bounds(&tree.hull));
            carriers.push(carrier);
            trees.push(Arc::new(tree));
        }
        check_boxes(&boxes, &carriers)?;
        let (tree, leaves) = WideTree::build(&boxes, 1);
        let order = || leaves.iter().flat_map(LeafItems::as_slice);
        Ok(Self {
            meshes,
            trees,
            placements,
            tree,
            carriers: order().map(|&leaf| carriers[leaf as usize]).collect(),
            boxes: order().map(|&leaf| boxes[leaf as usize]).collect(),
            level: Level::best(),
        })
    }

    /// Selects the vector instructions for tracing; hits have the same bits at every level.
    #[must_use]
    pub fn at_level(mut self, level: Level) -> Self {
        self.level = level;
        self
    }

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

    /// The surface at a hit; `_ray` is the ray that found it.
    pub fn surface(&self, _ray: &Ray, hit: &Hit) -> SurfacePoint {
        let placement = &self.placements[hit.instance as usize];
        let mesh = &self.meshes[placement.instance.mesh as usize];
        let corners = self.corners(placement, hit);
        SurfacePoint::at(hit, corners, mesh, placement)
    }

    /// Corners of the triangle of a hit, in the frame in which it is traced.
    #[inline]
    fn corners(&self, placement: &Placement, hit: &Hit) -> [Vec3; 3] {
        let tree = &self.trees[placement.carrier.tree as usize];
        let block = &tree.blocks[hit.place as usize / LANES];
        block.corners(hit.place as usize % LANES)
    }

    /// How texture coordinates lie on the surface at a hit; `None` if they do not span the triangle.
    pub fn texture_scale(&self, hit: &Hit) -> Option<TextureScale> {
        let placement = &self.placements[hit.instance as usize];
        let mesh = &self.meshes[placement.instance.mesh as usize];
        let corners = self.corners(placement, hit);
        TextureScale::at(hit, corners, mesh, placement)
    }

    /// How texture coordinates change along two unit directions in the plane of the surface at a hit,
    /// 1/m; not at all if the triangle is degenerate.
    pub fn uv_per_metre(&self, hit: &Hit, directions: [Vec3; 2]) -> [Vec2; 2] {
        let placement = &self.placements[hit.instance as usize];
        let mesh = &self.meshes[placement.instance.mesh as usize];
        let corners = self.corners(placement, hit);
        surface::uv_per_metre(hit, corners, (mesh, placement), directions)
    }

    /// Smallest and largest coordinates of all instances' boxes, m; both the origin if there are
    /// none.
    pub fn bounds(&self) -> (Vec3, Vec3) {
        let bounds = self.tree.bounds();
        if bounds.is_empty() {
            return (Vec3::ZERO, Vec3::ZERO);
        }
        (bounds.min, bounds.max)
    }

    /// Area of one side of all triangles of an instance, m².
    pub fn area_of(&self, instance: u32) -> f64 {
        let placed = self.instance(instance);
        let mesh = self.mesh(placed.mesh);
        let area = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|vertex| {
                let point = mesh.positions()[vertex as usize];
                placed.to_world.transform_point3(point).as_dvec3()
            });
            0.5 * (b - a).cross(c - a).length()
        };
        mesh.triangles().iter().map(area).sum()
    }

    /// Number of instances.
    pub fn instances(&self) -> u32 {
        self.placements.len() as u32
    }

    /// Smallest and largest coordinates of an instance's box, m.
    pub fn bounds_of(&self, instance: u32) -> (Vec3, Vec3) {
        let placement = &self.placements[instance as usize];
        let tree = &self.trees[placement.carrier.tree as usize];
        let bounds = placement.world_bounds(tree.hull_of(instance));
        (bounds.min, bounds.max)
    }

    /// Memory of meshes and trees, bytes.
    pub fn memory_bytes(&self) -> usize {
        let meshes: usize = self.meshes.iter().map(TriangleMesh::memory_bytes).sum();
        let trees: usize = self.trees.iter().map(|tree| tree.memory_bytes()).sum();
        meshes
            + trees
            + self.tree.memory_bytes()
            + self.placements.capacity() * size_of::<Placement>()
            + self.carriers.capacity() * size_of::<Carrier>()
            + self.boxes.capacity() * size_of::<Bounds>()
    }

    /// A mesh by number.
    pub fn mesh(&self, i: u32) -> &TriangleMesh {
        &self.meshes[i as usize]
    }

    /// An instance by number.
    pub fn instance(&self, i: u32) -> &Instance {
        &self.placements[i as usize].instance
    }
}

/// The trees of the meshes by which an instance is traced; of those that are there already, as they
/// are.
fn trees_of(
    meshes: &[TriangleMesh],
    trees: &[Arc<TriangleTree>],
    placements: &[Placement],
    joined: Option<&Joined>,
) -> Vec<Arc<TriangleTree>> {
    let mut is_used = vec![false; meshes.len()];
    for (number, placement) in (0..).zip(placements) {
        if joined.is_none_or(|joined| !joined.contains(number)) {
            is_used[placement.instance.mesh as usize] = true;
        }
    }
    (meshes.par_iter().zip(&is_used).enumerate())
        .map(|(number, (mesh, is_used))| match trees.get(number) {
            Some(tree) if !tree.blocks.is_empty() => Arc::clone(tree),
            _ if *is_used => Arc::new(TriangleTree::of_mesh(mesh)),
            _ => Arc::new(TriangleTree::none()),
        })
        .collect()
}

/// Refuses an instance that lies beyond the range of numbers.
fn check_boxes(boxes: &[Bounds], carriers: &[Carrier]) -> Result<(), GeometryError> {
    for (bounds, carrier) in boxes.iter().zip(carriers) {
        if !bounds.min.is_finite() || !bounds.max.is_finite() {
            return Err(GeometryError::Transform {
                instance: carrier.instance as usize,
                what: "takes the mesh beyond 32-bit numbers",
            });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;
