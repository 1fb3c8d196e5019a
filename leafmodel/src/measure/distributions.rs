//! Every single value behind the measures, with its place.

use glam::DVec2;

use super::skeleton::{Skeleton, angle_deg};
use super::{Known, Subject};

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

impl Subject<'_> {
    /// All values of all kinds: areoles by number, veins from junction to junction, branches,
    /// freely ending veinlets in areoles, and points of the blade with their distance to the nearest
    /// vein.
    ///
    /// The angle of a branch is its deflection from the direction of the one vein that leads to the
    /// junction. Branches are of a finer order than that vein; where orders are not known, all but
    /// the straightest.
    pub fn distributions(&self) -> Vec<Sample> {
        let of_length = |kind, value, place| Sample {
            kind,
            order: None,
            value,
            unit: "mm",
            place,
        };
        let mut samples = Vec::new();
        for areole in self.found.iter() {
            let mut add = |kind, value, unit| {
                samples.push(Sample {
                    unit,
                    ..of_length(kind, value, areole.centroid)
                });
            };
            add("areole_area", areole.area_mm2, "mm²");
            add("areole_elongation", areole.elongation, "");
            add("areole_circularity", areole.circularity(), "");
        }
        self.add_veins(&mut samples);
        self.add_branches(&mut samples);
        for ending in self
            .found
            .free_endings()
            .filter(|ending| ending.areole.is_some())
        {
            samples.push(of_length(
                "free_ending_length",
                ending.length_mm,
                ending.tip,
            ));
        }
        for (place, value) in self.distances() {
            samples.push(of_length("vein_distance", value, place));
        }
        samples
    }

    fn add_veins(&self, samples: &mut Vec<Sample>) {
        let (chains, graph) = (self.found.chains(), self.found.graph());
        for chain in 0..chains.len() as u32 {
            let orders = chains
                .edges(chain)
                .iter()
                .map(|&edge| graph.edges()[edge as usize].order);
            let order = orders.min().filter(|_| self.known.orders);
            let points = chains.points(chain);
            let mut add = |kind, value| {
                samples.push(Sample {
                    kind,
                    order,
                    value,
                    unit: "mm",
                    place: points[points.len() / 2],
                });
            };
            add("vein_length", chains.lengths[chain as usize]);
            if self.known.radii {
                add("vein_width", 2.0 * chains.radii[chain as usize]);
            }
        }
    }

    fn add_branches(&self, samples: &mut Vec<Sample>) {
        let graph = self.found.graph();
        let edges: Vec<[u32; 2]> = graph.edges().iter().map(|e| [e.from, e.to]).collect();
        let skeleton = Skeleton::new(graph, &edges, self.network.segment_mm());
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
                    samples.push(Sample {
                        kind: "branch_angle",
                        order: Some(order).filter(|_| self.known.orders),
                        value: turn(edge),
                        unit: "°",
                        place: skeleton.place(node),
                    });
                }
            }
        }
    }
}
