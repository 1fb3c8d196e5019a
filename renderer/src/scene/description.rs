//! A scene with names resolved to indices and units to SI: plain data, before anything is built.
//!
//! Both the tracer ([`super::world`]) and the exporters read this, so that both programs get the
//! same input.

mod camera;
mod instrument;
mod medium;
mod object;
mod reflectance;

use std::path::PathBuf;
use std::sync::Arc;

use glam::DVec3;
use leafmodel::blade::stalk::StalkMesh;
pub use leafmodel::document::names::Named;
use leafmodel::leaf::LeafPlan;
use leafmodel::optics::Pigments;
use leafmodel::plant::PlantPlan;
use leafmodel::solid::SolidPlan;

pub use self::camera::{Camera, FocusObject};
pub use self::instrument::{
    Amount, Canopy, DepthProfile, Detector, Estimator, ExcitationLight, FluorescenceReading, Gonio,
    Incidence, Incident, Index, Instrument, InstrumentKind, Response, Sample, Spot, SpotMiddle,
};
pub use self::medium::{Medium, MediumPhase};
pub use self::object::{InstancePlace, Object, ObjectShape, StrewnOn};
pub use self::reflectance::Reflectance;
pub use crate::geometry::shapes::{Drop, Lump, Masonry, MasonryPart, Terrain};
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
    /// Meshes, in the file's order.
    pub meshes: Vec<Named<Mesh>>,
    /// Leaves that are grown, in the file's order.
    pub leaves: Vec<Named<Leaf>>,
    /// Bodies of solid tissue that are grown, in the file's order.
    pub solids: Vec<Named<Solid>>,
    /// Plants, in the file's order. Where objects are plants, their leaves, axes and bark stand
    /// behind those of the file.
    pub plants: Vec<Named<Plant>>,
    /// Lights, in the file's order.
    pub lights: Vec<Named<Light>>,
    /// The objects.
    pub objects: Vec<Named<Object>>,
    /// Instruments, in the file's order.
    pub instruments: Vec<Named<Instrument>>,
}

impl Material {
    /// What it holds, if it is tissue whose contents are known.
    pub fn held(&self) -> Option<&Held> {
        match self {
            Self::Leaf {
                tissue: LeafTissue::Held(held),
                ..
            }
            | Self::Solid { held, .. } => Some(held),
            Self::Diffuse { .. }
            | Self::Dielectric { .. }
            | Self::Plastic { .. }
            | Self::Leaf { .. } => None,
        }
    }
}

impl Material {
    /// Whether paths need to know on which side of it they are: it bounds a medium, or it is no
    /// boundary for light at all.
    pub fn is_transparent_to_paths(&self) -> bool {
        match self {
            Self::Dielectric { eta, interior, .. } => interior.is_some() || *eta == 1.0,
            Self::Diffuse { .. }
            | Self::Plastic { .. }
            | Self::Leaf { .. }
            | Self::Solid { .. } => false,
        }
    }
}

impl Held {
    /// Whether PROSPECT's table is continued by its end values outside 400–2500 nm.
    pub fn extrapolates(&self) -> bool {
        match self {
            Self::Contents { extrapolate, .. } | Self::Map { extrapolate, .. } => *extrapolate,
        }
    }
}

impl Description {
    /// Whether a material takes the colours of the mesh with this number.
    pub fn wants_colours_of(&self, mesh: usize) -> bool {
        let mut reflectances = self
            .materials
            .iter()
            .filter_map(|named| named.value.reflectance());
        reflectances.any(|reflectance| match reflectance {
            Reflectance::OfMesh(of) => *of == mesh,
            Reflectance::Even(_) | Reflectance::Picture { .. } => false,
        })
    }

    /// A scene with nothing in it.
    pub(crate) fn empty(name: &str, source: String) -> Self {
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

/// What is recorded, and how well.
#[derive(Clone, Debug)]
pub struct Film {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Samples per pixel, or their greatest number if there is a target noise.
    pub spp: u32,
    /// Relative error at which a part of the picture has enough samples; `None` if all parts get
    /// the same number.
    pub noise: Option<f64>,
    /// Seed of every random number.
    pub seed: u64,
    /// Radius of the Gaussian reconstruction filter in pixels; 0 is a box of one pixel.
    pub filter_radius: f64,
    /// Colour or bands.
    pub kind: FilmKind,
}

/// How light is followed.
#[derive(Clone, Copy, Debug, Default)]
pub struct Integrator {
    /// Greatest number of scattering events of a path; `None` is no limit.
    pub max_depth: Option<u32>,
    /// Throughput below which Russian roulette is applied; 0 switches it off, `None` leaves it to a
    /// trial.
    pub roulette_below: Option<f64>,
    /// Number of paths that continue from the first vertex if no sampled light reaches it; `None`
    /// leaves it to a trial.
    pub branches: Option<u32>,
    /// Number of light samples at the first vertex; `None` leaves it to a trial.
    pub light_samples: Option<u32>,
}

/// A material.
#[derive(Clone, Debug)]
pub enum Material {
    /// Lambertian.
    Diffuse {
        /// Its reflectance.
        reflectance: Reflectance,
    },
    /// A smooth or rough (GGX) boundary of a transparent medium.
    Dielectric {
        /// Refractive index inside over outside.
        eta: f64,
        /// GGX roughness; 0 is smooth.
        roughness: f64,
        /// What fills the body, index into [`Description::media`]; `None` is clear.
        interior: Option<usize>,
    },
    /// A diffuse body below a rough dielectric coat.
    Plastic {
        /// Reflectance of the body, for light that has passed the coat.
        reflectance: Reflectance,
        /// Refractive index of the coat.
        eta: f64,
        /// Its GGX roughness.
        roughness: f64,
    },
    /// A leaf of uniform contents or measured spectra (grown leaves bring their own maps).
    Leaf {
        /// Its tissue, which determines R and T.
        tissue: LeafTissue,
        /// The kinds of pigments of its contents.
        pigments: Box<Pigments>,
        /// The properties of its faces.
        faces: LeafFaces,
        /// How its chlorophyll fluoresces; `None` if it does not.
        fluorescence: Option<Fluorescence>,
    },
    /// Solid tissue of uniform contents or a map (grown bodies bring their own maps).
    Solid {
        /// Its contents.
        held: Held,
        /// The kinds of pigments of its contents.
        pigments: Box<Pigments>,
        /// The optics of the tissue.
        optics: SolidOptics,
    },
}

/// How light is scattered by a leaf.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LeafOptics {
    /// At its surface, by the leaf BSDF of the plate model.
    #[default]
    Plates,
    /// On its way through five layers, which it may leave beside the place where it entered.
    Layers,
}

/// The two faces of a leaf, grown or of a material.
#[derive(Clone, Debug)]
pub struct LeafFaces {
    /// How light is scattered.
    pub optics: LeafOptics,
    /// Abaxial over adaxial reflectance; none if it follows what the leaf absorbs.
    pub abaxial_ratio: Option<Spectrum>,
    /// Adaxial and abaxial coat.
    pub coats: [Coat; 2],
}

/// Chlorophyll fluorescence of a leaf.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fluorescence {
    /// Photons emitted for each photon that chlorophyll absorbs, in (0, 1].
    pub quantum_efficiency: f64,
}

/// Contents of tissue per area of its surface.
#[derive(Clone, Debug)]
pub enum Held {
    /// Uniform contents.
    Contents {
        /// The contents.
        contents: leafmodel::optics::Contents,
        /// Whether PROSPECT's table is continued by its end values outside 400–2500 nm.
        extrapolate: bool,
    },
    /// Contents read from a map: an EXR with a channel for each
    /// [`leafmodel::optics::Constituent`].
    Map {
        /// The map's file, resolved and inside the scene's folder.
        file: PathBuf,
        /// Whether PROSPECT's table is continued by its end values outside 400–2500 nm.
        extrapolate: bool,
    },
}

/// The optics of solid tissue.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolidOptics {
    /// Depth, scattering and refractive index, in range.
    pub tissue: leafmodel::optics::solid::Solid,
    /// The skin's surface, the same in all directions.
    pub coat: Coat,
}

/// The tissue of a leaf, which determines R and T.
#[derive(Clone, Debug)]
pub enum LeafTissue {
    /// PROSPECT-D of contents.
    Held(Held),
    /// Measured spectra.
    Measured {
        /// Directional–hemispherical reflectance, adaxial face.
        reflectance: Spectrum,
        /// Directional–hemispherical transmittance.
        transmittance: Spectrum,
    },
}

/// The rough dielectric coat of one face of a leaf.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coat {
    /// Refractive index.
    pub eta: f64,
    /// GGX roughness across the main vein.
    pub alpha_across: f64,
    /// GGX roughness along the main vein.
    pub alpha_along: f64,
}

/// A shape.
#[derive(Clone, Debug)]
pub enum Mesh {
    /// A rectangle in the xy plane around the origin, normal +z, uv from 0 to 1.
    Rectangle {
        /// Extent along x, m.
        width: f64,
        /// Extent along y, m.
        height: f64,
    },
    /// A sphere around the origin, as triangles.
    Sphere {
        /// Radius, m.
        radius: f64,
        /// Triangles around the equator and half as many from pole to pole.
        segments: u32,
    },
    /// A closed box around the origin.
    Box {
        /// Extent along x, y and z, m.
        size: [f64; 3],
    },
    /// A disc in the xy plane around the origin, normal +z, uv from 0 to 1 over the square around
    /// it.
    Disc {
        /// Radius of the disc that has its area, m.
        radius: f64,
        /// Corners.
        segments: u32,
    },
    /// A drop of water on z = 0.
    Drop(Drop),
    /// A pebble or crumb around the origin.
    Lump(Lump),
    /// Uneven ground around the origin.
    Terrain(Terrain),
    /// A wall of bricks.
    Masonry(Masonry),
    /// A PLY or OBJ file, resolved and inside the scene's folder.
    File {
        /// The file.
        file: PathBuf,
        /// Metres per unit of the file.
        scale: f64,
    },
    /// A glTF 2.0 file, resolved and inside the scene's folder.
    Gltf {
        /// The file.
        file: PathBuf,
        /// The files that it names, as written there and resolved.
        beside: Vec<(String, PathBuf)>,
        /// Metres per unit of the file.
        scale: f64,
    },
    /// The axes of a plant, or other bodies of it, mm.
    Axes(Arc<StalkMesh>),
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

/// A bough or shoot.
#[derive(Clone, Debug)]
pub struct Plant {
    /// Its numbers.
    pub plan: PlantPlan,
    /// The leaves that it bears, from the foot of each axis to its tip: indices into
    /// [`Description::leaves`].
    pub leaves: Vec<usize>,
    /// What its axes are made of: index into [`Description::materials`]; `None` is young bark, or
    /// green tissue.
    pub bark: Option<usize>,
    /// The leaves that are the sepals and the petals of its flower: indices into
    /// [`Description::leaves`].
    pub perianth: [Option<usize>; 2],
    /// The materials of its pot and of the soil in it: indices into [`Description::materials`];
    /// `None` is fired clay, and soil of the pot's moisture.
    pub potting: [Option<usize>; 2],
    /// The objects on which it climbs: indices into [`Description::objects`].
    pub walls: Vec<usize>,
    /// Once it is grown: how many of its leaves cut another one or an axis, and how many it has;
    /// `None` where that was not looked at.
    pub crossing: Option<[usize; 2]>,
}

/// A light.
#[derive(Clone, Debug)]
pub enum Light {
    /// A disc at infinity, like the sun.
    Distant {
        /// Unit vector towards the light.
        towards: DVec3,
        /// Angular diameter of the disc, rad, > 0.
        angular_diameter: f64,
        /// Irradiance on a surface facing it, W m⁻² nm⁻¹.
        irradiance: Spectrum,
    },
    /// The same radiance from everywhere.
    Constant {
        /// Its radiance, W m⁻² sr⁻¹ nm⁻¹.
        radiance: Spectrum,
    },
    /// A latitude–longitude picture at infinity, up is +z.
    Environment {
        /// EXR, Radiance HDR, PNG or JPEG with RGB, resolved and inside the scene's folder.
        file: PathBuf,
        /// Factor on the picture.
        scale: f64,
        /// Rotation about +z, rad.
        rotation: f64,
        /// Spectrum of RGB 1 1 1, W m⁻² sr⁻¹ nm⁻¹.
        white: Spectrum,
    },
    /// The sun and a clear sky.
    Daylight(Daylight),
    /// Lights as photographers set them up; when the scene has been read, its parts stand in its
    /// place.
    Rig(Rig),
    /// A sky that is covered with cloud.
    Overcast {
        /// Irradiance on a horizontal surface, W m⁻² nm⁻¹.
        irradiance: Spectrum,
        /// Share of light that the ground far around reflects.
        ground_albedo: f64,
    },
    /// An object whose surface emits on the side of its normal.
    Area {
        /// The object.
        object: usize,
        /// Its radiance, W m⁻² sr⁻¹ nm⁻¹; with a pattern, where that is 1.
        radiance: Spectrum,
        /// How the radiance varies over the texture coordinates; `None` is even.
        pattern: Option<AreaPattern>,
    },
    /// A point that emits into a cone (a spotlight).
    Spot {
        /// The point, m.
        position: DVec3,
        /// Point on the cone's axis, m; not the light's own.
        look_at: DVec3,
        /// Half angle of the cone, outside which there is no light, rad, > 0.
        cone_angle: f64,
        /// Width of the edge inside the cone, over which intensity falls to 0 linearly in the
        /// angle, rad, at most `cone_angle`.
        penumbra_angle: f64,
        /// Radiant intensity on the axis, W sr⁻¹ nm⁻¹.
        intensity: Spectrum,
    },
}

impl Light {
    /// Number of lights that are built of it: daylight is the sun and the sky.
    pub fn parts(&self) -> usize {
        match self {
            Self::Daylight(_) => 2,
            Self::Rig(_) => 0,
            Self::Distant { .. }
            | Self::Constant { .. }
            | Self::Environment { .. }
            | Self::Overcast { .. }
            | Self::Area { .. }
            | Self::Spot { .. } => 1,
        }
    }

    /// The picture that it shines by.
    pub fn picture(&self) -> Option<&PathBuf> {
        match self {
            Self::Environment { file, .. } => Some(file),
            Self::Area { pattern, .. } => pattern.as_ref()?.picture.as_ref(),
            Self::Distant { .. }
            | Self::Constant { .. }
            | Self::Daylight(_)
            | Self::Rig(_)
            | Self::Overcast { .. }
            | Self::Spot { .. } => None,
        }
    }
}

/// How the radiance of an area light varies
/// ([`Pattern`](crate::light::pattern::Pattern)).
#[derive(Clone, Debug, PartialEq)]
pub struct AreaPattern {
    /// Radiance in the middle of the edges of the uv square over that in its middle, in (0, 1].
    pub edge: f64,
    /// EXR, Radiance HDR, PNG or JPEG with RGB, resolved and inside the scene's folder.
    pub picture: Option<PathBuf>,
}

/// Lights as photographers set them up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rig {
    /// How they stand.
    pub preset: RigPreset,
    /// What is lit, m; `None` is what the camera looks at.
    pub subject: Option<DVec3>,
    /// Size of the subject, m, > 0.
    pub size: f64,
    /// Azimuth in which the camera is taken to look, rad; `None` is that in which it does.
    pub azimuth: Option<f64>,
    /// Light more or less than usual, as a power of 2.
    pub ev: f64,
}

/// The arrangements of lights.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RigPreset {
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
