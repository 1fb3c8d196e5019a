//! The petiole: a stalk that goes on as the midrib.
//!
//! From the stem it comes along −y to the base at the origin, where the blade's own midrib leaves
//! along +y. The blade begins inside the tube, its raised midrib too. Beyond the base the tube
//! follows the thickest vein and gets ever thinner. Its abaxial side stays outside the relief all
//! along, its adaxial side sinks through the blade once, so that it ends as a fine point that lies
//! on the midrib from below. How far and how fast is by eye.

mod midrib;

use glam::{DVec2, DVec3};

use super::BladeForm;
use super::error::BladeError;
use super::form::Bending;
use super::relief::{Relief, smooth_step};
use super::stalk::StalkMesh;
use crate::shape::outline::Outline;
use crate::venation::network::{VeinSegment, VenationNetwork};
use midrib::Midrib;

/// Length of the joint in radii of the petiole, and its least and greatest share of the leaf's
/// length.
const JOINT_RADII: f64 = 14.0;
const JOINT_SHARE: [f64; 2] = [0.03, 0.2];
/// Pieces of the joint.
const JOINT_PIECES: usize = 24;
/// Radius of the tube's end over the lesser of its own and the vein's.
const END_RADIUS: f64 = 0.05;
/// By how much of its radius the tube at the base reaches beyond the ridge of the midrib, at least.
const BEYOND_RIDGE: f64 = 0.25;
/// Least radius at the base over the height of the ridge there: the tube holds the end of the blade
/// from the ridge up.
const HOLDS: f64 = 0.75;
/// Share of the joint after which the tube has sunk, and the share of its diameter that is then
/// beyond the ridge: a touch more than all, so that nothing of it is left on the adaxial side.
const SUNK_AT: f64 = 0.9;
const SUNK: f64 = 1.02;
/// Over how many radii before the base the tube makes ready for the joint, over half its length at
/// most.
const READY_RADII: f64 = 7.0;
/// Places across the tube at which the relief is looked up, on each side.
const ACROSS: i32 = 4;
/// By how much the foot is thicker, and over how many radii.
const FOOT: f64 = 0.3;
const FOOT_RADII: f64 = 5.0;
/// Pieces of a petiole, at least, and the greatest angle between two of them, radians.
const PIECES: f64 = 12.0;
const PIECE_ANGLE: f64 = 0.06;

/// What decides a petiole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PetiolePlan {
    /// Length over the leaf's, 0 to 10.
    pub length: f64,
    /// Radius, mm, 0.001 to 100; as the midrib at its base if `None`.
    pub radius_mm: Option<f64>,
    /// Angle by which it has bent towards the abaxial side at its foot, radians, −3 to 3; 0 is
    /// straight.
    pub curl: f64,
}

impl PetiolePlan {
    /// Checks every field.
    ///
    /// # Errors
    ///
    /// [`BladeError::OutOfRange`] for the first field outside its range.
    pub fn validate(&self) -> Result<(), BladeError> {
        let radius = self.radius_mm.unwrap_or(1.0);
        for (field, value, allowed, range) in [
            ("petiole.length", self.length, 0.0..=10.0, "0 to 10"),
            (
                "petiole.radius_mm",
                radius,
                1e-3..=100.0,
                "0.001 to 100 (millimetres)",
            ),
            ("petiole.curl", self.curl, -3.0..=3.0, "-3 to 3 (radians)"),
        ] {
            if !allowed.contains(&value) {
                return Err(BladeError::OutOfRange {
                    field,
                    value,
                    range,
                });
            }
        }
        Ok(())
    }

    /// Its radius on a leaf with these veins, mm.
    pub fn radius_on(&self, outline: &Outline, network: &VenationNetwork) -> f64 {
        let midrib = || Midrib::new(outline, network, 0.0).radius;
        self.radius_mm.unwrap_or_else(midrib).max(1e-3)
    }

    /// The petiole of a blade of this form, mm, joint and all.
    ///
    /// # Errors
    ///
    /// [`BladeError`] if a field of either is out of range.
    pub fn build(
        &self,
        outline: &Outline,
        network: &VenationNetwork,
        form: &BladeForm,
    ) -> Result<StalkMesh, BladeError> {
        self.validate()?;
        form.validate()?;
        let leaf = outline.length();
        let midrib = Midrib::new(outline, network, JOINT_SHARE[1] * leaf);
        let radius = self.radius_mm.unwrap_or(midrib.radius).max(1e-3);
        let veins: Vec<VeinSegment> = network
            .segments()
            .filter(|vein| vein.radius_from.max(vein.radius_to) >= form.meshed_vein_radius_mm)
            .collect();
        let joint = Joint::new(
            radius,
            &midrib,
            Relief::new(form, &veins),
            Bending::new(form, outline, network.map()),
            leaf,
        );
        let (mut points, mut radii) = (Vec::new(), Vec::new());
        let length = self.length * leaf;
        if length > 1e-6 * leaf {
            let foot = (FOOT_RADII * radius).min(length);
            let ready = (READY_RADII * joint.radius).min(0.5 * length);
            for back in self.places(length, foot, ready) {
                let near = smooth_step(1.0 - back / ready);
                points.push(self.behind(back, length) - DVec3::Z * (near * joint.depth));
                let from_foot = (length - back) / foot;
                let own = radius * (1.0 + FOOT * (1.0 - smooth_step(from_foot)));
                radii.push(own + (joint.radius - radius) * near);
            }
        }
        let with_joint = |midrib: &Midrib| {
            let (mut points, mut radii) = (points.clone(), radii.clone());
            for i in 0..=JOINT_PIECES {
                let (point, radius) = joint.at(midrib, i as f64 / JOINT_PIECES as f64);
                points.push(point);
                radii.push(radius);
            }
            StalkMesh::tube(&points, &radii)
        };
        // A vein with a kink is left for the straight line.
        let straight = || {
            let nodes = Vec::new();
            with_joint(&Midrib { nodes, ..midrib })
        };
        Ok(with_joint(&midrib)
            .or_else(|_| straight())
            .expect("a smooth bend of a straight line has no kinks, and radii are above 0"))
    }

    /// Distances from the base of the points of the tube behind it, from the foot on: even ones,
    /// and closer ones where the radius changes.
    fn places(&self, length: f64, foot: f64, ready: f64) -> Vec<f64> {
        let pieces = PIECES.max((self.curl.abs() / PIECE_ANGLE).ceil());
        let mut backs: Vec<f64> = (1..=pieces as u32)
            .map(|i| length * f64::from(i) / pieces)
            .collect();
        let closer = |share: f64| [length - foot * share, ready * share];
        backs.extend((1..=6).flat_map(|i| closer(f64::from(i) / 6.0)));
        backs.sort_by(|a, b| b.total_cmp(a));
        // Nothing of the base's own place, which the joint has.
        backs.retain(|&back| back > 0.01 * ready);
        backs.dedup_by(|next, kept| *kept - *next < 0.02 * ready.min(foot));
        backs
    }

    /// A point of the petiole so far from the base.
    fn behind(&self, back: f64, length: f64) -> DVec3 {
        let curvature = self.curl / length;
        let angle = curvature * back;
        let (y, z) = if angle.abs() < 1e-6 {
            (back, 0.5 * angle * back)
        } else {
            let half = libm::sin(0.5 * angle);
            (libm::sin(angle) / curvature, 2.0 * half * half / curvature)
        };
        DVec3::new(0.0, -y, -z)
    }
}

/// The tube from the base on.
struct Joint {
    /// Radius at the base.
    radius: f64,
    /// Depth of the axis at the base, towards the abaxial side.
    depth: f64,
    /// Share of the diameter at the base that is beyond the ridge.
    beyond: f64,
    end: f64,
    length: f64,
    relief: Relief,
    bending: Bending,
}

impl Joint {
    /// Of a petiole with this radius.
    fn new(radius: f64, midrib: &Midrib, relief: Relief, bending: Bending, leaf: f64) -> Self {
        let [least, most] = JOINT_SHARE;
        let ridge = ridge(&relief, midrib.at(0.0).0, radius.max(midrib.radius));
        let wide = radius.max(HOLDS * ridge);
        let beyond = (BEYOND_RIDGE * wide).max(wide - ridge);
        Self {
            radius: wide,
            depth: ridge + beyond - wide,
            beyond: 0.5 * beyond / wide,
            end: END_RADIUS * radius.min(midrib.radius.max(1e-3)),
            length: (JOINT_RADII * wide).clamp(least * leaf, most * leaf),
            relief,
            bending,
        }
    }

    /// Axis and radius at a share of the way to its end.
    fn at(&self, midrib: &Midrib, t: f64) -> (DVec3, f64) {
        let (p, _) = midrib.at(self.length * t);
        let radius = self.end + (self.radius - self.end) * (1.0 - smooth_step(t));
        let beyond = self.beyond + (SUNK - self.beyond) * smooth_step(t / SUNK_AT);
        let depth = if t > 0.0 {
            ridge(&self.relief, p, radius) + radius * (2.0 * beyond - 1.0)
        } else {
            self.depth
        };
        (self.bending.place(p, -depth), radius)
    }
}

/// The greatest height of the relief over the width of a tube.
fn ridge(relief: &Relief, p: DVec2, radius: f64) -> f64 {
    (-ACROSS..=ACROSS)
        .map(|i| relief.height(p + DVec2::X * (radius * f64::from(i) / f64::from(ACROSS))))
        .fold(0.0, f64::max)
}

#[cfg(test)]
mod tests;
