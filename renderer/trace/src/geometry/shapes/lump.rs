//! Pebbles and crumbs.

use document::declared::{Declared, Defaults};
use glam::DVec3;

use super::globe::globe;
use crate::geometry::{MeshError, TriangleMesh};
use crate::sampling::mixer::random;

/// A stone between rounded and broken: the surface Σ (max(nᵢ · p, 0) / hᵢ)ᵏ = 1 for planes with
/// random normals nᵢ and distances hᵢ. A large k leaves flat faces and sharp edges.
#[derive(Clone, Debug, Declared, Defaults)]
pub struct Lump {
    /// Greatest distance of its faces from the middle.
    #[key("radius_m", required, above(0.0, 1e6), default = 0.001)]
    pub radius: f64,
    /// 0 is rounded by water, 1 freshly broken.
    #[key("angularity", 0.0..=1.0, default = 0.4)]
    pub angularity: f64,
    /// How much nearer some of its faces are than others.
    ///
    /// hᵢ is from 1 − this to 1 of the radius.
    #[key("irregularity", 0.0..=0.8, default = 0.4)]
    pub irregularity: f64,
    /// Triangles around it, half as many from pole to pole.
    #[key("segments", 8..=4096, default = 32)]
    pub segments: u32,
    /// Same numbers and seed, same lump.
    #[key("seed")]
    pub seed: u64,
}

/// Number of planes.
const PLANES: u64 = 24;

impl Lump {
    /// Its closed surface, with its exact normals.
    ///
    /// # Errors
    ///
    /// [`MeshError`] if it is too large or too small for single precision.
    pub fn mesh(&self) -> Result<TriangleMesh, MeshError> {
        let planes: Vec<(DVec3, f64)> = (0..PLANES).map(|number| self.plane(number)).collect();
        let power = 4.0 + 36.0 * self.angularity;
        globe(self.segments, std::f64::consts::PI, |direction| {
            let shares = planes
                .iter()
                .map(|(normal, distance)| (normal.dot(direction).max(0.0) / distance, normal));
            // The greatest is taken out, so that powers neither vanish nor overflow.
            let greatest = shares.clone().map(|(share, _)| share).fold(0.0, f64::max);
            let (mut sum, mut gradient) = (0.0, DVec3::ZERO);
            for ((share, normal), (_, distance)) in shares.zip(&planes) {
                let relative = libm::pow(share / greatest, power - 1.0);
                sum += relative * share / greatest;
                gradient += *normal * (relative / distance);
            }
            let reach = self.radius / (greatest * libm::pow(sum, 1.0 / power));
            let normal = gradient.normalize_or(direction);
            ((direction * reach).as_vec3(), normal.as_vec3())
        })
    }

    /// A plane: its normal, near a point of a spiral over the sphere so that no side is without one,
    /// and its distance from the middle.
    fn plane(&self, number: u64) -> (DVec3, f64) {
        let at = |what: u64| random(self.seed, 4 * number + what);
        let z = 1.0 - 2.0 * (number as f64 + at(0)) / PLANES as f64;
        let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
        let (sin, cos) = libm::sincos(golden * number as f64 + 0.8 * (at(1) - 0.5));
        let across = (1.0 - z * z).max(0.0).sqrt();
        let normal = DVec3::new(across * cos, across * sin, z);
        (normal, 1.0 - self.irregularity * at(2))
    }
}
