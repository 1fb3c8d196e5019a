//! How veins supply a leaf with water, and what is lost when they are cut.
//!
//! Each edge is a pipe with the radii of the vein, in which water flows by Poiseuille's law: a cone
//! between the radii `r` and `s` over the length `l` has the conductance
//! `g = 3 π r³ s³ / (8 μ l (r² + r s + s²))`, which is `π r⁴ / (8 μ l)` for a cylinder
//! (\[sutera1993\]). Water enters at the petiole, the origins of the network, and leaves evenly along
//! all veins: each edge loses half of its length's share at either end. With the drop of pressure
//! `pᵢ` from the petiole to node `i`, which loses `qᵢ`, the **conductance** is
//! `K = Q / p̄ = Q² / Σ qᵢ pᵢ`, with `Q = Σ qᵢ` and the mean drop `p̄` over all that leaves.
//!
//! A vein holds many conduits far finer than itself, so `K` is far above that of a leaf; ratios
//! between leaves and losses are what it is for.

#[cfg(test)]
mod tests;

use glam::DVec2;

use super::Subject;
use super::bridges;
use super::laplacian::{Factored, Pipe};
use crate::venation::network::VeinEdge;
use crate::venation::planar::PlaneGraph;

/// Viscosity of water at 20 °C, 1.0016 mPa s (\[huber2009\]), in megapascal seconds: lengths in mm then give
/// conductances in mm³ s⁻¹ MPa⁻¹.
const VISCOSITY_MPA_S: f64 = 1.0016e-9;

/// Where less of the flow between a pipe's ends than this share has a way around the pipe, that share
/// is a difference of numbers too near to each other: the network is solved anew without the pipe.
const LEAST_AROUND: f64 = 1e-8;

/// What is lost when one vein is cut in its middle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cut {
    /// Where, mm: the end of the edge in the middle of the vein.
    pub place: DVec2,
    /// Order of the vein.
    pub order: u8,
    /// Its mean radius, mm.
    pub radius_mm: f64,
    /// Its length from junction to junction, mm.
    pub length_mm: f64,
    /// Share of what leaves that is not supplied any more.
    pub cut_off: f64,
    /// Share of the conductance that is lost to what is still supplied; 0 where something is cut
    /// off, since nothing flows past there then.
    pub lost: f64,
}

/// What is lost without all veins of an order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrderLoss {
    /// The order.
    pub order: u8,
    /// Share of the length of all other veins that is cut off.
    pub cut_off: f64,
    /// Share of the conductance that is lost to what is still supplied, by the same outflow; `None`
    /// if nothing is.
    pub lost: Option<f64>,
}

/// The supply of a leaf by its veins.
#[derive(Clone, Debug, PartialEq)]
pub struct Supply {
    /// Conductance from the petiole, mm³ s⁻¹ MPa⁻¹.
    pub conductance: f64,
    /// Share of the length of veins that hangs together with the petiole.
    pub supplied: f64,
    /// Share of that length on edges whose cut cuts something off.
    pub bridges: f64,
    /// Cuts through the widest veins, widest first.
    pub cuts: Vec<Cut>,
    /// Losses by order.
    pub orders: Vec<OrderLoss>,
}

impl Subject<'_> {
    /// The supply from the petiole, and what is lost when each of the `widest` widest veins is cut,
    /// one at a time, and when all veins of an order are.
    ///
    /// `None` if radii are not known, no vein begins at an origin, or a conductance is
    /// not finite. Losses by order take a solution
    /// for each order; without known orders there are none.
    pub fn supply(&self, widest: usize) -> Option<Supply> {
        if !self.known.radii {
            return None;
        }
        let graph = self.found.graph();
        let roots = self.roots();
        let whole = Pipes::new(graph, &roots, |_| true)?;
        let total: f64 = graph.edges().iter().map(|edge| length(graph, edge)).sum();
        let factored = Factored::new(&whole.places, &whole.pipes)?;
        let drops = factored.solve(&whole.outflow);
        let power = dot(&whole.outflow, &drops);
        if !(power.is_finite() && power > 0.0) {
            return None;
        }
        let beyond = bridges::beyond(whole.places.len(), &whole.pipes, &whole.outflow);
        let bridges: f64 = whole
            .edges
            .iter()
            .zip(&beyond)
            .filter(|(_, beyond)| beyond.is_some())
            .map(|(&edge, _)| length(graph, &graph.edges()[edge as usize]))
            .sum();
        let cuts = self.cuts(&whole, &factored, (&drops, power), &beyond, widest);
        let orders = if self.known.orders {
            self.without_orders(&roots, &whole, &factored)
        } else {
            Vec::new()
        };
        Some(Supply {
            conductance: std::f64::consts::PI / (8.0 * VISCOSITY_MPA_S) * whole.total * whole.total
                / power,
            supplied: whole.total / total,
            bridges: bridges / whole.total,
            cuts,
            orders,
        })
    }

    /// Which nodes of the plane graph are origins.
    fn roots(&self) -> Vec<bool> {
        let origins = &self.network.nodes()[..self.network.origins()];
        let mut places: Vec<[u64; 2]> = origins.iter().map(|node| bits(node.position)).collect();
        places.sort_unstable();
        let nodes = self.found.graph().nodes().iter();
        nodes
            .map(|place| places.binary_search(&bits(*place)).is_ok())
            .collect()
    }

    fn cuts(
        &self,
        whole: &Pipes,
        factored: &Factored,
        (drops, power): (&[f64], f64),
        beyond: &[Option<f64>],
        widest: usize,
    ) -> Vec<Cut> {
        let (chains, graph) = (self.found.chains(), self.found.graph());
        let mut order: Vec<u32> = (0..chains.len() as u32).collect();
        let radius = |chain: u32| chains.radii[chain as usize];
        order.sort_by(|&a, &b| radius(b).total_cmp(&radius(a)).then(a.cmp(&b)));
        let mut pipe_of = vec![u32::MAX; graph.edges().len()];
        for (pipe, &edge) in (0..).zip(&whole.edges) {
            pipe_of[edge as usize] = pipe;
        }
        let mut scratch = vec![0.0; whole.places.len()];
        let drop_at = |end: u32| {
            if end == Pipe::GROUND {
                0.0
            } else {
                drops[end as usize]
            }
        };
        let cut = |&chain: &u32| {
            let edges = chains.edges(chain);
            let edge = edges[edges.len() / 2];
            let pipe = pipe_of[edge as usize];
            if pipe == u32::MAX {
                return None; // It hangs together with no petiole.
            }
            let Pipe { ends, conductance } = whole.pipes[pipe as usize];
            let (cut_off, lost) = if let Some(beyond) = beyond[pipe as usize] {
                (beyond / whole.total, 0.0)
            } else {
                // By Sherman and Morrison's formula for one pipe less.
                let between = drop_at(ends[0]) - drop_at(ends[1]);
                let around = 1.0 - conductance * factored.resistance(ends, &mut scratch);
                let more = conductance * between * between / around;
                let lost = more / (power + more);
                if around >= LEAST_AROUND && lost.is_finite() {
                    (0.0, lost)
                } else {
                    (0.0, whole.lost_without(pipe, power))
                }
            };
            let first = &graph.edges()[edge as usize];
            Some(Cut {
                place: graph.nodes()[first.to as usize],
                order: first.order,
                radius_mm: radius(chain),
                length_mm: chains.lengths[chain as usize],
                cut_off,
                lost,
            })
        };
        order.iter().filter_map(cut).take(widest).collect()
    }

    fn without_orders(&self, roots: &[bool], whole: &Pipes, factored: &Factored) -> Vec<OrderLoss> {
        let graph = self.found.graph();
        let mut lengths = vec![0.0; usize::from(u8::MAX) + 1];
        for &edge in &whole.edges {
            let edge = &graph.edges()[edge as usize];
            lengths[usize::from(edge.order)] += length(graph, edge);
        }
        let without = |order: u8| {
            let others = whole.total - lengths[usize::from(order)];
            let Some(left) = Pipes::new(graph, roots, |edge| edge.order != order) else {
                let cut_off = if others > 0.0 { 1.0 } else { 0.0 };
                return OrderLoss {
                    order,
                    cut_off,
                    lost: None,
                };
            };
            let after = Factored::new(&left.places, &left.pipes);
            let after = after.map(|after| after.solve(&left.outflow));
            // The same outflow in the whole network.
            let mut outflow = vec![0.0; whole.places.len()];
            for (&node, value) in left.nodes.iter().zip(&left.outflow) {
                outflow[whole.number[node as usize] as usize] = *value;
            }
            let before = dot(&outflow, &factored.solve(&outflow));
            OrderLoss {
                order,
                cut_off: (1.0 - left.total / others).max(0.0),
                lost: after
                    .map(|after| 1.0 - before / dot(&left.outflow, &after))
                    .filter(|lost| lost.is_finite()),
            }
        };
        let orders = (1..=u8::MAX).filter(|order| lengths[usize::from(*order)] > 0.0);
        orders.map(without).collect()
    }
}

fn bits(place: DVec2) -> [u64; 2] {
    [place.x.to_bits(), place.y.to_bits()]
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn length(graph: &PlaneGraph, edge: &VeinEdge) -> f64 {
    (graph.nodes()[edge.to as usize] - graph.nodes()[edge.from as usize]).length()
}

/// The pipes that hang together with the petiole.
#[expect(clippy::struct_field_names, reason = "they are its pipes")]
struct Pipes {
    /// Places of the unknowns.
    places: Vec<DVec2>,
    /// Nodes of the graph that are unknowns.
    nodes: Vec<u32>,
    /// Number of the unknown of each node of the graph.
    number: Vec<u32>,
    /// The pipes, conductances in units of `π/(8 μ)`.
    pipes: Vec<Pipe>,
    /// The edge of the graph that each pipe is.
    edges: Vec<u32>,
    /// What leaves at each unknown: length, mm.
    outflow: Vec<f64>,
    /// What leaves in all, at the petiole too.
    total: f64,
}

impl Pipes {
    /// `None` if no wanted edge begins at a root.
    fn new(
        graph: &PlaneGraph,
        roots: &[bool],
        is_wanted: impl Fn(&VeinEdge) -> bool,
    ) -> Option<Self> {
        let mut starts = vec![0_u32; graph.nodes().len() + 1];
        let wanted = || {
            (0..)
                .zip(graph.edges())
                .filter(|(_, edge): &(u32, _)| is_wanted(edge))
        };
        for (_, edge) in wanted() {
            for end in [edge.from, edge.to] {
                starts[end as usize + 1] += 1;
            }
        }
        for node in 1..starts.len() {
            starts[node] += starts[node - 1];
        }
        let mut next = starts.clone();
        let mut around = vec![0_u32; starts[starts.len() - 1] as usize];
        for (number, edge) in wanted() {
            for end in [edge.from, edge.to] {
                let at = &mut next[end as usize];
                around[*at as usize] = number;
                *at += 1;
            }
        }
        let mut is_reached = roots.to_vec();
        let mut open: Vec<u32> = (0..)
            .zip(roots)
            .filter(|(_, root)| **root)
            .map(|(n, _)| n)
            .collect();
        while let Some(node) = open.pop() {
            let node = node as usize;
            for &edge in &around[starts[node] as usize..starts[node + 1] as usize] {
                let edge = &graph.edges()[edge as usize];
                for end in [edge.from, edge.to] {
                    if !std::mem::replace(&mut is_reached[end as usize], true) {
                        open.push(end);
                    }
                }
            }
        }
        let mut pipes = Self {
            places: Vec::new(),
            nodes: Vec::new(),
            number: vec![Pipe::GROUND; graph.nodes().len()],
            pipes: Vec::new(),
            edges: Vec::new(),
            outflow: Vec::new(),
            total: 0.0,
        };
        for (node, place) in (0..).zip(graph.nodes()) {
            if is_reached[node as usize] && !roots[node as usize] {
                pipes.number[node as usize] = pipes.nodes.len() as u32;
                pipes.nodes.push(node);
                pipes.places.push(*place);
            }
        }
        pipes.outflow = vec![0.0; pipes.nodes.len()];
        for (number, edge) in wanted() {
            if is_reached[edge.from as usize] {
                pipes.add(graph, number);
            }
        }
        (!pipes.places.is_empty()).then_some(pipes)
    }

    /// Share of the conductance that is lost without a pipe that is no bridge, from a solution
    /// without it; `power` is `Σ qᵢ pᵢ` with it.
    fn lost_without(&self, pipe: u32, power: f64) -> f64 {
        let mut pipes = self.pipes.clone();
        pipes.remove(pipe as usize);
        let after = Factored::new(&self.places, &pipes)
            .map(|after| dot(&self.outflow, &after.solve(&self.outflow)))
            .filter(|after| after.is_finite());
        // A way around with a conductance too small for a number conducts nothing.
        after.map_or(1.0, |after| (1.0 - power / after).max(0.0))
    }

    fn add(&mut self, graph: &PlaneGraph, number: u32) {
        let edge = &graph.edges()[number as usize];
        let (l, r, s) = (length(graph, edge), edge.radius_from, edge.radius_to);
        let (r3, s3) = (r * r * r, s * s * s);
        let ends = [edge.from, edge.to].map(|end| self.number[end as usize]);
        for end in ends.into_iter().filter(|end| *end != Pipe::GROUND) {
            self.outflow[end as usize] += 0.5 * l;
        }
        self.total += l;
        if ends != [Pipe::GROUND; 2] {
            let conductance = 3.0 * r3 * s3 / (l * (r * r + r * s + s * s));
            self.pipes.push(Pipe { ends, conductance });
            self.edges.push(number);
        }
    }
}
