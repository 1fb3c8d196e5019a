//! How a clear sky's light is spread over its directions.
//!
//! Luminance and chromaticity by direction are those of \[preetham1999\]; the chromaticity stands
//! for a mixture of the CIE's daylights. A direction is thus three weights, of the mean daylight
//! and its two components.

use std::f64::consts::PI;

use crate::spectrum::table::parse_shipped;

/// Mean and first two components of the CIE's daylight, rows over wavelength in nm.
pub fn daylight_basis() -> Vec<(f64, [f64; 3])> {
    parse_shipped::<3>(include_str!("cie_daylight.csv"))
}

/// Perez' five coefficients.
type Perez = [f64; 5];

/// The distribution for one turbidity and place of the sun.
#[derive(Clone, Debug)]
pub struct SkyShape {
    /// Of luminance, x and y.
    perez: [Perez; 3],
    /// Values in the zenith over Perez' function there; luminance up to a factor.
    scale: [f64; 3],
    /// Luminance of the basis.
    luminance: [f64; 3],
    /// The basis at the wavelengths of films.
    visible: Vec<[f64; 3]>,
}

/// Sine of the elevation under which the sky is that of this elevation: the model's fit has no
/// lower directions.
const LOWEST: f64 = 0.01;

/// Most of the mean daylight that its components may take away at any wavelength.
const MOST_TAKEN: f64 = 0.95;
/// First wavelength at which a sky must have light, nm.
const FIRST_NM: f64 = 360.0;

impl SkyShape {
    /// The sky of a turbidity from 2 to 10, with the sun at an elevation, rad; `luminance` is that
    /// of each of [`daylight_basis`].
    pub fn new(turbidity: f64, elevation: f64, luminance: [f64; 3]) -> Self {
        let t = turbidity;
        let linear = |rows: [[f64; 2]; 5]| rows.map(|[slope, start]| slope * t + start);
        let perez = [
            linear([
                [0.1787, -1.4630],
                [-0.3554, 0.4275],
                [-0.0227, 5.3251],
                [0.1206, -2.5771],
                [-0.0670, 0.3703],
            ]),
            linear([
                [-0.0193, -0.2592],
                [-0.0665, 0.0008],
                [-0.0004, 0.2125],
                [-0.0641, -0.8989],
                [-0.0033, 0.0452],
            ]),
            linear([
                [-0.0167, -0.2608],
                [-0.0950, 0.0092],
                [-0.0079, 0.2102],
                [-0.0441, -1.6537],
                [-0.0109, 0.0529],
            ]),
        ];
        let s = 0.5 * PI - elevation;
        let cubic = |rows: [[f64; 4]; 3]| {
            let in_angle = rows.map(|[a, b, c, d]| ((a * s + b) * s + c) * s + d);
            (in_angle[0] * t + in_angle[1]) * t + in_angle[2]
        };
        let zenith = [
            1.0,
            cubic([
                [0.00166, -0.00375, 0.00209, 0.0],
                [-0.02903, 0.06377, -0.03202, 0.00394],
                [0.11693, -0.21196, 0.06052, 0.25886],
            ]),
            cubic([
                [0.00275, -0.00610, 0.00317, 0.0],
                [-0.04214, 0.08970, -0.04153, 0.00516],
                [0.15346, -0.26756, 0.06670, 0.26688],
            ]),
        ];
        let scale = std::array::from_fn(|i| zenith[i] / value(&perez[i], 1.0, s));
        let rows = daylight_basis().into_iter();
        let visible = rows.filter(|row| row.0 >= FIRST_NM).map(|row| row.1);
        Self {
            perez,
            scale,
            luminance,
            visible: visible.collect(),
        }
    }

    /// Weights of the basis in a direction: `sin_elevation` above the horizon, and the angle from
    /// the sun, rad.
    pub fn weights(&self, sin_elevation: f64, from_sun: f64) -> [f64; 3] {
        let up = sin_elevation.max(LOWEST);
        let [luminance, x, y] =
            std::array::from_fn(|i| self.scale[i] * value(&self.perez[i], up, from_sun));
        // CIE 015: the daylight of a chromaticity.
        let below = 0.0241 + 0.2562 * x - 0.7341 * y;
        let first = (-1.3515 - 1.7703 * x + 5.9114 * y) / below;
        let second = (0.0300 - 31.4424 * x + 30.0717 * y) / below;
        // Beyond what daylight was measured for, as around a low sun, the mixture would be negative
        // in the violet: there it is moved towards the mean daylight.
        let held = self
            .visible
            .iter()
            .fold(1.0_f64, |held, [mean, by_first, by_second]| {
                let less = -(first * by_first + second * by_second);
                if less * held > MOST_TAKEN * mean {
                    MOST_TAKEN * mean / less
                } else {
                    held
                }
            });
        let mixture = [1.0, held * first, held * second];
        let of_mixture: f64 = (0..3).map(|i| mixture[i] * self.luminance[i]).sum();
        mixture.map(|weight| weight * luminance.max(0.0) / of_mixture)
    }

    /// Integral of the weights times the sine of the elevation over the upper half of directions:
    /// what a horizontal surface gets.
    pub(crate) fn on_horizontal(&self, elevation: f64) -> [f64; 3] {
        // Midpoints in the square of the sine and in the azimuth from the sun, by symmetry of half
        // a turn.
        const ROWS: usize = 256;
        const COLUMNS: usize = 256;
        let (sin_sun, cos_sun) = libm::sincos(elevation);
        let mut sums = [0.0; 3];
        for row in 0..ROWS {
            let up = ((row as f64 + 0.5) / ROWS as f64).sqrt();
            let along = (1.0 - up * up).sqrt();
            for column in 0..COLUMNS {
                let turn = PI * (column as f64 + 0.5) / COLUMNS as f64;
                let cos = up * sin_sun + along * cos_sun * libm::cos(turn);
                let weights = self.weights(up, libm::acos(cos.clamp(-1.0, 1.0)));
                for (sum, weight) in sums.iter_mut().zip(weights) {
                    *sum += weight;
                }
            }
        }
        sums.map(|sum| sum * PI / (ROWS * COLUMNS) as f64)
    }
}

/// Perez' function of the sine of the elevation and the angle from the sun.
fn value(&[a, b, c, d, e]: &Perez, up: f64, from_sun: f64) -> f64 {
    let cos = libm::cos(from_sun);
    (1.0 + a * libm::exp(b / up)) * (1.0 + c * libm::exp(d * from_sun) + e * cos * cos)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Luminance of the basis by the CIE 1931 observer, near enough for these tests.
    const LUMINANCE: [f64; 3] = [1.0, 0.0, 0.0];

    #[test]
    fn the_sky_is_bright_and_blue_where_it_is() {
        for turbidity in [2.0, 3.0, 6.0, 10.0] {
            for degrees in [1.0_f64, 10.0, 40.0, 70.0, 90.0] {
                let shape = SkyShape::new(turbidity, degrees.to_radians(), LUMINANCE);
                let basis = daylight_basis();
                for up in [0.0, 0.05, 0.2, 0.5, 0.8, 1.0] {
                    for angle in [0.0, 0.1, 0.5, 1.0, 2.0, 3.1] {
                        let weights = shape.weights(up, angle);
                        assert!(weights[0] > 0.0 && weights.iter().all(|w| w.is_finite()));
                        for (nm, row) in basis.iter().filter(|row| row.0 >= FIRST_NM) {
                            let sum: f64 = (0..3).map(|i| weights[i] * row[i]).sum();
                            assert!(
                                sum > 0.0,
                                "{turbidity} {degrees} up {up} angle {angle} at {nm}: {weights:?}"
                            );
                        }
                    }
                }
            }
        }
        // The zenith of a clear noon is bluer than the horizon; both from the paper's equations.
        let shape = SkyShape::new(2.5, 1.0, LUMINANCE);
        let ratio = |weights: [f64; 3]| {
            let at = |nm: f64| {
                let basis = daylight_basis();
                let row = basis
                    .iter()
                    .find(|row| row.0 == nm)
                    .expect("it is in the table");
                (0..3).map(|i| weights[i] * row.1[i]).sum::<f64>()
            };
            at(450.0) / at(600.0)
        };
        let (zenith, horizon) = (shape.weights(1.0, 0.5708), shape.weights(0.02, 1.6));
        assert!(
            ratio(zenith) > 1.2 * ratio(horizon),
            "{} {}",
            ratio(zenith),
            ratio(horizon)
        );
    }

    #[test]
    fn the_integral_does_not_depend_on_its_steps() {
        let elevation = 0.7_f64;
        let shape = SkyShape::new(3.0, elevation, LUMINANCE);
        let found = shape.on_horizontal(elevation);
        // Another grid: polar angle and azimuth all around.
        let (sin_sun, cos_sun) = libm::sincos(elevation);
        let mut sums = [0.0; 3];
        let (rows, columns) = (400, 300);
        for row in 0..rows {
            let polar = 0.5 * PI * (f64::from(row) + 0.5) / f64::from(rows);
            for column in 0..columns {
                let turn = 2.0 * PI * (f64::from(column) + 0.3) / f64::from(columns);
                let (sin, cos) = libm::sincos(polar);
                let angle = libm::acos((cos * sin_sun + sin * cos_sun * libm::cos(turn)).min(1.0));
                for (sum, weight) in sums.iter_mut().zip(shape.weights(cos, angle)) {
                    *sum += weight * cos * sin * PI * PI / f64::from(rows * columns);
                }
            }
        }
        for (one, other) in found.into_iter().zip(sums) {
            assert!(
                (one - other).abs() < 2e-3 * other.abs(),
                "{found:?} {sums:?}"
            );
        }
    }
}
