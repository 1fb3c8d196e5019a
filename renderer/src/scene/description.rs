//! A scene as shapes and places, with names resolved to indices and units to SI: plain data, before
//! anything is built.
//!
//! Both the tracer ([`super::world`]) and the exporters read this, so that both programs get the
//! same input. `scene::expand` makes it of what the file says.

mod camera;
pub(in crate::scene) mod instrument;
mod light;
mod material;
mod medium;
mod mesh;
pub(in crate::scene) mod name_list;
pub(in crate::scene) mod object;
mod reflectance;

use std::sync::Arc;

use leafmodel::blade::stalk::StalkMesh;
use leafmodel::document::declared::{Declared, Defaults};
pub use leafmodel::document::names::Named;
use leafmodel::leaf::LeafPlan;
use leafmodel::solid::SolidPlan;

use crate::film::MOST_SAMPLES;
use crate::sampling::dimensions::MOST_EVENTS;
use crate::scene::model::Wanted;

pub use self::camera::{Camera, FocusObject};
pub use self::instrument::{
    Amount, Canopy, DepthProfile, Detector, Estimator, ExcitationLight, FluorescenceReading, Gonio,
    Incidence, Incident, Index, Instrument, InstrumentKind, Response, Sample, Spot, SpotMiddle,
};
pub use self::light::{AreaPattern, Light};
pub use self::material::{
    Coat, Fluorescence, Held, LeafFaces, LeafOptics, LeafTissue, Material, SolidOptics,
};
pub use self::medium::{Medium, MediumPhase};
pub use self::mesh::{FileMesh, Mesh};
pub use self::object::{InstancePlace, Object, ObjectShape, StrewnOn};
pub use self::reflectance::Reflectance;
pub use crate::image::display::Display as Picture;
pub use crate::image::pixels::Depth;
pub use crate::image::tone::Tone;
pub use crate::image::white::White;
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
    /// What is used of the mesh with this number besides its triangles.
    pub fn wanted_of(&self, mesh: usize) -> Wanted {
        let materials = self.materials.iter().map(|named| &named.value);
        let of_it = materials.filter(|material| material.colours_of() == Some(mesh));
        let emission = self
            .lights
            .iter()
            .filter_map(|light| light.value.emitting_object())
            .any(|object| self.objects[object].value.first_mesh() == Some(mesh));
        let nothing = Wanted {
            emission,
            ..Wanted::default()
        };
        of_it.fold(nothing, |wanted, material| Wanted {
            colours: true,
            finishes: wanted.finishes || matches!(material, Material::Model { .. }),
            emission,
        })
    }
}

/// What is recorded, and how well.
#[derive(Clone, Debug, Declared)]
pub struct Film {
    /// Pixels across.
    #[key(with = Self::declare_size)]
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Samples a pixel; with `noise` the most.
    #[key("spp", required, 1..=MOST_SAMPLES.into())]
    pub spp: u32,
    /// Relative error at which a part of the picture has enough samples; `None` if all parts get
    /// the same number.
    #[key(with = Self::declare_noise)]
    pub noise: Option<f64>,
    /// Seed of every random number; same file, same seed, same bytes.
    #[key("seed")]
    pub seed: u64,
    /// Radius of the Gaussian reconstruction filter; 0 is a box of one pixel, which keeps pixels
    /// independent of each other.
    ///
    /// In pixels.
    #[key("filter_radius_px", 0.0..=8.0)]
    pub filter_radius: f64,
    /// Colour or bands.
    pub kind: FilmKind,
}

/// How light is followed.
///
/// Where a number is `None`, there is no limit, or a trial decides.
#[derive(Clone, Copy, Debug, Declared, Defaults)]
pub struct Integrator {
    /// Most scattering events of a path. A limit darkens the picture: in the infrared, where leaves
    /// hardly absorb, a limit of 8 loses some 2 %. How many paths it cuts is reported.
    #[key("max_depth", 1..=100_000)]
    pub max_depth: Option<u32>,
    /// Events after which a path is cut, in pictures and in instruments: scatterings, flights through
    /// media, and ways between scatterings in a leaf of layers. It is for light that is caught. How many
    /// paths were cut is reported, and how much light that may lose.
    ///
    /// Roulette ends paths long before, unless light is caught in what absorbs nothing, as in a medium so
    /// dense that its free paths are below the precision of places.
    #[key("max_events", 1..=u64::from(MOST_EVENTS), default = 100_000)]
    pub max_events: u32,
    /// Paths of whose light less than this share can reach the film may end by Russian roulette, without
    /// bias; 0 switches it off. On a film of colour the share is what the eye sees, on bands their mean,
    /// at least a quarter of the brightest. Higher is faster and noisier.
    #[key("roulette_below", 0.0..=1.0)]
    pub roulette_below: Option<f64>,
    /// Paths that go on from what the camera sees first, where none of the lights that are sampled
    /// (suns, lamps, sky pictures) reaches it. More is slower and less noisy, in shade.
    #[key("branches", 1..=64)]
    pub branches: Option<u32>,
    /// Paths that go on from there where such a light reaches it. More is slower and less noisy, above
    /// all close to leaves in the sun.
    #[key("lit_branches", 1..=64)]
    pub lit_branches: Option<u32>,
    /// Samples of lamps and sky pictures at what the camera sees first; suns have one each. More is
    /// slower and less noisy where lamps cast soft shadows.
    #[key("light_samples", 1..=64)]
    pub light_samples: Option<u32>,
    /// Whether skies and environment pictures are sampled as lamps are; if not, paths find them where
    /// they leave the scene. Without is faster, and noisier where little of a sky sends much of its
    /// light.
    #[key("sample_skies")]
    pub sample_skies: Option<bool>,
}

/// What a scene's triangles are made from.
#[derive(Clone, Debug)]
pub enum Shape {
    /// A mesh of the file.
    Mesh(Mesh),
    /// The axes of a plant, or other bodies of it, mm.
    Body(Arc<StalkMesh>),
}

/// A grown leaf: mesh, content maps and coats.
#[derive(Clone, Debug)]
pub struct Leaf {
    /// The plan from which it is grown.
    pub plan: LeafPlan,
    /// The properties of its faces.
    pub faces: LeafFaces,
    /// How its chlorophyll fluoresces; `None` if it does not.
    pub fluorescence: Option<Fluorescence>,
    /// Factor on the distance over which light that the blade lets through spreads sideways, ≥ 0.
    pub light_spread: f64,
    /// Whether PROSPECT's table is continued by its end values outside 400–2500 nm.
    pub extrapolate: bool,
}

/// A grown body of solid tissue: mesh and map of contents.
#[derive(Clone, Debug)]
pub struct Solid {
    /// The plan from which it is grown.
    pub plan: SolidPlan,
    /// The optics of the tissue.
    pub optics: SolidOptics,
    /// Whether PROSPECT's table is continued by its end values outside 400–2500 nm.
    pub extrapolate: bool,
}
