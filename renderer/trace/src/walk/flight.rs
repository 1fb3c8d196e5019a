//! Flights of light: what is ahead of a ray, and the bodies and media in which it is.

use glam::{Vec2, Vec3};

use crate::geometry::Hit;
use crate::geometry::surface::SurfacePoint;
use crate::medium::{Body, BodyPlace, Coefficients, Inside};
use crate::spectrum::Lanes;
use crate::world::WorldObjects;

/// Where light is, in scenes with media.
#[derive(Clone, Copy, Debug, Default)]
pub struct Passage {
    /// The bodies around.
    pub inside: Inside,
    /// Number of flights so far, each with random numbers of its own.
    pub flights: u32,
}

/// What is ahead of a ray.
#[derive(Clone, Copy, Debug)]
pub enum Ahead {
    /// A surface.
    Hit(Hit),
    /// The end of a flight of this length in a medium, m.
    End(f32),
    /// Nothing: the ray leaves.
    Nothing,
    /// The search was given up.
    Unknown,
}

/// An event of scattering in a medium.
#[derive(Clone, Copy, Debug)]
pub struct Collision<const N: usize> {
    /// Where it is.
    pub position: Vec3,
    /// The body that the medium fills.
    pub place: BodyPlace,
    /// The medium.
    pub medium: Coefficients<N>,
    /// Whether light reaches the place straight, through boundaries with one index on both sides;
    /// through others only bounces find it.
    pub is_lit: bool,
    /// What light carried before the flight.
    pub before: Lanes<N>,
    /// Two random numbers of the flight, by which the leaf was drawn if a leaf scatters.
    pub u: Vec2,
    /// By how much the ray was moved on its way, m.
    pub moved: f32,
}

/// The boundary of a body at a point.
#[derive(Clone, Copy, Debug)]
pub struct Boundary {
    place: BodyPlace,
    body: Body,
    /// The outward shading normal.
    normal: Vec3,
}

impl Boundary {
    /// The boundary on which a point lies, if it lies on one.
    #[inline]
    pub fn at(objects: &WorldObjects, surface: &SurfacePoint) -> Option<Self> {
        let body = objects[surface.instance as usize].body?;
        Some(Self {
            place: objects.body_place(surface.instance),
            body,
            normal: surface.shading_normal,
        })
    }

    /// Light that was in these bodies leaves the point in a direction.
    pub fn leave(&self, inside: &mut Inside, direction: Vec3) {
        inside.leave_boundary(self.place, self.body, self.normal, direction);
    }
}
