//! A pot with soil, in which a plant stands.
//!
//! The pot is a closed body: tapered wall, a rim that stands out like a collar, a floor. It stands in
//! a dish, if it has one. The soil reaches from wall to wall; crumbs lie on it.

use std::f64::consts::{PI, TAU};

use glam::{DQuat, DVec2, DVec3};

use super::turned::turned;
use crate::blade::stalk::StalkMesh;
use crate::document::Declared;
use crate::random::{Use, bell, uniform};

/// The numbers of a pot.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct PotPlan {
    /// Outer diameter at the rim.
    #[key("diameter_mm", 20.0..=2000.0)]
    pub diameter_mm: f64,
    /// Height, without the dish.
    #[key("height_mm", 20.0..=2000.0)]
    pub height_mm: f64,
    /// Diameter of the foot over that at the top of the body, without the rim.
    #[key("taper", 0.3..=1.0)]
    pub taper: f64,
    /// Thickness of the wall.
    #[key("wall_mm", 1.0..=100.0)]
    pub wall_mm: f64,
    /// Height of the rim, and how far it stands out; with a 0 there is none.
    #[key("rim_mm", 0.0..=500.0)]
    pub rim_mm: [f64; 2],
    /// Whether it stands in a dish.
    #[key("dish")]
    pub dish: bool,
    /// Height of the soil over that of the pot.
    #[key("fill", 0.2..=1.0)]
    pub fill: f64,
    /// Crumbs for each square centimetre of soil.
    #[key("crumbs_per_cm2", 0.0..=100.0)]
    pub crumbs_per_cm2: f64,
    /// Radius of the largest crumbs; most are much smaller.
    #[key("crumb_mm", 0.1..=50.0)]
    pub crumb_mm: f64,
    /// Moisture of the soil, from 0 dry to 1 wet.
    #[key("moisture", 0.0..=1.0)]
    pub moisture: f64,
}

impl PotPlan {
    /// A clay pot of 16 cm, as plants of a window sill stand in; proportions by eye of standard pots,
    /// which are about as high as wide and taper to two thirds.
    pub const USUAL: Self = Self {
        diameter_mm: 160.0,
        height_mm: 145.0,
        taper: 0.7,
        wall_mm: 6.0,
        rim_mm: [32.0, 4.0],
        dish: true,
        fill: 0.88,
        crumbs_per_cm2: 9.0,
        crumb_mm: 3.2,
        moisture: 0.5,
    };

    /// Whether the numbers make a pot with an inside.
    pub(super) fn is_hollow(&self) -> bool {
        let foot = self.taper * self.body_radius();
        foot > 2.0 * self.wall_mm
            && self.height_mm > 3.0 * self.wall_mm
            && self.rim_mm[0] + 2.0 * self.wall_mm < self.height_mm
            && self.fill * self.height_mm > 2.0 * self.wall_mm
    }

    /// Outer radius of the body where the rim begins, mm.
    fn body_radius(&self) -> f64 {
        0.5 * self.diameter_mm - self.rim_mm[1]
    }

    /// Height of the pot's foot above the ground, mm.
    fn foot_height(&self) -> f64 {
        if self.dish { self.wall_mm } else { 0.0 }
    }

    /// Outer radius of the body at a height above its foot, mm.
    fn outer_radius(&self, height: f64) -> f64 {
        let body = self.body_radius();
        body * (self.taper + (1.0 - self.taper) * height / self.height_mm)
    }

    /// Height of the soil above the ground, mm.
    pub(super) fn soil_height(&self) -> f64 {
        self.foot_height() + self.fill * self.height_mm
    }

    /// Inner radius at the soil, mm.
    pub(super) fn soil_radius(&self) -> f64 {
        self.outer_radius(self.fill * self.height_mm) - self.wall_mm
    }

    /// Pot and dish, the ground at z = 0.
    pub(super) fn vessel(&self) -> StalkMesh {
        let (wall, height, foot) = (self.wall_mm, self.height_mm, self.foot_height());
        let [rim, out] = self.rim_mm;
        let round = 0.35 * wall;
        let at = |height: f64| self.outer_radius(height);
        let mut profile = vec![[0.0, 0.0], [at(0.0) - round, 0.0], [at(0.0), round]];
        if out > 0.0 && rim > 0.0 {
            let under = height - rim;
            profile.push([at(under), under]);
            profile.push([at(under) + 0.8 * out, under + 0.1 * out]);
            profile.push([at(under) + out, under + 0.6 * out]);
        }
        // The lip is half a circle.
        let inner = at(height) - wall;
        let outer = at(height) + out;
        let (middle, lip) = (0.5 * (inner + outer), 0.5 * (outer - inner));
        for step in 0..=8 {
            let (sin, cos) = libm::sincos(PI * f64::from(step) / 8.0);
            profile.push([middle + lip * cos, height - round + round * sin]);
        }
        profile.push([at(wall) - wall, wall]);
        profile.push([0.0, wall]);
        let mut vessel = turned(&raised(&profile, foot));
        if self.dish {
            let inside = 1.22 * at(0.0) + 4.0;
            let outside = inside + 0.9 * wall;
            let side = 0.14 * height + wall;
            let flare = 0.25 * side;
            let round = 0.4 * wall;
            let lip = 0.45 * wall;
            let mut profile = vec![
                [0.0, 0.0],
                [outside - round, 0.0],
                [outside, round],
                [outside + flare, side - lip],
            ];
            for step in 0..=6 {
                let (sin, cos) = libm::sincos(PI * f64::from(step) / 6.0);
                profile.push([outside + flare - lip + lip * cos, side - lip + lip * sin]);
            }
            profile.extend([
                [inside + 0.3, 1.2 * wall],
                [inside - 1.5, wall],
                [0.0, wall],
            ]);
            vessel.append(turned(&profile));
        }
        vessel
    }

    /// The surface of the soil, uneven, up to 1 mm into the wall.
    pub(super) fn soil(&self, seed: u64) -> StalkMesh {
        let (rings, around) = (48_usize, 160_usize);
        let edge = self.soil_radius() + 1.0;
        let mut soil = StalkMesh::default();
        for ring in 0..=rings {
            for side in 0..around {
                let radius = edge * ring as f64 / rings as f64;
                let (sin, cos) = libm::sincos(TAU * side as f64 / around as f64);
                let at = DVec2::new(radius * cos, radius * sin);
                let height = |at: DVec2| self.soil_height() + self.unevenness(at, seed);
                let slope = DVec2::new(
                    height(at + DVec2::X) - height(at - DVec2::X),
                    height(at + DVec2::Y) - height(at - DVec2::Y),
                );
                soil.positions.push(at.extend(height(at)));
                soil.normals.push((-0.5 * slope).extend(1.0).normalize());
                soil.uvs.push(0.5 + 0.5 * at / edge);
                soil.thickness_mm.push(1.0);
            }
        }
        let at = |ring: usize, side: usize| (ring * around + side % around) as u32;
        for ring in 1..=rings {
            for side in 0..around {
                let [a, b] = [at(ring - 1, side), at(ring - 1, side + 1)];
                let [c, d] = [at(ring, side), at(ring, side + 1)];
                if ring > 1 {
                    soil.triangles.push([a, d, b]);
                }
                soil.triangles.push([a, c, d]);
            }
        }
        soil
    }

    /// Height of the soil over its mean, mm: waves of a quarter of its width and less, and a dip
    /// towards the wall, from which drying soil shrinks.
    fn unevenness(&self, at: DVec2, seed: u64) -> f64 {
        let edge = self.soil_radius();
        let waves: f64 = (0..24_u64)
            .map(|number| {
                let chance = |what: u64| uniform(seed, Use::Soil, 4 * number + what);
                let length = 0.5 * edge * libm::pow(0.82, number as f64);
                let (sin, cos) = libm::sincos(TAU * chance(0));
                let phase = TAU * (chance(1) + DVec2::new(cos, sin).dot(at) / length);
                0.011 * length * libm::cos(phase)
            })
            .sum();
        let share = (at.length() / edge).min(1.0);
        waves - 0.03 * edge * libm::pow(share, 6.0)
    }

    /// Crumbs on the soil, as many as they are said to be; small ones are many.
    pub(super) fn crumbs(&self, seed: u64) -> Vec<Crumb> {
        let radius = self.soil_radius();
        let area_cm2 = PI * radius * radius / 100.0;
        let count = (area_cm2 * self.crumbs_per_cm2).round().min(1e5) as u64;
        let crumb = |number: u64| {
            let chance = |what: u64| uniform(seed, Use::Soil, 1000 + 8 * number + what);
            let (sin, cos) = libm::sincos(TAU * chance(0));
            let size = self.crumb_mm * libm::pow(chance(1), 2.2).max(0.08);
            let from = (radius - size).max(0.0) * chance(2).sqrt();
            let at = DVec2::new(from * cos, from * sin);
            let turn = |what: u64| bell(seed, Use::Soil, 2_000_000 + 4 * number + what);
            let turn = DQuat::from_xyzw(turn(0), turn(1), turn(2), turn(3));
            Crumb {
                at: at.extend(self.soil_height() + self.unevenness(at, seed) + 0.3 * size),
                radius_mm: size,
                turn: if turn.length() > 1e-3 {
                    turn.normalize()
                } else {
                    DQuat::IDENTITY
                },
                shape: (chance(3) * 64.0) as u32,
            }
        };
        (0..count).map(crumb).collect()
    }
}

/// A crumb of soil.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crumb {
    /// Its middle, mm.
    pub at: DVec3,
    /// Its radius, mm.
    pub radius_mm: f64,
    /// How it is turned.
    pub turn: DQuat,
    /// A number below 64 that tells shapes apart.
    pub shape: u32,
}

fn raised(profile: &[[f64; 2]], by: f64) -> Vec<[f64; 2]> {
    profile.iter().map(|[r, z]| [*r, z + by]).collect()
}
