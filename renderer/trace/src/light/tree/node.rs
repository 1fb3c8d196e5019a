//! A node of a light tree: bounds of eight sets of lights.

use glam::Vec3;

use crate::light::sample::Receiver;

/// Number of children of a node.
pub(super) const WIDTH: usize = 8;

/// Number of bits of a child's index.
pub(super) const CHILD_BITS: u32 = 3;

/// Marks the number of a child as that of a light.
pub(super) const IS_LIGHT: u32 = 1 << 31;

/// Tolerance, above rounding, of the cosines that decide whether a light is dark.
const TOLERANCE: f32 = 1e-3;

/// Least cosine in an importance, so that rounding to zero cannot hide a light.
const LEAST_COSINE: f32 = 1e-4;

/// Bounds of a light: a sphere that encloses it, and a cone around an axis that contains its
/// normals.
#[derive(Clone, Copy, Debug)]
pub struct Emitter {
    /// Centre of a sphere around all emitting points, world, m.
    pub center: Vec3,
    /// Its radius, m; 0 for a point.
    pub radius: f32,
    /// Unit vector: axis of the cone of normals.
    pub axis: Vec3,
    /// Greatest angle between a normal and the axis, rad, 0 to π.
    pub spread: f32,
    /// Greatest angle between a normal and the directions of emission from that point, rad, 0 to π.
    pub reach: f32,
    /// Radiant intensity along the axis, W sr⁻¹ nm⁻¹, ≥ 0 and finite: for a surface its radiance
    /// times its area.
    pub intensity: f32,
}

/// Bounds and numbers of up to eight children; a missing child has intensity 0.
#[derive(Clone, Debug)]
pub(super) struct Node {
    center: [[f32; WIDTH]; 3],
    radius2: [f32; WIDTH],
    axis: [[f32; WIDTH]; 3],
    cos_spread: [f32; WIDTH],
    sin_spread: [f32; WIDTH],
    /// The child is dark if the greatest possible cosine towards the receiver is less.
    least_cos: [f32; WIDTH],
    /// The child is dark if the cosine at its centre towards the receiver is less; −2, which
    /// disables the test, unless it is flat.
    least_cos_of_center: [f32; WIDTH],
    intensity: [f32; WIDTH],
    /// Number of a node, or of a light with [`IS_LIGHT`].
    pub(super) child: [u32; WIDTH],
}

impl Node {
    pub(super) const EMPTY: Self = Self {
        center: [[0.0; WIDTH]; 3],
        radius2: [0.0; WIDTH],
        axis: [[0.0; WIDTH]; 3],
        cos_spread: [1.0; WIDTH],
        sin_spread: [0.0; WIDTH],
        least_cos: [0.0; WIDTH],
        least_cos_of_center: [0.0; WIDTH],
        intensity: [0.0; WIDTH],
        child: [0; WIDTH],
    };

    pub(super) fn set(&mut self, k: usize, bounds: &Emitter, child: u32) {
        for (axis, (center, direction)) in self.center.iter_mut().zip(&mut self.axis).enumerate() {
            center[k] = bounds.center[axis];
            direction[k] = bounds.axis[axis];
        }
        self.radius2[k] = bounds.radius * bounds.radius;
        let (sin, cos) = libm::sincosf(bounds.spread);
        let everywhere = bounds.spread >= std::f32::consts::PI;
        (self.cos_spread[k], self.sin_spread[k]) =
            if everywhere { (-1.0, 0.0) } else { (cos, sin) };
        self.least_cos[k] = libm::cosf(bounds.reach) - TOLERANCE;
        // A light with a single normal, which is flat or a point, is dark behind the plane through
        // its centre.
        let flat = child & IS_LIGHT != 0
            && bounds.spread == 0.0
            && bounds.reach <= std::f32::consts::FRAC_PI_2;
        self.least_cos_of_center[k] = if flat { -TOLERANCE } else { -2.0 };
        self.intensity[k] = bounds.intensity;
        self.child[k] = child;
    }

    /// An estimate of the light that each child may send to a receiver. It is not a bound, since it
    /// uses the distance to the child's centre (at least its radius).
    ///
    /// The importance of \[conty2018\], with cosines instead of angles.
    pub(super) fn importances(&self, receiver: &Receiver) -> [f32; WIDTH] {
        let (p, n) = (receiver.position, receiver.normal);
        let least_received = if n == Vec3::ZERO { 1.0 } else { LEAST_COSINE };
        let mut importances = [0.0; WIDTH];
        for (k, slot) in importances.iter_mut().enumerate() {
            let x = self.center[0][k] - p.x;
            let y = self.center[1][k] - p.y;
            let z = self.center[2][k] - p.z;
            let distance2 = (x * x + y * y + z * z).max(f32::MIN_POSITIVE);
            let per_distance = 1.0 / distance2.sqrt();
            // Half the angle that the sphere subtends; a right angle from inside.
            let sin2_size = (self.radius2[k] / distance2).min(1.0);
            let (sin_size, cos_size) = (sin2_size.sqrt(), (1.0 - sin2_size).sqrt());

            let cos = ((x * n.x + y * n.y + z * n.z).abs() * per_distance).min(1.0);
            let sin = (1.0 - cos * cos).sqrt();
            let nearer = cos * cos_size + sin * sin_size;
            let received = if cos >= cos_size { 1.0 } else { nearer };

            let along = x * self.axis[0][k] + y * self.axis[1][k] + z * self.axis[2][k];
            let cos = (-along * per_distance).clamp(-1.0, 1.0);
            let sin = (1.0 - cos * cos).sqrt();
            // Spread and size together.
            let cos_sum = self.cos_spread[k] * cos_size - self.sin_spread[k] * sin_size;
            let sin_sum = self.sin_spread[k] * cos_size + self.cos_spread[k] * sin_size;
            let nearer = cos * cos_sum + sin * sin_sum;
            // Separate selections, so that the compiler needs no branches.
            let sent = if cos >= cos_sum { 1.0 } else { nearer };
            let sent = if sin_sum < 0.0 { 1.0 } else { sent };
            let inside = distance2 <= self.radius2[k];
            let sent = if inside { 1.0 } else { sent };

            let least_distance2 = distance2.max(self.radius2[k]);
            let cosines = received.max(least_received) * sent.max(LEAST_COSINE);
            // A point light may be almost at the receiver.
            let importance = (self.intensity[k] * cosines / least_distance2).min(1e30);
            let dark = sent < self.least_cos[k];
            let importance = if dark { 0.0 } else { importance };
            let behind = cos < self.least_cos_of_center[k];
            *slot = if behind { 0.0 } else { importance };
        }
        importances
    }
}
