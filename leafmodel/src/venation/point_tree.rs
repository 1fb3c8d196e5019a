//! Points by place: a quadtree that grows while veins do.
//!
//! Veins crowd along lines and leave the rest empty, which a regular grid serves badly; a tree
//! follows them. Points are added one by one and can be removed; cells split when they overflow.

use glam::DVec2;

use super::probe::Probe;

/// Points a cell holds before it splits.
const CAPACITY: usize = 8;

/// Depth at which cells no longer split: points that near are as good as one.
const MAX_DEPTH: u32 = 40;

/// A point and the number it goes by.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Entry {
    /// Where it is.
    pub(crate) position: DVec2,
    /// Its number in the caller's list.
    pub(crate) id: u32,
}

/// A square of the tree.
#[derive(Clone, Debug)]
struct Cell {
    centre: DVec2,
    half: f64,
    content: Content,
}

#[derive(Clone, Debug)]
enum Content {
    /// Number of the first of four children, in the order −−, +−, −+, ++ of x and y.
    Branch(u32),
    Leaf(Vec<Entry>),
}

/// What a cell holds, for traversals of their own kind.
pub(crate) enum View<'a> {
    /// Numbers of the four children.
    Branch([u32; 4]),
    /// The points themselves.
    Leaf(&'a [Entry]),
}

/// A quadtree over a square that holds every point it will ever get.
#[derive(Clone, Debug)]
pub(crate) struct PointTree {
    low: DVec2,
    high: DVec2,
    cells: Vec<Cell>,
}

impl PointTree {
    /// Number of the cell that holds all others.
    pub(crate) const ROOT: u32 = 0;

    /// An empty tree over the rectangle from `low` to `high`.
    pub(crate) fn new(low: DVec2, high: DVec2) -> Self {
        let root = Cell {
            centre: (low + high) * 0.5,
            half: (high - low).max_element() * 0.5,
            content: Content::Leaf(Vec::new()),
        };
        Self {
            low,
            high,
            cells: vec![root],
        }
    }

    /// Lower left and upper right corner of the rectangle that holds every point.
    pub(crate) fn bounds(&self) -> (DVec2, DVec2) {
        (self.low, self.high)
    }

    /// Adds a point, which must lie in the tree's square.
    pub(crate) fn insert(&mut self, id: u32, position: DVec2) {
        let mut at = Self::ROOT as usize;
        let mut depth = 0;
        loop {
            let first = match &mut self.cells[at].content {
                Content::Branch(first) => *first,
                Content::Leaf(entries) => {
                    if entries.len() < CAPACITY || depth >= MAX_DEPTH {
                        entries.push(Entry { position, id });
                        return;
                    }
                    self.split(at)
                }
            };
            at = (first + quadrant(self.cells[at].centre, position)) as usize;
            depth += 1;
        }
    }

    /// Turns a leaf into a branch, its points into those of its children; gives the first child.
    fn split(&mut self, at: usize) -> u32 {
        let first = self.cells.len() as u32;
        let Cell { centre, half, .. } = self.cells[at];
        let old = std::mem::replace(&mut self.cells[at].content, Content::Branch(first));
        let quarter = half * 0.5;
        let mut leaves: [Vec<Entry>; 4] = std::array::from_fn(|_| Vec::with_capacity(CAPACITY));
        if let Content::Leaf(entries) = old {
            for entry in entries {
                leaves[quadrant(centre, entry.position) as usize].push(entry);
            }
        }
        for (i, entries) in leaves.into_iter().enumerate() {
            let side = |bit: usize| if i & bit == 0 { -quarter } else { quarter };
            self.cells.push(Cell {
                centre: centre + DVec2::new(side(1), side(2)),
                half: quarter,
                content: Content::Leaf(entries),
            });
        }
        first
    }

    /// Takes a point out again. Nothing happens if it is not there.
    pub(crate) fn remove(&mut self, id: u32, position: DVec2) {
        let mut at = Self::ROOT as usize;
        loop {
            match &mut self.cells[at].content {
                Content::Branch(first) => {
                    let first = *first;
                    at = (first + quadrant(self.cells[at].centre, position)) as usize;
                }
                Content::Leaf(entries) => {
                    if let Some(i) = entries.iter().position(|entry| entry.id == id) {
                        entries.swap_remove(i);
                    }
                    return;
                }
            }
        }
    }

    /// What a cell holds.
    pub(crate) fn view(&self, cell: u32) -> View<'_> {
        match &self.cells[cell as usize].content {
            Content::Branch(first) => View::Branch([*first, first + 1, first + 2, first + 3]),
            Content::Leaf(entries) => View::Leaf(entries),
        }
    }

    /// Squared distance from `p` to a cell, 0 inside.
    pub(crate) fn distance_squared(&self, cell: u32, p: DVec2) -> f64 {
        let cell = &self.cells[cell as usize];
        ((p - cell.centre).abs() - DVec2::splat(cell.half))
            .max(DVec2::ZERO)
            .length_squared()
    }

    /// Shows the points to `probe`, those about `p` first, as far as it enters their cells.
    pub(crate) fn visit(&self, p: DVec2, probe: &mut impl Probe) {
        self.visit_below(Self::ROOT, p, probe);
    }

    fn visit_below(&self, number: u32, p: DVec2, probe: &mut impl Probe) {
        let cell = &self.cells[number as usize];
        match self.view(number) {
            View::Branch(children) => {
                let half = DVec2::splat(cell.half);
                if probe.enters(cell.centre - half, cell.centre + half) {
                    let home = quadrant(cell.centre, p);
                    for i in 0..4 {
                        self.visit_below(children[(home ^ i) as usize], p, probe);
                    }
                }
            }
            View::Leaf(entries) => {
                for entry in entries {
                    probe.meet(entry.id, entry.position);
                }
            }
        }
    }

    /// Whether a point lies at `radius` from `p` or nearer.
    pub(crate) fn any_within(&self, p: DVec2, radius: f64) -> bool {
        self.any_within_below(Self::ROOT, p, radius * radius)
    }

    fn any_within_below(&self, cell: u32, p: DVec2, radius_squared: f64) -> bool {
        if self.distance_squared(cell, p) > radius_squared * (1.0 + 1e-9) {
            return false;
        }
        match self.view(cell) {
            View::Branch(children) => {
                // The quadrant of p first: it is the likeliest to have a near point.
                let home = quadrant(self.cells[cell as usize].centre, p);
                (0..4).any(|i| {
                    self.any_within_below(children[(home ^ i) as usize], p, radius_squared)
                })
            }
            View::Leaf(entries) => entries
                .iter()
                .any(|entry| (entry.position - p).length_squared() <= radius_squared),
        }
    }

    /// Whether a point other than number `except` lies as near as this, or nearer, both to `p` and to `q`.
    pub(crate) fn any_near_both(
        &self,
        p: DVec2,
        q: DVec2,
        distance_squared: f64,
        except: u32,
    ) -> bool {
        self.any_near_both_below(Self::ROOT, p, q, distance_squared, except)
    }

    fn any_near_both_below(
        &self,
        cell: u32,
        p: DVec2,
        q: DVec2,
        distance_squared: f64,
        except: u32,
    ) -> bool {
        let reach = distance_squared * (1.0 + 1e-9);
        if self.distance_squared(cell, p) > reach || self.distance_squared(cell, q) > reach {
            return false;
        }
        match self.view(cell) {
            View::Branch(children) => {
                let home = quadrant(self.cells[cell as usize].centre, q);
                (0..4).any(|i| {
                    self.any_near_both_below(
                        children[(home ^ i) as usize],
                        p,
                        q,
                        distance_squared,
                        except,
                    )
                })
            }
            View::Leaf(entries) => entries.iter().any(|entry| {
                (entry.position - p).length_squared() <= distance_squared
                    && (entry.position - q).length_squared() <= distance_squared
                    && entry.id != except
            }),
        }
    }

    /// Calls `visit` with points in such an order that all nearer than the distance it last
    /// returned (squared) are met. Serves nearest-point queries with ties of any rule.
    pub(crate) fn approach(&self, p: DVec2, mut visit: impl FnMut(&Entry) -> f64) {
        let mut best = f64::INFINITY;
        self.approach_below(Self::ROOT, p, &mut best, &mut visit);
    }

    fn approach_below(
        &self,
        cell: u32,
        p: DVec2,
        best: &mut f64,
        visit: &mut impl FnMut(&Entry) -> f64,
    ) {
        if self.distance_squared(cell, p) > *best * (1.0 + 1e-9) {
            return;
        }
        match self.view(cell) {
            View::Branch(children) => {
                let home = quadrant(self.cells[cell as usize].centre, p);
                for i in 0..4 {
                    self.approach_below(children[(home ^ i) as usize], p, best, visit);
                }
            }
            View::Leaf(entries) => {
                for entry in entries {
                    *best = visit(entry);
                }
            }
        }
    }
}

/// Which child of a cell about `centre` a point belongs to.
fn quadrant(centre: DVec2, p: DVec2) -> u32 {
    u32::from(p.x >= centre.x) | (u32::from(p.y >= centre.y) << 1)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use proptest::test_runner::RngSeed;

    use super::*;

    proptest! {
        #![proptest_config(ProptestConfig { rng_seed: RngSeed::Fixed(2005), failure_persistence: None, ..ProptestConfig::with_cases(256) })]

        #[test]
        fn a_tree_answers_as_a_list_does(
            points in proptest::collection::vec((0.0..10.0, 0.0..10.0), 1..300),
            gone in proptest::collection::vec(0_usize..300, 0..80),
            x in -2.0..12.0, y in -2.0..12.0, radius in 0.0..4.0,
        ) {
            let mut tree = PointTree::new(DVec2::ZERO, DVec2::splat(10.0));
            let mut list: Vec<(u32, DVec2)> = Vec::new();
            for (id, &(px, py)) in points.iter().enumerate() {
                // Whole numbers now and then, so that points meet cell walls and each other.
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
            let mut best = f64::INFINITY;
            tree.approach(p, |entry| {
                best = best.min((entry.position - p).length_squared());
                best
            });
            let nearest = list
                .iter()
                .map(|(_, q)| (*q - p).length_squared())
                .fold(f64::INFINITY, f64::min);
            prop_assert_eq!(best, nearest);
        }
    }
}
