//! Which instances are traced by one tree in the world.

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::super::bounds::Bounds;
use super::super::mesh::TriangleMesh;
use super::super::placement::Placement;
use crate::simd::LANES;

/// Greatest rounding of a vertex, as a share of a triangle's size: the side of a square of the mean
/// area.
const ROUNDING_SHARE: f64 = 1e-4;

/// Greatest widening of boxes by the rounding of rays, likewise. It goes with the size of all that
/// is joined.
const WIDENING_SHARE: f64 = 0.25;

/// That widening over the distance from the origin of the frame to its farthest point, at most.
const WIDENING: f64 = 16.0 / 16_777_216.0;

/// Greatest extent of all that is joined over that of a mesh at which neither is asked.
const NEAR: f64 = 4.0;

/// Most triangles of a wall, which stands beside the tree as one block.
const WALL_TRIANGLES: usize = LANES;

/// Most walls: a ray that may meet them tests each.
const MOST_WALLS: usize = 2;

/// Extent of a wall over that of all else, at least.
const WALL_EXTENT: f32 = 4.0;

/// Distance of what stands apart over that of all else, at least: a lamp in the sky, to which the
/// precision of what is joined cannot be that of a leaf's.
const APART: f32 = 64.0;

/// Most triangles of all instances of meshes that stand more than once, if these are joined too:
/// their copies take at most 36 MiB. A picture of six leaves takes 0.95 of the time that
/// it takes through six trees; in boughs of more than a hundred leaves joining gave nothing.
pub(super) const MOST_REPEATED: usize = 1 << 19;

/// Instances that are joined, by number, rising.
pub(super) struct Joined {
    /// In the tree.
    pub(super) instances: Vec<u32>,
    /// Beside it: few and large triangles, as of a floor, to which the tree's precision cannot be
    /// that of a leaf's.
    pub(super) walls: Vec<u32>,
    /// Origin of the frame in which they are traced, world.
    pub(super) center: Vec3,
}

impl Joined {
    /// All of them.
    pub(super) fn all(&self) -> impl Iterator<Item = u32> + '_ {
        self.instances.iter().chain(&self.walls).copied()
    }

    /// Whether an instance is among them.
    pub(super) fn contains(&self, instance: u32) -> bool {
        self.instances.binary_search(&instance).is_ok() || self.walls.contains(&instance)
    }
}

/// The instances that are traced by one tree: those whose mesh stands once, and all others if they
/// are small, as long as the world's numbers are as good as their own. None if there would be fewer
/// than two.
///
/// A ray carried from instance to instance visits the tree of each; joined, it visits one.
/// `most_repeated` is the greatest number of triangles of those others, together.
pub(super) fn choose(
    meshes: &[TriangleMesh],
    placements: &[Placement],
    most_repeated: usize,
) -> Option<Joined> {
    let mut uses = vec![0_usize; meshes.len()];
    for placement in placements {
        uses[placement.instance.mesh as usize] += 1;
    }
    let mesh_of = |placement: &Placement| &meshes[placement.instance.mesh as usize];
    let triangles = |placement: &Placement| mesh_of(placement).triangles().len();
    let is_placed_once = |placement: &Placement| uses[placement.instance.mesh as usize] == 1;
    let repeated = placements
        .iter()
        .filter(|placement| !is_placed_once(placement));
    let all_fit = repeated.map(triangles).sum::<usize>() <= most_repeated;
    let mut candidates: Vec<(u32, Bounds)> = (0..)
        .zip(placements)
        .filter(|(_, placement)| all_fit || is_placed_once(placement))
        .map(|(number, placement)| (number, rough_bounds(mesh_of(placement), placement)))
        .filter(|(_, bounds)| bounds.min.is_finite() && bounds.max.is_finite())
        .collect();
    while let Some(place) = apart_among(&candidates) {
        candidates.remove(place);
    }
    let mut walls = Vec::new();
    while let Some(place) = wall_among(&candidates)
        && triangles(&placements[candidates[place].0 as usize]) <= WALL_TRIANGLES
        && walls.len() < MOST_WALLS
    {
        walls.push(candidates.remove(place).0);
    }
    walls.sort_unstable();
    let whole = around(&candidates);
    let instances: Vec<u32> = candidates
        .into_par_iter()
        .filter(|&(number, bounds)| {
            let placement = &placements[number as usize];
            is_fine(mesh_of(placement), placement, bounds, whole)
        })
        .map(|(number, _)| number)
        .collect();
    let joined = Joined {
        instances,
        walls,
        center: whole.center(),
    };
    (!joined.instances.is_empty() && joined.all().count() >= 2).then_some(joined)
}

/// The place of the widest of some boxes, if it is much wider than all others together.
fn wall_among(boxes: &[(u32, Bounds)]) -> Option<usize> {
    let extent = |bounds: Bounds| (bounds.max - bounds.min).max_element();
    let widest = (0..boxes.len()).max_by(|&a, &b| {
        let [a, b] = [a, b].map(|place| extent(boxes[place].1));
        a.total_cmp(&b)
    })?;
    let others = around(&[&boxes[..widest], &boxes[widest + 1..]].concat());
    (!others.is_empty() && extent(boxes[widest].1) > WALL_EXTENT * extent(others)).then_some(widest)
}

/// The place of the box that reaches farthest from the origin of rays, if all of it is much farther
/// than the others reach.
fn apart_among(boxes: &[(u32, Bounds)]) -> Option<usize> {
    let reach = |place: usize| boxes[place].1.farthest();
    let farthest = (0..boxes.len()).max_by(|&a, &b| reach(a).total_cmp(&reach(b)))?;
    let others = (0..boxes.len()).filter(|&place| place != farthest);
    let others = others.map(reach).max_by(f32::total_cmp)?;
    let Bounds { min, max } = boxes[farthest].1;
    (min.max(-max).max_element() > APART * others).then_some(farthest)
}

/// The box around all.
fn around(boxes: &[(u32, Bounds)]) -> Bounds {
    let boxes = boxes.iter().map(|(_, bounds)| *bounds);
    boxes.fold(Bounds::EMPTY, Bounds::union)
}

/// A box around a placed mesh.
fn rough_bounds(mesh: &TriangleMesh, placement: &Placement) -> Bounds {
    let (min, max) = mesh.bounds();
    let center = Bounds { min, max }.center();
    let own = Bounds {
        min: min - center,
        max: max - center,
    };
    Bounds::around_transformed(&[own], &placement.linear, placement.offset)
}

/// Whether the triangles of a placed mesh in this box keep their detail among all in `whole`.
fn is_fine(mesh: &TriangleMesh, placement: &Placement, bounds: Bounds, whole: Bounds) -> bool {
    let reach = |bounds: Bounds, origin: DVec3| {
        let (min, max) = (bounds.min.as_dvec3(), bounds.max.as_dvec3());
        (min - origin).abs().max((max - origin).abs()).max_element()
    };
    let center = whole.center().as_dvec3();
    let (own, joined) = (reach(bounds, placement.offset), reach(bounds, center));
    let whole = reach(whole, center);
    if whole <= NEAR * own {
        return true;
    }
    let count = mesh.triangles().len();
    let area: f64 = (0..count as u32)
        .into_par_iter()
        .map(|triangle| {
            let [a, b, c] = mesh.corners(triangle).map(Vec3::as_dvec3);
            let edges = [placement.linear * (b - a), placement.linear * (c - a)];
            0.5 * edges[0].cross(edges[1]).length()
        })
        .sum();
    let size = (area / count as f64).sqrt();
    joined * f64::from(f32::EPSILON) * 0.5 <= ROUNDING_SHARE * size
        && whole * WIDENING <= WIDENING_SHARE * size
}
