//! A surface that grows while its cells divide.

use glam::DVec3;

use super::error::MosaicError;
use crate::document::ranges::RangeError;

/// Whether and how the surface grows.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum SurfaceGrowth {
    /// It has its final size from the start. Cells divide at the rates of their types and crowd.
    #[default]
    None,
    /// It grows along each axis from a share of its final size to that size. Cells keep their
    /// places in the tissue and their area. A region has as many divisions as its growth makes room
    /// for; they are shared among its cells in proportion to the rates of their types.
    Anisotropic {
        /// Size along x, y and z at the start over the final size, 0.01 to 10.
        start: DVec3,
        /// The course of growth.
        course: GrowthCourse,
    },
}

/// How the size goes from its start to its final value over the days of the plan.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum GrowthCourse {
    /// Evenly.
    #[default]
    Linear,
    /// Slowly, fast, slowly.
    Logistic {
        /// When growth is fastest, as a share of the days, 0 to 1.
        middle: f64,
        /// Steepness, 1 to 100: the rate of the logistic function over all days.
        steepness: f64,
    },
}

impl GrowthCourse {
    /// Share of growth done after a share of the days: rises from 0 at 0 to 1 at 1.
    pub fn done(&self, share: f64) -> f64 {
        let share = share.clamp(0.0, 1.0);
        match *self {
            Self::Linear => share,
            Self::Logistic { middle, steepness } => {
                let at = |x: f64| 1.0 / (1.0 + libm::exp(-steepness * (x - middle)));
                ((at(share) - at(0.0)) / (at(1.0) - at(0.0))).clamp(0.0, 1.0)
            }
        }
    }
}

impl SurfaceGrowth {
    pub(super) fn validate(&self) -> Result<(), MosaicError> {
        let Self::Anisotropic { start, course } = *self else {
            return Ok(());
        };
        for (axis, value) in ["x", "y", "z"].iter().zip(start.to_array()) {
            let (good, path) = (
                (0.01..=10.0).contains(&value),
                format!("size at the start along {axis}"),
            );
            RangeError::unless(good, &path, value, "0.01 to 10")?;
        }
        if let GrowthCourse::Logistic { middle, steepness } = course {
            let good = (0.0..=1.0).contains(&middle);
            RangeError::unless(good, "middle of growth", middle, "0 to 1")?;
            let good = (1.0..=100.0).contains(&steepness);
            RangeError::unless(good, "steepness of growth", steepness, "1 to 100")?;
        }
        Ok(())
    }

    /// Size over final size along each axis after a share of the days; `None` if the surface does
    /// not grow.
    pub(super) fn size(&self, share: f64) -> Option<DVec3> {
        match self {
            Self::None => None,
            Self::Anisotropic { start, course } => Some(start.lerp(DVec3::ONE, course.done(share))),
        }
    }
}
