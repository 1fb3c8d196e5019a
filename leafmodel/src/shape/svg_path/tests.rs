use super::*;

fn svg(inside: &str) -> String {
    format!("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 10 10\">{inside}</svg>")
}

fn parsed(inside: &str) -> Result<SvgContour, NotGrown> {
    SvgContour::parse("leaf.svg", &svg(inside), None)
}

/// A kite, 2 wide and 4 high, its base below.
const KITE: &str = "M5 9 L6 7 L5 5 L4 7 Z";

#[test]
fn the_lowest_point_seen_is_the_base_and_the_highest_the_apex() {
    let contour = parsed(&format!("<path d=\"{KITE}\"/>")).expect("a kite");
    assert_eq!((contour.base, contour.apex), ([5.0, 9.0], [5.0, 5.0]));
    let outline = contour.grow(20.0).expect("a kite");
    assert_eq!(
        (outline.base(), outline.apex()),
        (DVec2::ZERO, DVec2::new(0.0, 20.0))
    );
    assert!((outline.area() - 100.0).abs() < 1e-12);
    // The right side stays right: the corner at x = 6 comes out at +5 mm.
    assert!(outline.points().contains(&DVec2::new(5.0, 10.0)));
}

#[test]
fn base_and_apex_that_are_given_turn_the_leaf_upright() {
    let mut contour = parsed(&format!("<path d=\"{KITE}\"/>")).expect("a kite");
    // From the right corner to the left one: the kite lies on its side, half as long as it is wide.
    (contour.base, contour.apex) = ([6.0, 7.0], [4.0, 7.0]);
    let outline = contour.grow(20.0).expect("a kite");
    let (low, high) = outline.bounds();
    assert!((high - low - DVec2::new(40.0, 20.0)).length() < 1e-12);
    contour.apex = contour.base;
    assert_eq!(contour.grow(20.0), Err(OutlineError::NoMidrib));
    contour.apex = [40.0, 7.0];
    assert!(matches!(
        contour.grow(20.0),
        Err(OutlineError::OffBlade { end: "apex", .. })
    ));
}

#[test]
fn a_level_base_is_attached_in_its_middle() {
    let contour = parsed("<path d=\"M1 9 H3 L2 1 Z\"/>").expect("a wedge");
    assert_eq!((contour.base, contour.apex), ([2.0, 9.0], [2.0, 1.0]));
}

#[test]
fn transforms_of_the_path_and_of_its_groups_are_carried_out_inside_out() {
    let inside = format!(
        "<g transform=\"translate(10 20) scale(2)\"><g transform=\"rotate(90)\">\
         <path transform=\"matrix(1 0 0 1 -5 -7)\" d=\"{KITE}\"/></g></g>"
    );
    let contour = parsed(&inside).expect("a kite");
    // (5, 9) → (0, 2) → (-2, 0) → (-4, 0) → (6, 20).
    let expected = [[6.0, 20.0], [10.0, 22.0], [14.0, 20.0], [10.0, 18.0]];
    for (p, q) in contour.points.iter().zip(expected) {
        let away = DVec2::from(*p) - DVec2::from(q);
        assert!(away.length() < 1e-12, "{p:?} is not {q:?}");
    }
    let skewed = parsed(&format!("<path transform=\"skewX(45)\" d=\"{KITE}\"/>")).expect("a kite");
    assert!((DVec2::from(skewed.points[0]) - DVec2::new(14.0, 9.0)).length() < 1e-12);
}

#[test]
fn a_path_is_found_by_its_id_and_what_is_not_drawn_is_passed_over() {
    let text = svg(&format!(
        "<defs><path id=\"hidden\" d=\"M0 0H1V1Z\"/></defs><rect/>\
         <path id=\"first\" d=\"{KITE}\"/><path id=\"second\" d=\"M0 8 H2 L1 0 Z\"/>"
    ));
    let corners = |id| {
        let contour = SvgContour::parse("leaf.svg", &text, id).expect("a path");
        contour.points.len()
    };
    assert_eq!(
        (
            corners(None),
            corners(Some("second")),
            corners(Some("hidden"))
        ),
        (4, 3, 3)
    );
    let error = SvgContour::parse("leaf.svg", &text, Some("third")).expect_err("no such path");
    assert_eq!(error.to_string(), "has no path with the id \"third\"");
}

#[test]
fn what_a_drawing_lacks_is_reported() {
    let read = |inside: &str, id| {
        let reading = SvgContour::read("leaf.svg", &svg(inside), id).expect("a kite");
        assert_eq!(reading.contour.points.len(), 4);
        (reading.gap, reading.passed_over)
    };
    let closed = format!("<path id=\"kite\" d=\"{KITE}\"/>");
    assert_eq!(read(&closed, None), (0.0, 0));
    // From (4, 7) back to (5, 9) of a kite that is 4 high.
    let (gap, _) = read("<path d=\"M5 9 L6 7 L5 5 L4 7\"/>", None);
    assert!((gap - 5.0_f64.sqrt() / 4.0).abs() < 1e-12, "{gap}");
    assert_eq!(read("<path d=\"M5 9 L6 7 L5 5 L4 7 L5 9\"/>", None).0, 0.0);
    // What is not drawn does not count, nor does anything where the path is named.
    let several = format!("{closed}<path d=\"M0 0H1\"/><defs><path d=\"M0 0H1\"/></defs>");
    assert_eq!(read(&several, None), (0.0, 1));
    assert_eq!(read(&several, Some("kite")), (0.0, 0));
}

#[test]
fn hidden_paths_are_passed_over_and_basic_shapes_are_outlines_where_there_is_no_path() {
    let hidden = "<g style=\"display:none\" id=\"old\"><path id=\"h\" d=\"M0 0 h10 v10 z\"/></g>";
    let both = svg(&format!("{hidden}<path d=\"{KITE}\"/>"));
    let reading = SvgContour::read("leaf.svg", &both, None).expect("a kite");
    assert_eq!((reading.contour.points.len(), reading.passed_over), (4, 0));
    assert_eq!(
        reading.left_out,
        ["elements of the drawing are hidden (1): line 1 <g> \"old\""]
    );
    // A path that is asked for by its name is read all the same.
    let named = SvgContour::read("leaf.svg", &both, Some("h")).expect("a triangle");
    assert_eq!((named.contour.points.len(), named.left_out.len()), (3, 0));
    for (shape, area) in [
        (
            "<ellipse cx=\"5\" cy=\"5\" rx=\"1\" ry=\"2\"/>",
            std::f64::consts::PI * 0.5,
        ),
        ("<polygon points=\"4,7 5,9 6,7 5,5\"/>", 1.0),
        ("<rect x=\"4\" y=\"5\" width=\"1\" height=\"4\"/>", 1.0),
    ] {
        let outline = parsed(shape).expect(shape).grow(2.0).expect(shape);
        assert!(
            (outline.area() - area).abs() < 1e-3,
            "{shape}: {}",
            outline.area()
        );
    }
}

#[test]
fn a_drawing_that_is_stretched_on_its_page_is_stretched() {
    let page = "width=\"20mm\" height=\"10mm\" viewBox=\"0 0 10 10\" preserveAspectRatio=\"none\"";
    let text =
        format!("<svg xmlns=\"http://www.w3.org/2000/svg\" {page}><path d=\"{KITE}\"/></svg>");
    let contour = SvgContour::parse("leaf.svg", &text, None).expect("a kite");
    assert_eq!((contour.base, contour.apex), ([5.0, 4.5], [5.0, 2.5]));
    let outline = contour.grow(4.0).expect("a kite");
    // 2 wide and 4 high, twice as wide as high on the page: 4 by 4.
    assert!((outline.area() - 8.0).abs() < 1e-12);
}

#[test]
fn a_circle_of_arcs_has_the_area_of_a_circle() {
    let contour = parsed("<path d=\"M5 10 A5 5 0 0 1 5 0 A5 5 0 0 1 5 10 Z\"/>").expect("a circle");
    let outline = contour.grow(2.0).expect("a circle");
    // A polygon within 10⁻⁴ of the diameter of the circle.
    assert!((outline.area() - std::f64::consts::PI).abs() < 2.0 * std::f64::consts::PI * 2e-4);
    assert!(
        contour.points.len() < 400,
        "{} corners",
        contour.points.len()
    );
}

#[test]
fn files_of_drawing_programs_are_read() {
    let text = format!(
        "<?xml version=\"1.0\"?>\n<!DOCTYPE svg PUBLIC \"-//W3C//DTD SVG 1.1//EN\" \"svg11.dtd\" [\
         <!ENTITY ns \"http://www.w3.org/2000/svg\">]>\n\
         <s:svg xmlns:s=\"&ns;\"><!-- leaf --><s:path style=\"fill:none\" d=\"{KITE}\"/></s:svg>"
    );
    assert!(SvgContour::parse("leaf.svg", &text, None).is_ok());
}

#[test]
fn each_unfit_file_is_refused_by_its_own_error() {
    let not_xml = SvgContour::parse("leaf.svg", "<svg", None).expect_err("cut off");
    assert!(not_xml.to_string().starts_with("is no SVG file"));
    for (inside, start) in [
        ("<text>leaf</text>", "has no path"),
        ("<path/>", "has no path"),
        ("<path d=\"M0 0 L1\"/>", "has an attribute `d`"),
        (
            "<path transform=\"turn(3)\" d=\"M0 0H1V1Z\"/>",
            "has an attribute `transform`",
        ),
        (
            "<g style=\"transform: rotate(3deg)\"><path d=\"M0 0H1V1Z\"/></g>",
            "has an attribute `style`",
        ),
        ("<path d=\"M0 0H9V9Z M1 1H2V2Z\"/>", "has a path of 2 parts"),
        (
            "<path transform=\"scale(1e308)\" d=\"M0 0H9V9Z\"/>",
            "has a path that is too large",
        ),
    ] {
        let message = parsed(inside).expect_err(inside).to_string();
        assert!(message.starts_with(start), "{inside}: {message}");
    }
    let bow = parsed("<path d=\"M0 9 L3 9 L0 0 L2 1 Z\"/>").expect("a curve");
    assert!(matches!(
        bow.grow(10.0),
        Err(OutlineError::SelfCrossing { .. })
    ));
}
