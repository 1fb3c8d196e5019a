//! Whatever is not read of a file is listed, or refused.

use super::*;

/// Lines of all faults but for a root that was chosen.
fn lines(format: Format, text: &str) -> Vec<String> {
    let wanted = Wanted {
        mm_per_unit: Some(1.0),
        ..Wanted::default()
    };
    let draft = read(format, text, None).unwrap_or_else(|error| panic!("{error}"));
    let read = draft
        .network(&wanted)
        .unwrap_or_else(|error| panic!("{error}"));
    let faults = read.faults.iter();
    let faults = faults.filter(|fault| fault.kind != FaultKind::NoRoot);
    faults.map(Fault::line).collect()
}

#[track_caller]
fn listed(format: Format, text: &str, parts: &[&str]) {
    let lines = lines(format, text);
    let [line] = lines.as_slice() else {
        panic!("{lines:?}");
    };
    let start = format!(
        "parts of the file are not known; they are left out ({}): ",
        parts.len()
    );
    assert!(line.starts_with(&start), "{line}");
    assert!(parts.iter().all(|part| line.contains(part)), "{line}");
}

#[test]
fn holes_polygons_without_kind_short_lines_and_properties_of_geojson_are_listed() {
    let text = r#"{"type": "FeatureCollection", "coordinate_unit": "mm", "features": [
        {"type": "Feature", "properties": {"kind": "margin"}, "geometry": {"type": "Polygon", "coordinates":
            [[[-2, 0], [2, 0], [2, 3], [-2, 3], [-2, 0]], [[1, 1], [1.6, 1], [1.6, 1.6], [1, 1.6], [1, 1]]]}},
        {"type": "Feature", "properties": {"radius_mm": 0.1, "colour": "red", "kind": "vein"},
         "geometry": {"type": "LineString", "coordinates": [[0, 0], [0, 2]]}},
        {"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates": [[1, 1]]}},
        {"type": "Feature", "properties": {"kind": "areole"}, "geometry": {"type": "Polygon", "coordinates":
            [[[0, 0], [1, 0], [0, 1], [0, 0]]]}},
        {"type": "Feature", "properties": null, "geometry": {"type": "Polygon", "coordinates":
            [[[0, 0], [1, 0], [0, 1], [0, 0]]]}}]}"#;
    let parts = [
        "\"features[0]: holes of the margin: 1\" of files",
        "\"features[2]: a line of 1 points\" of files",
        "\"features[4]: Polygon\" of files",
        "\"colour\" of edges",
    ];
    listed(Format::Json, text, &parts);
}

#[test]
fn links_beside_edges_are_listed() {
    let text = r#"{"nodes": [{"id": 0, "x": 0, "y": 0}, {"id": 1, "x": 1, "y": 0}],
        "edges": [{"source": 0, "target": 1}], "links": [{"source": 1, "target": 0}]}"#;
    let lines = lines(Format::Json, text);
    assert!(
        lines
            .iter()
            .any(|line| line.contains("\"links\" beside \"edges\"")),
        "{lines:?}"
    );
}

#[test]
fn hyperedges_and_inner_graphs_of_graphml_are_listed() {
    let text = r#"<graphml><key id="x" for="node" attr.name="x"/><key id="y" for="node" attr.name="y"/>
        <key id="r" for="edge" attr.name="radius"/><graph edgedefault="undirected">
        <node id="a"><data key="x">0</data><data key="y">0</data></node>
        <node id="b"><data key="x">1</data><data key="y">0</data>
        <graph edgedefault="directed"><node id="c"/></graph></node>
        <edge source="a" target="b"><data key="r">0.1</data></edge>
        <hyperedge><endpoint node="a"/><endpoint node="b"/></hyperedge><hyperedge/></graph></graphml>"#;
    listed(
        Format::GraphMl,
        text,
        &[
            "2 <hyperedge>, the first in line 7",
            "1 <graph>, the first in line 5",
        ],
    );
}

#[test]
fn graphics_of_gml_are_read_and_what_is_else_in_them_is_listed() {
    let text = "graph [ node [ id 0 graphics [ x 0 y 0 w 5 ] ] node [ id 1 graphics [ x 3 y 4 w 5 ] ]\n\
        edge [ source 0 target 1 radius 0.1 ] ]";
    listed(Format::Gml, text, &["\"w\" of nodes"]);
}

#[test]
fn a_width_that_is_not_twice_the_radius_is_refused() {
    let table = |width: &str| {
        format!("from_x,from_y,to_x,to_y,radius_mm,diameter_um\n0,0,1,0,0.05,{width}\n")
    };
    assert_eq!(lines(Format::Table, &table("100")), Vec::<String>::new());
    assert_eq!(lines(Format::Table, &table("")), Vec::<String>::new());
    let error = refused(Format::Table, &table("200"), None);
    assert!(
        error.starts_with("line 2: diameter_um is \"200\"")
            && error.contains("another radius or width"),
        "{error}"
    );
}

#[test]
fn radii_of_ends_count_more_than_the_mean_in_any_order_of_columns() {
    for (columns, values) in [
        ("radius_from_mm,radius_to_mm,radius_mm", "0.2,0.1,0.15"),
        ("radius_mm,radius_from_mm,radius_to_mm", "0.15,0.2,0.1"),
    ] {
        let text = format!("from_x_mm,from_y_mm,to_x_mm,to_y_mm,{columns}\n0,0,1,0,{values}\n");
        let read = imported(Format::Table, &text);
        let edge = read.network.edges()[0];
        assert_eq!((edge.radius_from, edge.radius_to), (0.2, 0.1), "{text}");
    }
}

/// A drawing of 4 by 2 mm with a vein and something else.
fn drawing(more: &str) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 4 2\" width=\"4mm\" height=\"2mm\" \
         stroke=\"#000\" stroke-width=\"0.1\"><path d=\"M0,0 H2\"/>{more}</svg>"
    )
}

#[test]
fn of_a_switch_the_first_element_that_applies_is_drawn() {
    let vein = |attribute: &str, x: u32| format!("<g {attribute}><path d=\"M2,0 h{x}\"/></g>");
    for (branches, length) in [
        ([vein("", 1), vein("", 2)], 3.0),
        (
            [
                vein("requiredExtensions=\"http://ns.adobe.com\"", 1),
                vein("", 2),
            ],
            4.0,
        ),
        ([vein("systemLanguage=\"de, fr\"", 1), vein("", 2)], 4.0),
        ([vein("systemLanguage=\"de, en-GB\"", 1), vein("", 2)], 3.0),
    ] {
        let text = drawing(&format!("<switch>{}</switch>", branches.concat()));
        let read = imported(Format::Svg, &text);
        assert_eq!(read.network.vein_length_mm(), length, "{text}");
        let [line] = &lines(Format::Svg, &text)[..] else {
            panic!("the other branch is listed");
        };
        assert!(
            line.contains("<g> \"another of its <switch> is drawn\""),
            "{line}"
        );
    }
}

#[test]
fn strokes_that_are_scaled_unevenly_are_reported() {
    let scaled = |by: &str| drawing(&format!("<path d=\"M0,0 v1\" transform=\"scale({by})\"/>"));
    assert_eq!(
        lines(Format::Svg, &scaled("0.5 -0.5")),
        Vec::<String>::new()
    );
    assert_eq!(
        lines(Format::Svg, &scaled("1 1) rotate(30")),
        Vec::<String>::new()
    );
    let uneven = lines(Format::Svg, &scaled("4 1"));
    let [line] = uneven.as_slice() else {
        panic!("{uneven:?}");
    };
    assert!(
        line.starts_with("strokes are scaled unevenly") && line.ends_with("(1): line 1 <path>"),
        "{line}"
    );
}
