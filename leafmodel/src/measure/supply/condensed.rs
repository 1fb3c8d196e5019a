//! Veins condensed to the nodes where they meet, end or change, without loss.
//!
//! Between two nodes that matter, a vein is a row of pipes with resistances `r` from which water
//! leaves at the nodes between. With `s` the resistance from one end to such a node, `t` from the
//! other and `R = s + t`, what leaves there is drawn from the ends in shares `t/R` and `s/R`, and
//! flows on its way through the row with a power that does not depend on the ends: the sum of
//! `qᵢ pᵢ` with both ends at pressure 0. So a row becomes one pipe of resistance `R`, outflows at
//! its ends, and a power of its own (a Schur complement). Of a net with a million nodes a tenth
//! remains.

use glam::DVec2;

use crate::buckets::Buckets;
use crate::measure::laplacian::{Factored, Pipe};
use crate::venation::areole::chains::Chains;
use crate::venation::network::VeinEdge;
use crate::venation::planar::PlaneGraph;

/// A row of edges without a node that matters between its ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    /// The ends as unknowns, or [`Pipe::GROUND`] at the petiole.
    pub(super) ends: [u32; 2],
    /// In units of `π/(8 μ)`.
    conductance: f64,
    /// What leaves along it, mm, as it is drawn from the ends.
    outflow: [f64; 2],
    /// The power of what leaves along it and between the ends, with both at pressure 0.
    own_power: f64,
    /// Its length, mm.
    pub(super) length: f64,
    pub(super) order: u8,
    /// The chain of which it is a part.
    chain: u32,
}

/// All veins of a graph as stretches.
pub(super) struct Stretches {
    pub(super) all: Vec<Stretch>,
    /// Places of the unknowns.
    places: Vec<DVec2>,
    /// For each chain that is to be cut the stretch that its middle edge is.
    pub(super) middles: Vec<(u32, u32)>,
}

impl Stretches {
    /// `is_cut` tells the chains whose middle edge becomes a stretch of its own. A stretch has
    /// veins of one order.
    pub(super) fn new(
        graph: &PlaneGraph,
        chains: &Chains,
        roots: &[bool],
        is_cut: impl Fn(u32) -> bool,
    ) -> Self {
        let mut stretches = Self {
            all: Vec::with_capacity(chains.len()),
            places: Vec::new(),
            middles: Vec::new(),
        };
        let mut number = vec![Pipe::GROUND; graph.nodes().len()];
        let mut row = Row::default();
        for chain in 0..chains.len() as u32 {
            let edges = chains.edges(chain);
            let middle = is_cut(chain).then_some(edges.len() / 2);
            let mut at = chains.joints[chains.ends[chain as usize][0] as usize];
            let mut from = stretches.unknown(at, graph, roots, &mut number);
            for (i, &edge) in edges.iter().enumerate() {
                let edge = &graph.edges()[edge as usize];
                at = if edge.from == at { edge.to } else { edge.from };
                let is_forward = edge.to == at;
                row.push(edge, length(graph, edge), is_forward);
                let next = edges.get(i + 1).map(|&next| &graph.edges()[next as usize]);
                let is_middle = middle == Some(i);
                let goes_on = next.is_some_and(|next| next.order == edge.order)
                    && !roots[at as usize]
                    && !is_middle
                    && middle != Some(i + 1);
                if goes_on {
                    continue;
                }
                let to = stretches.unknown(at, graph, roots, &mut number);
                if is_middle {
                    let this = stretches.all.len() as u32;
                    stretches.middles.push((chain, this));
                }
                stretches
                    .all
                    .push(row.condensed([from, to], edge.order, chain));
                from = to;
            }
        }
        stretches
    }

    /// The unknown of a node.
    fn unknown(
        &mut self,
        node: u32,
        graph: &PlaneGraph,
        roots: &[bool],
        number: &mut [u32],
    ) -> u32 {
        if roots[node as usize] {
            return Pipe::GROUND;
        }
        let unknown = &mut number[node as usize];
        if *unknown == Pipe::GROUND {
            *unknown = self.places.len() as u32;
            self.places.push(graph.nodes()[node as usize]);
        }
        *unknown
    }

    /// Which stretches hang together with the petiole by wanted ones.
    fn reached(&self, is_wanted: impl Fn(&Stretch) -> bool) -> Vec<bool> {
        let ends = |stretch: &Stretch| {
            let unknowns = stretch.ends.into_iter();
            unknowns.filter(|&end| end != Pipe::GROUND)
        };
        let wanted = || (0..).zip(&self.all).filter(|(_, s)| is_wanted(s));
        let at_ends = wanted()
            .flat_map(|(number, stretch)| ends(stretch).map(move |end| (end as usize, number)));
        let around = Buckets::new(self.places.len(), at_ends);
        let mut is_reached = vec![false; self.all.len()];
        let mut open = Vec::new();
        for (number, stretch) in wanted() {
            if stretch.ends.contains(&Pipe::GROUND) {
                is_reached[number as usize] = true;
                open.push(number);
            }
        }
        while let Some(number) = open.pop() {
            for end in ends(&self.all[number as usize]) {
                for &other in around.list(end as usize) {
                    if !std::mem::replace(&mut is_reached[other as usize], true) {
                        open.push(other);
                    }
                }
            }
        }
        is_reached
    }

    /// Which chains hang together with the petiole.
    pub(super) fn reached_chains(&self, count: usize) -> Vec<bool> {
        let mut chains = vec![false; count];
        for (stretch, is_reached) in self.all.iter().zip(self.reached(|_| true)) {
            chains[stretch.chain as usize] |= is_reached;
        }
        chains
    }

    /// The system of the wanted stretches that hang together with the petiole; `None` if none does.
    pub(super) fn system(&self, is_wanted: impl Fn(&Stretch) -> bool) -> Option<System> {
        let is_reached = self.reached(is_wanted);
        let mut system = System {
            places: Vec::new(),
            number: vec![Pipe::GROUND; self.places.len()],
            unknowns: Vec::new(),
            pipes: Vec::new(),
            stretches: Vec::new(),
            outflow: Vec::new(),
            own_power: 0.0,
            total: 0.0,
            lengths: vec![0.0; usize::from(u8::MAX) + 1],
        };
        let reached = (0..)
            .zip(&self.all)
            .filter(|(i, _)| is_reached[*i as usize]);
        for (number, stretch) in reached {
            let ends = stretch.ends.map(|end| system.unknown(end, &self.places));
            for (end, outflow) in ends.into_iter().zip(stretch.outflow) {
                if end != Pipe::GROUND {
                    system.outflow[end as usize] += outflow;
                }
            }
            system.own_power += stretch.own_power;
            system.total += stretch.length;
            system.lengths[usize::from(stretch.order)] += stretch.length;
            if ends[0] != ends[1] {
                let conductance = stretch.conductance;
                system.pipes.push(Pipe { ends, conductance });
                system.stretches.push(number);
            }
        }
        let is_empty = system.places.is_empty() && system.own_power == 0.0;
        (!is_empty).then_some(system)
    }
}

/// Pipes, and what leaves between them.
pub(super) struct System {
    places: Vec<DVec2>,
    /// The number here of each of all unknowns.
    number: Vec<u32>,
    /// The number among all unknowns of each one here.
    unknowns: Vec<u32>,
    /// Stretches between different ends.
    pub(super) pipes: Vec<Pipe>,
    /// The stretch that each pipe is.
    pub(super) stretches: Vec<u32>,
    /// What leaves at each unknown: length, mm.
    pub(super) outflow: Vec<f64>,
    /// The power of what leaves between the unknowns.
    own_power: f64,
    /// What leaves in all, at the petiole too.
    pub(super) total: f64,
    /// The same by order.
    pub(super) lengths: Vec<f64>,
}

impl System {
    fn unknown(&mut self, of_all: u32, places: &[DVec2]) -> u32 {
        if of_all == Pipe::GROUND {
            return Pipe::GROUND;
        }
        let unknown = &mut self.number[of_all as usize];
        if *unknown == Pipe::GROUND {
            *unknown = self.unknowns.len() as u32;
            self.unknowns.push(of_all);
            self.places.push(places[of_all as usize]);
            self.outflow.push(0.0);
        }
        *unknown
    }

    /// Number of unknowns.
    pub(super) fn count(&self) -> usize {
        self.places.len()
    }

    pub(super) fn factored(&self) -> Option<Factored> {
        Factored::new(&self.places, &self.pipes)
    }

    /// `Σ qᵢ pᵢ` over all nodes, with the pressures at the unknowns.
    pub(super) fn power(&self, drops: &[f64]) -> f64 {
        dot(&self.outflow, drops) + self.own_power
    }

    /// The same for the outflow of a part of it, in the whole.
    pub(super) fn power_of(&self, part: &Self, factored: &Factored) -> f64 {
        let mut outflow = vec![0.0; self.count()];
        for (&of_all, value) in part.unknowns.iter().zip(&part.outflow) {
            outflow[self.number[of_all as usize] as usize] = *value;
        }
        dot(&outflow, &factored.solve(&outflow)) + part.own_power
    }

    /// Share of the conductance that is lost without a pipe that is no bridge, from a solution
    /// without it; `power` is `Σ qᵢ pᵢ` with it.
    pub(super) fn lost_without(&self, pipe: u32, power: f64) -> f64 {
        let mut pipes = self.pipes.clone();
        pipes.remove(pipe as usize);
        let after = Factored::new(&self.places, &pipes)
            .map(|after| self.power(&after.solve(&self.outflow)))
            .filter(|after| after.is_finite());
        // A way around with a conductance too small for a number conducts nothing.
        after.map_or(1.0, |after| (1.0 - power / after).max(0.0))
    }
}

/// Pipes in a row.
#[derive(Default)]
struct Row {
    resistances: Vec<f64>,
    lengths: Vec<f64>,
    /// What leaves at the near end of each pipe.
    near: Vec<f64>,
    /// The power of what leaves along the pipes themselves.
    within: f64,
    /// At each node between two pipes: resistance from the far end, and `Σ q t` beyond.
    beyond: Vec<[f64; 2]>,
}

impl Row {
    fn push(&mut self, edge: &VeinEdge, length: f64, is_forward: bool) {
        let (mut r, mut s) = (edge.radius_from, edge.radius_to);
        if !is_forward {
            std::mem::swap(&mut r, &mut s);
        }
        let (r3, s3) = (r * r * r, s * s * s);
        let conductance = 3.0 * r3 * s3 / (length * (r * r + r * s + s * s));
        self.resistances.push(1.0 / conductance);
        self.lengths.push(length);
        let squares = r * r + r * s + s * s;
        self.near
            .push(length * (r * (2.0 * r + s) / (2.0 * squares)));
        self.within += length * length * length / (4.0 * r * s * squares);
    }

    /// Makes a stretch of the row, and empties it.
    fn condensed(&mut self, ends: [u32; 2], order: u8, chain: u32) -> Stretch {
        let count = self.lengths.len();
        let far = |k: usize| self.lengths[k] - self.near[k];
        let leaving = |k: usize| far(k) + self.near[k + 1];
        self.beyond.clear();
        self.beyond.resize(count - 1, [0.0; 2]);
        let (mut t, mut sum) = (0.0, 0.0);
        for k in (0..count - 1).rev() {
            t += self.resistances[k + 1];
            self.beyond[k] = [t, sum];
            sum += leaving(k) * t;
        }
        let whole = t + self.resistances[0];
        let mut outflow = [self.near[0], far(count - 1)];
        let (mut s, mut before, mut own_power) = (0.0, 0.0, self.within);
        for k in 0..count - 1 {
            s += self.resistances[k];
            let (q, [t, beyond]) = (leaving(k), self.beyond[k]);
            before += q * s;
            own_power += q * (t * before + s * beyond) / whole;
            outflow[0] += q * (t / whole);
            outflow[1] += q * (s / whole);
        }
        let stretch = Stretch {
            ends,
            conductance: 1.0 / whole,
            outflow,
            own_power,
            length: self.lengths.iter().sum(),
            order,
            chain,
        };
        self.resistances.clear();
        self.lengths.clear();
        self.near.clear();
        self.within = 0.0;
        stretch
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn length(graph: &PlaneGraph, edge: &VeinEdge) -> f64 {
    (graph.nodes()[edge.to as usize] - graph.nodes()[edge.from as usize]).length()
}
