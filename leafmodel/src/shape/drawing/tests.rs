//! Drawings as browsers draw them.

use glam::DVec2;

use super::*;

/// Kind of element, places of its first part in the coordinates of the drawing, width of its stroke.
type Seen = (String, Vec<[f64; 2]>, Option<f64>);

fn with_root<T>(attributes: &str, inside: &str, look: impl FnOnce(&Drawing<'_>) -> T) -> T {
    let text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" \
         xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" {attributes}>{inside}</svg>"
    );
    let document = parse(&text).expect("well-formed");
    let css = style_sheets(&document);
    look(&Drawing::read(&document, &css).expect("a drawing"))
}

fn drawn(inside: &str) -> Vec<Seen> {
    with_root("viewBox=\"0 0 10 10\"", inside, |drawing| {
        let seen = drawing.drawn().map(|shape| {
            let parts = shape.parts().expect("good data");
            let mut places: Vec<[f64; 2]> = Vec::new();
            for cubic in parts.first().into_iter().flatten() {
                places.push(cubic.0[0].into());
                places.push(cubic.0[3].into());
            }
            places.dedup();
            let width = shape.stroke_width(drawing.mm_per_unit).expect("a width");
            (shape.node.tag_name().name().to_owned(), places, width)
        });
        seen.collect()
    })
}

fn widths(inside: &str) -> Vec<Option<f64>> {
    drawn(inside).into_iter().map(|seen| seen.2).collect()
}

fn left_out(inside: &str) -> Vec<(Reason, usize, Vec<String>)> {
    with_root("", inside, |drawing| {
        let left = drawing.left_out.iter();
        left.map(|(reason, left)| (*reason, left.count, left.names.clone()))
            .collect()
    })
}

#[test]
fn styles_follow_the_cascade() {
    let line = "<path class=\"a b\" d=\"M0 0H1\"/>";
    for (css, own, expected) in [
        (".a{stroke:#000;stroke-width:2}", line.to_owned(), Some(2.0)),
        // A rule goes before an attribute, `style` before a rule, `!important` before all.
        (
            ".a{stroke-width:2}",
            line.replace("d=", "stroke=\"red\" stroke-width=\"1\" d="),
            Some(2.0),
        ),
        (
            ".a{stroke-width:2}",
            line.replace("d=", "style=\"stroke:red;stroke-width:3\" d="),
            Some(3.0),
        ),
        (
            ".a{stroke-width:2 !important}",
            line.replace("d=", "style=\"stroke:red;stroke-width:3\" d="),
            Some(2.0),
        ),
        // The more specific rule, then the later one.
        (
            "path.a.b{stroke:red;stroke-width:4} .a{stroke-width:2}",
            line.to_owned(),
            Some(4.0),
        ),
        (
            ".a{stroke:red;stroke-width:4} .b{stroke-width:2}",
            line.to_owned(),
            Some(2.0),
        ),
        (
            "g > .a, .c{stroke:red}",
            format!("<g>{line}</g>"),
            Some(1.0),
        ),
        (
            "#v path{stroke:red;stroke-width:0.5}",
            format!("<g id=\"v\">{line}</g>"),
            Some(0.5),
        ),
        (".a{stroke:red} .b{stroke:none}", line.to_owned(), None),
        (".a{stroke:red;stroke-opacity:0}", line.to_owned(), None),
        ("/* .a{stroke:red} */", line.to_owned(), None),
        // Comments, and a block that is no text of its own.
        ("<![CDATA[ .a{stroke:red} ]]>", line.to_owned(), Some(1.0)),
    ] {
        assert_eq!(
            widths(&format!("<style>{css}</style>{own}")),
            [expected],
            "{css}: {own}"
        );
    }
}

#[test]
fn what_is_hidden_is_listed_and_not_drawn() {
    let line = "<path d=\"M0 0H1\"/>";
    for hidden in [
        format!("<g style=\"display:none\" id=\"old\">{line}{line}</g>"),
        format!("<g display=\"none\" inkscape:label=\"old\">{line}</g>"),
        format!("<style>.h{{display:none}}</style><g class=\"h\" id=\"old\">{line}</g>"),
        format!("<g opacity=\"0\" id=\"old\">{line}</g>"),
        "<path id=\"old\" visibility=\"hidden\" d=\"M0 0H1\"/>".to_owned(),
        "<path id=\"old\" style=\"visibility:collapse\" d=\"M0 0H1\"/>".to_owned(),
    ] {
        assert!(drawn(&hidden).is_empty(), "{hidden}");
        let left = left_out(&hidden);
        let [(Reason::Hidden, 1, names)] = left.as_slice() else {
            panic!("{hidden}: {left:?}");
        };
        assert!(
            names[0].starts_with("line 1 <") && names[0].ends_with("\"old\""),
            "{names:?}"
        );
    }
    // Visibility may be given back within, display may not.
    let back = "<g visibility=\"hidden\"><path visibility=\"visible\" d=\"M0 0H1\"/></g>";
    assert_eq!(drawn(back).len(), 1);
    let gone = "<g display=\"none\"><path display=\"inline\" d=\"M0 0H1\"/></g>";
    assert!(drawn(gone).is_empty());
}

#[test]
fn whatever_is_no_shape_is_listed() {
    let left = left_out(
        "<style>@media print { path { stroke: none } } @font-face { }</style>\
         <text>5 mm</text>\n<image/><g clip-path=\"url(#c)\"><rect width=\"1\" height=\"1\"/></g>\
         <use xlink:href=\"other.svg#a\"/><defs><text/></defs><metadata/><title/>",
    );
    assert_eq!(
        left,
        [
            (
                Reason::NoShape,
                3,
                vec![
                    "line 1 <text>".to_owned(),
                    "line 2 <image>".to_owned(),
                    "line 2 <use> \"other.svg#a\"".to_owned(),
                ]
            ),
            (Reason::Clip, 1, vec!["line 2 <g>".to_owned()]),
            (Reason::Rule, 1, vec!["@media".to_owned()]),
        ]
    );
}

#[test]
fn basic_shapes_are_read() {
    let places = |inside: &str| drawn(inside).remove(0).1;
    assert_eq!(
        places("<rect x=\"1\" y=\"2\" width=\"3\" height=\"4\"/>"),
        [[1.0, 2.0], [4.0, 2.0], [4.0, 6.0], [1.0, 6.0], [1.0, 2.0]]
    );
    assert_eq!(
        places("<polygon points=\"0,0 2,0 1,3\"/>"),
        [[0.0, 0.0], [2.0, 0.0], [1.0, 3.0], [0.0, 0.0]]
    );
    assert_eq!(
        places("<line x2=\"1in\" y2=\"1\"/>"),
        [[0.0, 0.0], [96.0, 1.0]]
    );
    for (round, radii) in [
        ("<circle cx=\"5\" cy=\"6\" r=\"2\"/>", [2.0, 2.0]),
        ("<ellipse cx=\"5\" cy=\"6\" rx=\"2\" ry=\"1\"/>", [2.0, 1.0]),
        (
            "<rect x=\"3\" y=\"5\" width=\"4\" height=\"2\" rx=\"2\" ry=\"1\"/>",
            [2.0, 1.0],
        ),
    ] {
        for place in places(round) {
            let off = (DVec2::from(place) - DVec2::new(5.0, 6.0)) / DVec2::from(radii);
            assert!((off.length() - 1.0).abs() < 1e-12, "{round}: {place:?}");
        }
    }
    // Nothing is drawn without a size, and `<use>` and hidden shapes do not hide that.
    for nothing in ["<rect width=\"3\"/>", "<circle/>", "<polygon/>", "<path/>"] {
        assert!(places(nothing).is_empty(), "{nothing}");
    }
}

#[test]
fn use_repeats_shapes_with_places_styles_and_symbols() {
    let seen = drawn(
        "<defs><path id=\"v\" d=\"M0 0H1\"/></defs>\
         <g stroke=\"red\" stroke-width=\"0.5\" transform=\"scale(2)\">\
         <use href=\"#v\" x=\"3\" y=\"1\"/><use xlink:href=\"#v\" transform=\"rotate(90)\"/></g>",
    );
    let expected = [
        ("path".to_owned(), vec![[6.0, 2.0], [8.0, 2.0]], Some(1.0)),
        ("path".to_owned(), vec![[0.0, 0.0], [0.0, 2.0]], Some(1.0)),
    ];
    for (seen, expected) in seen.iter().zip(&expected) {
        assert_eq!((&seen.0, seen.2), (&expected.0, expected.2));
        for (p, q) in seen.1.iter().zip(&expected.1) {
            assert!(
                DVec2::from(*p).distance(DVec2::from(*q)) < 1e-12,
                "{seen:?}"
            );
        }
    }
    assert_eq!(seen.len(), 2);
    // A symbol is fitted into the size that is asked for, in its middle.
    let symbol = "<symbol id=\"s\" viewBox=\"0 0 2 1\"><path d=\"M0 0L2 1\"/></symbol>";
    for (aspect, expected) in [
        ("", [[0.0, 1.0], [4.0, 3.0]]),
        (
            "preserveAspectRatio=\"xMaxYMax slice\"",
            [[-4.0, 0.0], [4.0, 4.0]],
        ),
        ("preserveAspectRatio=\"none\"", [[0.0, 0.0], [4.0, 4.0]]),
    ] {
        let symbol = symbol.replace("viewBox", &format!("{aspect} viewBox"));
        let seen = drawn(&format!(
            "{symbol}<use href=\"#s\" width=\"4\" height=\"4\"/>"
        ));
        assert_eq!(seen[0].1, expected, "{aspect}");
    }
    let nested = "<svg x=\"1\" y=\"2\" width=\"4\" height=\"2\" viewBox=\"0 0 2 1\"><path d=\"M0 0L2 1\"/></svg>";
    assert_eq!(drawn(nested)[0].1, [[1.0, 2.0], [5.0, 4.0]]);
}

#[test]
fn uses_that_go_in_a_circle_or_draw_too_much_are_reported() {
    let circle = "<g id=\"a\"><use href=\"#a\"/></g>";
    let left = left_out(circle);
    assert_eq!(left[0].0, Reason::NoShape, "{left:?}");
    let mut laughs = "<g id=\"l0\"><path d=\"M0 0H1\"/></g>".to_owned();
    for level in 1..30 {
        let of = format!("<use href=\"#l{}\"/>", level - 1).repeat(10);
        laughs += &format!("<g id=\"l{level}\">{of}</g>");
    }
    let text = format!("<svg xmlns=\"http://www.w3.org/2000/svg\">{laughs}</svg>");
    let document = parse(&text).expect("well-formed");
    let error = Drawing::read(&document, "").expect_err("too much");
    assert!(error.contains("1000000 elements"), "{error}");
}

#[test]
fn the_scale_of_a_page_keeps_its_proportions_unless_asked_otherwise() {
    let scale = |attributes: &str| {
        let view = format!("viewBox=\"0 0 100 50\" {attributes}");
        with_root(&view, "", |drawing| {
            drawing.mm_per_unit.map(|mm| mm.to_array())
        })
    };
    assert_eq!(scale("width=\"200mm\" height=\"100mm\""), Some([2.0, 2.0]));
    assert_eq!(scale("width=\"200mm\""), Some([2.0, 2.0]));
    assert_eq!(scale("height=\"10cm\""), Some([2.0, 2.0]));
    assert_eq!(scale("width=\"100%\" height=\"10cm\""), Some([2.0, 2.0]));
    assert_eq!(scale("width=\"200mm\" height=\"50mm\""), Some([1.0, 1.0]));
    let slice = "width=\"200mm\" height=\"50mm\" preserveAspectRatio=\"xMidYMid slice\"";
    assert_eq!(scale(slice), Some([2.0, 2.0]));
    let none = "width=\"200mm\" height=\"50mm\" preserveAspectRatio=\"none\"";
    assert_eq!(scale(none), Some([2.0, 1.0]));
    assert_eq!(scale("width=\"200\""), None);
}

#[test]
fn a_stroke_that_does_not_scale_is_counted_in_pixels_of_the_page() {
    let line = "<path transform=\"scale(7)\" vector-effect=\"non-scaling-stroke\" stroke=\"red\" \
                stroke-width=\"96\" d=\"M0 0H1\"/>";
    let attributes = "width=\"25.4mm\" height=\"25.4mm\" viewBox=\"0 0 10 10\"";
    with_root(attributes, line, |drawing| {
        let width = drawing.shapes[0].stroke_width(drawing.mm_per_unit);
        // An inch, which is ten units here.
        assert!((width.expect("a width").expect("a stroke") - 10.0).abs() < 1e-12);
    });
}
