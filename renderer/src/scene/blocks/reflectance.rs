//! The reflectance of a material: a spectrum, or the colours of a picture or of a model.

use std::path::PathBuf;

use leafmodel::document::coverage::require_coverage;
use leafmodel::document::declared::Declared;
use leafmodel::document::keys::Keys;
use leafmodel::document::limits::Limits;
use leafmodel::document::names::NameIn;
use leafmodel::document::value_kind::{FilePath, Number, Numbers, Word};

use super::spectrum::SpectrumOf;
use crate::scene::description::layer::ChosenLayer;
use crate::scene::description::{Reflectance, Spectrum, Wrap};
use crate::spectrum::rgb;

/// Largest picture that is read, bytes.
const MOST_PICTURE_BYTES: u64 = 4 << 30;

/// The keys of a reflectance; `about` says what it is a share of.
pub(super) fn reflectance(reflectance: &mut Reflectance, about: &'static str, keys: &mut Keys<'_>) {
    let ways = ["reflectance", "picture", "mesh"];
    for chosen in keys.one_of(&ways, Some("reflectance")) {
        match chosen {
            "reflectance" => {
                let mut spectrum = Spectrum::Constant(0.0);
                keys.required("reflectance", &mut spectrum, SpectrumOf::Share, about);
                *reflectance = Reflectance::Even(spectrum);
            }
            "picture" => {
                let about = "The reflectances of a picture's colours, over uv.";
                keys.required_block("picture", about, &[], |keys| {
                    *reflectance = picture(keys);
                });
            }
            _ => {
                // Replaced when the key is read.
                let mut mesh = usize::MAX;
                let about = "The base colours of that mesh's own materials.";
                model(&mut mesh, about, keys);
                *reflectance = Reflectance::OfMesh(mesh);
            }
        }
    }
}

/// The key `mesh`: a mesh whose file says what its surface is.
pub(super) fn model(mesh: &mut usize, about: &'static str, keys: &mut Keys<'_>) {
    let kind = NameIn("meshes", "the name of a mesh from a glTF file");
    keys.required("mesh", mesh, kind, about);
    require_colours("mesh", keys);
}

/// RGB says nothing of light that the eye does not see.
fn require_colours(key: &'static str, keys: &Keys<'_>) {
    if let Some(block) = keys.reader() {
        let at = block.node(key).map_or(&block.at, |node| &node.at);
        require_coverage(block.cx, at, "a picture's colour", rgb::RANGE_NM);
    }
}

fn picture(keys: &mut Keys<'_>) -> Reflectance {
    const PATH: FilePath = FilePath::of(
        "the path of a PNG, JPEG or EXR picture",
        &["png", "jpg", "jpeg", "exr"],
        MOST_PICTURE_BYTES,
    );
    let (mut file, mut wrap) = (PathBuf::new(), Wrap::default());
    let (mut repeats, mut scale) = ([1.0, 1.0], 1.0);
    let about = "Its lowest row is v = 0. PNG and JPEG hold sRGB values unless they say otherwise, an EXR \
        linear ones of 0 to 1.";
    super::file(keys, "file", &mut file, PATH, about);
    let mut layer = ChosenLayer::default();
    layer.declare(keys);
    let about = "What lies beside it: the same again, its mirror image, or its border.";
    keys.key("wrap", &mut wrap, Word(&Wrap::WORDS), about);
    let limits = Numbers::<2>(Limits::above(0.0, 1e6));
    let about = "How often it lies along u and v where these go from 0 to 1.";
    keys.key("repeats", &mut repeats, limits, about);
    let about = "Factor on its reflectances.";
    keys.key("scale", &mut scale, Number(Limits::closed(0.0, 1.0)), about);
    require_colours("file", keys);
    Reflectance::Picture {
        file,
        layer: layer.0,
        wrap,
        repeats,
        scale,
    }
}
