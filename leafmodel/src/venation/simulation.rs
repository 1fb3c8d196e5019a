//! The loop of section 3.3: the lamina grows, sources appear, veins grow towards them, sources
//! are used up.
//!
//! Within a step everything is decided from the state at the step's beginning and in the order of
//! numbers, so that neither the order of work nor the number of threads could show.

mod rounds;

use glam::DVec2;

use super::Grown;
use super::auxin::Darts;
use super::fresh_nodes::FreshNodes;
use super::influence::{Fate, Influence, Surroundings};
use super::lamina::Lamina;
use super::lamina_clock::LaminaClock;
use super::network::Ending;
use super::plan::{AuxinPlan, Growth};
use super::point_tree::PointTree;
use super::veins::{COINCIDENT, Veins};

/// Steps after which a source none of whose nodes can grow is given up, and after which, with
/// the lamina full-grown and no vein growing, all is over.
pub(crate) const PATIENCE: u32 = 3;

/// Below this length the sum of unit vectors has no direction worth following.
pub(crate) const NO_DIRECTION: f64 = 1e-9;

/// How near to an origin, in segments, veins turn aside at the margin.
pub(crate) const TURNING: f64 = 12.0;

/// The ways next to one that leaves the blade, those that turn least first, up to a right angle.
pub(crate) fn turned(straight: DVec2) -> impl Iterator<Item = DVec2> {
    (1..=6).flat_map(move |k| {
        let (sin, cos) = libm::sincos(f64::from(k) * 15.0_f64.to_radians());
        [sin, -sin].map(|sin| DVec2::new(cos, sin).rotate(straight))
    })
}

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
    /// Where its tissue started.
    start: DVec2,
    id: u32,
    influence: I,
    blocked_steps: u32,
}

/// A venation simulation under way, in the frame of [`super::lamina_clock`].
pub(crate) struct Simulation<'a, I> {
    plan: &'a AuxinPlan,
    pub(crate) lamina: Lamina<'a>,
    seed: u64,
    clock: LaminaClock,
    darts: Darts,
    /// The network so far.
    pub(crate) veins: Veins,
    sources: Vec<Source<I>>,
    source_tree: PointTree,
    /// How many nodes were there at the start.
    origins: u32,
    /// The step in which the lamina starts to grow; arches are laid out before.
    first_step: u32,
    /// Whether arches are being laid out.
    is_laying_out: bool,
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
    /// Before the first step: nodes where veins start, on a lamina as it is at step 0.
    pub(crate) fn new(
        plan: &'a AuxinPlan,
        mut lamina: Lamina<'a>,
        clock: LaminaClock,
        seed: u64,
    ) -> Self {
        let origins = plan.origins_in_segments();
        if let Some(map) = clock.tissue_map(0) {
            lamina.carry(map);
        }
        let (low, high) = lamina.room();
        let is_stretching = matches!(
            plan.growth,
            Growth::Isogonic { .. } | Growth::Anisotropic { .. }
        );
        let mut veins = Veins::new(low, high, is_stretching);
        for origin in origins {
            veins.add_node(lamina.now_of_full_grown(origin), 0, &lamina);
        }
        let darts = Darts::new(plan, &lamina, &clock, seed);
        Self::resume(plan, lamina, clock, seed, veins, darts)
    }

    /// Goes on with veins that are there.
    pub(crate) fn resume(
        plan: &'a AuxinPlan,
        lamina: Lamina<'a>,
        clock: LaminaClock,
        seed: u64,
        veins: Veins,
        darts: Darts,
    ) -> Self {
        let (low, high) = lamina.room();
        Self {
            plan,
            seed,
            darts,
            clock,
            first_step: 0,
            is_laying_out: false,
            origins: plan.origins.len().max(1) as u32,
            noticed: veins.count(),
            veins,
            sources: Vec::new(),
            source_tree: PointTree::new(low, high),
            lamina,
            sources_born: 0,
            step: 0,
            idle_steps: 0,
            darts_in_vain: 0.0,
            pulls: Vec::new(),
            is_driven: Vec::new(),
        }
    }

    /// What there is now, at the size that the lamina had in the last step.
    pub(crate) fn state(&self, ending: Ending) -> Grown {
        let size = self.clock.size(self.age(self.step.saturating_sub(1)));
        // Marginal growth leaves veins where they are.
        let (veins, margin) = match self.plan.growth {
            Growth::None | Growth::Anisotropic { .. } => (1.0, 1.0),
            Growth::Marginal { .. } => (1.0, size),
            Growth::Isogonic { .. } => (size, size),
        };
        let scaled = |points: &[DVec2], scale: f64| points.iter().map(|&p| p * scale).collect();
        let mut edges = self.veins.edges.clone();
        edges.sort_unstable_by_key(|&[from, to]| (to, from));
        Grown {
            positions: scaled(&self.veins.positions, veins),
            births: self.veins.births.clone(),
            edges,
            origins: self.origins,
            steps: self.step,
            sources: self.sources_born,
            ending,
            margin: scaled(&self.lamina.margin_now(), margin),
            apex: self.lamina.now_of_full_grown(self.lamina.blade.apex()) * margin,
            map_apex: self.lamina.blade.apex() * veins,
        }
    }

    /// Steps until nothing is left to do, or `look`, called after each step,
    /// says no.
    pub(crate) fn run(&mut self, mut look: impl FnMut(&Self) -> bool) -> Ending {
        let growth = f64::from(self.clock.last_growth_step());
        // Far beyond what a vein needs to cross the leaf; only a pattern that never settles gets there.
        let limit = self.step + (growth + 1000.0 + 50.0 * self.plan.final_length) as u32;
        while self.step < limit {
            let grown = self.advance();
            if !look(self) {
                return Ending::Growing;
            }
            self.idle_steps = if grown == 0 { self.idle_steps + 1 } else { 0 };
            let last = self.clock.stage(self.age(self.step - 1));
            let nothing_new = !last.still_growing && self.is_saturated();
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
                self.darts.are_all_thrown()
                    || self.darts_in_vain
                        > 8.0 * self.lamina.blade.area() / (spacing * spacing) + 100.0
            }
        }
    }

    /// One step; gives the number of veins that grew.
    pub(crate) fn advance(&mut self) -> usize {
        let age = self.age(self.step);
        let stage = self.clock.stage(age);
        if age > 0 && self.clock.stage(age - 1).still_growing {
            self.carry(age);
        }
        self.veins.subdivide(stage.unit, &self.lamina, self.step);
        self.notice();
        if !self.is_laying_out {
            self.add_sources(age, stage.unit);
        }
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

    /// Moves veins and sources with the tissue, if it moves.
    fn carry(&mut self, age: u32) {
        let Some(map) = self.clock.tissue_map(age) else {
            return;
        };
        self.lamina.carry(map);
        let (low, high) = self.lamina.room();
        self.veins.carry(&self.lamina, low, high);
        self.source_tree = PointTree::new(low, high);
        let surroundings = Surroundings {
            tree: &self.veins.tree,
            seed: self.seed,
        };
        for source in &mut self.sources {
            source.place = self.lamina.now_at(source.start);
            self.source_tree.insert(source.id, source.place);
            source.influence.place_anew(source.place, &surroundings);
        }
        self.noticed = self.veins.count();
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
    fn add_sources(&mut self, age: u32, unit: f64) {
        let clear_of_margin = self.clearance(age);
        for dart in self.darts.of_step(age, unit, self.seed, &self.lamina) {
            let unit = unit * self.lamina.enlargement(dart);
            if !self.lamina.contains(dart)
                || clear_of_margin > 0.0 && self.lamina.distance_to_margin(dart) < clear_of_margin
            {
                continue;
            }
            if self
                .source_tree
                .any_within(dart, self.plan.source_birth_distance * unit)
                || self
                    .veins
                    .tree
                    .any_within(dart, self.plan.vein_birth_distance * unit)
            {
                self.darts_in_vain += 1.0;
                continue;
            }
            self.darts_in_vain = 0.0;
            self.add_source(dart);
        }
    }

    fn add_source(&mut self, place: DVec2) {
        let id = self.sources_born;
        self.sources_born += 1;
        self.source_tree.insert(id, place);
        let surroundings = Surroundings {
            tree: &self.veins.tree,
            seed: self.seed,
        };
        self.sources.push(Source {
            place,
            start: self.lamina.start_of(place),
            id,
            influence: I::new(place, id, &surroundings),
            blocked_steps: 0,
        });
    }

    /// Steps for which the lamina has grown at `step`.
    fn age(&self, step: u32) -> u32 {
        if self.is_laying_out {
            0
        } else {
            step.saturating_sub(self.first_step)
        }
    }

    /// How far sources of this step keep from the margin, in segments of the full-grown leaf.
    fn clearance(&self, age: u32) -> f64 {
        match self.plan.margin_clearance {
            Some(rule) if self.clock.size(age) < rule.until => {
                rule.distance * self.plan.final_length
            }
            Some(_) | None => 0.0,
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
            let from = self.veins.positions[i];
            let unit = unit * self.lamina.enlargement(from);
            let straight = pull / length * unit;
            let reach = |way: &DVec2| self.lamina.can_reach(from, from + *way);
            let way = if reach(&straight) {
                Some(straight)
            } else if self.turns(node, unit) {
                turned(straight).find(reach)
            } else {
                None
            };
            let Some(way) = way else {
                return (node, Outcome::OffBlade);
            };
            let child = from + way;
            if self.veins.tree.any_within(child, COINCIDENT * unit) {
                return (node, Outcome::Blocked);
            }
            let id = self.veins.add_node(child, self.step, &self.lamina);
            self.veins.add_edge(node, id, &self.lamina);
            (node, Outcome::Child(id))
        };
        driven.iter().map(place_one).collect()
    }

    /// Whether a vein's tip that would leave the blade turns aside: only as near to where the veins come in, for the base of a
    /// blade whose halves hang down beside the petiole lies in a notch, and a midrib drawn to the mean of both would end there.
    fn turns(&self, node: u32, unit: f64) -> bool {
        let from = self.veins.positions[node as usize];
        let origins = &self.veins.positions[..self.origins as usize];
        let near = |origin: &DVec2| (*origin - from).length() < TURNING * unit;
        self.veins.is_tip(node) && origins.iter().any(near)
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
        let mut used_up = Vec::new();
        let source_tree = &mut self.source_tree;
        let lamina = &self.lamina;
        let kill_distance = self.plan.kill_distance;
        self.sources.retain_mut(|source| {
            let kill = kill_distance * (unit * lamina.enlargement(source.place));
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
                .weld(place, &arrivals, unit, &self.lamina, self.step);
        }
    }
}
