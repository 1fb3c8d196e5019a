//! The petiole of a peltate leaf, which meets the blade inside its margin.
//!
//! The tube comes from the abaxial side, at right angles to the blade, widens below it and goes
//! through it once: its rim lies within the blade all around, and its end is a low dome on the
//! adaxial side, the pale spot from which the veins of such a leaf spread. Near the blade the tube
//! is carried by the same map as the blade, and what is below it encloses the relief, so the rim
//! follows every bend and every vein. The proportions are by eye.

use glam::{DMat3, DVec2, DVec3};

use super::super::mesh::vertex_normals;
use super::super::relief::Relief;
use super::super::stalk::StalkMesh;
use super::super::stance::Posture;
use super::{FOOT_RADII, PetiolePlan, READY_RADII};
use crate::numeric::smooth_step;
use crate::shape::outline::Outline;

/// Least distance of the base from the margin, in radii of the petiole, for it to be inside.
const INSIDE_RADII: f64 = 1.5;
/// Radius of the rim over the petiole's, at most this share of the way to the margin.
const RIM: f64 = 1.7;
const RIM_SHARE: f64 = 0.8;
/// Length over which the tube widens, in radii.
const FLARE_RADII: f64 = 3.0;
/// Heights above the blade, in radii, and radii over that of the rim, of the dome.
const DOME: [[f64; 2]; 4] = [[0.02, 0.98], [0.07, 0.8], [0.11, 0.5], [0.13, 0.04]];

/// Whether the base of a leaf lies so far inside its margin that a petiole of this radius comes from
/// below.
pub(super) fn is_inside(outline: &Outline, radius: f64) -> bool {
    let base = outline.base();
    outline.contains(base) && outline.distance_to_margin(base) > INSIDE_RADII * radius
}

impl PetiolePlan {
    /// The mesh of the petiole of a peltate leaf.
    pub(super) fn peltate(
        &self,
        outline: &Outline,
        radius: f64,
        relief: &Relief,
        posture: &Posture<'_>,
        seed: u64,
    ) -> StalkMesh {
        let leaf = outline.length();
        let length = (self.length * leaf).max(FLARE_RADII * radius);
        let whole = Self {
            length: length / leaf,
            ..*self
        };
        // As an ordinary petiole that has bent by a right angle towards the abaxial side.
        let start = DMat3::from_cols(DVec3::X, DVec3::Z, -DVec3::Y);
        let foot = (FOOT_RADII * radius).min(length);
        let ready = (READY_RADII * radius).min(0.5 * length);
        let to_margin = outline.distance_to_margin(outline.base());
        let rim = (RIM * radius).min(RIM_SHARE * to_margin);
        let base = Base {
            flat: outline.base(),
            relief,
            posture,
            ready,
            rim,
        };
        let attempt = |course: Self| {
            let axis = course.axis(leaf, radius, posture.sag(), start, seed);
            let (mut points, mut radii, mut sections) = (Vec::new(), Vec::new(), Vec::new());
            for back in course.rings(posture.sag(), length, foot, ready, radius) {
                let (at, frame) = axis.at(back);
                // Straight where it widens, so that the rim is a circle about the base.
                let near = smooth_step(1.0 - back / ready);
                points.push(at.lerp(DVec3::NEG_Z * back, near));
                let flare = smooth_step(1.0 - back / (FLARE_RADII * radius));
                let swollen = course.swollen(length - back, foot, back / ready);
                radii.push(radius * (1.0 + swollen) + (rim - radius) * flare * flare);
                sections.push((1.0 - near, frame.x_axis));
            }
            for [height, share] in DOME {
                points.push(DVec3::Z * (height * radius));
                radii.push(share * rim);
                sections.push((0.0, DVec3::X));
            }
            let mut tube = StalkMesh::tube(&points, &radii).ok()?;
            course.section.shape(&mut tube, &points, &sections);
            Some(tube)
        };
        let straight = Self {
            curl: 0.0,
            course: super::Course::STRAIGHT,
            ..whole
        };
        let mut tube = attempt(whole)
            .or_else(|| attempt(straight))
            .expect("a straight line has no kinks, and radii are above 0");
        for position in &mut tube.positions {
            *position = base.place(*position);
        }
        tube.normals = vertex_normals(&tube.positions, &tube.triangles);
        tube
    }

    /// Distances from the base of the rings of the tube, from the foot on: denser where it widens.
    fn rings(&self, wilted: f64, length: f64, foot: f64, ready: f64, radius: f64) -> Vec<f64> {
        let flare = FLARE_RADII * radius;
        let mut backs = self.places(wilted, length, foot, ready);
        backs.extend((1..=8).map(|i| flare * f64::from(i) / 8.0));
        backs.push(0.02 * radius);
        backs.sort_by(|a, b| b.total_cmp(a));
        backs.dedup_by(|next, kept| *kept - *next < 0.01 * radius);
        backs
    }
}

/// Where the blade holds the tube.
struct Base<'a> {
    flat: DVec2,
    relief: &'a Relief,
    posture: &'a Posture<'a>,
    /// Distance over which the tube goes over from the blade's map to its own course.
    ready: f64,
    rim: f64,
}

impl Base<'_> {
    /// A point of the tube, in the frame of the base, brought into space.
    fn place(&self, at: DVec3) -> DVec3 {
        let (base, frame) = self.posture.base();
        let own = base + frame * at;
        let aside = (at.truncate().length() - 2.0 * self.rim).max(0.0);
        let near = smooth_step(1.0 + (at.z.min(0.0) - aside) / self.ready);
        if near == 0.0 {
            return own;
        }
        let p = self.flat + at.truncate();
        // The stalk holds the veins that stand out below; their grooves lie under the dome.
        let sunk = if at.z < 0.0 {
            self.relief.height(p)
        } else {
            0.0
        };
        let with_blade = self.posture.place(p, at.z - sunk);
        own.lerp(with_blade, near)
    }
}
