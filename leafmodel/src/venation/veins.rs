//! The growing network: nodes, edges, and an index of nodes by place.

mod nearby;

use std::collections::BTreeMap;

use glam::DVec2;

use super::lamina::Lamina;
use super::length_queue::LengthQueue;
use super::point_tree::PointTree;
pub(crate) use crate::shape::cubic::catmull_rom;

/// Stands for "no node".
pub(crate) const NO_NODE: u32 = u32::MAX;

/// Children nearer to a node than this, in segments, are not placed.
pub(crate) const COINCIDENT: f64 = 0.05;

/// Edges longer than this, in segments of the current step, are subdivided.
const LONGEST_EDGE: f64 = 1.5;

/// Veins farther from a used-up source than this, in segments, end freely instead of being joined
/// there: with a large kill distance veins do not meet (Fig. 9a–c).
const WELDING_REACH: f64 = 2.0;

/// Nodes and edges of a growing network; edges run from older to younger tissue.
pub(crate) struct Veins {
    /// Place of each node.
    pub(crate) positions: Vec<DVec2>,
    /// Where the tissue of each node started, if tissue moves.
    starts: Vec<DVec2>,
    /// Step at which each node came into being.
    pub(crate) births: Vec<u32>,
    /// The nodes at the start and the end of each edge.
    pub(crate) edges: Vec<[u32; 2]>,
    /// All nodes by place.
    pub(crate) tree: PointTree,
    /// What each node grew from.
    stems: Vec<Stem>,
    /// The first node that grew from each node, or [`NO_NODE`].
    first_children: Vec<u32>,
    /// Nodes besides the first from which edges lead to a junction.
    joints: BTreeMap<u32, Vec<u32>>,
    /// The order as which each node was laid out, or 0.
    pub(crate) laid_orders: Vec<u8>,
    /// Edges by length in segments of their place, if edges stretch in time.
    by_length: LengthQueue,
    /// Whether edges stretch in time.
    stretching: bool,
    /// Whether veins may not cross. The rows of the paper let them.
    pub(crate) minds_crossings: bool,
}

/// What a node grew from. Who looks for veins around a place asks all nodes there: so all that they ask
/// stands together.
#[derive(Clone, Copy)]
struct Stem {
    /// The node it grew from (the first, for a junction), or [`NO_NODE`].
    node: u32,
    /// Whether `joints` has more of them.
    is_joint: bool,
    /// The place of `node`.
    place: DVec2,
}

/// A queue of edges; a segment is never shorter than one unit of the frame.
fn length_queue() -> LengthQueue {
    LengthQueue::new(LONGEST_EDGE * LONGEST_EDGE)
}

impl Veins {
    /// Whether a node is a tip.
    pub(crate) fn is_tip(&self, node: u32) -> bool {
        self.first_children[node as usize] == NO_NODE
    }

    /// No veins yet, on a blade that fills the rectangle from `low` to `high`.
    pub(crate) fn new(low: DVec2, high: DVec2, stretching: bool) -> Self {
        Self {
            positions: Vec::new(),
            starts: Vec::new(),
            births: Vec::new(),
            edges: Vec::new(),
            tree: PointTree::new(low, high),
            stems: Vec::new(),
            first_children: Vec::new(),
            joints: BTreeMap::new(),
            laid_orders: Vec::new(),
            by_length: length_queue(),
            stretching,
            minds_crossings: false,
        }
    }

    /// Number of nodes, which is also the number of the next one.
    pub(crate) fn count(&self) -> u32 {
        self.positions.len() as u32
    }

    /// Adds a node without an edge to it.
    pub(crate) fn add_node(&mut self, position: DVec2, step: u32, lamina: &Lamina) -> u32 {
        self.add_ranked_node(position, 0, step, lamina)
    }

    /// The same for a node of a vein that is laid out as one of this order.
    pub(crate) fn add_ranked_node(
        &mut self,
        position: DVec2,
        order: u8,
        step: u32,
        lamina: &Lamina,
    ) -> u32 {
        let node = self.count();
        self.laid_orders.push(order);
        self.positions.push(position);
        if lamina.moves() {
            self.starts.push(lamina.start_of(position));
        }
        self.births.push(step);
        self.stems.push(Stem {
            node: NO_NODE,
            is_joint: false,
            place: position,
        });
        self.first_children.push(NO_NODE);
        self.tree.insert(node, position);
        node
    }

    /// Adds an edge between nodes.
    pub(crate) fn add_edge(&mut self, from: u32, to: u32, lamina: &Lamina) {
        let edge = self.edges.len() as u32;
        self.edges.push([from, to]);
        if self.stems[to as usize].node == NO_NODE {
            self.set_stem(to, from);
        } else {
            self.joints.entry(to).or_default().push(from);
            self.stems[to as usize].is_joint = true;
        }
        if self.first_children[from as usize] == NO_NODE {
            self.first_children[from as usize] = to;
        }
        self.note_length(edge, lamina);
    }

    fn set_stem(&mut self, of: u32, node: u32) {
        let stem = &mut self.stems[of as usize];
        stem.node = node;
        stem.place = self.positions[node as usize];
    }

    /// Called when growth has ended: edges stretch no more.
    pub(crate) fn stop_stretching(&mut self) {
        self.stretching = false;
        self.by_length = length_queue();
    }

    /// Moves all nodes with their tissue, on a lamina that now fills the rectangle from `low` to
    /// `high`.
    pub(crate) fn carry(&mut self, lamina: &Lamina, low: DVec2, high: DVec2) {
        self.tree = PointTree::new(low, high);
        for (node, &start) in self.starts.iter().enumerate() {
            let place = lamina.now_at(start);
            self.positions[node] = place;
            self.tree.insert(node as u32, place);
        }
        for stem in &mut self.stems {
            if stem.node != NO_NODE {
                stem.place = self.positions[stem.node as usize];
            }
        }
        self.by_length = length_queue();
        for edge in 0..self.edges.len() as u32 {
            self.note_length(edge, lamina);
        }
    }

    fn note_length(&mut self, edge: u32, lamina: &Lamina) {
        if self.stretching {
            let [from, to] = self.edges[edge as usize];
            let (from, to) = (self.positions[from as usize], self.positions[to as usize]);
            let enlargement = lamina.enlargement((from + to) * 0.5);
            let squared = (to - from).length_squared() / (enlargement * enlargement);
            self.by_length.push(edge, squared);
        }
    }

    /// Subdivides edges longer than one and a half segments, the longest first and among equals the
    /// oldest.
    ///
    /// Growth stretches old segments many times over. Without new nodes, sources and second veins
    /// would appear on top of them. New nodes lie on a Catmull–Rom curve through the ends of the
    /// edge and the nodes before and after it, so that bends stay round.
    pub(crate) fn subdivide(&mut self, unit: f64, lamina: &Lamina, step: u32) {
        let longest = LONGEST_EDGE * unit;
        while let Some((edge, squared)) = self.by_length.pop_above(longest * longest) {
            // At least two, since the root may round down to the limit itself.
            let pieces = (squared.sqrt() / longest).ceil().max(2.0) as u32;
            self.cut(edge, pieces, unit, lamina, step);
        }
    }

    /// Cuts one edge into `pieces`. An edge whose pieces would leave the blade stays whole.
    fn cut(&mut self, edge: u32, pieces: u32, unit: f64, lamina: &Lamina, step: u32) {
        let [from, to] = self.edges[edge as usize];
        let at = |node: u32| self.positions[node as usize];
        let (p1, p2) = (at(from), at(to));
        let before = self.stems[from as usize].node;
        let after = self.first_children[to as usize];
        // At the end of a vein, the missing neighbour is the reflection of the edge's other end.
        let neighbour = |node: u32, mirrored: DVec2, of: DVec2| {
            if node == NO_NODE || at(node) == of {
                mirrored
            } else {
                at(node)
            }
        };
        let p0 = neighbour(before, 2.0 * p1 - p2, p1);
        let p3 = neighbour(after, 2.0 * p2 - p1, p2);
        // If the curve would leave the blade, the straight edge is used.
        let stays = |places: &[DVec2]| {
            let mut before = p1;
            places.iter().chain([&p2]).all(|&p| {
                let fine = lamina.can_reach(before, p);
                before = p;
                fine
            })
        };
        let at_shares = |curve: &dyn Fn(f64) -> DVec2| -> Vec<DVec2> {
            (1..pieces)
                .map(|i| curve(f64::from(i) / f64::from(pieces)))
                .collect()
        };
        let curved = at_shares(&|u| catmull_rom([p0, p1, p2, p3], u));
        let straight = at_shares(&|u| p1 + (p2 - p1) * u);
        let crosses = |places: &[DVec2]| {
            let line: Vec<DVec2> = [&[p1], places, &[p2]].concat();
            self.line_crosses(&line, [from, to], unit)
        };
        let curved = Some(curved).filter(|places| !self.minds_crossings || !crosses(places));
        let Some(places) = curved.into_iter().chain([straight]).find(|p| stays(p)) else {
            return;
        };
        let mut tail = from;
        let mut tail_edge = edge;
        let order = self.laid_orders[to as usize];
        for place in places {
            let node = self.add_ranked_node(place, order, step, lamina);
            self.edges[tail_edge as usize] = [tail, node];
            if self.first_children[tail as usize] == to {
                self.first_children[tail as usize] = node;
            }
            self.set_stem(node, tail);
            self.first_children[node as usize] = to;
            if self.stems[to as usize].node == tail {
                self.set_stem(to, node);
            } else if let Some(before) = self.joints.get_mut(&to) {
                before
                    .iter_mut()
                    .filter(|n| **n == tail)
                    .for_each(|n| *n = node);
            }
            let rest = self.edges.len() as u32;
            self.edges.push([node, to]);
            self.note_length(tail_edge, lamina);
            (tail, tail_edge) = (node, rest);
        }
        self.note_length(tail_edge, lamina);
    }

    /// Joins veins that have arrived at a source by a junction node there (anastomosis). With fewer
    /// than two veins near enough the network is unchanged.
    pub(crate) fn weld(
        &mut self,
        source: DVec2,
        arrivals: &[u32],
        unit: f64,
        lamina: &Lamina,
        step: u32,
    ) {
        let unit = unit * lamina.enlargement(source);
        let reach = WELDING_REACH * unit;
        let ends: Vec<u32> = arrivals
            .iter()
            .copied()
            .filter(|&v| (self.positions[v as usize] - source).length_squared() <= reach * reach)
            .collect();
        if ends.len() < 2 {
            return;
        }
        // If a vein ends at the source itself, they meet midway instead.
        let sum: DVec2 = ends.iter().map(|&v| self.positions[v as usize]).sum();
        let middle = sum / ends.len() as f64;
        let free = |p: &DVec2| lamina.contains(*p) && !self.tree.any_within(*p, COINCIDENT * unit);
        let Some(place) = [source, middle].into_iter().find(free) else {
            return;
        };
        let mut ends = ends;
        ends.retain(|&v| {
            lamina.can_reach(self.positions[v as usize], place)
                && !(self.minds_crossings && self.crosses(v, place, unit))
        });
        if ends.len() < 2 {
            return;
        }
        let junction = self.add_node(place, step, lamina);
        for end in ends {
            self.add_edge(end, junction, lamina);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::shape::outline::Outline;
    use crate::venation::plan::AuxinPlan;

    fn blade() -> Outline {
        let corners = [(-50.0, 0.0), (50.0, 0.0), (50.0, 100.0), (-50.0, 100.0)];
        let points = corners.map(DVec2::from).to_vec();
        Outline::new(points, DVec2::ZERO, DVec2::new(0.0, 100.0)).expect("a square")
    }

    fn lamina(blade: &Outline) -> Lamina<'_> {
        Lamina::new(&AuxinPlan::default(), blade, None)
    }

    /// A chain of nodes two segments apart, as after tissue has doubled in size.
    fn chain(places: &[(f64, f64)]) -> Veins {
        let blade = blade();
        let (low, high) = blade.bounds();
        let mut veins = Veins::new(low, high, true);
        for (i, &place) in places.iter().enumerate() {
            let node = veins.add_node(DVec2::from(place), 0, &lamina(&blade));
            if i > 0 {
                veins.add_edge(node - 1, node, &lamina(&blade));
            }
        }
        veins
    }

    #[test]
    fn subdivision_leaves_no_long_edge_and_keeps_the_chain() {
        let mut veins = chain(&[(0.0, 1.0), (0.0, 3.0), (1.0, 13.0), (2.0, 14.9)]);
        veins.subdivide(1.0, &lamina(&blade()), 5);
        for &[from, to] in &veins.edges {
            let ends = veins.positions[to as usize] - veins.positions[from as usize];
            assert!(
                ends.length() <= 1.5,
                "{from}–{to} is {} long",
                ends.length()
            );
        }
        // Walking back from the tip meets every node once and ends at the seed.
        let (mut node, mut met) = (3, 1);
        while veins.stems[node].node != NO_NODE {
            let parent = veins.stems[node].node;
            assert_eq!(veins.stems[node].place, veins.positions[parent as usize]);
            assert!(veins.edges.contains(&[parent, node as u32]));
            assert_eq!(veins.first_children[parent as usize], node as u32);
            node = parent as usize;
            met += 1;
        }
        assert_eq!((node, met), (0, veins.positions.len()));
    }

    #[test]
    fn a_bend_stays_round_when_it_is_subdivided() {
        // On a circle of radius 10, midpoints of chords 2.6 long lie 0.085 inside it.
        let places: Vec<(f64, f64)> = (0..8)
            .map(|i| 0.26 * f64::from(i))
            .map(|a| (10.0 * libm::cos(a), 30.0 + 10.0 * libm::sin(a)))
            .collect();
        let mut veins = chain(&places);
        veins.subdivide(1.0, &lamina(&blade()), 1);
        let inner = veins.positions.iter().skip(8).filter(|p| {
            let a = libm::atan2(p.y - 30.0, p.x);
            (0.3..1.5).contains(&a)
        });
        for p in inner {
            let radius = (*p - DVec2::new(0.0, 30.0)).length();
            assert!((radius - 10.0).abs() < 0.01, "{radius}");
        }
    }

    #[test]
    fn two_veins_at_a_source_are_joined_there_and_one_is_not() {
        let mut veins = chain(&[(0.0, 1.0), (0.0, 2.0)]);
        let other = veins.add_node(DVec2::new(1.5, 2.5), 0, &lamina(&blade()));
        let far = veins.add_node(DVec2::new(9.0, 2.5), 0, &lamina(&blade()));
        let source = DVec2::new(0.8, 2.4);
        veins.weld(source, &[1], 1.0, &lamina(&blade()), 1);
        veins.weld(source, &[1, far], 1.0, &lamina(&blade()), 1);
        assert_eq!(veins.count(), 4);
        veins.weld(source, &[1, other], 1.0, &lamina(&blade()), 1);
        assert_eq!(veins.count(), 5);
        assert_eq!(veins.positions[4], source);
        assert_eq!(veins.edges[1..], [[1, 4], [other, 4]]);
    }
}
