//! The network as a graph with attributes.

use std::fmt::Write as _;

use super::text::SOFTWARE;
use crate::venation::network::VenationNetwork;

/// Name, element and type of every attribute.
const KEYS: [(&str, &str, &str); 8] = [
    ("x_mm", "node", "double"),
    ("y_mm", "node", "double"),
    ("born_step", "node", "int"),
    ("length_mm", "edge", "double"),
    ("radius_from_mm", "edge", "double"),
    ("radius_to_mm", "edge", "double"),
    ("order", "edge", "int"),
    ("segment_mm", "graph", "double"),
];

/// The network as `GraphML`: a directed graph, edges leading away from the petiole.
///
/// Nodes are `n0`, `n1`, … by number and carry `x_mm`, `y_mm` and `born_step`; edges carry
/// `length_mm`, `radius_from_mm`, `radius_to_mm` and `order`; the graph carries `segment_mm`. All
/// are names of `GraphML` keys.
pub fn graphml(network: &VenationNetwork) -> String {
    let mut text = String::from(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <graphml xmlns=\"http://graphml.graphdrawing.org/xmlns\">\n",
    );
    let _ = writeln!(text, "<desc>{SOFTWARE}</desc>");
    for (name, element, kind) in KEYS {
        let _ = writeln!(
            text,
            "<key id=\"{name}\" for=\"{element}\" attr.name=\"{name}\" attr.type=\"{kind}\"/>"
        );
    }
    let _ = writeln!(
        text,
        "<graph id=\"veins\" edgedefault=\"directed\">\n<data key=\"segment_mm\">{}</data>",
        network.segment_mm()
    );
    for (number, node) in network.nodes().iter().enumerate() {
        let _ = writeln!(
            text,
            "<node id=\"n{number}\"><data key=\"x_mm\">{}</data><data key=\"y_mm\">{}</data>\
             <data key=\"born_step\">{}</data></node>",
            node.position.x, node.position.y, node.born
        );
    }
    for (edge, segment) in network.edges().iter().zip(network.segments()) {
        let _ = writeln!(
            text,
            "<edge source=\"n{}\" target=\"n{}\"><data key=\"length_mm\">{}</data>\
             <data key=\"radius_from_mm\">{}</data><data key=\"radius_to_mm\">{}</data>\
             <data key=\"order\">{}</data></edge>",
            edge.from,
            edge.to,
            (segment.to - segment.from).length(),
            edge.radius_from,
            edge.radius_to,
            edge.order
        );
    }
    text + "</graph>\n</graphml>\n"
}
