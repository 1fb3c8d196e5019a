//! Media, and the bodies that they fill.

use std::cell::RefCell;
use std::collections::BTreeMap;

use glam::Vec3;

use super::error::WorldError;
use super::placing::MaterialOwner;
use crate::geometry::{Geometry, Instance, Ray, TriangleMesh};
use crate::medium::{Body, Inside, Media, Medium, Phase};
use crate::scene::description::{self, Description, Foliage, MediumPhase};
use crate::spectrum::{Curve, WavelengthGrid};
use trace::world::{WorldObject, WorldObjects};

/// Surfaces after which the search for the bodies around the camera ends.
const MOST_SURFACES: u32 = 100_000;

/// The scene's media.
pub(super) fn build_media(scene: &Description, grid: &WavelengthGrid) -> Media {
    let media = scene.media.iter().map(|named| {
        let description::Medium {
            absorption,
            scattering,
            phase,
            g,
            leaves,
        } = &named.value;
        let phase = match phase {
            MediumPhase::HenyeyGreenstein => Phase::HenyeyGreenstein { g: *g as f32 },
            MediumPhase::Rayleigh => Phase::Rayleigh,
        };
        let curve = Curve::from_description;
        let mut medium = match leaves {
            Some(Foliage {
                area,
                inclination,
                reflectance,
                transmittance,
            }) => Medium::of_leaves(
                *area as f32,
                inclination,
                [reflectance, transmittance].map(curve),
            ),
            None => Medium::new(curve(absorption), curve(scattering), phase),
        };
        medium.tabulate(grid);
        medium
    });
    let mut materials = scene.materials.iter();
    Media {
        media: media.collect(),
        are_present: materials.any(|named| named.value.is_transparent_to_paths()),
        around_camera: Inside::default(),
    }
}

/// Finds out which instances are drops: of a shape without a base, of a dielectric.
pub(super) fn set_drops(
    objects: &mut WorldObjects,
    scene: &Description,
    owners: &[MaterialOwner],
    instances: &[Instance],
) {
    objects.set_drops(|number, WorldObject { material, .. }| {
        let mesh = scene.meshes.get(instances[number].mesh as usize)?;
        let MaterialOwner::Scene(material) = owners[material] else {
            return None;
        };
        match (&mesh.value, &scene.materials[material].value) {
            (
                description::Shape::Mesh(description::Mesh::Drop(_)),
                description::Material::Dielectric(own),
            ) => Some(own.eta as f32).filter(|eta| *eta != 1.0),
            _ => None,
        }
    });
}

/// Finds out which instances are bodies to rays. A dielectric without a medium is one if it is
/// closed: inside it there is no medium, whatever is around it.
pub(super) fn set_bodies(
    objects: &mut WorldObjects,
    scene: &Description,
    owners: &[MaterialOwner],
    (meshes, instances): (&[TriangleMesh], &[Instance]),
) -> Result<(), WorldError> {
    let closed = RefCell::new(BTreeMap::new());
    objects.set_bodies(
        |number,
         WorldObject {
             object, material, ..
         }| {
            let MaterialOwner::Scene(material) = owners[material] else {
                return Ok(None);
            };
            let named = &scene.materials[material];
            let Some(boundary) = named.value.boundary() else {
                return Ok(None);
            };
            let mesh = instances[number].mesh;
            let is_closed = *closed
                .borrow_mut()
                .entry(mesh)
                .or_insert_with(|| meshes[mesh as usize].encloses_a_body());
            let is_matched = boundary.eta == 1.0;
            match boundary.interior {
                Some(_) if !is_closed => Err(WorldError::OpenBody {
                    object: scene.objects[object].name.clone(),
                    material: named.name.clone(),
                }),
                None if !is_closed && !is_matched => Ok(None),
                medium => Ok(Some(Body {
                    medium: medium.map(|medium| medium as u32),
                    is_matched,
                    is_closed,
                })),
            }
        },
    )
}

/// The bodies in which a point lies: those that a ray from there leaves without having entered
/// them, of which it leaves the innermost first.
pub(super) fn around(point: Vec3, geometry: &Geometry, objects: &WorldObjects) -> Inside {
    // In no direction in which faces of shapes are likely to lie.
    let direction = Vec3::new(0.283_7, -0.529_1, 0.799_7).normalize();
    let mut ray = Ray::new(point, direction);
    let (mut left, mut entered) = (Vec::new(), Vec::new());
    for _ in 0..MOST_SURFACES {
        let Some(hit) = geometry.intersect(&ray) else {
            break;
        };
        let surface = geometry.surface(&hit);
        if let Some(body) = objects[hit.instance as usize].body {
            let place = objects.body_place(hit.instance);
            if direction.dot(surface.geometric_normal) < 0.0 {
                entered.push(place);
            } else if let Some(number) = entered.iter().position(|own| *own == place) {
                entered.swap_remove(number);
            } else {
                left.push((place, body));
            }
        }
        ray = surface.spawn(direction);
    }
    let mut inside = Inside::default();
    for (place, body) in left.into_iter().rev() {
        inside.leave_boundary(place, body, Vec3::Z, Vec3::NEG_Z);
    }
    inside
}
