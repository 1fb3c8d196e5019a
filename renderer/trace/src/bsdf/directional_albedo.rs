//! The directional albedo of a rough coat, tabulated once for each material.

use std::f32::consts::FRAC_PI_2;

use glam::{Vec2, Vec3};
use rayon::prelude::*;

use crate::bsdf::fresnel;
use crate::bsdf::ggx::Ggx;
use crate::bsdf::known::Known;
use crate::bsdf::leaf_shape::{Passed, slant};
use crate::sampling::warp;

/// `E(ω)`, the share of light from ω that the coat's lobe reflects, and its mean `Ē`.
///
/// `E` is even in both tangent axes, so a table over `√µ` and the azimuth in the first quadrant is
/// complete; between nodes it is linear in µ and `sin² φ`. Nodes at squares of even steps in µ crowd at grazing
/// angles, where `E` rises fastest. There it follows the roughness in the plane of the light, so azimuths
/// are those at which this is at even ratios: at even steps of `sin² φ` a coat eight times as rough along as across
/// was off by 0.01.
#[derive(Clone, Debug)]
pub struct DirectionalAlbedo {
    /// `[azimuth][µ]`.
    values: Box<[[f32; MU_NODES]]>,
    /// `sin² φ` of each azimuth, from 0 to 1; a single one if the coat is isotropic.
    azimuths: Box<[f32]>,
    mean: f32,
    passed: Passed,
}

const MU_NODES: usize = 129;
/// Greatest step between azimuths of the logarithm of the roughness: `E` is within 3e-4 between them.
const ROUGHNESS_STEP: f32 = 0.0625;
/// Points of the rank-1 lattice for one entry: consecutive Fibonacci numbers.
const LATTICE: (u32, u32) = (6765, 4181);

impl DirectionalAlbedo {
    /// The directional albedo of a GGX coat with refractive index `eta`; worked out once in a process,
    /// since the leaves of a plant have the same coats.
    pub fn new(ggx: Ggx, eta: f32) -> Self {
        static KNOWN: Known<[u32; 3], DirectionalAlbedo> = Known::new();
        let key = [ggx.alpha_x, ggx.alpha_y, eta].map(f32::to_bits);
        KNOWN
            .get(key, || Self::worked_out(ggx, eta))
            .as_ref()
            .clone()
    }

    fn worked_out(ggx: Ggx, eta: f32) -> Self {
        if eta == 1.0 {
            return Self {
                values: Box::new([[0.0; MU_NODES]]),
                azimuths: Box::new([0.0]),
                mean: 0.0,
                passed: {
                    let [_, slanting, squared] = slants(|_| 1.0);
                    Passed::of_sums([1.0, slanting, squared])
                },
            };
        }
        let azimuths = azimuths_of(ggx);
        let points = lattice_on_disc(LATTICE);
        let entry = |number: usize| {
            let sin2 = azimuths[number / MU_NODES];
            let mu = mu_of((number % MU_NODES) as f32);
            reflected_share(
                ggx,
                |cos| fresnel::dielectric(cos, eta),
                (mu, sin2),
                &points,
            )
        };
        // Collected by number, so that it is the same on any number of threads.
        let entries = (0..azimuths.len() * MU_NODES).into_par_iter().map(entry);
        let entries: Vec<f32> = entries.collect();
        let values: Box<[[f32; MU_NODES]]> = entries.as_chunks().0.into();
        // Exact along µ: integrals of a linear function times µ and µ² over an interval.
        let mean = mean_of(&values, &azimuths, |[low, high], [at_low, at_high]| {
            2.0 * (high - low) * (at_low * (2.0 * low + high) + at_high * (low + 2.0 * high)) / 6.0
        });
        let weighted = |power: i32| {
            mean_of(&values, &azimuths, |[low, high], [at_low, at_high]| {
                let at = |share: f64| {
                    let mu = low + (high - low) * share;
                    let reflected = at_low + (at_high - at_low) * share;
                    2.0 * mu * reflected * f64::from(slant(mu as f32)).powi(power)
                };
                (high - low) * gauss(at)
            })
        };
        let [all, slanting, squared] = slants(|_| 1.0);
        let passed = Passed::of_sums([all - mean, slanting - weighted(1), squared - weighted(2)]);
        Self {
            values,
            azimuths,
            mean,
            passed,
        }
    }

    /// `E(ω)`, the same for ω and −ω.
    pub fn at(&self, w: Vec3) -> f32 {
        let place = w.z.abs().min(1.0).sqrt() * (MU_NODES - 1) as f32;
        let below = (place as usize).min(MU_NODES - 2);
        // Linear in µ between the nodes' cosines, so that the mean below is exact.
        let (low, high) = (mu_of(below as f32), mu_of(below as f32 + 1.0));
        let share = ((w.z.abs().min(1.0) - low) / (high - low)).clamp(0.0, 1.0);
        let along = |row: &[f32; MU_NODES]| row[below] * (1.0 - share) + row[below + 1] * share;
        if self.values.len() == 1 {
            return along(&self.values[0]);
        }
        let radius2 = w.x * w.x + w.y * w.y;
        let sin2 = if radius2 > 0.0 {
            w.y * w.y / radius2
        } else {
            0.5
        };
        let (below, share) = between(&self.azimuths, sin2);
        along(&self.values[below]) * (1.0 - share) + along(&self.values[below + 1]) * share
    }

    /// `E` at normal incidence.
    pub fn normal(&self) -> f32 {
        self.values[0][MU_NODES - 1]
    }

    /// `Ē = 1/π ∫ E µ dω`.
    pub fn mean(&self) -> f32 {
        self.mean
    }

    /// What passes of light that is alike from all directions.
    pub fn passed(&self) -> Passed {
        self.passed
    }
}

/// `sin² φ` of the azimuths of a table.
fn azimuths_of(ggx: Ggx) -> Box<[f32]> {
    let ratio = ggx.alpha_y / ggx.alpha_x;
    if ratio == 1.0 {
        return Box::new([0.0]);
    }
    let steps = (libm::logf(ratio).abs() / ROUGHNESS_STEP).ceil();
    let sin2 = |step: usize| {
        // The square of the roughness is linear in sin² φ.
        let square = libm::powf(ratio, 2.0 * step as f32 / steps);
        ((square - 1.0) / (ratio * ratio - 1.0)).clamp(0.0, 1.0)
    };
    let inner = (1..steps as usize).map(sin2);
    std::iter::once(0.0).chain(inner).chain([1.0]).collect()
}

/// The azimuth below and the share of the next one, of more than one.
#[inline]
fn between(azimuths: &[f32], sin2: f32) -> (usize, f32) {
    let above = azimuths.partition_point(|&node| node <= sin2);
    let below = above.clamp(1, azimuths.len() - 1) - 1;
    let [low, high] = [azimuths[below], azimuths[below + 1]];
    (below, ((sin2 - low) / (high - low)).clamp(0.0, 1.0))
}

/// Mean over [0, 1], exact for polynomials of degree 5 (Gauss and Legendre).
fn gauss(f: impl Fn(f64) -> f64) -> f64 {
    let away = 0.5 * libm::sqrt(0.6);
    (5.0 * (f(0.5 - away) + f(0.5 + away)) + 8.0 * f(0.5)) / 18.0
}

/// `∫ 2 w µ dµ`, `∫ 2 w x µ dµ` and `∫ 2 w x² µ dµ` of a weight by cosine.
pub(super) fn slants(weight: impl Fn(f32) -> f32) -> [f32; 3] {
    let steps = 400;
    let mut sums = [0.0_f64; 3];
    for step in 0..steps {
        // Midpoints in √µ: µ = y², 2 µ dµ = 4 y³ dy.
        let y = (step as f32 + 0.5) / steps as f32;
        let (mu, x) = (y * y, slant(y * y));
        let share = weight(mu) * 4.0 * y * y * y;
        for (sum, factor) in sums.iter_mut().zip([1.0, x, x * x]) {
            *sum += f64::from(share * factor) / f64::from(steps);
        }
    }
    sums.map(|sum| sum as f32)
}

fn mu_of(node: f32) -> f32 {
    let x = node / (MU_NODES - 1) as f32;
    x * x
}

/// The points of a rank-1 lattice (two consecutive Fibonacci numbers), on the unit disc.
pub(super) fn lattice_on_disc((count, step): (u32, u32)) -> Vec<Vec2> {
    let point = |i: u32| {
        let x = (i as f32 + 0.5) / count as f32;
        let y = ((u64::from(i) * u64::from(step)) % u64::from(count)) as f32 + 0.5;
        warp::disc(Vec2::new(x, y / count as f32))
    };
    (0..count).map(point).collect()
}

/// `E` at one direction, given by its cosine and `sin² φ`, by a lattice over the visible normals: the
/// integrand `F G₂ / G₁` is smooth.
pub(super) fn reflected_share(
    ggx: Ggx,
    fresnel: impl Fn(f32) -> f32,
    (mu, sin2_phi): (f32, f32),
    points: &[Vec2],
) -> f32 {
    // At exactly grazing incidence the limit is taken from close by.
    let mu = mu.max(0.25 * mu_of(1.0));
    let sin = (1.0 - mu * mu).max(0.0).sqrt();
    let wo = Vec3::new(sin * (1.0 - sin2_phi).sqrt(), sin * sin2_phi.sqrt(), mu);
    let visible = ggx.seen_from(wo);
    let (lambda, g1) = (ggx.lambda(wo), ggx.g1(wo));
    let mut sum = 0.0_f64;
    for point in points {
        let h = visible.normal(*point);
        let cos = wo.dot(h);
        let wi = 2.0 * cos * h - wo;
        if cos > 0.0 && wi.z > 0.0 {
            let g2 = 1.0 / (1.0 + lambda + ggx.lambda(wi));
            sum += f64::from(fresnel(cos) * g2 / g1);
        }
    }
    (sum / points.len() as f64) as f32
}

/// `2/π ∫₀^{π/2} dφ ∫ 2 E w dµ` of the table as interpolated; `interval` gives the integral over one
/// interval of µ from its ends and the values there.
fn mean_of(
    values: &[[f32; MU_NODES]],
    azimuths: &[f32],
    interval: impl Fn([f64; 2], [f64; 2]) -> f64,
) -> f32 {
    let row_mean = |row: &[f32; MU_NODES]| -> f64 {
        (0..MU_NODES - 1)
            .map(|i| {
                let ends = [i, i + 1];
                let cosines = ends.map(|node| f64::from(mu_of(node as f32)));
                interval(cosines, ends.map(|node| f64::from(row[node])))
            })
            .sum()
    };
    let rows: Vec<f64> = values.iter().map(row_mean).collect();
    if rows.len() == 1 {
        return rows[0] as f32;
    }
    // Along φ the table is linear in sin² φ.
    let steps = 4096;
    let mut sum = 0.0;
    for step in 0..steps {
        let phi = FRAC_PI_2 * (step as f32 + 0.5) / steps as f32;
        let sin = libm::sinf(phi);
        let (below, share) = between(azimuths, sin * sin);
        let share = f64::from(share);
        sum += rows[below] * (1.0 - share) + rows[below + 1] * share;
    }
    (sum / f64::from(steps)) as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_nearly_smooth_coat_reflects_what_fresnel_says() {
        let coat = DirectionalAlbedo::new(
            Ggx {
                alpha_x: 0.02,
                alpha_y: 0.02,
            },
            1.5,
        );
        for mu in [0.3_f32, 0.5, 0.8, 1.0] {
            let expected = fresnel::dielectric(mu, 1.5);
            let found = coat.at(Vec3::new((1.0 - mu * mu).sqrt(), 0.0, mu));
            assert!(
                (found - expected).abs() < 2e-3,
                "µ = {mu}: {found} against {expected}"
            );
        }
    }

    #[test]
    fn diffuse_light_meets_the_published_external_reflectance() {
        // Diffuse-incidence reflectance of a smooth boundary, n = 1.5: 0.0918. Even a nearly smooth
        // coat shadows itself at grazing angles, where a perfectly smooth one would reflect
        // everything.
        let coat = DirectionalAlbedo::new(
            Ggx {
                alpha_x: 0.02,
                alpha_y: 0.02,
            },
            1.5,
        );
        assert!((coat.mean() - 0.0918).abs() < 2e-3, "{}", coat.mean());
    }

    #[test]
    fn anisotropy_turns_with_the_axes() {
        let a = DirectionalAlbedo::new(
            Ggx {
                alpha_x: 0.2,
                alpha_y: 0.6,
            },
            1.45,
        );
        let b = DirectionalAlbedo::new(
            Ggx {
                alpha_x: 0.6,
                alpha_y: 0.2,
            },
            1.45,
        );
        for w in [
            Vec3::new(0.5, 0.7, 0.2),
            Vec3::new(0.9, 0.1, 0.1),
            Vec3::new(0.1, 0.2, 0.9),
        ] {
            let w = w.normalize();
            assert!((a.at(w) - b.at(Vec3::new(w.y, w.x, w.z))).abs() < 1e-3);
        }
        assert!((a.mean() - b.mean()).abs() < 2e-4);
    }

    #[test]
    fn the_table_is_right_between_its_azimuths_however_unlike_both_roughnesses() {
        for (alpha_x, alpha_y, eta) in [(0.05, 0.4, 2.0), (0.02, 1.0, 1.5), (0.4, 0.3, 1.45)] {
            let ggx = Ggx { alpha_x, alpha_y };
            let coat = DirectionalAlbedo::new(ggx, eta);
            let points = lattice_on_disc(LATTICE);
            let nodes = &coat.azimuths;
            let middles = nodes.windows(2).map(|ends| 0.5 * (ends[0] + ends[1]));
            let places = middles.flat_map(|sin2| [0.01_f32, 0.1, 0.3].map(|mu| (mu, sin2)));
            for (mu, sin2) in places {
                let fresnel = |cos| fresnel::dielectric(cos, eta);
                let expected = reflected_share(ggx, fresnel, (mu, sin2), &points);
                let (sin, along) = ((1.0 - mu * mu).sqrt(), sin2.sqrt());
                let found = coat.at(Vec3::new(sin * (1.0 - sin2).sqrt(), sin * along, mu));
                let off = (found - expected).abs();
                assert!(off < 7e-4, "{alpha_x} {alpha_y}, µ = {mu}, {sin2}: {off}");
            }
        }
    }
}
