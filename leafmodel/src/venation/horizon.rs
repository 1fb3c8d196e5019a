//! Bound of the distance of a source's relative neighbours, by direction.
//!
//! By Eq. 2 a node at `w` (seen from the source) keeps a node at `v` from being a relative
//! neighbour if it is no farther from the source, `‖w‖ ≤ ‖v‖`, and `v` lies on its side of their
//! bisector, `‖w‖ ≤ 2 ‖v‖ cos φ`, with `φ` the angle between `v` and `w`. So in the direction at
//! `φ` it *hides* everything at a distance of `‖w‖ / min(1, 2 cos φ)` or more, and nothing from a
//! right angle on. The region that a set of nodes leaves visible is star-shaped, and it only
//! shrinks as nodes are added.
//!
//! A [`Horizon`] bounds the visible region from outside in sixteen sectors. It stores inverse
//! distances. Within a sector `cos φ` is least at one of the ends, so the two ends bound what a
//! node hides over the whole sector.
//!
//! - **Always true**: single precision errs towards visibility, by [`SLACK`], far above rounding.
//!   So whatever the horizon hides is hidden by one of its nodes in double precision too.

use glam::DVec2;

/// Number of sectors, and of the directions between them.
const SECTORS: usize = 16;

/// Cosines of one, two and three sixteenths of a turn.
const C1: f32 = 0.923_879_5;
const C2: f32 = 0.707_106_77;
const C3: f32 = 0.382_683_43;

/// Unit vectors between the sectors, counter-clockwise from +x: x components, then y components.
const X: [f32; SECTORS] = [
    1.0, C1, C2, C3, 0.0, -C3, -C2, -C1, -1.0, -C1, -C2, -C3, 0.0, C3, C2, C1,
];
const Y: [f32; SECTORS] = [
    0.0, C3, C2, C1, 1.0, C1, C2, C3, 0.0, -C3, -C2, -C1, -1.0, -C1, -C2, -C3,
];

/// Slack on lengths and cosines: about ten times the rounding error of single precision.
const SLACK: f32 = 2e-6;

/// The nearest distance that single precision can square and invert with room to spare.
const NEAR: f32 = 1e-15;

/// An upper bound, in every direction, of the distance of a source's relative neighbours.
#[derive(Clone, Debug)]
pub(crate) struct Horizon {
    /// For the sector from each direction to the next: everything in it with this inverse distance
    /// or less is hidden.
    hidden: [f32; SECTORS],
    /// The least entry of `hidden`.
    least: f32,
}

impl Horizon {
    /// The horizon of a source in a rectangle without nodes; `low` and `high` are its corners
    /// relative to the source.
    pub(crate) fn of_rectangle(low: DVec2, high: DVec2) -> Self {
        // The source may lie on a side of the rectangle.
        let inverse = |distance: f64| (1.0 - SLACK) / (distance as f32).max(NEAR);
        let (left, right) = (inverse(-low.x), inverse(high.x));
        let (below, above) = (inverse(-low.y), inverse(high.y));
        let hidden = std::array::from_fn(|k| {
            // No sector crosses an axis.
            let next = (k + 1) % SECTORS;
            let side = if X[k] + X[next] > 0.0 { right } else { left };
            let end = if Y[k] + Y[next] > 0.0 { above } else { below };
            let across = X[k].abs().min(X[next].abs()) * side;
            let along = Y[k].abs().min(Y[next].abs()) * end;
            across.max(along)
        });
        let mut horizon = Self { hidden, least: 0.0 };
        horizon.measure();
        horizon
    }

    /// Whether a node at `offset` from the source, `distance_squared` away, may be visible.
    pub(crate) fn shows(&self, offset: DVec2, distance_squared: f64) -> bool {
        let squared = distance_squared as f32;
        let within = |hidden: f32| squared * hidden * hidden <= 1.0 + 4.0 * SLACK;
        within(self.least) && within(self.hidden[sector(offset)])
    }

    /// Whether something in the rectangle with these corners, relative to the source, may be
    /// visible.
    pub(crate) fn shows_any_in(&self, low: DVec2, high: DVec2) -> bool {
        let gap = low.max(-high);
        let squared = gap.max(DVec2::ZERO).length_squared() as f32;
        let within = |hidden: f32| squared * hidden * hidden <= 1.0 + 4.0 * SLACK;
        if !within(self.least) {
            return false;
        }
        if gap.x <= 0.0 && gap.y <= 0.0 {
            return true;
        }
        // The corners farthest clockwise and farthest counter-clockwise, as seen from the source.
        let (right, above) = (low.x > 0.0, low.y > 0.0);
        let (beside, beyond) = (gap.x > 0.0, gap.y > 0.0);
        let near_x = if right { low.x } else { high.x };
        let near_y = if above { low.y } else { high.y };
        let (first_x, last_x) = match (beyond, above) {
            (true, true) => (high.x, low.x),
            (true, false) => (low.x, high.x),
            (false, _) => (near_x, near_x),
        };
        let (first_y, last_y) = match (beside, right) {
            (true, true) => (low.y, high.y),
            (true, false) => (high.y, low.y),
            (false, _) => (near_y, near_y),
        };
        let last = sector(DVec2::new(last_x, last_y));
        let mut at = sector(DVec2::new(first_x, first_y));
        loop {
            if within(self.hidden[at]) {
                return true;
            }
            if at == last {
                return false;
            }
            at = (at + 1) % SECTORS;
        }
    }

    /// Adds a node at `offset` from the source.
    pub(crate) fn hide_behind(&mut self, offset: DVec2, distance_squared: f64) {
        let distance = distance_squared.sqrt() as f32;
        if distance_squared == 0.0 {
            // A node at the place of the source hides everything, even another node at the same
            // place.
            self.hidden = [f32::MAX; SECTORS];
        } else if distance >= NEAR {
            let (x, y) = (offset.x as f32, offset.y as f32);
            let inverse = (1.0 - SLACK) / distance;
            let twice = 2.0 / distance;
            let shadow: [f32; SECTORS] =
                std::array::from_fn(|k| ((x * X[k] + y * Y[k]) * twice - SLACK).min(1.0) * inverse);
            for k in 0..SECTORS {
                let next = shadow[(k + 1) % SECTORS];
                self.hidden[k] = self.hidden[k].max(shadow[k].min(next));
            }
        }
        self.measure();
    }

    fn measure(&mut self) {
        self.least = self.hidden.iter().fold(f32::INFINITY, |a, &b| a.min(b));
    }
}

/// Number of the sector of a direction. On a border it may be either.
fn sector(offset: DVec2) -> usize {
    let (x, y) = (offset.x.abs(), offset.y.abs());
    // Within a quadrant from the x axis on; the tangent of a sixteenth of a turn is √2 − 1.
    let tangent = std::f64::consts::SQRT_2 - 1.0;
    let within = usize::from(y > x * tangent) + usize::from(y > x) + usize::from(x < y * tangent);
    match (offset.x >= 0.0, offset.y >= 0.0) {
        (true, true) => within,
        (false, true) => 7 - within,
        (false, false) => 8 + within,
        (true, false) => 15 - within,
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use properties::fixed;

    /// Whether a node at `w` hides what is at `v` from the source at the origin: Eq. 2 as written.
    fn hides(w: DVec2, v: DVec2) -> bool {
        v.length_squared() >= w.length_squared().max((v - w).length_squared())
    }

    /// Places on rings around the source, some exactly on axes and diagonals.
    fn places(count: std::ops::Range<usize>) -> impl Strategy<Value = Vec<DVec2>> {
        let place = (0.0..1.0_f64, 0_u32..64, 0.01..10.0_f64, 0_u8..3).prop_map(
            |(turn, step, distance, kind)| {
                let turn = match kind {
                    0 => f64::from(step) / 64.0,
                    _ => turn,
                };
                let angle = turn * std::f64::consts::TAU;
                DVec2::new(libm::cos(angle), libm::sin(angle)) * distance
            },
        );
        proptest::collection::vec(place, count)
    }

    proptest! {
        #![proptest_config(fixed(2000))]

        #[test]
        fn what_is_beyond_the_horizon_is_hidden_by_a_node_or_outside(
            nodes in places(0..12), seen in places(40..41), left in 0.0..8.0_f64, above in 0.0..8.0_f64,
        ) {
            let (low, high) = (DVec2::new(-left, -3.0), DVec2::new(5.0, above));
            let mut horizon = Horizon::of_rectangle(low, high);
            for node in &nodes {
                horizon.hide_behind(*node, node.length_squared());
            }
            for &v in &seen {
                let outside = v.cmplt(low).any() || v.cmpgt(high).any();
                if !horizon.shows(v, v.length_squared()) {
                    prop_assert!(
                        outside || nodes.iter().any(|&w| hides(w, v)),
                        "{} is hidden by none of {:?}", v, nodes
                    );
                }
            }
        }

        #[test]
        fn a_rectangle_is_entered_for_anything_visible_in_it(
            nodes in places(1..12), corners in places(2..3),
            shares in proptest::collection::vec((0.0..=1.0_f64, 0.0..=1.0_f64), 40),
        ) {
            let mut horizon = Horizon::of_rectangle(DVec2::splat(-20.0), DVec2::splat(20.0));
            for node in &nodes {
                horizon.hide_behind(*node, node.length_squared());
            }
            let (low, high) = (corners[0].min(corners[1]), corners[0].max(corners[1]));
            let ends = [(0.0, 0.0), (0.0, 1.0), (1.0, 0.0), (1.0, 1.0)];
            for share in shares.into_iter().chain(ends) {
                let p = low + (high - low) * DVec2::from(share);
                if horizon.shows(p, p.length_squared()) {
                    prop_assert!(horizon.shows_any_in(low, high), "{} is seen in {}–{}", p, low, high);
                }
            }
        }

        #[test]
        fn few_places_are_visible_that_no_node_hides(nodes in places(20..30), seen in places(200..201)) {
            let mut horizon = Horizon::of_rectangle(DVec2::splat(-20.0), DVec2::splat(20.0));
            for node in &nodes {
                horizon.hide_behind(*node, node.length_squared());
            }
            let shown = seen.iter().filter(|v| horizon.shows(**v, v.length_squared()));
            let in_vain = shown.filter(|&&v| nodes.iter().any(|&w| hides(w, v))).count();
            prop_assert!(in_vain < 40, "{} of 200", in_vain);
        }
    }
}
