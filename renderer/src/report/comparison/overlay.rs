//! Two networks over each other.

use std::fmt::Write as _;

use glam::DVec2;
use leafmodel::export::runs::Runs;
use leafmodel::shape::outline::Outline;
use leafmodel::venation::areole::areoles;
use leafmodel::venation::network::VenationNetwork;
use thiserror::Error;

use crate::comparison::leaves::{Leaf, Shown};
use crate::plot::{Anchor, Canvas, short};
use crate::report::page::hue;

/// Overlays in one report.
pub(crate) const MOST: usize = 6;
/// Longer side of the drawing, and the space around it, pixels.
const SIDE: f64 = 900.0;
const SPACE: f64 = 12.0;
/// Height of the scale bar's strip.
const STRIP: f64 = 30.0;
/// The thinnest line.
const HAIR: f64 = 0.6;
/// Points of a line that are nearer to each other than this are one, pixels.
const NEAR: f64 = 0.4;
/// Lines whose widths differ by less than this share are drawn as one.
const CLASS: f64 = 1.25;

/// How one network is laid over another.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Alignment {
    /// As the files have them
    AsGiven,
    /// Turned, scaled and moved so that base and apex fall together
    BaseAndApex,
    /// Scaled and moved so that centroids and areas of the blades are the same
    CentroidAndArea,
}

/// A leaf by whose margin two networks cannot be aligned.
#[derive(Debug, Error)]
#[error("--align: {0} has no margin of one piece; give one by --outline, or --align as-given")]
pub(crate) struct NoMargin(String);

/// A similarity of the plane: `p ↦ turn · p + shift`, as complex numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Similarity {
    turn: DVec2,
    shift: DVec2,
}

impl Similarity {
    const NONE: Self = Self {
        turn: DVec2::X,
        shift: DVec2::ZERO,
    };

    /// That which brings one pair of points to the other.
    fn between(from: [DVec2; 2], to: [DVec2; 2]) -> Self {
        let [along, wanted] = [from[1] - from[0], to[1] - to[0]];
        let length = along.length_squared();
        let turn = DVec2::new(along.dot(wanted), along.perp_dot(wanted)) / length;
        let shift = to[0] - turn.rotate(from[0]);
        Self { turn, shift }
    }

    fn of(&self, point: DVec2) -> DVec2 {
        self.turn.rotate(point) + self.shift
    }

    fn scale(&self) -> f64 {
        self.turn.length()
    }

    fn inverse(&self) -> Self {
        let turn = DVec2::new(self.turn.x, -self.turn.y) / self.turn.length_squared();
        let shift = -turn.rotate(self.shift);
        Self { turn, shift }
    }
}

/// A drawing, and what there is to say of it.
pub(crate) struct Overlay {
    pub(crate) figure: String,
    pub(crate) caption: String,
}

/// Draws the veins of the second leaf over those of the first.
pub(crate) fn overlay(
    leaves: [&Leaf; 2],
    wanted: Option<Alignment>,
) -> Result<Option<Overlay>, NoMargin> {
    let [Some(first), Some(second)] = leaves.map(|leaf| leaf.shown.as_ref()) else {
        return Ok(None);
    };
    let shown = [first, second];
    let (onto, how) = aligned(leaves, shown, wanted)?;
    let maps = [Similarity::NONE, onto];
    let (low, high) = bounds(shown, maps);
    let extent = (high - low).max(DVec2::splat(1e-9));
    let scale = SIDE / extent.max_element();
    let size = extent * scale + DVec2::splat(2.0 * SPACE);
    let place = |point: DVec2| {
        let at = (point - low) * scale;
        DVec2::new(SPACE + at.x, size.y - SPACE - at.y)
    };
    let mut canvas = Canvas::new([size.x, size.y + STRIP]);
    for (number, (leaf, map)) in shown.into_iter().zip(maps).enumerate() {
        let to_pixels = |point: DVec2| place(map.of(point));
        let hue = hue(number);
        let dash = if number == 0 {
            ""
        } else {
            " stroke-dasharray=\"7 4\""
        };
        for outline in &leaf.outlines {
            let way = closed(outline.points().iter().map(|point| to_pixels(*point)));
            let style = format!("class=\"s{hue}\" fill=\"none\" stroke-width=\"1.2\"{dash}");
            canvas.path(&way, &style);
        }
        // Radii that are not known only hold the place of numbers.
        let wide = if leaf.known.radii {
            map.scale() * scale
        } else {
            0.0
        };
        for (width, way) in ways(&leaf.network, &to_pixels, wide) {
            let style = format!(
                "class=\"s{hue} over\" fill=\"none\" stroke-width=\"{width:.2}\" \
                 stroke-linecap=\"round\" stroke-linejoin=\"round\" stroke-opacity=\"0.85\""
            );
            canvas.path(&way, &style);
        }
    }
    scale_bar(
        &mut canvas,
        [SPACE, size.y + 8.0],
        extent.max_element(),
        scale,
    );
    let near = nearness(shown, onto);
    let [one, other] = leaves.map(|leaf| leaf.name.as_str());
    let figure = canvas.figure(&format!("Veins of {one} and of {other} over each other"));
    let caption = format!("{how} {near}");
    Ok(Some(Overlay { figure, caption }))
}

/// The similarity that lays the second leaf over the first, and how it was found.
fn aligned(
    leaves: [&Leaf; 2],
    shown: [&Shown; 2],
    wanted: Option<Alignment>,
) -> Result<(Similarity, String), NoMargin> {
    let margins = shown.map(|leaf| match leaf.outlines.as_slice() {
        [outline] => Some(outline),
        _ => None,
    });
    let both = margins[0].zip(margins[1]);
    let how = wanted.unwrap_or(if both.is_some() {
        Alignment::BaseAndApex
    } else {
        Alignment::AsGiven
    });
    let needed = || {
        let lacking = leaves
            .iter()
            .zip(&margins)
            .find(|(_, margin)| margin.is_none());
        let name = lacking.map_or("a leaf", |(leaf, _)| leaf.name.as_str());
        NoMargin(name.to_owned())
    };
    let turned = |map: Similarity| {
        let degrees = libm::atan2(map.turn.y, map.turn.x).to_degrees();
        format!(
            "scaled by {} and turned by {}°",
            short(map.scale(), 4),
            short(libm::round(degrees * 10.0) / 10.0 + 0.0, 3)
        )
    };
    Ok(match how {
        Alignment::AsGiven => (
            Similarity::NONE,
            "Both lie as their files have them.".to_owned(),
        ),
        Alignment::BaseAndApex => {
            let (one, other) = both.ok_or_else(needed)?;
            let ends = |outline: &Outline| [outline.base(), outline.apex()];
            let map = Similarity::between(ends(other), ends(one));
            let text = turned(map);
            (
                map,
                format!("The second is {text}, so that base and apex fall together."),
            )
        }
        Alignment::CentroidAndArea => {
            let (one, other) = both.ok_or_else(needed)?;
            let scale = (one.area() / other.area()).sqrt();
            let turn = DVec2::new(scale, 0.0);
            let shift = centroid(one) - scale * centroid(other);
            let map = Similarity { turn, shift };
            let scale = short(scale, 4);
            (
                map,
                format!("The second is scaled by {scale}, so that centroids and areas agree."),
            )
        }
    })
}

/// Centroid of the area inside a margin.
fn centroid(outline: &Outline) -> DVec2 {
    let points = outline.points();
    let next = points.iter().cycle().skip(1);
    let from = points[0];
    let mut sum = DVec2::ZERO;
    let mut area = 0.0;
    for (a, b) in points.iter().zip(next) {
        let [a, b] = [*a - from, *b - from];
        let twice = a.perp_dot(b);
        sum += (a + b) * twice;
        area += 3.0 * twice;
    }
    from + sum / area
}

fn bounds(shown: [&Shown; 2], maps: [Similarity; 2]) -> (DVec2, DVec2) {
    let mut corners = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    for (leaf, map) in shown.into_iter().zip(maps) {
        let margins = leaf.outlines.iter().flat_map(Outline::points);
        let nodes = leaf.network.nodes().iter().map(|node| &node.position);
        for point in margins.chain(nodes) {
            let at = map.of(*point);
            corners = (corners.0.min(at), corners.1.max(at));
        }
    }
    corners
}

fn closed(points: impl Iterator<Item = DVec2>) -> String {
    let mut way = open(points);
    way.push('Z');
    way
}

/// A path through these points, but for those that lie next to the one before.
fn open(points: impl Iterator<Item = DVec2>) -> String {
    let mut way = String::new();
    let mut last: Option<DVec2> = None;
    let mut points = points.peekable();
    while let Some(point) = points.next() {
        let is_near = last.is_some_and(|last| last.distance(point) < NEAR);
        if is_near && points.peek().is_some() {
            continue;
        }
        let letter = if last.is_none() { 'M' } else { 'L' };
        let _ = write!(way, "{letter}{:.1} {:.1}", point.x, point.y);
        last = Some(point);
    }
    way
}

/// The veins as paths, those of one class of widths together, thin ones first.
fn ways(
    network: &VenationNetwork,
    place: &dyn Fn(DVec2) -> DVec2,
    scale: f64,
) -> Vec<(f64, String)> {
    let mut classes: std::collections::BTreeMap<i32, String> = std::collections::BTreeMap::new();
    let position = |node: u32| network.nodes()[node as usize].position;
    for run in Runs::new(network).iter() {
        let edges = run.iter().map(|edge| &network.edges()[*edge as usize]);
        let (mut length, mut area) = (0.0, 0.0);
        for edge in edges.clone() {
            let step = position(edge.from).distance(position(edge.to));
            length += step;
            area += step * (edge.radius_from + edge.radius_to);
        }
        let width = if length > 0.0 {
            area / length * scale
        } else {
            0.0
        };
        let class = libm::round(libm::log(width.max(HAIR)) / libm::log(CLASS)) as i32;
        let first = edges.clone().next().map(|edge| position(edge.from));
        let rest = edges.map(|edge| position(edge.to));
        let points = first.into_iter().chain(rest).map(place);
        classes.entry(class).or_default().push_str(&open(points));
    }
    let width = |class: i32| libm::pow(CLASS, f64::from(class)).max(HAIR);
    classes
        .into_iter()
        .map(|(class, way)| (width(class), way))
        .collect()
}

/// A bar of a round length, at most a quarter of the drawing.
fn scale_bar(canvas: &mut Canvas, at: [f64; 2], side_mm: f64, scale: f64) {
    let most = 0.25 * side_mm;
    let power = libm::pow(10.0, libm::floor(libm::log10(most)));
    let round = [5.0, 2.0, 1.0]
        .into_iter()
        .find(|factor| factor * power <= most);
    let length = round.unwrap_or(1.0) * power;
    let to = [at[0] + length * scale, at[1]];
    canvas.line(at, to, "class=\"axis\" stroke-width=\"2\"");
    let label = format!("{} mm", short(length, 1));
    canvas.text([to[0] + 6.0, at[1] + 4.0], Anchor::Start, "", &label);
}

/// How near the veins of one lie to those of the other, in words.
fn nearness(shown: [&Shown; 2], onto: Similarity) -> String {
    let [first, second] = shown;
    let there = distances(&second.network, &first.network, onto);
    let back = distances(&first.network, &second.network, onto.inverse());
    let back = back.map(|found| found.map(|distance| distance * onto.scale()));
    let told = |found: [f64; 2], whose: &str, other: &str| {
        let [half, most] = found.map(|distance| short(distance, 3));
        format!(
            "Half of the length of the {whose} veins lies within {half} mm of a vein of the {other}, \
             95 % within {most} mm."
        )
    };
    match (there, back) {
        (Some(there), Some(back)) => format!(
            "{} {}",
            told(back, "first's", "second"),
            told(there, "second's", "first")
        ),
        (Some(_) | None, _) => String::new(),
    }
}

/// Distances from veins to the nearest vein of another network, mm: half of the length, and 95 % of
/// it, lie within. `None` without veins.
fn distances(of: &VenationNetwork, to: &VenationNetwork, map: Similarity) -> Option<[f64; 2]> {
    let found = areoles(to);
    let position = |node: u32| of.nodes()[node as usize].position;
    let mut pieces: Vec<(f64, f64)> = of
        .edges()
        .iter()
        .filter_map(|edge| {
            let [from, to] = [edge.from, edge.to].map(position);
            let middle = map.of(0.5 * (from + to));
            Some((found.graph().distance_to_vein(middle)?, from.distance(to)))
        })
        .collect();
    pieces.sort_by(|a, b| a.0.total_cmp(&b.0));
    let all: f64 = pieces.iter().map(|(_, length)| length).sum();
    let within = |share: f64| {
        let mut sum = 0.0;
        let mut nearer = pieces.iter().skip_while(|(_, length)| {
            sum += length;
            sum < share * all
        });
        nearer
            .next()
            .or(pieces.last())
            .map(|(distance, _)| *distance)
    };
    Some([within(0.5)?, within(0.95)?])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_similarity_brings_ends_to_ends_and_back() {
        let [a, b] = [DVec2::new(1.0, 2.0), DVec2::new(4.0, -2.0)];
        let [c, d] = [DVec2::new(-3.0, 0.5), DVec2::new(-3.0, 10.5)];
        let map = Similarity::between([a, b], [c, d]);
        assert!(map.of(a).distance(c) < 1e-12 && map.of(b).distance(d) < 1e-12);
        // Five long, ten long.
        assert!((map.scale() - 2.0).abs() < 1e-12);
        let point = DVec2::new(0.3, 0.7);
        assert!(map.inverse().of(map.of(point)).distance(point) < 1e-12);
        // No mirror image: what lies on the left stays there.
        let left = map.of(a + (b - a).perp());
        assert!((d - c).perp_dot(left - c) > 0.0);
    }

    #[test]
    fn a_half_disc_has_its_centroid_where_the_book_says() {
        let arc = (0..=400).map(|i| std::f64::consts::PI * f64::from(i) / 400.0);
        let points: Vec<DVec2> = arc
            .map(|angle| DVec2::new(5.0 + libm::cos(angle), 7.0 + libm::sin(angle)))
            .collect();
        let (base, apex) = (points[0], points[200]);
        let outline = Outline::new(points, base, apex).expect("a half disc");
        let expected = DVec2::new(5.0, 7.0 + 4.0 / (3.0 * std::f64::consts::PI));
        assert!(
            centroid(&outline).distance(expected) < 1e-4,
            "{}",
            centroid(&outline)
        );
    }
}
