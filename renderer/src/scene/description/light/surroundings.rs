//! What lights are made in: the scene around them, and their pictures.

use std::path::Path;

use glam::{Affine3A, DVec3};
use leafmodel::document::value_kind::{FileOnly, FilePath};
use thiserror::Error;

use crate::geometry::TriangleMesh;
use crate::material::colour_map::ColourMap;
use crate::scene::assets::{self, AssetError, RgbPicture};

/// Why a light cannot be made.
#[derive(Debug, Error)]
pub enum LightError {
    /// Its picture cannot be read or has other contents.
    #[error("lights.{name}: {source}")]
    Picture {
        /// Name of the light.
        name: String,
        /// What is wrong with it.
        source: AssetError,
    },
    /// An area light varies over texture coordinates that its mesh lacks.
    #[error(
        "lights.{name}.area: the mesh of its object has no texture coordinates, over which `edge` \
         and `picture` are spread: leave them out, or use a mesh with them, such as a rectangle"
    )]
    NoTextureCoordinates {
        /// Name of the light.
        name: String,
    },
    /// An area light takes the emission of a model that emits nothing.
    #[error(
        "lights.{name}.area: no material of its object's mesh emits light: leave `emission` out, so that it \
         shines evenly"
    )]
    NoEmission {
        /// Name of the light.
        name: String,
    },
}

/// What a light is made in.
pub(in crate::scene) struct Surroundings<'w> {
    /// The light's name in the scene.
    pub(in crate::scene) name: &'w str,
    /// The origin of rays.
    pub(in crate::scene) origin: DVec3,
    /// The surface of the object that shines.
    pub(in crate::scene) surface: Option<Surface<'w>>,
    /// What was changed of its picture.
    pub(in crate::scene) notes: &'w mut Vec<String>,
}

/// The surface of an object that shines.
pub(in crate::scene) struct Surface<'w> {
    pub(in crate::scene) mesh: &'w TriangleMesh,
    /// Its place around the origin of rays.
    pub(in crate::scene) to_world: Affine3A,
    /// What the materials of its model emit.
    pub(in crate::scene) emission: Option<&'w ColourMap>,
}

/// A picture that shines, up to 4 GiB.
pub(super) const PICTURE: FileOnly = FileOnly(FilePath::of(
    "the path of an EXR, HDR, PNG or JPEG picture",
    &["exr", "hdr", "png", "jpg", "jpeg"],
    4 << 30,
));

/// The picture of a light, and the layer of it.
pub(super) fn read_picture(
    file: &Path,
    layer: Option<&str>,
    around: &mut Surroundings<'_>,
) -> Result<RgbPicture, LightError> {
    let name = around.name;
    let picture = assets::shining(file, layer).map_err(|source| LightError::Picture {
        name: name.to_owned(),
        source,
    })?;
    let mut note = |fraction: f64, what: &str| {
        if fraction > 0.0 {
            let (file, percent) = (file.display(), 100.0 * fraction);
            let note = format!("lights.{name}: {file}: {percent:.2} % of its pixels have {what}");
            around.notes.push(note);
        }
    };
    note(picture.below, "a channel below 0, which is taken for 0");
    note(
        picture.outside,
        "colours outside of Rec. 709, whose spectra are below 0 at some wavelengths: as a part of the light of \
         a whole scene they are right",
    );
    Ok(picture)
}
