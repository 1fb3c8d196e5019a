//! Veins in their true widths, to draw.

use std::fmt::Write as _;

use glam::DVec2;

use super::runs::Runs;
use super::text::{SOFTWARE, rounded};
use crate::shape::outline::Outline;
use crate::venation::areole::areoles;
use crate::venation::network::{VeinEdge, VenationNetwork};

/// Radii that differ by less than this share are drawn as one.
const SAME_WIDTH: f64 = 0.005;

/// Space around the blade, as a share of its longer side.
const BORDER: f64 = 0.02;

/// Tints of areoles, in turn.
const TINTS: [&str; 4] = ["#e3edcb", "#d3e4bd", "#dbe9d6", "#eaeec4"];

/// How an SVG looks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SvgStyle {
    /// Each order in its colour ([`super::ORDER_COLOURS`]) instead of all in dark green.
    pub orders_in_colour: bool,
    /// Areoles filled in pale tints.
    pub areoles: bool,
}

/// Margin and veins as SVG 1.1, in millimetres, apex up.
///
/// There is a group for each order, finest first, so that coarse veins lie on top. Stretches of a
/// vein with one width are one stroked path; where a vein tapers it is a filled outline. A single
/// margin has its ends as `data-base` and `data-apex`, in the coordinates of its path.
pub fn svg(outline: &Outline, network: &VenationNetwork, style: SvgStyle) -> String {
    let outlines = std::slice::from_ref(outline);
    svg_within(outline.bounds(), outlines, network, style)
}

/// The same with a page for another blade, by the lower left and upper right corner of its
/// [`Outline::bounds`]: pictures of a leaf while it grows have one scale on the page of the
/// full-grown one. A compound leaf has several margins.
pub fn svg_within(
    (low, high): (DVec2, DVec2),
    outlines: &[Outline],
    network: &VenationNetwork,
    style: SvgStyle,
) -> String {
    let border = BORDER * (high - low).max_element();
    let size = high - low + DVec2::splat(2.0 * border);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}mm\" height=\"{1}mm\" viewBox=\"{2} {3} {0} {1}\">\n\
         <desc>{SOFTWARE}</desc>\n\
         <g transform=\"scale(1,-1)\">\n<path id=\"margin\" fill=\"#eef3e2\" stroke=\"none\" d=\"",
        rounded(size.x),
        rounded(size.y),
        rounded(low.x - border),
        rounded(-(high.y + border)),
    );
    for outline in outlines {
        points(&mut text, outline.points().iter().copied());
        text.push('Z');
    }
    text += "\"";
    // For programs that read the margin back; nobody else looks at names that begin with data.
    if let [outline] = outlines {
        for (name, end) in [("base", outline.base()), ("apex", outline.apex())] {
            // As the corners of the path, or the end would lie beside them and off the blade.
            let (x, y) = (rounded(end.x), rounded(end.y));
            let _ = write!(text, " data-{name}=\"{x} {y}\"");
        }
    }
    text += "/>\n";
    if style.areoles {
        text += "<g id=\"areoles\" stroke=\"none\">\n";
        let found = areoles(network);
        for number in 0..found.len() {
            let tint = TINTS[number % TINTS.len()];
            let _ = write!(text, "<path fill=\"{tint}\" d=\"");
            points(&mut text, found.polygon(number));
            text += "Z\"/>\n";
        }
        text += "</g>\n";
    }
    let runs = Runs::new(network);
    let mut by_order: Vec<Vec<&[u32]>> = vec![Vec::new(); usize::from(u8::MAX) + 1];
    for run in runs.iter() {
        let order = network.edges()[run[0] as usize].order;
        by_order[usize::from(order)].push(run);
    }
    for (order, runs) in (0..=u8::MAX).zip(by_order).rev() {
        if runs.is_empty() {
            continue;
        }
        let [red, green, blue] = if style.orders_in_colour {
            order_colour(order)
        } else {
            [60, 90, 42]
        };
        let (mut even, mut tapering) = (String::new(), String::new());
        for run in runs {
            vein(&mut even, &mut tapering, network, run);
        }
        let colour = format!("#{red:02x}{green:02x}{blue:02x}");
        let _ = write!(
            text,
            "<g id=\"order-{order}\">\n\
             <g stroke=\"{colour}\" fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n{even}</g>\n\
             <g stroke=\"none\" fill=\"{colour}\">\n{tapering}</g>\n</g>\n"
        );
    }
    text + "</g>\n</svg>\n"
}

/// `M x y L x y …`
fn points(text: &mut String, points: impl Iterator<Item = DVec2>) {
    let mut letter = 'M';
    for point in points {
        let _ = write!(text, "{letter}{} {}", rounded(point.x), rounded(point.y));
        letter = 'L';
    }
}

fn vein(even: &mut String, tapering: &mut String, network: &VenationNetwork, run: &[u32]) {
    let place = |node: u32| network.nodes()[node as usize].position;
    let tapers = |e: &VeinEdge| e.radius_from - e.radius_to > SAME_WIDTH * e.radius_from;
    let mut rest = run
        .iter()
        .map(|&edge| &network.edges()[edge as usize])
        .peekable();
    while let Some(edge) = rest.next() {
        if tapers(edge) {
            let radii = [edge.radius_from, edge.radius_to];
            taper(tapering, place(edge.from), place(edge.to), radii);
            continue;
        }
        let width = 2.0 * edge.radius_to;
        let _ = write!(even, "<path stroke-width=\"{}\" d=\"", width_of(width));
        let mut way = vec![place(edge.from), place(edge.to)];
        let same = |e: &&VeinEdge| {
            !tapers(e) && (e.radius_to - edge.radius_to).abs() <= SAME_WIDTH * edge.radius_to
        };
        while let Some(next) = rest.next_if(same) {
            way.push(place(next.to));
        }
        points(even, way.into_iter());
        even.push_str("\"/>\n");
    }
}

/// A width rounded to a nanometre.
fn width_of(width: f64) -> f64 {
    (width * 1e6).round() / 1e6
}

/// The outline of a vein that tapers, its end rounded; its start lies under the round end of what
/// it comes from.
fn taper(text: &mut String, from: DVec2, to: DVec2, radii: [f64; 2]) {
    let aside = (to - from).perp().normalize_or_zero();
    let [start, end] = radii;
    let corners = [from + aside * start, from - aside * start, to - aside * end];
    text.push_str("<path d=\"");
    points(text, corners.into_iter());
    let (r, last) = (width_of(end), to + aside * end);
    let _ = writeln!(
        text,
        "A{r} {r} 0 0 1 {} {}Z\"/>",
        rounded(last.x),
        rounded(last.y)
    );
}

/// Colours (sRGB) that tell vein orders apart on white, also for most colour-blind eyes (after
/// Okabe and Ito); finer orders than there are colours share the last.
pub const ORDER_COLOURS: [[u8; 3]; 7] = [
    [0, 0, 0],
    [213, 94, 0],
    [0, 114, 178],
    [0, 158, 115],
    [204, 121, 167],
    [86, 180, 233],
    [160, 150, 120],
];

/// Colour of a vein order, 1 or more.
pub fn order_colour(order: u8) -> [u8; 3] {
    let last = ORDER_COLOURS.len() - 1;
    ORDER_COLOURS[usize::from(order.max(1) - 1).min(last)]
}
