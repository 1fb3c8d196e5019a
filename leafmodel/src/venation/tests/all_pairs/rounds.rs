//! The oracle's darts thrown beforehand and its sources for arches.

use glam::DVec2;

use super::{Oracle, apart};
use crate::random::Use;
use crate::venation::arches;
use crate::venation::auxin::{appearance, dart, waiting_darts};
use crate::venation::lamina_clock::LaminaClock;
use crate::venation::plan::{FreeEndings, Growth, Pattern};
use crate::venation::simulation::PATIENCE;

impl Oracle<'_> {
    /// Lays out secondaries that meet in arches, before the lamina grows.
    pub(super) fn lay_out_arches(&mut self, clock: &LaminaClock) {
        let Some(rule) = self.plan.margin_clearance else {
            return;
        };
        if rule.arches == 0 {
            return;
        }
        let scale = match self.plan.growth {
            Growth::Marginal { .. } => clock.size(0),
            Growth::None | Growth::Isogonic { .. } | Growth::Anisotropic { .. } => 1.0,
        };
        let margin: Vec<DVec2> = self
            .lamina
            .margin_now()
            .iter()
            .map(|&p| p * scale)
            .collect();
        let apex = self.lamina.now_of_full_grown(self.lamina.blade.apex()) * scale;
        let unit = clock.stage(0).unit;
        let rounds = arches::rounds(&rule, &margin, DVec2::ZERO, apex, self.seed);
        let (last, pattern) = (rounds.len() - 1, self.plan.pattern);
        for (number, round) in rounds.into_iter().enumerate() {
            self.plan.pattern = if number < last {
                Pattern::Open
            } else {
                pattern
            };
            for place in round {
                if self.lamina.contains(place) {
                    self.add_source(place);
                }
            }
            let (first, mut idle) = (self.step, 0);
            let most = 1000 + (50.0 * self.plan.final_length) as u32;
            while self.step < first + most && !self.sources.is_empty() && idle < PATIENCE {
                idle = if self.advance(unit, 0.0, &[]) {
                    0
                } else {
                    idle + 1
                };
                self.remember(clock, 0);
            }
            self.sources.clear();
        }
    }

    /// For marginal growth, all candidates with the step of their appearance.
    pub(super) fn candidates(&self, clock: &LaminaClock) -> Option<Vec<(u32, DVec2)>> {
        if !matches!(self.plan.growth, Growth::Marginal { .. }) {
            return None;
        }
        let mut kept: Vec<DVec2> = Vec::new();
        let count = waiting_darts(&self.plan, &self.lamina, clock.last_growth_step());
        for number in 0..count as u64 {
            let Some(dart) = dart([Use::DartX, Use::DartY], self.seed, number, &self.lamina) else {
                continue;
            };
            let spacing = self.plan.source_birth_distance * self.lamina.enlargement(dart);
            if kept.iter().all(|&p| apart(dart, p, spacing)) {
                kept.push(dart);
            }
        }
        kept.retain(|&dart| self.lamina.contains(dart));
        let appear = |dart| (appearance(self.lamina.blade.points(), clock, dart), dart);
        Some(kept.into_iter().map(appear).collect())
    }

    /// The darts of the last round.
    pub(super) fn free_darts(&self, free: &FreeEndings) -> Vec<(u32, DVec2)> {
        let (low, high) = self.lamina.bounds_now();
        let area = (high - low).x * (high - low).y * self.lamina.surplus();
        let uses = [Use::FreeDartX, Use::FreeDartY];
        (0..(free.darts_per_area * area) as u64)
            .filter_map(|number| dart(uses, self.seed, number, &self.lamina))
            .map(|dart| (0, dart))
            .collect()
    }
}
