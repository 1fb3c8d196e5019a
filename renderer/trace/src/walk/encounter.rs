//! The point where a ray meets a surface, and how light is scattered there.

use glam::{Vec2, Vec3};

use super::cone::{self, Cone};
use super::facet::{self, Facet, Surroundings};
use crate::bsdf::Bsdf;
use crate::geometry::frame::Frame;
use crate::geometry::ray::Ray;
use crate::geometry::surface::SurfacePoint;
use crate::geometry::{Geometry, Hit};
use crate::material::Material;
use crate::spectrum::Wavelengths;

/// The point where a ray meets a surface.
#[derive(Clone, Debug)]
pub struct Encounter<'m, const N: usize> {
    /// The point.
    pub surface: SurfacePoint,
    /// The frame of the BSDF: +z the shading normal, +y where v grows.
    pub frame: Frame,
    /// Scattering there, the relief of the faces included.
    pub bsdf: Bsdf<'m, N>,
    /// Direction from which the ray came, away from the surface, local; +z is the side of the
    /// triangle that is that of the shading normal ([`facet::arriving`]).
    pub wo: Vec3,
    /// Width of the ray there, m.
    pub width: f32,
    /// Whether the material has a relief or a map of normals.
    pub has_relief: bool,
}

/// The axes of a map of normals in the frame of a BSDF: those of the mesh's tangents, or else those
/// along which u and v grow.
fn map_axes(geometry: &Geometry, hit: &Hit, frame: &Frame) -> [Vec2; 2] {
    let given = geometry.tangent(hit).and_then(|(tangent, sign)| {
        let x = frame.to_local(tangent).truncate().try_normalize()?;
        Some([x, x.perp() * sign])
    });
    given.unwrap_or_else(|| {
        let scale = geometry.texture_scale(hit);
        let is_mirrored = scale.is_some_and(|scale| scale.is_mirrored);
        [if is_mirrored { -Vec2::X } else { Vec2::X }, Vec2::Y]
    })
}

impl<'m, const N: usize> Encounter<'m, N> {
    /// The encounter of a ray, with its cone, at a hit of a surface of this material.
    #[inline]
    pub fn new(
        geometry: &Geometry,
        material: &'m Material,
        (ray, cone): (&Ray, &Cone),
        hit: &Hit,
        wavelengths: &Wavelengths<N>,
    ) -> Self {
        let surface = geometry.surface(hit);
        let frame = surface.frame();
        let width = cone.width_at(hit.t);
        // What maps hold is asked for first and used last: it is on its way from memory meanwhile.
        let relief = material.relief().map(|relief| {
            let scale = geometry.texture_scale(hit);
            let facing = ray.direction().dot(surface.shading_normal);
            let footprint = cone::footprint(width, facing);
            (relief, relief.seen(surface.uv, scale, footprint))
        });
        let mut site = material.site(surface.uv, wavelengths);
        if material.is_tinted() {
            site.tint = geometry.colour(hit);
        }
        if material.has_normals() {
            site.map_axes = map_axes(geometry, hit, &frame);
        }
        let relieved =
            relief.map(|(relief, seen)| (relief.faces(&seen), relief.grains(wavelengths)));
        // Made where it stays: a BSDF is large.
        let mut encounter = Self {
            bsdf: material.bsdf_at(&site, wavelengths),
            wo: facet::arriving(&surface, &frame, ray.direction()),
            width,
            has_relief: relieved.is_some() || material.has_normals(),
            frame,
            surface,
        };
        if let Some((faces, grains)) = relieved {
            encounter.bsdf = encounter.bsdf.with_relief(faces, grains);
        }
        encounter
    }

    /// The place, from where light leaves.
    #[inline]
    pub fn facet<'e, S: Surroundings>(&'e self, around: &'e S) -> Facet<'e, S> {
        Facet {
            around,
            surface: &self.surface,
        }
    }
}
