//! The network as a table with a row for each edge.

use std::fmt::Write as _;

use super::text::SOFTWARE;
use crate::venation::network::VenationNetwork;

/// The edges as CSV, every number in full, in the columns `from`, `to`, `from_x_mm`, `from_y_mm`,
/// `to_x_mm`, `to_y_mm`, `radius_from_mm`, `radius_to_mm`, `order`, `length_mm`.
///
/// Two comments come first: what wrote the table, and `segment_mm`. Edges lead away from the
/// petiole; nodes are numbered from 0.
pub fn table(network: &VenationNetwork) -> String {
    let mut text = format!(
        "# {SOFTWARE}\n# segment_mm = {}\nfrom,to,from_x_mm,from_y_mm,to_x_mm,to_y_mm,\
         radius_from_mm,radius_to_mm,order,length_mm\n",
        network.segment_mm()
    );
    for (edge, segment) in network.edges().iter().zip(network.segments()) {
        let (start, end) = (segment.from, segment.to);
        let _ = writeln!(
            text,
            "{},{},{},{},{},{},{},{},{},{}",
            edge.from,
            edge.to,
            start.x,
            start.y,
            end.x,
            end.y,
            edge.radius_from,
            edge.radius_to,
            edge.order,
            start.distance(end),
        );
    }
    text
}
