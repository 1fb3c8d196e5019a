//! Triangles with a tree over them: those of one mesh, or of several that stand in the world.

use glam::Vec3;
use numerics::memory;
use rayon::prelude::*;

use super::super::bounds::Bounds;
use super::super::mesh::TriangleMesh;
use super::super::placement::Placement;
use super::super::triangle::TriangleBlock;
use super::super::wide_tree::{LeafItems, WideTree};
use super::joining::Joined;
use crate::simd::LANES;

/// Number of boxes that represent a mesh when the box of an instance is computed. For 10,000
/// rotated leaves, 8 boxes give 0.81 of the area and 64 give 0.63, so fewer boxes are entered in
/// vain. With 256 boxes rays are at most 3 % faster than with 64.
const HULL_BOXES: usize = 128;

/// Triangles with their tree, in a frame moved so that the centre of their bounds is the origin. So
/// a mesh far from the origin of its file keeps its detail.
#[derive(Debug)]
pub(super) struct TriangleTree {
    pub(super) tree: WideTree,
    /// The leaves of the tree, and after them the walls.
    pub(super) blocks: Vec<TriangleBlock>,
    /// Of joined meshes, the instance whose triangles are in each block. Empty for one mesh, which
    /// any number of instances may share.
    owners: Vec<u32>,
    /// Boxes around the blocks beside the tree: of meshes of a few triangles, so large that boxes
    /// widened for the rounding of rays to them would be too wide for the others.
    wall_boxes: Vec<Bounds>,
    /// The box around all of them.
    pub(super) wall_bounds: Bounds,
    /// Boxes that enclose the rotated triangles more tightly than the tree's own box.
    pub(super) hull: Vec<Bounds>,
}

impl TriangleTree {
    /// The tree of one mesh in its own frame.
    pub(super) fn of_mesh(mesh: &TriangleMesh) -> Self {
        let center = center_of(mesh);
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
            tree,
            blocks,
            owners: Vec::new(),
            wall_boxes: Vec::new(),
            wall_bounds: Bounds::EMPTY,
        }
    }

    /// The tree of a mesh by which no instance is traced.
    pub(super) fn none() -> Self {
        let (tree, _) = WideTree::build(&[], 8);
        Self {
            tree,
            blocks: Vec::new(),
            owners: Vec::new(),
            wall_boxes: Vec::new(),
            wall_bounds: Bounds::EMPTY,
            hull: Vec::new(),
        }
    }

    /// One tree over placed meshes in the world.
    pub(super) fn joined(
        meshes: &[TriangleMesh],
        placements: &[Placement],
        joined: &Joined,
    ) -> Self {
        let center = joined.center.as_dvec3();
        let corners = |instance: u32, triangle: u32| {
            let placement = &placements[instance as usize];
            let mesh = &meshes[placement.instance.mesh as usize];
            let own_center = center_of(mesh).as_dvec3();
            mesh.corners(triangle).map(|corner| {
                let local = corner.as_dvec3() - own_center;
                (placement.to_world(local) - center).as_vec3()
            })
        };
        let count = |instance: u32| {
            let mesh = placements[instance as usize].instance.mesh;
            meshes[mesh as usize].triangles().len() as u32
        };
        // The triangles of all instances are numbered one after the other.
        let mut firsts = vec![0];
        for &instance in &joined.instances {
            firsts.push(firsts[firsts.len() - 1] + count(instance) as usize);
        }
        let boxes: Vec<_> = (joined.instances.par_iter())
            .flat_map(|&instance| {
                let triangles = (0..count(instance)).into_par_iter();
                triangles.map(move |triangle| Bounds::around(corners(instance, triangle)))
            })
            .collect();
        let (tree, leaves) = WideTree::build_parts(&boxes, &firsts, 8);
        let member_of = |leaf: &LeafItems| {
            let item = leaf.as_slice()[0] as usize;
            firsts.partition_point(|&first| first <= item) - 1
        };
        let mut blocks = memory::room_for(leaves.len() + joined.walls.len());
        leaves
            .par_iter()
            .map(|leaf| {
                let member = member_of(leaf);
                let (instance, first) = (joined.instances[member], firsts[member] as u32);
                let triangle = |&item: &u32| (item - first, corners(instance, item - first));
                TriangleBlock::new(leaf.as_slice().iter().map(triangle))
            })
            .collect_into_vec(&mut blocks);
        let mut owners: Vec<_> = leaves
            .iter()
            .map(|leaf| joined.instances[member_of(leaf)])
            .collect();
        let mut hull = tree.hull(HULL_BOXES);
        let mut wall_boxes = Vec::with_capacity(joined.walls.len());
        for &instance in &joined.walls {
            let triangles: Vec<_> = (0..count(instance))
                .map(|triangle| (triangle, corners(instance, triangle)))
                .collect();
            let bounds = Bounds::around(triangles.iter().flat_map(|(_, corners)| *corners));
            blocks.push(TriangleBlock::new(triangles));
            owners.push(instance);
            hull.push(bounds);
            wall_boxes.push(bounds);
        }
        Self {
            hull,
            owners,
            tree,
            blocks,
            wall_bounds: wall_boxes
                .iter()
                .copied()
                .fold(Bounds::EMPTY, Bounds::union),
            wall_boxes,
        }
    }

    /// The blocks beside the tree, with the boxes around them.
    #[inline]
    pub(super) fn walls(&self) -> impl Iterator<Item = (u32, &Bounds)> {
        let first = self.blocks.len() - self.wall_boxes.len();
        (first as u32..).zip(&self.wall_boxes)
    }

    /// Of joined meshes, the instance of a triangle by its place.
    #[inline]
    pub(super) fn owner(&self, place: u32) -> Option<u32> {
        self.owners.get(place as usize / LANES).copied()
    }

    pub(super) fn memory_bytes(&self) -> usize {
        self.tree.memory_bytes()
            + self.blocks.capacity() * size_of::<TriangleBlock>()
            + self.owners.capacity() * size_of::<u32>()
    }
}

/// The centre of a mesh's bounds.
pub(super) fn center_of(mesh: &TriangleMesh) -> Vec3 {
    let (min, max) = mesh.bounds();
    Bounds { min, max }.center()
}
