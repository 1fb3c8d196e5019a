//! The algorithm as the definitions read, by comparing everything with everything: the oracle that the
//! fast code has to agree with, node for node.
//!
//! It shares with the fast code only what is no algorithm: the random numbers, the clock of the
//! lamina, the outline, and the curve on which stretched edges are cut.

use glam::DVec2;

use super::Grown;
use super::auxin::{Darts, appearance, dart, waiting_darts};
use super::lamina_clock::LaminaClock;
use super::network::Ending;
use super::open::lot;
use super::plan::{Growth, Pattern, VenationPlan};
use super::simulation::{NO_DIRECTION, PATIENCE};
use super::veins::catmull_rom;
use crate::shape::outline::Outline;

#[derive(Clone, Debug)]
struct Source {
    id: u32,
    place: DVec2,
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
    plan: &'a VenationPlan,
    blade: &'a Outline,
    seed: u64,
    nodes: Vec<DVec2>,
    births: Vec<u32>,
    edges: Vec<[usize; 2]>,
    /// Edges that cannot be cut, since they leave the blade.
    uncut: Vec<bool>,
    parents: Vec<Option<usize>>,
    first_children: Vec<Option<usize>>,
    sources: Vec<Source>,
    born: u32,
    step: u32,
    vain: f64,
}

/// What [`super::simulate`] gives, the slow way.
pub(crate) fn simulate(plan: &VenationPlan, blade: &Outline, seed: u64) -> Grown {
    let clock = LaminaClock::new(plan).expect("a plan that has been carried out");
    let mut oracle = Oracle {
        plan,
        blade,
        seed,
        nodes: vec![DVec2::ZERO],
        births: vec![0],
        edges: Vec::new(),
        uncut: Vec::new(),
        parents: vec![None],
        first_children: vec![None],
        sources: Vec::new(),
        born: 0,
        step: 0,
        vain: 0.0,
    };
    let candidates = oracle.candidates(&clock);
    let limit = (f64::from(clock.last_growth_step()) + 1000.0 + 50.0 * plan.final_length) as u32;
    let (mut idle, mut ending) = (0, Ending::StepLimit);
    let mut thrown = Darts::new(plan, blade, &clock, seed);
    while oracle.step < limit {
        let stage = clock.stage(oracle.step);
        let darts = match &candidates {
            Some(all) => all
                .iter()
                .filter(|(step, _)| *step == oracle.step)
                .map(|&(_, dart)| dart)
                .collect(),
            None => thrown.of_step(oracle.step, stage.unit, seed),
        };
        let grown = oracle.advance(stage.unit, &darts);
        idle = if grown { 0 } else { idle + 1 };
        let spacing = plan.source_birth_distance.min(plan.vein_birth_distance);
        let saturated = plan.growth != Growth::None
            || oracle.vain > 8.0 * blade.area() / (spacing * spacing) + 100.0;
        if !stage.still_growing && saturated && (oracle.sources.is_empty() || idle >= PATIENCE) {
            ending = Ending::Settled;
            break;
        }
    }
    let mut edges: Vec<[u32; 2]> = oracle.edges.iter().map(|e| e.map(|n| n as u32)).collect();
    edges.sort_unstable_by_key(|&[from, to]| (to, from));
    Grown {
        positions: oracle.nodes,
        births: oracle.births,
        edges,
        steps: oracle.step,
        sources: oracle.born,
        ending,
    }
}

impl Oracle<'_> {
    /// For marginal growth, all candidates with the step of their appearance.
    fn candidates(&self, clock: &LaminaClock) -> Option<Vec<(u32, DVec2)>> {
        if !matches!(self.plan.growth, Growth::Marginal { .. }) {
            return None;
        }
        let (low, high) = self.blade.bounds();
        let size = high - low;
        let mut kept: Vec<DVec2> = Vec::new();
        for number in 0..waiting_darts(self.plan, size, clock.last_growth_step()) as u64 {
            let dart = dart(self.seed, number, low, size);
            if kept
                .iter()
                .all(|&p| apart(dart, p, self.plan.source_birth_distance))
            {
                kept.push(dart);
            }
        }
        kept.retain(|&dart| self.blade.contains(dart));
        let appear = |dart| (appearance(self.blade.points(), clock, dart), dart);
        Some(kept.into_iter().map(appear).collect())
    }

    fn advance(&mut self, unit: f64, darts: &[DVec2]) -> bool {
        if matches!(self.plan.growth, Growth::Isogonic { .. }) {
            self.subdivide(unit);
        }
        for &dart in darts {
            self.throw(dart, unit);
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

    fn throw(&mut self, dart: DVec2, unit: f64) {
        if !self.blade.contains(dart) {
            return;
        }
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
        self.sources.push(Source {
            id: self.born,
            place: dart,
            tagged: None,
            arrived: Vec::new(),
            blocked_steps: 0,
        });
        self.born += 1;
    }

    /// `V(s)`: the nearest node, or all relative neighbours by Eq. 2.
    fn neighbours(&self, source: &Source) -> Vec<usize> {
        let squared = |p: DVec2, q: DVec2| (p - q).length_squared();
        let s = source.place;
        let all = 0..self.nodes.len();
        match self.plan.pattern {
            Pattern::Open => {
                let key = |v: usize| {
                    let bits = squared(self.nodes[v], s).to_bits();
                    (bits, lot(self.seed, source.id, v as u32))
                };
                all.min_by_key(|&v| key(v)).into_iter().collect()
            }
            Pattern::Closed(_) => all
                .filter(|&v| {
                    let at = self.nodes[v];
                    self.nodes
                        .iter()
                        .enumerate()
                        .all(|(i, &u)| i == v || squared(at, s) < squared(u, s).max(squared(at, u)))
                })
                .collect(),
        }
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
        let child = at + sum / sum.length() * unit;
        if !self.stays(at, child) {
            return Outcome::OffBlade;
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
        let kill = self.plan.kill_distance * unit;
        let near =
            |nodes: &[DVec2], v: usize, s: DVec2| (nodes[v] - s).length_squared() < kill * kill;
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
        let mut ends = arrived.to_vec();
        ends.retain(|&v| !apart(self.nodes[v], source, 2.0 * unit));
        if ends.len() < 2 {
            return;
        }
        let sum: DVec2 = ends.iter().map(|&v| self.nodes[v]).sum();
        let place = [source, sum / ends.len() as f64].into_iter().find(|&p| {
            self.blade.contains(p) && self.nodes.iter().all(|&u| apart(p, u, 0.05 * unit))
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

    /// Whether the straight way is on the blade, but for its very beginning.
    fn stays(&self, from: DVec2, to: DVec2) -> bool {
        let from = from + (to - from) * 1e-6;
        let side = |p: DVec2, q: DVec2, r: DVec2| (q - p).perp_dot(r - p);
        let margin = self.blade.points();
        let crossed = (0..margin.len()).any(|i| {
            let (a, b) = (margin[i], margin[(i + 1) % margin.len()]);
            let (p, q) = (side(a, b, from), side(a, b, to));
            let (r, s) = (side(from, to, a), side(from, to, b));
            p * q < 0.0 && r * s < 0.0
        });
        self.blade.contains(to) && !crossed
    }

    fn subdivide(&mut self, unit: f64) {
        let longest = 1.5 * unit;
        let squared = |oracle: &Self, e: usize| {
            let [from, to] = oracle.edges[e];
            (oracle.nodes[to] - oracle.nodes[from]).length_squared()
        };
        loop {
            let edge = (0..self.edges.len())
                .filter(|&e| !self.uncut[e] && squared(self, e) > longest * longest)
                // Keeps the last of equals: reversed, the oldest.
                .rev()
                .max_by(|&a, &b| squared(self, a).total_cmp(&squared(self, b)));
            let Some(edge) = edge else { return };
            let pieces = (squared(self, edge).sqrt() / longest).ceil().max(2.0) as usize;
            self.cut(edge, pieces);
        }
    }

    fn cut(&mut self, edge: usize, pieces: usize) {
        let [from, to] = self.edges[edge];
        let (p1, p2) = (self.nodes[from], self.nodes[to]);
        let other = |node: Option<usize>, mirrored: DVec2, of: DVec2| {
            node.map(|n| self.nodes[n])
                .filter(|&p| p != of)
                .unwrap_or(mirrored)
        };
        let p0 = other(self.parents[from], 2.0 * p1 - p2, p1);
        let p3 = other(self.first_children[to], 2.0 * p2 - p1, p2);
        let places = [true, false].into_iter().find_map(|curved| {
            let place = |i: usize| {
                let u = i as f64 / pieces as f64;
                let straight = p1 + (p2 - p1) * u;
                if curved {
                    catmull_rom([p0, p1, p2, p3], u)
                } else {
                    straight
                }
            };
            let places: Vec<DVec2> = (1..pieces).map(place).collect();
            let path: Vec<DVec2> = [&[p1], &places[..], &[p2]].concat();
            let stays = path.windows(2).all(|way| self.stays(way[0], way[1]));
            stays.then_some(places)
        });
        let Some(places) = places else {
            self.uncut[edge] = true;
            return;
        };
        let (mut tail, mut tail_edge) = (from, edge);
        for place in places {
            let node = self.add(place);
            self.edges[tail_edge] = [tail, node];
            if self.first_children[tail] == Some(to) {
                self.first_children[tail] = Some(node);
            }
            self.parents[node] = Some(tail);
            self.first_children[node] = Some(to);
            if self.parents[to] == Some(tail) {
                self.parents[to] = Some(node);
            }
            self.edges.push([node, to]);
            self.uncut.push(false);
            (tail, tail_edge) = (node, self.edges.len() - 1);
        }
    }
}

/// Whether two points are farther apart than `distance`.
fn apart(p: DVec2, q: DVec2, distance: f64) -> bool {
    (p - q).length_squared() > distance * distance
}
