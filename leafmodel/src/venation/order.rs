//! Vein orders, by width at the origin and by branching (\[hickey1979\]).
//!
//! The rule, order by order from the midrib on:
//!
//! 1. Where a vein branches, it **continues** in the branch with the largest `r (1 + cos φ)`, with
//!    the branch's radius `r` and its deflection `φ` from the vein's direction. That is the widest
//!    branch, unless a slightly finer one goes straight on. Directions are taken over a few
//!    segments.
//! 2. A branch and the continuation **fork** if the branch is at least 3/4 as wide and deflected to
//!    the other side by about the same angle (within 20°). Then both keep the order. At the leaf's
//!    base so do all branches at least 3/4 as wide as the widest (primaries of actinodromous
//!    leaves).
//! 3. All other branches are **laterals**. A lateral at least 1/4 as wide as the widest lateral of
//!    all veins of its parent's order is one order finer than the parent, one at least 1/16 as wide
//!    two orders, and so on. So a veinlet on the midrib is not a secondary vein.
//! 4. Where veins meet, the widest continues and the others end.

use glam::DVec2;

use super::topology::Topology;

/// Least width of a branch of the same order, relative to the continuation or the widest primary.
const ALIKE: f64 = 0.75;

/// Ratio of widths, relative to the widest lateral, at which the next finer order starts.
const NARROWER: f64 = 0.25;

/// Greatest difference between the deflections of the two branches of a fork, radians (20°).
const FORK_SKEW: f64 = 0.35;

/// Number of segments over which directions are taken.
const LOOK: usize = 4;

/// Over how many radii of the widest vein at a node directions are taken at least, where that is
/// asked for.
const LOOK_RADII: f64 = 4.0;

/// Over how much of a vein directions are taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Look {
    /// A few segments: in networks that are grown, whose segments are alike.
    Segments,
    /// A few segments of this length, mm, and at least a few radii of the widest vein at the node: in
    /// networks that are traced or read. Their pieces may be far finer than a vein is wide, and
    /// the point where lines meet lies off the middle of the widest.
    Length {
        /// The length of a segment, mm.
        segment_mm: f64,
    },
}

/// The finest order; still finer veins get it too.
const FINEST: u8 = 12;

/// Vein orders, and the edge that continues the vein at each node.
pub(crate) struct Orders {
    /// Order of each edge, ≥ 1.
    pub(crate) edges: Vec<u8>,
    /// For each node the edge in which the vein continues, if any.
    pub(crate) continuations: Vec<Option<u32>>,
}

/// Gives every edge its order, from the radius at which each starts. `laid` is the order as which
/// each node was laid out, 0 for none, and empty without an architecture: edges that lead to a laid
/// out node have its order, and all others are of finer ones.
pub(crate) fn orders(
    topology: &Topology,
    positions: &[DVec2],
    radii: &[f64],
    base_to_tip: &[u32],
    laid: &[u8],
    look: Look,
) -> Orders {
    let survey = Survey::new(topology, positions, radii, look);
    let mut edges = vec![0; topology.edge_count()];
    // For each order the edges that start a vein of it, found while coarser orders are followed.
    let mut starts: Vec<Vec<u32>> = vec![Vec::new(); usize::from(FINEST) + 1];
    let mut laterals: Vec<u32> = Vec::new();
    let laid_order = |edge: u32| {
        let node = topology.edge(edge)[1] as usize;
        laid.get(node).copied().unwrap_or(0)
    };
    let coarse = laid.iter().copied().max().unwrap_or(0);
    if coarse > 0 {
        for edge in 0..topology.edge_count() as u32 {
            edges[edge as usize] = laid_order(edge);
            let leaves = |&branch: &u32| laid_order(branch) == 0;
            if edges[edge as usize] > 0 {
                let end = topology.edge(edge)[1];
                laterals.extend(topology.leaving(end).iter().copied().filter(leaves));
            }
        }
        let roots = base_to_tip
            .iter()
            .filter(|&&node| topology.entering(node).is_empty());
        for &root in roots {
            let out = topology.leaving(root).iter().copied();
            laterals.extend(out.filter(|&branch| laid_order(branch) == 0));
        }
        laterals.sort_unstable();
        laterals.dedup();
        start_laterals(&mut laterals, coarse, radii, &mut starts);
    }
    let grown = if coarse > 0 { &[] } else { base_to_tip };
    for &seed in grown
        .iter()
        .filter(|&&node| topology.entering(node).is_empty())
    {
        let out = topology.leaving(seed);
        let widest = out.iter().map(|&e| radii[e as usize]).fold(0.0, f64::max);
        let (primary, lateral): (Vec<u32>, Vec<u32>) = out
            .iter()
            .partition(|&&e| radii[e as usize] >= ALIKE * widest);
        starts[1].extend(primary);
        laterals.extend(lateral);
    }
    for order in coarse + 1..=FINEST {
        let mut pending = std::mem::take(&mut starts[usize::from(order)]);
        // Veins are followed in the order found. Neighbours in the list are unrelated, so memory
        // fetches overlap.
        let mut next = 0;
        while let Some(&edge) = pending.get(next) {
            next += 1;
            edges[edge as usize] = order;
            let node = topology.edge(edge)[1];
            if survey.main_entry[node as usize] != Some(edge) {
                continue; // It ends where it meets a wider vein.
            }
            for &branch in topology.leaving(node) {
                if survey.continuations[node as usize] == Some(branch) || survey.forks(node, branch)
                {
                    pending.push(branch);
                } else {
                    laterals.push(branch);
                }
            }
        }
        start_laterals(&mut laterals, order, radii, &mut starts);
        if order == FINEST {
            // Laterals of the finest order are of the finest order too.
            let mut pending = std::mem::take(&mut starts[usize::from(FINEST)]);
            while let Some(edge) = pending.pop() {
                edges[edge as usize] = FINEST;
                let node = topology.edge(edge)[1];
                if survey.main_entry[node as usize] == Some(edge) {
                    pending.extend(topology.leaving(node));
                }
            }
        }
    }
    Orders {
        edges,
        continuations: survey.continuations,
    }
}

/// Gives laterals of veins of an order a finer one, by their width.
fn start_laterals(laterals: &mut Vec<u32>, order: u8, radii: &[f64], starts: &mut [Vec<u32>]) {
    let widest = laterals
        .iter()
        .map(|&e| radii[e as usize])
        .fold(0.0, f64::max);
    for edge in laterals.drain(..) {
        let mut finer = order + 1;
        let mut threshold = widest * NARROWER;
        while radii[edge as usize] < threshold && finer < FINEST {
            finer += 1;
            threshold *= NARROWER;
        }
        starts[usize::from(finer.min(FINEST))].push(edge);
    }
}

/// Properties of every node that are computed before orders are assigned.
struct Survey<'a> {
    topology: &'a Topology<'a>,
    positions: &'a [DVec2],
    radii: &'a [f64],
    look: Look,
    /// The widest edge into each node.
    main_entry: Vec<Option<u32>>,
    continuations: Vec<Option<u32>>,
    /// The start of the widest edge into each node, or the node itself if there is none.
    back: Vec<u32>,
    /// The end of the continuation of each node, or the node itself if there is none.
    ahead: Vec<u32>,
}

impl<'a> Survey<'a> {
    fn new(
        topology: &'a Topology<'a>,
        positions: &'a [DVec2],
        radii: &'a [f64],
        look: Look,
    ) -> Self {
        let widest = |edges: &[u32]| {
            edges
                .iter()
                .copied()
                // `max_by` keeps the last of equals; in reverse order that is the lowest number.
                .rev()
                .max_by(|&a, &b| radii[a as usize].total_cmp(&radii[b as usize]))
        };
        let nodes = topology.nodes() as u32;
        let mut survey = Self {
            topology,
            positions,
            radii,
            look,
            main_entry: (0..nodes)
                .map(|node| widest(topology.entering(node)))
                .collect(),
            // The widest edges are preliminary continuations, along which directions are taken.
            continuations: (0..nodes)
                .map(|node| widest(topology.leaving(node)))
                .collect(),
            back: Vec::new(),
            ahead: Vec::new(),
        };
        // Steps along veins dominate the time, so each is made a single look-up.
        let end = |node: u32, edge: Option<u32>, end: usize| {
            edge.map_or(node, |edge| topology.edge(edge)[end])
        };
        survey.back = (0..nodes)
            .map(|node| end(node, survey.main_entry[node as usize], 0))
            .collect();
        survey.ahead = (0..nodes)
            .map(|node| end(node, survey.continuations[node as usize], 1))
            .collect();
        let refined: Vec<(u32, Option<u32>)> = (0..nodes)
            .filter(|&node| topology.leaving(node).len() > 1)
            .map(|node| (node, survey.continuation(node)))
            .collect();
        for (node, edge) in refined {
            survey.continuations[node as usize] = edge;
            survey.ahead[node as usize] = end(node, edge, 1);
        }
        survey
    }

    /// The edge in which the vein continues.
    fn continuation(&self, node: u32) -> Option<u32> {
        let out = self.topology.leaving(node);
        let arrival = self.arrival(node);
        let score = |edge: u32| {
            let departure = self.departure(edge);
            self.radii[edge as usize] * (1.0 + arrival.dot(departure))
        };
        out.iter()
            .copied()
            .rev()
            .max_by(|&a, &b| score(a).total_cmp(&score(b)))
    }

    /// Direction in which the vein arrives at a node; zero at its start.
    fn arrival(&self, node: u32) -> DVec2 {
        match self.look {
            Look::Segments => {
                let back = (0..LOOK).fold(node, |at, _| self.back[at as usize]);
                self.direction(back, node)
            }
            Look::Length { segment_mm } => {
                let first = self.back[node as usize];
                -self.along(node, first, &self.back, self.length_at(node, segment_mm))
            }
        }
    }

    /// Direction in which a vein leaves along an edge.
    fn departure(&self, edge: u32) -> DVec2 {
        let [from, to] = self.topology.edge(edge);
        match self.look {
            Look::Segments => {
                let ahead = (1..LOOK).fold(to, |at, _| self.ahead[at as usize]);
                self.direction(from, ahead)
            }
            Look::Length { segment_mm } => {
                self.along(from, to, &self.ahead, self.length_at(from, segment_mm))
            }
        }
    }

    /// The length over which directions at a node are taken.
    fn length_at(&self, node: u32, segment_mm: f64) -> f64 {
        let (out, entering) = (self.topology.leaving(node), self.topology.entering(node));
        let radii = out.iter().chain(entering).map(|&e| self.radii[e as usize]);
        let widest = radii.fold(0.0, f64::max);
        f64::max(LOOK as f64 * segment_mm, LOOK_RADII * widest)
    }

    /// The direction from a node by its neighbour to the place that is a length away along `steps`.
    fn along(&self, from: u32, neighbour: u32, steps: &[u32], length: f64) -> DVec2 {
        let start = self.positions[from as usize];
        let (mut at, mut next, mut left) = (from, neighbour, length);
        loop {
            let way = self.positions[next as usize] - self.positions[at as usize];
            let piece = way.length();
            if piece >= left {
                let end = self.positions[at as usize] + way * (left / piece);
                return (end - start).normalize_or_zero();
            }
            left -= piece;
            (at, next) = (next, steps[next as usize]);
            // The end of a vein; there are no circles.
            if next == at {
                return self.direction(from, at);
            }
        }
    }

    fn direction(&self, from: u32, to: u32) -> DVec2 {
        (self.positions[to as usize] - self.positions[from as usize]).normalize_or_zero()
    }

    /// Whether the vein forks at `node` into its continuation and `branch`.
    fn forks(&self, node: u32, branch: u32) -> bool {
        let Some(main) = self.continuations[node as usize] else {
            return false;
        };
        if self.radii[branch as usize] < ALIKE * self.radii[main as usize] {
            return false;
        }
        let arrival = self.arrival(node);
        let angle = |edge: u32| {
            let departure = self.departure(edge);
            libm::atan2(arrival.perp_dot(departure), arrival.dot(departure))
        };
        let (ahead, aside) = (angle(main), angle(branch));
        ahead * aside < 0.0 && (ahead + aside).abs() <= FORK_SKEW
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::venation::width::{flows, radius};

    fn orders_of(places: &[(f64, f64)], edges: &[[u32; 2]]) -> Vec<u8> {
        let positions: Vec<DVec2> = places.iter().copied().map(DVec2::from).collect();
        let topology = Topology::new(positions.len(), edges);
        let order = topology.base_to_tip().expect("no circle");
        let flows = flows(&topology, &order, |_| 0.0);
        let radii: Vec<f64> = flows.edges.iter().map(|&q| radius(q, 0.01, 2.0)).collect();
        orders(&topology, &positions, &radii, &order, &[], Look::Segments).edges
    }

    #[test]
    fn a_straight_midrib_keeps_order_1_past_every_lateral() {
        // A herringbone: six nodes up, a lateral of five nodes to either side at each.
        let mut places = vec![(0.0, 0.0)];
        let mut edges = Vec::new();
        let mut expected = Vec::new();
        let mut spine = 0;
        for level in 1..=6 {
            let next = places.len() as u32;
            places.push((0.0, f64::from(level) * 4.0));
            edges.push([spine, next]);
            expected.push(1);
            spine = next;
            for side in [-1.0, 1.0] {
                let mut tail = spine;
                for reach in 1..=5 {
                    let node = places.len() as u32;
                    let reach = f64::from(reach);
                    places.push((side * reach, f64::from(level) * 4.0 + 0.7 * reach));
                    edges.push([tail, node]);
                    expected.push(2);
                    tail = node;
                }
            }
        }
        // The last pair has equal widths and no branch between them, so it is a fork of the midrib.
        let last = expected.len();
        expected[last - 10..].fill(1);
        assert_eq!(orders_of(&places, &edges), expected);
    }

    #[test]
    fn a_veinlet_on_the_midrib_is_finer_than_a_secondary() {
        let mut places = vec![(0.0, 0.0), (0.0, 1.0), (0.0, 2.0), (0.0, 3.0), (-1.0, 1.5)];
        let mut edges = vec![[0, 1], [1, 2], [2, 3], [1, 4]];
        // A lateral that carries 25 tips, and the midrib's own 40.
        let fan = |hub: u32, tips: u32, places: &mut Vec<(f64, f64)>, edges: &mut Vec<[u32; 2]>| {
            for i in 0..tips {
                let node = places.len() as u32;
                places.push((0.1 * f64::from(i) + 2.0 * f64::from(hub), 9.0));
                edges.push([hub, node]);
            }
        };
        places.push((1.5, 3.0));
        edges.push([2, 5]);
        fan(5, 25, &mut places, &mut edges);
        fan(3, 40, &mut places, &mut edges);
        let orders = orders_of(&places, &edges);
        assert_eq!(orders[..5], [1, 1, 1, 3, 2]);
    }

    #[test]
    fn a_midrib_goes_on_where_its_line_bends_to_a_lateral_within_its_own_width() {
        // As traced: pieces far finer than the midrib is wide, and the node where the lateral's line
        // meets that of the midrib lies aside.
        let line = |from: DVec2, to: DVec2, count: u32| {
            (1..=count).map(move |i| from.lerp(to, f64::from(i) / f64::from(count)))
        };
        let [base, node, above] = [(0.0, 0.0), (0.7, 5.0), (0.0, 5.3)].map(DVec2::from);
        let [apex, far] = [(0.0, 12.0), (6.0, 7.0)].map(DVec2::from);
        let mut places = vec![base];
        let (mut edges, mut radii) = (Vec::new(), Vec::new());
        let mut add = |start: u32, points: Vec<DVec2>, radius: f64| {
            let mut before = start;
            for point in points {
                places.push(point);
                edges.push([before, places.len() as u32 - 1]);
                radii.push(radius);
                before = places.len() as u32 - 1;
            }
            before
        };
        let below =
            line(base, DVec2::new(0.0, 4.8), 100).chain(line(DVec2::new(0.0, 4.8), node, 10));
        let junction = add(0, below.collect(), 1.0);
        add(
            junction,
            line(node, above, 10)
                .chain(line(above, apex, 100))
                .collect(),
            0.95,
        );
        let lateral = places.len();
        let mut before = junction;
        for point in line(node, far, 80) {
            places.push(point);
            edges.push([before, places.len() as u32 - 1]);
            radii.push(0.5);
            before = places.len() as u32 - 1;
        }
        let topology = Topology::new(places.len(), &edges);
        let sorted = topology.base_to_tip().expect("no circle");
        let look = Look::Length { segment_mm: 0.05 };
        let found = orders(&topology, &places, &radii, &sorted, &[], look).edges;
        for (edge, order) in edges.iter().zip(found) {
            assert_eq!(
                order == 1,
                (edge[1] as usize) < lateral,
                "{edge:?}: {order}"
            );
        }
    }

    #[test]
    fn dichotomy_keeps_the_order_in_both_prongs() {
        let places = [
            (0.0, 0.0),
            (0.0, 1.0),
            (-0.5, 2.0),
            (0.5, 2.0),
            (-0.8, 3.0),
            (-0.2, 3.0),
            (0.2, 3.0),
            (0.8, 3.0),
        ];
        let edges = [[0, 1], [1, 2], [1, 3], [2, 4], [2, 5], [3, 6], [3, 7]];
        assert_eq!(orders_of(&places, &edges)[..3], [1, 1, 1]);
    }
}
