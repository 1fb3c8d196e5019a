//! What new veins have to mind: veins that they would cross, and daughters that they would run
//! along.

use std::ops::ControlFlow;

use glam::DVec2;

use super::{NO_NODE, Veins};
use crate::plane::rectangle_distance_squared;
use crate::venation::architecture::course::cross;
use crate::venation::probe::{Probe, SLACK};

/// A new vein leaves a node at least so far from others there: the cosine of 40°.
const APART: f64 = 0.766;

/// Edges at a node, at most.
const MOST: usize = 4;

/// Calls `meet` with all nodes within a distance until it breaks.
struct Around<F> {
    place: DVec2,
    squared: f64,
    meet: F,
}

impl<F: FnMut(u32, DVec2) -> ControlFlow<()>> Probe for Around<F> {
    fn enters(&self, low: DVec2, high: DVec2) -> bool {
        rectangle_distance_squared(low, high, self.place) <= self.squared * SLACK
    }

    fn meet(&mut self, id: u32, position: DVec2) -> ControlFlow<()> {
        if (position - self.place).length_squared() > self.squared {
            return ControlFlow::Continue(());
        }
        (self.meet)(id, position)
    }
}

impl Veins {
    /// Visits all nodes within `distance` of a place until `meet` breaks.
    fn around(
        &self,
        place: DVec2,
        distance: f64,
        meet: impl FnMut(u32, DVec2) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let mut around = Around {
            place,
            squared: distance * distance,
            meet,
        };
        let reach = DVec2::splat(distance);
        let (low, high) = (place - reach, place + reach);
        self.tree.visit_within(low, high, place, &mut around)
    }

    /// The nodes from which edges lead to a node, and their places.
    fn before(&self, node: u32) -> impl Iterator<Item = (u32, DVec2)> + '_ {
        let stem = &self.stems[node as usize];
        let joints = stem.is_joint.then(|| self.joints.get(&node)).flatten();
        let more = joints.into_iter().flatten();
        let more = more.map(|&node| (node, self.positions[node as usize]));
        let first = (stem.node != NO_NODE).then_some((stem.node, stem.place));
        first.into_iter().chain(more)
    }

    /// Whether an edge leads from one of two nodes to the other.
    pub(crate) fn are_joined(&self, a: u32, b: u32) -> bool {
        let leads = |from, to| self.before(to).any(|(node, _)| node == from);
        leads(b, a) || leads(a, b)
    }

    /// Whether a straight vein from a node to a place crosses another; `unit` is a segment there.
    pub(crate) fn crosses(&self, from: u32, to: DVec2, unit: f64) -> bool {
        let start = self.positions[from as usize];
        self.line_crosses(&[start, to], [from, NO_NODE], unit)
    }

    /// Whether a line between two nodes crosses a vein. What its first piece meets at the first node,
    /// and its last at the last, does not count, nor does the edge between the two.
    pub(super) fn line_crosses(&self, line: &[DVec2], ends: [u32; 2], unit: f64) -> bool {
        let (low, high) = line.iter().fold((line[0], line[0]), |(low, high), &place| {
            (low.min(place), high.max(place))
        });
        // An edge is at most two segments long, so that one of its ends is not farther than that.
        let reach = (high - low).length() * 0.5 + 2.1 * unit;
        let last = line.len() - 2;
        self.around((low + high) * 0.5, reach, |node, place| {
            for (before, there) in self.before(node) {
                if [before, node] == ends {
                    continue;
                }
                for (k, piece) in line.windows(2).enumerate() {
                    let meets = |end: u32| end == node || end == before;
                    let is_joined = k == 0 && meets(ends[0]) || k == last && meets(ends[1]);
                    if !is_joined && cross(piece[0], piece[1], there, place).is_some() {
                        return ControlFlow::Break(());
                    }
                }
            }
            ControlFlow::Continue(())
        })
        .is_break()
    }

    /// Whether a vein that leaves a node in this direction would run along another there, or be
    /// one too many.
    pub(crate) fn is_crowded(&self, node: u32, way: DVec2, unit: f64) -> bool {
        let place = self.positions[node as usize];
        let way = way.normalize_or_zero();
        let runs_along = |other: DVec2| (other - place).normalize_or_zero().dot(way) > APART;
        let mut count = 0;
        for (_, before) in self.before(node) {
            count += 1;
            if runs_along(before) {
                return true;
            }
        }
        if self.first_children[node as usize] == NO_NODE {
            return false;
        }
        let crowded = self.around(place, 2.1 * unit, |other, at| {
            if other != node && self.before(other).any(|(before, _)| before == node) {
                count += 1;
                if runs_along(at) {
                    return ControlFlow::Break(());
                }
            }
            ControlFlow::Continue(())
        });
        crowded.is_break() || count >= MOST
    }

    /// The nearest node within `reach` of a place that `counts`.
    pub(crate) fn nearest(
        &self,
        place: DVec2,
        reach: f64,
        counts: impl Fn(u32) -> bool,
    ) -> Option<u32> {
        let mut best: Option<(f64, u32)> = None;
        let _ = self.around(place, reach, |node, at| {
            let candidate = ((at - place).length_squared(), node);
            // Of equally near ones the oldest, whatever the order of the tree.
            if counts(node) && best.is_none_or(|best| candidate < best) {
                best = Some(candidate);
            }
            ControlFlow::Continue(())
        });
        best.map(|(_, node)| node)
    }
}
