//! The loop of section 3.3: the lamina grows, sources appear, veins grow towards them, sources
//! are used up.
//!
//! Within a step all decisions depend on the state at its beginning and follow the order of
//! numbers. So results depend neither on the order of work nor on the number of threads.

pub(crate) mod courses;
mod growth;
mod rounds;

use glam::DVec2;

use super::auxin::Darts;
use super::fresh_nodes::FreshNodes;
use super::grown::Grown;
use super::influence::{Influence, Surroundings};
use super::lamina::Lamina;
use super::lamina_clock::LaminaClock;
use super::network::Ending;
use super::plan::{AuxinPlan, Growth, Neighbourhood, Pattern};
use super::point_tree::PointTree;
use super::sources::Sources;
use super::veins::Veins;

/// Number of steps after which a source is given up if none of its nodes can grow, and after which
/// the simulation ends if the lamina is full-grown and no vein grows.
pub(crate) const PATIENCE: u32 = 3;

/// Sources can be lone if they are farther from all veins than the kill distance plus this, in
/// segments.
const CLEAR: f64 = 1.0;

/// A running venation simulation, in the frame of [`super::lamina_clock`].
pub(crate) struct Simulation<'a, I> {
    plan: &'a AuxinPlan,
    pub(crate) lamina: Lamina<'a>,
    seed: u64,
    clock: LaminaClock,
    darts: Darts,
    /// The network so far.
    pub(crate) veins: Veins,
    sources: Sources<I>,
    source_tree: PointTree,
    /// Number of nodes at the start.
    origins: u32,
    /// The step in which the lamina starts to grow; arches are laid out before.
    first_step: u32,
    /// Whether arches are being laid out.
    is_laying_out: bool,
    /// Number of nodes of which all sources have taken notice.
    noticed: u32,
    /// Number of sources that have appeared.
    pub(crate) sources_born: u32,
    /// Number of steps done.
    pub(crate) step: u32,
    idle_steps: u32,
    darts_in_vain: f64,
    pulls: Vec<DVec2>,
    is_driven: Vec<bool>,
    /// Outcomes of the driven nodes of this step, by node.
    outcomes: Vec<Outcome>,
}

impl<'a, I: Influence> Simulation<'a, I> {
    /// The state before the first step: the origins, on the lamina of step 0.
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
        veins.minds_crossings = plan.architecture.is_some();
        for origin in origins {
            veins.add_node(lamina.now_of_full_grown(origin), 0, &lamina);
        }
        let darts = Darts::new(plan, &lamina, &clock, seed);
        Self::resume(plan, lamina, clock, seed, veins, darts)
    }

    /// Continues with existing veins.
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
            sources: Sources::new(),
            source_tree: PointTree::new(low, high),
            lamina,
            sources_born: 0,
            step: 0,
            idle_steps: 0,
            darts_in_vain: 0.0,
            pulls: Vec::new(),
            is_driven: Vec::new(),
            outcomes: Vec::new(),
        }
    }

    /// Length of a segment before the first step, in the frame of the simulation.
    pub(crate) fn unit_at_start(&self) -> f64 {
        self.clock.stage(0).unit
    }

    /// The present state, at the size of the lamina in the last step.
    pub(crate) fn state(&self, ending: Ending) -> Grown {
        let size = self.clock.size(self.age(self.step.saturating_sub(1)));
        // Marginal growth does not move veins.
        let (veins, margin) = match self.plan.growth {
            Growth::None | Growth::Anisotropic { .. } => (1.0, 1.0),
            Growth::Marginal { .. } => (1.0, size),
            Growth::Isogonic { .. } => (size, size),
        };
        let scaled = |points: &[DVec2], scale: f64| points.iter().map(|&p| p * scale).collect();
        let laid_orders = match self.plan.architecture {
            Some(_) => self.veins.laid_orders.clone(),
            None => Vec::new(),
        };
        let mut edges = self.veins.edges.clone();
        edges.sort_unstable_by_key(|&[from, to]| (to, from));
        Grown {
            positions: scaled(&self.veins.positions, veins),
            births: self.veins.births.clone(),
            laid_orders,
            is_held: self
                .veins
                .laid_orders
                .iter()
                .map(|&rank| rank > 0)
                .collect(),
            edges,
            origins: self.origins,
            steps: self.step,
            sources: self.sources_born,
            live_sources: self.sources.places().map(|place| place * veins).collect(),
            ending,
            margin: scaled(&self.lamina.margin_now(), margin),
            apex: self.lamina.now_of_full_grown(self.lamina.blade.apex()) * margin,
            map_apex: self.lamina.blade.apex() * veins,
        }
    }

    /// Runs steps until nothing is left to do, or until `look`, which is called after each step,
    /// returns false.
    pub(crate) fn run(&mut self, mut look: impl FnMut(&Self) -> bool) -> Ending {
        let growth = f64::from(self.clock.last_growth_step());
        // Far more than a vein needs to cross the leaf; only a pattern that never settles reaches
        // it.
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

    /// Whether no further source can be expected on a full-grown lamina: after growth there are no
    /// darts, and without growth so many darts in a row have missed that a free place is unlikely.
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

    /// Does one step; returns the number of veins that grew.
    pub(crate) fn advance(&mut self) -> usize {
        let age = self.age(self.step);
        let stage = self.clock.stage(age);
        if age > 0 && self.clock.stage(age - 1).still_growing {
            self.carry(age);
        }
        self.veins.subdivide(stage.unit, &self.lamina, self.step);
        self.notice(stage.unit);
        if !self.is_laying_out {
            self.add_sources(age, stage.unit);
        }
        let driven = self.gather_pulls();
        self.grow_veins(&driven, stage.unit);
        let grown = self.notify_sources(&driven);
        self.notice(stage.unit);
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
        let surroundings = Surroundings::new(&self.veins.tree, self.seed, self.plan);
        let (lamina, source_tree) = (&self.lamina, &mut self.source_tree);
        self.sources.carry(
            |start| lamina.now_at(start),
            &surroundings,
            |id, place| source_tree.insert(id, place),
        );
        self.noticed = self.veins.count();
    }

    /// Lets every source take in the nodes added since the last call.
    fn notice(&mut self, unit: f64) {
        let near = self.nearness(unit);
        let fresh = FreshNodes::new(&self.veins.positions, self.noticed);
        if !fresh.is_empty() {
            let surroundings = Surroundings::new(&self.veins.tree, self.seed, self.plan);
            self.sources.notice(&fresh, near, &surroundings);
        }
        self.noticed = self.veins.count();
    }

    /// Distance from all veins from which sources may be lone, if any may: they must not be used up
    /// in this step.
    fn nearness(&self, unit: f64) -> Option<f64> {
        let is_bipolar = self.plan.pattern == Pattern::Closed(Neighbourhood::Bipolar);
        let may_be = self.lamina.is_flat() && !self.lamina.moves() && !is_bipolar;
        may_be.then_some((self.plan.kill_distance + CLEAR) * unit)
    }

    /// Adds sources where darts hit the blade far enough from sources and veins.
    fn add_sources(&mut self, age: u32, unit: f64) {
        let clear_of_margin = self.clearance(age);
        let near = self.nearness(unit);
        self.sources
            .fit_cells(self.plan.source_birth_distance * unit);
        if let Some(near) = near {
            let surroundings = Surroundings::new(&self.veins.tree, self.seed, self.plan);
            self.sources.reconsider(self.step, near, &surroundings);
        }
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
            self.add_source(dart, near);
        }
    }

    fn add_source(&mut self, place: DVec2, near: Option<f64>) {
        let id = self.sources_born;
        self.sources_born += 1;
        self.source_tree.insert(id, place);
        let surroundings = Surroundings::new(&self.veins.tree, self.seed, self.plan);
        let start = self.lamina.start_of(place);
        self.sources.push(id, place, start, near, &surroundings);
    }

    /// Number of steps for which the lamina has grown at `step`.
    fn age(&self, step: u32) -> u32 {
        if self.is_laying_out {
            0
        } else {
            step.saturating_sub(self.first_step)
        }
    }

    /// Least distance of this step's sources from the margin, in segments of the full-grown leaf.
    fn clearance(&self, age: u32) -> f64 {
        match self.plan.margin_clearance {
            Some(rule) if self.clock.size(age) < rule.until => {
                rule.distance * self.plan.final_length
            }
            Some(_) | None => 0.0,
        }
    }
}

/// The outcome of a driven node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Outcome {
    /// It grew this child.
    Child(u32),
    /// No child: it would coincide with an existing node, or the pulls cancel.
    Blocked,
    /// No child: the new edge would leave the blade. Another vein may still reach the source, so it
    /// is not given up for this.
    OffBlade,
}

/// Below this length the sum of unit vectors is taken to cancel.
pub(crate) const NO_DIRECTION: f64 = 1e-9;

/// Distance from an origin, in segments, within which veins turn aside at the margin.
pub(crate) const TURNING: f64 = 12.0;

/// Directions beside one that leaves the blade, the smallest turns first, up to a right angle.
pub(crate) fn turned(straight: DVec2) -> impl Iterator<Item = DVec2> {
    (1..=6).flat_map(move |k| {
        let (sin, cos) = libm::sincos(f64::from(k) * 15.0_f64.to_radians());
        [sin, -sin].map(|sin| DVec2::new(cos, sin).rotate(straight))
    })
}
