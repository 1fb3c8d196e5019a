//! Visibility from lone sources: nodes that their nearest node does not hide.

use std::ops::ControlFlow;

use glam::DVec2;

use crate::plane::rectangle_distance_squared;
use crate::venation::point_tree::PointTree;
use crate::venation::probe::{Probe, SLACK};

/// Safety margin in comparisons of squared lengths, far above the rounding of coordinates.
pub(super) const MARGIN: f64 = 1e-9;

/// Number of nodes visible from a basin above which each source is tested individually.
pub(super) const MOST_SEEN: usize = 12;

/// A node with its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Node {
    pub(super) id: u32,
    pub(super) place: DVec2,
}

/// The region that a node leaves visible to sources in a rectangle.
pub(super) struct View {
    /// Lower corner of the rectangle relative to the node.
    pub(super) low: DVec2,
    pub(super) high: DVec2,
    pub(super) node: DVec2,
    pub(super) size_squared: f64,
}

impl View {
    pub(super) fn new(low: DVec2, high: DVec2, node: DVec2) -> Self {
        let (low, high) = (low - node, high - node);
        Self {
            low,
            high,
            node,
            size_squared: low.abs().max(high.abs()).length_squared(),
        }
    }

    /// Whether something between these corners may be visible to one of the sources.
    pub(super) fn shows_any_in(&self, low: DVec2, high: DVec2) -> bool {
        let (low, high) = (low - self.node, high - self.node);
        let at = |p: DVec2| {
            let s = p.clamp(self.low, self.high);
            (2.0 * p - s) * s
        };
        let most = at(low).max(at(high));
        let size_squared = self.size_squared + low.abs().max(high.abs()).length_squared();
        most.x + most.y > -MARGIN * size_squared
    }
}

/// Collects visible nodes other than the view's own, until there are too many.
pub(super) struct Seen<'a> {
    pub(super) view: &'a View,
    pub(super) node: Node,
    /// The search stops when more than this many are found.
    pub(super) most: usize,
    pub(super) found: &'a mut Vec<DVec2>,
}

impl Probe for Seen<'_> {
    fn enters(&self, low: DVec2, high: DVec2) -> bool {
        self.view.shows_any_in(low, high)
    }

    fn meet(&mut self, id: u32, place: DVec2) -> ControlFlow<()> {
        if id != self.node.id && self.view.shows_any_in(place, place) {
            if self.found.len() == self.most {
                return ControlFlow::Break(());
            }
            self.found.push(place);
        }
        ControlFlow::Continue(())
    }
}

/// Searches the nearest node.
pub(super) struct Nearest {
    pub(super) place: DVec2,
    pub(super) node: Option<Node>,
    pub(super) distance_squared: f64,
    pub(super) is_tied: bool,
}

impl Nearest {
    pub(super) fn new(place: DVec2) -> Self {
        Self {
            place,
            node: None,
            distance_squared: f64::INFINITY,
            is_tied: false,
        }
    }

    pub(super) fn consider(&mut self, node: Node) {
        let squared = (node.place - self.place).length_squared();
        if squared < self.distance_squared {
            self.distance_squared = squared;
            self.node = Some(node);
            self.is_tied = false;
        } else if squared == self.distance_squared {
            self.is_tied = true;
        }
    }

    /// The nearest node, unless there is none, a tie, or a distance below `near`.
    pub(super) fn unless_near(&self, near: f64) -> Option<Node> {
        let is_lone = !self.is_tied && self.distance_squared >= near * near;
        self.node.filter(|_| is_lone)
    }
}

impl Probe for Nearest {
    fn enters(&self, low: DVec2, high: DVec2) -> bool {
        rectangle_distance_squared(low, high, self.place) <= self.distance_squared * SLACK
    }

    fn meet(&mut self, id: u32, place: DVec2) -> ControlFlow<()> {
        self.consider(Node { id, place });
        ControlFlow::Continue(())
    }
}

/// Finds the sources to which a node other than `node` is visible. Sorts the sources by place where
/// that is needed.
pub(super) fn find_seeing(
    lone: &mut [Lone],
    node: Node,
    tree: &PointTree,
    seen: &mut Vec<DVec2>,
    seeing: &mut Vec<Lone>,
) {
    let Some(first) = lone.first() else {
        return;
    };
    let (low, high) = lone
        .iter()
        .fold((first.place, first.place), |(low, high), lone| {
            (low.min(lone.place), high.max(lone.place))
        });
    seen.clear();
    let view = View::new(low, high, node.place);
    let mut look = Seen {
        view: &view,
        node,
        most: if lone.len() == 1 { 0 } else { MOST_SEEN },
        found: seen,
    };
    if tree.visit(low, &mut look).is_continue() {
        let sees = |lone: &&Lone| {
            let view = View::new(lone.place, lone.place, node.place);
            seen.iter().any(|&p| view.shows_any_in(p, p))
        };
        seeing.extend(lone.iter().filter(sees));
    } else if let [only] = lone {
        seeing.push(*only);
    } else {
        let size = high - low;
        let key = |lone: &Lone| {
            if size.x > size.y {
                lone.place.x
            } else {
                lone.place.y
            }
        };
        let middle = lone.len() / 2;
        lone.select_nth_unstable_by(middle, |a, b| key(a).total_cmp(&key(b)));
        let (one, other) = lone.split_at_mut(middle);
        find_seeing(one, node, tree, seen, seeing);
        find_seeing(other, node, tree, seen, seeing);
    }
}

/// Whether `node` hides all others from the source at `place`.
pub(super) fn sees_no_other(place: DVec2, node: Node, tree: &PointTree) -> bool {
    let mut seen = Seen {
        view: &View::new(place, place, node.place),
        node,
        most: 0,
        found: &mut Vec::new(),
    };
    tree.visit(place, &mut seen).is_continue()
}

/// A lone source.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lone {
    /// Its place.
    pub(crate) place: DVec2,
    /// Its place in the list of all sources.
    pub(crate) slot: u32,
}
