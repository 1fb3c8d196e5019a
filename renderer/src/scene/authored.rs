//! A scene as its file says it, with names resolved to indices and units to SI. Rigs of lights, plants and
//! leaves that differ are what the file calls them; [`expand`](super::expand) makes shapes and places of
//! them.

use glam::DVec3;
use leafmodel::document::coverage::require_coverage;
use leafmodel::document::declared::{Declared, Defaults, Kinds, Words};
use leafmodel::document::names::NameIn;
use leafmodel::document::{Keys, Variant};
use leafmodel::plan_file;
use leafmodel::plant::PlantPlan;

use super::blocks::spectrum::D65_NM;
use super::description::light::constant::Constant;
use super::description::name_list::{IndicesIn, NamesIn};
use super::description::object::refuse_ages_of_one;
use super::description::{
    self, Camera, Film, Instrument, Integrator, Leaf, Material, Medium, Mesh, Named, Picture, Solid,
};
use crate::geometry::instance::COORDINATES_M;

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
            camera: Camera::default(),
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

const RIG: Variant<Rig> = Variant {
    name: "rig",
    about: "Lights as photographers set them up, around what the camera looks at.",
    new: Rig::default,
    is: |_| true,
    declare: Rig::declare,
};

impl Default for Light {
    fn default() -> Self {
        Self::Single(description::Light::Constant(Constant::default()))
    }
}

impl Declared for Light {
    fn declare(&mut self, keys: &mut Keys<'_>) {
        let rig = RIG.within(Self::Rig, |light| match light {
            Self::Single(_) => None,
            Self::Rig(own) => Some(own),
        });
        let kinds = description::Light::KINDS.iter();
        let kinds = kinds.map(|kind| {
            kind.within(Self::Single, |light| match light {
                Self::Single(own) => Some(own),
                Self::Rig(_) => None,
            })
        });
        keys.choose(self, &kinds.chain([rig]).collect::<Vec<_>>());
    }
}

/// One of `[objects]`.
#[derive(Clone, Debug, Default)]
pub(super) struct Object {
    /// The plant that it is, index into [`Authored::plants`]; it has no shapes then.
    pub(super) plant: Option<usize>,
    /// Its shapes and places.
    pub(super) placed: description::Object,
}

/// A bough or shoot.
#[derive(Clone, Debug, Declared, Defaults)]
#[key(last = Self::declare_plan)]
pub(super) struct Plant {
    /// Its numbers.
    #[key(with = Self::declare_preset, default = plan_file::usual_plant())]
    pub(super) plan: PlantPlan,
    /// The leaves that it bears, from the foot of each axis to its tip: indices into
    /// [`Authored::leaves`].
    #[key(with = Self::declare_leaves)]
    pub(super) leaves: Vec<usize>,
    /// Days of ageing of its youngest and its oldest individuals, the others between; young and old stand
    /// mixed. The leaves need `senescence` by `day`.
    ///
    /// `None` leaves them as they are.
    #[key("days", within(plan_file::DAYS))]
    pub(super) days: Option<[f64; 2]>,
    /// What its axes and buds are made of; left out, young brown bark.
    ///
    /// Index into [`Authored::materials`]; `None` is young bark, or green tissue.
    #[key("bark", MATERIAL)]
    pub(super) bark: Option<usize>,
    /// The objects on which it climbs, each a mesh in one place; left out, an even wall.
    ///
    /// Indices into [`Authored::objects`].
    #[key("wall", IndicesIn(NamesIn("objects", "the name of an object")))]
    pub(super) walls: Vec<usize>,
    /// The leaf that is a sepal of its flower.
    #[key("sepal", NameIn("leaves", "the name of a leaf"), at = 0)]
    /// The leaf that is a petal of its flower.
    #[key("petal", NameIn("leaves", "the name of a leaf"), at = 1)]
    pub(super) perianth: [Option<usize>; 2],
    /// What its pot and dish are made of; left out, fired clay.
    #[key("pot_material", MATERIAL, at = 0)]
    /// What the soil in its pot is made of; left out, measured soil of its moisture.
    #[key("soil_material", MATERIAL, at = 1)]
    pub(super) potting: [Option<usize>; 2],
}

const MATERIAL: NameIn = NameIn("materials", "the name of a material");

impl Plant {
    fn declare_preset(&mut self, keys: &mut Keys<'_>) {
        plan_file::plant_preset(&mut self.plan, keys);
    }

    fn declare_leaves(&mut self, keys: &mut Keys<'_>) {
        let kind = IndicesIn(NamesIn("leaves", "the name of a leaf"));
        let about =
            "The leaf that it bears; of a list, those from the foot of each axis to its tip.";
        keys.needed("leaf", &mut self.leaves, kind, about);
    }

    fn declare_plan(&mut self, keys: &mut Keys<'_>) {
        plan_file::plant(&mut self.plan, keys);
        refuse_ages_of_one(self.plan.individuals, self.days, keys);
        if self.plan.flower.is_some() && !self.perianth.iter().all(Option::is_some) {
            let help = "name a leaf as `sepal` and one as `petal`, such as of the presets \
                `trillium-sepal` and `trillium-petal`";
            keys.refuse(&[], "its flower lacks sepals or petals".to_owned(), help);
        }
        if !self.walls.is_empty() && self.plan.climbing.is_none() {
            let help = "give it a block `climbing`, or leave `wall` out";
            keys.refuse(&["wall"], "the plant does not climb".to_owned(), help);
        }
    }
}

/// Lights as photographers set them up.
#[derive(Clone, Copy, Debug, Declared, Defaults, PartialEq)]
#[key(last = require_d65)]
pub(super) struct Rig {
    /// How the lights stand.
    #[key("preset", required, word)]
    pub(super) preset: RigPreset,
    /// What is lit; left out, the point that the camera looks at.
    #[key("subject_m", within(COORDINATES_M))]
    pub(super) subject: Option<DVec3>,
    /// Size of the subject, of which sizes and distances of lamps are multiples.
    #[key("size_m", 1e-4..=1e4, default = 0.1)]
    pub(super) size: f64,
    /// Direction along the ground in which the camera is taken to look, from +x towards +y; left out, that in
    /// which it does.
    #[key("azimuth_deg", degrees(-360.0..=360.0))]
    pub(super) azimuth: Option<f64>,
    /// Light more or less than for a picture with `exposure_ev = 0`, as a power of 2.
    #[key("ev", -30.0..=30.0)]
    pub(super) ev: f64,
}

/// The arrangements of lights.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Words)]
pub(super) enum RigPreset {
    /// Three soft boxes.
    #[default]
    Studio,
    /// A tent of white cloth that is lit from outside.
    Tent,
    /// A light table below and a lamp above.
    Lightbox,
    /// A sky covered with cloud.
    Overcast,
    /// A low sun before the camera.
    #[word("golden-hour")]
    GoldenHour,
    /// The sun on open land, a forest behind the subject.
    #[word("forest-edge")]
    ForestEdge,
}

/// Reports a film that records more than the spectrum of lamps or of an overcast sky, D65, covers.
fn require_d65(rig: &mut Rig, keys: &mut Keys<'_>) {
    let is_day = matches!(rig.preset, RigPreset::GoldenHour | RigPreset::ForestEdge);
    if let Some(block) = keys.reader().filter(|_| !is_day) {
        let at = block.node("preset").map_or(&block.at, |node| &node.at);
        require_coverage(block.cx, at, "the lamps' D65", D65_NM);
    }
}
