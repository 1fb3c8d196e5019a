//! Veins that are there before the first source appears: those of another model.

use glam::DVec2;

use super::influence::Influence;
use super::network::{self, VenationNetwork};
use super::simulation::Simulation;
use super::topology::Topology;

/// Rank of nodes that were there: they stay in their places.
const GIVEN: u8 = u8::MAX;

/// Veins without loops, in segments of the full-grown leaf, base at the origin.
pub(crate) struct GivenVeins {
    /// From one branching to the next or to a tip: the first place of a way is the last of an
    /// earlier one, or the base.
    ways: Vec<Way>,
}

struct Way {
    /// The way at whose end it starts, or nothing if it starts at the base.
    after: Option<usize>,
    places: Vec<DVec2>,
}

impl GivenVeins {
    /// The veins of a network whose first node is the base, as far as they hang together with it.
    pub(super) fn new(network: &VenationNetwork, base: DVec2, segment_mm: f64) -> Self {
        let place = |node: u32| (network.nodes()[node as usize].position - base) / segment_mm;
        let pairs = network::ends(network.edges());
        let topology = Topology::new(network.nodes().len(), &pairs);
        let mut ways: Vec<Way> = Vec::new();
        let mut starts: Vec<(Option<usize>, u32)> = vec![(None, 0)];
        let mut next = 0;
        while let Some(&(after, start)) = starts.get(next) {
            next += 1;
            for &edge in topology.leaving(start) {
                let mut places = vec![place(start)];
                let mut node = pairs[edge as usize][1];
                places.push(place(node));
                while let &[edge] = topology.leaving(node) {
                    node = pairs[edge as usize][1];
                    places.push(place(node));
                }
                starts.push((Some(ways.len()), node));
                ways.push(Way { after, places });
            }
        }
        Self { ways }
    }
}

impl<I: Influence> Simulation<'_, I> {
    /// Adds veins that are there from the start, in pieces about as long as a segment is then.
    pub(crate) fn start_from(&mut self, given: &GivenVeins) {
        let unit = self.unit_at_start();
        // The node at which each way ends.
        let mut ends: Vec<u32> = Vec::with_capacity(given.ways.len());
        for way in &given.ways {
            let mut node = way.after.map_or(0, |after| ends[after]);
            for place in in_pieces(&way.places, unit) {
                let here = self.lamina.now_of_full_grown(place);
                let next = self.veins.add_ranked_node(here, GIVEN, 0, &self.lamina);
                self.veins.add_edge(node, next, &self.lamina);
                node = next;
            }
            ends.push(node);
        }
    }
}

/// Points at equal distances of about `piece` on a way, without its first.
fn in_pieces(places: &[DVec2], piece: f64) -> Vec<DVec2> {
    let lengths: Vec<f64> = places.windows(2).map(|p| (p[1] - p[0]).length()).collect();
    let whole: f64 = lengths.iter().sum();
    let count = libm::round(whole / piece).max(1.0);
    let mut points = Vec::with_capacity(count as usize);
    let (mut passed, mut i) = (0.0, 0);
    for number in 1..count as usize {
        let at = whole * number as f64 / count;
        while i + 1 < lengths.len() && passed + lengths[i] < at {
            passed += lengths[i];
            i += 1;
        }
        points.push(places[i].lerp(places[i + 1], ((at - passed) / lengths[i]).min(1.0)));
    }
    points.push(places[places.len() - 1]);
    points
}
