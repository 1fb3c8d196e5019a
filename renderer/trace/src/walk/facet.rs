//! Light at a triangle of a surface that is smooth: its BSDF knows the plane of the shading normal,
//! and rays know the triangle.
//!
//! - **Always true**: light arrives on the side of the triangle from which it comes, and leaves on
//!   that side of the shading normal to which the BSDF sends it. No ray starts behind a surface
//!   that it has not passed, and no light is lost or gained: a closed body is closed.
//!
//! Between the two planes, a direction of light goes to one side of the shading normal and to the
//! other of the triangle. Its ray rises from the triangle before it goes there, so far that it
//! passes over the triangle, as it would over the smooth surface. If something is in the way up, the
//! light is mirrored at the plane of the triangle instead. `docs/src/theory/paths.md` says why under
//! "Shading normals".

use glam::{Vec2, Vec3};

use crate::bsdf::{BsdfSample, Scattered, View};
use crate::geometry::frame::Frame;
use crate::geometry::surface::SurfacePoint;
use crate::geometry::{Geometry, Ray};

/// The surroundings of a surface.
pub trait Surroundings {
    /// Whether nothing is in the way of a ray that ends.
    fn is_free(&self, way: &Ray) -> bool;
}

impl Surroundings for Geometry {
    fn is_free(&self, way: &Ray) -> bool {
        !self.occluded(way)
    }
}

/// A place on a surface, from where light leaves.
#[derive(Debug)]
pub struct Facet<'a, S> {
    /// What is around it.
    pub around: &'a S,
    /// The place.
    pub surface: &'a SurfacePoint,
}

/// What scatters light at a place: a BSDF seen from one direction, with its frame, whose +z is the
/// shading normal or against it.
pub type Seen<'a, const N: usize> = (&'a Frame, &'a View<'a, N>);

impl<S> Clone for Facet<'_, S> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S> Copy for Facet<'_, S> {}

/// How a direction lies to the planes of the triangle and of the shading normal.
enum Direction {
    /// On the same side of both.
    Plain,
    /// On the same side of both, and its mirror image at the triangle is between them.
    BesideGap,
    /// Between them.
    InGap,
}

/// Direction of light that comes along a ray, in the frame of the shading normal, away from the
/// surface: on the side of the triangle from which the ray comes. One that is below the plane of the
/// shading normal is mirrored at it.
#[inline]
pub fn arriving(surface: &SurfacePoint, frame: &Frame, way: Vec3) -> Vec3 {
    let from = -way;
    let mut wo = frame.to_local(from);
    if surface.is_between_planes(from) {
        wo.z = -wo.z;
    }
    wo
}

impl<S: Surroundings> Facet<'_, S> {
    #[inline]
    fn lie_of(&self, direction: Vec3) -> Direction {
        if !self.surface.is_smooth() {
            return Direction::Plain;
        }
        let (geometric, shading) = (self.surface.geometric_normal, self.surface.shading_normal);
        let (to_triangle, to_shading) = (direction.dot(geometric), direction.dot(shading));
        if to_triangle * to_shading < 0.0 {
            Direction::InGap
        } else if to_shading.abs() > 2.0 * to_triangle.abs() * geometric.dot(shading) {
            Direction::BesideGap
        } else {
            Direction::Plain
        }
    }

    /// Whether light may be mirrored from a direction or into it.
    pub(crate) fn is_near_gap(&self, direction: Vec3) -> bool {
        match self.lie_of(direction) {
            Direction::Plain => false,
            Direction::BesideGap | Direction::InGap => true,
        }
    }

    /// The mirror image of a direction at the plane of the triangle.
    fn mirrored(&self, direction: Vec3) -> Vec3 {
        let normal = self.surface.geometric_normal;
        direction - normal * (2.0 * direction.dot(normal))
    }

    /// Whether light may leave in a direction between the planes.
    fn may_rise(&self, direction: Vec3) -> bool {
        self.around.is_free(&self.surface.way_up(direction))
    }

    /// A direction in the frame, what the BSDF scatters to there, without the cosine, and the
    /// density with which [`Facet::sample`] draws it.
    #[inline]
    pub fn scatter<const N: usize>(
        &self,
        (frame, view): Seen<'_, N>,
        wi_world: Vec3,
    ) -> (Vec3, Scattered<N>) {
        let wi = frame.to_local(wi_world);
        let scattered = view.scatter(wi);
        let all = match self.lie_of(wi_world) {
            Direction::Plain => scattered,
            Direction::BesideGap => self.with_mirrored((frame, view), (wi_world, wi), scattered),
            Direction::InGap if scattered.pdf == 0.0 && scattered.f.is_zero() => scattered,
            Direction::InGap if self.may_rise(wi_world) => scattered,
            Direction::InGap => Scattered::NOTHING,
        };
        (wi, all)
    }

    /// What is scattered in a direction, with the light that is mirrored there.
    #[cold]
    fn with_mirrored<const N: usize>(
        &self,
        (frame, view): Seen<'_, N>,
        (wi_world, wi): (Vec3, Vec3),
        own: Scattered<N>,
    ) -> Scattered<N> {
        let image_world = self.mirrored(wi_world);
        let image = frame.to_local(image_world);
        let mirrored = view.scatter(image);
        if (mirrored.pdf == 0.0 && mirrored.f.is_zero()) || self.may_rise(image_world) {
            return own;
        }
        Scattered {
            f: own.f + mirrored.f * (image.z / wi.z).abs(),
            pdf: own.pdf + mirrored.pdf,
        }
    }

    /// Draws a direction, and gives it in the world; `lobe` chooses the lobe, `u` the direction in
    /// it.
    #[inline]
    pub fn sample<const N: usize>(
        &self,
        (frame, view): Seen<'_, N>,
        lobe: f32,
        u: Vec2,
    ) -> Option<(Vec3, BsdfSample<N>)> {
        let sample = view.sample(lobe, u)?;
        let wi_world = frame.to_world(sample.wi);
        Some(match self.lie_of(wi_world) {
            Direction::Plain => (wi_world, sample),
            Direction::BesideGap | Direction::InGap => self.folded((frame, view), wi_world, sample),
        })
    }

    /// A direction that was drawn near the gap between the planes or in it, mirrored if that must
    /// be, with its density.
    #[cold]
    fn folded<const N: usize>(
        &self,
        seen: Seen<'_, N>,
        drawn: Vec3,
        mut sample: BsdfSample<N>,
    ) -> (Vec3, BsdfSample<N>) {
        let wi_world = self.leaving(drawn);
        let (wi, scattered) = self.scatter(seen, wi_world);
        sample.wi = wi;
        // Of finitely many directions none is drawn in two ways.
        if !sample.specular && scattered.pdf > 0.0 {
            sample.weight = scattered.f * (wi.z.abs() / scattered.pdf);
            sample.pdf = scattered.pdf;
        }
        (wi_world, sample)
    }

    /// The direction in which light leaves that the BSDF sends in one: the same, or its mirror
    /// image.
    #[inline]
    pub fn leaving(&self, direction: Vec3) -> Vec3 {
        if self.surface.is_between_planes(direction) && !self.may_rise(direction) {
            self.mirrored(direction)
        } else {
            direction
        }
    }

    /// The ray that leaves in a direction.
    #[inline]
    pub fn spawn(&self, direction: Vec3) -> Ray {
        if self.surface.is_between_planes(direction) {
            Ray::new(self.surface.raised(direction), direction)
        } else {
            self.surface.spawn(direction)
        }
    }

    /// The same, as [`SurfacePoint::spawn_whole`] gives it.
    #[inline]
    pub fn spawn_whole(&self, direction: Vec3) -> Ray {
        if self.surface.is_between_planes(direction) {
            self.spawn(direction)
        } else {
            self.surface.spawn_whole(direction)
        }
    }

    /// The ray to a point that lies in a direction, as [`SurfacePoint::spawn_to`] gives it.
    #[inline]
    pub fn spawn_to(&self, direction: Vec3, target: Vec3) -> Ray {
        if self.surface.is_between_planes(direction) {
            SurfacePoint::shadow(self.surface.raised(direction), target)
        } else {
            self.surface.spawn_to(target)
        }
    }
}
