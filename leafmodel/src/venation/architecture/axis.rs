//! A vein that secondaries leave: the midrib or a lateral primary.

use glam::DVec2;

use super::course::Course;

/// A primary vein.
#[derive(Clone, Debug)]
pub(crate) struct Axis {
    /// Its course.
    pub(crate) course: Course,
    /// On which side of the midrib it lies: 1 the right, −1 the left, 0 the midrib.
    pub(crate) side: f64,
    /// 0 the midrib, then one more than the primary that it leaves.
    pub(crate) generation: u32,
}

impl Axis {
    pub(crate) fn new(course: Course, side: f64, generation: u32) -> Self {
        Self {
            course,
            side,
            generation,
        }
    }

    /// Where it is at a share of its length, and its direction over a tenth of it.
    pub(crate) fn at(&self, share: f64) -> (DVec2, DVec2) {
        let (place, _) = self.course.at(share);
        let (before, _) = self.course.at(share - 0.05);
        let (after, _) = self.course.at(share + 0.05);
        (place, (after - before).normalize_or_zero())
    }
}
