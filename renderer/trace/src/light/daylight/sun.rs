//! The sun's disc.

use std::f64::consts::PI;

use glam::{Vec2, Vec3};

use crate::geometry::frame::Frame;
use crate::light::sample::LightSample;
use crate::spectrum::{Curve, Lanes, Share, Table, WavelengthGrid, Wavelengths};

/// Half the angular diameter of the sun at its mean distance, 0.53° across, rad.
pub const HALF_DIAMETER: f64 = 0.265 * PI / 180.0;

/// Exponent of the density with which the disc is sampled: that of the limb at 560 nm.
const SAMPLED_EXPONENT: f32 = 0.5;

/// A disc at infinity that is darker towards its limb.
///
/// With `r` the distance from the disc's middle in radii and `μ = √(1 − r²)`, radiance is
/// proportional to `μ^α`, `α = −0.023 + 0.292 / λ`, `λ` in µm.
///
/// # Source
///
/// \[hestroffer1998\], the fit for 416–1099 nm, held at its ends.
#[derive(Clone, Debug)]
pub struct SunLight {
    frame: Frame,
    sin_half: f32,
    irradiance: Curve,
    /// Radiance in the middle and exponent.
    limb: Option<Table>,
}

impl SunLight {
    /// The sun in the direction of a unit vector, with its irradiance on a surface that faces it,
    /// W m⁻² nm⁻¹.
    pub fn new(towards: Vec3, irradiance: Curve) -> Self {
        Self {
            frame: Frame::from_normal(towards),
            sin_half: libm::sin(HALF_DIAMETER) as f32,
            irradiance,
            limb: None,
        }
    }

    /// Irradiance on a surface that faces it, W m⁻² nm⁻¹.
    pub fn irradiance(&self) -> &Curve {
        &self.irradiance
    }

    /// Evaluates its radiance at every wavelength of a grid.
    pub fn tabulate(&mut self, grid: &WavelengthGrid) {
        self.limb = Some(Table::by_place(grid, |row, lane| {
            self.limb_at(&grid.share(row, lane))
        }));
    }

    /// Radiance in the middle, and the exponent of the darkening. The mean of `μ^α` over the disc
    /// is 2 / (α + 2).
    pub(in crate::light) fn limb_at(&self, share: &Share) -> [f32; 2] {
        let exponent = -0.023 + 292.0 / share.nm.clamp(416.0, 1099.0);
        let mean = f64::from(self.irradiance.over(share)) / (PI * f64::from(self.sin_half).powi(2));
        [mean as f32 * 0.5 * (exponent + 2.0), exponent]
    }

    /// Radiance where the square of `μ` has this value.
    fn radiance<const N: usize>(&self, mu2: f32, wavelengths: &Wavelengths<N>) -> Lanes<N> {
        let table = self.limb.as_ref().and_then(|table| table.row(wavelengths));
        let [middle, exponent] = table.unwrap_or_else(|| {
            let values = wavelengths.nm.map(|nm| self.limb_at(&Share::only(nm)));
            std::array::from_fn(|i| Lanes::from_fn(|lane| values[lane][i]))
        });
        Lanes::from_fn(|lane| middle.0[lane] * libm::powf(mu2, 0.5 * exponent.0[lane]))
    }

    /// Density over solid angle, nearly that of the radiance at 560 nm.
    fn pdf(&self, mu2: f32, cos: f32) -> f32 {
        let power = 0.5 * SAMPLED_EXPONENT;
        let over_disc = (power + 1.0) * libm::powf(mu2, power);
        over_disc * cos / (std::f32::consts::PI * self.sin_half * self.sin_half)
    }

    /// A direction to the disc.
    pub fn sample<const N: usize>(&self, wavelengths: &Wavelengths<N>, u: Vec2) -> LightSample<N> {
        // The share of the disc within r is 1 − μ^(α + 2). Never the very limb, where density is 0.
        let inner = (1.0 - u.x).max(f32::EPSILON);
        let mu2 = libm::powf(inner, 1.0 / (0.5 * SAMPLED_EXPONENT + 1.0));
        let sin = self.sin_half * (1.0 - mu2).max(0.0).sqrt();
        let (sin_phi, cos_phi) = libm::sincosf(2.0 * std::f32::consts::PI * u.y);
        let cos = (1.0 - sin * sin).sqrt();
        let local = Vec3::new(sin * cos_phi, sin * sin_phi, cos);
        LightSample {
            wi: self.frame.to_world(local).normalize(),
            point: None,
            radiance: self.radiance(mu2, wavelengths),
            pdf: self.pdf(mu2, cos),
            is_point: false,
        }
    }

    /// Radiance and density along `wi`, if that hits the disc.
    pub fn towards<const N: usize>(
        &self,
        wi: Vec3,
        wavelengths: &Wavelengths<N>,
    ) -> Option<(Lanes<N>, f32)> {
        let cos = wi.dot(self.frame.normal);
        // The sine is accurate where the cosine of so small an angle is not.
        let sin = wi.cross(self.frame.normal).length();
        let mu2 = 1.0 - (sin / self.sin_half) * (sin / self.sin_half);
        (cos > 0.0 && mu2 > 0.0).then(|| (self.radiance(mu2, wavelengths), self.pdf(mu2, cos)))
    }
}
