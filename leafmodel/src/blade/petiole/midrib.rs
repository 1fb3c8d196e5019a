//! The path along which a petiole continues into the blade.

use glam::DVec2;

use crate::shape::outline::Outline;
use crate::venation::network::VenationNetwork;

/// The first part of the thickest vein that starts at the base.
pub(super) struct Midrib {
    pub(super) base: DVec2,
    /// Radius at the base.
    pub(super) radius: f64,
    /// Distance along it, place and radius.
    pub(super) nodes: Vec<(f64, DVec2, f64)>,
}

impl Midrib {
    /// The midrib up to a length of `reach`, mm.
    pub(super) fn new(outline: &Outline, network: &VenationNetwork, reach: f64) -> Self {
        let base = outline.base();
        let leaf = outline.length();
        let mut thickest: Vec<Option<usize>> = vec![None; network.nodes().len()];
        let edges = network.edges();
        for (number, edge) in edges.iter().enumerate() {
            let best = &mut thickest[edge.from as usize];
            if best.is_none_or(|best| edges[best].radius_from < edge.radius_from) {
                *best = Some(number);
            }
        }
        let place = |node: u32| network.nodes()[node as usize].position;
        let near = |node: &u32| place(*node).distance(base) < 1e-3 * leaf;
        let start = (0..network.origins() as u32).find(near);
        let mut nodes = Vec::new();
        let mut next = start.and_then(|node| thickest[node as usize]);
        let mut way = 0.0;
        // The vein is followed only up to `reach` and only while it leads towards the apex.
        while let Some(edge) = next.map(|edge| &edges[edge]) {
            let (from, to) = (place(edge.from), place(edge.to));
            if way > reach || (to - from).y <= 0.0 {
                break;
            }
            nodes.push((way, from, edge.radius_from));
            way += from.distance(to);
            next = thickest[edge.to as usize];
        }
        let thick = network.segments().map(|vein| vein.radius_from);
        let radius = nodes
            .first()
            .map_or_else(|| thick.fold(0.0, f64::max), |node| node.2);
        Self {
            base,
            radius,
            nodes,
        }
    }

    /// Place and radius at a distance from the base; beyond the last node the path continues
    /// straight.
    ///
    /// Veins zigzag from node to node, so the coordinate across the leaf is a mean over nearby
    /// places.
    pub(super) fn at(&self, way: f64) -> (DVec2, f64) {
        let straight = (self.base + DVec2::Y * way, self.radius);
        let Some(&(last, end, thin)) = self.nodes.last() else {
            return straight;
        };
        if way >= last {
            return (end + DVec2::Y * (way - last), thin);
        }
        let after = self.nodes.partition_point(|node| node.0 <= way).max(1);
        let [(a, from, r), (b, to, s)] = [self.nodes[after - 1], self.nodes[after]];
        let t = (way - a) / (b - a);
        let p = from.lerp(to, t);
        let reach = 0.35 * way;
        let near = self.nodes.iter().filter(|n| (n.0 - way).abs() <= reach);
        let (sum, count) = near.fold((p.x, 1.0), |(sum, count), n| (sum + n.1.x, count + 1.0));
        (DVec2::new(sum / count, p.y), r + (s - r) * t)
    }
}
