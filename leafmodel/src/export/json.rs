//! Everything about margin and veins.

use std::fmt::Write as _;

use glam::DVec2;

use serde_json::{Value, json};

use super::text::SOFTWARE;
use crate::shape::outline::Outline;
use crate::venation::areole::{Areole, areoles};
use crate::venation::network::{Ending, VeinEdge, VeinNode, VenationNetwork};

/// Margin and network as JSON, every number in full.
///
/// `nodes` and `edges` are objects of columns of equal length (`x_mm`, `y_mm`, `born_step`; `from`,
/// `to`, `radius_from_mm`, `radius_to_mm`, `order`), which takes half the room of a list of objects
/// and loads into tables as it is. Nodes are numbered from 0. `areoles` is a list of objects, there
/// only if asked for. The margin is `outline`; a compound leaf has the list `outlines` instead.
pub fn json(outlines: &[Outline], network: &VenationNetwork, with_areoles: bool) -> String {
    let margin = |outline: &Outline| {
        let points: Vec<[f64; 2]> = outline.points().iter().map(DVec2::to_array).collect();
        json!({
            "points_mm": points,
            "base_mm": outline.base().to_array(),
            "apex_mm": outline.apex().to_array(),
        })
    };
    let head = match outlines {
        [outline] => format!("\"outline\":{}", margin(outline)),
        several => format!("\"outlines\":{}", column(several, margin)),
    };
    let ending = match network.ending() {
        Ending::Settled => "settled",
        Ending::Growing => "growing",
        Ending::StepLimit => "step limit",
    };
    let nodes = |value: fn(&VeinNode) -> Value| column(network.nodes(), value);
    let edges = |value: fn(&VeinEdge) -> Value| column(network.edges(), value);
    let mut text = format!(
        "{{\"software\":\"{SOFTWARE}\",\n\"length_unit\":\"mm\",\n\"steps\":{},\n\"sources\":{},\n\"segment_mm\":{},\n\"ending\":\"{ending}\",\n\
         {head},\n",
        network.steps(),
        network.sources(),
        Value::from(network.segment_mm()),
    );
    let _ = write!(
        text,
        "\"nodes\":{{\n\"x_mm\":{},\n\"y_mm\":{},\n\"born_step\":{}\n}},\n",
        nodes(|n| Value::from(n.position.x)),
        nodes(|n| Value::from(n.position.y)),
        nodes(|n| Value::from(n.born)),
    );
    let _ = write!(
        text,
        "\"edges\":{{\n\"from\":{},\n\"to\":{},\n\"radius_from_mm\":{},\n\"radius_to_mm\":{},\n\"order\":{}\n}}",
        edges(|e| Value::from(e.from)),
        edges(|e| Value::from(e.to)),
        edges(|e| Value::from(e.radius_from)),
        edges(|e| Value::from(e.radius_to)),
        edges(|e| Value::from(e.order)),
    );
    if with_areoles {
        let found = areoles(network);
        let object = |(number, areole): (usize, &Areole)| {
            let corners: Vec<[f64; 2]> = found.polygon(number).map(|p| p.to_array()).collect();
            json!({
                "area_mm2": areole.area_mm2,
                "perimeter_mm": areole.perimeter_mm,
                "circularity": areole.circularity(),
                "elongation": areole.elongation,
                "centroid_mm": areole.centroid.to_array(),
                "corners_mm": corners,
            })
        };
        let list: Vec<(usize, &Areole)> = found.iter().enumerate().collect();
        let _ = write!(
            text,
            ",\n\"areoles\":{}",
            column(&list, |&entry| object(entry))
        );
    }
    text + "\n}\n"
}

/// A list of values. One at a time is made into a JSON value, since all together would take many
/// times the room of the text.
fn column<T>(items: &[T], value: impl Fn(&T) -> Value) -> String {
    let mut text = String::from("[");
    for (number, item) in items.iter().enumerate() {
        let comma = if number == 0 { "" } else { "," };
        let _ = write!(text, "{comma}{}", value(item));
    }
    text + "]"
}
