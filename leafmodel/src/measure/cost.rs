//! What veins cost: their surface and volume, by order.

use crate::venation::network::VeinEdge;
use crate::venation::planar::PlaneGraph;

/// Veins of one order, or of all.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrderRow {
    /// The order, from 1; 0 stands for all.
    pub order: u8,
    /// Length of midlines, mm.
    pub length_mm: f64,
    /// Mean width along them, mm.
    pub width_mm: f64,
    /// Surface, mm².
    pub surface_mm2: f64,
    /// Volume, mm³.
    pub volume_mm3: f64,
}

/// All orders in turn that have veins. An edge is a cone cut off at both radii `r`, `s` over its
/// length `l`: its volume is `π l (r² + r s + s²) / 3`, its surface `π (r + s) √(l² + (r − s)²)`.
/// What veins share at junctions counts for each.
pub(super) fn by_order(graph: &PlaneGraph) -> Vec<OrderRow> {
    let empty = |order| OrderRow {
        order,
        length_mm: 0.0,
        width_mm: 0.0,
        surface_mm2: 0.0,
        volume_mm3: 0.0,
    };
    let mut rows: Vec<OrderRow> = (0..=u8::MAX).map(empty).collect();
    for edge in graph.edges() {
        let row = &mut rows[usize::from(edge.order)];
        let (length, r, s) = parts(graph, edge);
        row.length_mm += length;
        // The area of the midline's strip, divided by its length in the end.
        row.width_mm += length * (r + s);
        row.surface_mm2 +=
            std::f64::consts::PI * (r + s) * (length * length + (r - s) * (r - s)).sqrt();
        row.volume_mm3 += std::f64::consts::PI / 3.0 * length * (r * r + r * s + s * s);
    }
    rows.retain(|row| row.length_mm > 0.0);
    for row in &mut rows {
        row.width_mm /= row.length_mm;
    }
    rows
}

fn parts(graph: &PlaneGraph, edge: &VeinEdge) -> (f64, f64, f64) {
    let (from, to) = (
        graph.nodes()[edge.from as usize],
        graph.nodes()[edge.to as usize],
    );
    ((to - from).length(), edge.radius_from, edge.radius_to)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use glam::DVec2;

    use super::*;
    use crate::venation::network::VenationNetwork;
    use crate::venation::testing::{squares, wide};

    #[test]
    fn a_cone_and_a_cylinder_cost_what_geometry_says() {
        let places = [(0.0, 0.0), (0.0, 4.0), (3.0, 4.0)].map(DVec2::from);
        let veins = wide(&places, &[(0, 1, 0.25, 1), (1, 2, 0.5, 2)]);
        let mut edges = veins.edges().to_vec();
        edges[0].radius_from = 3.25;
        let veins = VenationNetwork::from_parts(veins.nodes().to_vec(), edges, 1.0).expect("valid");
        let rows = by_order(&PlaneGraph::new(&veins));
        // A cone of slant 5 between the radii 3.25 and 0.25, and a cylinder.
        let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-12 * b, "{a} is not {b}");
        near(rows[0].surface_mm2, PI * 3.5 * 5.0);
        near(
            rows[0].volume_mm3,
            PI / 3.0 * 4.0 * (3.25 * 3.25 + 3.25 * 0.25 + 0.25 * 0.25),
        );
        near(rows[0].width_mm, 3.5);
        near(rows[1].surface_mm2, 2.0 * PI * 0.5 * 3.0);
        near(rows[1].volume_mm3, PI * 0.25 * 3.0);
    }

    #[test]
    fn a_lattice_costs_its_length_times_the_section() {
        let rows = by_order(&PlaneGraph::new(&squares(10, 0.5)));
        let length = 2.0 * 10.0 * 11.0 * 0.5;
        assert_eq!(rows.len(), 1);
        assert!((rows[0].volume_mm3 - PI * 1e-4 * length).abs() < 1e-12);
        assert!((rows[0].surface_mm2 - 2.0 * PI * 0.01 * length).abs() < 1e-9);
    }
}
