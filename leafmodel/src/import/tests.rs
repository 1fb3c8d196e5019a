//! What is written is read back, what others write is read, and what is wrong is told.

mod courses;
mod drawings;
mod left_out;

use super::*;
use crate::document::rows::{Decimal, Separator};
use crate::export;
use crate::measure::{Blade, Known, Measures, Subject, Value, measure};
use crate::shape::outline::Outline;
use crate::species;
use crate::venation::network::VenationNetwork;

/// Leaves of all kinds: nets, trees, splines, transport, several primaries.
const PRESETS: [&str; 6] = ["birch", "poplar", "maple", "xia-1", "arcuate", "ginkgo"];

fn grown(preset: &str) -> (Outline, VenationNetwork) {
    let lamina = species::grown_once::lamina(preset);
    (lamina.outline, lamina.network)
}

fn numbers(measures: &Measures) -> Vec<(&'static str, Vec<Option<f64>>)> {
    let entries = measures.entries().iter().map(|entry| {
        let values = match &entry.value {
            Value::Count(count) => vec![Some(*count as f64)],
            Value::Number(number) => vec![*number],
            Value::List(list) => list.iter().copied().map(Some).collect(),
            Value::Orders(list) => list.clone(),
        };
        (entry.key, values)
    });
    entries.collect()
}

fn assert_alike(read: &Measures, written: &Measures, tolerance: f64, what: &str) {
    for ((key, a), (_, b)) in numbers(read).iter().zip(&numbers(written)) {
        assert_eq!(a.len(), b.len(), "{what}: {key}");
        for (a, b) in a.iter().zip(b) {
            let alike = match (a, b) {
                (Some(a), Some(b)) => (a - b).abs() <= tolerance * b.abs().max(1e-6),
                (None, None) => true,
                _ => false,
            };
            assert!(alike, "{what}: {key} is {a:?}, not {b:?}");
        }
    }
}

fn imported(format: Format, text: &str) -> Imported {
    let draft = read(format, text, None).unwrap_or_else(|error| panic!("{error}"));
    let network = draft.network(&Wanted::default());
    network.unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn a_network_comes_back_from_each_format_with_all_its_measures() {
    for preset in PRESETS {
        let (outline, veins) = grown(preset);
        let written = measure(&outline, &veins, 3.0);
        let outlines = std::slice::from_ref(&outline);
        for (format, text, has_margin) in [
            (Format::GraphMl, export::graphml(&veins), false),
            (Format::Json, export::json(outlines, &veins, false), true),
            (Format::Json, export::geojson(outlines, &veins), true),
            (Format::Table, export::table(&veins), false),
        ] {
            let what = format!("{preset} as {format:?}");
            let read = imported(format, &text);
            assert_eq!(read.known, Known::ALL, "{what}");
            assert!(!read.orders_found, "{what}");
            assert_eq!(read.network.edges(), veins.edges(), "{what}");
            assert_eq!(read.outlines.len(), usize::from(has_margin), "{what}");
            let margin = read.outlines.first().unwrap_or(&outline);
            assert_alike(&measure(margin, &read.network, 3.0), &written, 1e-9, &what);
        }
    }
}

#[test]
fn a_drawing_comes_back_with_lengths_and_widths_up_to_its_rounding() {
    for preset in PRESETS {
        let (outline, veins) = grown(preset);
        let written = measure(&outline, &veins, 3.0);
        let text = export::svg(&outline, &veins, export::SvgStyle::default());
        let read = imported(Format::Svg, &text);
        let margin = read.outlines.first().expect("the drawing has a margin");
        let read = measure(margin, &read.network, 3.0);
        // Coordinates are rounded to 0.0001 mm, and widths that differ by 0.5 % are drawn as one.
        for key in [
            "area_mm2",
            "vein_length_mm",
            "vein_density_mm_per_mm2",
            "minor_vein_share",
            "areole_area_mm2_mean",
            "areole_circularity_median",
            "vein_distance_mm_mean",
        ] {
            let (a, b) = (read.number(key), written.number(key));
            let alike = match (a, b) {
                (Some(a), Some(b)) => (a - b).abs() <= 2e-3 * b.abs(),
                (a, b) => a == b,
            };
            assert!(alike, "{preset}: {key} is {a:?}, not {b:?}");
        }
        let count = |measures: &Measures| measures.number("areole_count").unwrap_or(0.0);
        let (a, b) = (count(&read), count(&written));
        assert!((a - b).abs() <= 0.005 * b, "{preset}: {a} areoles, not {b}");
    }
}

#[test]
fn a_petiole_outside_the_margin_is_left_out_and_reported() {
    let plan = species::find("birch").expect("a preset").plan();
    let lamina = plan.grow_lamina().expect("presets grow");
    let flat = crate::compound::FlatLeaf::with_petiole(&plan, &lamina).expect("a birch has one");
    assert!(flat.network.edges().len() > lamina.network.edges().len());
    let draft = read(Format::GraphMl, &export::graphml(&flat.network), None).expect("just written");
    let read = draft
        .within(lamina.outline.clone())
        .network(&Wanted::default())
        .expect("a network");
    assert_eq!(read.network.edges(), lamina.network.edges());
    let told: Vec<(FaultKind, usize)> = read.faults.iter().map(|f| (f.kind, f.count)).collect();
    assert_eq!(told, [(FaultKind::OutsideMargin, 1)]);
}

/// What networkx 3 writes of a graph of three nodes with `pos`-like attributes in pixels.
const NETWORKX: &str = r#"<?xml version='1.0' encoding='utf-8'?>
<graphml xmlns="http://graphml.graphdrawing.org/xmlns" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:schemaLocation="http://graphml.graphdrawing.org/xmlns http://graphml.graphdrawing.org/xmlns/1.0/graphml.xsd">
  <key id="d3" for="edge" attr.name="width" attr.type="double"/>
  <key id="d1" for="node" attr.name="y" attr.type="long"/>
  <key id="d0" for="node" attr.name="x" attr.type="long"/>
  <graph edgedefault="undirected">
    <node id="stem"><data key="d0">100</data><data key="d1">0</data></node>
    <node id="fork"><data key="d0">100</data><data key="d1">200</data></node>
    <node id="left"><data key="d0">0</data><data key="d1">300</data></node>
    <node id="right"><data key="d0">250</data><data key="d1">300</data></node>
    <edge source="fork" target="left"><data key="d3">6</data></edge>
    <edge source="right" target="fork"><data key="d3">8</data></edge>
    <edge source="stem" target="fork"><data key="d3">10</data></edge>
  </graph>
</graphml>"#;

#[test]
fn a_graph_of_networkx_in_pixels_is_read_with_a_scale_and_turned_from_its_widest_end() {
    let draft = read(Format::GraphMl, NETWORKX, None).expect("well-formed");
    let none = draft.clone().network(&Wanted::default());
    assert_eq!(none.err(), Some(ImportError::NoScale("places")));
    let wanted = Wanted {
        mm_per_unit: Some(0.01),
        ..Wanted::default()
    };
    let read = draft.network(&wanted).expect("a scale is given");
    let edges: Vec<(u32, u32)> = read
        .network
        .edges()
        .iter()
        .map(|e| (e.from, e.to))
        .collect();
    assert_eq!(edges, [(0, 1), (1, 2), (1, 3)]);
    assert_eq!(read.network.nodes()[0].position.to_array(), [1.0, 0.0]);
    assert!((read.network.edges()[0].radius_from - 0.05).abs() < 1e-15);
    assert!(read.orders_found);
    let kinds: Vec<FaultKind> = read.faults.iter().map(|fault| fault.kind).collect();
    assert_eq!(kinds, [FaultKind::NoRoot]);
    let told = Wanted {
        root: Some(glam::DVec2::new(2.4, 3.1)),
        ..wanted
    };
    let read = super::read(Format::GraphMl, NETWORKX, None).and_then(|draft| draft.network(&told));
    let read = read.expect("a root is given");
    assert_eq!(read.network.nodes()[0].position.to_array(), [2.5, 3.0]);
    assert!(read.faults.is_empty());
}

#[test]
fn node_link_lists_and_lines_of_maps_are_read() {
    let lists = r#"{"directed": false, "nodes": [{"id": "a", "x_mm": 0, "y_mm": 0}, {"id": "b", "pos": [0, 5], "x_mm": 0, "y_mm": 5}],
        "links": [{"source": "b", "target": "a", "diameter_um": 80}]}"#;
    // A place in units of the file beside one in millimetres needs a scale.
    assert!(
        read(Format::Json, lists, None)
            .expect("well-formed")
            .place_units
            .some_lack
    );
    let read = imported(Format::Json, &lists.replace("\"pos\": [0, 5], ", ""));
    assert!((read.network.edges()[0].radius_from - 0.04).abs() < 1e-15);
    let map = r#"{"type": "FeatureCollection", "coordinate_unit": "um", "features": [
        {"type": "Feature", "geometry": {"type": "LineString", "coordinates": [[0, 0], [0, 1000], [200, 2000]]}, "properties": {"width": 60, "order": 1}},
        {"type": "Feature", "geometry": {"type": "MultiLineString", "coordinates": [[[0, 1000], [-200, 2000]]]}, "properties": {"width": 30, "order": 2}},
        {"type": "Feature", "geometry": {"type": "Polygon", "coordinates": [[[-1000, 0], [1000, 0], [0, 3000], [-1000, 0]]]}, "properties": {}}]}"#;
    let read = imported(Format::Json, map);
    assert_eq!(read.network.edges().len(), 3);
    assert_eq!(read.outlines[0].area(), 3.0);
    let widest = read.network.edges()[0];
    assert!((widest.radius_from - 0.03).abs() < 1e-15 && widest.order == 1);
}

#[test]
fn tables_have_columns_in_any_order_units_and_decimal_commas() {
    let nodes = "y (mm);x (mm);node\n0;0;base\n10,5;0;tip\n";
    let edges = "Radius_um;target;source\n50;tip;base\n";
    let draft = read(Format::Table, edges, Some(nodes)).expect("well-formed");
    let read = draft.network(&Wanted::default()).expect("a network");
    assert_eq!(read.network.vein_length_mm(), 10.5);
    assert!((read.network.edges()[0].radius_to - 0.05).abs() < 1e-15);
    let [guess] = read.faults.as_slice() else {
        panic!("{:?}", read.faults);
    };
    let said = "guesses about how tables are written (1): nodes: commas in numbers are decimal marks (if not, \
                say --decimal point)";
    assert_eq!(guess.line(), said);
    assert!(guess.kind.is_note());
    // What is known is no guess, and what it excludes is no number.
    let form = |decimal| Form {
        separator: Some(Separator::Semicolon),
        decimal: Some(decimal),
    };
    let known = read_written(Format::Table, edges, Some(nodes), form(Decimal::Comma));
    let read = known.and_then(|draft| draft.network(&Wanted::default()));
    assert!(read.expect("a network").faults.is_empty());
    let error = read_written(Format::Table, edges, Some(nodes), form(Decimal::Point));
    let error = error.expect_err("no number").to_string();
    assert!(error.contains("10,5"), "{error}");
}

fn refused(format: Format, text: &str, nodes: Option<&str>) -> String {
    let draft = read(format, text, nodes);
    let network = draft.and_then(|draft| draft.network(&Wanted::default()));
    network
        .err()
        .map(|error| error.to_string())
        .expect("it cannot be measured")
}

#[test]
fn each_bad_file_is_refused_by_a_sentence_that_names_its_place() {
    for format in [Format::GraphMl, Format::Json, Format::Table, Format::Svg] {
        assert_eq!(refused(format, " \n", None), "is empty");
    }
    let gap = NETWORKX.replace("target=\"left\"", "target=\"lost\"");
    assert_eq!(
        refused(Format::GraphMl, &gap, None),
        "cannot be measured:\n  edges lead to nodes that do not exist (1): line 11: node lost"
    );
    let nan = NETWORKX.replace(">300<", ">nan<");
    assert_eq!(
        refused(Format::GraphMl, &nan, None),
        "cannot be measured:\n  nodes have a coordinate that is not a finite number within 10⁶ mm of the origin (2): node left is at (0, NaN), node right is at (250, NaN)"
    );
    let word = NETWORKX.replace(">8<", ">wide<");
    assert_eq!(
        refused(Format::GraphMl, &word, None),
        "line 12: width is \"wide\"; it must be a number"
    );
    let negative = NETWORKX.replace(">8<", ">-8<");
    assert!(
        refused(Format::GraphMl, &negative, None)
            .contains("(1): line 12: edge 1 from node right to fork has the radius -4")
    );
    let bare = NETWORKX.replace("<data key=\"d1\">0</data>", "");
    assert!(
        refused(Format::GraphMl, &bare, None)
            .starts_with("line 7: node stem has no y; a node needs x and y")
    );
    let twice = NETWORKX.replace("id=\"left\"", "id=\"fork\"");
    assert_eq!(
        refused(Format::GraphMl, &twice, None),
        "line 9: two nodes are called fork"
    );
    assert!(refused(Format::GraphMl, "<svg/>", None).contains("its outermost element is <svg>"));
    assert!(refused(Format::GraphMl, "hello", None).starts_with("is no GraphML"));
    let point = "from_x_mm,from_y_mm,to_x_mm,to_y_mm\n1,1,1,1\n";
    assert!(refused(Format::Table, point, None).starts_with("holds no veins: edges with a length"));
    assert!(refused(Format::Json, "[1]", None).starts_with("holds no veins: an object with nodes"));
    assert!(refused(Format::Json, "{\"nodes\": NaN}", None).starts_with("is no JSON"));
    assert!(refused(Format::Table, "a,b\n1,2\n", None).contains("here are: a, b"));
    assert!(refused(Format::Table, "from,to\n1,2\n", None).contains("--nodes FILE.csv"));
    let places = "from_x_mm,from_y_mm,to_x_mm,to_y_mm,order\n0,0,0,1,0\n";
    assert!(refused(Format::Table, places, None).starts_with("line 2: order is \"0\""));
    let nan = "from_x_mm,from_y_mm,to_x_mm,to_y_mm,radius_mm\n0,0,0,1,0.1\n0,1,0,2,nan\n";
    assert!(refused(Format::Table, nan, None).contains("line 3: edge 1 from node 1 to 2"));
    assert!(
        refused(
            Format::Table,
            "from,to\na,b\n",
            Some("id,x_mm,y_mm\na,0,0\n")
        )
        .contains("line 2: node b")
    );
    assert!(
        refused(
            Format::Svg,
            "<svg xmlns=\"http://www.w3.org/2000/svg\"/>",
            None
        )
        .starts_with("holds no veins")
    );
}

#[test]
fn an_edge_without_one_of_its_ends_is_refused() {
    for (members, end) in [("\"from\":0", "target"), ("\"to\":1", "source")] {
        let text = format!(
            "{{\"nodes\":[{{\"id\":0,\"x_mm\":0,\"y_mm\":0}},{{\"id\":1,\"x_mm\":0,\"y_mm\":1}}],\
             \"links\":[{{{members}}}]}}"
        );
        assert_eq!(
            refused(Format::Json, &text, None),
            format!("edges[0]: an edge needs source and target; it has no {end}")
        );
    }
}

#[test]
fn a_place_that_is_no_number_is_refused_at_a_node_that_is_known_too() {
    let text = "from,to,from_x_mm,from_y_mm,to_x_mm,to_y_mm\na,b,0,0,0,5\nb,c,nan,5,0,9\n";
    assert_eq!(
        refused(Format::Table, text, None),
        "line 3: node b is at (NaN, 5) here and at (0, 5) in an earlier line"
    );
    let first = text.replace("0,5\n", "0,inf\n");
    assert!(refused(Format::Table, &first, None).contains("node b is at"));
}

#[test]
fn lengths_of_one_kind_have_all_a_unit_or_none() {
    let wanted = Wanted {
        mm_per_unit: Some(0.01),
        ..Wanted::default()
    };
    for (header, what) in [
        ("from_x,from_y,to_x_mm,to_y,radius_mm", "places"),
        ("from_x,from_y,to_x,to_y,radius_from_mm,radius_to", "radii"),
    ] {
        let text = format!("{header}\n0,0,0,10,0.1,0.1\n");
        let text = if what == "places" {
            text.replace("0.1,0.1", "0.1")
        } else {
            text
        };
        let draft = read(Format::Table, &text, None).expect("well-formed");
        let error = draft.network(&wanted).err();
        assert_eq!(error, Some(ImportError::MixedUnits(what)));
    }
    // Places in pixels beside radii in micrometres are two quantities.
    let text = "from_x,from_y,to_x,to_y,radius_um\n0,0,0,1000,50\n";
    let draft = read(Format::Table, text, None).expect("well-formed");
    let network = draft.network(&wanted).expect("a scale is given").network;
    assert_eq!(network.vein_length_mm(), 10.0);
    assert!((network.edges()[0].radius_from - 0.05).abs() < 1e-15);
}

#[test]
fn widths_of_strokes_have_units() {
    // 96 units are 25.4 mm here, as CSS counts them.
    let drawing = |width: &str| {
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"25.4mm\" viewBox=\"0 0 96 96\">\
             <path d=\"M0 0V96\" stroke=\"black\" stroke-width=\"{width}\"/></svg>"
        )
    };
    for (width, mm) in [
        ("0.5mm", 0.5),
        ("0.05cm", 0.5),
        ("0.02in", 0.508),
        ("1.44pt", 0.508),
        ("1.92", 0.508),
        ("1.92px", 0.508),
    ] {
        let edge = imported(Format::Svg, &drawing(width)).network.edges()[0];
        let found = 2.0 * edge.radius_from;
        assert!((found - mm).abs() < 1e-12, "{width}: {found} mm");
    }
    for width in ["wide", "5%", "-1", "1em"] {
        let told = refused(Format::Svg, &drawing(width), None);
        let expected = format!("line 1: stroke-width is \"{width}\"; it must be a number");
        assert!(told.starts_with(&expected), "{told}");
    }
}

#[test]
fn edges_without_a_radius_among_others_are_reported() {
    let text = "from,to,from_x_mm,from_y_mm,to_x_mm,to_y_mm,radius_mm\n\
                a,b,0,0,0,5,0.1\nb,c,0,5,0,9,\nb,d,0,5,2,9,0.05\n";
    let read = imported(Format::Table, text);
    assert!(!read.known.radii);
    let told = read.faults.iter().find(|f| f.kind == FaultKind::NoRadius);
    let told = told.expect("it is told");
    assert_eq!(
        (told.count, &told.names[..]),
        (1, &["from node b to c".to_owned()][..])
    );
    let whole = imported(Format::Table, &text.replace("9,\n", "9,0.05\n"));
    assert!(whole.faults.iter().all(|f| f.kind != FaultKind::NoRadius));
}

#[test]
fn a_root_that_is_reported_goes_before_the_directions_of_a_file() {
    let text = "from_x_mm,from_y_mm,to_x_mm,to_y_mm,radius_um\n0,9,0,5,80\n0,5,0,0,80\n";
    let root_of = |root: Option<[f64; 2]>| {
        let draft = read(Format::Table, text, None).expect("well-formed");
        let wanted = Wanted {
            root: root.map(Into::into),
            ..Wanted::default()
        };
        let read = draft.network(&wanted).expect("a network");
        let turned = read.faults.iter().any(|f| f.kind == FaultKind::Turned);
        (read.network.nodes()[0].position.to_array(), turned)
    };
    assert_eq!(root_of(None), ([0.0, 9.0], false));
    assert_eq!(root_of(Some([0.1, 8.0])), ([0.0, 9.0], false));
    assert_eq!(root_of(Some([0.0, -1.0])), ([0.0, 0.0], true));
}

#[test]
fn each_fault_that_can_be_mended_is_reported_with_its_place() {
    // A cross without a node, a twin node, an edge twice, one without length, a lone node, a part
    // of its own, and a node in the middle of an edge.
    let nodes = "id,x_mm,y_mm\n0,0,0\n1,0,4\n2,-1,2\n3,1,2\n4,0,4\n5,2,6\n6,9,9\n7,20,0\n8,20,1\n9,1,5\n10,5,5\n";
    let edges =
        "from,to,radius_mm\n0,1,0.2\n2,3,0.1\n4,5,0.1\n0,1,0.1\n5,5,0.1\n7,8,0.1\n9,10,0.1\n";
    let draft = read(Format::Table, edges, Some(nodes)).expect("well-formed");
    let wanted = Wanted {
        root: Some(glam::DVec2::ZERO),
        ..Wanted::default()
    };
    let read = draft.network(&wanted).expect("it can be measured");
    let lines: Vec<String> = read.faults.iter().map(Fault::line).collect();
    let expected = [
        (FaultKind::NoLength, "(2.000, 6.000)"),
        (FaultKind::TwiceJoined, "(0.000, 2.000)"),
        (FaultKind::SamePlace, "(0.000, 4.000)"),
        (FaultKind::Crossing, "(0.000, 2.000)"),
        (FaultKind::Touch, "(1.000, 5.000)"),
        (FaultKind::Apart, "(20.000, "),
        (FaultKind::Bare, "(9.000, 9.000)"),
    ];
    let kinds: Vec<FaultKind> = read.faults.iter().map(|fault| fault.kind).collect();
    assert_eq!(kinds, expected.map(|(kind, _)| kind), "{lines:#?}");
    for (line, (_, place)) in lines.iter().zip(expected) {
        assert!(line.contains(place), "{line}");
    }
    // The wider of the two edges stays.
    assert!(
        read.network
            .edges()
            .iter()
            .any(|edge| edge.radius_from == 0.2)
    );
}

#[test]
fn without_radii_and_margin_only_what_needs_them_is_missing() {
    let (outline, veins) = grown("poplar");
    let whole = measure(&outline, &veins, 3.0);
    let known = Known {
        radii: false,
        orders: false,
    };
    let partly = Subject::new(Blade::Unknown, &veins, known).measures(3.0);
    assert_eq!(partly.entries().len(), whole.entries().len());
    for key in [
        "vein_length_mm",
        "areole_count",
        "areole_area_mm2_median",
        "spanning_tree_ratio",
        "junction_count",
    ] {
        assert_eq!(partly.number(key), whole.number(key), "{key}");
    }
    for key in [
        "length_mm",
        "vein_density_mm_per_mm2",
        "murray_exponent_median",
        "loop_nesting",
        "minor_vein_share",
        "vein_distance_mm_mean",
    ] {
        assert_eq!(partly.number(key), None, "{key}");
    }
    let area = Subject::new(Blade::Area(outline.area()), &veins, Known::ALL).measures(3.0);
    let key = "vein_density_mm_per_mm2";
    assert_eq!(area.number(key), whole.number(key));
}

#[test]
fn names_and_values_of_files_are_escaped_and_cut_in_messages() {
    let long = "9".repeat(5000);
    for text in [
        "x1_mm;y1_mm;x2_mm;y\u{0}\u{1}µm\n0;0;0;1,5\n".to_owned(),
        format!("from_x_mm,from_y_mm,to_x_mm,to_y_mm\n0,0,0,\u{1b}[2J{long}\n"),
        format!("{long},\u{1b}[2J\n0,0\n"),
        "from_x_mm,from_y_mm,to_x_mm,to_y_mm\n0,0,0\n".to_owned(),
    ] {
        let error = read(Format::Table, &text, None).expect_err("it is wrong");
        let message = error.to_string();
        assert!(!message.contains(|c: char| c.is_control()), "{message:?}");
        assert!(message.chars().count() < 400, "{message}");
    }
    let nodes = "id,x_mm,y_mm\n\u{1b}[2J,0,0\n\u{1b}[2J,1,1\n";
    let error = read(Format::Table, "from,to\na,b\n", Some(nodes)).expect_err("twice");
    assert!(
        error
            .to_string()
            .contains("two nodes are called \\u{1b}[2J"),
        "{error}"
    );
}
