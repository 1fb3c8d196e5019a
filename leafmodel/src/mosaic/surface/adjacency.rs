//! Adjacency of faces: vertices at the same place are merged, and edges are paired.

use glam::DVec3;

use crate::not_grown::{NotGrown, not_grown};

/// Greatest number of vertices or faces; beyond it, edge numbers would overflow.
const MOST: usize = 1 << 30;

pub(super) fn check_finite(positions: &[DVec3]) -> Result<(), NotGrown> {
    match positions.iter().position(|at| !at.is_finite()) {
        Some(vertex) => Err(not_grown!(
            "vertex {vertex} is at {at}, which is not finite",
            at = positions[vertex]
        )),
        None => Ok(()),
    }
}

/// The mesh with equal positions merged, each to the first vertex that has it. Unused vertices are
/// kept.
pub(super) fn welded(
    positions: Vec<DVec3>,
    mut faces: Vec<[u32; 3]>,
) -> Result<(Vec<DVec3>, Vec<[u32; 3]>), NotGrown> {
    if faces.is_empty() {
        return Err(NotGrown::because("the mesh has no faces"));
    }
    let count = faces.len().max(positions.len());
    if count > MOST {
        return Err(not_grown!(
            "the mesh has {count} faces or vertices, more than 2³⁰"
        ));
    }
    for (face, corners) in faces.iter().enumerate() {
        if let Some(&vertex) = corners.iter().find(|&&id| id as usize >= positions.len()) {
            return Err(not_grown!(
                "face {face} names vertex {vertex}, but there are {vertices} (from 0)",
                vertices = positions.len()
            ));
        }
    }
    check_finite(&positions)?;
    // Adding zero makes both zeros one.
    let key = |id: u32| (positions[id as usize] + 0.0).to_array().map(f64::to_bits);
    let mut order: Vec<u32> = (0..positions.len() as u32).collect();
    order.sort_by_key(|&id| (key(id), id));
    let mut first: Vec<u32> = (0..positions.len() as u32).collect();
    for pair in 1..order.len() {
        let (before, id) = (order[pair - 1], order[pair]);
        if key(before) == key(id) {
            first[id as usize] = first[before as usize];
        }
    }
    for corners in &mut faces {
        *corners = corners.map(|id| first[id as usize]);
    }
    Ok((positions, faces))
}

/// A key for each edge that only faces at that edge share: its two vertices.
pub(super) fn keys_of_vertices(faces: &[[u32; 3]]) -> Vec<[u64; 3]> {
    let key = |a: u32, b: u32| (u64::from(a.min(b)) << 32) | u64::from(a.max(b));
    faces
        .iter()
        .map(|&[a, b, c]| [key(a, b), key(b, c), key(c, a)])
        .collect()
}

/// For each edge of each face the neighbour and the number of the shared edge in it.
pub(super) type Pairs = (Vec<[u32; 3]>, Vec<[u8; 3]>);

/// Pairs edges of equal key.
pub(super) fn pair(
    positions: &[DVec3],
    faces: &[[u32; 3]],
    keys: &[[u64; 3]],
) -> Result<Pairs, NotGrown> {
    let mut edges: Vec<(u64, u32, u8)> = Vec::with_capacity(3 * faces.len());
    for (face, keys) in keys.iter().enumerate() {
        for (edge, &key) in keys.iter().enumerate() {
            edges.push((key, face as u32, edge as u8));
        }
    }
    edges.sort_unstable();
    let mut neighbours = vec![[NONE; 3]; faces.len()];
    let mut neighbour_edges = vec![[0; 3]; faces.len()];
    for group in edges.chunk_by(|a, b| a.0 == b.0) {
        let (_, face, edge) = group[0];
        let (start, end) = ends(faces, face, edge);
        if group.len() > 2 {
            let (from, to) = (positions[start as usize], positions[end as usize]);
            let faces: Vec<u32> = group.iter().map(|&(_, face, _)| face).collect();
            return Err(not_grown!(
                "not a manifold: the edge from {from} mm to {to} mm has {} faces ({})",
                faces.len(),
                list(&faces)
            ));
        }
        let Some(&(_, other, theirs)) = group.get(1) else {
            continue;
        };
        // A degenerate face may have an edge twice; it has no area, which is detected when the
        // faces are flattened.
        if face != other && ends(faces, other, theirs).0 == start {
            let (from, to) = (positions[start as usize], positions[end as usize]);
            return Err(not_grown!(
                "faces {face} and {other} are of opposite orientation: both run along their edge \
                 from {from} mm to {to} mm"
            ));
        }
        neighbours[face as usize][usize::from(edge)] = other;
        neighbour_edges[face as usize][usize::from(edge)] = theirs;
        neighbours[other as usize][usize::from(theirs)] = face;
        neighbour_edges[other as usize][usize::from(theirs)] = edge;
    }
    Ok((neighbours, neighbour_edges))
}

fn list(faces: &[u32]) -> String {
    let shown: Vec<String> = faces.iter().take(6).map(u32::to_string).collect();
    let more = if faces.len() > 6 { ", …" } else { "" };
    shown.join(", ") + more
}

fn ends(faces: &[[u32; 3]], face: u32, edge: u8) -> (u32, u32) {
    let corners = faces[face as usize];
    let edge = usize::from(edge);
    (corners[edge], corners[(edge + 1) % 3])
}

/// Marks the missing neighbour at a margin.
pub(super) const NONE: u32 = u32::MAX;
