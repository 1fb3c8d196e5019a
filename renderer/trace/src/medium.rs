//! Media that absorb and scatter light on its way through bodies.
//!
//! - **In**: absorption and scattering coefficients by wavelength, m⁻¹, a [`Phase`] function, the
//!   throughput of a path at its wavelengths.
//! - **Out**: how far light goes before it is scattered, and the throughput of every wavelength
//!   there or where the way ends before.
//! - **Always true**: a medium is the same everywhere in its body; the mean of what is left over
//!   all flights is what the law of Beer and Lambert leaves and what is scattered.
//! - **Left out**: media that glow, and coefficients that vary within a body.
//!
//! Only scattering ends a flight. Absorption weakens light along the whole way, by the same factor
//! however it was sampled, so that a clear medium needs no random numbers at all.
//!
//! ```
//! use glam::Vec3;
//! use trace::medium::{Medium, Phase};
//! use trace::spectrum::{Curve, Lanes, Wavelengths};
//!
//! // A filter that absorbs 2 per metre of red light, and nothing of blue.
//! let absorption = Curve::from_points(&[(590.0, 0.0), (610.0, 2.0)]);
//! let filter = Medium::new(absorption, Curve::Constant(0.0), Phase::HenyeyGreenstein { g: 0.0 });
//! let at = filter.at(Vec3::X, &Wavelengths::new([450.0, 550.0, 650.0, 750.0]));
//! assert_eq!(at.reach(&Lanes::ONE, [0.5, 0.5]), f32::INFINITY);
//! let [blue, .., red] = at.passed(&Lanes::ONE, 0.5).0;
//! assert!(blue == 1.0 && (red - (-1.0_f32).exp()).abs() < 1e-6);
//! ```

mod coefficients;
mod foliage;
mod inside;
mod phase;

use glam::{Vec2, Vec3};

use self::foliage::Foliage;
use crate::geometry::scatter::Inclination;
use crate::spectrum::{Curve, Lanes, Spectrum, WavelengthGrid, Wavelengths};

pub use self::coefficients::Coefficients;
pub use self::inside::{Body, BodyPlace, Inside};
pub use self::phase::{Phase, Scattering};

/// A homogeneous medium.
#[derive(Clone, Debug)]
pub struct Medium {
    fill: Fill,
}

/// What it consists of.
#[derive(Clone, Debug)]
enum Fill {
    /// Particles.
    Particles {
        absorption: Spectrum,
        scattering: Spectrum,
        phase: Phase,
    },
    /// Leaves without extent.
    Leaves {
        /// Area of one side in each volume, m⁻¹.
        area: f32,
        foliage: Foliage,
        reflectance: Spectrum,
        transmittance: Spectrum,
    },
}

/// The media of a scene.
#[derive(Clone, Debug, Default)]
pub struct Media {
    /// The media.
    pub media: Vec<Medium>,
    /// Whether there are bodies whose boundary lets light pass straight or that a medium fills. If
    /// not, rays need not be told where they are.
    pub are_present: bool,
    /// The bodies in which the camera stands.
    pub around_camera: Inside,
}

impl Medium {
    /// A medium with these coefficients, m⁻¹, ≥ 0.
    pub fn new(absorption: Curve, scattering: Curve, phase: Phase) -> Self {
        Self {
            fill: Fill::Particles {
                absorption: absorption.into(),
                scattering: scattering.into(),
                phase,
            },
        }
    }

    /// Foliage: `area` of leaves in each volume, m⁻¹, inclined from the scene's +z, whose faces are Lambertian. The leaves have
    /// no extent, so light that is scattered back finds no way that it came by.
    ///
    /// # Source
    ///
    /// \[ross1981\] for what they turn to light.
    pub fn of_leaves(
        area: f32,
        inclination: &Inclination,
        [reflectance, transmittance]: [Curve; 2],
    ) -> Self {
        Self {
            fill: Fill::Leaves {
                area,
                foliage: Foliage::new(inclination),
                reflectance: reflectance.into(),
                transmittance: transmittance.into(),
            },
        }
    }

    /// Evaluates its spectra at every wavelength of a grid.
    pub fn tabulate(&mut self, grid: &WavelengthGrid) {
        let spectra = match &mut self.fill {
            Fill::Particles {
                absorption,
                scattering,
                ..
            } => [absorption, scattering],
            Fill::Leaves {
                reflectance,
                transmittance,
                ..
            } => [reflectance, transmittance],
        };
        for spectrum in spectra {
            spectrum.tabulate(grid);
        }
    }

    /// Its coefficients at a path's wavelengths, for light that goes `way`, of any length.
    pub fn at<const N: usize>(&self, way: Vec3, wavelengths: &Wavelengths<N>) -> Coefficients<N> {
        match &self.fill {
            Fill::Particles {
                absorption,
                scattering,
                phase,
            } => Coefficients {
                absorption: absorption.lanes(wavelengths),
                scattering: scattering.lanes(wavelengths),
                phase: *phase,
                through: Lanes::ZERO,
            },
            Fill::Leaves {
                area,
                foliage,
                reflectance,
                transmittance,
            } => {
                let turned = area * foliage.turned(way);
                let [back, forth] = [reflectance, transmittance].map(|s| s.lanes(wavelengths));
                let scattered = back + forth;
                let through = Lanes::from_fn(|lane| {
                    if scattered.0[lane] > 0.0 {
                        forth.0[lane] / scattered.0[lane]
                    } else {
                        0.0
                    }
                });
                Coefficients {
                    absorption: Lanes::from_fn(|lane| turned * (1.0 - scattered.0[lane]).max(0.0)),
                    scattering: scattered * turned,
                    phase: Phase::Leaf {
                        normal: way,
                        through: through.sum() / N as f32,
                    },
                    through,
                }
            }
        }
    }

    /// The coefficients where light that goes `way` is scattered: of foliage the leaf that it meets is drawn by numbers in
    /// [0, 1).
    pub fn met<const N: usize>(
        &self,
        way: Vec3,
        u: Vec2,
        mut at: Coefficients<N>,
    ) -> Coefficients<N> {
        if let (Fill::Leaves { foliage, .. }, Phase::Leaf { normal, .. }) =
            (&self.fill, &mut at.phase)
        {
            *normal = foliage.normal(way, u);
        }
        at
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::stream::Stream;

    fn medium() -> Coefficients<4> {
        Coefficients {
            absorption: Lanes([0.0, 0.5, 3.0, 1.0]),
            scattering: Lanes([2.0, 2.0, 0.3, 0.0]),
            phase: Phase::HenyeyGreenstein { g: 0.0 },
            through: Lanes::ZERO,
        }
    }

    #[test]
    fn flights_leave_of_every_wavelength_what_beer_and_lambert_do() {
        // Whatever the throughput was, the mean of what passes is exp(−(a + s) L), and of what is
        // scattered s / (a + s) of the rest.
        let (at, length, count) = (medium(), 0.7, 1 << 16);
        for before in [Lanes::ONE, Lanes([0.1, 2.0, 0.5, 1.0])] {
            let (mut passed, mut scattered) = ([0.0; 4], [0.0; 4]);
            for i in 0..count {
                let [u, v, ..] = Stream::new(3, 0, 0, i).next4();
                let reach = at.reach(&before, [u, v]);
                let (sums, factor) = if reach < length {
                    (&mut scattered, at.scattered(&before, reach))
                } else {
                    (&mut passed, at.passed(&before, length))
                };
                for (sum, factor) in sums.iter_mut().zip(factor.0) {
                    *sum += f64::from(factor) / f64::from(count);
                }
            }
            for lane in 0..4 {
                let (a, s) = (at.absorption.0[lane], at.scattering.0[lane]);
                let left = libm::exp(f64::from(-(a + s) * length));
                let expected = f64::from(s / (a + s)) * (1.0 - left);
                // Sobol points: far below 1/√count = 4e-3.
                assert!((passed[lane] - left).abs() < 4e-4, "{lane}: {passed:?}");
                assert!(
                    (scattered[lane] - expected).abs() < 4e-4,
                    "{lane}: {scattered:?}"
                );
            }
        }
    }

    #[test]
    fn wavelengths_that_are_scattered_alike_have_one_weight_and_absorption_no_noise() {
        let at = Coefficients {
            scattering: Lanes::splat(2.0),
            ..medium()
        };
        for length in [0.1_f32, 1.0, 30.0] {
            let passed = at.passed(&Lanes::ONE, length);
            let scattered = at.scattered(&Lanes::ONE, length);
            for lane in 0..4 {
                let expected = (-at.absorption.0[lane] * length).exp();
                assert!((passed.0[lane] - expected).abs() < 1e-6);
                assert!((scattered.0[lane] - expected).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn deep_media_give_numbers() {
        let at = Coefficients {
            scattering: Lanes([1e6, 1e6, 1e5, 1e6]),
            ..medium()
        };
        let one_lane = Lanes([0.0, 0.0, 0.0, 1.0]);
        for throughput in [Lanes::ONE, one_lane] {
            for length in [1e-9, 1.0, f32::INFINITY] {
                let passed = at.passed(&throughput, length) * throughput;
                assert!(
                    passed.0.iter().all(|factor| factor.is_finite()),
                    "{passed:?}"
                );
            }
            let reach = at.reach(&throughput, [0.999_999, 0.999_999_94]);
            let scattered = at.scattered(&throughput, reach) * throughput;
            assert!(
                scattered.0.iter().all(|factor| factor.is_finite()),
                "{scattered:?}"
            );
        }
    }
}
