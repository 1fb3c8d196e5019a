//! The major veins as edges for the mesh: chains resampled at the mesh's edge lengths, clipped and
//! welded.
//!
//! A grown network has nodes far closer together than a mesh needs, junctions at all angles, and
//! veins close to the margin. Unchanged, it would force sliver triangles. So chains are resampled
//! at the target edge length, points that would be too close together are welded into one, and
//! veins end shortly before the margin.

use std::collections::BTreeMap;

use glam::DVec2;

use super::size_field::SizeField;
use crate::shape::outline::Outline;
use crate::venation::network::VeinSegment;

/// Points closer than this share of the target length become one.
const WELD: f64 = 0.6;
/// An edge that passes a point closer than this share of the target length goes through it.
const PASS: f64 = 0.35;
/// Veins keep this share of the target length away from the margin.
const CLEARANCE: f64 = 0.6;

/// Points and edges that the mesh must have along veins.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Skeleton {
    /// Places, no two of them close.
    pub(super) points: Vec<DVec2>,
    /// Pairs of points, lower number first, each pair once. Edges may still cross; the mesh then
    /// uses the first one.
    pub(super) edges: Vec<[u32; 2]>,
}

impl Skeleton {
    /// The skeleton of these veins inside `outline`. Where veins conflict, the thicker one keeps
    /// its course.
    pub(super) fn new(outline: &Outline, size: &SizeField, veins: &[VeinSegment]) -> Self {
        let graph = Graph::new(outline, size, veins);
        let mut welder = Welder::new(size.longest());
        let mut edges = Vec::new();
        for chain in graph.chains() {
            let mut last = None;
            for p in resampled(&chain.points, size) {
                let target = size.at(p);
                let here = (outline.contains(p)
                    && outline.distance_to_margin(p) >= CLEARANCE * target)
                    .then(|| welder.weld(p, WELD * target));
                if let (Some(a), Some(b)) = (last, here)
                    && a != b
                {
                    edges.push([u32::min(a, b), u32::max(a, b)]);
                }
                last = here;
            }
        }
        let edges = through_points(&welder, edges, size);
        Self {
            points: welder.points,
            edges,
        }
    }
}

/// Replaces each edge that passes close by a point with two that meet there; drops repeated ones.
fn through_points(welder: &Welder, edges: Vec<[u32; 2]>, size: &SizeField) -> Vec<[u32; 2]> {
    let mut seen = std::collections::BTreeSet::new();
    let mut result = Vec::new();
    for [a, b] in edges {
        let (pa, pb) = (welder.points[a as usize], welder.points[b as usize]);
        let middle = pa.midpoint(pb);
        let near = PASS * size.at(middle);
        let between = welder
            .around(middle, 0.5 * pa.distance(pb) + near)
            .filter(|&c| c != a && c != b)
            .map(|c| (c, distance_inside(pa, pb, welder.points[c as usize])))
            .filter(|&(_, distance)| distance < near)
            .min_by(|x, y| x.1.total_cmp(&y.1).then(x.0.cmp(&y.0)));
        let pieces = match between {
            Some((c, _)) => vec![[a, c], [c, b]],
            None => vec![[a, b]],
        };
        for [a, b] in pieces {
            let edge = [a.min(b), a.max(b)];
            if seen.insert(edge) {
                result.push(edge);
            }
        }
    }
    result
}

/// Distance of `p` from the segment if its foot lies between the ends, else infinity.
fn distance_inside(a: DVec2, b: DVec2, p: DVec2) -> f64 {
    let along = b - a;
    let share = (p - a).dot(along) / along.length_squared();
    if share > 0.0 && share < 1.0 {
        (a + along * share).distance(p)
    } else {
        f64::INFINITY
    }
}

/// Points with a grid over them; a new point near an old one becomes the old one.
struct Welder {
    cell: f64,
    cells: BTreeMap<(i64, i64), Vec<u32>>,
    points: Vec<DVec2>,
}

impl Welder {
    fn new(cell: f64) -> Self {
        Self {
            cell,
            cells: BTreeMap::new(),
            points: Vec::new(),
        }
    }

    fn cell_of(&self, p: DVec2) -> (i64, i64) {
        let cell = (p / self.cell).floor();
        (cell.x as i64, cell.y as i64)
    }

    /// The points within `radius` of `p`.
    fn around(&self, p: DVec2, radius: f64) -> impl Iterator<Item = u32> + '_ {
        let (low, high) = (self.cell_of(p - radius), self.cell_of(p + radius));
        (low.0..=high.0)
            .flat_map(move |x| (low.1..=high.1).map(move |y| (x, y)))
            .filter_map(|cell| self.cells.get(&cell))
            .flatten()
            .copied()
            .filter(move |&i| self.points[i as usize].distance(p) <= radius)
    }

    fn weld(&mut self, p: DVec2, radius: f64) -> u32 {
        let distance = |i: u32| self.points[i as usize].distance_squared(p);
        let nearest = self
            .around(p, radius)
            .min_by(|&a, &b| distance(a).total_cmp(&distance(b)).then(a.cmp(&b)));
        nearest.unwrap_or_else(|| {
            let index = self.points.len() as u32;
            self.cells.entry(self.cell_of(p)).or_default().push(index);
            self.points.push(p);
            index
        })
    }
}

/// Points along a polyline at its target lengths, both ends included.
fn resampled(points: &[DVec2], size: &SizeField) -> Vec<DVec2> {
    // Arc length in units of the target, so that equal steps are edges of the right length
    // everywhere.
    let mut measure = vec![0.0];
    for pair in points.windows(2) {
        let target = size.at(pair[0].midpoint(pair[1]));
        measure.push(measure[measure.len() - 1] + pair[0].distance(pair[1]) / target);
    }
    let total = measure[measure.len() - 1];
    let pieces = total.round().max(1.0) as usize;
    let mut result = vec![points[0]];
    let mut segment = 0;
    for piece in 1..pieces {
        let wanted = total * piece as f64 / pieces as f64;
        while measure[segment + 1] < wanted {
            segment += 1;
        }
        let share = (wanted - measure[segment]) / (measure[segment + 1] - measure[segment]);
        result.push(points[segment].lerp(points[segment + 1], share));
    }
    result.push(points[points.len() - 1]);
    result
}

/// A vein from one junction or end to the next.
struct Chain {
    points: Vec<DVec2>,
    radius: f64,
}

/// The clipped veins, by node.
struct Graph {
    positions: Vec<DVec2>,
    edges: Vec<([u32; 2], f64)>,
    /// Numbers of the edges at each node.
    at: Vec<Vec<u32>>,
}

impl Graph {
    fn new(outline: &Outline, size: &SizeField, veins: &[VeinSegment]) -> Self {
        let mut graph = Self {
            positions: Vec::new(),
            edges: Vec::new(),
            at: Vec::new(),
        };
        // Ends of segments with the same bits are the same node, since they come from one network.
        let mut numbers = BTreeMap::new();
        let mut clear = Vec::new();
        for vein in veins {
            let [from, to] = [vein.from, vein.to].map(|p| {
                *numbers
                    .entry((p.x.to_bits(), p.y.to_bits()))
                    .or_insert_with(|| {
                        let inside = outline.contains(p)
                            && outline.distance_to_margin(p) >= CLEARANCE * size.at(p);
                        clear.push(inside);
                        graph.positions.push(p);
                        graph.at.push(Vec::new());
                        graph.positions.len() as u32 - 1
                    })
            });
            if from != to && clear[from as usize] && clear[to as usize] {
                let index = graph.edges.len() as u32;
                graph
                    .edges
                    .push(([from, to], vein.radius_from.max(vein.radius_to)));
                graph.at[from as usize].push(index);
                graph.at[to as usize].push(index);
            }
        }
        graph
    }

    /// Every edge once, in chains between nodes where other than two edges meet; thickest chain
    /// first.
    fn chains(&self) -> Vec<Chain> {
        let mut used = vec![false; self.edges.len()];
        let mut chains = Vec::new();
        let ends = (0..self.at.len() as u32).filter(|&n| self.at[n as usize].len() != 2);
        // After all chains with ends only closed loops remain, which may start anywhere.
        for start in ends.chain(0..self.at.len() as u32) {
            for &edge in &self.at[start as usize] {
                if !used[edge as usize] {
                    chains.push(self.follow(start, edge, &mut used));
                }
            }
        }
        chains.sort_by(|a, b| b.radius.total_cmp(&a.radius));
        chains
    }

    fn follow(&self, start: u32, edge: u32, used: &mut [bool]) -> Chain {
        let (mut node, mut edge) = (start, edge);
        let mut points = vec![self.positions[start as usize]];
        let mut radius = 0.0_f64;
        loop {
            used[edge as usize] = true;
            let ([from, to], r) = self.edges[edge as usize];
            radius = radius.max(r);
            node = if node == from { to } else { from };
            points.push(self.positions[node as usize]);
            let onward = &self.at[node as usize];
            let next = onward.iter().find(|&&next| !used[next as usize]);
            match next {
                Some(&next) if onward.len() == 2 => edge = next,
                _ => return Chain { points, radius },
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::blade::tests::{ellipse, flat, herringbone};

    #[test]
    fn points_lie_apart_and_clear_of_the_margin() {
        let outline = ellipse(20.0, 60.0, 90);
        let veins = herringbone(60.0, 9, 0.5);
        let size = SizeField::new(&flat(), &veins);
        let skeleton = Skeleton::new(&outline, &size, &veins);
        assert!(skeleton.edges.len() > 60, "{}", skeleton.edges.len());
        for (i, p) in skeleton.points.iter().enumerate() {
            let target = size.at(*p);
            assert!(outline.contains(*p));
            assert!(outline.distance_to_margin(*p) >= CLEARANCE * target);
            for q in &skeleton.points[..i] {
                assert!(p.distance(*q) > WELD * target);
            }
        }
    }

    #[test]
    fn every_edge_joins_two_points_once() {
        let outline = ellipse(20.0, 60.0, 90);
        let veins = herringbone(60.0, 9, 0.5);
        let size = SizeField::new(&flat(), &veins);
        let Skeleton { points, mut edges } = Skeleton::new(&outline, &size, &veins);
        assert!(
            edges
                .iter()
                .all(|e| e[0] < e[1] && (e[1] as usize) < points.len())
        );
        let count = edges.len();
        edges.sort_unstable();
        edges.dedup();
        assert_eq!(edges.len(), count);
    }

    #[test]
    fn a_closed_loop_is_a_chain_too() {
        let corner = |i: usize| {
            let angle = std::f64::consts::TAU * (i % 12) as f64 / 12.0;
            DVec2::new(4.0 * libm::cos(angle), 30.0 + 4.0 * libm::sin(angle))
        };
        let ring: Vec<VeinSegment> = (0..12)
            .map(|i| VeinSegment {
                from: corner(i),
                to: corner(i + 1),
                radius_from: 0.2,
                radius_to: 0.2,
                order: 3,
            })
            .collect();
        let size = SizeField::new(&flat(), &ring);
        let skeleton = Skeleton::new(&ellipse(20.0, 60.0, 90), &size, &ring);
        assert_eq!(skeleton.points.len(), skeleton.edges.len());
        assert!(skeleton.edges.len() > 12);
    }
}
