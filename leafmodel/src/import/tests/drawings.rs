//! Drawings of other programs as networks.

use super::*;

/// A drawing of 2 by 1 mm with five veins around two areoles.
fn ladder(head: &str, veins: &str, tail: &str) -> String {
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" \
         xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" viewBox=\"0 0 2 1\" width=\"2mm\" \
         height=\"1mm\">{head}<g {veins}><path d=\"M0,0 L1,0 L2,0\"/><path d=\"M0,1 H1 H2\"/>\
         <path d=\"M0,0 V1\"/><path d=\"M1,0 v1\"/><path d=\"m2,0 v1\"/></g>{tail}</svg>"
    )
}

fn kinds(read: &Imported) -> Vec<(FaultKind, usize)> {
    let faults = read.faults.iter().map(|fault| (fault.kind, fault.count));
    faults
        .filter(|(kind, _)| *kind != FaultKind::NoRoot)
        .collect()
}

fn length_and_areoles(read: &Imported) -> (f64, Option<f64>) {
    let measures = Subject::new(Blade::Area(2.0), &read.network, read.known).measures(3.0);
    let length = measures.number("vein_length_mm").expect("veins");
    (length, measures.number("areole_count"))
}

const PLAIN: &str = "fill=\"none\" stroke=\"#000\" stroke-width=\"0.1\"";

#[test]
fn veins_are_the_same_however_their_style_is_given() {
    let class = "<style>.v{fill:none;stroke:#000;stroke-width:0.1}</style>";
    let hidden = "<g inkscape:groupmode=\"layer\" style=\"display:none\"><path d=\"M0,0 L2,1\" stroke=\"#000\"/></g>";
    let used = "<defs><path id=\"p\" d=\"M0,0 v1\"/></defs>";
    for (text, left_out) in [
        (ladder("", PLAIN, ""), vec![]),
        (ladder(class, "class=\"v\"", ""), vec![]),
        (
            ladder(class, PLAIN, "")
                .replace("<path d=\"M1,0 v1\"/>", "<path class=\"v\" d=\"M1,0 v1\"/>"),
            vec![],
        ),
        (ladder("", PLAIN, hidden), vec![(FaultKind::Hidden, 1)]),
        (
            ladder(used, PLAIN, "").replace("<path d=\"M1,0 v1\"/>", "<use href=\"#p\" x=\"1\"/>"),
            vec![],
        ),
        (
            ladder(
                "",
                PLAIN,
                "<text>2 mm</text><rect width=\"2\" height=\"1\" fill=\"#eee\"/>",
            ),
            vec![(FaultKind::NoStroke, 1), (FaultKind::NoShape, 1)],
        ),
    ] {
        let read = imported(Format::Svg, &text);
        assert_eq!(length_and_areoles(&read), (7.0, Some(2.0)), "{text}");
        assert_eq!(kinds(&read), left_out, "{text}");
        assert!((read.network.edges()[0].radius_from - 0.05).abs() < 1e-15);
    }
}

#[test]
fn a_hidden_vein_is_no_vein() {
    let text = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 2 1\" width=\"2mm\" height=\"1mm\">\
        <g stroke=\"#000\" stroke-width=\"0.1\"><path d=\"M0,0 L2,0\"/></g>\
        <g style=\"display:none\"><path d=\"M0,0.5 L2,0.5\" stroke=\"#000\" stroke-width=\"0.1\"/></g></svg>";
    let read = imported(Format::Svg, text);
    assert_eq!(length_and_areoles(&read), (2.0, Some(0.0)));
    assert_eq!(kinds(&read), [(FaultKind::Hidden, 1)]);
    let all = text.replace("<g stroke", "<g display=\"none\" stroke");
    assert!(refused(Format::Svg, &all, None).contains("are hidden or have no stroke"));
}

#[test]
fn stroked_basic_shapes_are_veins() {
    let text = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 9 9\" width=\"9mm\" height=\"9mm\">\
        <g stroke=\"#000\" stroke-width=\"0.1\"><rect width=\"2\" height=\"3\"/>\
        <polygon points=\"3,0 6,0 6,4\"/><circle cx=\"6\" cy=\"7\" r=\"1\"/></g></svg>";
    let (length, areoles) = length_and_areoles(&imported(Format::Svg, text));
    assert_eq!(areoles, Some(3.0));
    let expected = 10.0 + 12.0 + std::f64::consts::TAU;
    assert!(
        (length - expected).abs() < 1e-2,
        "{length} is not {expected}"
    );
}

#[test]
fn a_margin_is_no_hidden_path() {
    let text = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 9 9\" width=\"9mm\" height=\"9mm\">\
        <path display=\"none\" d=\"M0 0H1V1Z\"/><polygon points=\"1,1 5,1 5,5 1,5\"/></svg>";
    let draft = read_margin(Format::Svg, text).expect("a margin");
    let outlines = draft.outlines(&Wanted::default()).expect("an outline");
    assert_eq!(outlines[0].area(), 16.0);
}
