//! Which vein nodes are relative neighbours of a source: exact, and without all pairs.
//!
//! Node `v` is a relative neighbour of source `s` if and only if every other node `u` satisfies
//! `‖v − s‖ < max(‖u − s‖, ‖v − u‖)` (Eq. 2). Read the other way round: `v` lies on the side of `s`
//! of the bisector between `s` and each node that is as near to `s` as `v` is, or nearer. So visit nodes by growing distance
//! and keep the convex cell of points nearer to `s` than to any node visited: `v` is a relative neighbour
//! if it lies in the cell when its turn comes, and then cuts the cell itself. Once the next node is farther
//! away than the cell's farthest corner, no more can be in it.
//!
//! - **Always true**: the answer is that of the definition evaluated in floating point on squared
//!   distances. The cell only says which nodes can matter, with a margin far above rounding.
//! - **Time coherence**: nodes that did not cut the cell when their turn came never will, since new
//!   nodes only shrink it. A source therefore keeps the nodes that did (ten or twenty) and the cell after
//!   each of them. A new node matters only if it cuts the cell *as it was when its turn would have come*;
//!   the last cell alone does not tell, because later nodes may have shrunk it since. If some do matter, the work
//!   is taken up again at the turn of the nearest.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use glam::DVec2;

use super::fresh_nodes::{FreshNodes, NodeBox};
use super::point_tree::{Entry, PointTree, View};

/// Squares are compared with this much to spare where a wrong answer would only cost time.
const SLACK: f64 = 1.0 + 1e-9;

/// A node that cut the cell of a source.
#[derive(Clone, Copy, Debug)]
struct Cutter {
    position: DVec2,
    distance_squared: f64,
    id: u32,
    is_neighbour: bool,
}

/// The relative neighbours of one source, kept up to date as nodes appear.
#[derive(Clone, Debug)]
pub(crate) struct RelativeNeighbourhood {
    source: DVec2,
    /// By growing distance.
    cutters: Vec<Cutter>,
    /// Corners, relative to the source and counter-clockwise, of the cell at the start and after
    /// each cutter, one cell after the other.
    corners: Vec<DVec2>,
    /// Where each of these cells begins in `corners`; the last reaches to the end.
    starts: Vec<u32>,
    /// Squared distance of the farthest corner of the last cell.
    radius_squared: f64,
}

/// Room to work in, shared by all sources, and the rectangle that holds everything.
pub(crate) struct Workspace {
    low: DVec2,
    high: DVec2,
    incoming: Vec<Cutter>,
    queue: BinaryHeap<Reverse<Pending>>,
}

impl Workspace {
    /// For nodes and sources in the rectangle from `low` to `high`.
    pub(crate) fn new(low: DVec2, high: DVec2) -> Self {
        Self {
            low,
            high,
            incoming: Vec::new(),
            queue: BinaryHeap::new(),
        }
    }

    /// The longer side of the rectangle.
    pub(crate) fn size(&self) -> f64 {
        (self.high - self.low).max_element()
    }
}

/// A tree cell or a point that waits for its turn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Pending {
    /// Bits of a squared distance; for numbers that are not negative they sort as the number does.
    distance_bits: u64,
    what: What,
    place: [u64; 2],
}

/// Cells sort before points of the same distance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum What {
    Cell(u32),
    Point(u32),
}

impl RelativeNeighbourhood {
    /// Finds the relative neighbours of `source` among the points of `tree`.
    pub(crate) fn find(source: DVec2, tree: &PointTree, workspace: &mut Workspace) -> Self {
        let (low, high) = (workspace.low - source, workspace.high - source);
        let (right, left) = (DVec2::new(high.x, low.y), DVec2::new(low.x, high.y));
        let mut found = Self {
            source,
            cutters: Vec::new(),
            corners: vec![low, right, high, left],
            starts: vec![0],
            radius_squared: 0.0,
        };
        found.measure();
        let queue = &mut workspace.queue;
        queue.clear();
        found.queue_cell(tree, PointTree::ROOT, queue);
        let mut group: Vec<Cutter> = Vec::new();
        while let Some(Reverse(next)) = queue.pop() {
            if !found.reaches(f64::from_bits(next.distance_bits)) {
                break;
            }
            match next.what {
                What::Cell(number) => match tree.view(number) {
                    View::Branch(children) => {
                        for child in children {
                            found.queue_cell(tree, child, queue);
                        }
                    }
                    View::Leaf(entries) => {
                        for entry in entries {
                            found.queue_point(entry, queue);
                        }
                    }
                },
                What::Point(id) => {
                    group.clear();
                    group.push(found.candidate(id, next.place));
                    // All nodes at the same distance are judged together. They follow at once:
                    // cells at this distance come before points.
                    while let Some(Reverse(other)) = queue.peek().copied() {
                        let What::Point(id) = other.what else { break };
                        if other.distance_bits != next.distance_bits {
                            break;
                        }
                        queue.pop();
                        group.push(found.candidate(id, other.place));
                    }
                    found.meet(&mut group);
                }
            }
        }
        found
    }

    /// Takes in nodes that have come since.
    pub(crate) fn update(&mut self, fresh: &FreshNodes, workspace: &mut Workspace) {
        let incoming = &mut workspace.incoming;
        incoming.clear();
        let last = self
            .cutters
            .last()
            .map_or(0.0, |last| last.distance_squared);
        let reach = self.radius_squared.max(last) * SLACK;
        let matters = |node_box: &NodeBox| {
            let nearest = node_box.distance_squared(self.source);
            nearest <= reach
                && self.cell(self.turn(nearest)).iter().any(|&q| {
                    node_box.distance_squared(self.source + q) <= q.length_squared() * SLACK
                })
        };
        fresh.each(matters, |id, position| {
            let offset = position - self.source;
            let distance_squared = offset.length_squared();
            if distance_squared <= reach && cuts(self.cell(self.turn(distance_squared)), offset) {
                incoming.push(Cutter {
                    position,
                    distance_squared,
                    id,
                    is_neighbour: false,
                });
            }
        });
        let nearest = incoming
            .iter()
            .map(|node| node.distance_squared)
            .fold(f64::INFINITY, f64::min);
        if incoming.is_empty() {
            return;
        }
        // Back to the cell before the nearest of them, and on from there with old and new.
        let turn = self.turn(nearest);
        incoming.extend(self.cutters.drain(turn..));
        self.corners.truncate(match self.starts.get(turn + 1) {
            Some(&end) => end as usize,
            None => self.corners.len(),
        });
        self.starts.truncate(turn + 1);
        self.measure();
        incoming.sort_unstable_by(|a, b| {
            a.distance_squared
                .total_cmp(&b.distance_squared)
                .then(a.id.cmp(&b.id))
        });
        for group in incoming.chunk_by_mut(|a, b| a.distance_squared == b.distance_squared) {
            if !self.reaches(group[0].distance_squared) {
                break;
            }
            self.meet(group);
        }
    }

    /// Number and squared distance of each relative neighbour, the nearest first. The nearest
    /// node is always one, unless another is at exactly the same distance and near it.
    pub(crate) fn members(&self) -> impl Iterator<Item = (u32, f64)> + '_ {
        self.cutters
            .iter()
            .filter(|cutter| cutter.is_neighbour)
            .map(|cutter| (cutter.id, cutter.distance_squared))
    }

    /// How many cutters are nearer than this squared distance.
    fn turn(&self, distance_squared: f64) -> usize {
        self.cutters
            .partition_point(|cutter| cutter.distance_squared < distance_squared)
    }

    /// Corners of the cell after the first `turn` cutters.
    fn cell(&self, turn: usize) -> &[DVec2] {
        let end = self.starts.get(turn + 1);
        &self.corners
            [self.starts[turn] as usize..end.map_or(self.corners.len(), |&end| end as usize)]
    }

    /// Corners of the cell as it is.
    fn last_cell(&self) -> &[DVec2] {
        self.cell(self.cutters.len())
    }

    fn measure(&mut self) {
        self.radius_squared = self
            .last_cell()
            .iter()
            .fold(0.0, |far, corner| corner.length_squared().max(far));
    }

    /// Whether a node at this squared distance could lie in the cell.
    fn reaches(&self, distance_squared: f64) -> bool {
        distance_squared <= self.radius_squared * SLACK
    }

    fn candidate(&self, id: u32, place: [u64; 2]) -> Cutter {
        let position = DVec2::from_array(place.map(f64::from_bits));
        Cutter {
            position,
            distance_squared: (position - self.source).length_squared(),
            id,
            is_neighbour: false,
        }
    }

    /// Judges nodes at one distance from the source (usually one) and cuts the cell by them.
    fn meet(&mut self, group: &mut [Cutter]) {
        for i in 0..group.len() {
            let v = group[i];
            // Eq. 2 for all nodes that are not farther than v; farther ones never exclude it.
            let free = |u: &Cutter| v.distance_squared < (v.position - u.position).length_squared();
            group[i].is_neighbour = cuts(self.last_cell(), v.position - self.source)
                && self.cutters.iter().all(free)
                && group.iter().enumerate().all(|(j, u)| j == i || free(u));
        }
        for &node in &*group {
            let offset = node.position - self.source;
            if node.is_neighbour || cuts(self.last_cell(), offset) {
                self.cut(offset);
                self.cutters.push(node);
            }
        }
    }

    /// Adds the cell of what is nearer to the source than to the node at `offset`.
    fn cut(&mut self, offset: DVec2) {
        let half = 0.5 * offset.length_squared();
        let old = self.starts[self.cutters.len()] as usize..self.corners.len();
        self.starts.push(old.end as u32);
        // A node on the source leaves nothing to anyone else.
        let Some(mut previous) = self.corners[old.clone()]
            .last()
            .copied()
            .filter(|_| half > 0.0)
        else {
            self.radius_squared = 0.0;
            return;
        };
        let mut beyond_before = previous.dot(offset) - half;
        let mut far = 0.0_f64;
        for i in old {
            let corner = self.corners[i];
            let beyond = corner.dot(offset) - half;
            if (beyond > 0.0) != (beyond_before > 0.0) {
                let along = beyond_before / (beyond_before - beyond);
                let on_bisector = previous + (corner - previous) * along;
                far = far.max(on_bisector.length_squared());
                self.corners.push(on_bisector);
            }
            if beyond <= 0.0 {
                far = far.max(corner.length_squared());
                self.corners.push(corner);
            }
            (previous, beyond_before) = (corner, beyond);
        }
        self.radius_squared = far;
    }

    /// Queues a cell of the tree, unless none of its points can cut the cell of the source. A
    /// point cuts it if it lies in a circle about a corner that passes through the source.
    fn queue_cell(&self, tree: &PointTree, number: u32, queue: &mut BinaryHeap<Reverse<Pending>>) {
        let matters = self
            .last_cell()
            .iter()
            .any(|&q| tree.distance_squared(number, self.source + q) <= q.length_squared() * SLACK);
        if matters {
            let distance = tree.distance_squared(number, self.source);
            queue.push(Reverse(Pending {
                distance_bits: distance.to_bits(),
                what: What::Cell(number),
                place: [0; 2],
            }));
        }
    }

    fn queue_point(&self, entry: &Entry, queue: &mut BinaryHeap<Reverse<Pending>>) {
        let offset = entry.position - self.source;
        if cuts(self.last_cell(), offset) {
            queue.push(Reverse(Pending {
                distance_bits: offset.length_squared().to_bits(),
                what: What::Point(entry.id),
                place: entry.position.to_array().map(f64::to_bits),
            }));
        }
    }
}

/// Whether a node at `offset` from the source is nearer to some corner of a cell than the source is.
fn cuts(corners: &[DVec2], offset: DVec2) -> bool {
    let threshold = 0.5 * offset.length_squared() / SLACK;
    corners.iter().any(|q| q.dot(offset) >= threshold)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use proptest::test_runner::RngSeed;

    use super::*;

    /// Eq. 2 word by word.
    fn by_definition(source: DVec2, nodes: &[DVec2]) -> Vec<u32> {
        let neighbour = |i: usize| {
            let squared = |p: DVec2, q: DVec2| (p - q).length_squared();
            let v = nodes[i];
            (0..nodes.len())
                .filter(|&j| j != i)
                .all(|j| squared(v, source) < squared(nodes[j], source).max(squared(v, nodes[j])))
        };
        (0..nodes.len())
            .filter(|&i| neighbour(i))
            .map(|i| i as u32)
            .collect()
    }

    fn sorted(neighbourhood: &RelativeNeighbourhood) -> Vec<u32> {
        let mut ids: Vec<u32> = neighbourhood.members().map(|(id, _)| id).collect();
        ids.sort_unstable();
        ids
    }

    /// Points crowded along chains, as veins are, or on a lattice with its many equal distances.
    fn nodes(count: usize, kind: u8) -> impl Strategy<Value = Vec<DVec2>> {
        proptest::collection::vec((0.0..10.0, 0.0..10.0), count).prop_map(move |points| {
            let mut at = DVec2::splat(5.0);
            points
                .into_iter()
                .map(DVec2::from)
                .map(|p| match kind {
                    0 => p,
                    1 => p.floor(),
                    _ => {
                        let way = p - DVec2::splat(5.0);
                        at = (at + way * 0.1).clamp(DVec2::ZERO, DVec2::splat(10.0));
                        at
                    }
                })
                .collect()
        })
    }

    fn cases() -> impl Strategy<Value = (Vec<DVec2>, u8)> {
        (1_usize..150, 0_u8..3)
            .prop_flat_map(|(count, kind)| nodes(count, kind).prop_map(move |n| (n, kind)))
    }

    proptest! {
        #![proptest_config(ProptestConfig { rng_seed: RngSeed::Fixed(2005), failure_persistence: None, ..ProptestConfig::with_cases(1500) })]

        #[test]
        fn neighbours_are_those_of_the_definition_at_every_stage(
            (nodes, kind) in cases(), x in 0.0..10.0, y in 0.0..10.0, steps in 1_usize..6,
        ) {
            let source = DVec2::new(x, y);
            // On the lattice, a source in the middle of a square or on a point has the most ties.
            let source = if kind == 1 { (source * 2.0).floor() * 0.5 } else { source };
            let (low, high) = (DVec2::ZERO, DVec2::splat(10.0));
            let mut workspace = Workspace::new(low, high);
            let mut tree = PointTree::new(low, high);
            let mut neighbourhood = RelativeNeighbourhood::find(source, &tree, &mut workspace);
            for step in 0..steps {
                let (from, to) = (nodes.len() * step / steps, nodes.len() * (step + 1) / steps);
                for (id, &p) in nodes.iter().enumerate().take(to).skip(from) {
                    tree.insert(id as u32, p);
                }
                let known = &nodes[..to];
                neighbourhood.update(&FreshNodes::new(known, from as u32), &mut workspace);
                let expected = by_definition(source, known);
                prop_assert_eq!(&sorted(&neighbourhood), &expected, "kept up to date");
                let anew = RelativeNeighbourhood::find(source, &tree, &mut workspace);
                prop_assert_eq!(&sorted(&anew), &expected, "found anew");
            }
        }
    }
}
