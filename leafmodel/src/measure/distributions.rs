//! Every single value behind the measures, with its place.

use glam::DVec2;

use super::definitions::unit;
use super::skeleton::{Skeleton, angle_deg};
use super::subject::{Known, Subject};
use crate::venation::network;

/// One value of one kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// What it is: `areole_area`, `areole_elongation`, `areole_circularity`, `vein_length`,
    /// `vein_width`, `branch_angle`, `free_ending_length` or `vein_distance`.
    pub kind: &'static str,
    /// The vein order, of veins and branches where orders are known.
    pub order: Option<u8>,
    /// The value.
    pub value: f64,
    /// Its unit, empty for pure numbers.
    pub unit: &'static str,
    /// Where: the centroid of an areole, the middle of a vein, a junction, a tip, a point of the
    /// blade; mm.
    pub place: DVec2,
}

/// Makes values of a kind, of an order and at a place.
fn of_kind(kind: &'static str) -> impl Fn(Option<u8>, f64, DVec2) -> Sample {
    let unit = unit(kind);
    move |order, value, place| Sample {
        kind,
        order,
        value,
        unit,
        place,
    }
}

impl Subject<'_> {
    /// All values of all kinds: areoles by number, veins from junction to junction, branches,
    /// freely ending veinlets in areoles, and points of the blade with their distance to the nearest
    /// vein.
    ///
    /// The angle of a branch is its deflection from the direction of the one vein that leads to the
    /// junction. Branches are of a finer order than that vein; where orders are not known, all but
    /// the straightest.
    pub fn distributions(&self) -> Vec<Sample> {
        let mut samples = Vec::new();
        let kinds = ["areole_area", "areole_elongation", "areole_circularity"];
        let [area, elongation, circularity] = kinds.map(of_kind);
        for areole in self.found.iter() {
            let place = areole.centroid;
            samples.extend([
                area(None, areole.area_mm2, place),
                elongation(None, areole.elongation, place),
                circularity(None, areole.circularity(), place),
            ]);
        }
        self.add_veins(&mut samples);
        self.add_branches(&mut samples);
        let [length, distance] = ["free_ending_length", "vein_distance"].map(of_kind);
        for ending in self
            .found
            .free_endings()
            .filter(|ending| ending.areole.is_some())
        {
            samples.push(length(None, ending.length_mm, ending.tip));
        }
        for (place, value) in self.distances() {
            samples.push(distance(None, value, place));
        }
        samples
    }

    fn add_veins(&self, samples: &mut Vec<Sample>) {
        let (chains, graph) = (self.found.chains(), self.found.graph());
        let [length, width] = ["vein_length", "vein_width"].map(of_kind);
        for chain in 0..chains.len() as u32 {
            let orders = chains
                .edges(chain)
                .iter()
                .map(|&edge| graph.edges()[edge as usize].order);
            let order = orders.min().filter(|_| self.known.orders);
            let points = chains.points(chain);
            let place = points[points.len() / 2];
            samples.push(length(order, chains.lengths[chain as usize], place));
            if self.known.radii {
                samples.push(width(order, 2.0 * chains.radii[chain as usize], place));
            }
        }
    }

    fn add_branches(&self, samples: &mut Vec<Sample>) {
        let graph = self.found.graph();
        let edges = network::ends(graph.edges());
        let skeleton = Skeleton::new(graph, &edges, self.network.segment_mm());
        let angle = of_kind("branch_angle");
        for node in skeleton.nodes() {
            let out = skeleton.topology.leaving(node);
            let &[parent] = skeleton.topology.entering(node) else {
                continue;
            };
            if out.len() < 2 {
                continue;
            }
            let arrival = skeleton.arrival(parent);
            let turn = |edge: u32| angle_deg(arrival, skeleton.departure(edge));
            let straightest = out
                .iter()
                .copied()
                .min_by(|&a, &b| turn(a).total_cmp(&turn(b)));
            let coarse = skeleton.edge(parent).order;
            for &edge in out {
                let order = skeleton.edge(edge).order;
                let is_branch = match self.known {
                    Known { orders: true, .. } => order > coarse,
                    Known { orders: false, .. } => Some(edge) != straightest,
                };
                if is_branch {
                    let order = Some(order).filter(|_| self.known.orders);
                    samples.push(angle(order, turn(edge), skeleton.place(node)));
                }
            }
        }
    }
}
