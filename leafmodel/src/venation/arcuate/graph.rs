//! Splines as a network: chains of nodes that end on the margin or meet where splines cross.

use glam::DVec2;

use super::layout::ArcuateVeins;
use super::layout::Vein;
use crate::buckets::Buckets;
use crate::numeric::bisect;
use crate::plane::bounds;
use crate::plane::segment::crossing;
use crate::shape::outline::Outline;
use crate::venation::network::{NetworkError, VeinEdge, VeinNode, VenationNetwork};

/// Number of pieces of the midrib.
const PIECES: f64 = 120.0;

/// Least radius of a vein, as a share of `Width`. The article's veins taper to 0; a network needs
/// radii above 0.
const LEAST_RADIUS: f64 = 0.02;

/// Nodes nearer together than this share of the midrib's length are merged.
const SAME: f64 = 1e-9;

/// Lays the veins on a blade as a network.
pub(super) fn network(
    veins: &ArcuateVeins,
    outline: &Outline,
) -> Result<VenationNetwork, NetworkError> {
    let (mut graph, on_axes) = axes(veins, outline);
    for lateral in &veins.laterals {
        // An axis that the margin cut short bears no laterals beyond its end.
        if let Some(from) = node_at(&on_axes[lateral.axis], lateral.start) {
            graph.lateral(lateral, from);
        }
    }
    graph.finish()
}

/// The share of each primary's length that is laid.
pub(super) fn primaries_laid(veins: &ArcuateVeins, outline: &Outline) -> Vec<f64> {
    let (graph, on_axes) = axes(veins, outline);
    let laid = |(axis, nodes): (&Vein, &Vec<(f64, u32)>)| {
        let steps = nodes.windows(2).map(|pair| {
            let [from, to] = [pair[0].1, pair[1].1].map(|node| graph.nodes[node as usize]);
            (to - from).length()
        });
        let count = pieces(axis);
        let at = |i: u32| axis.curve.at(f64::from(i) / f64::from(count));
        let whole: f64 = (0..count).map(|i| (at(i + 1) - at(i)).length()).sum();
        (steps.sum::<f64>() / (whole * graph.length())).min(1.0)
    };
    veins.axes.iter().zip(&on_axes).skip(1).map(laid).collect()
}

/// Midrib and primaries on a blade. For each axis it also returns the nodes from which laterals
/// start, with their parameters.
fn axes<'v>(veins: &'v ArcuateVeins, outline: &'v Outline) -> (Graph<'v>, Vec<Vec<(f64, u32)>>) {
    let mut graph = Graph {
        veins,
        outline,
        nodes: vec![veins.frame.to_mm(DVec2::ZERO)],
        edges: Vec::new(),
        boxes: Vec::new(),
    };
    let mut on_axes: Vec<Vec<(f64, u32)>> = Vec::new();
    for (number, axis) in veins.axes.iter().enumerate() {
        let primaries = if number == 0 { &veins.axes[1..] } else { &[] };
        let starts = veins
            .laterals
            .iter()
            .chain(primaries)
            .filter(|vein| vein.axis == number)
            .map(|vein| vein.start);
        let from = if number == 0 {
            Some(0)
        } else {
            node_at(&on_axes[0], axis.start)
        };
        let nodes = from.map(|from| graph.axis(axis, from, starts.collect()));
        on_axes.push(nodes.unwrap_or_default());
    }
    (graph, on_axes)
}

/// The node of an axis at a parameter, if there is one.
fn node_at(nodes: &[(f64, u32)], t: f64) -> Option<u32> {
    let node = nodes.iter().find(|(at, _)| (at - t).abs() < SAME);
    node.map(|&(_, node)| node)
}

/// Number of pieces of a vein, so that they are about as long as the midrib's.
fn pieces(vein: &Vein) -> u32 {
    let [a, b, c] = vein.curve.0;
    let length = (b - a).length() + (c - b).length();
    (length * PIECES).ceil().clamp(2.0, 10.0 * PIECES) as u32
}

struct Graph<'v> {
    veins: &'v ArcuateVeins,
    outline: &'v Outline,
    nodes: Vec<DVec2>,
    edges: Vec<VeinEdge>,
    /// The edges of one vein are consecutive: the first edge of each vein, and the box around its
    /// edges.
    boxes: Vec<(usize, DVec2, DVec2)>,
}

/// The path of a vein over the blade.
struct Way {
    /// Places along the path, the start left out, mm.
    places: Vec<DVec2>,
    /// If the path meets another vein, the edge of that vein and the place on it. Else the path
    /// ends with the spline or at the margin.
    meets: Option<(usize, f64)>,
}

impl Graph<'_> {
    fn length(&self) -> f64 {
        self.veins.frame.length()
    }

    /// Adds the midrib or a primary with nodes where laterals start; returns its nodes by
    /// parameter.
    fn axis(&mut self, axis: &Vein, from: u32, mut stops: Vec<f64>) -> Vec<(f64, u32)> {
        let pieces = pieces(axis);
        stops.extend((1..=pieces).map(|i| f64::from(i) / f64::from(pieces)));
        stops.sort_by(f64::total_cmp);
        stops.dedup_by(|next, before| *next - *before < SAME);
        stops.retain(|&t| t > SAME);
        let way = self.way(axis, from, &stops);
        let radius = |t: &f64| self.veins.axis_radius(axis, *t);
        let radii = std::iter::once(&0.0).chain(&stops).map(radius).collect();
        let nodes = self.lay(from, &way, radii, 1);
        let places = std::iter::once(0.0).chain(stops);
        places.zip(nodes).collect()
    }

    fn lateral(&mut self, vein: &Vein, from: u32) {
        let pieces = pieces(vein);
        let stops: Vec<f64> = (1..=pieces)
            .map(|i| f64::from(i) / f64::from(pieces))
            .collect();
        let way = self.way(vein, from, &stops);
        let radius = |t: &f64| self.veins.lateral_radius(vein, *t, vein.curve.at(*t));
        let radii: Vec<f64> = std::iter::once(&0.0).chain(&stops).map(radius).collect();
        // At a narrow base a vein that would end within the width of its axis is left out.
        let begin = self.nodes[from as usize];
        let out = |p: &DVec2| (*p - begin).length() >= radii[0] * self.length();
        if way.places.iter().any(out) {
            self.lay(from, &way, radii, 2);
        }
    }

    /// Whether the straight line from `a`, on the blade, to `b` leaves the blade.
    fn leaves_blade(&self, a: DVec2, b: DVec2) -> bool {
        self.outline.is_crossed_by(a, b) || !self.outline.covers(b)
    }

    /// Follows a spline from a node up to the margin or another vein.
    fn way(&self, vein: &Vein, from: u32, stops: &[f64]) -> Way {
        let mut way = Way {
            places: Vec::with_capacity(stops.len()),
            meets: None,
        };
        let mut a = self.nodes[from as usize];
        for &t in stops {
            let mut b = self.veins.frame.to_mm(vein.curve.at(t));
            let ends = self.leaves_blade(a, b);
            if ends {
                // Bisection for the last point on the blade.
                let stays = |share| !self.leaves_blade(a, a.lerp(b, share));
                b = a.lerp(b, bisect(0.0, 1.0, 60, stays).0);
            }
            way.meets = self.first_crossing(a, b);
            if let Some((edge, share)) = way.meets {
                let [c, d] = self.ends(edge);
                way.places.push(c.lerp(d, share));
                break;
            }
            if (b - a).length() > SAME * self.length() {
                way.places.push(b);
            }
            if ends {
                break;
            }
            a = b;
        }
        way
    }

    /// Adds a path as a vein; returns its nodes. A path that would close a directed cycle is left
    /// out.
    fn lay(&mut self, from: u32, way: &Way, radii: Vec<f64>, order: u8) -> Vec<u32> {
        let mut nodes = vec![from];
        let upstream = |(edge, share): (usize, f64)| {
            let above = self.above(from);
            let VeinEdge { from, to, .. } = self.edges[edge];
            above[to as usize] || (above[from as usize] && share <= self.least_share(edge))
        };
        if way.meets.is_some_and(upstream) {
            return nodes;
        }
        let joint = way.meets.map(|(edge, share)| self.node_on(edge, share));
        let start = self.edges.len();
        let (mut low, mut high) = bounds([]);
        // The radius never grows, even where a lateral bends back to where its axis is wider.
        let mut radius = f64::INFINITY;
        let mut taper = radii.into_iter().map(|here| {
            radius = here.max(LEAST_RADIUS * self.veins.plan.width).min(radius);
            radius * self.veins.frame.length()
        });
        let mut radius_from = taper.next().unwrap_or(f64::INFINITY);
        for (i, (&place, radius_to)) in way.places.iter().zip(taper).enumerate() {
            let before = nodes[nodes.len() - 1];
            let node = match joint {
                Some(joint) if i + 1 == way.places.len() => joint,
                Some(_) | None => {
                    self.nodes.push(place);
                    (self.nodes.len() - 1) as u32
                }
            };
            if node != before {
                self.edges.push(VeinEdge {
                    from: before,
                    to: node,
                    radius_from,
                    radius_to,
                    order,
                });
                for end in [before, node].map(|node| self.nodes[node as usize]) {
                    (low, high) = (low.min(end), high.max(end));
                }
                nodes.push(node);
            }
            radius_from = radius_to;
        }
        self.boxes.push((start, low, high));
        nodes
    }

    /// For each node whether it leads to this one; a node leads to itself.
    fn above(&self, node: u32) -> Vec<bool> {
        let leading = self.edges.iter().map(|edge| (edge.to as usize, edge.from));
        let leading = Buckets::new(self.nodes.len(), leading);
        let mut above = vec![false; self.nodes.len()];
        let mut open = vec![node];
        while let Some(node) = open.pop() {
            if !std::mem::replace(&mut above[node as usize], true) {
                open.extend(leading.list(node as usize));
            }
        }
        above
    }

    fn ends(&self, edge: usize) -> [DVec2; 2] {
        let VeinEdge { from, to, .. } = self.edges[edge];
        [from, to].map(|node| self.nodes[node as usize])
    }

    /// The edge of an earlier vein that a–b crosses first, and where on that edge.
    fn first_crossing(&self, a: DVec2, b: DVec2) -> Option<(usize, f64)> {
        let (low, high) = (a.min(b), a.max(b));
        let ends = self.boxes.iter().skip(1).map(|vein| vein.0);
        let ends = ends.chain([self.edges.len()]);
        let mut first: Option<(f64, usize, f64)> = None;
        for (&(start, vein_low, vein_high), end) in self.boxes.iter().zip(ends) {
            if low.cmpgt(vein_high).any() || vein_low.cmpgt(high).any() {
                continue;
            }
            for edge in start..end {
                let [c, d] = self.ends(edge);
                if let Some((along, share)) = crossing(a, b, c, d)
                    && first.is_none_or(|first| along < first.0)
                {
                    first = Some((along, edge, share));
                }
            }
        }
        first.map(|(_, edge, share)| (edge, share))
    }

    /// The share of an edge below which two places on it count as one.
    fn least_share(&self, edge: usize) -> f64 {
        let [a, b] = self.ends(edge);
        SAME * self.length() / (b - a).length()
    }

    /// The node at a place on an edge: one of its ends if that is close enough, else a new node
    /// that subdivides the edge.
    fn node_on(&mut self, edge: usize, share: f64) -> u32 {
        let whole = self.edges[edge];
        let [a, b] = self.ends(edge);
        let least = self.least_share(edge);
        if share <= least {
            return whole.from;
        }
        if share >= 1.0 - least {
            return whole.to;
        }
        let node = self.nodes.len() as u32;
        self.nodes.push(a.lerp(b, share));
        let radius = whole.radius_from + (whole.radius_to - whole.radius_from) * share;
        let first = VeinEdge {
            to: node,
            radius_to: radius,
            ..whole
        };
        let second = VeinEdge {
            from: node,
            radius_from: radius,
            ..whole
        };
        self.edges[edge] = first;
        self.edges.insert(edge + 1, second);
        for vein in &mut self.boxes {
            if vein.0 > edge {
                vein.0 += 1;
            }
        }
        node
    }

    fn finish(self) -> Result<VenationNetwork, NetworkError> {
        let segment = self.length() / PIECES;
        let nodes = self
            .nodes
            .into_iter()
            .map(|position| VeinNode { position, born: 0 })
            .collect();
        let mut edges = self.edges;
        edges.sort_by_key(|edge| (edge.to, edge.from));
        VenationNetwork::from_parts(nodes, edges, segment)
    }
}
