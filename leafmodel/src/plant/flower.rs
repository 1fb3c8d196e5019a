//! A flower at the tip of the main axis: peduncle, sepals, petals, stamens and pistil.
//!
//! Whorls alternate: petals stand between sepals, the outer stamens before the sepals, the inner
//! ones before the petals. Sepals and petals are leaves; stamens and pistil are bodies.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::turned::level;
use super::turned::ribbed;
use crate::blade::stalk::StalkMesh;
use crate::document::Declared;
use crate::not_grown::NotGrown;
use crate::random::{Use, bell};
use crate::rotation::about;

/// The numbers of a flower. Angles are radians.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct FlowerPlan {
    /// Sepals, petals, stamens of either whorl, stigmas: so many of each.
    #[key("parts", 2..=12)]
    pub parts: u32,
    /// Length of the peduncle.
    #[key("peduncle_mm", 1.0..=1000.0)]
    pub peduncle_mm: f64,
    /// Radius of the peduncle.
    #[key("peduncle_radius_mm", 0.1..=20.0)]
    pub peduncle_radius_mm: f64,
    /// Angle by which it leans away from the axis that bears it.
    ///
    /// Radians.
    #[key("nod_deg", degrees(0.0..=143.0))]
    pub nod: f64,
    /// Angles of the feet of sepals and of petals from the flower's axis.
    ///
    /// Radians.
    #[key("angles_deg", degrees(3.0..=170.0))]
    pub angles: [f64; 2],
    /// Lengths of filament and anther.
    #[key("stamens_mm", 0.2..=100.0)]
    pub stamens_mm: [f64; 2],
    /// Lengths of ovary and stigmas.
    #[key("pistil_mm", 0.2..=100.0)]
    pub pistil_mm: [f64; 2],
}

impl FlowerPlan {
    /// A flower of three parts: the numbers that a file leaves out, those of white trillium
    /// (\[gleason1991\]: peduncle 5 to 8 cm, stamens 15 to 25 mm with filaments of more than half an
    /// anther, stigmas slightly shorter than the ovary; angles and radii by eye).
    pub const USUAL: Self = Self {
        parts: 3,
        peduncle_mm: 60.0,
        peduncle_radius_mm: 1.3,
        nod: 25.0 * PI / 180.0,
        angles: [75.0 * PI / 180.0, 38.0 * PI / 180.0],
        stamens_mm: [7.5, 12.0],
        pistil_mm: [9.0, 7.5],
    };
}

/// How far sepals and petals stand from the flower's axis, in radii of the peduncle.
const RECEPTACLE: [f64; 2] = [1.1, 0.9];
/// Radius of the receptacle, in radii of the peduncle.
const RECEPTACLE_RADIUS: f64 = 1.35;
/// Height of sepals, petals and stamens above the end of the peduncle, in its radii.
const HEIGHTS: [f64; 3] = [0.2, 0.6, 0.9];
/// Angles of outer and inner stamens from the flower's axis.
const STAMEN_ANGLES: [f64; 2] = [0.34, 0.24];
/// Radius of a filament over its length, and of each half of an anther over its length.
const SLENDER: [f64; 2] = [0.055, 0.05];
/// Radius of the ovary over its length, and of a stigma over its length.
const PISTIL_SLENDER: [f64; 2] = [0.33, 0.055];
/// Depth of the furrows between the ribs of the ovary, as a share of its radius.
const FURROWS: f64 = 0.22;
/// Radii of the ovary from its foot to its top, over the greatest.
const OVARY: [[f64; 2]; 9] = [
    [0.0, 0.35],
    [0.08, 0.68],
    [0.2, 0.9],
    [0.35, 1.0],
    [0.5, 0.96],
    [0.65, 0.8],
    [0.8, 0.55],
    [0.92, 0.34],
    [1.0, 0.2],
];

/// Bodies of a flower in the plant's frame, mm.
#[derive(Clone, Debug, Default)]
pub(super) struct Bodies {
    pub(super) peduncle: StalkMesh,
    pub(super) filaments: StalkMesh,
    pub(super) anthers: StalkMesh,
    pub(super) pistil: StalkMesh,
}

/// A place for a sepal or petal.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seat {
    pub(super) at: DVec3,
    pub(super) along: DVec3,
    pub(super) radial: DVec3,
    pub(super) angle: f64,
}

/// A grown flower: its bodies, and places for its sepals and petals.
pub(super) struct Flower {
    pub(super) bodies: Bodies,
    pub(super) seats: [Vec<Seat>; 2],
}

impl FlowerPlan {
    /// The flower on an axis that ends at a place in a direction.
    pub(super) fn grown(&self, at: DVec3, along: DVec3, seed: u64) -> Result<Flower, NotGrown> {
        let radius = self.peduncle_radius_mm;
        let chance = |number: u64| bell(seed, Use::Flower, number);
        // It leans between two leaves of a whorl, which stand at multiples of 2π / parts.
        let reference = level(along);
        let lean = about(along, PI / f64::from(self.parts)) * reference;
        let pieces = 14;
        let (mut points, mut place, mut forward) = (vec![at - along * radius], at, along);
        for _ in 0..pieces {
            points.push(place);
            let side = forward
                .cross(lean)
                .normalize_or(forward.any_orthonormal_vector());
            forward = about(side, self.nod / f64::from(pieces)) * forward;
            place += forward * (self.peduncle_mm / f64::from(pieces));
        }
        points.push(place);
        let radii: Vec<f64> = (0..points.len())
            .map(|number| {
                let share = number as f64 / (points.len() - 1) as f64;
                radius * (1.0 - 0.15 * share + (RECEPTACLE_RADIUS - 0.85) * libm::pow(share, 8.0))
            })
            .collect();
        let mut bodies = Bodies {
            peduncle: StalkMesh::tube(&points, &radii)?,
            ..Bodies::default()
        };
        let first = level(forward);
        let around = |share: f64| about(forward, TAU * share / f64::from(self.parts)) * first;
        let seats = [0, 1].map(|whorl| {
            let seats = (0..self.parts).map(|part| {
                let radial = around(f64::from(part) + 0.5 * whorl as f64);
                Seat {
                    at: place
                        + forward * (HEIGHTS[whorl] * radius)
                        + radial * (RECEPTACLE[whorl] * radius),
                    along: forward,
                    radial,
                    angle: self.angles[whorl] + 0.06 * chance(8 * whorl as u64 + u64::from(part)),
                }
            });
            seats.collect()
        });
        let top = place + forward * (HEIGHTS[2] * radius);
        for whorl in 0..2_u32 {
            for part in 0..self.parts {
                let number = 64 + 8 * u64::from(whorl * 12 + part);
                let radial =
                    around(f64::from(part) + 0.5 * f64::from(whorl) + 0.03 * chance(number));
                let angle = STAMEN_ANGLES[whorl as usize] + 0.05 * chance(number + 1);
                self.stamen(&mut bodies, [top, forward, radial], angle)?;
            }
        }
        self.pistil(&mut bodies, top, forward, &around)?;
        Ok(Flower { bodies, seats })
    }

    fn stamen(
        &self,
        bodies: &mut Bodies,
        [top, forward, radial]: [DVec3; 3],
        angle: f64,
    ) -> Result<(), NotGrown> {
        let [filament, anther] = self.stamens_mm;
        let way = |share: f64| {
            // It bends back upwards: filaments spread, anthers stand nearly upright.
            let angle = angle * (1.3 - 0.8 * share);
            forward * libm::cos(angle) + radial * libm::sin(angle)
        };
        let foot = top + radial * (0.9 * self.peduncle_radius_mm);
        let step = filament / 5.0;
        let mut points = vec![foot - forward * 0.4];
        for number in 0..=5 {
            let last = points[points.len() - 1];
            points.push(last + way(f64::from(number) / 10.0) * step);
        }
        let thick = SLENDER[0] * filament;
        let radii: Vec<f64> = (0..points.len())
            .map(|number| thick * (1.0 - 0.08 * number as f64))
            .collect();
        bodies.filaments.append(StalkMesh::tube(&points, &radii)?);
        let side = forward.cross(radial);
        let half = SLENDER[1] * anther;
        let end = points[points.len() - 1];
        for hand in [-1.0, 1.0] {
            let mut at = end + side * (0.8 * hand * half);
            let (mut points, mut radii) = (Vec::new(), Vec::new());
            for number in 0..=8 {
                let share = f64::from(number) / 8.0;
                points.push(at);
                radii.push(half * (0.62 + 0.38 * (PI * (0.1 + 0.8 * share)).sin()));
                at += way(0.5 + 0.5 * share) * (anther / 8.0);
            }
            bodies.anthers.append(StalkMesh::tube(&points, &radii)?);
        }
        Ok(())
    }

    fn pistil(
        &self,
        bodies: &mut Bodies,
        top: DVec3,
        forward: DVec3,
        around: &impl Fn(f64) -> DVec3,
    ) -> Result<(), NotGrown> {
        let [ovary, stigma] = self.pistil_mm;
        let radius = PISTIL_SLENDER[0] * ovary;
        let profile = OVARY.map(|[height, share]| [height * ovary, share * radius]);
        let ribs = 2 * self.parts;
        let foot = top - forward * (0.05 * ovary);
        let frame = [foot, around(0.0), forward];
        bodies.pistil.append(ribbed(&profile, frame, ribs, FURROWS));
        let summit = top + forward * (0.9 * ovary);
        for part in 0..self.parts {
            let radial = around(f64::from(part) + 0.5);
            let (mut points, mut radii) = (Vec::new(), Vec::new());
            let mut at = summit + radial * (0.1 * radius);
            for number in 0..=8 {
                let share = f64::from(number) / 8.0;
                points.push(at);
                radii.push(PISTIL_SLENDER[1] * stigma * (1.0 - 0.6 * share));
                // They stand upright and recurve at their ends.
                let angle = 0.15 + 1.0 * share * share;
                at += (forward * libm::cos(angle) + radial * libm::sin(angle)) * (stigma / 8.0);
            }
            bodies.pistil.append(StalkMesh::tube(&points, &radii)?);
        }
        Ok(())
    }
}
