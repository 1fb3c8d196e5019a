//! The reflectance of a surface.

use std::path::PathBuf;

use super::{Material, Spectrum, Wrap};

/// The reflectance of a surface, 0 to 1.
#[derive(Clone, Debug)]
pub enum Reflectance {
    /// The same everywhere.
    Even(Spectrum),
    /// The colours of a picture.
    Picture {
        /// EXR, PNG or JPEG with RGB, resolved and inside the scene's folder.
        file: PathBuf,
        /// The layer of an EXR; `None` is that without a name.
        layer: Option<String>,
        /// What lies beside it.
        wrap: Wrap,
        /// How often it lies along u and v in what is 1 wide.
        repeats: [f64; 2],
        /// Factor on its reflectances, 0 to 1.
        scale: f64,
    },
    /// The base colours of a mesh from a glTF file: index into [`Description::meshes`](super::Description::meshes).
    OfMesh(usize),
}

impl Material {
    /// The mesh whose own colours it has: index into [`Description::meshes`](super::Description::meshes).
    pub fn colours_of(&self) -> Option<usize> {
        match self {
            Self::Model { mesh } => Some(*mesh),
            Self::Diffuse { reflectance } | Self::Plastic { reflectance, .. } => {
                match reflectance {
                    Reflectance::OfMesh(mesh) => Some(*mesh),
                    Reflectance::Even(_) | Reflectance::Picture { .. } => None,
                }
            }
            Self::Dielectric { .. } | Self::Leaf { .. } | Self::Solid { .. } => None,
        }
    }

    /// Its reflectance, if it is given as such.
    pub fn reflectance(&self) -> Option<&Reflectance> {
        match self {
            Self::Diffuse { reflectance } | Self::Plastic { reflectance, .. } => Some(reflectance),
            Self::Dielectric { .. }
            | Self::Model { .. }
            | Self::Leaf { .. }
            | Self::Solid { .. } => None,
        }
    }
}
