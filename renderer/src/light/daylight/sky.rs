//! A clear sky as a light at infinity, with the ground below its horizon.

use std::f32::consts::PI;

use glam::{Vec2, Vec3};

use super::sky_shape::{SkyShape, daylight_basis};
use super::spctrl2::Irradiance;
use super::{Daylight, curve};
use crate::light::LightSample;
use crate::sampling::distribution::Piecewise2d;
use crate::spectrum::{Curve, Lanes, Table, WavelengthGrid, Wavelengths, cie};

/// Columns of the sky's table, around the horizon.
const WIDTH: usize = 128;
/// Its rows, from the zenith to the horizon; as many lie below for the ground.
const HEIGHT: usize = 64;
/// Cells of the table are sampled in squares of this side.
const SAMPLED: usize = 2;
/// Wavelength by whose radiance directions are sampled, nm.
const SAMPLED_NM: f32 = 560.0;
/// Wavelengths at which the sky's shape is known, nm: it is held at the ends.
const SHAPED_NM: [f64; 2] = [360.0, 830.0];

/// Radiance of the upper half of directions by [`SkyShape`], scaled at each wavelength so that a
/// horizontal surface gets the diffuse irradiance of [`super::spctrl2`]; below the horizon that of
/// an even ground, which reflects its share of sun and sky to all sides alike.
#[derive(Clone, Debug)]
pub struct SkyLight {
    /// Weights of the basis, row by row from the zenith; columns run with the azimuth from +x
    /// towards +y.
    texels: Box<[[f32; 3]]>,
    /// Radiance of the sky where the weights are 1 0 0, 0 1 0 and 0 0 1.
    basis: [Curve; 3],
    ground: Curve,
    diffuse: Curve,
    /// The basis, then the ground.
    table: Option<Table>,
    distribution: Piecewise2d,
}

impl SkyLight {
    /// The sky of a day with these irradiances.
    pub(super) fn new(day: &Daylight, irradiance: &[Irradiance]) -> Self {
        let atmosphere = &day.atmosphere;
        let rows = daylight_basis();
        let luminance = std::array::from_fn(|i| {
            let seen = |row: &(f64, [f64; 3])| cie::observer(row.0)[1] * row.1[i];
            rows.iter().map(seen).sum()
        });
        let shape = SkyShape::new(atmosphere.turbidity, day.elevation, luminance);
        let towards_sun = day.towards_sun().as_dvec3();
        let texels: Box<[[f32; 3]]> = (0..HEIGHT * WIDTH)
            .map(|texel| {
                let uv = [(texel % WIDTH) as f32 + 0.5, (texel / WIDTH) as f32 + 0.5];
                let wi = direction([uv[0] / WIDTH as f32, 0.5 * uv[1] / HEIGHT as f32]);
                let from_sun = wi.as_dvec3().angle_between(towards_sun);
                shape
                    .weights(f64::from(wi.z), from_sun)
                    .map(|weight| weight as f32)
            })
            .collect();
        let on_horizontal = shape.on_horizontal(day.elevation);
        let shaped: [Curve; 3] = std::array::from_fn(|i| {
            let points: Vec<_> = rows.iter().map(|row| (row.0, row.1[i])).collect();
            Curve::from_points(&points)
        });
        let basis_at = |nm: f64| {
            let nm = nm.clamp(SHAPED_NM[0], SHAPED_NM[1]) as f32;
            [0, 1, 2].map(|i| f64::from(shaped[i].at(nm)))
        };
        // A finer step than the irradiance's, since the basis has kinks of its own.
        let mut nm: Vec<f64> = irradiance.iter().map(|row| row.nm).collect();
        nm.extend(rows.iter().map(|row| row.0));
        nm.sort_by(f64::total_cmp);
        nm.dedup();
        let diffuse = curve(irradiance, |row| row.diffuse);
        let basis = std::array::from_fn(|i| {
            let points: Vec<_> = nm
                .iter()
                .map(|&nm| {
                    let at = basis_at(nm);
                    let unscaled: f64 = (0..3).map(|i| at[i] * on_horizontal[i]).sum();
                    (nm, at[i] * f64::from(diffuse.at(nm as f32)) / unscaled)
                })
                .collect();
            Curve::from_points(&points)
        });
        let up = libm::sin(day.elevation);
        let ground = curve(irradiance, |row| {
            atmosphere.ground_albedo * (row.direct * up + row.diffuse) / std::f64::consts::PI
        });
        Self {
            distribution: distribution(&texels, &basis, &ground),
            texels,
            basis,
            ground,
            diffuse,
            table: None,
        }
    }

    /// Irradiance on a horizontal surface from above, W m⁻² nm⁻¹.
    pub fn diffuse(&self) -> &Curve {
        &self.diffuse
    }

    /// Evaluates its spectra at every wavelength of a grid.
    pub fn tabulate(&mut self, grid: &WavelengthGrid) {
        self.table = Some(Table::new(grid, |nm| self.spectra_at(nm)));
    }

    fn spectra_at(&self, nm: f32) -> [f32; 4] {
        let [mean, first, second] = &self.basis;
        [mean, first, second, &self.ground].map(|curve| curve.at(nm))
    }

    fn radiance<const N: usize>(&self, uv: [f32; 2], wavelengths: &Wavelengths<N>) -> Lanes<N> {
        let table = self.table.as_ref().and_then(|table| table.row(wavelengths));
        let [mean, first, second, ground] = table.unwrap_or_else(|| {
            let values = wavelengths.nm.map(|nm| self.spectra_at(nm));
            std::array::from_fn(|i| Lanes::from_fn(|lane| values[lane][i]))
        });
        if uv[1] >= 0.5 {
            return ground;
        }
        let weights = weights(&self.texels, uv);
        let sum = mean * weights[0] + first * weights[1] + second * weights[2];
        // Between the rows of the basis rounding may pass zero.
        Lanes(sum.0.map(|radiance| radiance.max(0.0)))
    }

    /// Samples a direction with a density roughly proportional to its radiance.
    pub fn sample<const N: usize>(
        &self,
        wavelengths: &Wavelengths<N>,
        u: Vec2,
    ) -> Option<LightSample<N>> {
        let (uv, density) = self.distribution.sample([u.x, u.y]);
        let sin_theta = libm::sinf(PI * uv[1]);
        (sin_theta > 0.0 && density > 0.0).then(|| LightSample {
            wi: direction(uv),
            point: None,
            radiance: self.radiance(uv, wavelengths),
            pdf: density / (2.0 * PI * PI * sin_theta),
            is_point: false,
        })
    }

    /// Radiance and density along `wi`.
    pub fn towards<const N: usize>(
        &self,
        wi: Vec3,
        wavelengths: &Wavelengths<N>,
    ) -> (Lanes<N>, f32) {
        let turns = libm::atan2f(wi.y, wi.x) / (2.0 * PI);
        let sin_theta = (wi.x * wi.x + wi.y * wi.y).sqrt();
        // acos is inaccurate near the poles; atan2 is not.
        let down = libm::atan2f(sin_theta, wi.z) / PI;
        let uv = [turns - turns.floor(), down.min(1.0 - f32::EPSILON)];
        let pdf = if sin_theta > 0.0 {
            self.distribution.density(uv) / (2.0 * PI * PI * sin_theta)
        } else {
            0.0
        };
        (self.radiance(uv, wavelengths), pdf)
    }
}

/// Unit direction of a point of the table.
fn direction([u, v]: [f32; 2]) -> Vec3 {
    let (sin_theta, cos_theta) = libm::sincosf(PI * v);
    let (sin_phi, cos_phi) = libm::sincosf(2.0 * PI * u);
    Vec3::new(sin_theta * cos_phi, sin_theta * sin_phi, cos_theta)
}

/// Weights of the basis above the horizon, linear between texels.
fn weights(texels: &[[f32; 3]], uv: [f32; 2]) -> [f32; 3] {
    let x = uv[0] * WIDTH as f32 + (WIDTH as f32 - 0.5);
    let y = (2.0 * uv[1] * HEIGHT as f32 - 0.5).clamp(0.0, (HEIGHT - 1) as f32);
    let (x0, y0) = (x as usize, y as usize);
    let (share_x, share_y) = (x - x0 as f32, y - y0 as f32);
    let mut sums = [0.0; 3];
    for (row, weight_y) in [(y0, 1.0 - share_y), ((y0 + 1).min(HEIGHT - 1), share_y)] {
        for (column, weight_x) in [(x0, 1.0 - share_x), (x0 + 1, share_x)] {
            let texel = texels[row * WIDTH + column % WIDTH];
            for (sum, value) in sums.iter_mut().zip(texel) {
                *sum += weight_x * weight_y * value;
            }
        }
    }
    sums
}

/// Radiance times solid angle of squares of texels, over the whole sphere.
fn distribution(texels: &[[f32; 3]], basis: &[Curve; 3], ground: &Curve) -> Piecewise2d {
    let at = basis.each_ref().map(|curve| curve.at(SAMPLED_NM));
    let (across, down) = (WIDTH / SAMPLED, 2 * HEIGHT / SAMPLED);
    let mut cells = vec![0.0; across * down];
    for y in 0..2 * HEIGHT {
        let sin = libm::sinf(PI * (y as f32 + 0.5) / (2 * HEIGHT) as f32);
        for x in 0..WIDTH {
            let radiance = if y < HEIGHT {
                let weights = texels[y * WIDTH + x];
                (0..3).map(|i| weights[i] * at[i]).sum::<f32>().max(0.0)
            } else {
                ground.at(SAMPLED_NM)
            };
            cells[y / SAMPLED * across + x / SAMPLED] += sin * radiance;
        }
    }
    Piecewise2d::new(&cells, across)
}
