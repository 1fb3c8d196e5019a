//! Lights.

use std::path::{Path, PathBuf};

use glam::DVec3;

use super::{Daylight, Spectrum};

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
            Self::Distant { .. }
            | Self::Constant { .. }
            | Self::Environment { .. }
            | Self::Overcast { .. }
            | Self::Area { .. }
            | Self::Spot { .. } => 1,
        }
    }

    /// Its spectrum, relative: of daylight, of sun and sky on a level plane.
    pub(in crate::scene) fn relative_spectrum(&self) -> Spectrum {
        match self {
            Self::Distant { irradiance, .. } | Self::Overcast { irradiance, .. } => {
                irradiance.clone()
            }
            Self::Constant { radiance } | Self::Area { radiance, .. } => radiance.clone(),
            Self::Environment { white, .. } => white.clone(),
            Self::Spot { intensity, .. } => intensity.clone(),
            Self::Daylight(day) => {
                let (sun, sky) = day.lights();
                let up = libm::sin(day.elevation);
                let points = sun.irradiance().points().into_iter();
                let points = points.map(|(nm, direct)| {
                    let diffuse = f64::from(sky.diffuse().at(nm as f32));
                    (nm, direct * up + diffuse)
                });
                Spectrum::Table {
                    points: points.collect(),
                    extrapolate: true,
                }
            }
        }
    }

    /// The object whose own materials say what it emits.
    pub fn emitting_object(&self) -> Option<usize> {
        match self {
            Self::Area {
                object,
                pattern: Some(AreaPattern { emission: true, .. }),
                ..
            } => Some(*object),
            Self::Distant { .. }
            | Self::Constant { .. }
            | Self::Environment { .. }
            | Self::Daylight(_)
            | Self::Overcast { .. }
            | Self::Area { .. }
            | Self::Spot { .. } => None,
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
