//! What scatters a path at a vertex: a surface or a medium.

use glam::{Vec2, Vec3};

use super::facet::{Facet, Surroundings};
use crate::bsdf::{Scattered, View};
use crate::geometry::Geometry;
use crate::geometry::frame::Frame;
use crate::geometry::ray::Ray;
use crate::geometry::surface::SurfacePoint;
use crate::medium::Coefficients;
use crate::spectrum::Lanes;

/// What scatters a path.
#[derive(Debug)]
pub enum Scatterer<'a, const N: usize, S = Geometry> {
    /// A surface.
    Surface {
        /// The place.
        facet: Facet<'a, S>,
        /// Its frame.
        frame: &'a Frame,
        /// The BSDF as it is seen from where light comes.
        view: &'a View<'a, N>,
    },
    /// A medium, of the ray that came this way.
    Medium {
        /// Where it is.
        position: Vec3,
        /// Direction of the ray.
        way: Vec3,
        /// Where light goes that is scattered.
        medium: Coefficients<N>,
    },
}

/// A direction that was drawn.
#[derive(Debug)]
pub struct Drawn<const N: usize> {
    /// Unit, world.
    pub wi_world: Vec3,
    /// What light from there is multiplied by.
    pub weight: Lanes<N>,
    /// Density over solid angle, sr⁻¹; infinite if it is one of finitely many directions.
    pub pdf: f32,
}

impl<const N: usize, S: Surroundings> Scatterer<'_, N, S> {
    /// What light from a direction is multiplied by, sr⁻¹, the cosine of a surface included, and the
    /// density with which the direction is drawn.
    #[inline]
    pub fn scatter(&self, wi_world: Vec3) -> Scattered<N> {
        match self {
            Self::Surface { facet, frame, view } => {
                let (wi, Scattered { f, pdf }) = facet.scatter((frame, view), wi_world);
                Scattered {
                    f: f * wi.z.abs(),
                    pdf,
                }
            }
            Self::Medium { way, medium, .. } => medium.turned_to(*way, wi_world),
        }
    }

    /// Draws a direction; `lobe` chooses the lobe, `u` the direction in it.
    #[inline]
    pub fn sample(&self, lobe: f32, u: Vec2) -> Option<Drawn<N>> {
        match self {
            Self::Surface { facet, frame, view } => {
                let (wi_world, sample) = facet.sample((frame, view), lobe, u)?;
                Some(Drawn {
                    wi_world,
                    weight: sample.weight,
                    pdf: if sample.specular {
                        f32::INFINITY
                    } else {
                        sample.pdf
                    },
                })
            }
            Self::Medium { way, medium, .. } => {
                let (scattering, weight) = medium.turn(*way, lobe, u);
                Some(Drawn {
                    wi_world: scattering.direction,
                    weight,
                    pdf: scattering.pdf,
                })
            }
        }
    }

    /// The ray that leaves in a direction.
    #[inline]
    pub fn spawn(&self, direction: Vec3) -> Ray {
        match self {
            Self::Surface { facet, .. } => facet.spawn(direction),
            Self::Medium { position, .. } => Ray::new(*position, direction),
        }
    }

    /// The ray to a point that lies in a direction, as [`SurfacePoint::spawn_to`] gives it.
    #[inline]
    pub fn spawn_to(&self, direction: Vec3, target: Vec3) -> Ray {
        match self {
            Self::Surface { facet, .. } => facet.spawn_to(direction, target),
            Self::Medium { position, .. } => SurfacePoint::shadow(*position, target),
        }
    }
}
