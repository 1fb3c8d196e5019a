//! What is written is read back.

use glam::DVec2;
use serde_json::Value;

use super::*;
use crate::venation::areole::areoles;
use crate::venation::network::{VeinEdge, VeinNode, VenationNetwork};
use crate::venation::testing::{network, poplar, rectangle, wide};

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-14 * b.abs().max(1e-3)
}

fn assert_same(read: &VenationNetwork, written: &VenationNetwork) {
    assert_eq!(read.nodes().len(), written.nodes().len());
    for (a, b) in read.nodes().iter().zip(written.nodes()) {
        assert!(close(a.position.x, b.position.x) && close(a.position.y, b.position.y));
        assert_eq!(a.born, b.born);
    }
    assert_eq!(read.edges().len(), written.edges().len());
    for (a, b) in read.edges().iter().zip(written.edges()) {
        assert_eq!((a.from, a.to, a.order), (b.from, b.to, b.order));
        assert!(close(a.radius_from, b.radius_from) && close(a.radius_to, b.radius_to));
    }
    assert!(close(read.segment_mm(), written.segment_mm()));
}

fn parse(text: &str) -> Value {
    serde_json::from_str(text).expect("well-formed JSON")
}

fn floats(value: &Value) -> Vec<f64> {
    let list = value.as_array().expect("a list");
    list.iter().map(|v| v.as_f64().expect("a number")).collect()
}

#[test]
fn json_gives_the_network_back() {
    let (blade, veins) = poplar(2);
    let read = parse(&json(std::slice::from_ref(&blade), &veins, true));
    let (nodes, edges) = (&read["nodes"], &read["edges"]);
    let (x, y, born) = (
        floats(&nodes["x_mm"]),
        floats(&nodes["y_mm"]),
        floats(&nodes["born_step"]),
    );
    let nodes = (0..x.len()).map(|i| VeinNode {
        position: DVec2::new(x[i], y[i]),
        born: born[i] as u32,
    });
    let columns =
        ["from", "to", "radius_from_mm", "radius_to_mm", "order"].map(|key| floats(&edges[key]));
    let edges = (0..columns[0].len()).map(|i| VeinEdge {
        from: columns[0][i] as u32,
        to: columns[1][i] as u32,
        radius_from: columns[2][i],
        radius_to: columns[3][i],
        order: columns[4][i] as u8,
    });
    let segment = read["segment_mm"].as_f64().expect("a number");
    let again = VenationNetwork::from_parts(nodes.collect(), edges.collect(), segment);
    assert_same(&again.expect("a valid network"), &veins);
    assert_eq!(read["steps"], veins.steps());
    assert_eq!(read["sources"], veins.sources());
    assert_eq!(
        read["outline"]["points_mm"].as_array().map(Vec::len),
        Some(blade.points().len())
    );
    let found = areoles(&veins);
    let list = read["areoles"].as_array().expect("a list");
    assert_eq!(list.len(), found.len());
    for (number, (object, areole)) in list.iter().zip(found.iter()).enumerate() {
        assert!(close(
            object["area_mm2"].as_f64().expect("a number"),
            areole.area_mm2
        ));
        assert_eq!(
            object["corners_mm"].as_array().map(Vec::len),
            Some(found.polygon(number).count())
        );
    }
    assert!(
        parse(&json(std::slice::from_ref(&blade), &veins, false))
            .get("areoles")
            .is_none()
    );
}

#[test]
fn graphml_is_well_formed_and_gives_the_network_back() {
    let (_, veins) = poplar(2);
    let text = graphml(&veins);
    let options = roxmltree::ParsingOptions {
        nodes_limit: u32::MAX,
        ..Default::default()
    };
    let document =
        roxmltree::Document::parse_with_options(&text, options).expect("well-formed XML");
    let all = |tag: &'static str| document.descendants().filter(move |n| n.has_tag_name(tag));
    let keys: Vec<&str> = all("key").filter_map(|key| key.attribute("id")).collect();
    let data = |node: roxmltree::Node, key: &str| -> f64 {
        assert!(keys.contains(&key), "{key} is not declared");
        let mut children = node
            .children()
            .filter(|child| child.attribute("key") == Some(key));
        let text = children
            .next()
            .and_then(|child| child.text().map(str::to_owned));
        text.expect("there").parse().expect("a number")
    };
    let node_number = |edge: &roxmltree::Node, end: &str| -> u32 {
        let id = edge.attribute(end).expect("both ends");
        id.strip_prefix('n')
            .expect("ids start so")
            .parse()
            .expect("a number")
    };
    let nodes = all("node").map(|node| VeinNode {
        position: DVec2::new(data(node, "x_mm"), data(node, "y_mm")),
        born: data(node, "born_step") as u32,
    });
    let edges = all("edge").map(|edge| VeinEdge {
        from: node_number(&edge, "source"),
        to: node_number(&edge, "target"),
        radius_from: data(edge, "radius_from_mm"),
        radius_to: data(edge, "radius_to_mm"),
        order: data(edge, "order") as u8,
    });
    let graph = all("graph").next().expect("one graph");
    let again =
        VenationNetwork::from_parts(nodes.collect(), edges.collect(), data(graph, "segment_mm"));
    assert_same(&again.expect("a valid network"), &veins);
    let length: f64 = all("edge").map(|edge| data(edge, "length_mm")).sum();
    assert!((length - veins.vein_length_mm()).abs() < 1e-9 * length);
}

#[test]
fn geojson_holds_margin_veins_and_areoles() {
    let (blade, veins) = poplar(3);
    let read = parse(&geojson(std::slice::from_ref(&blade), &veins));
    assert_eq!(read["type"], "FeatureCollection");
    assert_eq!(read["coordinate_unit"], "mm");
    let features = read["features"].as_array().expect("a list");
    let of = |kind: &str| -> Vec<&Value> {
        features
            .iter()
            .filter(|f| f["properties"]["kind"] == kind)
            .collect()
    };
    assert_eq!(of("margin").len(), 1);
    let length: f64 = of("vein")
        .iter()
        .filter_map(|f| f["properties"]["length_mm"].as_f64())
        .sum();
    assert!((length - veins.vein_length_mm()).abs() < 1e-9 * length);
    let corners: usize = of("vein")
        .iter()
        .filter_map(|f| f["geometry"]["coordinates"].as_array().map(Vec::len))
        .sum();
    // A run has one corner more than edges.
    assert_eq!(corners, veins.edges().len() + of("vein").len());
    assert_eq!(of("areole").len(), areoles(&veins).len());
    for areole in of("areole").iter().chain(&of("margin")) {
        let ring = areole["geometry"]["coordinates"][0]
            .as_array()
            .expect("a ring");
        assert_eq!(ring.first(), ring.last());
        let ring: Vec<Vec<f64>> = ring.iter().map(floats).collect();
        let doubled: f64 = ring
            .windows(2)
            .map(|p| p[0][0] * p[1][1] - p[0][1] * p[1][0])
            .sum();
        let area = areole["properties"]["area_mm2"].as_f64().expect("a number");
        assert!(
            (0.5 * doubled - area).abs() < 0.01 * area + 0.01,
            "{doubled} {area}"
        );
    }
}

#[test]
fn svg_is_well_formed_and_draws_every_vein_once_in_its_width() {
    let (blade, veins) = poplar(2);
    for (orders_in_colour, with_areoles) in [(false, false), (true, true)] {
        let style = SvgStyle {
            orders_in_colour,
            areoles: with_areoles,
        };
        let text = svg(&blade, &veins, style);
        let document = roxmltree::Document::parse(&text).expect("well-formed XML");
        let mut area = 0.0;
        let mut areole_paths = 0;
        for path in document.descendants().filter(|n| n.has_tag_name("path")) {
            let d = path.attribute("d").expect("a way");
            if path.parent_element().and_then(|p| p.attribute("id")) == Some("areoles") {
                areole_paths += 1;
            }
            let Some(width) = path.attribute("stroke-width") else {
                continue;
            };
            let width: f64 = width.parse().expect("a number");
            let way: Vec<DVec2> = d[1..]
                .split('L')
                .map(|p| {
                    let (x, y) = p.split_once(' ').expect("two numbers");
                    DVec2::new(x.parse().expect("a number"), y.parse().expect("a number"))
                })
                .collect();
            area += width * way.windows(2).map(|p| (p[1] - p[0]).length()).sum::<f64>();
        }
        assert_eq!(
            areole_paths,
            if with_areoles {
                areoles(&veins).len()
            } else {
                0
            }
        );
        // Where a vein tapers it is no stroke.
        let even: f64 = veins
            .segments()
            .filter(|s| s.radius_from - s.radius_to <= 0.005 * s.radius_from)
            .map(|s| (s.to - s.from).length() * (s.radius_from + s.radius_to))
            .sum();
        assert!((area - even).abs() < 2e-3 * even, "{area} is not {even}");
    }
}

#[test]
fn a_vein_that_tapers_is_drawn_with_both_its_widths() {
    let veins = wide(&[DVec2::ZERO, DVec2::new(0.0, 2.0)], &[(0, 1, 0.1, 1)]);
    let mut edges = veins.edges().to_vec();
    edges[0].radius_from = 0.2;
    let veins = VenationNetwork::from_parts(veins.nodes().to_vec(), edges, 1.0).expect("valid");
    let text = svg(
        &rectangle((-1.0, 0.0), (1.0, 3.0)),
        &veins,
        SvgStyle::default(),
    );
    assert!(
        text.contains("d=\"M-0.2 0L0.2 0L0.1 2A0.1 0.1 0 0 1 -0.1 2Z\""),
        "{text}"
    );
}

#[test]
fn a_leaf_without_veins_is_written_as_one() {
    let (blade, none) = (rectangle((0.0, 0.0), (1.0, 2.0)), network(&[], &[]));
    assert_eq!(
        parse(&json(std::slice::from_ref(&blade), &none, true))["areoles"],
        Value::Array(Vec::new())
    );
    assert_eq!(
        parse(&geojson(std::slice::from_ref(&blade), &none))["features"]
            .as_array()
            .map(Vec::len),
        Some(1)
    );
    assert!(roxmltree::Document::parse(&graphml(&none)).is_ok());
    assert!(roxmltree::Document::parse(&svg(&blade, &none, SvgStyle::default())).is_ok());
}
