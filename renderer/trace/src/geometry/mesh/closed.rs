//! Whether a mesh encloses a body.

use std::collections::{BTreeMap, HashMap};

use glam::Vec3;

use super::TriangleMesh;

/// Distance, as a share of the mesh's size, within which vertices count as the same: the poles and
/// seams of shapes differ by roundings.
const SAME: f32 = 1e-6;

impl TriangleMesh {
    /// Whether the mesh is the whole boundary of a body, with its normals to the outside: each edge
    /// is passed as often one way as the other, and the volume is above 0.
    pub fn encloses_a_body(&self) -> bool {
        let (least, most) = self.bounds();
        let cell = SAME * (most - least).max_element();
        let numbers = welded(self.positions(), self.triangles(), least, cell);
        let mut passes: BTreeMap<[u32; 2], i64> = BTreeMap::new();
        let mut volume = 0.0;
        for triangle in self.triangles() {
            let corners = triangle.map(|index| numbers[index as usize]);
            for i in 0..3 {
                let (from, to) = (corners[i], corners[(i + 1) % 3]);
                if from != to {
                    let (edge, way) = if from < to {
                        ([from, to], 1)
                    } else {
                        ([to, from], -1)
                    };
                    *passes.entry(edge).or_default() += way;
                }
            }
            let at = |i: usize| (self.positions()[triangle[i] as usize] - least).as_dvec3();
            volume += at(0).dot(at(1).cross(at(2)));
        }
        volume > 0.0 && passes.values().all(|passes| *passes == 0)
    }
}

/// A number for each vertex that a face uses, the same for vertices in the same place.
fn welded(positions: &[Vec3], triangles: &[[u32; 3]], origin: Vec3, cell: f32) -> Vec<u32> {
    let key = |place: Vec3| {
        let place = (place - origin).as_dvec3() / f64::from(cell.max(f32::MIN_POSITIVE));
        place.to_array().map(|x| x.round() as i64)
    };
    let mut numbers = vec![u32::MAX; positions.len()];
    let mut known: HashMap<[i64; 3], u32> = HashMap::new();
    for &index in triangles.iter().flatten() {
        let index = index as usize;
        if numbers[index] != u32::MAX {
            continue;
        }
        let own = key(positions[index]);
        // What lies in the next cell may be nearer than what lies in its own.
        let around = (0..27_i64).map(|i| [i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1]);
        let found = around
            .map(|by| [own[0] + by[0], own[1] + by[1], own[2] + by[2]])
            .find_map(|cell| known.get(&cell).copied());
        let number = found.unwrap_or(index as u32);
        known.entry(own).or_insert(number);
        numbers[index] = number;
    }
    numbers
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::shapes::{Cuboid, Disc, Drop, Lump, Sphere};

    #[test]
    fn spheres_boxes_and_pebbles_enclose_bodies_and_drops_and_sheets_do_not() {
        for segments in [8, 64, 97, 333] {
            let radius = 1e-3;
            let ball = Sphere { radius, segments }.mesh().expect("a mesh");
            assert!(ball.encloses_a_body(), "{segments}");
        }
        let size = [2.0, 1e-3, 0.7];
        let cuboid = Cuboid { size }.mesh().expect("a mesh");
        assert!(cuboid.encloses_a_body());
        let lump = Lump {
            radius: 0.004,
            angularity: 0.5,
            irregularity: 0.4,
            segments: 48,
            seed: 3,
        };
        assert!(lump.mesh().expect("a mesh").encloses_a_body());
        let drop = Drop {
            volume: 1e-9,
            contact_angle: 1.5,
            segments: 64,
        };
        assert!(!drop.mesh().expect("a mesh").encloses_a_body());
        let disc = Disc::default().mesh().expect("a mesh");
        assert!(!disc.encloses_a_body());
    }

    #[test]
    fn a_hole_or_normals_to_the_inside_are_found() {
        let (radius, segments) = (1.0, 32);
        let ball = Sphere { radius, segments }.mesh().expect("a mesh");
        let mut triangles = ball.triangles().to_vec();
        let turned = triangles.iter().map(|&[a, b, c]| [a, c, b]).collect();
        triangles.swap_remove(100);
        for triangles in [triangles, turned] {
            let positions = ball.positions().to_vec();
            let mesh = TriangleMesh::new(positions, None, None, triangles).expect("a mesh");
            assert!(!mesh.encloses_a_body());
        }
    }
}
