//! A scene as shapes and places, with names resolved to indices and units to SI: plain data, before
//! anything is built.
//!
//! Both the tracer ([`super::world`]) and the exporters read this, so that both programs get the
//! same input. `scene::expand` makes it of what the file says.

mod camera;
pub mod film;
mod grown;
pub(in crate::scene) mod instrument;
pub mod layer;
pub mod light;
pub mod material;
mod medium;
mod mesh;
pub(in crate::scene) mod name_list;
pub(in crate::scene) mod object;
pub mod reflectance;
pub mod tissue;

use std::sync::Arc;

use leafmodel::blade::stalk::StalkMesh;
pub use leafmodel::document::names::Named;

use crate::light::Light as BuiltLight;
use crate::scene::model::Wanted;

pub use self::camera::{Camera, FocusError, Places};
pub use self::film::Film;
pub use self::grown::{Leaf, Solid};
pub use self::instrument::{
    Amount, Canopy, DepthProfile, Detector, Estimator, ExcitationLight, FluorescenceReading, Gonio,
    Incidence, Incident, Index, Instrument, InstrumentKind, Response, Sample, Spot, SpotMiddle,
};
pub use self::light::Light;
pub use self::material::Material;
pub use self::medium::{Foliage, Medium, MediumPhase};
pub use self::mesh::{FileMesh, Mesh};
pub use self::object::{InstancePlace, Object, ObjectShape, StrewnOn};
pub use self::reflectance::Reflectance;
pub use self::tissue::{Coat, Fluorescence, Held, LeafFaces, LeafOptics, SolidOptics};
pub use crate::image::display::Display as Picture;
pub use crate::image::pixels::Depth;
pub use crate::image::tone::Tone;
pub use crate::image::white::White;
pub use crate::integrator::settings::Integrator;
pub use crate::light::daylight::Daylight;
pub use crate::material::colour_map::Wrap;
pub use crate::spectrum::recorded::{Band, FilmKind};
pub use crate::spectrum::written::Spectrum;

/// A whole scene.
#[derive(Clone, Debug)]
pub struct Description {
    /// The scene's name: stem of the default output files.
    pub name: String,
    /// The scene file as written, after overrides.
    pub source: String,
    /// What is recorded.
    pub film: Film,
    /// How the PNG is made from it.
    pub picture: Picture,
    /// The view.
    pub camera: Camera,
    /// How light is followed.
    pub integrator: Integrator,
    /// Media that fill bodies, in the file's order.
    pub media: Vec<Named<Medium>>,
    /// Materials, in the file's order.
    pub materials: Vec<Named<Material>>,
    /// Meshes, in the file's order, then those of rigs and plants.
    pub meshes: Vec<Named<Shape>>,
    /// Leaves that are grown, in the file's order, then further individuals.
    pub leaves: Vec<Named<Leaf>>,
    /// Bodies of solid tissue that are grown, in the file's order.
    pub solids: Vec<Named<Solid>>,
    /// Lights, in the file's order, those of a rig in its place.
    pub lights: Vec<Named<Light>>,
    /// The objects, those of rigs last.
    pub objects: Vec<Named<Object>>,
    /// Instruments, in the file's order.
    pub instruments: Vec<Named<Instrument>>,
    /// Plants of which some leaves cut another one or an axis: how many, and how many leaves they have.
    pub crossing: Vec<Named<[usize; 2]>>,
}

impl Description {
    /// Each light with those of the tracer that were built of it, given all of these.
    pub(crate) fn with_built<'a>(
        &'a self,
        built: &'a [BuiltLight],
    ) -> impl Iterator<Item = (&'a Named<Light>, &'a [BuiltLight])> {
        let mut rest = built;
        self.lights.iter().map(move |named| {
            let (own, others) = rest.split_at(named.value.parts());
            rest = others;
            (named, own)
        })
    }

    /// What is used of the mesh with this number besides its triangles.
    pub fn wanted_of(&self, mesh: usize) -> Wanted {
        let materials = self.materials.iter().map(|named| &named.value);
        let mut of_it = materials.filter(|material| material.colours_of() == Some(mesh));
        let emission = self
            .lights
            .iter()
            .filter_map(|light| light.value.emitting_object())
            .any(|object| self.objects[object].value.first_mesh() == Some(mesh));
        Wanted {
            colours: of_it.clone().next().is_some(),
            finishes: of_it.any(|material| matches!(material, Material::Model(_))),
            emission,
        }
    }
}

/// What a scene's triangles are made from.
#[derive(Clone, Debug)]
pub enum Shape {
    /// A mesh of the file.
    Mesh(Mesh),
    /// The axes of a plant, or other bodies of it, mm.
    Body(Arc<StalkMesh>),
}
