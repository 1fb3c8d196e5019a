//! A quadtree of points that grows with the veins.
//!
//! Vein nodes crowd along lines and leave the rest empty. That suits a tree better than a regular
//! grid. Points are added one by one and can be removed; cells split when they overflow.
//!
//! A cell is a single number, its place follows from the path to it, and empty cells have no
//! bucket. So the tree of a million points, without the points themselves, fits into the caches.

use std::ops::ControlFlow;

use glam::DVec2;

use super::probe::{Probe, SLACK};
use crate::plane::rectangle_distance_squared;

/// Greatest number of points in a cell before it splits.
const CAPACITY: usize = 16;

/// Depth at which cells no longer split, since points that near count as coincident.
const MAX_DEPTH: u32 = 40;

/// No bucket.
const NONE: u32 = u32::MAX;

/// Flag that marks a number as that of a cell's first child instead of its bucket.
const BRANCH: u32 = 1 << 31;

/// The points of a leaf, or some of them.
#[derive(Clone, Debug)]
struct Bucket {
    positions: [DVec2; CAPACITY],
    ids: [u32; CAPACITY],
    len: u32,
    /// The bucket with more points of the same leaf, which only the deepest leaves have, or
    /// [`NONE`].
    next: u32,
}

impl Bucket {
    const EMPTY: Self = Self {
        positions: [DVec2::ZERO; CAPACITY],
        ids: [0; CAPACITY],
        len: 0,
        next: NONE,
    };

    fn is_full(&self) -> bool {
        self.len as usize == CAPACITY
    }

    fn push(&mut self, id: u32, position: DVec2) {
        self.positions[self.len as usize] = position;
        self.ids[self.len as usize] = id;
        self.len += 1;
    }

    fn points(&self) -> impl Iterator<Item = (u32, DVec2)> + '_ {
        let len = self.len as usize;
        let ids = self.ids[..len].iter().copied();
        ids.zip(self.positions[..len].iter().copied())
    }
}

/// The square of a cell of the tree.
#[derive(Clone, Copy, Debug)]
struct Square {
    centre: DVec2,
    half: f64,
}

impl Square {
    /// Which quarter a point belongs to, in the order −−, +−, −+, ++ of x and y.
    fn quadrant(self, p: DVec2) -> u32 {
        u32::from(p.x >= self.centre.x) | (u32::from(p.y >= self.centre.y) << 1)
    }

    fn quarter(self, quadrant: u32) -> Self {
        let half = self.half * 0.5;
        let side = |bit: u32| if quadrant & bit == 0 { -half } else { half };
        Self {
            centre: self.centre + DVec2::new(side(1), side(2)),
            half,
        }
    }
}

/// A quadtree over a rectangle that must hold every point that will be inserted.
#[derive(Clone, Debug)]
pub(crate) struct PointTree {
    low: DVec2,
    high: DVec2,
    root: Square,
    /// The number of the first of four children with the mark [`BRANCH`], or that of a bucket, or
    /// [`NONE`].
    cells: Vec<u32>,
    buckets: Vec<Bucket>,
}

impl PointTree {
    /// An empty tree over the rectangle from `low` to `high`.
    pub(crate) fn new(low: DVec2, high: DVec2) -> Self {
        Self {
            low,
            high,
            root: Square {
                centre: (low + high) * 0.5,
                half: (high - low).max_element() * 0.5,
            },
            cells: vec![NONE],
            buckets: Vec::new(),
        }
    }

    /// Lower left and upper right corner of the rectangle that holds every point.
    pub(crate) fn bounds(&self) -> (DVec2, DVec2) {
        (self.low, self.high)
    }

    /// Number, square and depth of the leaf that holds `p`.
    fn leaf(&self, p: DVec2) -> (usize, Square, u32) {
        let (mut at, mut square, mut depth) = (0, self.root, 0);
        while let Some(first) = children(self.cells[at]) {
            let quadrant = square.quadrant(p);
            at = (first + quadrant) as usize;
            square = square.quarter(quadrant);
            depth += 1;
        }
        (at, square, depth)
    }

    /// Adds a point, which must lie in the rectangle, since searches rely on that.
    pub(crate) fn insert(&mut self, id: u32, position: DVec2) {
        let (mut at, mut square, mut depth) = self.leaf(position);
        loop {
            let number = self.cells[at];
            match self.buckets.get_mut(number as usize) {
                Some(bucket) if !bucket.is_full() => return bucket.push(id, position),
                Some(_) if depth < MAX_DEPTH => {
                    let quadrant = square.quadrant(position);
                    at = (self.split(at, square) + quadrant) as usize;
                    square = square.quarter(quadrant);
                    depth += 1;
                }
                // The leaf is empty, or at the greatest depth, where buckets are chained.
                _ => {
                    self.cells[at] = self.add_bucket(number);
                }
            }
        }
    }

    fn add_bucket(&mut self, next: u32) -> u32 {
        let number = self.buckets.len() as u32;
        self.buckets.push(Bucket {
            next,
            ..Bucket::EMPTY
        });
        number
    }

    /// Turns a leaf with one bucket into a branch; returns the first child.
    fn split(&mut self, at: usize, square: Square) -> u32 {
        let first = self.cells.len() as u32;
        let number = std::mem::replace(&mut self.cells[at], first | BRANCH);
        let old = std::mem::replace(&mut self.buckets[number as usize], Bucket::EMPTY);
        let mut children = [NONE; 4];
        // The bucket goes to the first child that needs one.
        let mut free = Some(number);
        for (id, position) in old.points() {
            let child = &mut children[square.quadrant(position) as usize];
            if *child == NONE {
                *child = free.take().unwrap_or_else(|| self.add_bucket(NONE));
            }
            self.buckets[*child as usize].push(id, position);
        }
        self.cells.extend(children);
        first
    }

    /// Removes a point. Does nothing if it is not in the tree.
    pub(crate) fn remove(&mut self, id: u32, position: DVec2) {
        let (at, ..) = self.leaf(position);
        let mut number = self.cells[at];
        while let Some(bucket) = self.buckets.get_mut(number as usize) {
            let len = bucket.len as usize;
            if let Some(i) = bucket.ids[..len].iter().position(|&other| other == id) {
                bucket.ids[i] = bucket.ids[len - 1];
                bucket.positions[i] = bucket.positions[len - 1];
                bucket.len -= 1;
                return;
            }
            number = bucket.next;
        }
    }

    /// Passes to `probe` the points in all cells that it enters, those around `p` first.
    pub(crate) fn visit(&self, p: DVec2, probe: &mut impl Probe) -> ControlFlow<()> {
        self.visit_cell(self.cells[0], self.root, p, probe)
    }

    /// The same for a probe that only needs points between the corners `low` and `high`: starts at
    /// the smallest cell that holds that rectangle.
    pub(crate) fn visit_within(
        &self,
        low: DVec2,
        high: DVec2,
        p: DVec2,
        probe: &mut impl Probe,
    ) -> ControlFlow<()> {
        // Far above the rounding of coordinates.
        let slack = DVec2::splat(1e-12 * self.root.half);
        let (low, high) = (low - slack, high + slack);
        let (mut cell, mut square) = (self.cells[0], self.root);
        while let Some(first) = children(cell) {
            let quadrant = square.quadrant(low);
            if square.quadrant(high) != quadrant {
                break;
            }
            cell = self.cells[(first + quadrant) as usize];
            square = square.quarter(quadrant);
        }
        self.visit_cell(cell, square, p, probe)
    }

    fn visit_cell(
        &self,
        cell: u32,
        square: Square,
        p: DVec2,
        probe: &mut impl Probe,
    ) -> ControlFlow<()> {
        if let Some(first) = children(cell) {
            let home = square.quadrant(p);
            for i in 0..4 {
                let child = self.cells[(first + (home ^ i)) as usize];
                if child == NONE {
                    continue;
                }
                let square = square.quarter(home ^ i);
                let half = DVec2::splat(square.half);
                if probe.enters(square.centre - half, square.centre + half) {
                    self.visit_cell(child, square, p, probe)?;
                }
            }
            return ControlFlow::Continue(());
        }
        let mut number = cell;
        while let Some(bucket) = self.buckets.get(number as usize) {
            for (id, position) in bucket.points() {
                probe.meet(id, position)?;
            }
            number = bucket.next;
        }
        ControlFlow::Continue(())
    }

    /// Whether a point lies at `radius` from `p` or nearer.
    pub(crate) fn any_within(&self, p: DVec2, radius: f64) -> bool {
        let reach = DVec2::splat(radius);
        let mut circle = Within {
            p,
            radius_squared: radius * radius,
        };
        self.visit_within(p - reach, p + reach, p, &mut circle)
            .is_break()
    }

    /// Whether a point other than number `except` lies within a distance, given by its square, of
    /// both `p` and `q`.
    pub(crate) fn any_near_both(&self, p: DVec2, q: DVec2, squared: f64, except: u32) -> bool {
        let mut lune = Lune {
            ends: [p, q],
            squared,
            except,
        };
        let reach = DVec2::splat(squared.sqrt());
        let (low, high) = (p.max(q) - reach, p.min(q) + reach);
        self.visit_within(low, high, q, &mut lune).is_break()
    }
}

/// The first of the four children if the cell is a branch.
fn children(cell: u32) -> Option<u32> {
    (cell & BRANCH != 0 && cell != NONE).then_some(cell & !BRANCH)
}

/// Searches any point in a circle.
struct Within {
    p: DVec2,
    radius_squared: f64,
}

impl Probe for Within {
    fn enters(&self, low: DVec2, high: DVec2) -> bool {
        rectangle_distance_squared(low, high, self.p) <= self.radius_squared * SLACK
    }

    fn meet(&mut self, _id: u32, position: DVec2) -> ControlFlow<()> {
        if (position - self.p).length_squared() <= self.radius_squared {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }
}

/// Searches any point in the intersection of two circles.
struct Lune {
    ends: [DVec2; 2],
    squared: f64,
    except: u32,
}

impl Probe for Lune {
    fn enters(&self, low: DVec2, high: DVec2) -> bool {
        let reach = self.squared * SLACK;
        let [p, q] = self.ends;
        rectangle_distance_squared(low, high, p) <= reach
            && rectangle_distance_squared(low, high, q) <= reach
    }

    fn meet(&mut self, id: u32, position: DVec2) -> ControlFlow<()> {
        let near = |p: DVec2| (position - p).length_squared() <= self.squared;
        if near(self.ends[0]) && near(self.ends[1]) && id != self.except {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use properties::fixed;

    /// Collects every point.
    struct All(Vec<u32>);

    impl Probe for All {
        fn enters(&self, _low: DVec2, _high: DVec2) -> bool {
            true
        }

        fn meet(&mut self, id: u32, _position: DVec2) -> ControlFlow<()> {
            self.0.push(id);
            ControlFlow::Continue(())
        }
    }

    #[test]
    fn any_number_of_points_fits_in_one_place() {
        let (low, high) = (DVec2::ZERO, DVec2::splat(10.0));
        let mut tree = PointTree::new(low, high);
        let p = DVec2::new(3.1, 4.1);
        for id in 0..100 {
            tree.insert(id, p);
        }
        tree.insert(100, DVec2::new(3.1, 4.2));
        for id in (0..100).filter(|id| id % 7 != 0) {
            tree.remove(id, p);
        }
        let mut met = All(Vec::new());
        assert!(tree.visit(p, &mut met).is_continue());
        met.0.sort_unstable();
        assert!(met.0.iter().copied().eq((0..=98).step_by(7).chain([100])));
    }

    proptest! {
        #![proptest_config(fixed(256))]

        #[test]
        fn a_tree_answers_as_a_list_does(
            points in proptest::collection::vec((0.0..10.0, 0.0..10.0), 1..300),
            gone in proptest::collection::vec(0_usize..300, 0..80),
            x in -2.0..12.0, y in -2.0..12.0, radius in 0.0..4.0,
        ) {
            let mut tree = PointTree::new(DVec2::ZERO, DVec2::splat(10.0));
            let mut list: Vec<(u32, DVec2)> = Vec::new();
            for (id, &(px, py)) in points.iter().enumerate() {
                // Some coordinates are integers, so that points lie on cell borders and coincide.
                let p = DVec2::new(px, py);
                let p = if id % 3 == 0 { p.floor() } else { p };
                tree.insert(id as u32, p);
                list.push((id as u32, p));
            }
            for id in gone {
                if let Some(&(_, p)) = list.iter().find(|(other, _)| *other == id as u32) {
                    tree.remove(id as u32, p);
                }
                list.retain(|&(other, _)| other != id as u32);
            }
            let p = DVec2::new(x, y);
            let near = list.iter().any(|(_, q)| (*q - p).length_squared() <= radius * radius);
            prop_assert_eq!(tree.any_within(p, radius), near);
            let other = DVec2::new(y, x);
            let squared = |q: DVec2| (q - p).length_squared().max((q - other).length_squared());
            let both = list.iter().any(|(id, q)| *id != 3 && squared(*q) <= radius);
            prop_assert_eq!(tree.any_near_both(p, other, radius, 3), both);
            let mut met = All(Vec::new());
            prop_assert!(tree.visit(p, &mut met).is_continue());
            met.0.sort_unstable();
            let mut all: Vec<u32> = list.iter().map(|&(id, _)| id).collect();
            all.sort_unstable();
            prop_assert_eq!(met.0, all);
        }
    }
}
