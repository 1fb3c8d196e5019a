//! The veins that matter at a point: a grid of cells, each with the segments that reach into it.

use std::f64::consts::FRAC_1_SQRT_2;

use glam::DVec2;

use crate::buckets::Buckets;
use crate::plane::{Lattice, bounds, segment};
use crate::venation::network::VeinSegment;

/// Segments sorted into square cells by how far each of them reaches.
#[derive(Debug)]
pub(super) struct VeinGrid {
    lattice: Lattice,
    members: Buckets,
    segments: Vec<VeinSegment>,
}

/// The point of a vein's axis that is nearest to a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct NearVein {
    /// Distance to the axis, mm.
    pub(super) distance: f64,
    /// Radius of the vein there, mm.
    pub(super) radius: f64,
    /// That point, mm.
    pub(super) foot: DVec2,
}

/// Greatest number of cells along a side.
const MOST_CELLS: f64 = 1024.0;

impl VeinGrid {
    /// Sorts segments. A query within the distance `reach(segment)` of a segment finds it.
    pub(super) fn new(segments: Vec<VeinSegment>, reach: impl Fn(&VeinSegment) -> f64) -> Self {
        Self::with_cells(1.0, segments, reach)
    }

    /// As [`VeinGrid::new`], with cells of this share of the mean reach.
    pub(super) fn with_cells(
        share: f64,
        segments: Vec<VeinSegment>,
        reach: impl Fn(&VeinSegment) -> f64,
    ) -> Self {
        let reaches: Vec<f64> = segments.iter().map(reach).collect();
        let rectangles = segments.iter().zip(&reaches).map(|(vein, &reach)| {
            let (low, high) = (vein.from.min(vein.to), vein.from.max(vein.to));
            [low - reach, high + reach]
        });
        let (low, high) = match segments[..] {
            [] => (DVec2::ZERO, DVec2::ZERO),
            _ => bounds(rectangles.clone().flatten()),
        };
        let mean_reach = reaches.iter().sum::<f64>() / reaches.len().max(1) as f64;
        let extent = (high - low).max_element();
        let cell = (share * mean_reach)
            .max(extent / MOST_CELLS)
            .max(f64::MIN_POSITIVE);
        let lattice = Lattice::new(low, high - low, cell);
        let reached = (0..).zip(rectangles).flat_map(|(number, [low, high])| {
            let cells = lattice.cells_between(low, high);
            cells.map(move |cell| (cell, number))
        });
        Self {
            members: Buckets::new(lattice.cells(), reached),
            lattice,
            segments,
        }
    }

    /// The nearest points of the veins that may reach a point, in the order of the segments.
    pub(super) fn near(&self, p: DVec2) -> impl Iterator<Item = NearVein> + '_ {
        let members = self.members(p).iter();
        members.map(move |&index| self.nearest(index, p))
    }

    /// The numbers of the veins that may reach a point, ascending unless they were ordered.
    pub(super) fn members(&self, p: DVec2) -> &[u32] {
        let cell = self.lattice.cell_with(p);
        cell.map_or(&[], |cell| self.members.list(cell))
    }

    /// Orders the members of each cell by a key: that of a vein's number for the cell with this
    /// middle and half diagonal.
    pub(super) fn order_by(self, key: impl Fn(u32, DVec2, f64) -> f64) -> OrderedVeinGrid {
        let half_diagonal = self.lattice.cell * FRAC_1_SQRT_2;
        let mut members = self.members.map(|cell, number| {
            let middle = self.lattice.middle(cell);
            (key(number, middle, half_diagonal), number)
        });
        members.sort_each(|list| {
            list.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        });
        OrderedVeinGrid {
            veins: self,
            members,
        }
    }

    /// The point of a vein that is nearest to `p`.
    pub(super) fn nearest(&self, number: u32, p: DVec2) -> NearVein {
        nearest(&self.segments[number as usize], p)
    }

    /// The greatest radius of a vein, mm.
    pub(super) fn widest(&self, number: u32) -> f64 {
        let vein = &self.segments[number as usize];
        vein.radius_from.max(vein.radius_to)
    }
}

/// A [`VeinGrid`] whose cells list their veins by a key.
#[derive(Debug)]
pub(super) struct OrderedVeinGrid {
    veins: VeinGrid,
    /// Keys and numbers of the veins of each cell.
    members: Buckets<(f64, u32)>,
}

impl OrderedVeinGrid {
    /// Keys and numbers of the veins that may reach a point, by ascending key.
    pub(super) fn members(&self, p: DVec2) -> &[(f64, u32)] {
        let cell = self.veins.lattice.cell_with(p);
        cell.map_or(&[], |cell| self.members.list(cell))
    }

    /// As [`VeinGrid::nearest`].
    pub(super) fn nearest(&self, number: u32, p: DVec2) -> NearVein {
        self.veins.nearest(number, p)
    }
}

fn nearest(vein: &VeinSegment, p: DVec2) -> NearVein {
    let share = segment::share(vein.from, vein.to, p);
    let foot = vein.from + (vein.to - vein.from) * share;
    NearVein {
        distance: (foot - p).length(),
        radius: vein.radius_from + (vein.radius_to - vein.radius_from) * share,
        foot,
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use properties::fixed;

    fn segment((ax, ay, bx, by): (f64, f64, f64, f64), radius: f64) -> VeinSegment {
        VeinSegment {
            from: DVec2::new(ax, ay),
            to: DVec2::new(bx, by),
            radius_from: radius,
            radius_to: radius / 2.0,
            order: 1,
        }
    }

    proptest! {
        #![proptest_config(fixed(256))]

        #[test]
        fn every_vein_within_reach_is_named(
            ends in prop::collection::vec((-20.0..20.0, 0.0..50.0, -20.0..20.0, 0.0..50.0), 1..40),
            x in -25.0..25.0, y in -5.0..55.0,
            reach in 0.1..6.0,
        ) {
            let segments: Vec<_> = ends.iter().enumerate()
                .map(|(i, &ends)| segment(ends, 0.1 + i as f64 * 0.01))
                .collect();
            let p = DVec2::new(x, y);
            let within: Vec<_> = segments.iter().map(|s| nearest(s, p)).filter(|n| n.distance <= reach).collect();
            let grid = VeinGrid::new(segments, |_| reach);
            let found: Vec<_> = grid.near(p).filter(|n| n.distance <= reach).collect();
            prop_assert_eq!(found, within);
        }
    }

    #[test]
    fn a_leaf_without_veins_has_none_near() {
        let grid = VeinGrid::new(Vec::new(), |_| 1.0);
        assert_eq!(grid.near(DVec2::ZERO).count(), 0);
        assert_eq!(grid.near(DVec2::splat(1e9)).count(), 0);
    }

    #[test]
    fn the_radius_is_that_of_the_nearest_point() {
        let vein = segment((0.0, 0.0, 0.0, 10.0), 1.0);
        let near = nearest(&vein, DVec2::new(3.0, 5.0));
        assert_eq!((near.distance, near.radius), (3.0, 0.75));
        assert_eq!(nearest(&vein, DVec2::new(0.0, 14.0)).distance, 4.0);
    }
}
