//! Margin, veins and areoles as shapes with attributes.

use glam::DVec2;

use serde_json::{Value, json};

use super::runs::Runs;
use super::text::{SOFTWARE, rounded};
use crate::shape::outline::Outline;
use crate::venation::areole::areoles;
use crate::venation::network::VenationNetwork;

/// Margin, veins and areoles as a `GeoJSON` `FeatureCollection`.
///
/// Coordinates are millimetres in the frame of the outline, **not** degrees on the Earth as RFC
/// 7946 has it; the member `coordinate_unit` says so. Each feature's property `kind` is `margin`
/// (with `area_mm2`, `base_mm`, `apex_mm`), `vein` (a `LineString` from junction to junction, with
/// `order`, `radius_mm_mean`, `length_mm`) or `areole` (a `Polygon` with `area_mm2`, `perimeter_mm`,
/// `circularity`; nets inside it are no holes in it). So that the network can be read back, a vein
/// also has the numbers of its `nodes` and `edges`, and `radii_mm`, the radii at both ends of each
/// edge in turn; corners of margins and veins are written in full.
pub fn geojson(outlines: &[Outline], network: &VenationNetwork) -> String {
    let mut text = format!(
        "{{\"type\":\"FeatureCollection\",\n\
         \"software\":\"{SOFTWARE}\",\n\
         \"coordinate_unit\":\"mm\",\n\
         \"segment_mm\":{},\n\
         \"note\":\"Coordinates are millimetres on the leaf, base to apex along +y, not degrees of longitude and latitude.\",\n\
         \"features\":[\n",
        Value::from(network.segment_mm()),
    );
    for (number, outline) in outlines.iter().enumerate() {
        let margin = closed(outline.points().iter().map(DVec2::to_array));
        let properties = json!({
            "kind": "margin",
            "area_mm2": outline.area(),
            "base_mm": outline.base().to_array(),
            "apex_mm": outline.apex().to_array(),
        });
        text += if number > 0 { ",\n" } else { "" };
        text += &feature("Polygon", &json!([margin]), &properties);
    }
    for run in Runs::new(network).iter() {
        let edges = run.iter().map(|&edge| &network.edges()[edge as usize]);
        let place = |node: u32| network.nodes()[node as usize].position;
        let first = &network.edges()[run[0] as usize];
        let nodes = std::iter::once(first.from).chain(edges.clone().map(|e| e.to));
        let nodes: Vec<u32> = nodes.collect();
        let way: Vec<[f64; 2]> = nodes.iter().map(|&node| place(node).to_array()).collect();
        let radii = edges.clone().flat_map(|e| [e.radius_from, e.radius_to]);
        let radii: Vec<f64> = radii.collect();
        let (mut length, mut area) = (0.0, 0.0);
        for edge in edges {
            let step = (place(edge.to) - place(edge.from)).length();
            length += step;
            area += step * (edge.radius_from + edge.radius_to);
        }
        let properties = json!({
            "kind": "vein",
            "order": first.order,
            "radius_mm_mean": 0.5 * area / length,
            "length_mm": length,
            "nodes": nodes,
            "edges": run,
            "radii_mm": radii,
        });
        text += ",\n";
        text += &feature("LineString", &json!(way), &properties);
    }
    let found = areoles(network);
    for (number, areole) in found.iter().enumerate() {
        let properties = json!({
            "kind": "areole",
            "area_mm2": areole.area_mm2,
            "perimeter_mm": areole.perimeter_mm,
            "circularity": areole.circularity(),
        });
        text += ",\n";
        let polygon = closed(found.polygon(number).map(corner));
        text += &feature("Polygon", &json!([polygon]), &properties);
    }
    text + "\n]}\n"
}

fn feature(kind: &str, coordinates: &Value, properties: &Value) -> String {
    json!({
        "type": "Feature",
        "geometry": { "type": kind, "coordinates": coordinates },
        "properties": properties,
    })
    .to_string()
}

fn corner(p: DVec2) -> [f64; 2] {
    [rounded(p.x), rounded(p.y)]
}

/// A ring as `GeoJSON` wants it: the first corner comes again at the end.
fn closed(points: impl Iterator<Item = [f64; 2]>) -> Vec<[f64; 2]> {
    let mut ring: Vec<[f64; 2]> = points.collect();
    let first = ring.first().copied();
    ring.extend(first);
    ring
}
