//! Ridges that a tight crumple has turned over.

use glam::DVec3;

use super::{BladeMesh, vertex_normals};

/// How often corners of triangles that are turned over are moved.
const SMOOTHINGS: usize = 40;
/// After so many times, neighbours one ring farther away move as well.
const WIDENED_AFTER: usize = 4;

impl BladeMesh {
    /// Draws the corners of triangles that are turned over towards their neighbours. In a crumpled
    /// blade a ridge of relief may fold over itself.
    pub(super) fn smooth_turned_over(&mut self) {
        for round in 0..SMOOTHINGS {
            let mut moved = vec![false; self.positions.len()];
            for &v in self.turned_over().flatten() {
                moved[v as usize] = true;
            }
            if !moved.contains(&true) {
                return;
            }
            for _ in 0..round / WIDENED_AFTER {
                let near = moved.clone();
                for corners in &self.triangles {
                    if corners.iter().any(|&v| near[v as usize]) {
                        for &v in corners {
                            moved[v as usize] = true;
                        }
                    }
                }
            }
            let mut means = vec![(DVec3::ZERO, 0.0); self.positions.len()];
            for &[a, b, c] in &self.triangles {
                for [v, from, to] in [[a, b, c], [b, c, a], [c, a, b]] {
                    if moved[v as usize] {
                        let (sum, count) = &mut means[v as usize];
                        *sum += self.positions[from as usize] + self.positions[to as usize];
                        *count += 2.0;
                    }
                }
            }
            for (position, (sum, count)) in self.positions.iter_mut().zip(means) {
                if count > 0.0 {
                    *position = sum / count;
                }
            }
            self.renew_normals(&moved);
            // Where the blade is crumpled, only its surface tells the way across.
            for (v, across) in self.across.iter_mut().enumerate() {
                if moved[v] {
                    *across = self.normals[v];
                }
            }
        }
    }

    /// Normals of the corners of all triangles of which a vertex has moved.
    fn renew_normals(&mut self, moved: &[bool]) {
        let mut stale = vec![false; moved.len()];
        for corners in &self.triangles {
            if corners.iter().any(|&v| moved[v as usize]) {
                for &v in corners {
                    stale[v as usize] = true;
                }
            }
        }
        let near: Vec<[u32; 3]> = self
            .triangles
            .iter()
            .filter(|corners| corners.iter().any(|&v| stale[v as usize]))
            .copied()
            .collect();
        // The others keep theirs: of their triangles some are missing here.
        let renewed = vertex_normals(&self.positions, &near);
        for ((normal, renewed), stale) in self.normals.iter_mut().zip(renewed).zip(stale) {
            if stale {
                *normal = renewed;
            }
        }
    }
}
