//! Veins under tension: they straighten, and their angles follow their widths.
//!
//! Where veins meet, each pulls along its own direction with a force in proportion to its radius,
//! and the forces cancel in real leaves (\[bohn2002\]): three equal veins meet at 120°, a fine one
//! leaves a thick one squarely. Nodes move towards that balance for a number of rounds.
//!
//! - **Always true**: no two veins cross that did not before; all nodes move at once, so the order
//!   of work does not matter.

use std::cell::LazyCell;

use glam::DVec2;
use rayon::prelude::*;

use super::network::VeinEdge;
use super::planar::EdgeGrid;
use super::topology::Topology;
use crate::plane::{Lattice, bounds, segment};
use net::{Net, reach, steps};

mod net;

/// Edges shorter than this share of the mean do not pull, so that none shrinks to nothing.
const SHORTEST: f64 = 0.4;

/// How often veins that came to cross are held in place and the rest is moved anew; after that
/// nothing moves at all.
const TRIES: u32 = 24;

/// Edges that a thread takes at a time.
const BLOCK: usize = 4096;

/// The places of the nodes after `rounds`; only nodes with two or more veins for which `is_free`
/// holds move.
pub(super) fn relaxed(
    positions: &[DVec2],
    edges: &[VeinEdge],
    is_free: impl Fn(usize) -> bool,
    rounds: u32,
) -> Vec<DVec2> {
    let mut degrees = vec![0_u32; positions.len()];
    for edge in edges {
        degrees[edge.from as usize] += 1;
        degrees[edge.to as usize] += 1;
    }
    let mut moves: Vec<bool> = degrees
        .iter()
        .enumerate()
        .map(|(node, &degree)| degree > 1 && is_free(node))
        .collect();
    let mut now = moved(positions, edges, &moves, rounds);
    let mut found = crossings(&now, edges);
    let pairs: LazyCell<Vec<[u32; 2]>, _> =
        LazyCell::new(|| edges.iter().map(|edge| [edge.from, edge.to]).collect());
    let topology = LazyCell::new(|| Topology::new(positions.len(), &pairs));
    for attempt in 0..TRIES {
        let new: Vec<[u32; 2]> = found
            .into_iter()
            .filter(|&pair| !cross(ends(positions, edges, pair)))
            .collect();
        if new.is_empty() {
            return now;
        }
        let were = moves.clone();
        hold(&mut moves, edges, new.as_flattened(), 1 + attempt / 4);
        let stopped: Vec<u32> = (0..)
            .zip(were.iter().zip(&moves))
            .filter_map(|(node, (before, after))| (before != after).then_some(node))
            .collect();
        let net = (edges, &*topology);
        let renewed = renew(&mut now, positions, net, &moves, (rounds, &stopped));
        found = match renewed {
            Some(renewed) => crossings_of(&now, edges, &renewed),
            None => crossings(&now, edges),
        };
    }
    positions.to_vec()
}

/// Holds the ends of these edges and all nodes up to `reach` edges from them.
fn hold(moves: &mut [bool], edges: &[VeinEdge], held: &[u32], reach: u32) {
    let mut near = vec![false; moves.len()];
    for &edge in held {
        near[edges[edge as usize].from as usize] = true;
        near[edges[edge as usize].to as usize] = true;
    }
    for _ in 0..reach {
        let inner = near.clone();
        for &VeinEdge { from, to, .. } in edges {
            near[from as usize] |= inner[to as usize];
            near[to as usize] |= inner[from as usize];
        }
    }
    for (moves, near) in moves.iter_mut().zip(near) {
        *moves &= !near;
    }
}

/// Brings `now` to what [`moved`] gives once the nodes `stopped` move no more.
///
/// What happens at a node reaches one edge farther in each step, of which nothing is left far away:
/// see [`reach`]. So places farther away stay, and those nearer are found on the net up to twice as
/// far. Gives the nodes that have new places, or none if all have.
fn renew(
    now: &mut Vec<DVec2>,
    positions: &[DVec2],
    (edges, topology): (&[VeinEdge], &Topology<'_>),
    moves: &[bool],
    (rounds, stopped): (u32, &[u32]),
) -> Option<Vec<u32>> {
    const FAR: u32 = u32::MAX;
    let reach = reach(&steps(rounds));
    let mut away = vec![FAR; positions.len()];
    let mut near = stopped.to_vec();
    for &node in stopped {
        away[node as usize] = 0;
    }
    let mut next = 0;
    while let Some(&node) = near.get(next) {
        next += 1;
        let step = away[node as usize] + 1;
        let leaving = topology
            .leaving(node)
            .iter()
            .map(|&edge| topology.edge(edge)[1]);
        let entering = topology
            .entering(node)
            .iter()
            .map(|&edge| topology.edge(edge)[0]);
        for other in leaving.chain(entering) {
            if step <= 2 * reach && away[other as usize] == FAR {
                away[other as usize] = step;
                near.push(other);
            }
        }
    }
    if 2 * near.len() > positions.len() {
        *now = moved(positions, edges, moves, rounds);
        return None;
    }
    let mut local = vec![FAR; positions.len()];
    for (number, &node) in (0..).zip(&near) {
        local[node as usize] = number;
    }
    let part: Vec<VeinEdge> = edges
        .iter()
        .map(|edge| VeinEdge {
            from: local[edge.from as usize],
            to: local[edge.to as usize],
            ..*edge
        })
        .filter(|edge| edge.from != FAR && edge.to != FAR)
        .collect();
    let at: Vec<DVec2> = near.iter().map(|&node| positions[node as usize]).collect();
    let free: Vec<bool> = near.iter().map(|&node| moves[node as usize]).collect();
    let shortest = SHORTEST * mean_length(positions, edges);
    let found = moved_from(&at, &part, &free, rounds, shortest);
    for (&node, place) in near.iter().zip(found) {
        if away[node as usize] <= reach {
            now[node as usize] = place;
        }
    }
    near.retain(|&node| away[node as usize] <= reach);
    Some(near)
}

fn moved(positions: &[DVec2], edges: &[VeinEdge], moves: &[bool], rounds: u32) -> Vec<DVec2> {
    let shortest = SHORTEST * mean_length(positions, edges);
    moved_from(positions, edges, moves, rounds, shortest)
}

/// As [`moved`]; edges shorter than `shortest` do not pull.
///
/// Each node gathers the pulls on itself in the order of `edges`, so the bits are those of one
/// thread. Nodes are worked on in the order of their places, since what lies near in memory is fetched
/// sooner: three times as fast as in the order of birth. Patches of them go through several steps at
/// once, in the cache.
fn moved_from(
    positions: &[DVec2],
    edges: &[VeinEdge],
    moves: &[bool],
    rounds: u32,
    shortest: f64,
) -> Vec<DVec2> {
    let sorted = by_strips(positions, mean_length(positions, edges));
    let mut places = vec![0_u32; positions.len()];
    for (place, &node) in (0..).zip(&sorted) {
        places[node as usize] = place;
    }
    let net = Net::new(&places, edges, |place| moves[sorted[place] as usize]);
    let at_place = |node: &u32| positions[*node as usize];
    let start = sorted.iter().map(at_place).collect();
    let now = net.after(start, &steps(rounds), shortest);
    places.iter().map(|&place| now[place as usize]).collect()
}

/// The nodes ordered by strips of the blade, each of which is worked through in narrow columns, so
/// that a patch of them is nearly square: as high as it is wide, with few neighbours around.
fn by_strips(positions: &[DVec2], mean_length: f64) -> Vec<u32> {
    let [high, wide] = [128.0, 8.0].map(|edges| edges * mean_length);
    let least = positions.iter().copied().fold(DVec2::INFINITY, DVec2::min);
    let mut sorted: Vec<([u32; 2], f64, u32)> = (0..)
        .zip(positions)
        .map(|(node, &place)| {
            let from = place - least;
            let [strip, column] = [from.y / high, from.x / wide].map(|cell| cell as u32);
            ([strip, column], place.y, node)
        })
        .collect();
    sorted.par_sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2)));
    sorted.into_iter().map(|(.., node)| node).collect()
}

fn mean_length(positions: &[DVec2], edges: &[VeinEdge]) -> f64 {
    let length = |e: &VeinEdge| (positions[e.to as usize] - positions[e.from as usize]).length();
    edges.iter().map(length).sum::<f64>() / (edges.len() as f64).max(1.0)
}

/// Pairs of edges that cross, ascending.
fn crossings(positions: &[DVec2], edges: &[VeinEdge]) -> Vec<[u32; 2]> {
    let nodes = |edge: u32| {
        let edge = &edges[edge as usize];
        [edge.from, edge.to]
    };
    let mean = mean_length(positions, edges);
    let grid = EdgeGrid::new(positions, edges, mean);
    let pairs = |near: &[u32], found: &mut Vec<[u32; 2]>| {
        for (i, &first) in near.iter().enumerate() {
            let [a, b] = nodes(first);
            for &second in &near[i + 1..] {
                let [c, d] = nodes(second);
                let share_a_node = a == c || a == d || b == c || b == d;
                let pair = [first.min(second), first.max(second)];
                if !share_a_node && cross(ends(positions, edges, pair)) {
                    found.push(pair);
                }
            }
        }
    };
    let mut found: Vec<[u32; 2]> = grid
        .lists_at_once()
        .with_min_len(BLOCK)
        .fold(Vec::new, |mut found, near| {
            pairs(near, &mut found);
            found
        })
        .flatten()
        .collect();
    found.sort_unstable();
    found.dedup();
    found
}

/// As [`crossings`], of pairs of which one has an end among these nodes, and perhaps some more.
fn crossings_of(positions: &[DVec2], edges: &[VeinEdge], nodes: &[u32]) -> Vec<[u32; 2]> {
    let mut is_one = vec![false; positions.len()];
    for &node in nodes {
        is_one[node as usize] = true;
    }
    let (low, high) = bounds(positions.iter().copied());
    let size = high - low;
    let cell = (4.0 * mean_length(positions, edges)).max(size.max_element() / 2000.0);
    let lattice = Lattice::new(low, size, cell);
    let cells = |edge: &VeinEdge| {
        let [from, to] = [edge.from, edge.to].map(|node| positions[node as usize]);
        lattice.cells_between(from.min(to), from.max(to))
    };
    let mut is_near = vec![false; lattice.cells()];
    for edge in edges {
        if is_one[edge.from as usize] || is_one[edge.to as usize] {
            cells(edge).for_each(|cell| is_near[cell] = true);
        }
    }
    let (numbers, near): (Vec<u32>, Vec<VeinEdge>) = (0..)
        .zip(edges)
        .filter(|(_, edge)| cells(edge).any(|cell| is_near[cell]))
        .map(|(number, edge)| (number, *edge))
        .unzip();
    let found = crossings(positions, &near);
    let whole = |pair: [u32; 2]| pair.map(|edge| numbers[edge as usize]);
    found.into_iter().map(whole).collect()
}

/// The ends of the first, then of the second edge.
fn ends(positions: &[DVec2], edges: &[VeinEdge], pair: [u32; 2]) -> [DVec2; 4] {
    let [first, second] = pair.map(|edge| &edges[edge as usize]);
    [first.from, first.to, second.from, second.to].map(|node| positions[node as usize])
}

/// Whether the way from the first to the second place crosses that from the third to the fourth.
fn cross([a, b, c, d]: [DVec2; 4]) -> bool {
    segment::cross(a, b, c, d)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn vein(from: u32, to: u32, radius: f64) -> VeinEdge {
        VeinEdge {
            from,
            to,
            radius_from: radius,
            radius_to: radius,
            order: 1,
        }
    }

    /// Three veins of these radii from a junction to fixed ends, at 0°, 90° and 180°.
    fn angle_after(radii: [f64; 3]) -> f64 {
        let ends = [DVec2::X, DVec2::Y, -DVec2::X].map(|end| end * 10.0);
        let positions = [DVec2::ZERO, ends[0], ends[1], ends[2]];
        let edges: Vec<VeinEdge> = (0..3).map(|i| vein(0, i + 1, radii[i as usize])).collect();
        let now = relaxed(&positions, &edges, |_| true, 1000);
        assert_eq!(now[1..], positions[1..], "ends stay");
        (now[1] - now[0])
            .angle_to(now[3] - now[0])
            .abs()
            .to_degrees()
    }

    #[test]
    fn equal_veins_meet_at_120_degrees_and_a_fine_one_leaves_squarely() {
        assert!((angle_after([1.0; 3]) - 120.0).abs() < 0.1);
        // 2 cos(θ / 2) = 0.2 of forces 1, 0.2, 1.
        let thin = 2.0 * libm::acos(0.1).to_degrees();
        assert!((angle_after([1.0, 0.2, 1.0]) - thin).abs() < 0.1);
    }

    #[test]
    fn a_zigzag_straightens_and_keeps_its_ends() {
        let positions: Vec<DVec2> = (0..9)
            .map(|i| DVec2::new(f64::from(i), if i % 2 == 0 { 0.0 } else { 0.4 }))
            .collect();
        let edges: Vec<VeinEdge> = (0..8).map(|i| vein(i, i + 1, 1.0)).collect();
        let now = relaxed(&positions, &edges, |_| true, 20);
        assert_eq!((now[0], now[8]), (positions[0], positions[8]));
        let length = |p: &[DVec2]| p.windows(2).map(|w| (w[1] - w[0]).length()).sum::<f64>();
        assert!(length(&now) < 0.25 * length(&positions) + 0.75 * 8.01);
        let kept = relaxed(&positions, &edges, |node| node != 3, 20);
        assert_eq!(kept[3], positions[3]);
    }

    #[test]
    fn a_vein_that_straightens_does_not_pass_a_free_end() {
        // A bow around the end of a veinlet.
        let bow = (0..=8).map(|i| {
            let angle = f64::from(i) * std::f64::consts::PI / 8.0;
            DVec2::new(-libm::cos(angle), libm::sin(angle))
        });
        let positions: Vec<DVec2> = bow
            .chain([DVec2::new(0.0, -1.0), DVec2::new(0.0, 0.5)])
            .collect();
        let bow = (0..8).map(|i| vein(i, i + 1, 1.0));
        let edges: Vec<VeinEdge> = bow.chain([vein(9, 10, 1.0)]).collect();
        let mut moves = [true; 11];
        for fixed in [0, 8, 9, 10] {
            moves[fixed] = false;
        }
        let free = moved(&positions, &edges, &moves, 200);
        assert_eq!(crossings(&free, &edges).len(), 1, "it would pass");
        let now = relaxed(&positions, &edges, |_| true, 200);
        assert_eq!(crossings(&now, &edges), [[0; 2]; 0]);
        assert!(now != positions, "what is far from the end moves");
    }

    /// A net of so many crooked meshes.
    fn crooked(wide: u32, high: u32) -> (Vec<DVec2>, Vec<VeinEdge>) {
        let positions = (0..wide * high).map(|i| {
            let (x, y) = (f64::from(i % wide), f64::from(i / wide));
            let askew = DVec2::new(libm::sin(7.0 * x + y), libm::sin(3.0 * x - 5.0 * y));
            DVec2::new(x, y) + 0.3 * askew
        });
        let edges = (0..wide * high).flat_map(|i| {
            let right = (i % wide + 1 < wide).then(|| vein(i, i + 1, 1.0));
            let up = (i / wide + 1 < high).then(|| vein(i, i + wide, 0.5));
            [right, up].into_iter().flatten()
        });
        (positions.collect(), edges.collect())
    }

    #[test]
    fn what_is_moved_again_around_held_nodes_has_the_same_bits() {
        let wide = 60;
        let (positions, edges) = crooked(wide, 8);
        let mut moves = vec![true; positions.len()];
        let rounds = 9;
        assert_eq!(reach(&steps(rounds)), 6);
        let mut now = moved(&positions, &edges, &moves, rounds);
        let first = now.clone();
        for stopped in [[65, 66], [188, 3 * wide + 9]] {
            for node in stopped {
                moves[node as usize] = false;
            }
            let pairs: Vec<[u32; 2]> = edges.iter().map(|edge| [edge.from, edge.to]).collect();
            let net = (&edges[..], &Topology::new(positions.len(), &pairs));
            renew(&mut now, &positions, net, &moves, (rounds, &stopped));
            assert_eq!(now, moved(&positions, &edges, &moves, rounds));
        }
        assert_ne!(now, first);
    }

    #[test]
    fn crossings_around_some_nodes_are_those_of_all_that_have_an_end_there() {
        let (mut positions, edges) = crooked(60, 40);
        for (number, place) in positions.iter_mut().enumerate() {
            *place += 0.7 * DVec2::from_angle(number as f64);
        }
        let nodes: Vec<u32> = (900..960).collect();
        let has_end = |pair: &[u32; 2]| {
            let mut ends = pair.iter().flat_map(|&edge| {
                let edge = &edges[edge as usize];
                [edge.from, edge.to]
            });
            ends.any(|node| nodes.contains(&node))
        };
        let only = |pairs: Vec<[u32; 2]>| -> Vec<[u32; 2]> {
            pairs.into_iter().filter(|pair| has_end(pair)).collect()
        };
        let all = crossings(&positions, &edges);
        let expected = only(all.clone());
        assert!(expected.len() > 10 && 10 * expected.len() < all.len());
        assert_eq!(only(crossings_of(&positions, &edges, &nodes)), expected);
    }

    #[test]
    fn nothing_is_felt_beyond_the_reach_of_many_rounds() {
        let (positions, edges) = crooked(320, 4);
        let mut moves = vec![true; positions.len()];
        let rounds = 120;
        assert_eq!(reach(&steps(rounds)), 50);
        let mut now = moved(&positions, &edges, &moves, rounds);
        let stopped = [1];
        moves[1] = false;
        let pairs: Vec<[u32; 2]> = edges.iter().map(|edge| [edge.from, edge.to]).collect();
        let net = (&edges[..], &Topology::new(positions.len(), &pairs));
        let renewed = renew(&mut now, &positions, net, &moves, (rounds, &stopped));
        assert!(renewed.is_some_and(|nodes| nodes.len() < 4 * 60));
        let whole = moved(&positions, &edges, &moves, rounds);
        for (found, whole) in now.iter().zip(whole) {
            assert!((*found - whole).length() < 1e-14 * 320.0);
        }
    }
}
