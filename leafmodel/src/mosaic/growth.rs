//! A surface that grows while its cells divide.

use glam::DVec3;

use crate::document::{Declared, Keys};

/// How the surface grows.
///
/// It grows along each axis from a share of its final size to that size. Cells keep their places in
/// the tissue and their area. A region has as many divisions as its growth makes room for; they are
/// shared among its cells in proportion to the rates of their types.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
#[key(last = whole_course)]
pub struct SurfaceGrowth {
    /// Size at the start over the final size, along x, y and z.
    #[key("start", required, 0.01..=10.0)]
    pub start: DVec3,
    /// Days in which it reaches its final size; left out, those of the mosaic. Of a mosaic of fewer days the young surface is
    /// shown, enlarged to that size.
    #[key("days", above(0.0, 100_000.0))]
    pub days: Option<f64>,
    /// When growth is fastest, as a share of the days; 0.5 beside a steepness.
    #[key("middle", 0.0..=1.0)]
    pub middle: Option<f64>,
    /// How sudden it is; 8 beside a middle.
    ///
    /// The rate of the logistic function over all days. Without both growth is even.
    #[key("steepness", 1.0..=100.0)]
    pub steepness: Option<f64>,
}

impl Default for SurfaceGrowth {
    fn default() -> Self {
        Self {
            start: DVec3::ONE,
            days: None,
            middle: None,
            steepness: None,
        }
    }
}

/// Gives each number of a logistic course its default where only the other is said.
fn whole_course(growth: &mut SurfaceGrowth, _: &mut Keys<'_>) {
    if growth.middle.is_some() || growth.steepness.is_some() {
        growth.middle.get_or_insert(0.5);
        growth.steepness.get_or_insert(8.0);
    }
}

impl SurfaceGrowth {
    /// Share of growth done after a share of the days: rises from 0 at 0 to 1 at 1.
    pub fn done(&self, share: f64) -> f64 {
        let share = share.clamp(0.0, 1.0);
        let (Some(middle), Some(steepness)) = (self.middle, self.steepness) else {
            return share;
        };
        let at = |x: f64| 1.0 / (1.0 + libm::exp(-steepness * (x - middle)));
        ((at(share) - at(0.0)) / (at(1.0) - at(0.0))).clamp(0.0, 1.0)
    }

    /// Size over final size along each axis on a day of a mosaic of so many days.
    pub(super) fn size(&self, day: f64, days: f64) -> DVec3 {
        let days = self.days.unwrap_or(days);
        let share = if days > 0.0 { day / days } else { 1.0 };
        self.start.lerp(DVec3::ONE, self.done(share))
    }
}
