//! The lamina on which veins grow: its margin, and the length of a segment at each place.
//!
//! A flat lamina has the same unit of length everywhere. On a curved blade, veins grow in its
//! conformal map ([`super::conformal_map`]): segments, birth and kill distances are multiplied by
//! the map's enlargement at the place.

use glam::DVec2;

use super::conformal_map::ConformalMap;
use super::plan::AuxinPlan;
use crate::plane::bounds;
use crate::shape::growth::TissueMap;
use crate::shape::outline::Outline;

/// The blade in the frame of [`super::lamina_clock`].
#[derive(Clone, Debug)]
pub(crate) struct Lamina<'a> {
    /// The full-grown margin, in segments.
    pub(crate) blade: &'a Outline,
    /// For anisotropic growth, the tissue maps at this step and at the end.
    carried: Option<(TissueMap, TissueMap)>,
    /// The conformal map of the blade.
    map: ConformalMap,
    /// The smallest upright rectangle around the blade at this step.
    bounds: (DVec2, DVec2),
}

impl<'a> Lamina<'a> {
    /// The lamina of a plan, with the map of the full-grown leaf if its tissue moves.
    pub(crate) fn new(plan: &AuxinPlan, blade: &'a Outline, last: Option<TissueMap>) -> Self {
        let length = plan.final_length;
        Self {
            blade,
            carried: last.map(|last| (last.clone(), last)),
            map: ConformalMap::new(
                plan.gaussian_curvature / (length * length),
                (blade.base() + blade.apex()) * 0.5,
            ),
            bounds: blade.bounds(),
        }
    }

    /// Moves the tissue to its places in `now`.
    pub(crate) fn carry(&mut self, now: TissueMap) {
        if let Some((current, _)) = &mut self.carried {
            *current = now;
            self.bounds = bounds(self.margin_now());
        }
    }

    /// Where the tissue now at `p` started; `p` itself if tissue does not move.
    pub(crate) fn start_of(&self, p: DVec2) -> DVec2 {
        self.carried.as_ref().map_or(p, |(now, _)| now.back(p))
    }

    /// The present place of the tissue that started at `start`.
    pub(crate) fn now_at(&self, start: DVec2) -> DVec2 {
        self.carried
            .as_ref()
            .map_or(start, |(now, _)| now.forward(start))
    }

    /// Where the tissue now at `p` will be in the full-grown leaf. Whether a place is on the blade
    /// is decided in the full-grown leaf, so that nothing can leave the blade as it grows.
    pub(crate) fn full_grown(&self, p: DVec2) -> DVec2 {
        self.carried
            .as_ref()
            .map_or(p, |(now, last)| last.forward(now.back(p)))
    }

    /// The present place of the tissue that will be at `p` in the full-grown leaf.
    pub(crate) fn now_of_full_grown(&self, p: DVec2) -> DVec2 {
        self.carried
            .as_ref()
            .map_or(p, |(now, last)| now.forward(last.back(p)))
    }

    /// The margin at this step.
    pub(crate) fn margin_now(&self) -> Vec<DVec2> {
        let margin = self.blade.points().iter();
        margin.map(|&p| self.now_of_full_grown(p)).collect()
    }

    /// Lower left and upper right corner of the smallest upright rectangle around the blade at this
    /// step.
    pub(crate) fn bounds_now(&self) -> (DVec2, DVec2) {
        self.bounds
    }

    /// Corners of a rectangle that holds everything on the blade at this step. If tissue moves,
    /// straight edges of the full-grown margin bulge between their corners, which
    /// [`Self::bounds_now`] does not account for.
    pub(crate) fn room(&self) -> (DVec2, DVec2) {
        let (low, high) = self.bounds;
        let spare = match self.carried {
            Some(_) => 0.1 * (high - low),
            None => DVec2::ZERO,
        };
        (low - spare, high + spare)
    }

    /// Whether tissue moves.
    pub(crate) fn moves(&self) -> bool {
        self.carried.is_some()
    }

    /// Whether `p` is on the blade.
    pub(crate) fn contains(&self, p: DVec2) -> bool {
        self.blade.contains(self.full_grown(p))
    }

    /// Whether a straight vein from a node at `from` to `to` stays on the blade. An origin may lie
    /// on the margin, after rounding on either side of it, so the first millionth of the line is
    /// ignored.
    pub(crate) fn can_reach(&self, from: DVec2, to: DVec2) -> bool {
        let (from, to) = (self.full_grown(from), self.full_grown(to));
        self.blade.contains(to) && !self.blade.is_crossed_by(from + (to - from) * 1e-6, to)
    }

    /// Distance from `p` to the margin, both in the full-grown leaf.
    pub(crate) fn distance_to_margin(&self, p: DVec2) -> f64 {
        self.blade.distance_to_margin(self.full_grown(p))
    }

    /// Whether the blade has no curvature.
    pub(crate) fn is_flat(&self) -> bool {
        self.map.is_flat()
    }

    /// Factor on the number of darts that allows for the rejection of darts on a curved blade, ≥ 1:
    /// the greatest ratio of true area to area in the map.
    pub(crate) fn surplus(&self) -> f64 {
        let (low, high) = self.bounds;
        let smallest = [
            low,
            high,
            DVec2::new(low.x, high.y),
            DVec2::new(high.x, low.y),
        ]
        .map(|corner| self.enlargement(corner))
        .into_iter()
        .fold(1.0, f64::min);
        1.0 / (smallest * smallest)
    }

    /// Lengths in the map over true lengths at `p`, > 0; 1 on a flat blade.
    pub(crate) fn enlargement(&self, p: DVec2) -> f64 {
        self.map.enlargement(p)
    }
}
