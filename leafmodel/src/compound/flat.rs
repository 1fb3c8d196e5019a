//! A leaf with all its leaflets and stalks in the plane, as one network and its margins.

use glam::DVec2;

use super::arranged::{CompoundLeaf, PlacedLeaflet, StalkKind};
use super::whole::joined_stalks;
use crate::leaf::{Lamina, LeafPlan};
use crate::shape::outline::Outline;
use crate::venation::network::{Ending, VeinEdge, VeinNode, VenationNetwork};

/// Nodes of stalks nearer together than this are merged, mm.
const SAME_MM: f64 = 1e-7;

/// A leaf in the plane, mm: a simple one with its petiole along −y, a compound one with its
/// petiole's foot at the origin.
#[derive(Clone, Debug, PartialEq)]
pub struct FlatLeaf {
    /// The margin of each blade.
    pub outlines: Vec<Outline>,
    /// Stalks, then the veins of each blade, as one graph that leads away from the petiole's foot.
    /// Stalks are of order 1.
    pub network: VenationNetwork,
}

impl FlatLeaf {
    /// A simple leaf with its petiole; `None` if it has none.
    pub fn with_petiole(plan: &LeafPlan, lamina: &Lamina) -> Option<Self> {
        let petiole = plan.petiole.as_ref()?;
        let (outline, network) = (&lamina.outline, &lamina.network);
        let length = petiole.length * outline.length();
        let radius = petiole.radius_on(outline, network);
        let mut graph = Graph::default();
        if length > SAME_MM {
            let base = outline.base();
            graph.stalk(&[base - DVec2::Y * length, base], &[radius; 2]);
        }
        graph.blade(network, 1.0, outline.base(), |p| p);
        Some(Self {
            outlines: vec![outline.clone()],
            network: graph.finish(network)?,
        })
    }

    /// A compound leaf; `laminas` are those of its different leaflets. `None` if scaling made a
    /// part vanish.
    pub fn compound(leaf: &CompoundLeaf, laminas: &[&Lamina]) -> Option<Self> {
        let mut graph = Graph::default();
        for (points, radii) in joined_stalks(leaf) {
            graph.stalk(&points, &radii);
        }
        for stalk in &leaf.stalks {
            if stalk.kind == StalkKind::Petiolule {
                graph.stalk(&stalk.points, &stalk.radii_mm);
            }
        }
        let mut outlines = Vec::with_capacity(leaf.leaflets.len());
        for leaflet in &leaf.leaflets {
            let lamina = laminas[leaflet.variant as usize];
            let base = lamina.outline.base();
            let place = |p: DVec2| leaflet.place(p - base);
            outlines.push(placed(&lamina.outline, leaflet)?);
            graph.blade(&lamina.network, leaflet.scale, leaflet.base, place);
        }
        Some(Self {
            network: graph.finish(&laminas[0].network)?,
            outlines,
        })
    }

    /// Lower left and upper right corner of the box around everything, mm.
    pub fn bounds(&self) -> (DVec2, DVec2) {
        let margins = self.outlines.iter().map(Outline::bounds);
        let (low, high) = margins.fold(
            (DVec2::INFINITY, DVec2::NEG_INFINITY),
            |(low, high), (a, b)| (low.min(a), high.max(b)),
        );
        self.network.segments().fold((low, high), |(low, high), s| {
            let (from, to) = (DVec2::splat(s.radius_from), DVec2::splat(s.radius_to));
            (
                low.min(s.from - from).min(s.to - to),
                high.max(s.from + from).max(s.to + to),
            )
        })
    }
}

fn placed(outline: &Outline, leaflet: &PlacedLeaflet) -> Option<Outline> {
    let place = |p: DVec2| leaflet.place(p - outline.base());
    let points = outline.points().iter().map(|&p| place(p)).collect();
    Outline::new(points, place(outline.base()), place(outline.apex())).ok()
}

/// A network under construction.
#[derive(Default)]
struct Graph {
    nodes: Vec<VeinNode>,
    edges: Vec<VeinEdge>,
    /// Number of nodes of stalks; they come first.
    stalks: usize,
    sources: u32,
}

impl Graph {
    fn node(&mut self, position: DVec2) -> u32 {
        let same = |node: &VeinNode| node.position.distance(position) < SAME_MM;
        if let Some(there) = self.nodes.iter().position(same) {
            return there as u32;
        }
        self.nodes.push(VeinNode { position, born: 0 });
        self.stalks = self.nodes.len();
        (self.nodes.len() - 1) as u32
    }

    fn stalk(&mut self, points: &[DVec2], radii: &[f64]) {
        let nodes: Vec<u32> = points.iter().map(|&p| self.node(p)).collect();
        for (ends, thick) in nodes.windows(2).zip(radii.windows(2)) {
            if ends[0] != ends[1] {
                self.edges.push(VeinEdge {
                    from: ends[0],
                    to: ends[1],
                    radius_from: thick[0],
                    radius_to: thick[1],
                    order: 1,
                });
            }
        }
    }

    /// The veins of a blade; those that start at its base go on from the stalk there.
    fn blade(
        &mut self,
        network: &VenationNetwork,
        scale: f64,
        base: DVec2,
        place: impl Fn(DVec2) -> DVec2,
    ) {
        let foot = self.nodes[..self.stalks]
            .iter()
            .position(|node| node.position.distance(base) < SAME_MM);
        let mut numbers = Vec::with_capacity(network.nodes().len());
        for (number, node) in network.nodes().iter().enumerate() {
            let position = place(node.position);
            let at_base = number < network.origins() && position.distance(base) < SAME_MM;
            if let (true, Some(foot)) = (at_base, foot) {
                numbers.push(foot as u32);
                continue;
            }
            numbers.push(self.nodes.len() as u32);
            let born = node.born;
            self.nodes.push(VeinNode { position, born });
        }
        self.edges
            .extend(network.edges().iter().map(|edge| VeinEdge {
                from: numbers[edge.from as usize],
                to: numbers[edge.to as usize],
                radius_from: edge.radius_from * scale,
                radius_to: edge.radius_to * scale,
                order: edge.order,
            }));
        self.sources += network.sources();
    }

    fn finish(self, like: &VenationNetwork) -> Option<VenationNetwork> {
        let mut network =
            VenationNetwork::from_parts(self.nodes, self.edges, like.segment_mm()).ok()?;
        network.steps = like.steps();
        network.sources = self.sources;
        network.ending = Ending::Settled;
        Some(network)
    }
}
