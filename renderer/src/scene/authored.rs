//! A scene as its file says it, with names resolved to indices and units to SI. Rigs of lights, plants and
//! leaves that differ are what the file calls them; [`expand`](super::expand) makes shapes and places of
//! them.

use glam::DVec3;
use leafmodel::plant::PlantPlan;

use super::description::{
    self, Camera, Film, Instrument, Integrator, Leaf, Material, Medium, Mesh, Named, Picture, Solid,
};

/// A whole scene.
#[derive(Clone, Debug)]
pub(super) struct Authored {
    /// The scene's name: stem of the default output files.
    pub(super) name: String,
    /// The scene file as written, after overrides.
    pub(super) source: String,
    /// What is recorded.
    pub(super) film: Film,
    /// How the PNG is made from it.
    pub(super) picture: Picture,
    /// The view.
    pub(super) camera: Camera,
    /// How light is followed.
    pub(super) integrator: Integrator,
    /// Media that fill bodies.
    pub(super) media: Vec<Named<Medium>>,
    /// Materials.
    pub(super) materials: Vec<Named<Material>>,
    /// Meshes.
    pub(super) meshes: Vec<Named<Mesh>>,
    /// Leaves.
    pub(super) leaves: Vec<Named<Leaf>>,
    /// Bodies of solid tissue.
    pub(super) solids: Vec<Named<Solid>>,
    /// Plants.
    pub(super) plants: Vec<Named<Plant>>,
    /// Lights and rigs of lights.
    pub(super) lights: Vec<Named<Light>>,
    /// The objects.
    pub(super) objects: Vec<Named<Object>>,
    /// Instruments.
    pub(super) instruments: Vec<Named<Instrument>>,
}

impl Authored {
    /// A scene with nothing in it.
    pub(super) fn empty(name: &str, source: String) -> Self {
        Self {
            name: name.to_owned(),
            source,
            film: Film::usual(),
            picture: Picture::default(),
            camera: Camera::usual(),
            integrator: Integrator::default(),
            media: Vec::new(),
            materials: Vec::new(),
            meshes: Vec::new(),
            leaves: Vec::new(),
            solids: Vec::new(),
            plants: Vec::new(),
            lights: Vec::new(),
            objects: Vec::new(),
            instruments: Vec::new(),
        }
    }
}

/// One of `[lights]`.
#[derive(Clone, Debug)]
pub(super) enum Light {
    /// A single light.
    Single(description::Light),
    /// Several by one name.
    Rig(Rig),
}

/// One of `[objects]`.
#[derive(Clone, Debug)]
pub(super) struct Object {
    /// The plant that it is, index into [`Authored::plants`]; it has no shapes then.
    pub(super) plant: Option<usize>,
    /// Its shapes and places.
    pub(super) placed: description::Object,
}

/// A bough or shoot.
#[derive(Clone, Debug)]
pub(super) struct Plant {
    /// Its numbers.
    pub(super) plan: PlantPlan,
    /// The leaves that it bears, from the foot of each axis to its tip: indices into
    /// [`Authored::leaves`].
    pub(super) leaves: Vec<usize>,
    /// The days of ageing of its youngest and its oldest leaves; `None` leaves them as they are.
    pub(super) days: Option<[f64; 2]>,
    /// What its axes are made of: index into [`Authored::materials`]; `None` is young bark, or
    /// green tissue.
    pub(super) bark: Option<usize>,
    /// The leaves that are the sepals and the petals of its flower: indices into
    /// [`Authored::leaves`].
    pub(super) perianth: [Option<usize>; 2],
    /// The materials of its pot and of the soil in it: indices into [`Authored::materials`];
    /// `None` is fired clay, and soil of the pot's moisture.
    pub(super) potting: [Option<usize>; 2],
    /// The objects on which it climbs: indices into [`Authored::objects`].
    pub(super) walls: Vec<usize>,
}

/// Lights as photographers set them up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rig {
    /// How they stand.
    pub(super) preset: RigPreset,
    /// What is lit, m; `None` is what the camera looks at.
    pub(super) subject: Option<DVec3>,
    /// Size of the subject, m, > 0.
    pub(super) size: f64,
    /// Azimuth in which the camera is taken to look, rad; `None` is that in which it does.
    pub(super) azimuth: Option<f64>,
    /// Light more or less than usual, as a power of 2.
    pub(super) ev: f64,
}

/// The arrangements of lights.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum RigPreset {
    /// Three soft boxes.
    Studio,
    /// A tent of white cloth that is lit from outside.
    Tent,
    /// A light table below and a lamp above.
    Lightbox,
    /// A sky covered with cloud.
    Overcast,
    /// A low sun before the camera.
    GoldenHour,
    /// The sun on open land, a forest behind the subject.
    ForestEdge,
}
