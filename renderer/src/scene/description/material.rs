//! Materials and what tissue holds.

use std::path::PathBuf;

use leafmodel::optics::Pigments;

use super::{Reflectance, Spectrum};

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
        /// What fills the body, index into [`media`](super::Description::media); `None` is clear.
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
    /// All that a mesh from a glTF file says of its surface: index into
    /// [`meshes`](super::Description::meshes).
    Model {
        /// The mesh.
        mesh: usize,
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
            | Self::Model { .. }
            | Self::Leaf { .. } => None,
        }
    }

    /// Whether paths need to know on which side of it they are: it bounds a medium, or it is no
    /// boundary for light at all.
    pub fn is_transparent_to_paths(&self) -> bool {
        match self {
            Self::Dielectric { eta, interior, .. } => interior.is_some() || *eta == 1.0,
            Self::Diffuse { .. }
            | Self::Plastic { .. }
            | Self::Model { .. }
            | Self::Leaf { .. }
            | Self::Solid { .. } => false,
        }
    }
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
    /// Reflectance of the abaxial face, if it was measured; then there is no ratio.
    pub abaxial_reflectance: Option<Spectrum>,
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

impl Held {
    /// Whether PROSPECT's table is continued by its end values outside 400–2500 nm.
    pub fn extrapolates(&self) -> bool {
        match self {
            Self::Contents { extrapolate, .. } | Self::Map { extrapolate, .. } => *extrapolate,
        }
    }
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
