//! The veins of an architecture, laid out before the lamina grows.
//!
//! Each vein has sources of its own: they appear one after another along its course, and its tip
//! grows to each in turn, a segment a step. A tip that comes upon another vein joins it and ends.

use glam::DVec2;

use super::{Simulation, turned};
use crate::venation::architecture::course::Course;
use crate::venation::architecture::ground::Ground;
use crate::venation::architecture::margin::Margin;
use crate::venation::architecture::secondaries::Secondary;
use crate::venation::architecture::{
    Architecture, Lots, festoons, primaries, quaternaries, secondaries, tertiaries,
};
use crate::venation::influence::Influence;

/// Distance between the sources of a vein, segments.
const SPACING: f64 = 2.0;

/// Nearer than this to a source, in segments, a tip turns to the next.
const REACHED: f64 = 0.5;

/// A tip that comes as near as this to another vein joins it, segments.
const TOUCH: f64 = 0.8;

/// The length that a vein needs to get away from the one that it leaves, segments: coarse ones may
/// leave at acute angles.
const AWAY: [f64; 2] = [5.0, 2.5];

/// The same of one that starts among others, segments.
const CROWDED: f64 = 30.0;

/// How far the last leg of a vein that joins another may be, segments.
const LAST_LEG: f64 = 4.0;

/// Ways aside that a tip tries at the margin: up to 45° either way.
const TURNED: usize = 6;

/// Steps aside after which it ends.
const MOST_TURNS: u32 = 12;

/// A vein under way.
struct Tip {
    /// Its nodes so far; the first lies on the vein that it leaves.
    nodes: Vec<u32>,
    sources: Vec<DVec2>,
    next: usize,
    joins: bool,
    /// The length that it needs to get away from the others, segments.
    away: Option<f64>,
    length: f64,
    /// Steps in which it had to turn aside at the margin.
    turns: u32,
    /// Whether it grows no more.
    is_done: bool,
    /// Whether it has joined another vein.
    is_joined: bool,
}

impl<I: Influence> Simulation<'_, I> {
    /// Lays out all veins of an architecture; `look` is called after each step.
    pub(crate) fn lay_out_architecture(
        &mut self,
        plan: &Architecture,
        mut look: impl FnMut(&Self) -> bool,
    ) {
        let lots = Lots::new(self.seed, plan.irregularity);
        let blade = self.lamina.blade;
        let margin = Margin::new(blade);
        let ground = Ground {
            blade,
            margin: &margin,
            lots,
        };
        let axes = primaries::lay_out(plan, ground);
        let mut grown = Vec::new();
        // Each generation leaves the one before it.
        for generation in axes.chunk_by(|a, b| a.generation == b.generation) {
            let courses: Vec<Course> = generation.iter().map(|a| a.course.clone()).collect();
            grown.extend(self.lay_out_order(&courses, 1, &mut look));
        }
        if plan.is_fimbrial {
            // Before secondaries, which end on it.
            let along = festoons::fimbrial(&margin, blade.length());
            self.lay_out_order(&along, 3, &mut look);
        }
        let site = secondaries::Site {
            ground,
            axes: &axes,
        };
        let laid = secondaries::lay_out(plan, site);
        let courses: Vec<Course> = laid.veins.iter().map(|vein| vein.course.clone()).collect();
        let seconds = self.lay_out_order(&courses, 2, &mut look);
        // Agrophic veins leave secondaries.
        let combs = &laid.agrophic.veins;
        let courses: Vec<Course> = combs.iter().map(|vein| vein.course.clone()).collect();
        let comb_nodes = self.lay_out_order(&courses, 2, &mut look);
        let primary = grown.iter().enumerate().map(|(number, nodes)| {
            // Up to the first secondary on the side that faces the midrib.
            let axis = &axes[number];
            let inner = laid
                .veins
                .iter()
                .filter(|vein| vein.axis == number && vein.side != axis.side);
            let first = inner
                .map(|vein| (vein.course.start() - axis.course.start()).length())
                .fold(f64::INFINITY, f64::min);
            let fertile = (first / axis.course.length()).min(0.95);
            self.as_grown(nodes, axis.side, fertile, false)
        });
        let bears = |number: usize| combs.iter().any(|vein| vein.axis == number);
        let secondary = seconds
            .iter()
            .zip(&laid.veins)
            .enumerate()
            .map(|(i, (nodes, vein))| {
                let is_lowest = is_first_of_row(&laid.veins, i) && !bears(i);
                self.as_grown(nodes, vein.side, 1.0, is_lowest)
            });
        let agrophic = comb_nodes
            .iter()
            .zip(combs)
            .enumerate()
            .map(|(i, (nodes, vein))| {
                let is_lowest =
                    is_first_of_row(combs, i) && is_first_of_row(&laid.veins, vein.axis);
                self.as_grown(nodes, vein.side, 1.0, is_lowest)
            });
        let coarse: Vec<tertiaries::Grown> = primary.chain(secondary).chain(agrophic).collect();
        let unit = self.clock.stage(0).unit;
        let rungs = tertiaries::courses(plan, &coarse, ground, unit);
        let first = laid.finer.len();
        let mut finer = laid.finer;
        finer.extend(rungs.iter().map(|rung| rung.course.clone()));
        let thirds = self.lay_out_order(&finer, 3, &mut look);
        // Tertiaries send quaternaries to the next tertiary farther out; coarser veins stop them.
        let mut row: Vec<tertiaries::Grown> = coarse
            .into_iter()
            .map(|vein| tertiaries::Grown {
                side: 0.0,
                is_lowest: false,
                ..vein
            })
            .collect();
        let of_rungs = thirds[first..].iter().zip(&rungs);
        row.extend(of_rungs.map(|(nodes, rung)| self.as_grown(nodes, -rung.side, 1.0, false)));
        let fourths = quaternaries::courses(plan, &row, ground, unit);
        self.lay_out_order(&fourths.veins, 4, &mut look);
        self.lay_out_order(&fourths.branches, 4, &mut look);
        self.noticed = self.veins.count();
        self.first_step = self.step;
    }

    /// A vein that has grown, as those that leave it see it.
    fn as_grown(
        &self,
        nodes: &[u32],
        side: f64,
        fertile: f64,
        is_lowest: bool,
    ) -> tertiaries::Grown {
        let place = |&node: &u32| self.lamina.full_grown(self.veins.positions[node as usize]);
        tertiaries::Grown {
            nodes: nodes.iter().map(place).collect(),
            side,
            fertile,
            is_lowest,
        }
    }

    /// Lets veins of one order grow together until all are done; gives the nodes of each.
    fn lay_out_order(
        &mut self,
        courses: &[Course],
        order: u8,
        look: &mut impl FnMut(&Self) -> bool,
    ) -> Vec<Vec<u32>> {
        self.is_laying_out = true;
        let unit = self.clock.stage(0).unit;
        let older = self.veins.count();
        let mut tips: Vec<Tip> = courses
            .iter()
            .map(|course| self.tip(course, older, unit))
            .collect();
        // Far more than a vein takes to cross the young leaf.
        let end = self.step + 1000 + (50.0 * self.plan.final_length) as u32;
        while self.step < end && tips.iter().any(|tip| !tip.is_done) {
            for tip in tips.iter_mut().filter(|tip| !tip.is_done) {
                self.grow_tip(tip, order, unit);
            }
            self.step += 1;
            if !look(self) {
                break;
            }
        }
        for tip in tips.iter_mut().filter(|tip| tip.joins && !tip.is_joined) {
            let end = tip.nodes[tip.nodes.len() - 1];
            let end = self.veins.positions[end as usize];
            self.join(tip, order, end, LAST_LEG * unit, unit);
        }
        self.is_laying_out = false;
        tips.into_iter().map(|tip| tip.nodes).collect()
    }

    /// A vein before it grows, on the nearest of the first `older` nodes.
    fn tip(&mut self, course: &Course, older: u32, unit: f64) -> Tip {
        let start = self.lamina.now_of_full_grown(course.start());
        let size = self.plan.final_length;
        let node = [4.0 * unit, size]
            .into_iter()
            .find_map(|reach| self.veins.nearest(start, reach, |node| node < older))
            .unwrap_or(0);
        let mut sources = Vec::new();
        let mut left = SPACING * unit;
        for pair in course.points.windows(2) {
            let [from, to] = [pair[0], pair[1]].map(|p| self.lamina.now_of_full_grown(p));
            let step = (to - from).length();
            while left <= step {
                sources.push(from.lerp(to, left / step));
                left += SPACING * unit;
            }
            left -= step;
        }
        let end = course.points[course.points.len() - 1];
        sources.push(self.lamina.now_of_full_grown(end));
        self.sources_born += sources.len() as u32;
        Tip {
            nodes: vec![node],
            sources,
            next: 0,
            joins: course.joins,
            away: course.is_crowded.then_some(CROWDED),
            length: 0.0,
            turns: 0,
            is_done: false,
            is_joined: false,
        }
    }

    /// One segment towards the next source.
    fn grow_tip(&mut self, tip: &mut Tip, order: u8, unit: f64) {
        let last = tip.nodes[tip.nodes.len() - 1];
        let from = self.veins.positions[last as usize];
        while let Some(&source) = tip.sources.get(tip.next)
            && (source - from).length() < REACHED * unit
        {
            tip.next += 1;
        }
        let Some(&source) = tip.sources.get(tip.next) else {
            tip.is_done = true;
            return;
        };
        let way = source - from;
        let step = if way.length() < 1.4 * unit {
            way
        } else {
            way.normalize_or_zero() * unit
        };
        let reach = |way: &DVec2| self.lamina.can_reach(from, from + *way);
        let straight = Some(step).filter(reach);
        let step = straight.or_else(|| {
            // Around the corner of a sinus, but not on and on along the margin.
            tip.turns += 1;
            turned(step)
                .take(TURNED)
                .find(reach)
                .filter(|_| tip.turns < MOST_TURNS)
        });
        let Some(step) = step else {
            tip.is_done = true;
            return;
        };
        let place = from + step;
        // It ends where it would touch another vein, so that none of its nodes lies upon that.
        let away = tip.away.unwrap_or(AWAY[usize::from(order > 2)]);
        let is_away = tip.length > away * unit;
        if is_away && self.join(tip, order, place, TOUCH * unit, unit) {
            return;
        }
        if self.veins.crosses(last, place, unit) {
            self.join(tip, order, place, 1.6 * unit, unit);
            tip.is_done = true;
            return;
        }
        let node = self
            .veins
            .add_ranked_node(place, order, self.step, &self.lamina);
        self.veins.add_edge(last, node, &self.lamina);
        tip.nodes.push(node);
        tip.length += step.length();
    }

    /// Joins a vein to another that is within `reach` of a place, if any is.
    fn join(&mut self, tip: &mut Tip, order: u8, place: DVec2, reach: f64, unit: f64) -> bool {
        let last = tip.nodes[tip.nodes.len() - 1];
        let from = self.veins.positions[last as usize];
        let start = tip.nodes[0];
        let is_other = |node: u32| {
            !tip.nodes.contains(&node) && node != start && !self.veins.are_joined(last, node)
        };
        let Some(other) = self.veins.nearest(place, reach, is_other) else {
            return false;
        };
        let there = self.veins.positions[other as usize];
        let middle = from.lerp(there, 0.5);
        if tip.nodes.len() < 2
            || self.veins.crosses(last, middle, unit)
            || self.veins.crosses(other, middle, unit)
            || !self.lamina.can_reach(from, there)
        {
            return false;
        }
        let node = self
            .veins
            .add_ranked_node(middle, order, self.step, &self.lamina);
        self.veins.add_edge(last, node, &self.lamina);
        self.veins.add_edge(other, node, &self.lamina);
        tip.is_done = true;
        tip.is_joined = true;
        true
    }
}

/// Whether a vein is the lowest of its side of its axis: each side's come one after the other.
fn is_first_of_row(veins: &[Secondary], i: usize) -> bool {
    i == 0 || {
        let (before, vein) = (&veins[i - 1], &veins[i]);
        before.axis != vein.axis || before.side != vein.side
    }
}
