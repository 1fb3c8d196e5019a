//! The reflectance of a surface: a spectrum, or the colours of a picture or of a model.

use std::path::PathBuf;

use leafmodel::document::coverage::require_coverage;
use leafmodel::document::declared::{Declared, Defaults};
use leafmodel::document::keys::Keys;
use leafmodel::document::names::NameIn;
use leafmodel::document::value_kind::{FileOnly, FilePath, Word};

use super::layer::ChosenLayer;
use crate::material::colour_map::Wrap;
use crate::plugin::element::Element;
use crate::plugin::surface::Exported;
use crate::scene::blocks::spectrum::SpectrumOf;
use crate::spectrum::rgb;
use crate::spectrum::written::Spectrum;

/// The reflectance of a surface, 0 to 1.
#[derive(Clone, Debug)]
pub enum Reflectance {
    /// The same everywhere.
    Even(Spectrum),
    /// The colours of a picture.
    Picture(ReflectancePicture),
    /// The base colours of a mesh from a glTF file: index into [`Description::meshes`](super::Description::meshes).
    OfMesh(usize),
}

impl Default for Reflectance {
    fn default() -> Self {
        Self::Even(Spectrum::default())
    }
}

/// A picture up to 4 GiB.
const PICTURE: FileOnly = FileOnly(FilePath::of(
    "the path of a PNG, JPEG or EXR picture",
    &["png", "jpg", "jpeg", "exr"],
    4 << 30,
));

/// A picture whose colours are those of a surface.
#[derive(Clone, Debug, Declared, Defaults)]
#[key(last = require_colours_of_file)]
pub struct ReflectancePicture {
    /// Its lowest row is v = 0. PNG and JPEG hold sRGB values unless they say otherwise, an EXR linear ones of
    /// 0 to 1.
    ///
    /// Resolved and inside the scene's folder.
    #[key("file", required, PICTURE)]
    pub file: PathBuf,
    /// The layer of the picture.
    #[key(flat)]
    pub layer: ChosenLayer,
    /// What lies beside it: the same again, its mirror image, or its border.
    #[key("wrap", Word(&Wrap::WORDS))]
    pub wrap: Wrap,
    /// How often it lies along u and v where these go from 0 to 1.
    #[key("repeats", above(0.0, 1e6), default = [1.0, 1.0])]
    pub repeats: [f64; 2],
    /// Factor on its reflectances.
    #[key("scale", 0.0..=1.0, default = 1.0)]
    pub scale: f64,
}

impl Reflectance {
    /// The keys of a reflectance; `about` says what it is a fraction of.
    pub(super) fn declare(&mut self, about: &'static str, keys: &mut Keys<'_>) {
        let ways = ["reflectance", "picture", "mesh"];
        for chosen in keys.one_of(&ways, Some("reflectance")) {
            match chosen {
                "reflectance" => {
                    let mut spectrum = Spectrum::default();
                    keys.required("reflectance", &mut spectrum, SpectrumOf::Share, about);
                    *self = Self::Even(spectrum);
                }
                "picture" => {
                    let about = "The reflectances of a picture's colours, over uv.";
                    keys.required_block("picture", about, &[], |keys| {
                        let mut picture = ReflectancePicture::default();
                        picture.declare(keys);
                        *self = Self::Picture(picture);
                    });
                }
                _ => {
                    // Replaced when the key is read.
                    let mut mesh = usize::MAX;
                    let about = "The base colours of that mesh's own materials.";
                    keys.required("mesh", &mut mesh, MODEL, about);
                    require_colours("mesh", keys);
                    *self = Self::OfMesh(mesh);
                }
            }
        }
    }

    /// The parameter `reflectance` of Mitsuba: a spectrum, or a texture that is written to files beside.
    pub(super) fn parameter(&self, surface: &mut Exported<'_>) -> Element {
        match self {
            Self::Even(spectrum) => surface.spectra.element("reflectance", spectrum, 1.0),
            Self::Picture(_) | Self::OfMesh(_) => surface.colours("reflectance"),
        }
    }

    /// The mesh whose own colours it has.
    pub(super) fn mesh(&self) -> Option<usize> {
        if let Self::OfMesh(mesh) = self {
            Some(*mesh)
        } else {
            None
        }
    }
}

/// A mesh whose file says what its surface is.
pub(super) const MODEL: NameIn = NameIn("meshes", "the name of a mesh from a glTF file");

fn require_colours_of_file(_: &mut ReflectancePicture, keys: &mut Keys<'_>) {
    require_colours("file", keys);
}

/// RGB says nothing of light that the eye does not see.
pub(super) fn require_colours(key: &'static str, keys: &Keys<'_>) {
    if let Some(block) = keys.reader() {
        let at = block.node(key).map_or(&block.at, |node| &node.at);
        require_coverage(block.cx, at, "a picture's colour", rgb::RANGE_NM);
    }
}
