//! Phase functions: where light goes that a medium scatters.

use std::f32::consts::PI;

use glam::{Vec2, Vec3};

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
    /// That of small level plates in all directions alike, both faces Lambertian, which let the fraction
    /// `through` of the light that they scatter pass.
    Leaves {
        /// The fraction.
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
    /// Value for a cosine of the angle between the ways before and after, sr⁻¹. Its integral over
    /// all directions is 1.
    pub fn value(self, cos: f32) -> f32 {
        match self {
            Self::HenyeyGreenstein { g } => {
                let base = (1.0 + g * g - 2.0 * g * cos).max(f32::MIN_POSITIVE);
                (1.0 - g * g) / (4.0 * PI * base * base.sqrt())
            }
            Self::Rayleigh => 3.0 / (16.0 * PI) * (1.0 + cos * cos),
            Self::Leaves { through } => {
                let [back, forth] = lobes_of_leaves(cos);
                (1.0 - through) * back + through * forth
            }
        }
    }

    /// Draws a direction for light that went along `way`, unit, by numbers in [0, 1).
    ///
    /// # Source
    ///
    /// Inversion for Henyey–Greenstein \[henyey1941\]; \[frisvad2011\] for Rayleigh.
    pub fn sample(self, way: Vec3, u: Vec2) -> Scattering {
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
            Self::Leaves { through } => {
                let through = f64::from(through);
                if x < through {
                    -cosine_of_leaves(x / through)
                } else {
                    cosine_of_leaves((x - through) / (1.0 - through))
                }
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
            pdf: self.value(cos),
        }
    }
}

/// Where plates in all directions alike send light, by the cosine of the angle of scattering: what their lit faces reflect, as
/// a Lambertian sphere does, and what passes them, which is the same mirrored.
fn lobes_of_leaves(cos: f32) -> [f32; 2] {
    let cos = cos.clamp(-1.0, 1.0);
    let angle = libm::acosf(cos);
    let sin = (1.0 - cos * cos).max(0.0).sqrt();
    let factor = 2.0 / (3.0 * PI * PI);
    [angle, angle - PI].map(|angle| factor * (sin - angle * cos))
}

/// The cosine of the angle b of scattering below which a fraction of what lit faces reflect goes: the inverse of
/// (4b + 2b cos 2b − 3 sin 2b) / 6π.
fn cosine_of_leaves(fraction: f64) -> f64 {
    let target = 6.0 * std::f64::consts::PI * fraction.clamp(0.0, 1.0);
    let (mut low, mut high) = (0.0, std::f64::consts::PI);
    let mut angle = 0.5 * high;
    // Newton's steps where they stay between the bounds, else halves.
    for _ in 0..60 {
        let (sin, cos) = libm::sincos(2.0 * angle);
        let off = 4.0 * angle + 2.0 * angle * cos - 3.0 * sin - target;
        if off < 0.0 {
            low = angle;
        } else {
            high = angle;
        }
        let slope = 4.0 - 4.0 * cos - 4.0 * angle * sin;
        let next = angle - off / slope;
        let next = if next > low && next < high {
            next
        } else {
            0.5 * (low + high)
        };
        if (next - angle).abs() < 1e-9 {
            break;
        }
        angle = next;
    }
    libm::cos(angle)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Integrals of the function and of cosine times it, by the midpoint rule in the cosine.
    fn moments(phase: Phase) -> [f64; 2] {
        let steps = 2_000_000;
        let mut moments = [0.0; 2];
        for i in 0..steps {
            let cos = -1.0 + (2.0 * f64::from(i) + 1.0) / f64::from(steps);
            let value = f64::from(phase.value(cos as f32)) * 4.0 * std::f64::consts::PI;
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
        // A Lambertian sphere has the mean cosine −4/9.
        for through in [0.0, 0.3, 1.0] {
            let [all, mean] = moments(Phase::Leaves { through });
            let expected = (2.0 * f64::from(through) - 1.0) * 4.0 / 9.0;
            assert!((all - 1.0).abs() < 1e-5, "{through}: {all}");
            assert!((mean - expected).abs() < 1e-5, "{through}: {mean}");
        }
    }

    #[test]
    fn angles_of_leaves_are_drawn_as_often_as_they_should_be() {
        let (way, bins, count) = (Vec3::Z, 16_usize, 40_000_u32);
        for through in [0.0, 0.4, 1.0] {
            let phase = Phase::Leaves { through };
            let mut found = vec![0.0; bins];
            for i in 0..count {
                let u = Vec2::new((f64::from(i) + 0.5) as f32 / count as f32, 0.3);
                let cos = f64::from(phase.sample(way, u).direction.dot(way));
                let bin = (0.5 * (cos + 1.0) * bins as f64) as usize;
                found[bin.min(bins - 1)] += 1.0 / f64::from(count);
            }
            for (bin, found) in found.into_iter().enumerate() {
                let steps = 1000;
                let cosines = (0..steps).map(|i| {
                    let place =
                        (bin as f64 + (f64::from(i) + 0.5) / f64::from(steps)) / bins as f64;
                    2.0 * place - 1.0
                });
                let mean = cosines
                    .map(|cos| f64::from(phase.value(cos as f32)))
                    .sum::<f64>();
                let expected = mean / f64::from(steps) * 4.0 * std::f64::consts::PI / bins as f64;
                assert!(
                    (found - expected).abs() < 2e-4,
                    "{through} {bin}: {found} {expected}"
                );
            }
        }
    }

    #[test]
    fn directions_are_unit_and_about_the_way() {
        let way = Vec3::new(0.48, -0.6, 0.64);
        for phase in [
            Phase::HenyeyGreenstein { g: 0.8 },
            Phase::HenyeyGreenstein { g: 1e-5 },
            Phase::Rayleigh,
        ] {
            for i in 0..1000_u16 {
                let u = Vec2::new(f32::from(i) / 1000.0, f32::from(i * 37 % 1000) / 1000.0);
                let drawn = phase.sample(way, u);
                assert!((drawn.direction.length() - 1.0).abs() < 1e-6);
                let expected = phase.value(drawn.direction.dot(way));
                assert!(
                    (drawn.pdf - expected).abs() < 1e-3 * expected,
                    "{phase:?} {u}"
                );
            }
        }
    }
}
