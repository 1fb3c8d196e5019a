//! A sky as a light at infinity, clear or overcast, with the ground below its horizon.

use std::f32::consts::PI;
use std::f64::consts::{FRAC_PI_2, TAU};

use glam::{Vec2, Vec3};

use super::day::{Daylight, curve};
use super::forest::{self, Forest};
use super::sky_shape::{SkyShape, daylight_basis};
use super::spctrl2::Irradiance;
use crate::light::radiance_table::RadianceTable;
use crate::light::sample::{LightSample, unevenness};
use crate::sampling::distribution::Piecewise2d;
use crate::spectrum::{Curve, Lanes, Share, Table, WavelengthGrid, Wavelengths, cie};

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

/// Weights of three spectra of the sky, and of the ground's.
type Weights = [f32; 4];

/// Radiance of the upper half of directions, scaled at each wavelength so that a horizontal surface
/// gets the diffuse irradiance; below the horizon that of an even ground, which reflects its share
/// of sun and sky to all sides alike.
#[derive(Clone, Debug)]
pub struct SkyLight {
    /// Weights of the basis and of the ground, row by row from the zenith; columns run with the
    /// azimuth from +x towards +y.
    texels: Box<[Weights]>,
    /// Radiance of the sky where the weights are 1 0 0, 0 1 0 and 0 0 1.
    basis: [Curve; 3],
    ground: Curve,
    diffuse: Curve,
    /// The basis, then the ground.
    table: Option<Table>,
    distribution: Piecewise2d,
}

impl SkyLight {
    /// The clear sky of a day with these irradiances, by [`SkyShape`] and [`super::spctrl2`].
    pub(super) fn new(day: &Daylight, irradiance: &[Irradiance]) -> Self {
        let atmosphere = &day.atmosphere;
        let rows = daylight_basis();
        let luminance = std::array::from_fn(|i| {
            let seen = |row: &(f64, [f64; 3])| cie::observer(row.0)[1] * row.1[i];
            rows.iter().map(seen).sum()
        });
        let shape = SkyShape::new(atmosphere.turbidity, day.elevation, luminance);
        let towards_sun = day.towards_sun();
        let forest = day.forest.map(|azimuth| Forest {
            azimuth,
            sun: day.azimuth,
        });
        let texels: Box<[Weights]> = (0..HEIGHT * WIDTH)
            .map(|texel| {
                let uv = [(texel % WIDTH) as f32 + 0.5, (texel / WIDTH) as f32 + 0.5];
                let uv = [uv[0] / WIDTH as f32, 0.5 * uv[1] / HEIGHT as f32];
                let wi = direction(uv);
                let from_sun = wi.as_dvec3().angle_between(towards_sun);
                let sky = shape.weights(f64::from(wi.z), from_sun);
                let [share, brightness] = forest.map_or([0.0; 2], |forest| {
                    let [turns, down] = uv.map(f64::from);
                    forest.seen(turns * TAU, FRAC_PI_2 - down * std::f64::consts::PI)
                });
                let [a, b, c] = sky.map(|weight| ((1.0 - share) * weight) as f32);
                [a, b, c, (share * brightness) as f32]
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
            let reflected = match day.forest {
                Some(_) => forest::reflected(row.nm),
                None => atmosphere.ground_albedo,
            };
            reflected * (row.direct * up + row.diffuse) / std::f64::consts::PI
        });
        let at = basis.each_ref().map(|curve: &Curve| curve.at(SAMPLED_NM));
        Self {
            distribution: distribution(&texels, at, ground.at(SAMPLED_NM)),
            texels,
            basis,
            ground,
            diffuse,
            table: None,
        }
    }

    /// A sky that is covered with cloud, with its irradiance on a horizontal surface, W m⁻² nm⁻¹,
    /// and the share that the ground reflects.
    ///
    /// The radiance rises from the horizon to three times as much in the zenith,
    /// `L = L_z (1 + 2 cos θ) / 3`, with the irradiance `7 π L_z / 9`.
    ///
    /// # Source
    ///
    /// \[moon1942\]; the CIE's traditional overcast sky (ISO 15469, type 16).
    pub fn overcast(irradiance: &Curve, ground_albedo: f64) -> Self {
        use std::f64::consts::PI;
        let texels: Box<[Weights]> = (0..HEIGHT * WIDTH)
            .map(|texel| {
                let down = (texel / WIDTH) as f64 + 0.5;
                let cos = libm::cos(0.5 * PI * down / HEIGHT as f64);
                [(3.0 * (1.0 + 2.0 * cos) / (7.0 * PI)) as f32, 0.0, 0.0, 0.0]
            })
            .collect();
        let reflected = (ground_albedo / PI) as f32;
        Self {
            distribution: distribution(&texels, [1.0, 0.0, 0.0], reflected),
            texels,
            basis: [
                irradiance.clone(),
                Curve::Constant(0.0),
                Curve::Constant(0.0),
            ],
            ground: irradiance.clone().scaled(reflected),
            diffuse: irradiance.clone(),
            table: None,
        }
    }

    /// Its radiance as a table.
    pub fn tabulated(&self) -> RadianceTable<'_> {
        RadianceTable {
            size: [WIDTH, HEIGHT],
            weights: self.texels.to_vec(),
            spectra: self.basis.clone(),
            ground: Some(&self.ground),
            rotation: 0.0,
        }
    }

    /// Mean square of its radiance over all directions, relative to the square of the mean.
    pub fn unevenness(&self) -> f64 {
        unevenness(&self.distribution)
    }

    /// Irradiance on a horizontal surface from above, W m⁻² nm⁻¹.
    pub fn diffuse(&self) -> &Curve {
        &self.diffuse
    }

    /// Evaluates its spectra at every wavelength of a grid.
    pub fn tabulate(&mut self, grid: &WavelengthGrid) {
        self.table = Some(Table::by_place(grid, |row, lane| {
            self.spectra_at(&grid.share(row, lane))
        }));
    }

    fn spectra_at(&self, share: &Share) -> [f32; 4] {
        let [mean, first, second] = &self.basis;
        [mean, first, second, &self.ground].map(|curve| curve.over(share))
    }

    /// A radiance that it exceeds in no direction.
    pub fn at_most(&self, share: &Share) -> f32 {
        let spectra = self.spectra_at(share);
        let sky = self.texels.iter().map(|weights| {
            let parts = weights.iter().zip(spectra);
            parts.map(|(weight, spectrum)| weight * spectrum).sum()
        });
        // Between texels it is linear.
        sky.fold(spectra[3], f32::max)
    }

    fn radiance<const N: usize>(&self, uv: [f32; 2], wavelengths: &Wavelengths<N>) -> Lanes<N> {
        let table = self.table.as_ref().and_then(|table| table.row(wavelengths));
        let [mean, first, second, ground] = table.unwrap_or_else(|| {
            let values = wavelengths.nm.map(|nm| self.spectra_at(&Share::only(nm)));
            std::array::from_fn(|i| Lanes::from_fn(|lane| values[lane][i]))
        });
        if uv[1] >= 0.5 {
            return ground;
        }
        let weights = weights(&self.texels, uv);
        let sum = mean * weights[0] + first * weights[1] + second * weights[2];
        // Between the rows of the basis rounding may pass zero.
        Lanes(sum.0.map(|radiance| radiance.max(0.0))) + ground * weights[3]
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

    /// Radiance along `wi`.
    pub fn seen_towards<const N: usize>(&self, wi: Vec3, wavelengths: &Wavelengths<N>) -> Lanes<N> {
        let (uv, _) = place_of(wi);
        self.radiance(uv, wavelengths)
    }

    /// Radiance and density along `wi`.
    pub fn towards<const N: usize>(
        &self,
        wi: Vec3,
        wavelengths: &Wavelengths<N>,
    ) -> (Lanes<N>, f32) {
        let (uv, sin_theta) = place_of(wi);
        let pdf = if sin_theta > 0.0 {
            self.distribution.density(uv) / (2.0 * PI * PI * sin_theta)
        } else {
            0.0
        };
        (self.radiance(uv, wavelengths), pdf)
    }
}

/// The point of the table in a unit direction, and the sine of its angle from the zenith.
fn place_of(wi: Vec3) -> ([f32; 2], f32) {
    let turns = libm::atan2f(wi.y, wi.x) / (2.0 * PI);
    let sin_theta = (wi.x * wi.x + wi.y * wi.y).sqrt();
    // acos is inaccurate near the poles; atan2 is not.
    let down = libm::atan2f(sin_theta, wi.z) / PI;
    let uv = [turns - turns.floor(), down.min(1.0 - f32::EPSILON)];
    (uv, sin_theta)
}

/// Unit direction of a point of the table.
fn direction([u, v]: [f32; 2]) -> Vec3 {
    let (sin_theta, cos_theta) = libm::sincosf(PI * v);
    let (sin_phi, cos_phi) = libm::sincosf(2.0 * PI * u);
    Vec3::new(sin_theta * cos_phi, sin_theta * sin_phi, cos_theta)
}

/// Weights above the horizon, linear between texels.
fn weights(texels: &[Weights], uv: [f32; 2]) -> Weights {
    let x = uv[0] * WIDTH as f32 + (WIDTH as f32 - 0.5);
    let y = (2.0 * uv[1] * HEIGHT as f32 - 0.5).clamp(0.0, (HEIGHT - 1) as f32);
    let (x0, y0) = (x as usize, y as usize);
    let (share_x, share_y) = (x - x0 as f32, y - y0 as f32);
    let mut sums = [0.0; 4];
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

/// Radiance times solid angle of squares of texels, over the whole sphere; `basis` and `ground` are
/// those at some wavelength.
fn distribution(texels: &[Weights], basis: [f32; 3], ground: f32) -> Piecewise2d {
    let (across, down) = (WIDTH / SAMPLED, 2 * HEIGHT / SAMPLED);
    let mut cells = vec![0.0; across * down];
    for y in 0..2 * HEIGHT {
        let sin = libm::sinf(PI * (y as f32 + 0.5) / (2 * HEIGHT) as f32);
        for x in 0..WIDTH {
            let radiance = if y < HEIGHT {
                let weights = texels[y * WIDTH + x];
                let sky = (0..3).map(|i| weights[i] * basis[i]).sum::<f32>();
                sky.max(0.0) + weights[3] * ground
            } else {
                ground
            };
            cells[y / SAMPLED * across + x / SAMPLED] += sin * radiance;
        }
    }
    Piecewise2d::new(&cells, across)
}
