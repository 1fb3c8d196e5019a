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
//! use leafmodel::rest::{Contact, support};
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
    // Three far corners that nothing holds begin.
    let far = [(0.0, 1.0), (-0.8, -0.6), (0.8, -0.6)]
        .map(|(x, y)| DVec3::new(100.0 * reach * x, 100.0 * reach * y, least - 1e4 * span));
    let mut triple = far;
    let mut held: [Option<Contact>; 3] = [None; 3];
    let tolerance = 1e-9 * span;
    let mut plane = through(&triple)?;
    for _ in 0..EXCHANGES {
        let depth = |c: &Contact| c.lift - (plane.z + plane.truncate().dot(c.at));
        let deepest = contacts
            .iter()
            .max_by(|a, b| depth(a).total_cmp(&depth(b)))?;
        if depth(deepest) <= tolerance {
            break;
        }
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
