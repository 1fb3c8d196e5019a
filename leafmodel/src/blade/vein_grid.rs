//! The veins that matter at a point: a grid of cells, each with the segments that reach into it.

use std::f64::consts::FRAC_1_SQRT_2;
use std::ops::Range;

use glam::DVec2;

use crate::venation::network::VeinSegment;

/// Segments sorted into square cells by how far each of them reaches.
#[derive(Debug)]
pub(super) struct VeinGrid {
    origin: DVec2,
    cell: f64,
    columns: usize,
    rows: usize,
    /// Where each cell's list begins in `members`; one more than there are cells.
    starts: Vec<u32>,
    members: Vec<u32>,
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
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for (segment, &reach) in segments.iter().zip(&reaches) {
            low = low.min(segment.from.min(segment.to) - reach);
            high = high.max(segment.from.max(segment.to) + reach);
        }
        if segments.is_empty() {
            (low, high) = (DVec2::ZERO, DVec2::ZERO);
        }
        let mean_reach = reaches.iter().sum::<f64>() / reaches.len().max(1) as f64;
        let extent = (high - low).max_element();
        let cell = (share * mean_reach)
            .max(extent / MOST_CELLS)
            .max(f64::MIN_POSITIVE);
        let cells = |length: f64| (length / cell).floor() as usize + 1;
        let mut grid = Self {
            origin: low,
            cell,
            columns: cells(high.x - low.x),
            rows: cells(high.y - low.y),
            starts: Vec::new(),
            members: Vec::new(),
            segments,
        };
        grid.sort(&reaches);
        grid
    }

    /// Counting sort of the segments into their cells.
    fn sort(&mut self, reaches: &[f64]) {
        let mut starts = vec![0_u32; self.columns * self.rows + 1];
        for (segment, &reach) in self.segments.iter().zip(reaches) {
            self.cells_of(segment, reach, |cell| starts[cell + 1] += 1);
        }
        for cell in 1..starts.len() {
            starts[cell] += starts[cell - 1];
        }
        let mut free = starts.clone();
        let mut members = vec![0; starts[starts.len() - 1] as usize];
        for (index, (segment, &reach)) in self.segments.iter().zip(reaches).enumerate() {
            self.cells_of(segment, reach, |cell| {
                members[free[cell] as usize] = index as u32;
                free[cell] += 1;
            });
        }
        self.starts = starts;
        self.members = members;
    }

    fn cells_of(&self, segment: &VeinSegment, reach: f64, mut visit: impl FnMut(usize)) {
        let index = |p: DVec2| ((p - self.origin) / self.cell).floor().max(DVec2::ZERO);
        let low = index(segment.from.min(segment.to) - reach);
        let high = index(segment.from.max(segment.to) + reach);
        for row in low.y as usize..=(high.y as usize).min(self.rows - 1) {
            for column in low.x as usize..=(high.x as usize).min(self.columns - 1) {
                visit(row * self.columns + column);
            }
        }
    }

    /// The nearest points of the veins that may reach a point, in the order of the segments.
    pub(super) fn near(&self, p: DVec2) -> impl Iterator<Item = NearVein> + '_ {
        let members = self.members(p).iter();
        members.map(move |&index| self.nearest(index, p))
    }

    /// The numbers of the veins that may reach a point, ascending unless they were ordered.
    pub(super) fn members(&self, p: DVec2) -> &[u32] {
        &self.members[self.places(p)]
    }

    /// Where the veins that may reach a point stand in the list of all members.
    fn places(&self, p: DVec2) -> Range<usize> {
        let place = ((p - self.origin) / self.cell).floor();
        let inside = place.cmpge(DVec2::ZERO).all()
            && place.x < self.columns as f64
            && place.y < self.rows as f64;
        if inside {
            let cell = place.y as usize * self.columns + place.x as usize;
            self.starts[cell] as usize..self.starts[cell + 1] as usize
        } else {
            0..0
        }
    }

    /// Orders the members of each cell by a key: that of a vein's number for the cell with this
    /// middle and half diagonal.
    pub(super) fn order_by(mut self, key: impl Fn(u32, DVec2, f64) -> f64) -> OrderedVeinGrid {
        let half_diagonal = self.cell * FRAC_1_SQRT_2;
        let mut keys = Vec::with_capacity(self.members.len());
        let mut keyed = Vec::new();
        for cell in 0..self.columns * self.rows {
            let place = DVec2::new((cell % self.columns) as f64, (cell / self.columns) as f64);
            let middle = self.origin + (place + 0.5) * self.cell;
            let members = self.starts[cell] as usize..self.starts[cell + 1] as usize;
            let members = &mut self.members[members];
            keyed.clear();
            keyed.extend(
                members
                    .iter()
                    .map(|&number| (key(number, middle, half_diagonal), number)),
            );
            keyed.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            for (member, &(key, number)) in members.iter_mut().zip(&keyed) {
                *member = number;
                keys.push(key);
            }
        }
        OrderedVeinGrid { veins: self, keys }
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
    /// One for each member.
    keys: Vec<f64>,
}

impl OrderedVeinGrid {
    /// Keys and numbers of the veins that may reach a point, by ascending key.
    pub(super) fn members(&self, p: DVec2) -> impl Iterator<Item = (f64, u32)> + '_ {
        let places = self.veins.places(p);
        let keys = self.keys[places.clone()].iter().copied();
        keys.zip(self.veins.members[places].iter().copied())
    }

    /// As [`VeinGrid::nearest`].
    pub(super) fn nearest(&self, number: u32, p: DVec2) -> NearVein {
        self.veins.nearest(number, p)
    }
}

fn nearest(segment: &VeinSegment, p: DVec2) -> NearVein {
    let along = segment.to - segment.from;
    let squared = along.length_squared();
    let share = if squared > 0.0 {
        ((p - segment.from).dot(along) / squared).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let foot = segment.from + along * share;
    NearVein {
        distance: (foot - p).length(),
        radius: segment.radius_from + (segment.radius_to - segment.radius_from) * share,
        foot,
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::testing::fixed;

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
