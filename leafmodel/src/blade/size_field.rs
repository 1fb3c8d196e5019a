//! Target lengths of the mesh's edges.

use glam::DVec2;

use super::plan::BladeForm;
use super::vein_grid::{OrderedVeinGrid, VeinGrid};
use crate::venation::network::VeinSegment;

/// Edge length over a vein's radius where the vein has relief: five vertices across its mound.
const EDGE_PER_RADIUS: f64 = 0.6;
/// Growth of the edge per unit of distance from a vein.
const GRADING: f64 = 0.3;
/// Half-width, in radii, over which the edge stays as short as on the vein's axis: that of the
/// mound.
const PLATEAU: f64 = 1.5;
/// Delaunay triangles have edges up to twice their circumradius: aiming at this share of the
/// longest edge allowed keeps them below it.
const AIM: f64 = 0.75;
/// Shortest target edge at a vein, as a share of the longest edge.
const SHORTEST: f64 = 1.0 / 16.0;
/// Cells of the grid of veins over their mean reach.
const CELL: f64 = 0.25;

/// Target edge length over the lamina, mm.
#[derive(Debug)]
pub(super) struct SizeField {
    longest: f64,
    /// By the least target that a vein may ask for in a cell.
    veins: OrderedVeinGrid,
    /// A bound for each vein.
    bounds: Vec<Bound>,
}

impl SizeField {
    /// The target lengths of `form`: short at `veins`, growing linearly with the distance from them
    /// up to the longest.
    pub(super) fn new(form: &BladeForm, veins: &[VeinSegment]) -> Self {
        let longest = AIM * form.max_edge_mm;
        // A vein so thick that the longest edge is short enough for it asks for nothing.
        let asks = |vein: &&VeinSegment| {
            form.relief > 0.0 && on_axis(longest, vein.radius_from.min(vein.radius_to)) < longest
        };
        let shaping: Vec<VeinSegment> = veins.iter().filter(asks).copied().collect();
        let reach = |segment: &VeinSegment| {
            let radius = segment.radius_from.max(segment.radius_to);
            PLATEAU * radius + (longest - on_axis(longest, radius)).max(0.0) / GRADING
        };
        let bounds: Vec<Bound> = shaping.iter().map(|s| Bound::new(s, longest)).collect();
        let veins = VeinGrid::with_cells(CELL, shaping, reach);
        let least = |number: u32, middle, half_diagonal| {
            bounds[number as usize].least_near(middle, half_diagonal)
        };
        Self {
            longest,
            veins: veins.order_by(least),
            bounds,
        }
    }

    /// Target edge length at a point, mm.
    pub(super) fn at(&self, p: DVec2) -> f64 {
        let shortest = SHORTEST * self.longest;
        let mut target = self.longest;
        for &(least, number) in self.veins.members(p) {
            if target <= shortest.max(least) {
                break;
            }
            if self.bounds[number as usize].is_too_far(p, target, self.longest) {
                continue;
            }
            let vein = self.veins.nearest(number, p);
            let away = (vein.distance - PLATEAU * vein.radius).max(0.0);
            target = target.min(on_axis(self.longest, vein.radius) + GRADING * away);
        }
        target
    }

    /// The greatest target anywhere, mm.
    pub(super) fn longest(&self) -> f64 {
        self.longest
    }
}

/// A bound on the target of a vein that is cheaper than the distance to it.
#[derive(Debug)]
struct Bound {
    middle: DVec2,
    /// Half the vein's length plus the distance over which its least target holds.
    reach: f64,
    /// The least target on its axis.
    least: f64,
}

impl Bound {
    fn new(segment: &VeinSegment, longest: f64) -> Self {
        let thickest = segment.radius_from.max(segment.radius_to);
        let thinnest = segment.radius_from.min(segment.radius_to);
        Self {
            middle: 0.5 * (segment.from + segment.to),
            reach: 0.5 * (segment.to - segment.from).length() + PLATEAU * thickest,
            least: on_axis(longest, thinnest),
        }
    }

    /// A bound on the vein's target from below, within this distance of a place.
    fn least_near(&self, place: DVec2, within: f64) -> f64 {
        let away = (place - self.middle).length() - within - self.reach;
        let spare = 1e-9 * (self.least + within + self.reach);
        self.least + GRADING * away.max(0.0) - spare
    }

    /// Whether the vein's target at `p` is certainly not below `target`, with a margin above
    /// rounding.
    fn is_too_far(&self, p: DVec2, target: f64, longest: f64) -> bool {
        let spare = 1e-9 * (longest + self.reach);
        let near = self.reach + (target - self.least) * (1.0 / GRADING) + spare;
        (p - self.middle).length_squared() >= near.max(0.0) * near.max(0.0)
    }
}

/// Target on the axis of a vein.
fn on_axis(longest: f64, radius: f64) -> f64 {
    (EDGE_PER_RADIUS * radius).clamp(SHORTEST * longest, longest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::blade::tests::flat;

    #[test]
    fn edges_grow_away_from_a_vein_up_to_the_longest() {
        let vein = VeinSegment {
            from: DVec2::ZERO,
            to: DVec2::new(0.0, 10.0),
            radius_from: 0.4,
            radius_to: 0.4,
            order: 1,
        };
        let form = BladeForm {
            relief: 0.5,
            max_edge_mm: 2.0,
            ..flat()
        };
        let size = SizeField::new(&form, &[vein]);
        assert!((size.at(DVec2::new(0.0, 5.0)) - 0.24).abs() < 1e-12);
        let mut last = 0.0;
        for step in 0..200 {
            let now = size.at(DVec2::new(0.05 * f64::from(step), 5.0));
            // Without a step: the reach of the segment ends where the longest edge is met.
            assert!(now >= last && now <= last + 0.24 + 0.05 * GRADING);
            if step > 0 {
                assert!(now - last <= 0.05 * GRADING + 1e-12);
            }
            last = now;
        }
        assert_eq!(last, 1.5);
    }

    #[test]
    fn without_relief_veins_ask_for_nothing() {
        let vein = VeinSegment {
            from: DVec2::ZERO,
            to: DVec2::Y,
            radius_from: 0.1,
            radius_to: 0.1,
            order: 1,
        };
        let size = SizeField::new(&flat(), &[vein]);
        assert_eq!(size.at(DVec2::ZERO), size.longest());
    }
}
