//! Two streams of diffuse light between the surfaces of a leaf.

use std::sync::OnceLock;

use crate::interface::Interface;
use crate::pile::ReflectanceTransmittance;
use crate::quadrature::gauss;

/// Number of depths at which light in a leaf is told, Gauss's nodes.
pub const DEPTHS: usize = 16;

/// Least reflectance of the mesophyll; below it nothing is scattered.
const LEAST_REFLECTANCE: f64 = 1e-12;
/// Least transmittance of the mesophyll: of one that lets less through, nothing is told at depths
/// that matter.
const LEAST_TRANSMITTANCE: f64 = 1e-30;

/// A leaf between its surfaces at one wavelength: light of two streams, absorbed and scattered
/// evenly with depth, of which the whole thickness is 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mesophyll {
    /// `α`: a layer without end reflects `e^−α`.
    alpha: f64,
    /// `β`: streams in a layer without end fall by `e^−β` over the leaf.
    beta: f64,
    /// Reflectance over transmittance, the scattering where nothing is absorbed.
    lossless: f64,
    /// Share of diffuse light inside that a surface lets out.
    out: f64,
}

/// A number for each depth, of Gauss's nodes from the lit face on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Profile(pub [f64; DEPTHS]);

impl Profile {
    /// Sum of products over the depths; `mirrored` counts those of the other from the other face.
    pub fn dot(&self, other: &Self, mirrored: bool) -> f64 {
        let pairs = self.0.iter().enumerate();
        pairs
            .map(|(i, value)| value * other.0[if mirrored { DEPTHS - 1 - i } else { i }])
            .sum()
    }
}

/// Gauss's nodes on [0, 1], rising, with their weights.
fn nodes() -> &'static [(f64, f64); DEPTHS] {
    static NODES: OnceLock<[(f64, f64); DEPTHS]> = OnceLock::new();
    NODES.get_or_init(|| {
        let nodes = gauss(DEPTHS);
        // Made exactly symmetric, so that a leaf is the same from both faces.
        std::array::from_fn(|i| {
            let ((x, w), (y, v)) = (nodes[i], nodes[DEPTHS - 1 - i]);
            (0.5 + 0.5 * (x - y), 0.5 * (w + v))
        })
    })
}

impl Mesophyll {
    /// From what the leaf with both its surfaces reflects and transmits near its normal.
    pub fn of(face: &Interface, optics: ReflectanceTransmittance) -> Self {
        let ReflectanceTransmittance {
            reflectance,
            transmittance,
        } = optics;
        let out = face.transmissivity_from_inside();
        Self::new([reflectance, transmittance], face.t_av_40, out)
    }

    /// From `R` and `T` of the leaf, the share `entering` of the light on it that its surface lets
    /// in, and the share `out` of diffuse light within that a surface lets out.
    ///
    /// A leaf that reflects less than its surface alone, or more than diffuse light in it allows, is
    /// taken as the nearest that can be.
    pub fn new([reflectance, transmittance]: [f64; 2], entering: f64, out: f64) -> Self {
        let within = 1.0 - out;
        // All below the lit surface: R = 1 − t + t b t' / (1 − b r').
        let back = (reflectance - (1.0 - entering)).max(0.0);
        let below = back / (entering * out + back * within);
        let through = transmittance * (1.0 - below * within) / (entering * out);
        // Less the lower surface: through = τ / (1 − ρ r'), below = ρ + r' τ through.
        let squared = within * through;
        let rho = ((below - squared * through) / (1.0 - squared * squared)).max(0.0);
        let tau = (through * (1.0 - rho * within)).max(LEAST_TRANSMITTANCE);
        let sum = rho + tau;
        let (rho, tau) = if sum > 1.0 {
            (rho / sum, tau / sum)
        } else {
            (rho, tau)
        };
        let lost = (1.0 - rho - tau).max(0.0);
        let delta = ((1.0 + rho + tau) * (1.0 + rho - tau) * (1.0 - rho + tau) * lost)
            .max(0.0)
            .sqrt();
        let alpha = if rho > LEAST_REFLECTANCE {
            libm::asinh(0.5 * delta / rho)
        } else {
            f64::INFINITY
        };
        Self {
            alpha,
            beta: libm::asinh(0.5 * delta / tau),
            lossless: if rho > LEAST_REFLECTANCE {
                rho / tau
            } else {
                0.0
            },
            out,
        }
    }

    /// `k`, share of a stream that is absorbed on a path as long as the leaf is thick, ≥ 0.
    pub fn absorption(&self) -> f64 {
        self.beta * libm::tanh(0.5 * self.alpha)
    }

    /// `s`, share of a stream that is scattered into the other one on such a path, ≥ 0.
    pub fn scattering(&self) -> f64 {
        if self.alpha > 0.0 && self.beta > 0.0 {
            self.beta / libm::sinh(self.alpha)
        } else {
            self.lossless
        }
    }

    /// Reflectance and transmittance of a layer of this thickness, of 1, without surfaces.
    pub fn layer(&self, thickness: f64) -> [f64; 2] {
        let depth = thickness * self.beta;
        let whole = libm::expm1(-2.0 * (self.alpha + depth));
        if whole == 0.0 {
            let scattered = thickness * self.lossless;
            return [scattered / (1.0 + scattered), 1.0 / (1.0 + scattered)];
        }
        [
            libm::exp(-self.alpha) * libm::expm1(-2.0 * depth) / whole,
            libm::exp(-depth) * libm::expm1(-2.0 * self.alpha) / whole,
        ]
    }

    /// Both streams together at a depth, of diffuse light that has just passed the surface at depth
    /// 0 with flux 1: each stream is reflected by all layers and surfaces above and below.
    ///
    /// The same number is twice the share of light from that depth, half up and half down, that
    /// arrives at the surface at depth 0 and is not reflected there, over what a surface lets out:
    /// light goes there as it comes from there.
    pub fn light_at(&self, depth: f64) -> f64 {
        let within = 1.0 - self.out;
        let bounded = |thickness: f64| {
            let [r, t] = self.layer(thickness);
            let passing = t / (1.0 - r * within);
            [r + t * passing * within, passing]
        };
        let ([above, passing], [below, _]) = (bounded(depth), bounded(1.0 - depth));
        passing * (1.0 + below) / (1.0 - above * below)
    }

    /// [`Mesophyll::light_at`] at Gauss's nodes, without their weights.
    fn light(&self) -> [f64; DEPTHS] {
        let within = 1.0 - self.out;
        let bounded = nodes().map(|(thickness, _)| {
            let [r, t] = self.layer(thickness);
            let passing = t / (1.0 - r * within);
            [r + t * passing * within, passing]
        });
        std::array::from_fn(|i| {
            let ([above, passing], [below, _]) = (bounded[i], bounded[DEPTHS - 1 - i]);
            passing * (1.0 + below) / (1.0 - above * below)
        })
    }

    /// How what the leaf absorbs of light on a face is distributed over depths from there; the sum
    /// is 1. Where nothing is absorbed it is the limit of little absorption.
    pub fn absorbing(&self) -> Profile {
        let mut light = self.light();
        for (light, (_, weight)) in light.iter_mut().zip(nodes()) {
            *light *= weight;
        }
        let sum: f64 = light.iter().sum();
        Profile(light.map(|light| light / sum))
    }

    /// Share of the light that is emitted at each depth, half up and half down, which leaves through
    /// the face from which depth is counted, in [0, 1].
    pub fn escaping(&self) -> Profile {
        Profile(self.light().map(|light| 0.5 * self.out * light))
    }
}
