//! Edges that are curves, in the files of many programs.

use super::*;

/// Total length, number of areoles, and kinds of faults but for a root that was chosen.
fn seen(draft: Draft) -> (f64, Option<f64>, Vec<FaultKind>) {
    let wanted = Wanted {
        mm_per_unit: Some(1.0),
        ..Wanted::default()
    };
    let read = draft
        .network(&wanted)
        .unwrap_or_else(|error| panic!("{error}"));
    let measures = Subject::new(Blade::Area(4.0), &read.network, read.known).measures(3.0);
    let kinds = read.faults.iter().map(|fault| fault.kind);
    let kinds = kinds.filter(|kind| *kind != FaultKind::NoRoot && *kind != FaultKind::Turned);
    let length = measures.number("vein_length_mm").expect("veins");
    (length, measures.number("areole_count"), kinds.collect())
}

fn read_seen(format: Format, text: &str) -> (f64, Option<f64>, Vec<FaultKind>) {
    seen(read(format, text, None).unwrap_or_else(|error| panic!("{error}")))
}

#[track_caller]
fn near(
    found: &(f64, Option<f64>, Vec<FaultKind>),
    length: f64,
    areoles: f64,
    kinds: &[FaultKind],
) {
    assert!((found.0 - length).abs() < 1e-9 * length, "{found:?}");
    assert_eq!((found.1, found.2.as_slice()), (Some(areoles), kinds));
}

const KEYS: &str = r#"<graphml xmlns="http://graphml.graphdrawing.org/xmlns">
  <key id="d3" for="edge" attr.name="length" attr.type="double" />
  <key id="d2" for="edge" attr.name="radius" attr.type="double"><default>0.05</default></key>
  <key id="d1" for="node" attr.name="y" attr.type="double"><default>0</default></key>
  <key id="d0" for="node" attr.name="x" attr.type="double" />
  <graph edgedefault="undirected">"#;

#[test]
fn defaults_of_graphml_hold_for_each_attribute_that_an_element_lacks() {
    let text = format!(
        "{KEYS}<node id=\"a\"><data key=\"d0\">0</data></node>
        <node id=\"b\"><data key=\"d0\">2</data></node>
        <node id=\"c\"><data key=\"d0\">2</data><data key=\"d1\">3</data></node>
        <edge source=\"a\" target=\"b\"><data key=\"d3\">2</data></edge>
        <edge source=\"b\" target=\"c\"><data key=\"d2\">0.02</data></edge></graph></graphml>"
    );
    let wanted = Wanted {
        mm_per_unit: Some(1.0),
        ..Wanted::default()
    };
    let draft = read(Format::GraphMl, &text, None).expect("well-formed");
    let network = draft.network(&wanted).expect("a network").network;
    assert_eq!(network.vein_length_mm(), 5.0);
    let mut radii: Vec<f64> = network.edges().iter().map(|edge| edge.radius_to).collect();
    radii.sort_by(f64::total_cmp);
    assert_eq!(radii, [0.02, 0.05]);
}

#[test]
fn parallel_edges_of_given_lengths_are_both_kept() {
    let text = format!(
        "{KEYS}<node id=\"0\"><data key=\"d0\">0</data></node>
        <node id=\"1\"><data key=\"d0\">2</data></node>
        <node id=\"2\"><data key=\"d0\">-1</data></node>
        <edge source=\"0\" target=\"1\"><data key=\"d3\">2.0</data></edge>
        <edge source=\"0\" target=\"1\"><data key=\"d2\">0.04</data><data key=\"d3\">3.14159</data></edge>
        <edge source=\"0\" target=\"2\"><data key=\"d3\">1.0</data></edge></graph></graphml>"
    );
    near(
        &read_seen(Format::GraphMl, &text),
        6.14159,
        1.0,
        &[FaultKind::Bent],
    );
    // Two that are curved, from either end, and one of the node with itself.
    let two = text
        .replace("<data key=\"d3\">2.0", "<data key=\"d3\">2.5")
        .replace(
            "source=\"0\" target=\"1\"><data key=\"d2\"",
            "source=\"1\" target=\"0\"><data key=\"d2\"",
        );
    near(
        &read_seen(Format::GraphMl, &two),
        6.64159,
        1.0,
        &[FaultKind::Bent],
    );
    let ring = text.replace(
        "source=\"0\" target=\"2\"><data key=\"d3\">1.0",
        "source=\"1\" target=\"1\"><data key=\"d3\">1.5",
    );
    let (length, areoles, kinds) = read_seen(Format::GraphMl, &ring);
    assert!((length - 6.64159).abs() < 1e-9, "{length}");
    assert_eq!(
        (areoles, kinds),
        (Some(2.0), vec![FaultKind::Bare, FaultKind::Bent])
    );
}

#[test]
fn lengths_of_tables_are_read_and_those_that_cannot_be_are_reported() {
    let table = "from_x,from_y,to_x,to_y,radius,length\n0,0,1,0,0.05,1.7\n1,0,1,1.5,0.05,1.9\n";
    near(
        &read_seen(Format::Table, table),
        3.6,
        0.0,
        &[FaultKind::Bent],
    );
    let short = table.replace("1.7", "0.7").replace("1.9", "");
    near(
        &read_seen(Format::Table, &short),
        2.5,
        0.0,
        &[FaultKind::ShortLength],
    );
    for bad in ["nan", "-1", "long"] {
        let text = table.replace("1.7", bad);
        let error = read(Format::Table, &text, None)
            .map(|_| ())
            .expect_err(bad)
            .to_string();
        assert!(
            error.starts_with(&format!("line 2: length is \"{bad}\"")),
            "{error}"
        );
    }
    // A unit of its own.
    let micrometres = table
        .replace("length", "length_um")
        .replace("1.7", "1700")
        .replace("1.9", "1900");
    near(
        &read_seen(Format::Table, &micrometres),
        3.6,
        0.0,
        &[FaultKind::Bent],
    );
}

#[test]
fn a_skeleton_of_skan_is_read_with_its_rows_downwards() {
    let table = "skeleton-id,node-id-src,node-id-dst,branch-distance,branch-type,image-coord-src-0,\
        image-coord-src-1,image-coord-dst-0,image-coord-dst-1,coord-src-0,coord-src-1,coord-dst-0,coord-dst-1,\
        euclidean-distance\n0,0,5,5.0,1,0,0,8,0,0,0,4,0,4.0\n0,5,9,3.0,1,8,0,8,6,4,0,4,3,3.0\n";
    let draft = read(Format::Table, table, None).expect("a table");
    let lowest = draft.clone().network(&Wanted {
        mm_per_unit: Some(1.0),
        ..Wanted::default()
    });
    let lowest = lowest
        .expect("a network")
        .network
        .nodes()
        .iter()
        .map(|node| node.position.y)
        .fold(0.0, f64::min);
    assert_eq!(lowest, -4.0);
    // Columns that are not read are named.
    near(
        &seen(draft),
        8.0,
        0.0,
        &[FaultKind::Ignored, FaultKind::Bent],
    );
}

#[test]
fn a_graph_of_sknw_is_read_with_its_points_and_weights() {
    let json = r#"{"directed": false, "multigraph": true, "nodes": [{"id": 0, "o": [0, 0]}, {"id": 1, "o": [0, 4]}, {"id": 2, "o": [0, 9]}],
        "links": [{"source": 0, "target": 1, "key": 0, "pts": [[0, 4], [3, 4], [3, 0], [0, 0]], "weight": 10},
                  {"source": 0, "target": 1, "key": 1, "weight": 4.0},
                  {"source": 1, "target": 2, "key": 0, "pts": "[[0 5]\n [0 8]]", "weight": 5.5}]}"#;
    near(
        &read_seen(Format::Json, json),
        3.0 + 4.0 + 3.0 + 4.0 + 5.0,
        1.0,
        &[],
    );
    let odd = json.replace("[3, 4], ", "3, ");
    let error = read(Format::Json, &odd, None)
        .map(|_| ())
        .expect_err("odd")
        .to_string();
    assert!(
        error.contains("pts is") && error.contains("a list of points"),
        "{error}"
    );
}

#[test]
fn neighbours_of_nefi_are_read() {
    let text = "# graph\n(0, 0)|2\n(0, 4)|{'pixels': 5, 'length': 5.5, 'width': np.float64(0.4)}\n\
        (3, 0)|{'pixels': 3, 'length': 3.0, 'width': 0.2}\n(0, 4)|0\n(3, 0)|0\n";
    let draft = read(Format::Neighbours, text, None).expect("a list");
    near(
        &seen(draft.clone()),
        8.5,
        0.0,
        &[FaultKind::Ignored, FaultKind::Bent],
    );
    let wanted = Wanted {
        mm_per_unit: Some(1.0),
        ..Wanted::default()
    };
    let network = draft.network(&wanted).expect("a network").network;
    let lowest = network
        .nodes()
        .iter()
        .map(|node| node.position.y)
        .fold(0.0, f64::min);
    assert_eq!(lowest, -3.0);
    assert!(network.edges().iter().any(|edge| edge.radius_to == 0.2));
    let error = read(Format::Neighbours, "0 1 2\n", None)
        .map(|_| ())
        .expect_err("no list")
        .to_string();
    assert!(error.contains("line 1"), "{error}");
}

#[test]
fn gml_is_read_with_lists_graphics_and_lengths() {
    let text = "Creator \"networkx\"\ngraph [\n  multigraph 1\n  node [ id 0 label \"0\" x 0.0 y 0 ]\n\
        node [ id 1 label \"µ &quot;1&quot;\" graphics [ x 2 y 0 w 3 fill \"#fff\" ] ]\n\
        node [ id 2 label \"2\" x -1 y 0 ]\n\
        edge [ source 0 target 1 key 0 radius 0.05 length 2.0 ]\n\
        edge [ source 0 target 1 key 1 radius 0.04 points 0 points 1 points 2 points 1 ]\n\
        edge [ source 2 target 0 key 0 radius 0.05 ] ]\n";
    near(
        &read_seen(Format::Gml, text),
        2.0 + 4.0 + 1.0,
        1.0,
        &[FaultKind::Ignored],
    );
    for (bad, problem) in [
        ("graph [ node [ id 0 ", "is not closed by ]"),
        ("graph [ node [ id \"0 ] ]", "is not closed by \""),
        ("graph [ node [ label \"a\" ] ]", "a node has no id"),
        ("nodes 3", "it has no graph"),
    ] {
        let error = read(Format::Gml, bad, None)
            .map(|_| ())
            .expect_err(bad)
            .to_string();
        assert!(error.contains(problem), "{bad}: {error}");
    }
    let deep = "a [ ".repeat(100_000);
    assert!(read(Format::Gml, &deep, None).is_err());
}

#[test]
fn what_a_map_holds_beside_lines_is_listed() {
    let map = r#"{"type": "FeatureCollection", "features": [
        {"type": "Feature", "geometry": {"type": "MultiLineString", "coordinates": [[[0, 0], [0, 1], [1, 2]], [[0, 1], [-1, 2]]]}, "properties": {"length": 99}},
        {"type": "Feature", "geometry": {"type": "Point", "coordinates": [0, 0]}, "properties": {}}]}"#;
    let expected = 1.0 + 2.0 * 2.0_f64.sqrt();
    near(
        &read_seen(Format::Json, map),
        expected,
        0.0,
        &[FaultKind::Ignored],
    );
}

#[test]
fn a_single_feature_or_geometry_is_a_map() {
    let line = r#"{"type": "MultiLineString", "coordinates": [[[0, 0], [0, 1], [1, 1]], [[0, 1], [-2, 1]]]}"#;
    near(&read_seen(Format::Json, line), 4.0, 0.0, &[]);
    let feature = format!(r#"{{"type": "Feature", "properties": {{}}, "geometry": {line}}}"#);
    near(&read_seen(Format::Json, &feature), 4.0, 0.0, &[]);
}

#[test]
fn free_endings_conductance_and_angles_do_not_depend_on_how_finely_veins_are_digitised() {
    // A comb of seven tips, its teeth slanted, in pieces of several lengths.
    let comb = |pieces: u32| {
        let mut text =
            "from_x_mm,from_y_mm,to_x_mm,to_y_mm,radius_from_mm,radius_to_mm\n".to_owned();
        let mut vein = |from: [f64; 2], to: [f64; 2], radii: [f64; 2]| {
            let at = |share: f64| {
                let [x, y] = [0, 1].map(|axis| from[axis] + share * (to[axis] - from[axis]));
                (x, y, radii[0] + share * (radii[1] - radii[0]))
            };
            for piece in 0..pieces {
                let (a, b) = (
                    at(f64::from(piece) / f64::from(pieces)),
                    at(f64::from(piece + 1) / f64::from(pieces)),
                );
                text += &format!("{},{},{},{},{},{}\n", a.0, a.1, b.0, b.1, a.2, b.2);
            }
        };
        for step in 0..4 {
            let (low, high) = (2.0 * f64::from(step), 2.0 * f64::from(step + 1));
            vein(
                [0.0, low],
                [0.0, high],
                [0.2 - 0.01 * low, 0.2 - 0.01 * high],
            );
            if step > 0 {
                vein([0.0, low], [3.0, low + 1.0], [0.1, 0.05]);
                vein([0.0, low], [-3.0, low + 1.0], [0.1, 0.05]);
            }
        }
        text
    };
    let measured = |pieces: u32, outline: &Outline| {
        let read = read(Format::Table, &comb(pieces), None).expect("a table");
        let read = read
            .within(outline.clone())
            .network(&Wanted::default())
            .expect("a network");
        let subject = Subject::new(Blade::Margin(&read.outlines[0]), &read.network, read.known);
        let measures = subject.measures(3.0);
        let supply = subject.supply(0).expect("radii");
        (
            measures
                .number("freely_ending_veinlet_count")
                .expect("a count"),
            supply.conductance,
            [
                "branching_wide_deflection_deg_median",
                "secondary_angle_deg_mean",
            ]
            .map(|key| measures.number(key)),
        )
    };
    let corners =
        [[-20.0, -0.001], [20.0, -0.001], [20.0, 40.0], [-20.0, 40.0]].map(glam::DVec2::from);
    let box_of = |first: usize, pieces: u32| {
        let sides = (0..4).flat_map(|side| {
            let (a, b) = (corners[(first + side) % 4], corners[(first + side + 1) % 4]);
            (0..pieces).map(move |piece| a.lerp(b, f64::from(piece) / f64::from(pieces)))
        });
        let (base, apex) = (glam::DVec2::new(0.0, -0.001), glam::DVec2::new(0.0, 40.0));
        Outline::new(sides.collect(), base, apex).expect("a box")
    };
    let coarse = measured(1, &box_of(0, 1));
    assert_eq!(coarse.0, 7.0);
    for (pieces, outline) in [
        (3, box_of(0, 1)),
        (10, box_of(0, 1)),
        (1, box_of(2, 1)),
        (3, box_of(1, 7)),
    ] {
        let fine = measured(pieces, &outline);
        assert_eq!(fine.0, coarse.0, "{pieces} pieces");
        assert!(
            (fine.1 / coarse.1 - 1.0).abs() < 1e-9,
            "{} is not {}",
            fine.1,
            coarse.1
        );
        for (fine, coarse) in fine.2.iter().zip(&coarse.2) {
            let (fine, coarse) = (fine.unwrap_or(-1.0), coarse.unwrap_or(-1.0));
            assert!((fine - coarse).abs() < 1e-6, "{fine}° is not {coarse}°");
        }
    }
}
