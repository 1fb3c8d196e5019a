//! Materials: each kind is a file with its keys and with how the tracer's material is made of it.

pub mod dielectric;
pub mod diffuse;
pub mod hapke;
pub mod leaf;
mod measured;
pub mod model;
pub mod plastic;
pub mod solid;
mod sources;

use std::path::Path;

use leafmodel::document::declared::{Declared, Kinds};

use self::dielectric::Boundary;
use self::diffuse::Diffuse;
use self::hapke::Hapke;
use self::leaf::{LeafTissue, PlainLeaf};
use self::model::GltfSurface;
use self::plastic::Plastic;
use self::solid::PlainSolid;
pub(in crate::scene) use self::sources::Sources;
use super::reflectance::Reflectance;
use super::tissue::Held;
use crate::material;
use crate::plugin::element::Element;
use crate::plugin::surface::Exported;
use crate::scene::assets::AssetError;
use crate::spectrum::written::Spectrum;

/// A material.
#[derive(Clone, Debug, Declared)]
pub enum Material {
    /// Lambertian.
    Diffuse(Diffuse),
    /// A smooth or rough (GGX) boundary of a transparent medium.
    Dielectric(Boundary),
    /// A diffuse body below a rough clear coat: glaze, varnish, waxy bark and rind.
    Plastic(Plastic),
    /// The materials of a mesh from a glTF file: base colour, metal, roughness, normals.
    #[key("gltf")]
    Model(GltfSurface),
    /// A surface of grains, as bare soil is, after Hapke: brighter from where the light comes.
    Hapke(Hapke),
    /// A leaf of uniform contents, of a map of contents, or of measured spectra.
    Leaf(PlainLeaf),
    /// Solid tissue of uniform contents or of a map of contents.
    Solid(PlainSolid),
}

impl Default for Material {
    fn default() -> Self {
        Self::Diffuse(Diffuse::default())
    }
}

impl Material {
    /// A matt surface with a spectrum.
    pub fn matt(spectrum: Spectrum) -> Self {
        Self::Diffuse(Diffuse {
            reflectance: Reflectance::Even(spectrum),
        })
    }

    /// The tracer's material.
    pub(in crate::scene) fn built(
        &self,
        sources: &mut Sources<'_>,
    ) -> Result<material::Material, AssetError> {
        Ok(match self {
            Self::Diffuse(of) => material::Material::Diffuse(sources.reflectance(&of.reflectance)?),
            Self::Dielectric(of) => material::Material::Dielectric(of.built()),
            Self::Plastic(of) => material::Material::Plastic(Box::new(of.built(sources)?)),
            Self::Model(_) => material::Material::Model(Box::new(GltfSurface::built(sources))),
            Self::Hapke(of) => of.built(),
            Self::Leaf(of) => material::Material::Leaf(Box::new(of.built(sources)?)),
            Self::Solid(of) => material::Material::Solid(Box::new(of.built(sources)?)),
        })
    }

    /// Mitsuba's plugin for it.
    pub(crate) fn plugin(&self, surface: &mut Exported<'_>) -> Element {
        match self {
            Self::Diffuse(of) => of.plugin(surface),
            Self::Dielectric(of) => of.plugin(surface.id),
            Self::Plastic(of) => of.plugin(surface),
            Self::Model(_) => GltfSurface::plugin(surface),
            Self::Hapke(of) => of.plugin(surface),
            Self::Leaf(of) => of.plugin(surface),
            Self::Solid(of) => of.optics.plugin(of.held.extrapolates(), surface),
        }
    }

    /// Whether that is a plugin of Mitsuba's own, and scatters.
    pub(crate) fn is_stock(&self) -> bool {
        match self {
            Self::Diffuse(_) => true,
            Self::Dielectric(of) => of.eta != 1.0,
            Self::Plastic(_) | Self::Model(_) | Self::Hapke(_) | Self::Leaf(_) | Self::Solid(_) => {
                false
            }
        }
    }

    /// The word for its kind.
    pub(in crate::scene) fn kind(&self) -> &'static str {
        let mut kinds = Self::KINDS.iter();
        let own = kinds.find(|kind| (kind.is)(self));
        own.map_or("", |kind| kind.name)
    }

    /// What it holds, if it is tissue whose contents are known.
    pub fn held(&self) -> Option<&Held> {
        match self {
            Self::Leaf(leaf) => match &leaf.tissue {
                LeafTissue::Held(held) => Some(held),
                LeafTissue::Measured { .. } => None,
            },
            Self::Solid(solid) => Some(&solid.held),
            Self::Diffuse(_)
            | Self::Dielectric(_)
            | Self::Plastic(_)
            | Self::Model(_)
            | Self::Hapke(_) => None,
        }
    }

    /// The boundary that it is.
    pub fn boundary(&self) -> Option<&Boundary> {
        if let Self::Dielectric(boundary) = self {
            Some(boundary)
        } else {
            None
        }
    }

    /// What fills the body: index into [`Description::media`](super::Description::media).
    pub fn interior(&self) -> Option<usize> {
        self.boundary()?.interior
    }

    /// Whether paths need to know on which side of it they are: it bounds a medium, or it is no
    /// boundary for light at all.
    pub fn is_transparent_to_paths(&self) -> bool {
        let boundary = self.boundary();
        boundary.is_some_and(|of| of.interior.is_some() || of.eta == 1.0)
    }

    /// The mesh whose own colours it has: index into [`Description::meshes`](super::Description::meshes).
    pub fn colours_of(&self) -> Option<usize> {
        if let Self::Model(model) = self {
            Some(model.mesh)
        } else {
            self.reflectance()?.mesh()
        }
    }

    /// The picture of its reflectance, and the layer of it.
    pub fn picture(&self) -> Option<(&Path, Option<&str>)> {
        if let Reflectance::Picture(of) = self.reflectance()? {
            Some((&of.file, of.layer.name()))
        } else {
            None
        }
    }

    /// Its reflectance, if it is given as such.
    pub fn reflectance(&self) -> Option<&Reflectance> {
        match self {
            Self::Diffuse(of) => Some(&of.reflectance),
            Self::Plastic(of) => Some(&of.reflectance),
            Self::Dielectric(_)
            | Self::Model(_)
            | Self::Hapke(_)
            | Self::Leaf(_)
            | Self::Solid(_) => None,
        }
    }
}
