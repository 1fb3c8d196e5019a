//! Secondary veins that are laid out, and what goes with them.

use glam::DVec2;

use crate::venation::architecture::course::{Axis, Course};
use crate::venation::architecture::ground::Ground;
use crate::venation::architecture::margin::Hit;

/// A secondary vein to be laid out.
#[derive(Clone, Debug)]
pub(crate) struct Secondary {
    /// Its course.
    pub(crate) course: Course,
    /// The number of the primary that it leaves, or of the secondary if it is an agrophic vein.
    pub(crate) axis: usize,
    /// On which side of it: 1 the right, −1 the left.
    pub(crate) side: f64,
}

/// What secondaries there are, and what goes with them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Laid {
    /// Order 2.
    pub(crate) veins: Vec<Secondary>,
    /// Agrophic veins, which leave some of them.
    pub(crate) agrophic: Agrophics,
    /// Intersecondaries, and branches that run from arches into teeth.
    pub(crate) finer: Vec<Course>,
}

/// The blade and its primaries.
#[derive(Clone, Copy)]
pub(crate) struct Site<'s> {
    /// Full-grown, in segments.
    pub(crate) ground: Ground<'s>,
    /// Its primaries, the midrib first.
    pub(crate) axes: &'s [Axis],
}

/// One vein while its place is settled.
pub(super) struct Draft {
    /// Place on the axis, share of its length.
    pub(super) share: f64,
    /// Angle of the chord to the axis, radians.
    pub(super) angle: f64,
    pub(super) hit: Hit,
    pub(super) tip: Option<DVec2>,
}

/// Agrophic veins, each with the number of the secondary that bears it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Agrophics {
    /// The veins; their axis is the number of the bearing secondary.
    pub(crate) veins: Vec<Secondary>,
}

impl Agrophics {
    /// How many veins the poorest comb has of those asked for.
    pub(crate) fn poorest(&self, bearers: &[usize]) -> usize {
        let of = |&bearer: &usize| self.veins.iter().filter(|v| v.axis == bearer).count();
        bearers.iter().map(of).min().unwrap_or(0)
    }
}
