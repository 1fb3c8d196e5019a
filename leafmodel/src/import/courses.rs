//! The courses of edges: points between their ends, and lengths beyond the straight line.
//!
//! An edge whose file gives points becomes a chain through them. One whose file gives only a length
//! is drawn as arcs of that length: a single one where it shares its ends with another edge, so that
//! both are kept, else several small ones, so that it crosses no neighbour. The length is exact.

use std::collections::BTreeMap;

use glam::DVec2;

use super::draft::{Draft, DraftEdge};
use super::faults::{Fault, FaultKind};
use crate::numeric::bisect;

/// Pieces of an arc.
const PIECES: u32 = 12;

/// Arcs of an edge that is alone between its ends.
const WAVES: u32 = 4;

/// A length counts as that of the straight line within this fraction: files round.
const ROUNDED: f64 = 1e-9;

/// Lengths shorter than this fraction of the straight line are reported.
const SHORT: f64 = 0.99;

/// Makes chains of all edges whose course is not a straight line. Lengths are in millimetres.
pub(super) fn drawn(draft: &mut Draft) {
    let courses = std::mem::take(&mut draft.courses);
    let lengths = std::mem::take(&mut draft.lengths);
    if courses.is_empty() && lengths.is_empty() {
        return;
    }
    let mut between: BTreeMap<[u32; 2], u32> = BTreeMap::new();
    for edge in &draft.edges {
        *between.entry(sorted(edge.ends)).or_default() += 1;
    }
    let mut seen: BTreeMap<[u32; 2], u32> = BTreeMap::new();
    let (mut bent, mut short) = (
        Fault::new(FaultKind::Bent),
        Fault::new(FaultKind::ShortLength),
    );
    let old = std::mem::take(&mut draft.edges);
    // Where other edges lead from a node to which an edge comes back.
    let others = |node: u32| -> DVec2 {
        let at = draft.places[node as usize];
        let around = old
            .iter()
            .flat_map(|edge| [edge.ends, [edge.ends[1], edge.ends[0]]]);
        let around = around.filter(|[from, to]| *from == node && *to != node);
        around
            .map(|[_, to]| (draft.places[to as usize] - at).normalize_or_zero())
            .sum()
    };
    let rings = (0..)
        .zip(&old)
        .filter(|(number, edge)| edge.ends[0] == edge.ends[1] && lengths.contains_key(number));
    let away: BTreeMap<u32, DVec2> = rings
        .map(|(number, edge)| (number, -others(edge.ends[0])))
        .collect();
    for (number, edge) in (0_u32..).zip(old) {
        let [from, to] = edge.ends.map(|end| draft.places[end as usize]);
        let ends = sorted(edge.ends);
        let turn = seen.entry(ends).or_default();
        *turn += 1;
        let chain = if let Some(course) = courses.get(&number) {
            inner_points(course, [from, to])
        } else {
            let chord = from.distance(to);
            match lengths.get(&number) {
                Some(&length) if length > chord * (1.0 + ROUNDED) && length > 0.0 => {
                    bent.at(0.5 * (from + to));
                    // Both sides in turn, as seen from the end with the lower number.
                    let is_left = (*turn % 2 == 1) == (edge.ends == ends);
                    let waves = if between[&ends] > 1 { 1 } else { WAVES };
                    match away.get(&number) {
                        Some(&away) => ring(from, length, away),
                        None => arcs([from, to], length, waves, is_left),
                    }
                }
                Some(&length) if length < SHORT * chord => {
                    short.at(0.5 * (from + to));
                    Vec::new()
                }
                _ => Vec::new(),
            }
        };
        push_chain(draft, &edge, &chain);
    }
    draft.remarks.extend((bent.count > 0).then_some(bent));
    draft.remarks.extend((short.count > 0).then_some(short));
}

fn sorted([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// The points of a course between the ends of its edge, in the direction of the edge; a file may
/// list them from either end, and with the ends or without.
fn inner_points(course: &[DVec2], [from, to]: [DVec2; 2]) -> Vec<DVec2> {
    let (Some(&first), Some(&last)) = (course.first(), course.last()) else {
        return Vec::new();
    };
    let along = first.distance(from) + last.distance(to);
    let against = first.distance(to) + last.distance(from);
    let mut points = course.to_vec();
    if against < along {
        points.reverse();
    }
    points.retain(|point| *point != from && *point != to);
    points.dedup();
    points
}

/// Points of arcs of equal size, on both sides in turn, between two places.
fn arcs([from, to]: [DVec2; 2], length: f64, waves: u32, is_left: bool) -> Vec<DVec2> {
    let chord = to - from;
    if chord == DVec2::ZERO {
        return ring(from, length, DVec2::Y); // Two nodes at one place.
    }
    let turn = turn_of(chord.length() / length);
    let step = chord / f64::from(waves);
    let mut points = Vec::new();
    for wave in 0..waves {
        let start = from + f64::from(wave) * step;
        let side = if (wave % 2 == 0) == is_left {
            1.0
        } else {
            -1.0
        };
        if wave > 0 {
            points.push(start);
        }
        // From the direction of the chord, turned to one side, each piece turns to the other.
        let piece = length / f64::from(waves * PIECES);
        let angle = turn / f64::from(PIECES);
        let mut at = start;
        for number in 0..PIECES - 1 {
            let way = side * (0.5 * turn - (f64::from(number) + 0.5) * angle);
            let (sin, cos) = libm::sincos(way);
            at += piece * DVec2::new(cos, sin).rotate(step.normalize());
            points.push(at);
        }
    }
    points
}

/// By how much [`PIECES`] equal chords of a circle turn, in all, whose ends are `straight` of their
/// length apart, radians: `sin(φ/2) / (n sin(φ/2n)) = straight`.
fn turn_of(straight: f64) -> f64 {
    const STEPS: usize = 80;
    let pieces = f64::from(PIECES);
    let of = |turn: f64| libm::sin(0.5 * turn) / (pieces * libm::sin(0.5 * turn / pieces));
    let (low, high) = bisect(0.0, std::f64::consts::TAU, STEPS, |turn| {
        of(turn) > straight
    });
    0.5 * (low + high)
}

/// A ring of a length through a place, its middle in a direction from there.
fn ring(at: DVec2, length: f64, middle: DVec2) -> Vec<DVec2> {
    let middle = middle.try_normalize().unwrap_or(DVec2::Y);
    let side = length / f64::from(PIECES);
    let angle = std::f64::consts::TAU / f64::from(PIECES);
    let mut place = at;
    let steps = 0..PIECES - 1;
    let point = |step: u32| {
        let (sin, cos) = libm::sincos((f64::from(step) + 0.5) * angle);
        place += side * DVec2::new(cos, sin).rotate(-middle.perp());
        place
    };
    steps.map(point).collect()
}

/// Puts a chain in place of an edge; radii between its ends change evenly with the length.
fn push_chain(draft: &mut Draft, edge: &DraftEdge, inner: &[DVec2]) {
    let [from, to] = edge.ends.map(|end| draft.places[end as usize]);
    let first = draft.places.len() as u32;
    draft.places.extend(inner);
    if !draft.names.is_empty() {
        draft.names.resize(draft.places.len(), String::new());
    }
    let nodes = (first..draft.places.len() as u32).chain([edge.ends[1]]);
    let places: Vec<DVec2> = inner.iter().copied().chain([to]).collect();
    let mut total = 0.0;
    let mut at = from;
    let along: Vec<f64> = places
        .iter()
        .map(|&place| {
            total += at.distance(place);
            at = place;
            total
        })
        .collect();
    let radius = |along: f64| match edge.radii {
        [Some(start), Some(end)] if total > 0.0 => Some(start + (end - start) * (along / total)),
        [start, end] => start.or(end),
    };
    let (mut before, mut start) = (edge.ends[0], edge.radii[0]);
    let last = places.len() - 1;
    for (step, (node, along)) in nodes.zip(along).enumerate() {
        let end = if step == last {
            edge.radii[1]
        } else {
            radius(along)
        };
        draft.edges.push(DraftEdge {
            ends: [before, node],
            radii: [start, end],
            order: edge.order,
        });
        (before, start) = (node, end);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn length(points: &[DVec2]) -> f64 {
        points
            .windows(2)
            .map(|pair| pair[0].distance(pair[1]))
            .sum()
    }

    #[test]
    fn arcs_have_the_length_that_is_asked_for_and_end_where_they_should() {
        let ends = [DVec2::new(1.0, 2.0), DVec2::new(4.0, -2.0)];
        for wanted in [5.000_001, 5.5, 7.9, 20.0] {
            for waves in [1, WAVES] {
                for is_left in [false, true] {
                    let inner = arcs(ends, wanted, waves, is_left);
                    let all: Vec<DVec2> = [&ends[..1], &inner, &ends[1..]].concat();
                    let found = length(&all);
                    assert!(
                        (found - wanted).abs() < 1e-9 * wanted,
                        "{found} is not {wanted}"
                    );
                    let middle = inner[(PIECES / 2 - 1) as usize] - ends[0];
                    let is_there = (ends[1] - ends[0]).perp_dot(middle) > 0.0;
                    assert_eq!(is_there, is_left, "{wanted} mm in {waves} arcs");
                }
            }
        }
        let ring = ring(ends[0], 6.0, DVec2::X);
        let all: Vec<DVec2> = [&ends[..1], &ring, &ends[..1]].concat();
        assert!((length(&all) - 6.0).abs() < 1e-12);
        assert!(ring.iter().all(|place| place.x > ends[0].x - 1e-12));
    }
}
