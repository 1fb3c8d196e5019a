//! How far it is to the nearest of many segments, fast at millions of points.

use glam::DVec2;
use rayon::prelude::*;

use super::points::{bounds, rectangle_distance_squared};
use super::polygon;
use super::segment::Line;

/// Distances to segments.
///
/// A binary tree of boxes halves the segments at the median of their middles, along the longer side
/// of its box. A search goes into the nearer half first and leaves out boxes that are farther than
/// what has been found, so it finds the exact least distance.
#[derive(Clone, Debug)]
pub struct Distances {
    /// In the order of the tree's leaves.
    segments: Vec<[DVec2; 2]>,
    nodes: Vec<Node>,
}

/// A node. The first child comes next in the list.
#[derive(Clone, Copy, Debug)]
struct Node {
    low: DVec2,
    high: DVec2,
    /// Place of the second child; of a leaf, of its first segment.
    place: u32,
    /// Number of a leaf's segments; 0 for an inner node.
    count: u32,
}

/// The segments that matter to some points that lie together.
#[derive(Debug, Default)]
struct Near {
    lines: Vec<Line>,
    /// Number of the segment that was the nearest of the points before. A search that begins with it
    /// leaves out nearly all boxes.
    nearest: u32,
    /// Room for a search: nodes that wait.
    waiting: Vec<u32>,
}

impl Near {
    /// Distance of a point to the nearest of the segments.
    fn distance(&self, p: DVec2) -> f64 {
        let squares = self.lines.iter().map(|line| line.distance_squared(p));
        squares.fold(f64::INFINITY, f64::min).sqrt()
    }
}

/// Points of a grid along a side of the squares that share a search.
const TILE: usize = 4;
/// Most segments of a leaf.
const SHORT: usize = 4;
/// Boxes are left out only if they are farther than what has been found by this share, so that
/// rounding hides no segment.
const SPARE: f64 = 1e-9;
/// Levels of the tree for 2³² segments, halved until they are short.
const DEEPEST: usize = 32;

impl Node {
    /// Squared distance of a point to the box.
    fn distance_squared(&self, p: DVec2) -> f64 {
        rectangle_distance_squared(self.low, self.high, p)
    }
}

impl Distances {
    /// Builds the tree.
    #[inline]
    pub fn new(mut segments: Vec<[DVec2; 2]>) -> Self {
        let mut nodes = Vec::with_capacity(segments.len());
        if !segments.is_empty() {
            part(&mut nodes, &mut segments, 0);
        }
        Self { segments, nodes }
    }

    /// Distances to the sides of a closed polygon.
    #[inline]
    pub fn around(corners: &[DVec2]) -> Self {
        Self::new(polygon::sides(corners).map(<[DVec2; 2]>::from).collect())
    }

    /// Distance of a point (mm) to the nearest segment; infinite if there are none.
    #[inline]
    pub fn at(&self, p: DVec2) -> f64 {
        self.search(p, f64::INFINITY, &mut 0)
    }

    /// As [`Distances::at`], with the same bits, for the points `place([column, row])` of a grid of
    /// `[width, height]`, row by row, on all threads; infinite where a row's flags, `asked(row)`,
    /// do not ask for it. Much faster, since points that lie together share their search.
    #[inline]
    pub fn of_grid<'f>(
        &self,
        [width, height]: [usize; 2],
        place: impl Fn([usize; 2]) -> DVec2 + Sync,
        asked: impl Fn(usize) -> &'f [bool] + Sync,
    ) -> Vec<f64> {
        let mut away = vec![f64::INFINITY; width * height];
        let bands = away.par_chunks_mut(TILE * width).enumerate();
        bands.for_each(|(band, away)| {
            let (top, rows) = (band * TILE, away.len() / width);
            let mut near = Near::default();
            for left in (0..width).step_by(TILE) {
                let columns = left..(left + TILE).min(width);
                if !(top..top + rows).any(|row| asked(row)[columns.clone()].contains(&true)) {
                    continue;
                }
                let corners = [place([left, top]), place([columns.end - 1, top + rows - 1])];
                self.gather(corners, &mut near);
                for row in 0..rows {
                    for column in columns.clone().filter(|&column| asked(top + row)[column]) {
                        away[row * width + column] = near.distance(place([column, top + row]));
                    }
                }
            }
        });
        away
    }

    /// Collects the segments of which one is the nearest of any point in the box between two corners.
    fn gather(&self, corners: [DVec2; 2], near: &mut Near) {
        let centre = 0.5 * (corners[0] + corners[1]);
        let first = self.segments.get(near.nearest as usize);
        let best = first.map_or(f64::INFINITY, |&segment| {
            Line::new(segment).distance_squared(centre)
        });
        // A point is within half the diagonal of the centre, so the nearest segment of either is at
        // most that much nearer or farther than that of the other.
        let most = self.search(centre, best, &mut near.nearest) + corners[0].distance(corners[1]);
        let square = most * most * (1.0 + SPARE);
        near.lines.clear();
        near.waiting.clear();
        near.waiting.extend((!self.nodes.is_empty()).then_some(0));
        while let Some(place) = near.waiting.pop() {
            let node = &self.nodes[place as usize];
            if node.distance_squared(centre) > square {
                continue;
            }
            if node.count == 0 {
                near.waiting.extend([place + 1, node.place]);
                continue;
            }
            let of_leaf = &self.segments[node.place as usize..][..node.count as usize];
            let lines = of_leaf.iter().map(|&segment| Line::new(segment));
            near.lines
                .extend(lines.filter(|line| line.distance_squared(centre) <= square));
        }
    }

    /// The distance, where the segment with the number `nearest` has the squared distance `best`.
    fn search(&self, p: DVec2, mut best: f64, nearest: &mut u32) -> f64 {
        // What waits, with the squared distance of its box.
        let mut waiting = [(0.0, 0_u32); DEEPEST];
        let mut height = usize::from(!self.nodes.is_empty());
        while height > 0 {
            height -= 1;
            let (mut away, mut place) = waiting[height];
            while away <= best * (1.0 + SPARE) {
                let node = &self.nodes[place as usize];
                if node.count > 0 {
                    for number in node.place..node.place + node.count {
                        let square = Line::new(self.segments[number as usize]).distance_squared(p);
                        if square < best {
                            (best, *nearest) = (square, number);
                        }
                    }
                    break;
                }
                let (a, b) = (place + 1, node.place);
                let (to_a, to_b) = (
                    self.nodes[a as usize].distance_squared(p),
                    self.nodes[b as usize].distance_squared(p),
                );
                let (near, far) = if to_a <= to_b {
                    ((to_a, a), (to_b, b))
                } else {
                    ((to_b, b), (to_a, a))
                };
                if far.0 <= best * (1.0 + SPARE) {
                    waiting[height] = far;
                    height += 1;
                }
                (away, place) = near;
            }
        }
        best.sqrt()
    }
}

/// Adds the tree of these segments, whose first one has the number `first`.
fn part(nodes: &mut Vec<Node>, segments: &mut [[DVec2; 2]], first: usize) {
    let (low, high) = bounds(segments.iter().flatten().copied());
    let place = nodes.len();
    nodes.push(Node {
        low,
        high,
        place: first as u32,
        count: segments.len() as u32,
    });
    if segments.len() <= SHORT {
        return;
    }
    let axis = usize::from(high.x - low.x <= high.y - low.y);
    let key = |[from, to]: &[DVec2; 2]| from[axis] + to[axis];
    let half = segments.len() / 2;
    segments.select_nth_unstable_by(half, |a, b| key(a).total_cmp(&key(b)));
    let (left, right) = segments.split_at_mut(half);
    part(nodes, left, first);
    nodes[place].place = nodes.len() as u32;
    nodes[place].count = 0;
    part(nodes, right, first + half);
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use properties::fixed;

    fn exhaustive(segments: &[[DVec2; 2]], p: DVec2) -> f64 {
        let squares = segments
            .iter()
            .map(|&segment| Line::new(segment).distance_squared(p));
        squares.fold(f64::INFINITY, f64::min).sqrt()
    }

    proptest! {
        #![proptest_config(fixed(1000))]
        #[test]
        fn distances_are_those_of_a_search_over_all_segments(
            ends in prop::collection::vec((-10.0..10.0, 0.0..30.0, -3.0..3.0, -3.0..3.0), 1..40),
            points in prop::collection::vec((-15.0..15.0, -5.0..35.0), 50),
            texel in -3.0..0.7,
        ) {
            let segments: Vec<[DVec2; 2]> = ends.iter()
                .map(|&(x, y, dx, dy)| [DVec2::new(x, y), DVec2::new(x + dx, y + dy)]).collect();
            let field = Distances::new(segments.clone());
            for &(x, y) in &points {
                let p = DVec2::new(x, y);
                prop_assert_eq!(field.at(p), exhaustive(&segments, p));
            }
            // A grid whose last tiles are narrower and lower, without some of its points.
            let corner = DVec2::from(points[0]);
            let place = |[column, row]: [usize; 2]| {
                corner + libm::pow(10.0, texel) * DVec2::new(column as f64, row as f64)
            };
            let asked: Vec<bool> = (0..9 * 7).map(|i| i % 5 != 3 && i / 9 != 2).collect();
            let away = field.of_grid([9, 7], place, |row| &asked[9 * row..][..9]);
            for (i, &away) in away.iter().enumerate() {
                let p = place([i % 9, i / 9]);
                let expected = if asked[i] { exhaustive(&segments, p) } else { f64::INFINITY };
                prop_assert_eq!(away, expected);
            }
        }
    }

    #[test]
    fn segments_that_meet_in_one_point_are_all_kept() {
        let middle = DVec2::new(0.1, 15.0);
        let spokes = (0..64).map(|spoke| {
            [
                middle,
                middle + 12.0 * DVec2::from_angle(f64::from(spoke) * 0.1),
            ]
        });
        let spokes: Vec<_> = spokes.collect();
        let field = Distances::new(spokes.clone());
        for step in 0..100 {
            let p = middle + 1e-4 * DVec2::from_angle(f64::from(step));
            assert_eq!(field.at(p), exhaustive(&spokes, p));
        }
    }

    #[test]
    fn a_crowd_of_equal_segments_takes_two_nodes_for_each_few() {
        let crowd = vec![[DVec2::new(0.1, 15.0), DVec2::new(0.2, 15.0)]; 100_000];
        let field = Distances::new(crowd);
        assert!(field.nodes.len() <= 100_000);
        assert_eq!(field.at(DVec2::new(0.1, 11.0)), 4.0);
    }

    #[test]
    fn without_segments_everything_is_infinitely_far() {
        let none = Distances::new(Vec::new());
        assert_eq!(none.at(DVec2::ONE), f64::INFINITY);
        let away = none.of_grid([1, 1], |_| DVec2::ONE, |_| &[true]);
        assert_eq!(away, [f64::INFINITY]);
    }
}
