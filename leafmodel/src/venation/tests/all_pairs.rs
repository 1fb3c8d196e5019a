//! The algorithm straight from the definitions, comparing all pairs: the oracle with which the fast
//! code must agree node for node.
//!
//! It shares with the fast code what other modules' tests cover: where darts land and when the
//! margin passes over them, the clock and the map of the lamina, the outline, the layout of arches,
//! the curve on which stretched edges are subdivided, and the two constants that say when to give
//! up.

use glam::DVec2;

use crate::venation::Grown;
use crate::venation::auxin::Darts;
use crate::venation::bipolar::axis_of;
use crate::venation::lamina::Lamina;
use crate::venation::lamina_clock::LaminaClock;
use crate::venation::network::Ending;
use crate::venation::plan::{AuxinPlan, Growth, Pattern};
use crate::venation::simulation::{NO_DIRECTION, PATIENCE, TURNING, turned};

mod rounds;
mod surroundings;

#[derive(Clone, Debug)]
struct Source {
    id: u32,
    place: DVec2,
    start: DVec2,
    /// Of a bipolar source.
    axis: DVec2,
    tagged: Option<Vec<usize>>,
    arrived: Vec<usize>,
    blocked_steps: u32,
}

#[derive(Clone, Copy, PartialEq)]
enum Outcome {
    Child(usize),
    Blocked,
    OffBlade,
}

struct Oracle<'a> {
    plan: AuxinPlan,
    lamina: Lamina<'a>,
    seed: u64,
    nodes: Vec<DVec2>,
    starts: Vec<DVec2>,
    births: Vec<u32>,
    edges: Vec<[usize; 2]>,
    /// Edges that are not subdivided, since the pieces would leave the blade.
    uncut: Vec<bool>,
    parents: Vec<Option<usize>>,
    first_children: Vec<Option<usize>>,
    sources: Vec<Source>,
    born: u32,
    step: u32,
    vain: f64,
    origins: u32,
    /// Steps whose states are to be kept, and these states.
    wanted: Vec<u32>,
    young: Vec<Grown>,
}

/// The result of [`crate::venation::simulate`], by the slow method.
pub(crate) fn simulate(
    plan: &AuxinPlan,
    lamina: Lamina,
    clock: &LaminaClock,
    seed: u64,
    steps: &[u32],
) -> (Grown, Vec<Grown>) {
    let mut oracle = Oracle {
        plan: plan.clone(),
        lamina,
        seed,
        nodes: Vec::new(),
        starts: Vec::new(),
        births: Vec::new(),
        edges: Vec::new(),
        uncut: Vec::new(),
        parents: Vec::new(),
        first_children: Vec::new(),
        sources: Vec::new(),
        born: 0,
        step: 0,
        vain: 0.0,
        origins: 0,
        wanted: steps.to_vec(),
        young: Vec::new(),
    };
    if let Some(map) = clock.tissue_map(0) {
        oracle.lamina.carry(map);
    }
    for origin in plan.origins_in_segments() {
        oracle.add(oracle.lamina.now_of_full_grown(origin));
    }
    oracle.origins = oracle.nodes.len() as u32;
    oracle.remember(clock, 0);
    oracle.lay_out_arches(clock);
    let candidates = oracle.candidates(clock);
    let thrown = Darts::new(plan, &oracle.lamina, clock, seed);
    let mut ending = oracle.run(clock, candidates.as_deref(), thrown);
    if let Some(free) = &plan.free_endings {
        let darts = oracle.free_darts(free);
        let still = Darts::at_once(free, &oracle.lamina, seed);
        oracle.plan = free.as_plan(plan);
        oracle.sources.clear();
        let clock = LaminaClock::new(&oracle.plan).expect("nothing grows");
        if oracle.run(&clock, Some(&darts), still) == Ending::StepLimit {
            ending = Ending::StepLimit;
        }
    }
    let grown = oracle.state(1.0, ending);
    (grown, oracle.young)
}

impl Oracle<'_> {
    fn run(
        &mut self,
        clock: &LaminaClock,
        candidates: Option<&[(u32, DVec2)]>,
        mut thrown: Darts,
    ) -> Ending {
        let steps = f64::from(clock.last_growth_step()) + 1000.0 + 50.0 * self.plan.final_length;
        let (limit, first) = (self.step + steps as u32, self.step);
        let at_once = self.plan.pattern == Pattern::Open && candidates.is_some();
        let mut idle = 0;
        while self.step < limit {
            let age = self.step - first;
            let stage = clock.stage(age);
            if age > 0
                && clock.stage(age - 1).still_growing
                && let Some(map) = clock.tissue_map(age)
            {
                self.lamina.carry(map);
                for (node, start) in self.nodes.iter_mut().zip(&self.starts) {
                    *node = self.lamina.now_at(*start);
                }
                for source in &mut self.sources {
                    source.place = self.lamina.now_at(source.start);
                }
                self.uncut.fill(false);
            }
            let darts = match candidates {
                Some(all) => all
                    .iter()
                    .filter(|(step, _)| *step == age)
                    .map(|&(_, dart)| dart)
                    .collect(),
                None => thrown.of_step(age, stage.unit, self.seed, &self.lamina),
            };
            let grown = self.advance(stage.unit, clock.size(age), &darts);
            self.remember(clock, age);
            idle = if grown { 0 } else { idle + 1 };
            let spacing = (self.plan.source_birth_distance).min(self.plan.vein_birth_distance);
            let saturated = self.plan.growth != Growth::None
                || at_once
                || self.vain > 8.0 * self.lamina.blade.area() / (spacing * spacing) + 100.0;
            if !stage.still_growing && saturated && (self.sources.is_empty() || idle >= PATIENCE) {
                return Ending::Settled;
            }
        }
        Ending::StepLimit
    }

    fn remember(&mut self, clock: &LaminaClock, age: u32) {
        if self.wanted.contains(&self.step) {
            let size = clock.size(age);
            self.young.push(self.state(size, Ending::Growing));
        }
    }

    /// The leaf at this step in its size at that step; `size` is its length over the final one.
    fn state(&self, size: f64, ending: Ending) -> Grown {
        let (veins, margin) = match self.plan.growth {
            Growth::None | Growth::Anisotropic { .. } => (1.0, 1.0),
            Growth::Marginal { .. } => (1.0, size),
            Growth::Isogonic { .. } => (size, size),
        };
        let mut edges: Vec<[u32; 2]> = self.edges.iter().map(|e| e.map(|n| n as u32)).collect();
        edges.sort_unstable_by_key(|&[from, to]| (to, from));
        let scaled = |points: &[DVec2], by: f64| points.iter().map(|&p| p * by).collect();
        Grown {
            margin: scaled(&self.lamina.margin_now(), margin),
            apex: self.lamina.now_of_full_grown(self.lamina.blade.apex()) * margin,
            map_apex: self.lamina.blade.apex() * veins,
            positions: scaled(&self.nodes, veins),
            births: self.births.clone(),
            laid_orders: Vec::new(),
            is_held: vec![false; self.nodes.len()],
            edges,
            origins: self.origins,
            steps: self.step,
            sources: self.born,
            live_sources: self.sources.iter().map(|s| s.place * veins).collect(),
            ending,
        }
    }

    fn add_source(&mut self, place: DVec2) {
        let away = |node: &&DVec2| (**node - place).length_squared();
        let nearest = self.nodes.iter().min_by(|a, b| away(a).total_cmp(&away(b)));
        let axis = nearest.map_or(DVec2::X, |&near| {
            axis_of(
                near - place,
                self.born,
                self.plan.axis_along_vein,
                self.seed,
            )
        });
        self.sources.push(Source {
            axis,
            id: self.born,
            place,
            start: self.lamina.start_of(place),
            tagged: None,
            arrived: Vec::new(),
            blocked_steps: 0,
        });
        self.born += 1;
    }

    fn advance(&mut self, unit: f64, size: f64, darts: &[DVec2]) -> bool {
        if matches!(
            self.plan.growth,
            Growth::Isogonic { .. } | Growth::Anisotropic { .. }
        ) {
            self.subdivide(unit);
        }
        for &dart in darts {
            self.throw(dart, unit, size);
        }
        let driven: Vec<Vec<usize>> = self.sources.iter().map(|s| self.driven_by(s)).collect();
        let outcomes: Vec<Option<Outcome>> = (0..self.nodes.len())
            .map(|v| {
                let is_driven = driven.iter().any(|nodes| nodes.contains(&v));
                is_driven.then(|| self.grow_from(v, &driven, unit))
            })
            .collect();
        for (source, nodes) in self.sources.iter_mut().zip(&driven) {
            let came: Vec<Outcome> = nodes.iter().filter_map(|&v| outcomes[v]).collect();
            let blocked = came.iter().all(|&outcome| outcome == Outcome::Blocked);
            source.blocked_steps = if blocked { source.blocked_steps + 1 } else { 0 };
            if let Some(tagged) = &mut source.tagged {
                for &v in nodes {
                    if let (true, Some(Outcome::Child(child))) = (tagged.contains(&v), outcomes[v])
                    {
                        tagged.push(child);
                    }
                }
            }
        }
        self.judge(unit);
        self.step += 1;
        outcomes
            .iter()
            .any(|o| matches!(o, Some(Outcome::Child(_))))
    }

    fn throw(&mut self, dart: DVec2, unit: f64, size: f64) {
        let near_margin = self.plan.margin_clearance.is_some_and(|rule| {
            let clear = rule.distance * self.plan.final_length;
            size < rule.until && self.lamina.distance_to_margin(dart) < clear
        });
        if !self.lamina.contains(dart) || near_margin {
            return;
        }
        let unit = unit * self.lamina.enlargement(dart);
        let (bs, bv) = (
            self.plan.source_birth_distance * unit,
            self.plan.vein_birth_distance * unit,
        );
        let free = self.sources.iter().all(|s| apart(dart, s.place, bs))
            && self.nodes.iter().all(|&v| apart(dart, v, bv));
        if !free {
            self.vain += 1.0;
            return;
        }
        self.vain = 0.0;
        self.add_source(dart);
    }

    fn driven_by(&self, source: &Source) -> Vec<usize> {
        let mut neighbours = self.neighbours(source);
        if let Some(tagged) = &source.tagged {
            neighbours.retain(|v| tagged.contains(v));
        }
        neighbours
    }

    fn grow_from(&mut self, v: usize, driven: &[Vec<usize>], unit: f64) -> Outcome {
        let at = self.nodes[v];
        let mut sum = DVec2::ZERO;
        for (source, nodes) in self.sources.iter().zip(driven) {
            if nodes.contains(&v) && source.place != at {
                sum += (source.place - at) / (source.place - at).length();
            }
        }
        if sum.length() < NO_DIRECTION {
            return Outcome::Blocked;
        }
        let unit = unit * self.lamina.enlargement(at);
        let straight = sum / sum.length() * unit;
        let mut child = at + straight;
        if !self.stays(at, child) {
            let origins = &self.nodes[..self.origins as usize];
            let is_near = origins.iter().any(|o| (*o - at).length() < TURNING * unit);
            if !is_near || self.first_children[v].is_some() {
                return Outcome::OffBlade;
            }
            // The smallest turn that works, left before right.
            let mut least = None;
            for (number, way) in turned(straight).enumerate() {
                if self.stays(at, at + way) && least.is_none_or(|(n, _)| number < n) {
                    least = Some((number, at + way));
                }
            }
            let Some((_, aside)) = least else {
                return Outcome::OffBlade;
            };
            child = aside;
        }
        if !self.nodes.iter().all(|&u| apart(child, u, 0.05 * unit)) {
            return Outcome::Blocked;
        }
        let id = self.add(child);
        self.join(v, id);
        Outcome::Child(id)
    }

    fn add(&mut self, position: DVec2) -> usize {
        self.nodes.push(position);
        self.starts.push(self.lamina.start_of(position));
        self.births.push(self.step);
        self.parents.push(None);
        self.first_children.push(None);
        self.nodes.len() - 1
    }

    fn join(&mut self, from: usize, to: usize) {
        self.edges.push([from, to]);
        self.uncut.push(false);
        self.parents[to].get_or_insert(from);
        self.first_children[from].get_or_insert(to);
    }

    fn judge(&mut self, unit: f64) {
        let (lamina, kill_distance) = (self.lamina.clone(), self.plan.kill_distance);
        let near = |nodes: &[DVec2], v: usize, s: DVec2| {
            let kill = kill_distance * (unit * lamina.enlargement(s));
            (nodes[v] - s).length_squared() < kill * kill
        };
        let mut meetings = Vec::new();
        let mut sources = std::mem::take(&mut self.sources);
        sources.retain_mut(|source| {
            let candidates = self.driven_by(source);
            let (come, coming): (Vec<_>, Vec<_>) = candidates
                .into_iter()
                .partition(|&v| near(&self.nodes, v, source.place));
            let used_up = match self.plan.pattern {
                Pattern::Open => !come.is_empty(),
                Pattern::Closed(_) if source.tagged.is_none() && come.is_empty() => false,
                Pattern::Closed(_) => {
                    source.arrived.extend(come);
                    let done = coming.is_empty();
                    source.tagged = Some(coming);
                    done
                }
            };
            if used_up || source.blocked_steps >= PATIENCE {
                source.arrived.sort_unstable();
                meetings.push((source.place, std::mem::take(&mut source.arrived)));
            }
            !used_up && source.blocked_steps < PATIENCE
        });
        self.sources = sources;
        for (place, arrived) in meetings {
            self.weld(place, &arrived, unit);
        }
    }

    fn weld(&mut self, source: DVec2, arrived: &[usize], unit: f64) {
        let unit = unit * self.lamina.enlargement(source);
        let mut ends = arrived.to_vec();
        ends.retain(|&v| !apart(self.nodes[v], source, 2.0 * unit));
        if ends.len() < 2 {
            return;
        }
        let sum: DVec2 = ends.iter().map(|&v| self.nodes[v]).sum();
        let place = [source, sum / ends.len() as f64].into_iter().find(|&p| {
            self.lamina.contains(p) && self.nodes.iter().all(|&u| apart(p, u, 0.05 * unit))
        });
        let Some(place) = place else { return };
        ends.retain(|&v| self.stays(self.nodes[v], place));
        if ends.len() >= 2 {
            let junction = self.add(place);
            for end in ends {
                self.join(end, junction);
            }
        }
    }
}

/// Whether two points are farther apart than `distance`.
fn apart(p: DVec2, q: DVec2, distance: f64) -> bool {
    (p - q).length_squared() > distance * distance
}
