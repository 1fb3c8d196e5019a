//! Conversion of materials from the description, with data that several of them share.

use std::sync::Arc;

use leafmodel::optics::solid::ReflectanceTable;

use super::WorldError;
use super::meshes::OwnSurface;
use crate::bsdf::coat::Coat;
use crate::bsdf::dielectric::Dielectric;
use crate::material::Material;
use crate::material::colour_map::{ColourMap, ColourTexture};
use crate::material::held::Held;
use crate::material::leaf::LeafTissue;
use crate::material::model::ModelMaterial;
use crate::material::palette::{Palette, Palettes};
use crate::material::plastic::PlasticMaterial;
use crate::material::reflectance::Reflectance;
use crate::material::solid::ReflectanceTables;
use crate::scene::assets;
use crate::scene::description::{self, Description};
use crate::scene::tissue;
use crate::spectrum::{Curve, WavelengthGrid};

/// Data that materials share, made on first use.
pub(super) struct Known {
    /// Palettes of pigments.
    pub(super) palettes: Palettes,
    reflectances: ReflectanceTables,
}

impl Known {
    /// Empty data for a picture with these wavelengths.
    pub(super) fn on(grid: &WavelengthGrid) -> Self {
        Self {
            palettes: Palettes::on(grid),
            reflectances: ReflectanceTables::default(),
        }
    }

    /// The shared data for each leaf and each body of solid tissue.
    pub(super) fn for_grown(
        &mut self,
        scene: &Description,
    ) -> (Vec<Palette>, Vec<(Palette, Arc<ReflectanceTable>)>) {
        let leaves = scene.leaves.iter();
        let leaves = leaves.map(|leaf| self.palettes.of(&leaf.value.plan.pigments));
        let leaves = leaves.collect();
        let solids = scene.solids.iter().map(|solid| {
            let palette = self.palettes.of(&solid.value.plan.pigments);
            (palette, self.reflectances.of(solid.value.optics.tissue.eta))
        });
        (leaves, solids.collect())
    }
}

/// Makes the scene's materials; `surfaces` are those that each of its meshes brings along.
pub(super) fn build_materials(
    scene: &Description,
    surfaces: &[OwnSurface],
    known: &mut Known,
    notes: &mut Vec<String>,
) -> Result<Vec<Material>, WorldError> {
    let written = scene.materials.iter();
    let built =
        written.map(|named| build_material(&named.name, &named.value, surfaces, known, notes));
    built.collect()
}

fn build_material(
    name: &str,
    material: &description::Material,
    surfaces: &[OwnSurface],
    known: &mut Known,
    notes: &mut Vec<String>,
) -> Result<Material, WorldError> {
    let read = |held: &description::Held| match held {
        description::Held::Contents { contents, .. } => Ok(Held::Uniform(*contents)),
        description::Held::Map { file, .. } => match assets::contents_map(file) {
            Ok(map) => Ok(Held::Map(map)),
            Err(source) => Err(WorldError::Asset {
                place: format!("materials.{name}"),
                source,
            }),
        },
    };
    Ok(match material {
        description::Material::Diffuse { reflectance } => {
            Material::Diffuse(build_reflectance(name, reflectance, surfaces, notes)?)
        }
        description::Material::Dielectric { eta, roughness, .. } => {
            Material::Dielectric(Dielectric {
                eta: *eta as f32,
                alpha: *roughness as f32,
            })
        }
        description::Material::Plastic {
            reflectance,
            eta,
            roughness,
        } => {
            let alpha = *roughness as f32;
            let coat = Coat::new(*eta as f32, alpha, alpha);
            let reflectance = build_reflectance(name, reflectance, surfaces, notes)?;
            Material::Plastic(Box::new(PlasticMaterial::new(reflectance, coat)))
        }
        description::Material::Model { mesh } => {
            let OwnSurface {
                colours, finishes, ..
            } = &surfaces[*mesh];
            let (colours, finishes) = colours
                .clone()
                .zip(finishes.clone())
                .expect("a mesh whose surface is wanted was read with it");
            Material::Model(Box::new(ModelMaterial::new(colours, finishes)))
        }
        description::Material::Leaf {
            tissue,
            pigments,
            faces,
            fluorescence,
        } => {
            let made = match tissue {
                description::LeafTissue::Held(held) => LeafTissue::Held(read(held)?),
                description::LeafTissue::Measured {
                    reflectance,
                    transmittance,
                } => LeafTissue::Measured {
                    reflectance: Curve::from_description(reflectance),
                    transmittance: Curve::from_description(transmittance),
                },
            };
            let palette = known.palettes.of(pigments);
            Material::Leaf(Box::new(tissue::leaf(made, palette, faces, *fluorescence)))
        }
        description::Material::Solid {
            held,
            pigments,
            optics,
        } => {
            let palette = known.palettes.of(pigments);
            let table = known.reflectances.of(optics.tissue.eta);
            Material::Solid(Box::new(tissue::solid(read(held)?, palette, optics, table)))
        }
    })
}

fn build_reflectance(
    name: &str,
    reflectance: &description::Reflectance,
    surfaces: &[OwnSurface],
    notes: &mut Vec<String>,
) -> Result<Reflectance, WorldError> {
    match reflectance {
        description::Reflectance::Even(spectrum) => Ok(Curve::from_description(spectrum).into()),
        description::Reflectance::OfMesh(mesh) => {
            let map = surfaces[*mesh].colours.clone();
            let map = map.expect("a mesh whose colours are wanted was read with them");
            Ok(Reflectance::Picture(Box::new(map)))
        }
        description::Reflectance::Picture {
            file,
            layer,
            wrap,
            repeats,
            scale,
        } => {
            let picture = assets::reflectances(file, layer.as_deref());
            let picture = picture.map_err(|source| WorldError::Asset {
                place: format!("materials.{name}"),
                source,
            })?;
            if picture.outside > 0.0 {
                notes.push(format!(
                    "materials.{name}: {}: {:.2} % of its pixels have colours outside of Rec. 709; they come \
                     to its border",
                    file.display(),
                    100.0 * picture.outside
                ));
            }
            let texture = ColourTexture::new(picture.width, picture.texels, [*wrap; 2]);
            let repeats = repeats.map(|count| count as f32).into();
            let map = ColourMap::of(texture, *scale as f32, repeats);
            Ok(Reflectance::Picture(Box::new(map)))
        }
    }
}
