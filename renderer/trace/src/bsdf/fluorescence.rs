//! The directions in which a leaf takes in light that excites it, and sends out what it emits.
//!
//! What chlorophyll emits leaves each face as transmitted light does: evenly within the tissue, less
//! what the coat reflects back. `docs/src/theory/fluorescence.md` has the formula.

use std::f32::consts::FRAC_1_PI;

use glam::{Vec2, Vec3};

use crate::bsdf::coat::Coat;
use crate::bsdf::sample::{BsdfSample, Scattered};
use crate::sampling::warp;
use crate::spectrum::Lanes;

/// Share of light from `wi` that passes the coat of the face on its side into the tissue.
pub fn taken_in(coats: &[Coat; 2], wi: Vec3) -> f32 {
    1.0 - coats[usize::from(wi.z < 0.0)].reflected(wi)
}

/// Radiance towards `wo` over the mean radiance of what leaves the face on its side; the mean over
/// the half space, weighted with the cosine, is 1.
pub fn sent_out(coats: &[Coat; 2], wo: Vec3) -> f32 {
    let coat = &coats[usize::from(wo.z < 0.0)];
    (1.0 - coat.reflected(wo)) / coat.passed_mean()
}

/// A leaf that emits towards `wo` what light on one of its faces excites.
///
/// Its value is that of a leaf which emits all that passes the coat, the same in each lane; what it
/// does emit is a matrix of lanes, which is applied to the light that was found.
#[derive(Clone, Copy, Debug)]
pub struct FluorescenceView<'a> {
    coats: &'a [Coat; 2],
    /// Sign of z of directions on the face that is lit.
    lit: f32,
    /// `f` without the factor for the coat on the lit face, sr⁻¹.
    sent: f32,
}

impl<'a> FluorescenceView<'a> {
    /// Seen from `wo`, lit on the same face or, `through` the leaf, on the other one.
    pub fn new(coats: &'a [Coat; 2], wo: Vec3, through: bool) -> Self {
        let side = 1.0_f32.copysign(wo.z);
        Self {
            coats,
            lit: if through { -side } else { side },
            sent: sent_out(coats, wo) * FRAC_1_PI,
        }
    }

    /// The value for light from `wi`, and the density with which `wi` is sampled.
    pub fn scatter<const N: usize>(&self, wi: Vec3) -> Scattered<N> {
        if wi.z * self.lit <= 0.0 {
            return Scattered::NOTHING;
        }
        Scattered {
            f: Lanes::splat(self.sent * taken_in(self.coats, wi)),
            pdf: wi.z.abs() * FRAC_1_PI,
        }
    }

    /// Draws a direction of light.
    pub fn sample<const N: usize>(&self, u: Vec2) -> Option<BsdfSample<N>> {
        let up = warp::cosine_hemisphere(u);
        let wi = Vec3::new(up.x, up.y, self.lit * up.z);
        self.scatter(wi).drawn(wi)
    }
}
