//! A surface that shines to the side of its normal.

use glam::{Vec2, Vec3};

use crate::light::LightSample;
use crate::sampling::distribution::Piecewise1d;
use crate::sampling::warp;
use crate::spectrum::{Curve, Lanes, Spectrum, WavelengthGrid, Wavelengths};

/// Triangles in world space with one radiance.
#[derive(Clone, Debug)]
pub struct AreaLight {
    radiance: Spectrum,
    triangles: Box<[[Vec3; 3]]>,
    by_area: Piecewise1d,
    area: f32,
}

impl AreaLight {
    /// From world-space triangles, counter-clockwise seen from the bright side; at least one has an area.
    pub fn new(triangles: Vec<[Vec3; 3]>, radiance: Curve) -> Self {
        let areas: Vec<f32> = triangles
            .iter()
            .map(|[a, b, c]| 0.5 * (*b - *a).cross(*c - *a).length())
            .collect();
        Self {
            radiance: radiance.into(),
            area: areas.iter().sum(),
            by_area: Piecewise1d::new(&areas),
            triangles: triangles.into(),
        }
    }

    /// Area, m².
    pub fn area(&self) -> f32 {
        self.area
    }

    /// Radiance curve, W m⁻² sr⁻¹ nm⁻¹.
    pub fn radiance(&self) -> &Curve {
        self.radiance.curve()
    }

    /// Works its radiance out at every wavelength of a grid.
    pub fn tabulate(&mut self, grid: &WavelengthGrid) {
        self.radiance.tabulate(grid);
    }

    /// A point on the surface, uniform over its area, seen from `position`.
    pub fn sample<const N: usize>(
        &self,
        position: Vec3,
        wavelengths: &Wavelengths<N>,
        choice: f32,
        u: Vec2,
    ) -> Option<LightSample<N>> {
        let (triangle, _) = self.by_area.sample(choice);
        let [a, b, c] = self.triangles[triangle];
        let weights = warp::triangle(u);
        let point = a + (b - a) * weights.x + (c - a) * weights.y;
        let normal = (b - a).cross(c - a).normalize();
        let offset = point - position;
        let distance2 = offset.length_squared();
        let wi = offset.try_normalize()?;
        let cos = -wi.dot(normal);
        (cos > 0.0).then(|| LightSample {
            wi,
            point: Some(point),
            radiance: self.radiance.lanes(wavelengths),
            pdf: distance2 / (cos * self.area),
        })
    }

    /// Radiance towards `-wi` from a point of the surface with the given normal, and the density over solid angle,
    /// seen from `distance` away, with which [`AreaLight::sample`] draws it.
    pub fn emitted<const N: usize>(
        &self,
        wi: Vec3,
        normal: Vec3,
        distance: f32,
        wavelengths: &Wavelengths<N>,
    ) -> Option<(Lanes<N>, f32)> {
        let cos = -wi.dot(normal);
        (cos > 0.0).then(|| {
            (
                self.radiance.lanes(wavelengths),
                distance * distance / (cos * self.area),
            )
        })
    }
}
