//! Where a body that may turn a little comes to rest.
//!
//! Let a body's centre of mass be at the origin of the plan, and let a corner at (x, y) have to be
//! lifted by c for it to touch what lies below. After a lift by t and small turns with the slopes a
//! and b it is lifted by t + a x + b y. The body rests where t is least while no corner is inside
//! anything:
//!
//! ```text
//! minimise t, so that t + a xᵢ + b yᵢ ≥ cᵢ for all corners i
//! ```
//!
//! The solution is the plane of the upper convex hull of the points (x, y, c) over the origin: the
//! three corners on which the body lies, with the centre of mass over the triangle between them.
//! It is found by the dual simplex method: a triple whose triangle holds the origin exchanges one
//! corner for the one that lies deepest, until none lies deeper than the plane.
//!
//! - **In**: corners of a body, and what lies below each.
//! - **Out**: the slopes over which it turns to lie on three of them.
//! - **Always true**: the same corners in the same order give the same bits.
//! - **Left out**: bodies that slide, roll over or bend.
//!
//! ```
//! use glam::DVec2;
//! use numerics::rest::{Contact, support};
//!
//! // Three feet on level ground, of which one is shorter: it must go down, the others not.
//! let feet = [(-1.0, -1.0, 0.0), (1.0, -1.0, 0.0), (0.0, 2.0, -0.3)];
//! let feet = feet.map(|(x, y, lift)| Contact { at: DVec2::new(x, y), lift, height: 0.0 });
//! let support = support(&feet).expect("its centre is between them");
//! assert!(support.slope.distance(DVec2::new(0.0, -0.1)) < 1e-12);
//! ```

use glam::{DVec2, DVec3};

/// A corner of a body.
#[derive(Clone, Copy, Debug)]
pub struct Contact {
    /// Its place in the plan, from the centre of mass. All lengths have the same unit.
    pub at: DVec2,
    /// How far it must be lifted to touch what lies below.
    pub lift: f64,
    /// Height of what lies below.
    pub height: f64,
}

/// How a body lies.
#[derive(Clone, Copy, Debug)]
pub struct Support {
    /// The slopes (a, b) over which it wants to turn.
    pub slope: DVec2,
    /// Slope of the plane through the three points on which it lies then; infinite if they are in
    /// line.
    pub steepness: f64,
}

/// Exchanges after which the plane is taken as it is.
const EXCHANGES: usize = 300;

/// The plane on which a body with these corners lies; `None` if the corners that have something
/// below them all lie to one side of its centre of mass.
pub fn support(contacts: &[Contact]) -> Option<Support> {
    let reach = contacts.iter().map(|c| c.at.length()).fold(0.0, f64::max);
    let (least, most) = contacts
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), c| {
            (least.min(c.lift), most.max(c.lift))
        });
    if contacts.is_empty() || reach <= 0.0 {
        return None;
    }
    let span = (most - least) + reach;
    let corners = Corners::of(contacts);
    // Three far corners that nothing holds begin.
    let far = [(0.0, 1.0), (-0.8, -0.6), (0.8, -0.6)]
        .map(|(x, y)| DVec3::new(100.0 * reach * x, 100.0 * reach * y, least - 1e4 * span));
    let mut triple = far;
    let mut held: [Option<Contact>; 3] = [None; 3];
    let tolerance = 1e-9 * span;
    let mut plane = through(&triple)?;
    for _ in 0..EXCHANGES {
        let (deepest, depth) = corners.deepest_below(plane)?;
        if depth <= tolerance {
            break;
        }
        let deepest = &contacts[deepest];
        let corner = deepest.at.extend(deepest.lift);
        // Of the exchanges after which the origin is still inside, the one that lifts most.
        let exchanged = (0..3).filter_map(|leaves| {
            let mut next = triple;
            next[leaves] = corner;
            let plane = through(&next).filter(|_| holds_origin(&next))?;
            Some((leaves, next, plane))
        });
        let Some((leaves, next, lifted)) =
            exchanged.max_by(|(_, _, a), (_, _, b)| a.z.total_cmp(&b.z))
        else {
            break;
        };
        (triple, plane) = (next, lifted);
        held[leaves] = Some(*deepest);
    }
    let [Some(p), Some(q), Some(r)] = held else {
        return None;
    };
    let below = through(&[p, q, r].map(|contact| contact.at.extend(contact.height)));
    Some(Support {
        slope: plane.truncate(),
        steepness: below.map_or(f64::INFINITY, |plane| plane.truncate().length()),
    })
}

/// Corners by coordinate, so that some are looked at at once.
struct Corners {
    x: Vec<f64>,
    y: Vec<f64>,
    lift: Vec<f64>,
}

/// Corners of which the deepest is found before it is known which one it is.
const BLOCK: usize = 256;
/// Corners that are looked at at once.
const LANES: usize = 4;

impl Corners {
    fn of(contacts: &[Contact]) -> Self {
        Self {
            x: contacts.iter().map(|contact| contact.at.x).collect(),
            y: contacts.iter().map(|contact| contact.at.y).collect(),
            lift: contacts.iter().map(|contact| contact.lift).collect(),
        }
    }

    /// The number of the corner that lies deepest below a plane, the last one of several, and how
    /// deep.
    fn deepest_below(&self, plane: DVec3) -> Option<(usize, f64)> {
        let mut found: Option<(usize, f64)> = None;
        for first in (0..self.lift.len()).step_by(BLOCK) {
            let depth = self.greatest_depth(first, plane);
            if found.is_none_or(|(_, most)| depth >= most) {
                found = Some((first, depth));
            }
        }
        let (first, most) = found?;
        let last = (first + BLOCK).min(self.lift.len());
        let number = (first..last).rfind(|&number| self.depth(number, plane) >= most)?;
        Some((number, most))
    }

    fn depth(&self, number: usize, plane: DVec3) -> f64 {
        depth(self.x[number], self.y[number], self.lift[number], plane)
    }

    /// That of the deepest corner of a block.
    fn greatest_depth(&self, first: usize, plane: DVec3) -> f64 {
        let last = (first + BLOCK).min(self.lift.len());
        let [x, y, lift] = [&self.x, &self.y, &self.lift].map(|values| &values[first..last]);
        let mut most = [f64::NEG_INFINITY; LANES];
        let (x, x_rest) = x.as_chunks::<LANES>();
        let (y, y_rest) = y.as_chunks::<LANES>();
        let (lift, lift_rest) = lift.as_chunks::<LANES>();
        for ((x, y), lift) in x.iter().zip(y).zip(lift) {
            for lane in 0..LANES {
                let depth = depth(x[lane], y[lane], lift[lane], plane);
                most[lane] = if depth > most[lane] {
                    depth
                } else {
                    most[lane]
                };
            }
        }
        let rest = x_rest.iter().zip(y_rest).zip(lift_rest);
        let rest = rest.map(|((x, y), lift)| depth(*x, *y, *lift, plane));
        rest.chain(most).fold(f64::NEG_INFINITY, f64::max)
    }
}

/// How deep a corner lies below a plane.
fn depth(x: f64, y: f64, lift: f64, plane: DVec3) -> f64 {
    lift - (plane.z + (plane.x * x + plane.y * y))
}

/// The plane a x + b y + t through three points, as (a, b, t); `None` if their plans are in line.
fn through([p, q, r]: &[DVec3; 3]) -> Option<DVec3> {
    let (u, v) = (*q - *p, *r - *p);
    let area = u.truncate().perp_dot(v.truncate());
    let slope = DVec2::new(u.z * v.y - v.z * u.y, v.z * u.x - u.z * v.x) / area;
    let plane = slope.extend(p.z - slope.dot(p.truncate()));
    plane.is_finite().then_some(plane)
}

/// Whether the origin lies in the plan of a triangle.
fn holds_origin([p, q, r]: &[DVec3; 3]) -> bool {
    let side = |a: &DVec3, b: &DVec3| a.truncate().perp_dot(b.truncate());
    let sides = [side(p, q), side(q, r), side(r, p)];
    sides.iter().all(|side| *side >= 0.0) || sides.iter().all(|side| *side <= 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_many_corners_it_lies_on_those_that_let_it_lowest() {
        // A place for each corner by a sequence of low discrepancy, on ground with waves.
        for count in [3, 100, BLOCK, BLOCK + 1, 3 * BLOCK + 17] {
            let contacts: Vec<Contact> = (0..count)
                .map(|number| {
                    let at = [0.754_877_666, 0.569_840_291].map(|step| number as f64 * step % 1.0);
                    let at = DVec2::from_array(at) - 0.5;
                    let lift = 0.1 * libm::sin(9.0 * at.x) * libm::cos(7.0 * at.y) + 0.05 * at.x;
                    Contact {
                        at,
                        lift,
                        height: 0.0,
                    }
                })
                .collect();
            let lifted = |slope: DVec2| {
                let lifts = contacts.iter().map(|c| c.lift - slope.dot(c.at));
                lifts.fold(f64::NEG_INFINITY, f64::max)
            };
            let Some(found) = support(&contacts) else {
                assert_eq!(count, 3, "its centre is among so many");
                continue;
            };
            let least = lifted(found.slope);
            for angle in 0..24 {
                let (sin, cos) = libm::sincos(f64::from(angle) * std::f64::consts::TAU / 24.0);
                for step in [1e-6, 1e-3, 0.1] {
                    let other = lifted(found.slope + step * DVec2::new(cos, sin));
                    assert!(other > least - 1e-12, "{count}: {other} below {least}");
                }
            }
        }
    }

    #[test]
    fn the_deepest_corner_is_the_last_one_of_several() {
        for (count, deepest) in [
            (5, vec![1, 3]),
            (2 * BLOCK + 3, vec![7, BLOCK, 2 * BLOCK + 2]),
        ] {
            let contact = |number: usize| Contact {
                at: DVec2::new(number as f64, 1.0),
                lift: if deepest.contains(&number) { 2.0 } else { 1.0 },
                height: 0.0,
            };
            let corners = Corners::of(&(0..count).map(contact).collect::<Vec<_>>());
            let level = DVec3::new(0.0, 0.5, 0.25);
            let last = deepest[deepest.len() - 1];
            assert_eq!(corners.deepest_below(level), Some((last, 1.25)));
        }
        assert_eq!(Corners::of(&[]).deepest_below(DVec3::ZERO), None);
    }
}
