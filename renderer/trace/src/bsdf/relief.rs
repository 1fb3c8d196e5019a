//! A leaf at a point of its relief: each face has a normal of its own and a coat as rough as the
//! slopes that the filter left out.
//!
//! Directions stay in the frame of the mesh's shading normal. It alone decides on which side of the
//! leaf a direction lies, so that no light leaks from one face to the other. The face's own normal
//! decides under which angle it is lit.

use std::f32::consts::FRAC_1_PI;

use glam::{Vec2, Vec3};

use super::coat_table::LocalCoat;
use super::dust::LocalDust;
use super::leaf::LeafBsdf;
use super::leaf_shape::{Passed, slant};
use super::leaf_tissue::TissueView;
use super::sample::{BsdfSample, Scattered};
use crate::sampling::warp;
use crate::spectrum::Lanes;

/// Share of the light that the relief's own horizon would take from a diffuse lobe that is given
/// back. All of it would be too much, as the coat passes less at grazing angles.
const GIVEN_BACK: f32 = 0.5;
/// Share of the cosine to the mesh's normal that the cosine to the relief's must have for the view:
/// steeper slopes are lowered.
const LEAST_FACING: f32 = 0.5;

/// The slope and the coat of one face.
#[derive(Clone, Debug)]
pub struct ReliefFace<'a> {
    /// ∂z/∂x and ∂z/∂y, z towards the adaxial side.
    pub slope: Vec2,
    /// The coat, with the roughness of slopes that are not resolved.
    pub coat: LocalCoat<'a>,
    /// The dust on it, if there is any.
    pub dust: Option<LocalDust>,
}

/// A leaf at a point of its relief.
#[derive(Clone, Debug)]
pub struct ReliefBsdf<'a, const N: usize> {
    /// The leaf, whose tissue this is.
    pub leaf: LeafBsdf<'a, N>,
    /// Adaxial and abaxial.
    pub faces: [ReliefFace<'a>; 2],
    /// Albedo of a grain of dust.
    pub grains: Lanes<N>,
}

/// The same, seen from one direction.
#[derive(Clone, Debug)]
pub struct ReliefView<'a, const N: usize> {
    wo: Vec3,
    /// `wo` in the frame of the face, mirrored to +z.
    outward: Vec3,
    /// Frame of the face on the side of the view, in the mesh's shading frame.
    frame: Tilt,
    /// Normal of the other face.
    other: Vec3,
    coats: [LocalCoat<'a>; 2],
    /// Dust of the side of the view, and of the other.
    dusts: [Option<LocalDust>; 2],
    grains: Lanes<N>,
    /// What of light from `wo` goes on through the dust.
    onward: Lanes<N>,
    lambda: f32,
    /// What the bloom sends back of light from `wo`.
    sent_back: f32,
    /// With bloom, dust and what the horizon takes, but for the side of `wi`.
    tissue: TissueView<N>,
    lobes: [f32; 3],
}

impl ReliefFace<'_> {
    /// What a face passes of diffuse light from within, once it has left the tissue for good.
    fn passed(&self) -> Passed {
        self.dust.map_or(self.coat.passed(), |dust| Passed {
            mean: dust.passed.mean / (1.0 - dust.sent_mean),
            ..dust.passed
        })
    }
}

/// What goes on through dust, if there is any, at a cosine.
#[inline]
fn onward<const N: usize>(dust: Option<LocalDust>, grains: Lanes<N>, mu: f32) -> Lanes<N> {
    dust.map_or(Lanes::ONE, |dust| LocalDust::onward(grains, dust.sent(mu)))
}

/// The adaxial unit normal of a slope.
pub(super) fn normal_of(slope: Vec2) -> Vec3 {
    Vec3::new(-slope.x, -slope.y, 1.0).normalize()
}

/// The frame of a face in that of the mesh: +y stays as near to the mesh's as it can.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tilt {
    across: Vec3,
    along: Vec3,
    pub(super) normal: Vec3,
}

impl Tilt {
    pub(super) fn to(normal: Vec3) -> Self {
        // Slopes are finite, so the normal is never +y.
        let along = (Vec3::Y - normal * normal.y).normalize();
        Self {
            across: along.cross(normal),
            along,
            normal,
        }
    }

    pub(super) fn to_local(self, w: Vec3) -> Vec3 {
        Vec3::new(w.dot(self.across), w.dot(self.along), w.dot(self.normal))
    }

    pub(super) fn to_mesh(self, w: Vec3) -> Vec3 {
        self.across * w.x + self.along * w.y + self.normal * w.z
    }
}

/// What a diffuse lobe about a normal of this cosine to the mesh's is multiplied with, because
/// light from below the mesh is left out: the cut takes `(1 − cos) / 2` of it.
pub(super) fn given_back(cosine: f32) -> f32 {
    1.0 / (1.0 - GIVEN_BACK * 0.5 * (1.0 - cosine))
}

/// A slope, lowered so that its face does not turn away from `wo`.
pub(super) fn lowered(slope: Vec2, wo: Vec3) -> Vec2 {
    let away = slope.dot(wo.truncate()) * 1.0_f32.copysign(wo.z);
    if away <= 0.0 {
        return slope;
    }
    slope * ((1.0 - LEAST_FACING) * wo.z.abs() / away).min(1.0)
}

fn above(w: Vec3) -> Vec3 {
    Vec3::new(w.x, w.y, w.z.abs())
}

impl<'a, const N: usize> ReliefBsdf<'a, N> {
    /// The slope of the face that `wo` sees, [lowered].
    fn seen_slope(&self, wo: Vec3) -> Vec2 {
        let side = usize::from(wo.z < 0.0);
        lowered(self.faces[side].slope, wo)
    }

    /// The normal of the face that `wo` sees, on its side, in the mesh's shading frame.
    pub fn normal(&self, wo: Vec3) -> Vec3 {
        normal_of(self.seen_slope(wo)) * 1.0_f32.copysign(wo.z)
    }

    /// Share of the diffuse light on the face that `wo` sees which the leaf scatters, to either
    /// side; that of a dusty leaf is near.
    pub fn albedo(&self, wo: Vec3) -> Lanes<N> {
        let clean = self.leaf.albedo(wo);
        match &self.faces[usize::from(wo.z < 0.0)].dust {
            Some(dust) => {
                let onward = LocalDust::onward(self.grains, dust.sent_mean);
                clean * onward + self.grains * dust.sent_mean
            }
            None => clean,
        }
    }

    /// The leaf seen from `wo`; `None` from within its plane.
    pub fn seen_from(&self, wo: Vec3) -> Option<ReliefView<'a, N>> {
        if wo.z == 0.0 {
            return None;
        }
        let side = usize::from(wo.z < 0.0);
        let [own, other] = [&self.faces[side], &self.faces[1 - side]];
        let frame = Tilt::to(normal_of(self.seen_slope(wo)));
        let outward = above(frame.to_local(wo));
        let sent_back = own.coat.sent_back(outward.z);
        let albedo = own.coat.reflected(outward.z);
        let passed = 1.0 - albedo;
        let dusts = [own.dust, other.dust];
        let grains = self.grains;
        let dusted =
            |dust: Option<LocalDust>| dust.map_or(Lanes::ZERO, |dust| grains * dust.sent_mean);
        let onward = onward(own.dust, grains, outward.z);
        let means = [own, other].map(ReliefFace::passed);
        let mut sent = dusts.map(dusted);
        if side == 1 {
            sent.reverse();
        }
        // The coats differ from those for which the tissue was made.
        let tissue = self.leaf.tissue().between(sent);
        let (shape, x) = (self.leaf.shape(), slant(outward.z));
        let leaving = other.dust.map_or(1.0, |dust| 1.0 - dust.sent_mean);
        let tissue = tissue.seen(shape, side, means.each_ref(), x, leaving);
        // Bloom and dust are sampled as the tissue is.
        let missed = own.dust.map_or(1.0, |dust| dust.missed(outward.z));
        let shining = (albedo - sent_back) * missed * missed;
        let grainy = own
            .dust
            .map_or(0.0, |dust| grains.mean() * dust.sent(outward.z));
        let [back, on] = tissue.shares.map(|share| passed * (share * onward).mean());
        let (reflected, transmitted) = (back + sent_back + grainy, on);
        let total = shining + reflected + transmitted;
        let share = if total > 0.0 { 1.0 / total } else { 0.0 };
        let other_normal = normal_of(other.slope);
        let factors = [frame.normal.z, other_normal.z]
            .map(|cosine| onward * (passed * FRAC_1_PI * given_back(cosine)));
        Some(ReliefView {
            wo,
            outward,
            frame,
            other: other_normal,
            lambda: own.coat.ggx.lambda(outward),
            tissue: tissue.scaled(factors[0], factors[1]),
            dusts,
            grains,
            onward,
            sent_back,
            lobes: [shining, reflected, transmitted].map(|lobe| lobe * share),
            coats: [own.coat.clone(), other.coat.clone()],
        })
    }
}

impl<const N: usize> ReliefView<'_, N> {
    /// The value for light from `wi`, cosine to the mesh's normal left out, and the density with
    /// which `wi` is sampled.
    #[inline]
    pub fn scatter(&self, wi: Vec3) -> Scattered<N> {
        if wi.z == 0.0 {
            return Scattered::NOTHING;
        }
        let [coat, other] = &self.coats;
        let [shining, reflected, transmitted] = self.lobes;
        let through = self.wo.z * wi.z < 0.0;
        let local = if through {
            Vec3::new(0.0, 0.0, wi.dot(self.other))
        } else {
            self.frame.to_local(wi)
        };
        // A face that turns away from the light is in its own shadow.
        if local.z * wi.z <= 0.0 {
            return Scattered::NOTHING;
        }
        let tilted = local.z / wi.z;
        let cosine = local.z.abs() * FRAC_1_PI;
        let mu = local.z.abs();
        if through {
            let onward = onward(self.dusts[1], self.grains, mu);
            let across = -self.wo.truncate().dot(wi.truncate());
            return Scattered {
                f: self.tissue.let_through(slant(mu), across)
                    * onward
                    * ((1.0 - other.reflected(mu)) * tilted),
                pdf: transmitted * cosine,
            };
        }
        let sent_back = coat.sent_back(mu);
        let bloom = coat.bloom(self.sent_back, sent_back);
        let across = -self.outward.truncate().dot(local.truncate());
        let below = self.tissue.sent_back(slant(mu), across) * (1.0 - coat.reflected(mu));
        let mut f = (below + self.onward * bloom) * tilted;
        let mut missed = 1.0;
        if let Some(dust) = &self.dusts[0] {
            let (from_wo, from_wi) = (dust.sent(self.outward.z), dust.sent(mu));
            f = f * LocalDust::onward(self.grains, from_wi)
                + dust.lobe(self.grains, from_wo, from_wi) * tilted;
            missed = dust.missed(self.outward.z) * dust.missed(mu);
        }
        let diffuse = Scattered {
            f,
            pdf: reflected * cosine,
        };
        if !coat.shines() {
            return diffuse;
        }
        let unveiled = (1.0 - self.sent_back) * (1.0 - sent_back);
        let (lobe, pdf) = coat.lobe(self.outward, self.lambda, above(local));
        Scattered {
            f: diffuse.f + Lanes::splat(lobe * unveiled * missed * tilted),
            pdf: diffuse.pdf + shining * pdf,
        }
    }

    /// Samples a direction; lobes are chosen in proportion to the light that they scatter. `None`
    /// too where the direction would leave by the other face.
    #[inline]
    pub fn sample(&self, lobe: f32, u: Vec2) -> Option<BsdfSample<N>> {
        let [coat, reflected, transmitted] = self.lobes;
        let up = if lobe < coat {
            let h = self.coats[0].ggx.sample_visible(self.outward, u);
            2.0 * self.outward.dot(h) * h - self.outward
        } else {
            warp::cosine_hemisphere(u)
        };
        if up.z <= 0.0 || reflected + transmitted + coat == 0.0 {
            return None;
        }
        let through = lobe >= coat + reflected;
        let side = 1.0_f32.copysign(self.wo.z);
        let wi = if through {
            let down = Vec3::new(up.x, up.y, -side * up.z);
            Tilt::to(self.other).to_mesh(down)
        } else {
            let local = Vec3::new(up.x, up.y, side * up.z);
            self.frame.to_mesh(local)
        };
        if (wi.z * self.wo.z < 0.0) != through {
            return None;
        }
        self.scatter(wi).drawn(wi)
    }
}

#[cfg(test)]
mod tests;
