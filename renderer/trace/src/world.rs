//! What rays meet: the finished scene, immutable and shared by all threads.

mod objects;

pub use self::objects::{WorldObject, WorldObjects};
use crate::camera::Camera;
use crate::camera::filter::PixelFilter;
use crate::geometry::Geometry;
use crate::integrator::settings::Integrator;
use crate::light::Light;
use crate::light::selection::Selections;
use crate::material::Material;
use crate::medium::Media;
use crate::spectrum::WavelengthSampler;

/// Everything that paths need.
#[derive(Debug)]
pub struct World {
    /// The placed surfaces. Its [origin](Geometry::origin) is also that of the lights and the
    /// camera.
    pub geometry: Geometry,
    /// The object, material and light of each instance of the geometry.
    pub objects: WorldObjects,
    /// Materials: the scene's, then those of each grown leaf, then that of each grown body.
    pub materials: Vec<Material>,
    /// The media that fill bodies.
    pub media: Media,
    /// Lights, in the scene's order; daylight is two, sun and sky.
    pub lights: Vec<Light>,
    /// The selection of lights for sampling.
    pub selections: Selections,
    /// The camera.
    pub camera: Camera,
    /// The pixel filter.
    pub filter: PixelFilter,
    /// Settings of the integrator.
    pub integrator: Integrator,
    /// The wavelengths of paths.
    pub wavelengths: WavelengthSampler,
    /// A radiance that lights exceed nowhere, W m⁻² sr⁻¹ nm⁻¹; infinite if one has no extent.
    pub brightest: f32,
    /// Whether any of its materials fluoresces.
    pub fluoresces: bool,
}

impl World {
    /// The material of an instance.
    pub fn material_of(&self, instance: u32) -> &Material {
        &self.materials[self.objects[instance as usize].material]
    }
}
