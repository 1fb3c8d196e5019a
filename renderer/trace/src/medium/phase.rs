//! Phase functions: where light goes that a medium scatters.

use std::f32::consts::PI;

use glam::{Vec2, Vec3};

use crate::geometry::frame::Frame;
use crate::sampling::warp::cosine_hemisphere;

/// Where light goes that a medium scatters, by the angle from its way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Phase {
    /// Henyey and Greenstein's function; `g` is the mean cosine of the angle, in (−1, 1): 0 is the
    /// same in all directions, above it goes on forwards.
    HenyeyGreenstein {
        /// Mean cosine.
        g: f32,
    },
    /// That of particles far smaller than the wavelength, unpolarised.
    Rayleigh,
    /// That of a leaf with Lambertian faces.
    Leaf {
        /// Its normal, unit, on the side to which light goes that passes.
        normal: Vec3,
        /// The fraction of what it scatters that passes.
        through: f32,
    },
}

/// A direction in which light is scattered.
#[derive(Clone, Copy, Debug)]
pub struct Scattering {
    /// Where it goes, unit, world.
    pub direction: Vec3,
    /// Density over solid angle, sr⁻¹, which is the phase function's value.
    pub pdf: f32,
}

impl Phase {
    /// Value for light that goes from one way to another, both unit, sr⁻¹. Its integral over all directions is 1.
    pub fn value(self, way: Vec3, next: Vec3) -> f32 {
        let cos = way.dot(next);
        match self {
            Self::HenyeyGreenstein { g } => {
                let base = (1.0 + g * g - 2.0 * g * cos).max(f32::MIN_POSITIVE);
                (1.0 - g * g) / (4.0 * PI * base * base.sqrt())
            }
            Self::Rayleigh => 3.0 / (16.0 * PI) * (1.0 + cos * cos),
            Self::Leaf { normal, through } => {
                let is_through = passes(normal, way, next);
                let fraction = if is_through { through } else { 1.0 - through };
                fraction * normal.dot(next).abs() / PI
            }
        }
    }

    /// Draws a direction for light that went along `way`, unit, by numbers in [0, 1). `lobe` is for leaves alone.
    ///
    /// # Source
    ///
    /// Inversion for Henyey–Greenstein \[henyey1941\]; \[frisvad2011\] for Rayleigh.
    pub fn sample(self, way: Vec3, lobe: f32, u: Vec2) -> Scattering {
        let x = f64::from(u.x);
        let cos = match self {
            Self::HenyeyGreenstein { g } => {
                let g = f64::from(g);
                if g.abs() < 1e-4 {
                    // Where g² is nothing beside 1, this is the inverse to first order in g.
                    let even = 2.0 * x - 1.0;
                    even + 1.5 * g * (1.0 - even * even)
                } else {
                    let root = (1.0 - g * g) / (1.0 - g + 2.0 * g * x);
                    (1.0 + g * g - root * root) / (2.0 * g)
                }
            }
            Self::Leaf { normal, through } => {
                let side = if lobe < through { normal } else { -normal };
                let direction = Frame::from_normal(side)
                    .to_world(cosine_hemisphere(u))
                    .normalize();
                return Scattering {
                    direction,
                    pdf: self.value(way, direction),
                };
            }
            Self::Rayleigh => {
                let even = 4.0 * x - 2.0;
                let root = libm::cbrt(even + (even * even + 1.0).sqrt());
                root - 1.0 / root
            }
        };
        let cos = cos.clamp(-1.0, 1.0);
        let sin = ((1.0 - cos) * (1.0 + cos)).max(0.0).sqrt() as f32;
        let cos = cos as f32;
        let (sin_phi, cos_phi) = libm::sincosf(2.0 * PI * u.y);
        let (across, along) = way.any_orthonormal_pair();
        let direction = across * (sin * cos_phi) + along * (sin * sin_phi) + way * cos;
        Scattering {
            direction: direction.normalize(),
            pdf: self.value(way, direction),
        }
    }
}

/// Whether light from one way to another passes a plate.
pub(super) fn passes(normal: Vec3, way: Vec3, next: Vec3) -> bool {
    (normal.dot(way) < 0.0) == (normal.dot(next) < 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn slanted(cos: f64) -> Vec3 {
        Vec3::new((1.0 - cos * cos).sqrt() as f32, 0.0, cos as f32)
    }

    /// Integrals of the function and of cosine times it, by the midpoint rule in the cosine.
    fn moments(phase: Phase) -> [f64; 2] {
        let steps = 2_000_000;
        let mut moments = [0.0; 2];
        for i in 0..steps {
            let cos = -1.0 + (2.0 * f64::from(i) + 1.0) / f64::from(steps);
            let value = f64::from(phase.value(Vec3::Z, slanted(cos))) * 4.0 * std::f64::consts::PI;
            moments[0] += value / f64::from(steps);
            moments[1] += value * cos / f64::from(steps);
        }
        moments
    }

    #[test]
    fn phase_functions_scatter_all_light_and_have_their_mean_cosine() {
        for g in [-0.9, -0.3, 0.0, 1e-5, 0.5, 0.9, 0.99_f32] {
            let [all, mean] = moments(Phase::HenyeyGreenstein { g });
            assert!((all - 1.0).abs() < 1e-3, "{g}: {all}");
            assert!((mean - f64::from(g)).abs() < 1e-3, "{g}: {mean}");
        }
        let [all, mean] = moments(Phase::Rayleigh);
        assert!((all - 1.0).abs() < 1e-6 && mean.abs() < 1e-6);
    }

    #[test]
    fn directions_are_unit_and_about_the_way() {
        let way = Vec3::new(0.48, -0.6, 0.64);
        for phase in [
            Phase::HenyeyGreenstein { g: 0.8 },
            Phase::HenyeyGreenstein { g: 1e-5 },
            Phase::Rayleigh,
            Phase::Leaf {
                normal: Vec3::new(0.6, 0.0, 0.8),
                through: 0.3,
            },
        ] {
            for i in 0..1000_u16 {
                let u = Vec2::new(f32::from(i) / 1000.0, f32::from(i * 37 % 1000) / 1000.0);
                let drawn = phase.sample(way, 0.5, u);
                assert!((drawn.direction.length() - 1.0).abs() < 1e-6);
                let expected = phase.value(way, drawn.direction);
                assert!(
                    (drawn.pdf - expected).abs() <= 1e-3 * expected,
                    "{phase:?} {u}"
                );
            }
        }
    }
}
