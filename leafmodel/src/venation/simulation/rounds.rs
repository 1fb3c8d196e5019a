//! Rounds before and after the loop: arches, and free veinlet endings.

use glam::DVec2;

use super::{PATIENCE, Simulation};
use crate::venation::arches;
use crate::venation::auxin::Darts;
use crate::venation::influence::Influence;
use crate::venation::lamina_clock::LaminaClock;
use crate::venation::open::NearestNode;
use crate::venation::plan::{AuxinPlan, FreeEndings, Growth};

impl<'a, I: Influence> Simulation<'a, I> {
    /// Runs the last round, in which free-ending veinlets grow, by the plan `rest`.
    pub(crate) fn with_free_endings<'b>(
        self,
        rest: &'b AuxinPlan,
        free: &FreeEndings,
    ) -> Simulation<'b, NearestNode>
    where
        'a: 'b,
    {
        let darts = Darts::at_once(free, &self.lamina, self.seed);
        let clock = LaminaClock::new(rest).expect("nothing grows any more");
        let mut veins = self.veins;
        veins.stop_stretching();
        let mut simulation = Simulation::resume(rest, self.lamina, clock, self.seed, veins, darts);
        simulation.step = self.step;
        simulation.first_step = self.step;
        simulation.sources_born = self.sources_born;
        simulation
    }

    /// Before the lamina grows: lets sources at `places` draw veins until they are used up, and
    /// calls `look` after each step.
    pub(crate) fn lay_out(&mut self, places: &[DVec2], mut look: impl FnMut(&Self) -> bool) {
        self.is_laying_out = true;
        let unit = self.clock.stage(0).unit;
        self.notice(unit);
        let near = self.nearness(unit);
        for &place in places {
            if self.lamina.contains(place) {
                self.add_source(place, near);
            }
        }
        // Far more than a vein needs to cross the young leaf.
        let end = self.step + 1000 + (50.0 * self.plan.final_length) as u32;
        let mut idle = 0;
        while self.step < end && !self.sources.is_empty() && idle < PATIENCE {
            idle = if self.advance() == 0 { idle + 1 } else { 0 };
            if !look(self) {
                break;
            }
        }
        let source_tree = &mut self.source_tree;
        self.sources
            .drain(|id, place| source_tree.remove(id, place));
        self.is_laying_out = false;
        self.first_step = self.step;
    }

    /// The rounds of sources that lay out arches, if the plan asks for them.
    pub(crate) fn arch_rounds(&self) -> Vec<Vec<DVec2>> {
        match self.plan.margin_clearance {
            Some(rule) if rule.arches > 0 => {
                let (margin, apex) = self.young_margin();
                arches::rounds(&rule, &margin, DVec2::ZERO, apex, self.seed)
            }
            Some(_) | None => Vec::new(),
        }
    }

    /// The same veins with another rule for sources; present sources are discarded.
    pub(crate) fn under<J: Influence>(self) -> Simulation<'a, J> {
        let (lamina, clock) = (self.lamina, self.clock);
        let mut simulation =
            Simulation::resume(self.plan, lamina, clock, self.seed, self.veins, self.darts);
        simulation.step = self.step;
        simulation.first_step = self.first_step;
        simulation.sources_born = self.sources_born;
        simulation
    }

    /// The young leaf's margin and apex, in the frame of the simulation.
    fn young_margin(&self) -> (Vec<DVec2>, DVec2) {
        // Only under marginal growth does the margin move in the frame.
        let scale = match self.plan.growth {
            Growth::Marginal { .. } => self.clock.size(0),
            Growth::None | Growth::Isogonic { .. } | Growth::Anisotropic { .. } => 1.0,
        };
        let margin = self.lamina.margin_now().into_iter().map(|p| p * scale);
        let apex = self.lamina.now_of_full_grown(self.lamina.blade.apex()) * scale;
        (margin.collect(), apex)
    }
}
