//! The loop of section 3.3: the lamina grows, sources appear, veins grow towards them, sources
//! are used up.
//!
//! Within a step everything is decided from the state at the step's beginning and in the order of
//! numbers, so that neither the order of work nor the number of threads could show.

use glam::DVec2;

use super::auxin::Darts;
use super::fresh_nodes::FreshNodes;
use super::influence::{Fate, Influence, Surroundings};
use super::lamina_clock::LaminaClock;
use super::network::Ending;
use super::plan::{Growth, VenationPlan};
use super::point_tree::PointTree;
use super::veins::{COINCIDENT, Veins, can_reach};
use crate::shape::outline::Outline;

/// Steps after which a source none of whose nodes can grow is given up, and after which, with
/// the lamina full-grown and no vein growing, all is over.
pub(crate) const PATIENCE: u32 = 3;

/// Below this length the sum of unit vectors has no direction worth following.
pub(crate) const NO_DIRECTION: f64 = 1e-9;

/// What a driven node came to.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Outcome {
    /// This child.
    Child(u32),
    /// None: it would fall upon a node that is there, or the pulls cancel.
    Blocked,
    /// None: the way there would leave the blade. Another vein may still come, so this is no reason to give up.
    OffBlade,
}

struct Source<I> {
    place: DVec2,
    id: u32,
    influence: I,
    blocked_steps: u32,
}

/// A venation simulation under way, in the frame of [`super::lamina_clock`].
pub(crate) struct Simulation<'a, I> {
    plan: &'a VenationPlan,
    blade: &'a Outline,
    seed: u64,
    clock: LaminaClock,
    darts: Darts,
    /// The network so far.
    pub(crate) veins: Veins,
    sources: Vec<Source<I>>,
    source_tree: PointTree,
    /// Nodes that all sources have noticed.
    noticed: u32,
    /// Sources that have appeared.
    pub(crate) sources_born: u32,
    /// Steps done.
    pub(crate) step: u32,
    idle_steps: u32,
    darts_in_vain: f64,
    pulls: Vec<DVec2>,
    is_driven: Vec<bool>,
}

impl<'a, I: Influence> Simulation<'a, I> {
    /// Before the first step: one node at the base.
    pub(crate) fn new(
        plan: &'a VenationPlan,
        blade: &'a Outline,
        clock: LaminaClock,
        seed: u64,
    ) -> Self {
        let (low, high) = blade.bounds();
        let stretching = matches!(plan.growth, Growth::Isogonic { .. });
        let mut veins = Veins::new(low, high, stretching);
        veins.add_node(DVec2::ZERO, 0);
        Self {
            plan,
            blade,
            seed,
            darts: Darts::new(plan, blade, &clock, seed),
            clock,
            veins,
            sources: Vec::new(),
            source_tree: PointTree::new(low, high),
            noticed: 1,
            sources_born: 0,
            step: 0,
            idle_steps: 0,
            darts_in_vain: 0.0,
            pulls: Vec::new(),
            is_driven: Vec::new(),
        }
    }

    /// Steps until nothing is left to do.
    pub(crate) fn run(&mut self) -> Ending {
        let growth = f64::from(self.clock.last_growth_step());
        // Far beyond what a vein needs to cross the leaf; only a pattern that never settles gets there.
        let limit = (growth + 1000.0 + 50.0 * self.plan.final_length) as u32;
        while self.step < limit {
            let grown = self.advance();
            self.idle_steps = if grown == 0 { self.idle_steps + 1 } else { 0 };
            let nothing_new = !self.clock.stage(self.step - 1).still_growing && self.is_saturated();
            if nothing_new && (self.sources.is_empty() || self.idle_steps >= PATIENCE) {
                return Ending::Settled;
            }
        }
        Ending::StepLimit
    }

    /// Whether no further source can be expected on a full-grown lamina: after growth there are no darts,
    /// and without growth so many have missed in a row that a free spot is unlikely.
    fn is_saturated(&self) -> bool {
        match self.plan.growth {
            Growth::Marginal { .. } | Growth::Isogonic { .. } | Growth::Anisotropic { .. } => true,
            Growth::None => {
                let spacing = self
                    .plan
                    .source_birth_distance
                    .min(self.plan.vein_birth_distance);
                self.darts_in_vain > 8.0 * self.blade.area() / (spacing * spacing) + 100.0
            }
        }
    }

    /// One step; gives the number of veins that grew.
    pub(crate) fn advance(&mut self) -> usize {
        let stage = self.clock.stage(self.step);
        self.veins.subdivide(stage.unit, self.blade, self.step);
        self.notice();
        self.add_sources(stage.unit);
        let driven = self.gather_pulls();
        let outcomes = self.grow_veins(&driven, stage.unit);
        let grown = outcomes
            .iter()
            .filter(|(_, outcome)| matches!(outcome, Outcome::Child(_)))
            .count();
        self.tell_sources(&outcomes);
        self.notice();
        self.judge_sources(stage.unit);
        self.step += 1;
        grown
    }

    /// Lets every source take in the nodes since the last time.
    fn notice(&mut self) {
        let fresh = FreshNodes::new(&self.veins.positions, self.noticed);
        if !fresh.is_empty() {
            let surroundings = Surroundings {
                tree: &self.veins.tree,
                seed: self.seed,
            };
            for source in &mut self.sources {
                source.influence.notice(&fresh, &surroundings);
            }
        }
        self.noticed = self.veins.count();
    }

    /// New sources, where darts hit the blade far enough from sources and veins.
    fn add_sources(&mut self, unit: f64) {
        let from_sources = self.plan.source_birth_distance * unit;
        let from_veins = self.plan.vein_birth_distance * unit;
        for dart in self.darts.of_step(self.step, unit, self.seed) {
            if !self.blade.contains(dart) {
                continue;
            }
            if self.source_tree.any_within(dart, from_sources)
                || self.veins.tree.any_within(dart, from_veins)
            {
                self.darts_in_vain += 1.0;
                continue;
            }
            self.darts_in_vain = 0.0;
            let id = self.sources_born;
            self.sources_born += 1;
            self.source_tree.insert(id, dart);
            let surroundings = Surroundings {
                tree: &self.veins.tree,
                seed: self.seed,
            };
            self.sources.push(Source {
                place: dart,
                id,
                influence: I::new(dart, id, &surroundings),
                blocked_steps: 0,
            });
        }
    }

    /// Adds up, for each driven node, the unit vectors to its sources (Eq. 1); gives the driven
    /// nodes by number.
    fn gather_pulls(&mut self) -> Vec<u32> {
        let count = self.veins.positions.len();
        self.pulls.resize(count, DVec2::ZERO);
        self.is_driven.resize(count, false);
        let mut driven = Vec::new();
        let (pulls, is_driven) = (&mut self.pulls, &mut self.is_driven);
        for source in &self.sources {
            source.influence.each_driven(|node| {
                let i = node as usize;
                if !is_driven[i] {
                    is_driven[i] = true;
                    driven.push(node);
                }
                let way = source.place - self.veins.positions[i];
                let length = way.length();
                if length > 0.0 {
                    pulls[i] += way / length;
                }
            });
        }
        driven.sort_unstable();
        driven
    }

    /// Places a child for each driven node, where there is room; gives what came of each node.
    fn grow_veins(&mut self, driven: &[u32], unit: f64) -> Vec<(u32, Outcome)> {
        let place_one = |&node: &u32| {
            let i = node as usize;
            let pull = std::mem::take(&mut self.pulls[i]);
            self.is_driven[i] = false;
            let length = pull.length();
            if length < NO_DIRECTION {
                return (node, Outcome::Blocked);
            }
            let child = self.veins.positions[i] + pull / length * unit;
            if !can_reach(self.blade, self.veins.positions[i], child) {
                return (node, Outcome::OffBlade);
            }
            if self.veins.tree.any_within(child, COINCIDENT * unit) {
                return (node, Outcome::Blocked);
            }
            let id = self.veins.add_node(child, self.step);
            self.veins.add_edge(node, id);
            (node, Outcome::Child(id))
        };
        driven.iter().map(place_one).collect()
    }

    /// Hands tags on to children, and counts the steps in which a source moved nothing.
    fn tell_sources(&mut self, outcomes: &[(u32, Outcome)]) {
        let outcome_of = |node: u32| {
            outcomes
                .binary_search_by_key(&node, |&(node, _)| node)
                .map_or(Outcome::Blocked, |i| outcomes[i].1)
        };
        let mut children = Vec::new();
        for source in &mut self.sources {
            let mut all_blocked = true;
            children.clear();
            source.influence.each_driven(|node| match outcome_of(node) {
                Outcome::Child(child) => {
                    all_blocked = false;
                    children.push((node, child));
                }
                Outcome::OffBlade => all_blocked = false,
                Outcome::Blocked => {}
            });
            for &(parent, child) in &children {
                source.influence.inherit(parent, child);
            }
            source.blocked_steps = if all_blocked {
                source.blocked_steps + 1
            } else {
                0
            };
        }
    }

    /// Removes used-up sources and joins the veins that have met there.
    fn judge_sources(&mut self, unit: f64) {
        let kill = self.plan.kill_distance * unit;
        let mut used_up = Vec::new();
        let source_tree = &mut self.source_tree;
        self.sources.retain_mut(|source| {
            let arrivals = match source.influence.judge(kill) {
                Fate::UsedUp(arrivals) => arrivals,
                Fate::Stays if source.blocked_steps >= PATIENCE => source.influence.give_up(),
                Fate::Stays => return true,
            };
            source_tree.remove(source.id, source.place);
            used_up.push((source.place, arrivals));
            false
        });
        for (place, arrivals) in used_up {
            self.veins
                .weld(place, &arrivals, unit, self.blade, self.step);
        }
    }
}
