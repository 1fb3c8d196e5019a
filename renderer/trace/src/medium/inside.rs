//! The bodies in which a ray is.

use glam::Vec3;

/// Number of bodies within each other that are kept apart.
const MOST: usize = 6;

/// What a closed body with a transparent boundary is to a ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Body {
    /// Number of the medium that fills it; `None` is clear.
    pub medium: Option<u32>,
    /// Whether the index on both sides is the same, so that the boundary neither reflects nor
    /// refracts and light goes straight on.
    pub is_matched: bool,
    /// Whether its surface is closed. One that is not has no inside: light that goes straight on
    /// through a matched one is where it was before.
    pub is_closed: bool,
}

/// Which body it is: the part of an object, and its place of the object's places. Copies of a body
/// beyond the sides of a box that repeats itself are the same body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BodyPlace {
    /// Number of the part.
    pub part: u32,
    /// Number of the place within its object.
    pub place: u32,
}

/// The bodies in which a ray is, in the order in which it came in.
///
/// What fills the place is what fills the body that the ray entered last and has not left: bodies
/// may lie within each other. Where bodies overlap in part, light finds in the common part
/// the medium of the one that it entered last, so that the place has no medium of its own. Of more
/// than six bodies within each other the outermost is forgotten.
#[derive(Clone, Copy, Debug, Default)]
pub struct Inside {
    count: u8,
    bodies: [(BodyPlace, Option<Body>); MOST],
}

impl Inside {
    /// Number of the medium around; `None` if it is clear.
    #[inline]
    pub fn medium(&self) -> Option<u32> {
        self.innermost()?.1.medium
    }

    /// The body whose inside this is; `None` in the open.
    #[inline]
    pub fn innermost(&self) -> Option<(BodyPlace, Body)> {
        let last = usize::from(self.count).checked_sub(1)?;
        let (place, body) = self.bodies[last];
        body.map(|body| (place, body))
    }

    /// A ray leaves the boundary of a body, with its outward `normal`, in a direction.
    pub fn leave_boundary(&mut self, place: BodyPlace, body: Body, normal: Vec3, direction: Vec3) {
        if !body.is_closed {
            return;
        }
        let count = usize::from(self.count);
        let known = self.bodies[..count].iter().position(|own| own.0 == place);
        let is_inside = direction.dot(normal) < 0.0;
        match known {
            None if is_inside => {
                if count == MOST {
                    self.bodies.copy_within(1.., 0);
                    self.count -= 1;
                }
                self.bodies[usize::from(self.count)] = (place, Some(body));
                self.count += 1;
            }
            Some(number) if !is_inside => {
                self.bodies.copy_within(number + 1..count, number);
                self.count -= 1;
            }
            None | Some(_) => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn filled(medium: u32) -> Body {
        Body {
            medium: Some(medium),
            is_matched: true,
            is_closed: true,
        }
    }

    fn at(part: u32) -> BodyPlace {
        BodyPlace { part, place: 0 }
    }

    #[test]
    fn the_medium_is_that_of_the_body_entered_last() {
        let mut inside = Inside::default();
        assert_eq!(inside.medium(), None);
        let (into, out) = (Vec3::NEG_Z, Vec3::Z);
        inside.leave_boundary(at(1), filled(1), Vec3::Z, into);
        inside.leave_boundary(at(2), filled(2), Vec3::Z, into);
        assert_eq!(inside.medium(), Some(2));
        // Reflected within, it is still there, once.
        inside.leave_boundary(at(2), filled(2), Vec3::Z, into);
        inside.leave_boundary(at(2), filled(2), Vec3::Z, out);
        assert_eq!(inside.medium(), Some(1));
        inside.leave_boundary(at(1), filled(1), Vec3::Z, out);
        assert_eq!(inside.medium(), None);
        assert!(inside.innermost().is_none());
    }

    #[test]
    fn faces_that_lie_close_together_may_be_met_in_either_order() {
        for first in [1, 2] {
            let mut inside = Inside::default();
            inside.leave_boundary(at(1), filled(1), Vec3::Z, Vec3::NEG_Z);
            for body in [first, 3 - first] {
                // It goes along −z, out of 1 and into 2.
                let normal = if body == 1 { Vec3::NEG_Z } else { Vec3::Z };
                inside.leave_boundary(at(body), filled(body), normal, Vec3::NEG_Z);
            }
            assert_eq!(inside.medium(), Some(2));
        }
    }

    #[test]
    fn of_too_many_bodies_the_outermost_is_forgotten() {
        let mut inside = Inside::default();
        for body in 0..=MOST as u32 {
            inside.leave_boundary(at(body), filled(body), Vec3::Z, Vec3::NEG_Z);
        }
        for body in (1..=MOST as u32).rev() {
            assert_eq!(inside.medium(), Some(body));
            inside.leave_boundary(at(body), filled(body), Vec3::Z, Vec3::Z);
        }
        assert_eq!(inside.medium(), None);
    }
}
