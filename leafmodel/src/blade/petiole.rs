//! The petiole: a stalk that continues into the midrib.
//!
//! It runs along the −y axis to the base at the origin, where the blade's midrib starts along +y.
//! The blade, with its raised midrib, begins inside the tube. Beyond the base the tube follows the
//! thickest vein and tapers. Its abaxial side stays outside the relief, while its adaxial side
//! sinks through the blade once, so that the tube ends as a fine point on the abaxial side of the
//! midrib. The proportions are by eye.
//!
//! Between base and foot its axis takes a [`Course`]. The petiole of a peltate leaf comes from
//! below instead.

mod course;
mod midrib;
mod peltate;
mod section;

use glam::{DMat3, DVec2, DVec3};

use super::error::BladeError;
use super::plan::BladeForm;
use super::relief::Relief;
use super::stalk::StalkMesh;
use super::stance::{Posture, Settled};
use crate::document::Declared;
use crate::numeric::smooth_step;
use crate::shape::outline::Outline;
use crate::venation::network::{VeinSegment, VenationNetwork};
pub use course::Course;
use course::{Axis, Petiole};
use midrib::Midrib;
pub use section::Section;

/// Length of the joint in radii of the petiole, and its least and greatest share of the leaf's
/// length.
const JOINT_RADII: f64 = 14.0;
const JOINT_SHARE: [f64; 2] = [0.03, 0.2];
/// Number of pieces of the joint.
const JOINT_PIECES: usize = 24;
/// Radius of the tube's end over the lesser of its own and the vein's.
const END_RADIUS: f64 = 0.05;
/// Least distance, as a share of its radius, by which the tube at the base reaches beyond the ridge
/// of the midrib.
const BEYOND_RIDGE: f64 = 0.25;
/// Least radius at the base over the height of the ridge there, so that the tube encloses the end
/// of the blade from the ridge up.
const HOLDS: f64 = 0.75;
/// Share of the joint after which the tube has sunk, and the share of its diameter that is then
/// beyond the ridge: slightly more than all, so that nothing of it remains on the adaxial side.
const SUNK_AT: f64 = 0.9;
const SUNK: f64 = 1.02;
/// Length before the base, in radii, over which the tube adapts to the joint; at most half its
/// length.
const READY_RADII: f64 = 7.0;
/// Number of places on each side across the tube at which the relief is looked up.
const ACROSS: i32 = 4;
/// Length of the foot in radii.
const FOOT_RADII: f64 = 5.0;
/// Least number of pieces of a petiole, and the greatest angle between two of them, radians.
const PIECES: f64 = 12.0;
const PIECE_ANGLE: f64 = 0.06;
const MOST_PIECES: f64 = 240.0;

/// The parameters of a petiole.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct PetiolePlan {
    /// Length over the leaf's.
    #[key("length", required, 0.0..=10.0)]
    pub length: f64,
    /// Radius between its ends.
    ///
    /// Radius; `None` means that of the midrib at its base.
    #[key("radius_mm", 0.001..=100.0)]
    pub radius_mm: Option<f64>,
    /// Angle by which it has bent towards the abaxial side at its foot.
    #[key("curl_deg", degrees(-170.0..=170.0))]
    pub curl: f64,
    /// How its axis runs beside that.
    #[key(flat)]
    pub course: Course,
    /// Its form between both ends.
    #[key(flat)]
    pub section: Section,
}

/// A point of the tube before the base, in the frame of the base.
struct Station {
    at: DVec3,
    /// Direction across it.
    across: DVec3,
    radius: f64,
    /// How much of the section applies.
    share: f64,
}

/// How a tube goes.
#[derive(Clone, Copy)]
enum Way {
    /// Where the ground and the blade let it.
    Whole,
    /// Into the ground, out of which the leaf is then lifted.
    OverGround,
    /// Straight on, and before the base as deep as there: beside a leaf whose veins are thicker than
    /// its petiole is long, the stem cannot sink from its own depth to that of the joint.
    Rigid,
}

/// A mound before the base, over the distance from it in lengths of the tube's end: 0 at the base,
/// 1 at once that length, 0 from two and a half on.
fn swelling(back: f64) -> f64 {
    smooth_step(back / 0.8) * (1.0 - smooth_step((back - 1.2) / 1.3))
}

impl Default for PetiolePlan {
    /// A petiole of which nothing is said.
    fn default() -> Self {
        Self {
            length: 0.0,
            radius_mm: None,
            curl: 0.0,
            course: Course::STRAIGHT,
            section: Section::default(),
        }
    }
}

impl PetiolePlan {
    /// Checks every field.
    ///
    /// # Errors
    ///
    /// [`BladeError::Range`] for the first field outside its range.
    pub fn validate(&self) -> Result<(), BladeError> {
        Ok(self.in_range()?)
    }

    /// Its radius on a leaf with these veins, mm.
    pub fn radius_on(&self, outline: &Outline, network: &VenationNetwork) -> f64 {
        let midrib = || Midrib::new(outline, network, 0.0).radius;
        self.radius_mm.unwrap_or_else(midrib).max(1e-3)
    }

    /// The mesh of the petiole of a blade of this form, mm, including the joint.
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
        self.settled((outline, network), form, None, 0)
    }

    /// As [`PetiolePlan::build`], of the leaf of this seed, whose blade has come to lie as
    /// `settled` says.
    ///
    /// # Errors
    ///
    /// As [`PetiolePlan::build`].
    pub fn settled(
        &self,
        (outline, network): (&Outline, &VenationNetwork),
        form: &BladeForm,
        settled: Option<&Settled>,
        seed: u64,
    ) -> Result<StalkMesh, BladeError> {
        self.validate()?;
        form.validate()?;
        let leaf = outline.length();
        let midrib = Midrib::new(outline, network, JOINT_SHARE[1] * leaf);
        let radius = self.radius_mm.unwrap_or(midrib.radius).max(1e-3);
        let all: Vec<VeinSegment> = network.segments().collect();
        let relief = Relief::new(form, &form.major(&all));
        let posture = Posture::new(form, outline, (network.map(), &all), settled);
        if peltate::is_inside(outline, radius) {
            return Ok(self.peltate(outline, radius, &relief, &posture, seed));
        }
        let joint = Joint::new(radius, &midrib, relief, posture, leaf);
        let stem = self.stem(&joint, radius, leaf, seed);
        // A vein may have a kink, above all in a crumpled blade. Then the tube follows a straight
        // line instead; if that does not help, it leaves the ground; in the end it is straight.
        let straight = Midrib {
            nodes: Vec::new(),
            ..midrib
        };
        let attempts = [
            (&midrib, Way::Whole),
            (&straight, Way::Whole),
            (&midrib, Way::OverGround),
            (&straight, Way::OverGround),
        ];
        let found = attempts
            .into_iter()
            .find_map(|(midrib, way)| self.tube(&stem, &joint, midrib, way));
        Ok(found
            .or_else(|| self.tube(&stem, &joint, &straight, Way::Rigid))
            .expect("a smooth bend of a straight line has no kinks, and radii are above 0"))
    }

    /// The axis behind a base, from which it leads on against the second axis of `start`.
    fn axis(&self, leaf: f64, radius: f64, wilted: f64, start: DMat3, seed: u64) -> Axis {
        let thickest = 1.0 + self.section.foot.max(self.section.head);
        let petiole = Petiole {
            length: self.length * leaf,
            radius: radius * thickest,
            leaf,
            curl: self.curl,
            wilted,
            start,
            seed,
        };
        Axis::new(&self.course, &petiole)
    }

    /// Place and frame (columns across it, along it towards the blade, and to its adaxial side) of
    /// the foot of this petiole in the frame of a leaf of this length, mm, and seed, that does not
    /// wilt. A radius that is the midrib's counts as none: it limits how tightly a petiole bends.
    pub(crate) fn foot(&self, leaf: f64, seed: u64) -> (DVec3, DMat3) {
        let length = self.length * leaf;
        if length <= 1e-6 * leaf {
            return (DVec3::ZERO, DMat3::IDENTITY);
        }
        let radius = self.radius_mm.unwrap_or(1e-3);
        self.axis(leaf, radius, 0.0, DMat3::IDENTITY, seed)
            .at(length)
    }

    /// The tube up to the base, from its foot on.
    fn stem(&self, joint: &Joint<'_>, radius: f64, leaf: f64, seed: u64) -> Vec<Station> {
        let length = self.length * leaf;
        if length <= 1e-6 * leaf {
            return Vec::new();
        }
        let axis = self.axis(leaf, radius, joint.posture.sag(), DMat3::IDENTITY, seed);
        let foot = (FOOT_RADII * radius).min(length);
        let ready = (READY_RADII * joint.radius).min(0.5 * length);
        self.places(joint.posture.sag(), length, foot, ready)
            .into_iter()
            .map(|back| {
                let near = smooth_step(1.0 - back / ready);
                let own = radius * (1.0 + self.swollen(length - back, foot, back / ready));
                let (at, frame) = axis.at(back);
                Station {
                    at: at - DVec3::Z * (near * joint.depth),
                    across: frame.x_axis,
                    radius: own + (joint.radius - radius) * near,
                    share: 1.0 - near,
                }
            })
            .collect()
    }

    /// How much thicker it is, over its radius, at a distance from the foot, and from the base in
    /// lengths of the tube's end.
    fn swollen(&self, from_foot: f64, foot: f64, from_base: f64) -> f64 {
        self.section.foot * (1.0 - smooth_step(from_foot / foot))
            + self.section.head * swelling(from_base)
    }

    /// The tube along stem and joint, unless it has a kink.
    fn tube(
        &self,
        stem: &[Station],
        joint: &Joint<'_>,
        midrib: &Midrib,
        way: Way,
    ) -> Option<StalkMesh> {
        let (base, frame) = joint.posture.base();
        let lies = joint.posture.on_ground() && matches!(way, Way::Whole);
        let end: Vec<(DVec3, f64)> = (0..=JOINT_PIECES)
            .map(|i| {
                let t = i as f64 / JOINT_PIECES as f64;
                let (point, radius) = joint.at(midrib, t);
                if matches!(way, Way::Rigid) {
                    let along = DVec3::new(0.0, joint.length * t, -joint.depth);
                    (base + frame * along, radius)
                } else {
                    (point, radius)
                }
            })
            .collect();
        // The leaf is lifted until its joint is out of the ground, and the stem with it: held above
        // the ground as it is now, the stem would have a step before the joint.
        let below = |(point, radius): &(DVec3, f64)| point.z - radius;
        let ground = end.iter().map(below).fold(0.0, f64::min);
        let (mut points, mut radii, mut sections) = (Vec::new(), Vec::new(), Vec::new());
        for station in stem {
            let mut at = base + frame * station.at;
            if matches!(way, Way::Rigid) {
                at -= frame * DVec3::Z * (station.share * joint.depth);
            }
            if lies {
                at.z = at.z.max(ground + station.radius);
            }
            points.push(at);
            radii.push(station.radius);
            sections.push((station.share, frame * station.across));
        }
        for (point, radius) in end {
            points.push(point);
            radii.push(radius);
            sections.push((0.0, frame.x_axis));
        }
        let mut tube = StalkMesh::tube(&points, &radii).ok()?;
        self.section.shape(&mut tube, &points, &sections);
        Some(tube)
    }

    /// Distances from the base of the points of the tube before the joint, from the foot on: evenly
    /// spaced, and denser where the radius changes.
    fn places(&self, wilted: f64, length: f64, foot: f64, ready: f64) -> Vec<f64> {
        let course = &self.course;
        // A neck bends by its whole angle in a part of the length.
        let bends = [
            self.curl,
            course.sag,
            wilted,
            course.sway,
            course.twist,
            course.neck / course.neck_length,
            4.0 * course.stray,
        ];
        let bent: f64 = bends.iter().map(|angle| angle.abs()).sum();
        let pieces = (bent / PIECE_ANGLE).ceil().clamp(PIECES, MOST_PIECES);
        let mut backs: Vec<f64> = (1..=pieces as u32)
            .map(|i| length * f64::from(i) / pieces)
            .collect();
        let closer = |share: f64| [length - foot * share, ready * share];
        backs.extend((1..=6).flat_map(|i| closer(f64::from(i) / 6.0)));
        if self.section.head > 0.0 {
            backs.extend(
                (7..=15)
                    .map(|i| ready * f64::from(i) / 6.0)
                    .filter(|&back| back < length),
            );
        }
        backs.sort_by(|a, b| b.total_cmp(a));
        // Points at the base itself belong to the joint.
        backs.retain(|&back| back > 0.01 * ready);
        backs.dedup_by(|next, kept| *kept - *next < 0.02 * ready.min(foot));
        backs
    }
}

/// The joint: the part of the tube beyond the base.
struct Joint<'s> {
    /// Radius at the base.
    radius: f64,
    /// Depth of the axis at the base, towards the abaxial side.
    depth: f64,
    /// Share of the diameter at the base that is beyond the ridge.
    beyond: f64,
    end: f64,
    length: f64,
    relief: Relief,
    posture: Posture<'s>,
}

impl<'s> Joint<'s> {
    /// The joint of a petiole with this radius.
    fn new(radius: f64, midrib: &Midrib, relief: Relief, posture: Posture<'s>, leaf: f64) -> Self {
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
            posture,
        }
    }

    /// Axis and radius at a share of its length.
    fn at(&self, midrib: &Midrib, t: f64) -> (DVec3, f64) {
        let (p, _) = midrib.at(self.length * t);
        let radius = self.end + (self.radius - self.end) * (1.0 - smooth_step(t));
        let beyond = self.beyond + (SUNK - self.beyond) * smooth_step(t / SUNK_AT);
        let depth = if t > 0.0 {
            ridge(&self.relief, p, radius) + radius * (2.0 * beyond - 1.0)
        } else {
            self.depth
        };
        (self.posture.place(p, -depth), radius)
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
