//! A drawing of measured and fitted spectra, and of what is left.

use std::fmt::Write as _;

use super::Fitted;

/// Leaves that are drawn; more would be a book.
const MOST_LEAVES: usize = 12;
/// Size of one leaf's panel, the share of it that shows what is left, and margins, px.
const SIZE: [f64; 2] = [640.0, 360.0];
const MARGIN: f64 = 44.0;
const LEFT: f64 = 90.0;
/// What is left is drawn this many times larger.
const LARGER: f64 = 10.0;

/// One panel a leaf: R from below in green, 1 − T from above in blue; points are measured, lines
/// fitted. Below, what is left, ten times larger.
pub(super) fn svg(fitted: &[Fitted<'_>]) -> String {
    let drawn = &fitted[..fitted.len().min(MOST_LEAVES)];
    let [width, height] = [SIZE[0], SIZE[1] * drawn.len() as f64];
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" font-size=\"11\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
    );
    for (number, fitted) in drawn.iter().enumerate() {
        let _ = writeln!(
            text,
            "<g transform=\"translate(0 {})\">",
            SIZE[1] * number as f64
        );
        panel(&mut text, fitted);
        text += "</g>\n";
    }
    text + "</svg>\n"
}

fn panel(text: &mut String, Fitted { leaf, found }: &Fitted<'_>) {
    let [first, last] = [leaf.nm[0], leaf.nm[leaf.nm.len() - 1]];
    let floor = SIZE[1] - MARGIN - LEFT;
    let middle = SIZE[1] - MARGIN - 0.5 * LEFT + 8.0;
    let x = |nm: f64| MARGIN + (nm - first) / (last - first) * (SIZE[0] - 2.0 * MARGIN);
    let y = |share: f64| floor - share * (floor - MARGIN);
    let name = leaf.shown().replace('&', "&amp;").replace('<', "&lt;");
    let _ = writeln!(
        text,
        "<text x=\"{MARGIN}\" y=\"{}\">{name}: R (green), 1 − T (blue); points measured, lines \
         fitted; below, fitted less measured, {LARGER} times larger; rms {:.1e}</text>",
        MARGIN - 14.0,
        found.rms()
    );
    for share in [0.0, 0.25, 0.5, 0.75, 1.0] {
        rule(text, y(share), "#ddd");
        let _ = writeln!(
            text,
            "<text x=\"8\" y=\"{:.1}\">{share}</text>",
            y(share) + 4.0
        );
    }
    rule(text, middle, "#999");
    let step = if last - first > 1000.0 { 500.0 } else { 100.0 };
    let mut nm = libm::ceil(first / step) * step;
    while nm <= last {
        let _ = writeln!(
            text,
            "<text x=\"{:.1}\" y=\"{}\">{nm}</text>",
            x(nm) - 12.0,
            SIZE[1] - 14.0
        );
        nm += step;
    }
    let _ = writeln!(
        text,
        "<text x=\"{}\" y=\"{}\">nm</text>",
        SIZE[0] - MARGIN + 8.0,
        SIZE[1] - 14.0
    );
    let through = |share: f64, is_r: bool| if is_r { share } else { 1.0 - share };
    for (measured, left, colour, is_r) in [
        (&leaf.reflectance, &found.reflectance_left, "#2a7d2a", true),
        (
            &leaf.transmittance,
            &found.transmittance_left,
            "#2a4d9d",
            false,
        ),
    ] {
        let shown = |share: f64| through(share, is_r);
        let all = || leaf.nm.iter().zip(measured.iter().zip(left));
        for (nm, (value, _)) in all().step_by(all().count().div_ceil(200).max(1)) {
            let (x, y) = (x(*nm), y(shown(*value)));
            let _ = writeln!(
                text,
                "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"1.6\" fill=\"{colour}\"/>"
            );
        }
        let fitted = all().map(|(nm, (value, left))| (x(*nm), y(shown(value + left))));
        line(text, fitted, colour);
        let off = all().map(|(nm, (_, left))| (x(*nm), middle - LARGER * left * (floor - MARGIN)));
        line(text, off, colour);
    }
}

fn rule(text: &mut String, y: f64, colour: &str) {
    let right = SIZE[0] - MARGIN;
    let _ = writeln!(
        text,
        "<line x1=\"{MARGIN}\" x2=\"{right}\" y1=\"{y:.1}\" y2=\"{y:.1}\" stroke=\"{colour}\"/>"
    );
}

fn line(text: &mut String, points: impl Iterator<Item = (f64, f64)>, colour: &str) {
    let points: Vec<String> = points.map(|(x, y)| format!("{x:.1},{y:.1}")).collect();
    if !points.is_empty() {
        let points = points.join(" ");
        let _ = writeln!(
            text,
            "<polyline points=\"{points}\" fill=\"none\" stroke=\"{colour}\"/>"
        );
    }
}
