//! Instanced meshes, against which rays are traced.

use std::sync::Arc;

use glam::{Affine3A, DVec3, Vec2, Vec3};
use rayon::prelude::*;

use self::joining::{Joined, MOST_REPEATED};
use self::triangle_tree::TriangleTree;
use super::bounds::Bounds;
use super::instance::Instance;
use super::mesh::TriangleMesh;
pub use super::placement::GeometryError;
use super::placement::{Carrier, MOST_INSTANCES, Placement};
pub use super::ray::Hit;
use super::slab;
use super::surface::{self, SurfacePoint, TextureScale};
use super::wide_tree::{LeafItems, WideTree};
use crate::simd::{LANES, Level};

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
    /// The point of the scene around which rays are traced.
    origin: DVec3,
    /// The box around everything.
    around: Bounds,
    /// Over boxes widened for culling.
    tree: WideTree,
    /// Greatest magnitude of a coordinate of those.
    farthest: f32,
    /// The instance of each leaf of `tree`, or joined ones.
    carriers: Vec<Carrier>,
    /// Its box in the world, widened for hits.
    boxes: Vec<Bounds>,
    level: Level,
}

impl Geometry {
    /// Builds the trees, for rays around the scene's origin. Without instances nothing is ever hit.
    ///
    /// # Errors
    ///
    /// [`GeometryError`]: for an instance of a mesh that does not exist, or with a transform that
    /// cannot be inverted.
    pub fn build(
        meshes: Vec<TriangleMesh>,
        instances: Vec<Instance>,
    ) -> Result<Self, GeometryError> {
        Self::build_around(DVec3::ZERO, meshes, instances)
    }

    /// The same for rays around a point of the scene.
    ///
    /// # Errors
    ///
    /// As [`Geometry::build`].
    pub fn build_around(
        origin: DVec3,
        meshes: Vec<TriangleMesh>,
        instances: Vec<Instance>,
    ) -> Result<Self, GeometryError> {
        Self::built(meshes, instances, origin, MOST_REPEATED)
    }

    /// As [`Geometry::build`]; `most_repeated` as in [`joining::choose`].
    pub(super) fn built(
        meshes: Vec<TriangleMesh>,
        instances: Vec<Instance>,
        origin: DVec3,
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
        Self::placed(meshes.into(), &[], (instances, origin), most_repeated)
    }

    /// The same meshes with some of the instances, each moved by an offset, m, in the order given,
    /// for rays around a point of the scene.
    ///
    /// # Errors
    ///
    /// [`GeometryError`] if there are too many, or an offset is not finite.
    pub fn with_places(
        &self,
        places: &[(u32, DVec3)],
        origin: DVec3,
    ) -> Result<Self, GeometryError> {
        let moved = places.iter().map(|&(number, by)| {
            let mut instance = self.placements[number as usize].instance;
            instance.translation += by;
            instance
        });
        self.with_instances(moved.collect(), origin)
    }

    /// The same meshes as other instances, for rays around a point of the scene.
    ///
    /// # Errors
    ///
    /// As [`Geometry::build`].
    ///
    /// # Panics
    ///
    /// If an instance is of a mesh that does not exist.
    pub fn with_instances(
        &self,
        instances: Vec<Instance>,
        origin: DVec3,
    ) -> Result<Self, GeometryError> {
        let meshes = Arc::clone(&self.meshes);
        let placed = (instances, origin);
        let geometry = Self::placed(meshes, &self.trees, placed, MOST_REPEATED)?;
        Ok(geometry.at_level(self.level))
    }

    /// Meshes, placed, with their trees as far as these are there already.
    fn placed(
        meshes: Arc<[TriangleMesh]>,
        trees: &[Arc<TriangleTree>],
        (instances, origin): (Vec<Instance>, DVec3),
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
                Placement::new(number, instance, origin, center)
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
        let around = boxes.iter().copied().fold(Bounds::EMPTY, Bounds::union);
        let widened: Vec<_> = boxes
            .iter()
            .copied()
            .map(slab::widened_for_culling)
            .collect();
        let (tree, leaves) = WideTree::build(&widened, 1);
        let farthest = widened.iter().map(Bounds::farthest).fold(0.0, f32::max);
        let order = || leaves.iter().flat_map(LeafItems::as_slice);
        Ok(Self {
            meshes,
            trees,
            placements,
            origin,
            around,
            tree,
            farthest,
            carriers: order().map(|&leaf| carriers[leaf as usize]).collect(),
            boxes: order()
                .map(|&leaf| slab::widened_for_hits(boxes[leaf as usize]))
                .collect(),
            level: Level::best(),
        })
    }

    /// Selects the vector instructions for tracing; hits have the same bits at every level.
    #[must_use]
    pub fn at_level(mut self, level: Level) -> Self {
        self.level = level;
        self
    }

    /// The surface at a hit.
    pub fn surface(&self, hit: &Hit) -> SurfacePoint {
        let (placement, mesh, corners) = self.at(hit);
        SurfacePoint::at(hit, corners, mesh, placement)
    }

    /// The instance and the mesh of a hit, and the corners of its triangle in the frame in which it is
    /// traced.
    #[inline]
    fn at(&self, hit: &Hit) -> (&Placement, &TriangleMesh, [Vec3; 3]) {
        let placement = &self.placements[hit.instance as usize];
        let mesh = &self.meshes[placement.instance.mesh as usize];
        let tree = &self.trees[placement.carrier.tree as usize];
        let block = &tree.blocks[hit.place as usize / LANES];
        (placement, mesh, block.corners(hit.place as usize % LANES))
    }

    /// How texture coordinates lie on the surface at a hit; `None` if they do not span the triangle.
    pub(crate) fn texture_scale(&self, hit: &Hit) -> Option<TextureScale> {
        let (placement, mesh, corners) = self.at(hit);
        TextureScale::at(hit, corners, mesh, placement)
    }

    /// The colour of the mesh's vertices, interpolated to a hit; white if they have none.
    pub fn colour(&self, hit: &Hit) -> [f32; 3] {
        let mesh = &self.meshes[self.placements[hit.instance as usize].instance.mesh as usize];
        let colours = mesh.colours();
        colours.map_or([1.0; 3], |colours| interpolated(mesh, hit, colours))
    }

    /// The direction in the world of the x axis of a map of normals, of any length, interpolated from
    /// the mesh's tangents to a hit, and the sign with which the shading normal times it is the y
    /// axis; `None` if they are not given there.
    pub fn tangent(&self, hit: &Hit) -> Option<(Vec3, f32)> {
        let placement = &self.placements[hit.instance as usize];
        let mesh = &self.meshes[placement.instance.mesh as usize];
        let [x, y, z, sign] = interpolated(mesh, hit, mesh.tangents()?);
        let tangent = placement.instance.linear * Vec3::new(x, y, z);
        let sign = if placement.is_mirrored { -sign } else { sign };
        (tangent != Vec3::ZERO && sign != 0.0).then_some((tangent, sign.signum()))
    }

    /// How texture coordinates change along two unit directions in the plane of the surface at a hit,
    /// 1/m; not at all if the triangle is degenerate.
    pub(crate) fn uv_per_metre(&self, hit: &Hit, directions: [Vec3; 2]) -> [Vec2; 2] {
        let (placement, mesh, corners) = self.at(hit);
        surface::uv_per_metre(hit, corners, (mesh, placement), directions)
    }

    /// The point of the scene around which rays are traced: it is the origin of their coordinates.
    pub fn origin(&self) -> DVec3 {
        self.origin
    }

    /// Smallest and largest coordinates of all instances' boxes, m, around [`Geometry::origin`]; both
    /// the origin if there are none.
    pub fn bounds(&self) -> (Vec3, Vec3) {
        if self.around.is_empty() {
            return (Vec3::ZERO, Vec3::ZERO);
        }
        (self.around.min, self.around.max)
    }

    /// Area of one side of all triangles of an instance, m².
    pub fn area_of(&self, instance: u32) -> f64 {
        let placed = self.instance(instance);
        let mesh = self.mesh(placed.mesh);
        let linear = placed.linear.as_dmat3();
        let area = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|vertex| mesh.positions()[vertex as usize].as_dvec3());
            0.5 * (linear * (b - a)).cross(linear * (c - a)).length()
        };
        mesh.triangles().iter().map(area).sum()
    }

    /// Number of instances.
    pub fn instances(&self) -> u32 {
        self.placements.len() as u32
    }

    /// Smallest and largest coordinates of an instance's box in the scene, m, as exact as its place.
    pub fn bounds_of(&self, instance: u32) -> (DVec3, DVec3) {
        let placement = &self.placements[instance as usize];
        let own = &placement.instance;
        let (mesh, to_scene) = (self.mesh(own.mesh), own.to_scene());
        if placement.carrier.tree < self.meshes.len() as u32 {
            let hull = &self.trees[own.mesh as usize].hull;
            let center = triangle_tree::center_of(mesh).as_dvec3();
            let offset = to_scene.transform_point3(center);
            return Bounds::of_transformed(hull, &to_scene.matrix3, offset);
        }
        let around = |[a, b]: [DVec3; 2], [c, d]: [DVec3; 2]| [a.min(c), b.max(d)];
        let nowhere = || [DVec3::INFINITY, DVec3::NEG_INFINITY];
        let triangles = 0..mesh.triangles().len() as u32;
        let [least, most] = triangles
            .into_par_iter()
            .flat_map_iter(|triangle| mesh.corners(triangle))
            .map(|corner| [to_scene.transform_point3(corner.as_dvec3()); 2])
            .reduce(nowhere, around);
        (least, most)
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

    /// All meshes.
    pub fn meshes(&self) -> &[TriangleMesh] {
        &self.meshes
    }

    /// A mesh by number.
    pub fn mesh(&self, i: u32) -> &TriangleMesh {
        &self.meshes[i as usize]
    }

    /// An instance by number.
    pub fn instance(&self, i: u32) -> &Instance {
        &self.placements[i as usize].instance
    }

    /// From the frame of an instance's mesh to that of rays.
    pub fn to_world(&self, i: u32) -> Affine3A {
        self.instance(i).around(self.origin)
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

/// What vertices have, interpolated to a hit.
fn interpolated<const N: usize>(mesh: &TriangleMesh, hit: &Hit, values: &[[f32; N]]) -> [f32; N] {
    let corners = mesh.triangles()[hit.triangle as usize];
    let [a, b, c] = corners.map(|vertex| values[vertex as usize]);
    let first = 1.0 - hit.b1 - hit.b2;
    std::array::from_fn(|i| first * a[i] + hit.b1 * b[i] + hit.b2 * c[i])
}

#[cfg(test)]
mod tests;
