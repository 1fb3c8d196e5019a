//! What materials are made of.

use std::sync::Arc;

use crate::material;
use crate::material::colour_map::{ColourMap, ColourTexture};
use crate::material::model::Finish;
use crate::material::palette::Palettes;
use crate::material::reflectance::Reflectance as Built;
use crate::material::solid::ReflectanceTables;
use crate::scene::assets::{self, AssetError};
use crate::scene::description::reflectance::Reflectance;
use crate::scene::description::tissue::Held;
use crate::spectrum::Curve;

/// What a material is made of.
pub(in crate::scene) struct Sources<'w> {
    /// The material's name in the scene.
    pub(in crate::scene) name: &'w str,
    /// The palettes of pigments that were made.
    pub(in crate::scene) palettes: &'w mut Palettes,
    /// The tables of reflectances that were made.
    pub(in crate::scene) reflectances: &'w mut ReflectanceTables,
    /// The base colours of the mesh [`Material::colours_of`], if they are wanted.
    pub(in crate::scene) colours: Option<&'w ColourMap>,
    /// What its materials say besides, if that is wanted.
    pub(in crate::scene) finishes: Option<&'w Arc<[Finish]>>,
    /// What was changed of pictures.
    pub(in crate::scene) notes: &'w mut Vec<String>,
}

impl Sources<'_> {
    pub(super) fn reflectance(&mut self, of: &Reflectance) -> Result<Built, AssetError> {
        let map = match of {
            Reflectance::Even(spectrum) => return Ok(Curve::from_description(spectrum).into()),
            Reflectance::OfMesh(_) => {
                let colours = self.colours.cloned();
                colours.expect("a mesh whose colours are wanted was read with them")
            }
            Reflectance::Picture(of) => {
                let picture = assets::reflectances(&of.file, of.layer.name())?;
                if picture.outside > 0.0 {
                    self.notes.push(format!(
                        "materials.{}: {}: {:.2} % of its pixels have colours outside of Rec. 709; they come \
                         to its border",
                        self.name,
                        of.file.display(),
                        100.0 * picture.outside
                    ));
                }
                let texture = ColourTexture::new(picture.width, picture.texels, [of.wrap; 2]);
                let repeats = of.repeats.map(|count| count as f32).into();
                ColourMap::of(texture, of.scale as f32, repeats)
            }
        };
        Ok(Built::Picture(Box::new(map)))
    }

    pub(super) fn held(held: &Held) -> Result<material::held::Held, AssetError> {
        Ok(match held {
            Held::Contents { contents, .. } => material::held::Held::Uniform(*contents),
            Held::Map { file, .. } => material::held::Held::Map(assets::contents_map(file)?),
        })
    }
}
