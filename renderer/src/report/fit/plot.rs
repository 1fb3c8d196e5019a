//! A drawing of measured and fitted spectra, and of what is left.

use crate::measured::spectra::Leaf;
use crate::plot::{Anchor, Axis, Canvas};
use leafmodel::optics::inversion::Found;

/// A leaf and what it was found to hold.
pub(crate) struct Fitted<'a> {
    pub(crate) leaf: &'a Leaf,
    pub(crate) found: Found,
}

/// A leaf's name in messages and tables.
pub(crate) fn shown(leaf: &Leaf) -> &str {
    if leaf.name.is_empty() {
        "the leaf"
    } else {
        &leaf.name
    }
}

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
pub(crate) fn svg(fitted: &[Fitted<'_>]) -> String {
    let drawn = &fitted[..fitted.len().min(MOST_LEAVES)];
    let mut canvas = Canvas::new([SIZE[0], SIZE[1] * drawn.len() as f64]);
    for (number, fitted) in drawn.iter().enumerate() {
        let corner = [0.0, SIZE[1] * number as f64];
        canvas.shifted(corner, |canvas| panel(canvas, fitted));
    }
    canvas.file()
}

fn panel(canvas: &mut Canvas, Fitted { leaf, found }: &Fitted<'_>) {
    let floor = SIZE[1] - MARGIN - LEFT;
    let middle = SIZE[1] - MARGIN - 0.5 * LEFT + 8.0;
    let x = Axis::linear(
        [leaf.nm[0], leaf.nm[leaf.nm.len() - 1]],
        [MARGIN, SIZE[0] - MARGIN],
    );
    let y = Axis::linear([0.0, 1.0], [floor, MARGIN]);
    let abaxial = if leaf.abaxial.is_empty() {
        ""
    } else {
        " and of the abaxial face (brown)"
    };
    let title = format!(
        "{}: R (green){abaxial}, 1 − T (blue); points measured, lines fitted",
        shown(leaf)
    );
    let below = format!(
        "below, fitted less measured, {LARGER} times larger; rms {:.1e}",
        found.rms()
    );
    canvas.text([MARGIN, MARGIN - 26.0], Anchor::Start, "", &title);
    canvas.text([MARGIN, MARGIN - 12.0], Anchor::Start, "", &below);
    let rule = |canvas: &mut Canvas, y: f64, colour: &str| {
        let style = format!("stroke=\"{colour}\"");
        canvas.line([MARGIN, y], [SIZE[0] - MARGIN, y], &style);
    };
    for tick in y.ticks(5) {
        rule(canvas, tick.at, "#ddd");
        canvas.text([MARGIN - 6.0, tick.at + 4.0], Anchor::End, "", &tick.label);
    }
    rule(canvas, middle, "#999");
    for tick in x.ticks(6) {
        canvas.text([tick.at, SIZE[1] - 14.0], Anchor::Middle, "", &tick.label);
    }
    canvas.text(
        [SIZE[0] - MARGIN + 20.0, SIZE[1] - 14.0],
        Anchor::Start,
        "",
        "nm",
    );
    let through = |share: f64, is_r: bool| if is_r { share } else { 1.0 - share };
    for (measured, left, colour, is_r) in [
        (&leaf.reflectance, &found.reflectance_left, "#2a7d2a", true),
        (&leaf.abaxial, &found.abaxial_left, "#8a5a1a", true),
        (
            &leaf.transmittance,
            &found.transmittance_left,
            "#2a4d9d",
            false,
        ),
    ] {
        let place = |nm: f64, share: f64| [x.at(nm), y.at(through(share, is_r))];
        let all = || leaf.nm.iter().zip(measured.iter().zip(left));
        let (fill, stroke) = (format!("fill=\"{colour}\""), format!("stroke=\"{colour}\""));
        for (nm, (value, _)) in all().step_by(all().count().div_ceil(200).max(1)) {
            canvas.circle(place(*nm, *value), 1.6, &fill);
        }
        let fitted = all().map(|(nm, (value, left))| place(*nm, value + left));
        canvas.polyline(fitted, &stroke);
        let off = |left: f64| middle - LARGER * left * (floor - MARGIN);
        let off = all().map(|(nm, (_, left))| [x.at(*nm), off(*left)]);
        canvas.polyline(off, &stroke);
    }
}
