//! Wide veins led straight past their laterals.
//!
//! Where a lateral parts from a wide vein, the line of pixels bends towards it, by up to the wide
//! vein's radius: the middle of both lies there. The wide vein would be longer than it is, and would
//! part from its own direction at each lateral. So the line of a vein that goes through a junction is
//! taken from the points beside, which are clear of the lateral, and the junction lies on it.

use glam::DVec2;

use super::graph::{Chain, Graph};
use super::radii::shadow_of;
use crate::plane::polyline;

/// A vein goes through a junction if all others are at most so wide, as a fraction of its finer side.
const FINER: f64 = 0.75;

/// The finer side is at least so wide, as a fraction of the wider.
const ALIKE: f64 = 0.5;

/// Cosine of the least angle between both sides, 120°.
const STRAIGHT: f64 = -0.5;

/// Points up to this many shadows away are taken.
const WINDOW: f64 = 2.5;

/// Weight of a point that lies in the shadow of a lateral.
const SHADOWED: f64 = 0.02;

/// An end of a chain: the chain's number, and 0 for its first or 1 for its last point.
type End = (usize, usize);

/// Leads all veins straight through their junctions.
pub(super) fn straightened(chains: &mut [Chain], radii: &[Vec<f64>], graph: &mut Graph) {
    let mut at: Vec<Vec<End>> = vec![Vec::new(); graph.nodes.len()];
    for (number, chain) in chains.iter().enumerate() {
        for (end, node) in chain.ends.into_iter().enumerate() {
            at[node as usize].push((number, end));
        }
    }
    let mut partner: Vec<[Option<End>; 2]> = vec![[None; 2]; chains.len()];
    for (node, ends) in at.iter().enumerate() {
        if let Some([a, b]) = through(ends, chains, radii, shadow_of(graph.nodes[node].reach)) {
            partner[a.0][a.1] = Some(b);
            partner[b.0][b.1] = Some(a);
        }
    }
    let mut is_done = vec![false; chains.len()];
    for first in 0..chains.len() {
        if is_done[first] || partner[first] == [None; 2] {
            continue;
        }
        let path = path_through(first, &partner);
        for &(chain, _) in &path {
            is_done[chain] = true;
        }
        lead(&path, chains, graph);
    }
    for (node, ends) in graph
        .nodes
        .iter()
        .zip(&at)
        .filter(|(_, ends)| ends.len() > 2)
    {
        for &(chain, end) in ends {
            let chain = &mut chains[chain];
            let last = chain.points.len() - 1;
            chain.points[if end == 0 { 0 } else { last }] = node.place;
        }
    }
}

/// Both sides of the vein that goes through a junction.
fn through(ends: &[End], chains: &[Chain], radii: &[Vec<f64>], shadow: f64) -> Option<[End; 2]> {
    if ends.len() < 3 {
        return None;
    }
    let side = |&(number, end): &End| {
        let points = &chains[number].points;
        let last = points.len() - 1;
        let index = |i: usize| if end == 0 { i } else { last - i };
        let node = points[index(0)];
        // So far that the bend itself is a small part of the way.
        let is_out = |i: &usize| points[index(*i)].distance(node) >= WINDOW * shadow;
        let ahead = (1..=last).find(is_out).unwrap_or(last);
        (
            radii[number][index(0)],
            (points[index(ahead)] - node).normalize_or_zero(),
            (number, end),
        )
    };
    let mut sides: Vec<(f64, DVec2, End)> = ends.iter().map(side).collect();
    // The sort is stable, so that of equals the first is taken.
    sides.sort_by(|a, b| b.0.total_cmp(&a.0));
    let (first, second, third) = (sides[0], sides[1], sides[2]);
    let is_one = second.0 >= ALIKE * first.0
        && third.0 <= FINER * second.0
        && first.1.dot(second.1) <= STRAIGHT
        && first.2.0 != second.2.0;
    is_one.then_some([first.2, second.2])
}

/// The chains of a vein in order, each with the end at which it is entered.
fn path_through(first: usize, partner: &[[Option<End>; 2]]) -> Vec<End> {
    // Back to where it begins, or once around.
    let mut start: End = (first, 0);
    while let Some((chain, end)) = partner[start.0][start.1] {
        start = (chain, 1 - end);
        if start.0 == first {
            break;
        }
    }
    let mut path = vec![start];
    let mut at = start;
    while let Some(next) = partner[at.0][1 - at.1] {
        if next.0 == start.0 {
            break;
        }
        path.push(next);
        at = next;
    }
    path
}

/// Leads one vein, whose chains are in order, past the shadows of its junctions.
fn lead(path: &[End], chains: &mut [Chain], graph: &mut Graph) {
    // The points with the length up to them, and the shadow in which each is.
    let mut points: Vec<DVec2> = Vec::new();
    let mut places: Vec<(usize, usize)> = Vec::new();
    let mut junctions: Vec<(usize, u32)> = Vec::new();
    for (number, &(chain, end)) in path.iter().enumerate() {
        let count = chains[chain].points.len();
        for i in usize::from(number > 0)..count {
            let i = if end == 0 { i } else { count - 1 - i };
            points.push(chains[chain].points[i]);
            places.push((chain, i));
        }
        if number + 1 < path.len() {
            junctions.push((points.len() - 1, chains[chain].ends[1 - end]));
        }
    }
    let along = polyline::lengths(&points);
    let mut shadow = vec![0.0_f64; points.len()];
    for &(at, node) in &junctions {
        let reach = shadow_of(graph.nodes[node as usize].reach);
        let low = along.partition_point(|&here| here < along[at] - reach);
        let high = along.partition_point(|&here| here <= along[at] + reach);
        for shadow in &mut shadow[low..high] {
            *shadow = shadow.max(reach);
        }
    }
    let last = points.len() - 1;
    let led: Vec<DVec2> = (0..points.len())
        .map(|i| {
            // What the ends are joined to stays.
            if shadow[i] == 0.0 || i == 0 || i == last {
                return points[i];
            }
            let window = WINDOW * shadow[i];
            let low = along.partition_point(|&here| here < along[i] - window);
            let high = along.partition_point(|&here| here <= along[i] + window);
            let fitted = fitted(&points, &along, &shadow, low..high, (along[i], window));
            let shift = fitted - points[i];
            points[i] + shift.clamp_length_max(shadow[i])
        })
        .collect();
    for (&(chain, i), &point) in places.iter().zip(&led) {
        chains[chain].points[i] = point;
    }
    for (at, node) in junctions {
        graph.nodes[node as usize].place = led[at];
    }
}

/// The straight line through some points by weighted least squares, at a length along them.
fn fitted(
    points: &[DVec2],
    along: &[f64],
    shadow: &[f64],
    range: std::ops::Range<usize>,
    (here, window): (f64, f64),
) -> DVec2 {
    let (mut total, mut first, mut second) = (0.0, 0.0, 0.0);
    let (mut sum, mut moment) = (DVec2::ZERO, DVec2::ZERO);
    for i in range {
        let off = along[i] - here;
        let near = 1.0 - (off.abs() / window).powi(3);
        let clear = if shadow[i] > 0.0 { SHADOWED } else { 1.0 };
        let weight = clear * near * near * near + 1e-12;
        total += weight;
        first += weight * off;
        second += weight * off * off;
        sum += weight * points[i];
        moment += weight * off * points[i];
    }
    let determinant = total * second - first * first;
    if determinant <= 1e-9 * total * second {
        return sum / total;
    }
    (sum * second - moment * first) / determinant
}

#[cfg(test)]
mod tests {
    use super::super::graph::Node;
    use super::*;

    #[test]
    fn a_vein_whose_line_bends_at_each_lateral_becomes_straight_and_its_junctions_lie_on_it() {
        // A vein along x with a bump of 6 pixels at x = 50 and at x = 90, towards laterals.
        let bump = |x: f64, middle: f64| (6.0 - 0.6 * (x - middle).abs()).max(0.0);
        let place = |x: f64| DVec2::new(x, bump(x, 50.0) - bump(x, 90.0));
        let line =
            |from: u32, to: u32| (from..=to).map(|x| place(f64::from(x))).collect::<Vec<_>>();
        let lateral = |x: f64, side: f64| -> Vec<DVec2> {
            (0..40)
                .map(|i| DVec2::new(x + f64::from(i), place(x).y + side * f64::from(i)))
                .collect()
        };
        let mut nodes = vec![place(0.0), place(50.0), place(90.0), place(140.0)];
        let shapes = [
            ([0, 1], line(0, 50), 10.0),
            ([1, 2], line(50, 90), 10.0),
            ([2, 3], line(90, 140), 10.0),
            ([1, 4], lateral(50.0, 1.0), 3.0),
            ([2, 5], lateral(90.0, -1.0), 3.0),
        ];
        nodes.extend([shapes[3].1[39], shapes[4].1[39]]);
        let mut chains: Vec<Chain> = Vec::new();
        let mut radii = Vec::new();
        for (number, (ends, points, radius)) in shapes.into_iter().enumerate() {
            radii.push(vec![radius; points.len()]);
            let chain = Chain {
                ends,
                reaches: vec![radius; points.len()],
                points,
            };
            // From either end.
            chains.push(if number % 2 == 1 {
                chain.reversed()
            } else {
                chain
            });
        }
        let nodes = nodes.into_iter().map(|place| Node { place, reach: 10.0 });
        let mut graph = Graph {
            nodes: nodes.collect(),
            chains: Vec::new(),
        };
        let before: f64 = chains[..3].iter().map(Chain::length).sum();
        straightened(&mut chains, &radii, &mut graph);
        let after: f64 = chains[..3].iter().map(Chain::length).sum();
        assert!(
            before > 146.0 && (after - 140.0).abs() < 0.5,
            "{before} became {after}"
        );
        for node in &graph.nodes[1..3] {
            assert!(node.place.y.abs() < 0.5, "{node:?}");
        }
        // All chains still end at their nodes.
        for chain in &chains {
            let ends = [chain.points[0], chain.points[chain.points.len() - 1]];
            let nodes = chain.ends.map(|node| graph.nodes[node as usize].place);
            assert_eq!(ends, nodes);
        }
    }
}
