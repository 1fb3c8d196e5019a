//! Nodes added since sources were last updated.
//!
//! A source's neighbourhood changes only through new nodes near it. A step adds few nodes, so they
//! get a small tree of boxes, rebuilt each time.

use std::ops::ControlFlow;

use glam::DVec2;

use super::probe::Probe;
use crate::plane::bounds;

/// Greatest number of nodes in a box that is not divided.
const CAPACITY: usize = 6;

/// The nodes numbered from `first` on, in nested boxes.
pub(crate) struct FreshNodes<'a> {
    first: u32,
    positions: &'a [DVec2],
    /// Indices into `positions`, sorted so that each box holds a range of them.
    sorted: Vec<u32>,
    /// All boxes, each before those inside it.
    boxes: Vec<NodeBox>,
}

/// The smallest upright rectangle around some nodes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NodeBox {
    low: DVec2,
    high: DVec2,
    from: u32,
    to: u32,
    /// Number of the next box that is not inside this one.
    after: u32,
    is_divided: bool,
}

impl<'a> FreshNodes<'a> {
    /// The nodes of `positions` with numbers from `first` on.
    pub(crate) fn new(positions: &'a [DVec2], first: u32) -> Self {
        let positions = &positions[first as usize..];
        let mut fresh = Self {
            first,
            positions,
            sorted: (0..positions.len() as u32).collect(),
            boxes: Vec::with_capacity(positions.len() / 2),
        };
        if !positions.is_empty() {
            fresh.divide(0, positions.len());
        }
        fresh
    }

    /// Adds boxes for the nodes in a range of `sorted`, halved across the longer side until few
    /// nodes are left.
    fn divide(&mut self, from: usize, to: usize) {
        let positions = self.positions;
        let range = &mut self.sorted[from..to];
        let (low, high) = bounds(range.iter().map(|&i| positions[i as usize]));
        let number = self.boxes.len();
        let is_divided = to - from > CAPACITY;
        self.boxes.push(NodeBox {
            low,
            high,
            from: from as u32,
            to: to as u32,
            after: 0,
            is_divided,
        });
        if is_divided {
            let middle = (to - from) / 2;
            let size = high - low;
            let key = |i: u32| {
                let p = positions[i as usize];
                if size.x > size.y { p.x } else { p.y }
            };
            range
                .select_nth_unstable_by(middle, |&i, &j| key(i).total_cmp(&key(j)).then(i.cmp(&j)));
            self.divide(from, from + middle);
            self.divide(from + middle, to);
        }
        self.boxes[number].after = self.boxes.len() as u32;
    }

    /// Whether there are none.
    pub(crate) fn is_empty(&self) -> bool {
        self.positions.is_empty()
    }

    /// Passes to `probe` the nodes in all boxes that it enters, in no particular order.
    pub(crate) fn visit(&self, probe: &mut impl Probe) -> ControlFlow<()> {
        let mut next = 0;
        while let Some(node_box) = self.boxes.get(next) {
            if !probe.enters(node_box.low, node_box.high) {
                next = node_box.after as usize;
                continue;
            }
            if !node_box.is_divided {
                for &i in &self.sorted[node_box.from as usize..node_box.to as usize] {
                    probe.meet(self.first + i, self.positions[i as usize])?;
                }
            }
            next += 1;
        }
        ControlFlow::Continue(())
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::plane::rectangle_distance_squared;
    use properties::fixed;

    /// Gathers the nodes in a circle.
    struct Circle {
        centre: DVec2,
        squared: f64,
        found: Vec<usize>,
    }

    impl Probe for Circle {
        fn enters(&self, low: DVec2, high: DVec2) -> bool {
            rectangle_distance_squared(low, high, self.centre) <= self.squared
        }

        fn meet(&mut self, id: u32, p: DVec2) -> ControlFlow<()> {
            if (p - self.centre).length_squared() <= self.squared {
                self.found.push(id as usize);
            }
            ControlFlow::Continue(())
        }
    }

    proptest! {
        #![proptest_config(fixed(256))]

        #[test]
        fn boxes_within_reach_hold_all_nodes_within_reach(
            points in proptest::collection::vec((0.0..9.0, 0.0..3.0), 0..120),
            old in 0_usize..10, x in -3.0..12.0, y in -3.0..6.0, radius in 0.0..5.0,
        ) {
            let positions: Vec<DVec2> = points.into_iter().map(DVec2::from).collect();
            let old = old.min(positions.len());
            let centre = DVec2::new(x, y);
            let squared = radius * radius;
            let mut circle = Circle { centre, squared, found: Vec::new() };
            let fresh = FreshNodes::new(&positions, old as u32);
            prop_assert!(fresh.visit(&mut circle).is_continue());
            let mut found = circle.found;
            found.sort_unstable();
            let expected: Vec<usize> = (old..positions.len())
                .filter(|&i| (positions[i] - centre).length_squared() <= squared)
                .collect();
            prop_assert_eq!(found, expected);
        }
    }
}
