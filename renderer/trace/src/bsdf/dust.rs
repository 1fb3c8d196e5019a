//! A thin layer of dust on a face.
//!
//! A beam at the cosine µ meets grains with the probability `1 − exp(−τ/µ)`, at most one of them.
//! A grain scatters the share ω, half of it to each side. So `ω E_d(µ)` is sent back, with
//! `E_d = ½ (1 − exp(−τ/µ))`, and `1 − (2 − ω) E_d(µ)` goes on.

use std::f32::consts::FRAC_1_PI;

use optics::plate::layer_absorptance;

use super::coat_table::{Bloom, CoatTable, LocalCoat};
use super::leaf_shape::Passed;
use crate::spectrum::Lanes;

const NODES: usize = 24;
/// Greatest optical thickness of the table; thicker dust is like that.
const MOST_TAU: f32 = 8.0;

/// What dust of any thickness over a coat of any roughness lets pass, if its grains absorb nothing.
#[derive(Clone, Debug)]
pub struct DustTable {
    /// What passes by `(1 − E_d)(1 − E)` of diffuse light, for each optical thickness and then each
    /// roughness of the coat's table.
    ///
    /// It is convex in τ, so that linear interpolation never lies below it and a leaf under the dust
    /// never sends out more than comes in.
    passed: Box<[Box<[Passed]>]>,
}

/// Dust at one place.
#[derive(Clone, Copy, Debug)]
pub struct LocalDust {
    tau: f32,
    /// Mean of `E_d` over diffuse light.
    pub sent_mean: f32,
    /// What passes by `(1 − E_d)(1 − E)` with the coat's `E`.
    pub passed: Passed,
}

/// `E_d`.
#[inline]
fn sent(tau: f32, mu: f32) -> f32 {
    0.5 * (1.0 - libm::expf(-tau / mu.max(1e-4)))
}

fn tau_of(node: usize) -> f32 {
    let x = node as f32 / (NODES - 1) as f32;
    MOST_TAU * x * x
}

impl DustTable {
    /// The table over a coat under its bloom.
    pub fn new(table: &CoatTable, bloom: &Bloom) -> Self {
        let row = |node: usize| table.passed(bloom, |mu| 1.0 - sent(tau_of(node), mu));
        Self {
            passed: (0..NODES).map(row).collect(),
        }
    }

    /// Dust of an optical thickness, > 0, over a coat of the table.
    pub fn dust(&self, tau: f32, coat: &LocalCoat<'_>) -> LocalDust {
        let tau = tau.min(MOST_TAU);
        let place = (tau / MOST_TAU).sqrt() * (NODES - 1) as f32;
        let node = (place as usize).min(NODES - 2);
        let [low, high] = [tau_of(node), tau_of(node + 1)];
        let share = ((tau - low) / (high - low)).clamp(0.0, 1.0);
        let passed = |node: usize| coat.along_roughness(&self.passed[node]);
        LocalDust {
            tau,
            sent_mean: 0.5 * layer_absorptance(f64::from(tau)) as f32,
            passed: passed(node).towards(passed(node + 1), share),
        }
    }
}

impl LocalDust {
    /// `E_d` at a cosine.
    #[inline]
    pub fn sent(&self, mu: f32) -> f32 {
        sent(self.tau, mu)
    }

    /// Share of a beam at a cosine that meets no grain.
    #[inline]
    pub fn missed(&self, mu: f32) -> f32 {
        1.0 - 2.0 * self.sent(mu)
    }

    /// What goes on of light whose `E_d` is `sent`, for grains of these albedos.
    #[inline]
    pub fn onward<const N: usize>(grains: Lanes<N>, sent: f32) -> Lanes<N> {
        Lanes::ONE - (Lanes::splat(2.0) - grains) * sent
    }

    /// The grains' own `f`, from `E_d` of light from either direction.
    #[inline]
    pub fn lobe<const N: usize>(&self, grains: Lanes<N>, from_wo: f32, from_wi: f32) -> Lanes<N> {
        grains * (from_wo * from_wi * FRAC_1_PI / self.sent_mean)
    }
}

/// A leaf between two layers that send back `s` of diffuse light: what it sends back on its own
/// side, and what it lets through to the other and from there, all by light that comes in on it
/// from outside through a layer.
///
/// `r` and `t` are those of the own side and of the other. Light goes back and forth between leaf
/// and layers as often as it likes (the adding equations of Stokes for three layers).
#[inline]
pub fn between<const N: usize>(
    [r_own, r_other]: [Lanes<N>; 2],
    [t_own, t_other]: [Lanes<N>; 2],
    [s_own, s_other]: [Lanes<N>; 2],
) -> (Lanes<N>, [Lanes<N>; 2]) {
    let (open_own, open_other) = (Lanes::ONE - r_own * s_own, Lanes::ONE - r_other * s_other);
    let both = t_own * t_other;
    let inverse = Lanes::ONE / (open_own * open_other - both * s_own * s_other);
    let back = (r_own * open_other + both * s_other) * inverse;
    (back, [t_own * inverse, t_other * inverse])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A photon's way through dust, leaf and dust: the side on which it leaves, or nothing if it is
    /// absorbed. `leaf` has R and T of either side, `dust` the share of light that meets grains and
    /// their albedo.
    fn walk(
        leaf: [[f32; 2]; 2],
        dust: [[f32; 2]; 2],
        next: &mut impl FnMut() -> f32,
    ) -> Option<usize> {
        let (mut side, mut inwards) = (0, true);
        loop {
            let [met, albedo] = dust[side];
            if next() < met {
                if next() >= albedo {
                    return None;
                }
                if next() < 0.5 {
                    inwards = !inwards;
                }
            }
            if !inwards {
                return Some(side);
            }
            let [r, t] = leaf[side];
            let u = next();
            if u >= r + t {
                return None;
            }
            if u >= r {
                side = 1 - side;
            }
            inwards = false;
        }
    }

    #[test]
    fn diffuse_light_between_dust_and_leaf_goes_where_photons_do() {
        // Reflectance and transmittance of both sides, share of light that meets grains and albedo.
        let leaf = [[0.45, 0.4], [0.5, 0.4]];
        let dust = [[0.4, 0.7], [0.25, 0.5]];
        let mut state = 1_u64;
        let mut next = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f32 / 16_777_216.0
        };
        let count = 400_000;
        let mut left = [0.0_f64; 2];
        for _ in 0..count {
            if let Some(side) = walk(leaf, dust, &mut next) {
                left[side] += 1.0 / f64::from(count);
            }
        }
        let s = dust.map(|[met, albedo]| 0.5 * met * albedo);
        let on = dust.map(|[met, albedo]| 1.0 - met + 0.5 * met * albedo);
        let lanes = |pair: [f32; 2]| pair.map(|value| Lanes([value]));
        let [r, t] = [0, 1].map(|i| lanes([leaf[0][i], leaf[1][i]]));
        let (back, [through, _]) = between(r, t, lanes(s));
        let expected = [
            s[0] + on[0] * on[0] * back.0[0],
            on[0] * on[1] * through.0[0],
        ];
        for (found, expected) in left.iter().zip(expected) {
            // Four standard errors of so many photons.
            let error = 4.0 * (0.25 / f64::from(count)).sqrt();
            assert!(
                (found - f64::from(expected)).abs() < error,
                "{left:?} {expected}"
            );
        }
    }
}
