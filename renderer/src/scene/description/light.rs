//! Lights and rigs of lights.

use std::path::{Path, PathBuf};

use glam::DVec3;

use super::{Daylight, Named, Object, ObjectShape, Spectrum};

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
        /// The layer of an EXR; `None` is that without a name.
        layer: Option<String>,
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

    /// The mesh whose own materials say what it emits: index into
    /// [`Description::meshes`](super::Description::meshes).
    pub fn emission_of(&self, objects: &[Named<Object>]) -> Option<usize> {
        let Self::Area {
            object,
            pattern: Some(AreaPattern { emission: true, .. }),
            ..
        } = self
        else {
            return None;
        };
        // An unknown name is reported where it is written.
        match objects.get(*object)?.value.shapes.first()? {
            ObjectShape::Mesh { mesh, .. } => Some(*mesh),
            ObjectShape::Leaf { .. } | ObjectShape::Solid { .. } => None,
        }
    }

    /// The picture that it shines by, and the layer of it.
    pub fn picture(&self) -> Option<(&Path, Option<&str>)> {
        match self {
            Self::Environment { file, layer, .. } => Some((file, layer.as_deref())),
            Self::Area { pattern, .. } => pattern.as_ref()?.picture(),
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
    /// The layer of an EXR; `None` is that without a name.
    pub layer: Option<String>,
    /// Whether the light that the mesh's own materials emit multiplies it.
    pub emission: bool,
}

impl AreaPattern {
    /// Its picture, and the layer of it.
    pub fn picture(&self) -> Option<(&Path, Option<&str>)> {
        Some((self.picture.as_deref()?, self.layer.as_deref()))
    }
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
