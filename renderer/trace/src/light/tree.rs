//! A light tree: chooses one light by the light that it may send to a point.
//!
//! - **In**: [`Emitter`]s, which bound the place, directions and intensity of each light; a
//!   [`Receiver`]; a random number.
//! - **Out**: the number of one light, and the probability of any light from any receiver.
//! - **Always true**: a light that can send light to the receiver, from either side, has a
//!   probability above zero; [`LightTree::probability`] is the probability with which
//!   [`LightTree::choose`] chooses. The probabilities from one receiver sum to 1 or less: the
//!   bounds of a node may suggest light where none of its lights shines, and then nothing is
//!   chosen.
//! - **Left out**: shadows, and the receiving surface's BSDF apart from the cosine.
//!
//! # Source
//!
//! \[conty2018\], with eight children per node, whose importances are computed together, and
//! without splitting: one light per choice.

use glam::Vec3;

mod build;

use crate::light::sample::Receiver;

/// Number of children of a node.
const WIDTH: usize = 8;

/// Number of bits of a child's index.
const CHILD_BITS: u32 = 3;

/// Marks the number of a child as that of a light.
const IS_LIGHT: u32 = 1 << 31;

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

/// A tree over lights that are numbered from 0.
#[derive(Clone, Debug)]
pub struct LightTree {
    /// The nodes; the root is the first.
    nodes: Box<[Node]>,
    /// For each light the path from the root to it: the index of a child per level, three bits
    /// each, from the lowest bits on.
    trails: Box<[u64]>,
}

/// Bounds and numbers of up to eight children; a missing child has intensity 0.
#[derive(Clone, Debug)]
struct Node {
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
    child: [u32; WIDTH],
}

impl LightTree {
    /// The tree of at least one light and fewer than 2³¹.
    pub fn new(lights: &[Emitter]) -> Self {
        build::build(lights)
    }

    /// Number of lights.
    pub fn len(&self) -> usize {
        self.trails.len()
    }

    /// Whether there are no lights, which is never the case.
    pub fn is_empty(&self) -> bool {
        self.trails.is_empty()
    }

    /// Rough irradiance that all lights together may cause at a receiver, W m⁻² nm⁻¹; zero only if
    /// it is dark there.
    pub fn importance(&self, receiver: &Receiver) -> f32 {
        self.nodes[0].importances(receiver).iter().sum()
    }

    /// Chooses a light by `u` in [0, 1), and returns its number and probability; `None` if no light
    /// shines there.
    pub fn choose(&self, receiver: &Receiver, u: f32) -> Option<(usize, f32)> {
        // Each level uses up some of the digits of `u`.
        let mut u = f64::from(u);
        let mut probability = 1.0;
        let mut node = &self.nodes[0];
        loop {
            let importances = node.importances(receiver);
            let sum: f32 = importances.iter().sum();
            if sum <= 0.0 {
                return None;
            }
            let target = u * f64::from(sum);
            let (mut chosen, mut below) = (0, 0.0);
            let mut up_to = 0.0;
            for (child, &importance) in importances.iter().enumerate() {
                // The last child with any importance takes what rounding leaves over.
                if importance > 0.0 && up_to <= target {
                    (chosen, below) = (child, up_to);
                }
                up_to += f64::from(importance);
            }
            probability *= importances[chosen] / sum;
            u = ((target - below) / f64::from(importances[chosen])).min(1.0 - f64::EPSILON);
            let child = node.child[chosen];
            if child & IS_LIGHT != 0 {
                return Some(((child & !IS_LIGHT) as usize, probability));
            }
            node = &self.nodes[child as usize];
        }
    }

    /// Probability with which a light is chosen.
    pub fn probability(&self, light: usize, receiver: &Receiver) -> f32 {
        let mut trail = self.trails[light];
        let mut probability = 1.0;
        let mut node = &self.nodes[0];
        loop {
            let importances = node.importances(receiver);
            let chosen = trail as usize % WIDTH;
            if importances[chosen] <= 0.0 {
                return 0.0;
            }
            probability *= importances[chosen] / importances.iter().sum::<f32>();
            trail >>= CHILD_BITS;
            let child = node.child[chosen];
            if child & IS_LIGHT != 0 {
                return probability;
            }
            node = &self.nodes[child as usize];
        }
    }
}

impl Node {
    const EMPTY: Self = Self {
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

    fn set(&mut self, k: usize, bounds: &Emitter, child: u32) {
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
    fn importances(&self, receiver: &Receiver) -> [f32; WIDTH] {
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

#[cfg(test)]
mod tests;
