//! Leaves afloat in a box, without regard to each other: what theory calls a turbid medium, with
//! leaves of finite size.

use glam::{DAffine3, DMat3, DVec3};
use std::f64::consts::{FRAC_2_PI, FRAC_PI_2, TAU};
use thiserror::Error;

use super::{MOST_THINGS, Strewn, from_z};
use crate::geometry::scramble::scramble;

/// How many leaves float in a box, and how they are inclined.
#[derive(Clone, Debug, PartialEq)]
pub struct Volume {
    /// Least and greatest coordinates of the leaves' origins, m.
    pub within: [DVec3; 2],
    /// Leaf area over the area of the box's ground plan, > 0. Of a closed or thick leaf the whole
    /// surface counts.
    pub lai: f64,
    /// The distribution of inclinations.
    pub inclination: Inclination,
    /// Same volume and seed, same places.
    pub seed: u64,
}

/// Distributions of the angle θ between leaf normals and the vertical, from 0 to π/2. Azimuths are
/// even.
///
/// # Source
///
/// \[dewit1965\], in the trigonometric forms of \[bunnik1978\]; the density g is over θ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Inclination {
    /// As the surface of a sphere: g = sin θ.
    Spherical,
    /// All angles alike: g = 2/π.
    Uniform,
    /// Mostly level: g = 2/π (1 + cos 2θ).
    Planophile,
    /// Mostly upright: g = 2/π (1 − cos 2θ).
    Erectophile,
    /// Mostly at 45°: g = 2/π (1 − cos 4θ).
    Plagiophile,
    /// Level or upright: g = 2/π (1 + cos 4θ).
    Extremophile,
}

/// Why a volume cannot be filled.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum VolumeError {
    /// More than there may be.
    #[error("`lai`: this takes {wanted} leaves, more than the {most} that there may be")]
    TooMany {
        /// How many it takes.
        wanted: f64,
        /// How many there may be.
        most: usize,
    },
    /// Less than one leaf.
    #[error(
        "`lai`: this takes {wanted:.3} leaves: the box is too small for one, whose area is {area} m²"
    )]
    None {
        /// How many it takes.
        wanted: f64,
        /// Mean area of a leaf, m².
        area: f64,
    },
}

impl Inclination {
    /// The angle below which a share `u` in [0, 1] of the leaves is inclined, rad.
    pub fn angle(self, u: f64) -> f64 {
        let share = |theta: f64| {
            let (double, fourfold) = (libm::sin(2.0 * theta) / 2.0, libm::sin(4.0 * theta) / 4.0);
            match self {
                Self::Spherical => 1.0 - libm::cos(theta),
                Self::Uniform => FRAC_2_PI * theta,
                Self::Planophile => FRAC_2_PI * (theta + double),
                Self::Erectophile => FRAC_2_PI * (theta - double),
                Self::Plagiophile => FRAC_2_PI * (theta - fourfold),
                Self::Extremophile => FRAC_2_PI * (theta + fourfold),
            }
        };
        let (mut low, mut high) = (0.0, FRAC_PI_2);
        // Each share rises from 0 to 1; 44 halvings leave 1e-13.
        for _ in 0..44 {
            let middle = 0.5 * (low + high);
            if share(middle) < u {
                low = middle;
            } else {
                high = middle;
            }
        }
        0.5 * (low + high)
    }
}

/// What a random number of a leaf is for.
#[derive(Clone, Copy, Debug)]
enum Use {
    X,
    Y,
    Z,
    // Numbers that are kept keep the places of leaves.
    Inclination = 4,
    Azimuth,
    Turn,
}

impl Volume {
    /// Places for leaves with these areas, m², which take turns, so that their numbers differ by 1
    /// at most: as many leaves as bring their mean area nearest to the leaf area index.
    ///
    /// # Errors
    ///
    /// [`VolumeError`] if that is no leaf, or too many.
    ///
    /// # Panics
    ///
    /// If there is no area.
    pub fn places(&self, areas: &[f64]) -> Result<Vec<Strewn>, VolumeError> {
        assert!(!areas.is_empty(), "something floats");
        let area = areas.iter().sum::<f64>() / areas.len() as f64;
        let [least, most] = self.within;
        let size = most - least;
        let wanted = self.lai * size.x * size.y / area;
        if wanted.round() < 1.0 {
            return Err(VolumeError::None { wanted, area });
        }
        if wanted > MOST_THINGS as f64 {
            return Err(VolumeError::TooMany {
                wanted: wanted.round(),
                most: MOST_THINGS,
            });
        }
        let place = |number: u64| {
            let random = |what: Use| self.random(number, what);
            let at = least + size * DVec3::new(random(Use::X), random(Use::Y), random(Use::Z));
            let (sin, cos) = libm::sincos(self.inclination.angle(random(Use::Inclination)));
            let (east, north) = libm::sincos(TAU * random(Use::Azimuth));
            let normal = DVec3::new(sin * east, sin * north, cos);
            let (sin, cos) = libm::sincos(TAU * random(Use::Turn));
            let turned = DMat3::from_cols(
                DVec3::new(cos, sin, 0.0),
                DVec3::new(-sin, cos, 0.0),
                DVec3::Z,
            );
            Strewn {
                body: (number % areas.len() as u64) as u32,
                to_world: DAffine3::from_mat3_translation(from_z(normal) * turned, at),
            }
        };
        Ok((0..wanted.round() as u64).map(place).collect())
    }

    /// A number in [0, 1) for each use of each leaf.
    fn random(&self, number: u64, what: Use) -> f64 {
        let bits = scramble(scramble(self.seed ^ scramble(number)) ^ what as u64);
        (bits >> 11) as f64 / (1_u64 << 53) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Inclination; 6] = [
        Inclination::Spherical,
        Inclination::Uniform,
        Inclination::Planophile,
        Inclination::Erectophile,
        Inclination::Plagiophile,
        Inclination::Extremophile,
    ];

    #[test]
    fn mean_inclinations_are_those_of_their_densities() {
        // ∫ θ g dθ in closed form; plagiophile and extremophile are symmetric about 45°.
        let pi = std::f64::consts::PI;
        let expected = [
            1.0,
            pi / 4.0,
            pi / 4.0 - 1.0 / pi,
            pi / 4.0 + 1.0 / pi,
            pi / 4.0,
            pi / 4.0,
        ];
        for (kind, expected) in ALL.into_iter().zip(expected) {
            let count = 20_000;
            let angles = (0..count).map(|i| kind.angle((f64::from(i) + 0.5) / f64::from(count)));
            let mean = angles.sum::<f64>() / f64::from(count);
            assert!(
                (mean - expected).abs() < 1e-6,
                "{kind:?}: {mean} for {expected}"
            );
        }
    }

    #[test]
    fn leaves_of_a_spherical_volume_cast_half_their_area_whatever_the_sun() {
        let volume = Volume {
            within: [DVec3::new(-1.0, 2.0, 0.0), DVec3::new(3.0, 3.0, 0.5)],
            lai: 5.0,
            inclination: Inclination::Spherical,
            seed: 3,
        };
        let places = volume.places(&[2e-4]).expect("there is room");
        assert_eq!(places.len(), 100_000);
        for sun in [DVec3::Z, DVec3::X, DVec3::new(0.0, 0.6, 0.8)] {
            let cast = places.iter().map(|place| {
                let normal = place.to_world.matrix3.z_axis;
                assert!((normal.length() - 1.0).abs() < 1e-12 && normal.z >= 0.0);
                normal.dot(sun).abs()
            });
            let mean = cast.sum::<f64>() / places.len() as f64;
            // |cos| is even in [0, 1]: its deviation is 1/√12.
            assert!((mean - 0.5).abs() < 4.0 / (12.0 * 1e5_f64).sqrt(), "{mean}");
        }
        let middle = places.iter().map(|place| place.to_world.translation);
        let middle = middle.sum::<DVec3>() / places.len() as f64;
        assert!(
            (middle - DVec3::new(1.0, 2.5, 0.25)).length() < 0.02,
            "{middle}"
        );
    }

    #[test]
    fn shapes_of_a_list_take_turns_and_give_the_leaf_area_index() {
        let areas = [1e-3, 5e-3, 3e-2];
        let volume = Volume {
            within: [DVec3::ZERO, DVec3::ONE],
            lai: 1.2,
            inclination: Inclination::Uniform,
            seed: 8,
        };
        let places = volume.places(&areas).expect("there is room");
        assert_eq!(places.len(), 100);
        let lai: f64 = places.iter().map(|place| areas[place.body as usize]).sum();
        assert!((lai - 1.2).abs() <= 3e-2, "{lai}");
        let of = |body: u32| places.iter().filter(|place| place.body == body).count();
        assert_eq!([of(0), of(1), of(2)], [34, 33, 33]);
    }

    #[test]
    fn less_than_a_leaf_and_too_many_are_refused() {
        let volume = |lai: f64| Volume {
            within: [DVec3::ZERO, DVec3::ONE],
            lai,
            inclination: Inclination::Uniform,
            seed: 1,
        };
        let none = volume(0.001).places(&[1.0]);
        assert!(matches!(none, Err(VolumeError::None { .. })), "{none:?}");
        let many = volume(10.0).places(&[1e-8]);
        assert!(matches!(many, Err(VolumeError::TooMany { .. })), "{many:?}");
    }
}
