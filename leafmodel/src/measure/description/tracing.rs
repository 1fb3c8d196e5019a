//! Following veins of one order through a network.

use glam::DVec2;

use crate::plane::polyline;
use crate::shape::outline::Outline;
use crate::venation::network::VenationNetwork;
use crate::venation::topology::Topology;

/// Veins of so few nodes are stumps, by which those that come from elsewhere are joined here.
const STUMP: usize = 7;

/// Nodes over which a direction is taken.
const LOOK: usize = 6;

/// A vein of one order, from where it leaves a coarser one.
#[derive(Clone, Debug)]
pub(super) struct Vein {
    nodes: Vec<u32>,
    places: Vec<DVec2>,
    /// Whether it ends where another vein comes in.
    pub(super) is_joined: bool,
    /// The order of that vein.
    pub(super) joined_order: Option<u8>,
}

/// A network, ready to be followed.
pub(super) struct Tracer<'a> {
    network: &'a VenationNetwork,
    apex: DVec2,
    ends: &'a [[u32; 2]],
    topology: Topology<'a>,
}

impl<'a> Tracer<'a> {
    /// `ends` are those of the network's edges.
    pub(super) fn new(
        outline: &Outline,
        network: &'a VenationNetwork,
        ends: &'a [[u32; 2]],
    ) -> Self {
        Self {
            network,
            apex: outline.apex(),
            ends,
            topology: Topology::new(network.nodes().len(), ends),
        }
    }

    fn place(&self, node: u32) -> DVec2 {
        self.network.nodes()[node as usize].position
    }

    fn order(&self, edge: u32) -> u8 {
        self.network.edges()[edge as usize].order
    }

    /// All veins of order 1: first the one that comes nearest to the apex.
    pub(super) fn primaries(&self) -> Vec<Vein> {
        let topology = &self.topology;
        let mut starts: Vec<u32> = (0..self.network.nodes().len() as u32)
            .filter(|&node| topology.entering(node).is_empty())
            .flat_map(|node| topology.leaving(node).to_vec())
            .filter(|&edge| self.order(edge) == 1)
            .collect();
        let mut veins: Vec<Vein> = Vec::new();
        let mut next = 0;
        while let Some(&start) = starts.get(next) {
            next += 1;
            let vein = self.trace(topology, start);
            // Branches of the same order are primaries too.
            for pair in vein.nodes.windows(2) {
                let more = topology.leaving(pair[0]).iter().copied().filter(|&edge| {
                    self.order(edge) == 1 && self.ends[edge as usize][1] != pair[1]
                });
                starts.extend(
                    more.filter(|edge| !starts.contains(edge))
                        .collect::<Vec<u32>>(),
                );
            }
            if vein.nodes.len() > STUMP {
                veins.push(vein);
            }
        }
        let away = |vein: &Vein| (vein.end() - self.apex).length();
        if let Some(midrib) =
            (0..veins.len()).min_by(|&a, &b| away(&veins[a]).total_cmp(&away(&veins[b])))
        {
            veins.swap(0, midrib);
        }
        veins
    }

    /// The veins of an order that leave a vein.
    pub(super) fn leaving(&self, vein: &Vein, order: u8) -> Vec<Vein> {
        let topology = &self.topology;
        let starts = vein.nodes.iter().flat_map(|&node| topology.leaving(node));
        starts
            .copied()
            .filter(|&edge| self.order(edge) == order)
            .filter(|&edge| topology.entering(self.ends[edge as usize][1]).len() < 2)
            .filter(|&edge| !vein.nodes.contains(&self.ends[edge as usize][1]))
            .map(|edge| self.trace(topology, edge))
            .filter(|found| found.nodes.len() > STUMP)
            .collect()
    }

    /// The order of the vein from which a stump comes whose last edge and node before are given.
    fn order_behind(&self, topology: &Topology<'_>, edge: u32, node: u32) -> u8 {
        let stump = self.order(edge);
        let mut node = node;
        for _ in 0..2 * STUMP {
            let Some(&edge) = topology.entering(node).first() else {
                break;
            };
            if self.order(edge) != stump {
                return self.order(edge);
            }
            node = self.ends[edge as usize][0];
        }
        stump
    }

    /// A vein from its first edge on, as straight as can be.
    fn trace(&self, topology: &Topology<'_>, first: u32) -> Vein {
        let order = self.order(first);
        let [from, to] = self.ends[first as usize];
        let mut nodes = vec![from, to];
        loop {
            let here = nodes[nodes.len() - 1];
            if topology.entering(here).len() > 1 {
                break;
            }
            let back = nodes[nodes.len().saturating_sub(LOOK)];
            let arrival = (self.place(here) - self.place(back)).normalize_or_zero();
            let straightness = |edge: u32| {
                let end = self.ends[edge as usize][1];
                // What leads to where veins meet is the end of another.
                let is_end = topology.entering(end).len() > 1;
                let way = (self.place(end) - self.place(here)).normalize_or_zero();
                way.dot(arrival) - if is_end { 4.0 } else { 0.0 }
            };
            let same = topology.leaving(here).iter().copied();
            let next = same
                .filter(|&edge| self.order(edge) == order)
                .max_by(|&a, &b| straightness(a).total_cmp(&straightness(b)));
            let Some(next) = next else { break };
            nodes.push(self.ends[next as usize][1]);
        }
        let end = nodes[nodes.len() - 1];
        let before = nodes[nodes.len() - 2];
        let others = topology.entering(end).iter().copied();
        let other = others
            .map(|edge| (edge, self.ends[edge as usize][0]))
            .find(|o| o.1 != before);
        let joined_order = other.map(|(edge, node)| self.order_behind(topology, edge, node));
        Vein {
            places: nodes.iter().map(|&node| self.place(node)).collect(),
            is_joined: topology.entering(end).len() > 1,
            joined_order,
            nodes,
        }
    }
}

impl Vein {
    pub(super) fn start(&self) -> DVec2 {
        self.places[0]
    }

    pub(super) fn end(&self) -> DVec2 {
        self.places[self.places.len() - 1]
    }

    pub(super) fn length(&self) -> f64 {
        polyline::length(&self.places)
    }

    pub(super) fn chord(&self) -> f64 {
        (self.end() - self.start()).length()
    }

    /// The place at a share of its length.
    pub(super) fn at(&self, share: f64) -> DVec2 {
        let mut left = share.clamp(0.0, 1.0) * self.length();
        for pair in self.places.windows(2) {
            let step = (pair[1] - pair[0]).length();
            if step >= left && step > 0.0 {
                return pair[0].lerp(pair[1], left / step);
            }
            left -= step;
        }
        self.end()
    }

    /// The share of its length at the node nearest to a place.
    pub(super) fn share_near(&self, place: DVec2) -> f64 {
        let (mut walked, mut best) = (0.0, (f64::INFINITY, 0.0));
        for (i, &node) in self.places.iter().enumerate() {
            if i > 0 {
                walked += (node - self.places[i - 1]).length();
            }
            let away = (node - place).length();
            if away < best.0 {
                best = (away, walked);
            }
        }
        best.1 / self.length().max(1e-12)
    }

    /// Its direction at a share of its length, over a tenth of it.
    pub(super) fn direction_at(&self, share: f64) -> DVec2 {
        (self.at(share + 0.05) - self.at(share - 0.05)).normalize_or_zero()
    }

    /// Its direction over a first share of its length.
    pub(super) fn departure(&self, share: f64) -> DVec2 {
        (self.at(share) - self.start()).normalize_or_zero()
    }

    /// The node farthest from the straight way between two places, of those at these shares of its
    /// length, and how far away it is.
    pub(super) fn farthest(
        &self,
        from: DVec2,
        to: DVec2,
        shares: std::ops::Range<f64>,
    ) -> Option<(DVec2, f64)> {
        let way = (to - from).normalize_or_zero();
        let whole = self.length().max(1e-12);
        let mut walked = 0.0;
        let mut best: Option<(DVec2, f64)> = None;
        for (i, &place) in self.places.iter().enumerate() {
            if i > 0 {
                walked += (place - self.places[i - 1]).length();
            }
            let away = way.perp_dot(place - from).abs();
            if shares.contains(&(walked / whole)) && best.is_none_or(|(_, most)| away > most) {
                best = Some((place, away));
            }
        }
        best
    }

    /// How far it strays from its chord, share of that.
    pub(super) fn stray(&self) -> f64 {
        let chord = self.end() - self.start();
        let way = chord.normalize_or_zero();
        let away = |p: &DVec2| way.perp_dot(*p - self.start()).abs();
        let most = self.places.iter().map(away).fold(0.0, f64::max);
        most / chord.length().max(1e-12)
    }
}
