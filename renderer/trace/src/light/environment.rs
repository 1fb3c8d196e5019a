//! A latitude–longitude picture at infinity.

use std::f32::consts::PI;

use glam::{Vec2, Vec3};

use super::radiance_table::RadianceTable;
use super::texels::{Beyond, Texels};
use crate::light::sample::{LightSample, unevenness};
use crate::sampling::distribution::Piecewise2d;
use crate::spectrum::rgb::Primaries;
use crate::spectrum::{Curve, Lanes, Share, WavelengthGrid, Wavelengths};

/// Radiance by direction: `u` runs with the azimuth from +x towards +y, `v` from the zenith (+z)
/// down.
#[derive(Clone, Debug)]
pub struct EnvironmentLight {
    picture: Texels,
    primaries: Primaries,
    /// Rotation about +z, rad.
    rotation: f32,
    distribution: Piecewise2d,
}

impl EnvironmentLight {
    /// A light from linear sRGB texels, finite, `width` per row. Colours outside of Rec. 709 have
    /// channels below 0.
    pub fn new(texels: Vec<[f32; 3]>, width: usize, white: Curve, rotation: f32) -> Self {
        let height = texels.len() / width;
        let brightness = |x: usize, y: usize| amount(texels[y * width + x]);
        // Look-up is bilinear, so a texel's light reaches half a texel into its neighbours.
        let mut weights = Vec::with_capacity(texels.len());
        for y in 0..height {
            let sin = libm::sinf(PI * (y as f32 + 0.5) / height as f32);
            for x in 0..width {
                let mut sum = 0.0;
                for dy in [y.saturating_sub(1), y, (y + 1).min(height - 1)] {
                    for dx in [(x + width - 1) % width, x, (x + 1) % width] {
                        let weight =
                            if dy == y { 2.0 } else { 1.0 } * if dx == x { 2.0 } else { 1.0 };
                        sum += weight * brightness(dx, dy);
                    }
                }
                weights.push(sum * sin);
            }
        }
        let (weights, cells_across) = coarsened(&weights, width);
        Self {
            distribution: Piecewise2d::new(&weights, cells_across),
            picture: Texels::new(texels, width),
            primaries: Primaries::new(white),
            rotation,
        }
    }

    /// Mean of the texels' red, green and blue over the sphere, a rough measure, to be multiplied
    /// by `white`.
    pub(crate) fn mean_brightness(&self) -> f32 {
        let [width, height] = self.picture.size();
        let mut sum = 0.0;
        let mut weight = 0.0;
        for (row, texels) in self.picture.texels().chunks(width).enumerate() {
            let sin = libm::sinf(PI * (row as f32 + 0.5) / height as f32);
            let amounts = texels.iter().flatten().map(|value| value.abs());
            sum += sin * amounts.sum::<f32>() / (3 * width) as f32;
            weight += sin;
        }
        sum / weight
    }

    /// Mean square of its radiance over all directions, relative to the square of the mean.
    pub fn unevenness(&self) -> f64 {
        unevenness(&self.distribution)
    }

    /// Mean of the texels over the sphere, linear sRGB, to be multiplied by `white`.
    pub(crate) fn mean_colour(&self) -> [f64; 3] {
        let [width, height] = self.picture.size();
        let mut sum = [0.0; 3];
        let mut weight = 0.0;
        for (row, texels) in self.picture.texels().chunks(width).enumerate() {
            // A row's share of the sphere.
            let [upper, lower] = [row, row + 1]
                .map(|row| libm::cos(std::f64::consts::PI * row as f64 / height as f64));
            for texel in texels {
                for (sum, value) in sum.iter_mut().zip(texel) {
                    *sum += (upper - lower) * f64::from(*value);
                }
            }
            weight += (upper - lower) * width as f64;
        }
        sum.map(|sum| sum / weight)
    }

    /// Spectrum of RGB 1 1 1.
    pub fn white(&self) -> &Curve {
        self.primaries.white()
    }

    /// A radiance that it exceeds in no direction.
    pub fn at_most(&self, share: &Share) -> f32 {
        let parts = self.primaries.over(share).into_iter();
        let parts = parts.zip(self.picture.greatest());
        parts.map(|(spectrum, most)| spectrum * most).sum()
    }

    /// Evaluates its primaries at every wavelength of a grid.
    pub fn tabulate(&mut self, grid: &WavelengthGrid) {
        self.primaries.tabulate(grid);
    }

    /// Its radiance as a table.
    pub fn tabulated(&self) -> RadianceTable<'_> {
        RadianceTable {
            size: self.picture.size(),
            weights: self
                .picture
                .texels()
                .iter()
                .map(|&[r, g, b]| [r, g, b, 0.0])
                .collect(),
            spectra: self.primaries.curves(),
            ground: None,
            rotation: self.rotation,
        }
    }

    fn radiance<const N: usize>(&self, uv: [f32; 2], wavelengths: &Wavelengths<N>) -> Lanes<N> {
        let colour = self.picture.at(uv, Beyond::Opposite);
        self.primaries.spectrum(colour, wavelengths)
    }

    fn uv_of(&self, wi: Vec3) -> [f32; 2] {
        let azimuth = (libm::atan2f(wi.y, wi.x) - self.rotation) / (2.0 * PI);
        // acos is inaccurate near the poles; atan2 is not.
        let polar = libm::atan2f((wi.x * wi.x + wi.y * wi.y).sqrt(), wi.z) / PI;
        [azimuth - azimuth.floor(), polar.min(1.0 - f32::EPSILON)]
    }

    /// Prefetches what [`EnvironmentLight::seen_towards`] will look up. Never inlined: it would be
    /// worked out for every ray of scenes that have no such light, too, before a loop over lights.
    #[inline(never)]
    pub fn prefetch(&self, wi: Vec3) {
        let azimuth = (rough_atan2(wi.y, wi.x) - self.rotation) / (2.0 * PI);
        let polar = rough_atan2((wi.x * wi.x + wi.y * wi.y).sqrt(), wi.z) / PI;
        self.picture.prefetch([azimuth - azimuth.floor(), polar]);
    }

    /// Samples a direction with a density roughly proportional to its brightness.
    pub fn sample<const N: usize>(
        &self,
        wavelengths: &Wavelengths<N>,
        u: Vec2,
    ) -> Option<LightSample<N>> {
        let (uv, density) = self.distribution.sample([u.x, u.y]);
        let (sin_theta, cos_theta) = libm::sincosf(PI * uv[1]);
        let (sin_phi, cos_phi) = libm::sincosf(2.0 * PI * uv[0] + self.rotation);
        (sin_theta > 0.0 && density > 0.0).then(|| LightSample {
            wi: Vec3::new(sin_theta * cos_phi, sin_theta * sin_phi, cos_theta),
            point: None,
            radiance: self.radiance(uv, wavelengths),
            pdf: density / (2.0 * PI * PI * sin_theta),
            is_point: false,
        })
    }

    /// Radiance along `wi`.
    pub fn seen_towards<const N: usize>(&self, wi: Vec3, wavelengths: &Wavelengths<N>) -> Lanes<N> {
        self.radiance(self.uv_of(wi), wavelengths)
    }

    /// Radiance and density along `wi`.
    pub fn towards<const N: usize>(
        &self,
        wi: Vec3,
        wavelengths: &Wavelengths<N>,
    ) -> (Lanes<N>, f32) {
        let uv = self.uv_of(wi);
        let sin_theta = (wi.x * wi.x + wi.y * wi.y).sqrt();
        let pdf = if sin_theta > 0.0 {
            self.distribution.density(uv) / (2.0 * PI * PI * sin_theta)
        } else {
            0.0
        };
        (self.radiance(uv, wavelengths), pdf)
    }
}

/// Sum of a colour's channels without their signs, so that all light is found by chance.
fn amount(colour: [f32; 3]) -> f32 {
    colour.iter().map(|value| value.abs()).sum()
}

/// `atan2` within 0.005 rad, for a prefetch: of a picture of 512 columns half a texel.
///
/// The arctangent of a slope up to 1 is the polynomial of least error with these two powers.
#[inline]
fn rough_atan2(y: f32, x: f32) -> f32 {
    let (least, most) = (x.abs().min(y.abs()), x.abs().max(y.abs()));
    let slope = least / most;
    let mut angle = slope * (0.9724 - 0.1919 * slope * slope);
    if y.abs() > x.abs() {
        angle = 0.5 * PI - angle;
    }
    if x < 0.0 {
        angle = PI - angle;
    }
    angle.copysign(y)
}

/// Greatest relative increase of the mean square of light over density by cells that are larger
/// than texels.
const COARSENING: f64 = 0.01;

/// Weights of square cells of 1, 2, 4, … texels per side, as large as possible with almost no
/// additional noise, and the number of cells across. A small table stays in the caches.
fn coarsened(weights: &[f32], width: usize) -> (Vec<f32>, usize) {
    let total: f64 = weights.iter().map(|&weight| f64::from(weight)).sum();
    let (mut coarsest, mut across) = (weights.to_vec(), width);
    let mut texels = 1;
    while across.is_multiple_of(2) && (coarsest.len() / across).is_multiple_of(2) {
        texels *= 2;
        let halved: Vec<f32> = (0..coarsest.len() / 4)
            .map(|cell| {
                let (x, y) = (cell % (across / 2), cell / (across / 2));
                let first = 2 * y * across + 2 * x;
                let [upper, lower] =
                    [first, first + across].map(|left| coarsest[left] + coarsest[left + 1]);
                upper + lower
            })
            .collect();
        // Mean square of a texel's weight over its density, relative to the square of the mean; 1
        // if cells are texels.
        let mut square = 0.0;
        for (texel, &weight) in weights.iter().enumerate() {
            let (x, y) = (texel % width / texels, texel / width / texels);
            if weight > 0.0 {
                square += f64::from(weight).powi(2) / f64::from(halved[y * (across / 2) + x]);
            }
        }
        if square * (texels * texels) as f64 > (1.0 + COARSENING) * total {
            break;
        }
        (coarsest, across) = (halved, across / 2);
    }
    (coarsest, across)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sky that is brighter towards one side and the zenith, without edges.
    fn smooth_sky() -> EnvironmentLight {
        let (width, height) = (64, 32);
        let texels = (0..width * height)
            .map(|i| {
                let azimuth = 2.0 * PI * (i % width) as f32 / width as f32;
                let down = (i / width) as f32 / height as f32;
                [2.0 + azimuth.cos() - down, 1.5 - down, 1.2]
            })
            .collect();
        EnvironmentLight::new(texels, width, Curve::Constant(1.0), 0.7)
    }

    #[test]
    fn cells_are_larger_than_texels_where_the_sky_is_smooth_and_not_where_it_is_not() {
        let weights: Vec<f32> = (0..32 * 64).map(|i| 3.0 + (i % 64) as f32 / 64.0).collect();
        let (cells, across) = coarsened(&weights, 64);
        assert!(
            across <= 8 && cells.len() == across * across / 2,
            "{across}"
        );
        let [fine, coarse] = [&weights, &cells].map(|weights| weights.iter().sum::<f32>());
        assert!((coarse / fine - 1.0).abs() < 1e-5, "{coarse}, not {fine}");
        let mut with_a_sun = weights;
        with_a_sun[999] = 1e5;
        assert_eq!(coarsened(&with_a_sun, 64), (with_a_sun, 64));
        // Sizes that cannot be halved, and weights of 0.
        assert_eq!(coarsened(&[1.0; 15], 5), (vec![1.0; 15], 5));
        assert_eq!(coarsened(&[0.0; 16], 4).1, 1);
    }

    #[test]
    fn the_rough_angle_is_within_five_thousandths() {
        for step in 0..720 {
            let angle = PI * (step as f32 - 359.5) / 360.0;
            for length in [1e-3, 1.0] {
                let (sin, cos) = libm::sincosf(angle);
                let rough = rough_atan2(length * sin, length * cos);
                assert!((rough - angle).abs() < 0.005, "{rough} {angle}");
            }
        }
    }

    fn sky() -> EnvironmentLight {
        let (width, height) = (32, 16);
        let texels = (0..width * height)
            .map(|i| {
                let bright = if i == 5 * width + 7 { 50.0 } else { 0.2 };
                [bright, 0.5 * bright, 0.1 + (i % width) as f32 * 0.01]
            })
            .collect();
        EnvironmentLight::new(texels, width, Curve::Constant(1.0), 0.7)
    }

    fn wavelengths() -> Wavelengths<8> {
        Wavelengths::new([420.0, 460.0, 500.0, 540.0, 580.0, 620.0, 660.0, 700.0])
    }

    #[test]
    fn a_drawn_direction_has_the_density_and_radiance_that_are_reported_for_it() {
        let light = sky();
        let mut across_a_border = 0;
        for i in 0..2000 {
            let u = Vec2::new((i as f32 * 0.618_034).fract(), (i as f32 + 0.5) / 2000.0);
            let sample = light
                .sample(&wavelengths(), u)
                .expect("the sky is bright everywhere");
            let (radiance, pdf) = light.towards(sample.wi, &wavelengths());
            assert_eq!(radiance, light.seen_towards(sample.wi, &wavelengths()));
            across_a_border += usize::from((pdf / sample.pdf - 1.0).abs() > 1e-3);
            assert!((radiance.0[3] / sample.radiance.0[3] - 1.0).abs() < 1e-2);
        }
        // Rounding may carry a direction at the edge of a cell into the next one.
        assert!(across_a_border <= 4, "{across_a_border} densities differ");
    }

    #[test]
    fn unevenness_is_1_of_an_even_sky_and_the_inverse_share_of_a_single_part() {
        let white = Curve::Constant(1.0);
        let even = EnvironmentLight::new(vec![[0.7; 3]; 64 * 32], 64, white.clone(), 0.0);
        assert!(
            (even.unevenness() - 1.0).abs() < 1e-3,
            "{}",
            even.unevenness()
        );
        // The upper half, an eighth around: its border is half a texel wide on each side.
        let (width, height) = (512, 256);
        let lit = |i: usize| (i % width) < width / 8 && i / width < height / 2;
        let texels = (0..width * height).map(|i| if lit(i) { [2.0; 3] } else { [0.0; 3] });
        let part = EnvironmentLight::new(texels.collect(), width, white, 0.0);
        assert!(
            (part.unevenness() / 16.0 - 1.0).abs() < 0.03,
            "{}",
            part.unevenness()
        );
        let directions = 40_000;
        let light = smooth_sky();
        let (mut mean, mut square) = (0.0_f64, 0.0_f64);
        for i in 0..directions {
            let z = 1.0 - 2.0 * (i as f32 + 0.5) / directions as f32;
            let (sin, cos) = libm::sincosf(2.0 * PI * (i as f32 * 0.618_034).fract());
            let radius = (1.0 - z * z).sqrt();
            let wi = Vec3::new(radius * cos, radius * sin, z);
            let colour = light.picture.at(light.uv_of(wi), Beyond::Opposite);
            let brightness = f64::from(colour.iter().sum::<f32>());
            mean += brightness / f64::from(directions);
            square += brightness * brightness / f64::from(directions);
        }
        let expected = square / (mean * mean);
        // Cells of several texels lose up to a hundredth of it, and directions are counted.
        assert!((light.unevenness() - expected).abs() < 0.01 * (expected - 1.0) + 2e-3);
    }

    #[test]
    fn light_samples_and_even_directions_see_the_same_irradiance() {
        for light in [sky(), smooth_sky()] {
            assert_even_and_drawn_directions_agree(&light);
        }
    }

    fn assert_even_and_drawn_directions_agree(light: &EnvironmentLight) {
        let (mut drawn, mut even) = (0.0_f64, 0.0_f64);
        let side = 512;
        for i in 0..side * side {
            let u = Vec2::new((i % side) as f32 + 0.5, (i / side) as f32 + 0.5) / side as f32;
            if let Some(sample) = light.sample(&wavelengths(), u) {
                drawn += f64::from(sample.radiance.0[6] / sample.pdf);
            }
            let z = 1.0 - 2.0 * u.y;
            let (sin, cos) = libm::sincosf(2.0 * PI * u.x);
            let radius = (1.0 - z * z).sqrt();
            let wi = Vec3::new(radius * cos, radius * sin, z);
            even += f64::from(light.towards(wi, &wavelengths()).0.0[6] * 4.0 * PI);
        }
        assert!((drawn / even - 1.0).abs() < 2e-3, "{drawn} against {even}");
    }
}
