//! What scatters a path at a vertex: a surface or a medium.

use glam::{Vec2, Vec3};

use crate::bsdf::{Scattered, View};
use crate::geometry::Geometry;
use crate::geometry::frame::Frame;
use crate::geometry::ray::Ray;
use crate::geometry::surface::SurfacePoint;
use crate::integrator::facet::Facet;
use crate::medium::Phase;
use crate::spectrum::Lanes;

/// What scatters a path.
pub(in crate::integrator) enum Scatterer<'a, const N: usize> {
    /// A surface.
    Surface {
        facet: Facet<'a, Geometry>,
        frame: &'a Frame,
        view: &'a View<'a, N>,
    },
    /// A medium, of the ray that came this way.
    Medium {
        position: Vec3,
        way: Vec3,
        phase: Phase,
    },
}

/// A direction that was drawn.
pub(super) struct Drawn<const N: usize> {
    /// Unit, world.
    pub(super) wi_world: Vec3,
    /// What light from there is multiplied by.
    pub(super) weight: Lanes<N>,
    /// Density over solid angle, sr⁻¹; infinite if it is one of finitely many directions.
    pub(super) pdf: f32,
}

impl<const N: usize> Scatterer<'_, N> {
    /// What light from a direction is multiplied by, sr⁻¹, the cosine of a surface included, and the
    /// density with which the direction is drawn.
    #[inline]
    pub(super) fn scatter(&self, wi_world: Vec3) -> Scattered<N> {
        match self {
            Self::Surface { facet, frame, view } => {
                let (wi, Scattered { f, pdf }) = facet.scatter((frame, view), wi_world);
                Scattered {
                    f: f * wi.z.abs(),
                    pdf,
                }
            }
            Self::Medium { way, phase, .. } => {
                let value = phase.value(way.dot(wi_world));
                Scattered {
                    f: Lanes::splat(value),
                    pdf: value,
                }
            }
        }
    }

    /// Draws a direction; `lobe` chooses the lobe, `u` the direction in it.
    #[inline]
    pub(super) fn sample(&self, lobe: f32, u: Vec2) -> Option<Drawn<N>> {
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
            Self::Medium { way, phase, .. } => {
                let scattering = phase.sample(*way, u);
                Some(Drawn {
                    wi_world: scattering.direction,
                    weight: Lanes::ONE,
                    pdf: scattering.pdf,
                })
            }
        }
    }

    /// The ray that leaves in a direction.
    #[inline]
    pub(super) fn spawn(&self, direction: Vec3) -> Ray {
        match self {
            Self::Surface { facet, .. } => facet.spawn(direction),
            Self::Medium { position, .. } => Ray::new(*position, direction),
        }
    }

    /// The ray to a point that lies in a direction, as [`SurfacePoint::spawn_to`] gives it.
    #[inline]
    pub(super) fn spawn_to(&self, direction: Vec3, target: Vec3) -> Ray {
        match self {
            Self::Surface { facet, .. } => facet.spawn_to(direction, target),
            Self::Medium { position, .. } => SurfacePoint::shadow(*position, target),
        }
    }
}
