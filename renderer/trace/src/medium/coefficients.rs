//! Coefficients of a medium at a path's wavelengths: how far light goes in it, and where to.

use glam::{Vec2, Vec3};

use super::phase::{Phase, Scattering, passes};
use crate::bsdf::Scattered;
use crate::spectrum::Lanes;

/// The coefficients of a medium at a path's wavelengths.
#[derive(Clone, Copy, Debug)]
pub struct Coefficients<const N: usize> {
    /// Absorption, m⁻¹, ≥ 0.
    pub absorption: Lanes<N>,
    /// Scattering, m⁻¹, ≥ 0.
    pub scattering: Lanes<N>,
    /// Where light goes that is scattered, in the mean over wavelengths.
    pub phase: Phase,
    /// Fraction of the light that leaves scatter which they let through, at each wavelength.
    pub(super) through: Lanes<N>,
}

/// Sampling of flights: one wavelength is chosen in proportion to the path's throughput, and its
/// scattering coefficient decides how far light goes. Each wavelength is weighted by its own
/// probability over that of all of them (the balance heuristic for one sample). With weights w in
/// proportion to the throughputs, the density of a flight that ends at d is Σ wⱼ sⱼ exp(−sⱼ d), and
/// the probability of one longer than d is Σ wⱼ exp(−sⱼ d).
///
/// # Source
///
/// \[wilkie2014\] and \[miller2019\] for the weights over wavelengths. There all wavelengths share
/// one choice along a path; a choice at each flight in proportion to the throughput is the same
/// where media alone change the throughput, and leaves out wavelengths that have none left.
impl<const N: usize> Coefficients<N> {
    /// How far light goes before it is scattered, m; infinite if it never is. The throughput is not
    /// zero everywhere; the numbers are in [0, 1).
    pub fn reach(&self, throughput: &Lanes<N>, [choice, distance]: [f32; 2]) -> f32 {
        let target = choice * throughput.sum();
        let (mut chosen, mut below) = (0, 0.0);
        for (lane, &share) in throughput.0.iter().enumerate() {
            // The last lane with any throughput takes what rounding leaves over.
            if share > 0.0 && below <= target {
                chosen = lane;
            }
            below += share;
        }
        let scattering = self.scattering.0[chosen];
        if scattering > 0.0 {
            -libm::logf(1.0 - distance) / scattering
        } else {
            f32::INFINITY
        }
    }

    /// Factor on the throughput of light that has gone `length`, m, and was not scattered.
    pub fn passed(&self, throughput: &Lanes<N>, length: f32) -> Lanes<N> {
        let (least, weights) = self.weights(throughput);
        let mut probability = 0.0;
        for (weight, scattering) in weights.0.iter().zip(self.scattering.0) {
            probability += weight * beyond(scattering - least, length);
        }
        if probability <= 0.0 {
            return Lanes::ZERO;
        }
        let extinction = self.absorption + self.scattering;
        Lanes::from_fn(|lane| beyond(extinction.0[lane] - least, length) / probability)
    }

    /// Factor on the throughput of light that is scattered after `length`, m, which is finite.
    pub fn scattered(&self, throughput: &Lanes<N>, length: f32) -> Lanes<N> {
        let (least, weights) = self.weights(throughput);
        let mut density = 0.0;
        for (weight, scattering) in weights.0.iter().zip(self.scattering.0) {
            density += weight * scattering * beyond(scattering - least, length);
        }
        if density <= 0.0 {
            return Lanes::ZERO;
        }
        let extinction = self.absorption + self.scattering;
        Lanes::from_fn(|lane| {
            self.scattering.0[lane] * beyond(extinction.0[lane] - least, length) / density
        })
    }

    /// Share of light that goes `length`, m, straight on.
    pub fn transmittance(&self, length: f32) -> Lanes<N> {
        let extinction = self.absorption + self.scattering;
        Lanes::from_fn(|lane| beyond(extinction.0[lane], length))
    }

    /// Share of the light that is lost by extinction which is scattered.
    pub fn albedo(&self) -> Lanes<N> {
        let extinction = self.absorption + self.scattering;
        Lanes::from_fn(|lane| {
            let scattering = self.scattering.0[lane];
            if scattering > 0.0 {
                scattering / extinction.0[lane]
            } else {
                0.0
            }
        })
    }

    /// The least scattering coefficient of lanes with any throughput, and the shares of the lanes in
    /// the throughput. Taken out of all exponents, that coefficient keeps ratios from being 0 / 0.
    fn weights(&self, throughput: &Lanes<N>) -> (f32, Lanes<N>) {
        let mut least = f32::INFINITY;
        for (share, scattering) in throughput.0.iter().zip(self.scattering.0) {
            if *share > 0.0 {
                least = least.min(scattering);
            }
        }
        (least, *throughput / throughput.sum())
    }
}

/// exp(−coefficient · length); 1 for no coefficient at any length. A coefficient below 0 is that of
/// a lane without throughput, whose factor does not matter but must be finite.
fn beyond(coefficient: f32, length: f32) -> f32 {
    if coefficient > 0.0 {
        libm::expf(-coefficient * length)
    } else {
        1.0
    }
}

/// Directions of scattering. They are drawn by the mean over wavelengths, and each wavelength has its own value.
impl<const N: usize> Coefficients<N> {
    /// The value at each wavelength for light that goes from one way to another, sr⁻¹, and the density with which that is
    /// drawn.
    pub fn turned_to(&self, way: Vec3, next: Vec3) -> Scattered<N> {
        let pdf = self.phase.value(way, next);
        let f = self.fraction(way, next) * pdf;
        Scattered { f, pdf }
    }

    /// Draws a direction for light that went along `way`, as [`Phase::sample`], and the factor on each wavelength.
    pub fn turn(&self, way: Vec3, lobe: f32, u: Vec2) -> (Scattering, Lanes<N>) {
        let drawn = self.phase.sample(way, lobe, u);
        (drawn, self.fraction(way, drawn.direction))
    }

    /// The value at each wavelength over that in the mean.
    fn fraction(&self, way: Vec3, next: Vec3) -> Lanes<N> {
        match self.phase {
            Phase::HenyeyGreenstein { .. } | Phase::Rayleigh => Lanes::ONE,
            Phase::Leaf { normal, through } => {
                let is_through = passes(normal, way, next);
                let of = |through: f32| if is_through { through } else { 1.0 - through };
                let mean = of(through);
                Lanes::from_fn(|lane| {
                    if mean > 0.0 {
                        of(self.through.0[lane]) / mean
                    } else {
                        0.0
                    }
                })
            }
        }
    }
}
