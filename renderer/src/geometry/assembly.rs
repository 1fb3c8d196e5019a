//! Instanced meshes, against which rays are traced.

use std::sync::Arc;

use glam::{DAffine3, DMat3, DVec3, Mat3, Vec2, Vec3, Vec3A};
use rayon::prelude::*;
use thiserror::Error;

use super::bounds::Bounds;
pub use super::hit::Hit;
use super::instance::Instance;
use super::memory;
use super::mesh::TriangleMesh;
use super::placement::{Carrier, Placement};
use super::ray::Ray;
use super::surface::{self, SurfacePoint, TextureScale};
use super::triangle::TriangleBlock;
use super::wide_tree::{LeafItems, WideTree};
use crate::simd::{LANES, Level};
use search::{AnyHit, NearestHit, Search};

mod search;

/// Instanced meshes with their trees. Immutable and shared by all threads.
#[derive(Clone, Debug)]
pub struct Geometry {
    /// Shared with geometries of the same meshes in other places.
    meshes: Arc<[TracedMesh]>,
    placements: Vec<Placement>,
    tree: WideTree,
    /// The instance of each leaf of `tree`.
    carriers: Vec<Carrier>,
    /// Its box in the world.
    boxes: Vec<Bounds>,
    level: Level,
}

/// Why meshes and instances were refused.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum GeometryError {
    /// An instance refers to a mesh that does not exist.
    #[error(
        "instance {instance} names mesh {mesh}, but there are {meshes} meshes (counted from 0)"
    )]
    NoSuchMesh {
        /// Number of the instance.
        instance: usize,
        /// The missing mesh.
        mesh: u32,
        /// Number of meshes.
        meshes: usize,
    },
    /// A transform is not finite, flattens the mesh, or takes it beyond what `f32` can hold.
    #[error("the transform of instance {instance} {what}")]
    Transform {
        /// Number of the instance.
        instance: usize,
        /// What is wrong with it.
        what: &'static str,
    },
    /// There are more instances than can be numbered.
    #[error("there are {given} instances; the most is {MOST_INSTANCES}")]
    TooManyInstances {
        /// How many there are.
        given: usize,
    },
}

/// Number of boxes that represent a mesh when the box of an instance is computed. For 10,000
/// rotated leaves, 8 boxes give 0.81 of the area and 64 give 0.63, so fewer boxes are entered in
/// vain. With 256 boxes rays are at most 3 % faster than with 64.
const HULL_BOXES: usize = 128;

/// Instances and tree nodes share 32 bits.
const MOST_INSTANCES: usize = 1 << 29;

/// A mesh with its tree, in the mesh's frame, moved so that the centre of its bounds is the origin.
/// So a mesh far from the origin of its file keeps its detail.
#[derive(Clone, Debug)]
struct TracedMesh {
    mesh: TriangleMesh,
    center: Vec3,
    tree: WideTree,
    blocks: Vec<TriangleBlock>,
    /// Boxes that enclose the rotated mesh more tightly than the tree's own box.
    hull: Vec<Bounds>,
}

impl Placement {
    fn new(number: usize, instance: Instance, center: Vec3) -> Result<Self, GeometryError> {
        let refuse = |what| GeometryError::Transform {
            instance: number,
            what,
        };
        let to_world = DAffine3 {
            matrix3: DMat3::from_cols(
                Vec3::from(instance.to_world.matrix3.x_axis).as_dvec3(),
                Vec3::from(instance.to_world.matrix3.y_axis).as_dvec3(),
                Vec3::from(instance.to_world.matrix3.z_axis).as_dvec3(),
            ),
            translation: Vec3::from(instance.to_world.translation).as_dvec3(),
        };
        let linear = to_world.matrix3;
        let offset = to_world.transform_point3(center.as_dvec3());
        if !linear.is_finite() || !offset.is_finite() {
            return Err(refuse("is not finite"));
        }
        let size = linear.x_axis.length() * linear.y_axis.length() * linear.z_axis.length();
        // The determinant is relative to the lengths of the axes. Below this, rounding in f32 would
        // decide where the mesh is.
        if linear.determinant().abs() <= size * 1e-6 || size == 0.0 {
            return Err(refuse(
                "flattens the mesh: it has no inverse that 32-bit numbers can hold",
            ));
        }
        let inverse = linear.inverse();
        let carrier = Carrier {
            linear: inverse.as_mat3(),
            offset: (-(inverse * offset)).as_vec3(),
            mesh: instance.mesh,
            instance: number as u32,
        };
        if !carrier.linear.is_finite() || !carrier.offset.is_finite() {
            return Err(refuse("has an inverse beyond 32-bit numbers"));
        }
        Ok(Self {
            instance,
            linear,
            offset,
            normals: inverse.transpose(),
            linear_f32: rescaled(linear),
            normals_f32: rescaled(inverse.transpose()),
            carrier,
        })
    }

    /// For each coordinate, the sum of the magnitudes of the terms that carry a world point into
    /// the local frame.
    pub(super) fn to_local_size(&self, world: DVec3) -> DVec3 {
        let columns = self.carrier.linear;
        columns.x_axis.abs().as_dvec3() * world.x.abs()
            + columns.y_axis.abs().as_dvec3() * world.y.abs()
            + columns.z_axis.abs().as_dvec3() * world.z.abs()
            + self.carrier.offset.abs().as_dvec3()
    }

    /// A box around the mesh in the world.
    fn world_bounds(&self, mesh: &TracedMesh) -> Bounds {
        Bounds::around_transformed(&mesh.hull, &self.linear, self.offset)
    }
}

/// A transform of directions in single precision, scaled so that its numbers are near 1.
fn rescaled(matrix: DMat3) -> Mat3 {
    let size = matrix.x_axis.length() + matrix.y_axis.length() + matrix.z_axis.length();
    (matrix * (1.0 / size)).as_mat3()
}

impl TracedMesh {
    fn build(mesh: TriangleMesh) -> Self {
        let (min, max) = mesh.bounds();
        let center = Bounds { min, max }.center();
        let corners = |triangle: u32| {
            // In f64, since the difference of two f32 numbers may need more digits before it is
            // rounded once.
            mesh.corners(triangle)
                .map(|corner| (corner.as_dvec3() - center.as_dvec3()).as_vec3())
        };
        let count = mesh.triangles().len() as u32;
        let boxes: Vec<_> = (0..count)
            .into_par_iter()
            .map(|triangle| Bounds::around(corners(triangle)))
            .collect();
        let (tree, leaves) = WideTree::build(&boxes, 8);
        let mut blocks = memory::room_for(leaves.len());
        leaves
            .par_iter()
            .map(|leaf| TriangleBlock::new(leaf.as_slice().iter().map(|&id| (id, corners(id)))))
            .collect_into_vec(&mut blocks);
        Self {
            hull: tree.hull(HULL_BOXES),
            mesh,
            center,
            tree,
            blocks,
        }
    }
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
        if instances.len() > MOST_INSTANCES {
            return Err(GeometryError::TooManyInstances {
                given: instances.len(),
            });
        }
        for (number, instance) in instances.iter().enumerate() {
            if instance.mesh as usize >= meshes.len() {
                return Err(GeometryError::NoSuchMesh {
                    instance: number,
                    mesh: instance.mesh,
                    meshes: meshes.len(),
                });
            }
        }
        let meshes: Vec<_> = meshes.into_par_iter().map(TracedMesh::build).collect();
        Self::placed(meshes.into(), instances)
    }

    /// The same meshes with some of the instances, each moved by an offset, m; in the order given.
    ///
    /// # Errors
    ///
    /// [`GeometryError`] if there are too many, or an offset is not finite.
    pub fn with_places(&self, places: &[(u32, Vec3)]) -> Result<Self, GeometryError> {
        if places.len() > MOST_INSTANCES {
            return Err(GeometryError::TooManyInstances {
                given: places.len(),
            });
        }
        let moved = places.iter().map(|&(number, by)| {
            let mut instance = self.placements[number as usize].instance;
            instance.to_world.translation += Vec3A::from(by);
            instance
        });
        let geometry = Self::placed(Arc::clone(&self.meshes), moved.collect())?;
        Ok(geometry.at_level(self.level))
    }

    /// Meshes with their trees, placed.
    fn placed(meshes: Arc<[TracedMesh]>, instances: Vec<Instance>) -> Result<Self, GeometryError> {
        let placements = instances
            .into_iter()
            .enumerate()
            .map(|(number, instance)| {
                Placement::new(number, instance, meshes[instance.mesh as usize].center)
            })
            .collect::<Result<Vec<_>, _>>()?;
        let boxes: Vec<_> = placements
            .par_iter()
            .map(|placement| placement.world_bounds(&meshes[placement.instance.mesh as usize]))
            .collect();
        for (number, bounds) in boxes.iter().enumerate() {
            if !bounds.min.is_finite() || !bounds.max.is_finite() {
                return Err(GeometryError::Transform {
                    instance: number,
                    what: "takes the mesh beyond 32-bit numbers",
                });
            }
        }
        let (tree, leaves) = WideTree::build(&boxes, 1);
        let order = || leaves.iter().flat_map(LeafItems::as_slice);
        let carrier = |&instance: &u32| placements[instance as usize].carrier;
        let bounds = |&instance: &u32| boxes[instance as usize];
        let (carriers, boxes) = (
            order().map(carrier).collect(),
            order().map(bounds).collect(),
        );
        Ok(Self {
            meshes,
            placements,
            tree,
            carriers,
            boxes,
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
        let block = &mesh.blocks[hit.place as usize / LANES];
        let corners = block.corners(hit.place as usize % LANES);
        SurfacePoint::at(hit, corners, &mesh.mesh, placement)
    }

    /// How texture coordinates lie on the surface at a hit; `None` if they do not span the triangle.
    pub fn texture_scale(&self, hit: &Hit) -> Option<TextureScale> {
        let placement = &self.placements[hit.instance as usize];
        let mesh = &self.meshes[placement.instance.mesh as usize];
        let block = &mesh.blocks[hit.place as usize / LANES];
        let corners = block.corners(hit.place as usize % LANES);
        TextureScale::at(hit, corners, &mesh.mesh, placement)
    }

    /// How texture coordinates change along two unit directions in the plane of the surface at a hit,
    /// 1/m; not at all if the triangle is degenerate.
    pub fn uv_per_metre(&self, hit: &Hit, directions: [Vec3; 2]) -> [Vec2; 2] {
        let placement = &self.placements[hit.instance as usize];
        let mesh = &self.meshes[placement.instance.mesh as usize];
        let block = &mesh.blocks[hit.place as usize / LANES];
        let corners = block.corners(hit.place as usize % LANES);
        surface::uv_per_metre(hit, corners, (&mesh.mesh, placement), directions)
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
        let bounds = placement.world_bounds(&self.meshes[placement.instance.mesh as usize]);
        (bounds.min, bounds.max)
    }

    /// Memory of meshes and trees, bytes.
    pub fn memory_bytes(&self) -> usize {
        let meshes: usize = self
            .meshes
            .iter()
            .map(|traced| {
                traced.mesh.memory_bytes()
                    + traced.tree.memory_bytes()
                    + traced.blocks.capacity() * size_of::<TriangleBlock>()
            })
            .sum();
        meshes
            + self.tree.memory_bytes()
            + self.placements.capacity() * size_of::<Placement>()
            + self.carriers.capacity() * size_of::<Carrier>()
            + self.boxes.capacity() * size_of::<Bounds>()
    }

    /// A mesh by number.
    pub fn mesh(&self, i: u32) -> &TriangleMesh {
        &self.meshes[i as usize].mesh
    }

    /// An instance by number.
    pub fn instance(&self, i: u32) -> &Instance {
        &self.placements[i as usize].instance
    }
}

#[cfg(test)]
mod tests;
