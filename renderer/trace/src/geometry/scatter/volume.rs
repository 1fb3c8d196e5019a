//! Leaves afloat in a box: what theory calls a turbid medium, with leaves of finite size; even, in
//! rows, or in crowns.

use glam::{DAffine3, DMat3, DVec3};
use std::f64::consts::TAU;
use thiserror::Error;

use super::inclination::Inclination;
use super::place::{Most, Strewn, from_z};
use crate::sampling::mixer;

/// How many leaves float in a box, and how they are inclined.
#[derive(Clone, Debug, PartialEq)]
pub struct Volume {
    /// Least and greatest coordinates of the leaves' origins, m.
    pub within: [DVec3; 2],
    /// Leaf area over the area of the box's ground plan, ≥ 0. Of a closed or thick leaf the whole
    /// surface counts.
    pub lai: f64,
    /// The distribution of inclinations.
    pub inclination: Inclination,
    /// Where in the box they float.
    pub arrangement: Arrangement,
    /// Same volume and seed, same places.
    pub seed: u64,
}

/// Where in a box leaves float, each without regard to the others.
#[derive(Clone, Debug, PartialEq)]
pub enum Arrangement {
    /// Everywhere alike.
    Even,
    /// In strips along y, each in the middle of its share of the box's width.
    Rows {
        /// From the middle of one strip to that of the next, m; the box is a whole number of them
        /// wide.
        spacing: f64,
        /// Width of a strip, m, at most the spacing.
        width: f64,
    },
    /// In balls of one radius, as many leaves in each, but for one of each shape. A box repeats itself: what of a
    /// crown reaches beyond a side comes in at the opposite one.
    Crowns {
        /// Their radius, m.
        radius: f64,
        /// Where they are.
        centres: Centres,
    },
}

/// Where crowns are.
#[derive(Clone, Debug, PartialEq)]
pub enum Centres {
    /// So many, at random without regard to each other, as high in the box as they fit.
    Random(u32),
    /// At these points, at least one, m.
    At(Vec<DVec3>),
}

/// Why a volume cannot be filled.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum VolumeError {
    /// More than there may be.
    #[error("`lai`: this takes {wanted} leaves, more than {most}")]
    TooMany {
        /// How many it takes.
        wanted: f64,
        /// How many there may be.
        most: Most,
    },
    /// Less than one leaf, but more than none.
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
    /// [`VolumeError`] if that is too many, or no leaf although the index is above 0.
    ///
    /// # Panics
    ///
    /// If there is no area.
    pub fn places(&self, areas: &[f64], at_most: Most) -> Result<Vec<Strewn>, VolumeError> {
        assert!(!areas.is_empty(), "something floats");
        let area = areas.iter().sum::<f64>() / areas.len() as f64;
        let [least, most] = self.within;
        let size = most - least;
        let wanted = self.lai * size.x * size.y / area;
        if self.lai > 0.0 && wanted.round() < 1.0 {
            return Err(VolumeError::None { wanted, area });
        }
        if wanted > at_most.things() as f64 {
            return Err(VolumeError::TooMany {
                wanted: wanted.round(),
                most: at_most,
            });
        }
        let place = |number: u64| {
            let random = |what: Use| self.random(number, what);
            let draws = DVec3::new(random(Use::X), random(Use::Y), random(Use::Z));
            let at = self.at(draws, number / areas.len() as u64);
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

    /// The place of a leaf from three random numbers in [0, 1); `turn` counts rounds of shapes, so
    /// that every crown has leaves of each.
    fn at(&self, draws: DVec3, turn: u64) -> DVec3 {
        let [least, most] = self.within;
        let size = most - least;
        let even = least + size * draws;
        match &self.arrangement {
            Arrangement::Even => even,
            Arrangement::Rows { spacing, width } => {
                let rows = (size.x / spacing).round().max(1.0);
                // The whole part of the number chooses the row, the rest the place in it.
                let along = draws.x * rows;
                let row = along.floor();
                let x = (row + 0.5) * spacing + (along - row - 0.5) * width;
                DVec3::new(least.x + x, even.y, even.z)
            }
            Arrangement::Crowns { radius, centres } => {
                let centre = self.centre(*radius, centres, turn);
                let cos = 1.0 - 2.0 * draws.x;
                let (east, north) = libm::sincos(TAU * draws.y);
                let sin = (1.0 - cos * cos).max(0.0).sqrt();
                let direction = DVec3::new(sin * east, sin * north, cos);
                let at = centre + radius * libm::cbrt(draws.z) * direction;
                let wrapped =
                    |at: f64, least: f64, size: f64| least + (at - least).rem_euclid(size);
                DVec3::new(
                    wrapped(at.x, least.x, size.x),
                    wrapped(at.y, least.y, size.y),
                    at.z,
                )
            }
        }
    }

    /// The middle of the crown of a leaf.
    fn centre(&self, radius: f64, centres: &Centres, turn: u64) -> DVec3 {
        let [least, most] = self.within;
        match centres {
            Centres::At(places) => places[(turn % places.len() as u64) as usize],
            Centres::Random(count) => {
                let crown = turn % u64::from(*count);
                // Crowns draw from numbers that leaves do not reach.
                let random = |what: Use| self.random(u64::MAX - crown, what);
                let up = DVec3::Z * radius;
                let (low, high) = (least + up, most - up);
                low + (high - low) * DVec3::new(random(Use::X), random(Use::Y), random(Use::Z))
            }
        }
    }

    /// A number in [0, 1) for each use of each leaf.
    fn random(&self, number: u64, what: Use) -> f64 {
        mixer::of_use(self.seed, number, what as u64)
    }
}

#[cfg(test)]
mod tests;
