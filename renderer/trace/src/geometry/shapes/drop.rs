//! A drop of water on a surface.

use std::f64::consts::PI;

use document::declared::{Declared, Defaults};
use glam::DVec3;

use super::globe::globe;
use crate::geometry::{MeshError, TriangleMesh};

/// A cap of a sphere, as a drop is that is too small for gravity to flatten it (water: below some
/// 2 mm). It stands on z = 0 around the origin and has no base: what it stands on is its lower side.
#[derive(Clone, Debug, Declared, Defaults)]
pub struct Drop {
    /// Volume; up to 1 or 2 µl gravity hardly flattens a drop of water, above it does, and the shape
    /// is no longer that of water.
    ///
    /// In m³.
    #[key("volume_ul", required, nano(1e-6..=1000.0), default = 1e-9)]
    pub volume: f64,
    /// Angle in the water between the leaf and the drop's side: some 40 to 90 on most leaves, over 140
    /// on those that repel it.
    ///
    /// Radians.
    #[key("contact_angle_deg", degrees(5.0..=170.0), default = 1.5)]
    pub contact_angle: f64,
    /// Triangles around it, half as many from rim to top.
    #[key("segments", 8..=4096, default = 64)]
    pub segments: u32,
}

/// How far the side goes on below the surface on which the drop stands, as a share of the radius of
/// its foot: a leaf is not quite flat.
const SKIRT: f64 = 0.03;

impl Drop {
    /// Radius of the sphere, m: V = π R³ (2 + cos θ) (1 − cos θ)² / 3.
    pub(super) fn radius(&self) -> f64 {
        let cos = libm::cos(self.contact_angle);
        let of_unit = PI / 3.0 * (2.0 + cos) * (1.0 - cos) * (1.0 - cos);
        libm::cbrt(self.volume / of_unit)
    }

    /// Its surface, normals to the outside.
    ///
    /// # Errors
    ///
    /// [`MeshError`] if it is too small for single precision.
    pub fn mesh(&self) -> Result<TriangleMesh, MeshError> {
        let (radius, cos) = (self.radius(), libm::cos(self.contact_angle));
        let middle = DVec3::Z * (-radius * cos);
        let lowest = (cos - SKIRT * libm::sin(self.contact_angle)).max(-0.9999);
        globe(self.segments, libm::acos(lowest), |direction| {
            ((middle + radius * direction).as_vec3(), direction.as_vec3())
        })
    }
}
