//! A disc at infinity, like the sun.

use std::f32::consts::PI;

use glam::{Vec2, Vec3};

use crate::geometry::frame::Frame;
use crate::light::sample::LightSample;
use crate::sampling::warp;
use crate::spectrum::{Curve, Lanes, Spectrum, WavelengthGrid, Wavelengths};

/// Uniform radiance within a cone of directions.
#[derive(Clone, Debug)]
pub struct DistantLight {
    frame: Frame,
    /// 1 − cos of half the angular diameter.
    one_minus_cos: f32,
    /// Density of directions within it, sr⁻¹.
    pdf: f32,
    radiance: Spectrum,
}

impl DistantLight {
    /// A light in the direction of a unit vector, with the given angular diameter (rad) and
    /// irradiance on a surface facing it, W m⁻² nm⁻¹. Radiance is irradiance over `π sin²` of half
    /// the diameter.
    pub fn new(towards: Vec3, angular_diameter: f64, irradiance: Curve) -> Self {
        let half = 0.5 * angular_diameter;
        let sin = libm::sin(half);
        // 2 sin²(x/2) = 1 − cos x is accurate at small angles.
        let one_minus_cos = 2.0 * libm::sin(0.5 * half) * libm::sin(0.5 * half);
        let projected = std::f64::consts::PI * sin * sin;
        Self {
            frame: Frame::from_normal(towards),
            one_minus_cos: one_minus_cos as f32,
            pdf: 1.0 / (2.0 * PI * one_minus_cos as f32),
            radiance: irradiance.scaled((1.0 / projected) as f32).into(),
        }
    }

    /// Radiance curve, W m⁻² sr⁻¹ nm⁻¹.
    pub fn radiance(&self) -> &Curve {
        self.radiance.curve()
    }

    /// Irradiance on a surface that faces it, over its radiance, sr.
    pub fn solid_angle(&self) -> f32 {
        1.0 / self.pdf
    }

    /// Evaluates its radiance at every wavelength of a grid.
    pub fn tabulate(&mut self, grid: &WavelengthGrid) {
        self.radiance.tabulate(grid);
    }

    /// A direction to the disc, uniform over its solid angle.
    pub fn sample<const N: usize>(&self, wavelengths: &Wavelengths<N>, u: Vec2) -> LightSample<N> {
        LightSample {
            // Of unit length to a few roundings.
            wi: self.frame.to_world(warp::cone(u, self.one_minus_cos)),
            point: None,
            radiance: self.radiance.lanes(wavelengths),
            pdf: self.pdf,
            is_point: false,
        }
    }

    /// Radiance and density along `wi`, if that hits the disc.
    pub fn towards<const N: usize>(
        &self,
        wi: Vec3,
        wavelengths: &Wavelengths<N>,
    ) -> Option<(Lanes<N>, f32)> {
        // |wi − axis|² = 2 (1 − cos), free of cancellation.
        let one_minus_cos = 0.5 * (wi - self.frame.normal).length_squared();
        (one_minus_cos <= self.one_minus_cos).then(|| (self.radiance.lanes(wavelengths), self.pdf))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn irradiance_on_a_facing_surface_is_what_was_asked_for() {
        for diameter in [0.0093_f64, 0.5, 2.0] {
            let light = DistantLight::new(Vec3::Z, diameter, Curve::Constant(3.0));
            let wavelengths = Wavelengths::new([550.0; 8]);
            let side = 64;
            let mut irradiance = 0.0;
            for i in 0..side * side {
                let u = Vec2::new((i % side) as f32 + 0.5, (i / side) as f32 + 0.5) / side as f32;
                let sample = light.sample(&wavelengths, u);
                irradiance +=
                    sample.radiance.0[0] * sample.wi.z / sample.pdf / (side * side) as f32;
                assert!(light.towards(sample.wi, &wavelengths).is_some() || u.x > 0.98);
            }
            assert!(
                (irradiance - 3.0).abs() < 2e-3,
                "{diameter} rad: {irradiance}"
            );
        }
    }
}
