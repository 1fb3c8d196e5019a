//! A compound leaf that lies on the ground.
//!
//! Each leaflet has come to lie by its own weight ([`crate::blade::stance`]); its axes are straight.
//! The whole then lies on three points, with its centre over the triangle between them.

use glam::{DAffine3, DVec3};

use super::{Placement, WholeLeaf};
use crate::leaf::Leaf;
use crate::rest::{Contact, support};
use crate::rotation::about;

/// Moves a leaflet so that its petiolule begins at a place on the axis.
pub(super) fn join(placement: &mut Placement, leaf: &Leaf, axis: DVec3) {
    let stalk = leaf.petiole.as_ref().expect("a leaflet has a petiolule");
    // The pole of a stalk's foot is its first vertex.
    let foot = stalk.positions[0];
    let moved = axis - placement.to_leaf.transform_point3(foot);
    placement.to_leaf = DAffine3::from_translation(moved) * placement.to_leaf;
}

impl WholeLeaf {
    /// Turns the leaf so that it lies on three of its points, and lifts it onto the plane z = 0.
    pub(super) fn put_on_ground(&mut self) {
        let points = self.lowest_points();
        let centre = points.iter().copied().sum::<DVec3>() / points.len() as f64;
        let contacts: Vec<_> = points
            .iter()
            .map(|point| Contact {
                at: (point - centre).truncate(),
                lift: -point.z,
                height: 0.0,
            })
            .collect();
        if let Some(support) = support(&contacts) {
            let up = support.slope.extend(1.0).normalize();
            let axis = up.cross(DVec3::Z);
            let sine = axis.length();
            if sine > 0.0 {
                let turn = about(axis / sine, libm::atan2(sine, up.z));
                self.transform(DAffine3::from_mat3(turn));
            }
        }
        let points = self.lowest_points();
        let lowest = points.iter().map(|p| p.z).fold(f64::INFINITY, f64::min);
        self.transform(DAffine3::from_translation(DVec3::Z * -lowest));
    }

    fn transform(&mut self, by: DAffine3) {
        for placement in &mut self.placements {
            placement.to_leaf = by * placement.to_leaf;
        }
        if let Some(axes) = &mut self.axes {
            for position in &mut axes.positions {
                *position = by.transform_point3(*position);
            }
            for normal in &mut axes.normals {
                *normal = by.transform_vector3(*normal);
            }
        }
    }

    /// All vertices; those of blades as low as a closed blade's lower face.
    fn lowest_points(&self) -> Vec<DVec3> {
        let axes = self.axes.iter().flat_map(|axes| &axes.positions).copied();
        let mut points: Vec<_> = axes.collect();
        for placement in &self.placements {
            let (leaf, to_leaf) = (&self.blades[placement.blade], placement.to_leaf);
            let mesh = &leaf.mesh;
            for (number, &p) in mesh.positions.iter().enumerate() {
                // The leaflet's own direction across the blade is turned and scaled with it.
                let half = match mesh.across.get(number) {
                    Some(&across) => {
                        let across = to_leaf.transform_vector3(across);
                        0.5 * mesh.thickness_mm[number] * across.z.abs()
                    }
                    None => 0.0,
                };
                points.push(to_leaf.transform_point3(p) - DVec3::Z * half);
            }
            let stalk = leaf.petiole.iter().flat_map(|stalk| &stalk.positions);
            points.extend(stalk.map(|&p| to_leaf.transform_point3(p)));
        }
        points
    }
}
