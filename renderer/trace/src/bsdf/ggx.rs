//! The GGX distribution of microfacet normals with height-correlated Smith shadowing.

use std::f32::consts::PI;

use glam::{Vec2, Vec3};

use crate::sampling::warp;

/// Roughness along the two tangent axes; directions are on the side +z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ggx {
    /// Roughness along local x.
    pub alpha_x: f32,
    /// Roughness along local y.
    pub alpha_y: f32,
}

impl Ggx {
    /// Density of microfacet normals, sr⁻¹ (Walter et al. 2007; Heitz 2014 for the anisotropic
    /// form).
    pub fn d(&self, h: Vec3) -> f32 {
        let x = h.x / self.alpha_x;
        let y = h.y / self.alpha_y;
        let stretched = x * x + y * y + h.z * h.z;
        1.0 / (PI * self.alpha_x * self.alpha_y * stretched * stretched)
    }

    /// Smith's auxiliary function Λ.
    pub fn lambda(&self, w: Vec3) -> f32 {
        let x = self.alpha_x * w.x;
        let y = self.alpha_y * w.y;
        let tan2 = (x * x + y * y) / (w.z * w.z);
        0.5 * ((1.0 + tan2).sqrt() - 1.0)
    }

    /// Masking from one direction.
    pub fn g1(&self, w: Vec3) -> f32 {
        1.0 / (1.0 + self.lambda(w))
    }

    /// A microfacet normal drawn from those visible from `wo` (Heitz, JCGT 7(4), 2018).
    pub fn sample_visible(&self, wo: Vec3, u: Vec2) -> Vec3 {
        self.seen_from(wo).normal(warp::disc(u))
    }

    /// What the normals visible from one direction share.
    #[inline]
    pub(super) fn seen_from(self, wo: Vec3) -> Visible {
        let stretched = Vec3::new(self.alpha_x * wo.x, self.alpha_y * wo.y, wo.z).normalize();
        let length2 = stretched.x * stretched.x + stretched.y * stretched.y;
        let t1 = if length2 > 0.0 {
            Vec3::new(-stretched.y, stretched.x, 0.0) / length2.sqrt()
        } else {
            Vec3::X
        };
        Visible {
            ggx: self,
            stretched,
            t1,
            t2: stretched.cross(t1),
            lift: 0.5 * (1.0 + stretched.z),
        }
    }

    /// Density of [`Ggx::sample_visible`] over solid angle of the normal, sr⁻¹.
    pub(crate) fn visible_density(self, wo: Vec3, h: Vec3) -> f32 {
        self.g1(wo) * wo.dot(h).max(0.0) * self.d(h) / wo.z
    }
}

/// The microfacet normals visible from one direction.
pub(super) struct Visible {
    ggx: Ggx,
    /// The direction where the facets are a hemisphere, and the two tangents there.
    stretched: Vec3,
    t1: Vec3,
    t2: Vec3,
    lift: f32,
}

impl Visible {
    /// The normal for a point of the unit disc.
    #[inline]
    pub(super) fn normal(&self, point: Vec2) -> Vec3 {
        let y = (1.0 - self.lift) * (1.0 - point.x * point.x).max(0.0).sqrt() + self.lift * point.y;
        let z = (1.0 - point.x * point.x - y * y).max(0.0).sqrt();
        let normal = point.x * self.t1 + y * self.t2 + z * self.stretched;
        Vec3::new(
            self.ggx.alpha_x * normal.x,
            self.ggx.alpha_y * normal.y,
            normal.z.max(1e-6),
        )
        .normalize()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Integrates over the upper hemisphere with a rule that is even in cos² θ and φ.
    fn over_hemisphere(f: impl Fn(Vec3) -> f32) -> f64 {
        let (rings, spokes) = (2000, 256);
        let mut sum = 0.0;
        for i in 0..rings {
            // Nodes are dense around the pole, where a sharp lobe lies.
            let x = (i as f32 + 0.5) / rings as f32;
            let theta = 0.5 * PI * x * x;
            let weight = 0.5 * PI * 2.0 * x / rings as f32 * theta.sin();
            for j in 0..spokes {
                let phi = 2.0 * PI * (j as f32 + 0.5) / spokes as f32;
                let w = Vec3::new(
                    theta.sin() * phi.cos(),
                    theta.sin() * phi.sin(),
                    theta.cos(),
                );
                sum += f64::from(f(w) * weight) * f64::from(2.0 * PI) / f64::from(spokes);
            }
        }
        sum
    }

    #[test]
    fn facets_cover_the_surface_exactly_once() {
        for (alpha_x, alpha_y) in [(0.1, 0.1), (0.2, 0.5), (1.0, 1.0)] {
            let ggx = Ggx { alpha_x, alpha_y };
            let covered = over_hemisphere(|h| ggx.d(h) * h.z);
            assert!(
                (covered - 1.0).abs() < 2e-3,
                "{alpha_x} {alpha_y}: {covered}"
            );
        }
    }

    #[test]
    fn visible_normals_have_a_density_that_integrates_to_one() {
        let ggx = Ggx {
            alpha_x: 0.3,
            alpha_y: 0.15,
        };
        for wo in [
            Vec3::Z,
            Vec3::new(0.6, 0.0, 0.8),
            Vec3::new(0.3, 0.9, 0.2).normalize(),
        ] {
            let total = over_hemisphere(|h| ggx.visible_density(wo, h));
            assert!((total - 1.0).abs() < 5e-3, "{wo}: {total}");
        }
    }
}
