//! From lines one pixel wide to a graph: nodes where lines end or meet, chains of pixels between.

use glam::DVec2;

use super::grid::{Mask, beside};
use crate::plane::polyline;

/// A node: the end of a line, or a group of neighbouring pixels at which lines meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Node {
    /// Its place in pixels of the picture, y down.
    pub(super) place: DVec2,
    /// Distance to the edge of the vein, pixels.
    pub(super) reach: f64,
}

/// A line from node to node.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Chain {
    /// The nodes at its ends.
    pub(super) ends: [u32; 2],
    /// Its points, with those of the nodes, at least two.
    pub(super) points: Vec<DVec2>,
    /// Distance from each point to the edge of the vein, pixels.
    pub(super) reaches: Vec<f64>,
}

impl Chain {
    /// Its length, pixels.
    pub(super) fn length(&self) -> f64 {
        polyline::length(&self.points)
    }

    /// The same chain from its other end.
    pub(super) fn reversed(mut self) -> Self {
        self.ends.reverse();
        self.points.reverse();
        self.reaches.reverse();
        self
    }

    /// The chain from `node`, which is one of its ends.
    pub(super) fn from(self, node: u32) -> Self {
        if self.ends[0] == node {
            self
        } else {
            self.reversed()
        }
    }
}

/// Lines and where they meet.
#[derive(Clone, Debug, Default)]
pub(super) struct Graph {
    pub(super) nodes: Vec<Node>,
    pub(super) chains: Vec<Chain>,
}

/// No pixel.
const NONE: u32 = u32::MAX;

/// The pixels of a thinned set with their neighbours.
struct Lines<'a> {
    set: &'a Mask,
    squares: &'a [u32],
    /// The cells.
    cells: Vec<u32>,
    /// For each cell of the mask its number in `cells`.
    number: Vec<u32>,
}

impl Lines<'_> {
    /// The neighbours of a pixel, by number. Those across a corner count only if no third pixel
    /// joins them to it by sides.
    fn neighbours(&self, pixel: u32) -> impl Iterator<Item = u32> + '_ {
        let cell = self.cells[pixel as usize] as usize;
        let steps = self.set.steps();
        (0..8).filter_map(move |way| {
            let is_in = |way: usize| self.set.cells[beside(cell, steps[way % 8])];
            let joins = way % 2 == 0 || !(is_in(way + 7) || is_in(way + 1));
            (is_in(way) && joins).then(|| self.number[beside(cell, steps[way])])
        })
    }

    fn place(&self, pixel: u32) -> DVec2 {
        self.set.centre(self.cells[pixel as usize] as usize)
    }

    fn reach(&self, pixel: u32) -> f64 {
        f64::from(self.squares[self.cells[pixel as usize] as usize]).sqrt()
    }
}

/// The graph of a thinned set; `squares` are the squares of distances of the set before. Single
/// pixels have no length and are left out.
pub(super) fn graph_of(set: &Mask, squares: &[u32]) -> Graph {
    let cells: Vec<u32> = (0..set.cells.len() as u32)
        .filter(|&cell| set.cells[cell as usize])
        .collect();
    let mut number = vec![NONE; set.cells.len()];
    for (pixel, &cell) in (0..).zip(&cells) {
        number[cell as usize] = pixel;
    }
    let lines = Lines {
        set,
        squares,
        cells,
        number,
    };
    let count = lines.cells.len();
    let degrees: Vec<u8> = (0..count as u32)
        .map(|pixel| lines.neighbours(pixel).count() as u8)
        .collect();
    let mut graph = Graph::default();
    let mut node_of = nodes(&lines, &degrees, &mut graph);
    let mut is_done = vec![false; count];
    for pixel in 0..count as u32 {
        if node_of[pixel as usize] == NONE {
            continue;
        }
        for next in lines.neighbours(pixel) {
            let node = node_of[next as usize];
            let is_new = if node == NONE {
                !is_done[next as usize]
            } else {
                // Two ends side by side, or an end beside a meeting; each pair once.
                node != node_of[pixel as usize] && pixel < next
            };
            if is_new {
                let chain = follow(&lines, &node_of, &graph, [pixel, next], &mut is_done);
                graph.chains.push(chain);
            }
        }
    }
    // What is left are circles on which nothing meets.
    for pixel in 0..count as u32 {
        if node_of[pixel as usize] != NONE || is_done[pixel as usize] {
            continue;
        }
        let Some(next) = lines.neighbours(pixel).next() else {
            continue;
        };
        node_of[pixel as usize] = graph.nodes.len() as u32;
        graph.nodes.push(Node {
            place: lines.place(pixel),
            reach: lines.reach(pixel),
        });
        let chain = follow(&lines, &node_of, &graph, [pixel, next], &mut is_done);
        graph.chains.push(chain);
    }
    graph
}

/// Makes the nodes; for each pixel its node, if it belongs to one. Neighbouring pixels at which
/// lines meet are one node in the middle of them.
fn nodes(lines: &Lines, degrees: &[u8], graph: &mut Graph) -> Vec<u32> {
    let mut node_of = vec![NONE; degrees.len()];
    let mut group = Vec::new();
    for pixel in 0..degrees.len() as u32 {
        let degree = degrees[pixel as usize];
        if degree == 0 || degree == 2 || node_of[pixel as usize] != NONE {
            continue;
        }
        let node = graph.nodes.len() as u32;
        group.clear();
        group.push(pixel);
        node_of[pixel as usize] = node;
        let mut next = 0;
        while let Some(&member) = group.get(next).filter(|_| degree > 2) {
            next += 1;
            for other in lines.neighbours(member) {
                if degrees[other as usize] > 2 && node_of[other as usize] == NONE {
                    node_of[other as usize] = node;
                    group.push(other);
                }
            }
        }
        let sum: DVec2 = group.iter().map(|&member| lines.place(member)).sum();
        let reach = group.iter().map(|&member| lines.reach(member));
        graph.nodes.push(Node {
            place: sum / group.len() as f64,
            reach: reach.fold(0.0, f64::max),
        });
    }
    node_of
}

/// Follows a line from a pixel of a node to the next node.
fn follow(
    lines: &Lines,
    node_of: &[u32],
    graph: &Graph,
    [first, second]: [u32; 2],
    is_done: &mut [bool],
) -> Chain {
    let start = node_of[first as usize];
    let of_node = |node: u32| graph.nodes[node as usize];
    let mut points = vec![of_node(start).place];
    let mut reaches = vec![of_node(start).reach];
    let (mut before, mut here) = (first, second);
    while node_of[here as usize] == NONE {
        is_done[here as usize] = true;
        points.push(lines.place(here));
        reaches.push(lines.reach(here));
        let next = lines.neighbours(here).find(|&next| next != before);
        let next = next.expect("a pixel with two neighbours has one besides that before");
        (before, here) = (here, next);
    }
    let end = node_of[here as usize];
    points.push(of_node(end).place);
    reaches.push(of_node(end).reach);
    Chain {
        ends: [start, end],
        points,
        reaches,
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::components::{Joined, each_component, flip_small};
    use super::super::distance::squared_distances;
    use super::super::pruning::Pruning;
    use super::super::thinning::thinned;
    use super::*;

    fn traced(set: &Mask) -> (Mask, Graph) {
        let squares = squared_distances(set);
        let lines = thinned(set.clone(), &squares);
        let graph = graph_of(&lines, &squares);
        let before = loops(&graph);
        let mut pruning = Pruning::new(graph);
        pruning.cut_spurs(2.5);
        pruning.join_near_nodes(0.5);
        let graph = pruning.finished();
        assert_eq!(loops(&graph), before, "spurs are no loops");
        (lines, graph)
    }

    /// Number of parts and of holes.
    fn topology(set: &Mask) -> (usize, usize) {
        let (mut parts, mut holes) = (0, 0);
        each_component(set, true, Joined::Eight, |_| parts += 1);
        each_component(set, false, Joined::Four, |hole| {
            holes += usize::from(!hole.at_frame);
        });
        (parts, holes)
    }

    /// Lines less nodes and parts: the number of independent loops.
    fn loops(graph: &Graph) -> usize {
        let mut leaders: Vec<usize> = (0..graph.nodes.len()).collect();
        let mut parts = graph.nodes.len();
        for chain in &graph.chains {
            let [a, b] = chain.ends.map(|node| {
                let mut node = node as usize;
                while leaders[node] != node {
                    node = leaders[node];
                }
                node
            });
            if a != b {
                leaders[a] = b;
                parts -= 1;
            }
        }
        graph.chains.len() + parts - graph.nodes.len()
    }

    fn degrees(graph: &Graph) -> Vec<usize> {
        let mut degrees = vec![0; graph.nodes.len()];
        for end in graph.chains.iter().flat_map(|chain| chain.ends) {
            degrees[end as usize] += 1;
        }
        degrees
    }

    /// Whether a place lies within `radius` of the line from `a` to `b`.
    fn near(p: DVec2, [a, b]: [[f64; 2]; 2], radius: f64) -> bool {
        let (a, b) = (DVec2::from(a), DVec2::from(b));
        let along = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
        p.distance(a + (b - a) * along) <= radius
    }

    fn drawn(lines: &[[[f64; 2]; 2]], radius: f64) -> Mask {
        Mask::new(120, 120, |x, y| {
            let p = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
            lines.iter().any(|&line| near(p, line, radius))
        })
    }

    #[test]
    fn letters_and_ladders_have_the_nodes_and_loops_that_they_show() {
        let bars = |at: &[f64]| -> Vec<[[f64; 2]; 2]> {
            at.iter().map(|&y| [[30.0, y], [90.0, y]]).collect()
        };
        let posts = [[[30.0, 10.0], [30.0, 110.0]], [[90.0, 10.0], [90.0, 110.0]]];
        let letter_h = [&posts[..], &bars(&[60.0])].concat();
        let ladder = [&posts[..], &bars(&[20.0, 40.0, 60.0, 80.0, 100.0])].concat();
        let cross = [[[60.0, 10.0], [60.0, 110.0]], [[10.0, 60.0], [110.0, 60.0]]];
        for radius in [1.5, 2.0, 3.3] {
            for (lines, junctions, ends, circles) in [
                (&letter_h[..], 2, 4, 0),
                (&ladder[..], 10, 4, 4),
                (&cross[..], 1, 4, 0),
            ] {
                let (thin, graph) = traced(&drawn(lines, radius));
                let degrees = degrees(&graph);
                let more = degrees.iter().filter(|&&degree| degree > 2).count();
                let ones = degrees.iter().filter(|&&degree| degree == 1).count();
                assert_eq!((more, ones), (junctions, ends), "radius {radius}");
                assert_eq!(loops(&graph), circles);
                assert_eq!(topology(&thin), (1, circles));
            }
        }
    }

    #[test]
    fn a_ring_stays_a_ring_and_a_disc_is_no_line() {
        let ring = Mask::new(80, 80, |x, y| {
            let far = DVec2::new(x as f64 - 40.0, y as f64 - 40.0).length();
            (20.0..27.0).contains(&far)
        });
        let (thin, graph) = traced(&ring);
        assert_eq!(topology(&thin), (1, 1));
        assert_eq!((graph.chains.len(), loops(&graph)), (1, 1));
        let disc = Mask::new(80, 80, |x, y| {
            DVec2::new(x as f64 - 40.0, y as f64 - 40.0).length() < 27.0
        });
        let (thin, graph) = traced(&disc);
        assert_eq!(topology(&thin), (1, 0));
        assert_eq!(graph.chains.len(), 0, "a disc is no line");
    }

    proptest! {
        #![proptest_config(properties::fixed(64))]
        #[test]
        fn parts_and_holes_stay_and_each_hole_is_a_loop_of_the_graph(
            seeds in proptest::collection::vec((0.0..64.0, 0.0..64.0, 0.0..64.0, 0.0..64.0), 1..14),
            radius in 0.8..4.0,
        ) {
            let mut set = Mask::new(64, 64, |x, y| {
                let p = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
                seeds.iter().any(|&(a, b, c, d)| near(p, [[a, b], [c, d]], radius))
            });
            flip_small(&mut set, false, 8);
            let (thin, graph) = traced(&set);
            prop_assert_eq!(topology(&set), topology(&thin));
            prop_assert_eq!(loops(&graph), topology(&set).1);
        }
    }
}
