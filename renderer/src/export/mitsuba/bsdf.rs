//! Materials.

use leafmodel::optics::Contents;

use crate::export::element::{Element, Layout};
use crate::material;
use crate::scene::description::{
    Coat, Description, LeafTissue, Material, SolidOptics, SolidTissue, Spectrum,
};
use crate::scene::world::{MaterialOwner, World};

use super::absorption_file;
use super::spectra::Spectra;
use super::xml::material_id;

/// The material with this number.
pub(super) fn bsdf(
    scene: &Description,
    world: &World,
    material: usize,
    spectra: &mut Spectra,
) -> Element {
    let id = material_id(scene, world, material);
    let leaf_bsdf = || Element::plugin("bsdf", "lamina_leaf").called(&id);
    let solid_bsdf = || Element::plugin("bsdf", "lamina_solid").called(&id);
    let table = match &world.materials[material] {
        material::Material::Leaf(leaf) => absorption_file(&leaf.palette),
        material::Material::Solid(solid) => absorption_file(solid.palette()),
        material::Material::Diffuse(_) | material::Material::Dielectric(_) => String::new(),
    };
    if let MaterialOwner::Leaf { leaf, .. } = world.owners[material] {
        let leaf = &scene.leaves[leaf].value;
        let bsdf = leaf_bsdf();
        let bsdf = match &world.materials[material] {
            material::Material::Leaf(own) => match &own.tissue {
                material::leaf::LeafTissue::Uniform(contents) => {
                    uniform_tissue(bsdf, contents, &table, leaf.extrapolate)
                }
                material::leaf::LeafTissue::Map(_)
                | material::leaf::LeafTissue::Measured { .. } => {
                    map_tissue(bsdf, &id, &table, leaf.extrapolate)
                }
            },
            material::Material::Diffuse(_)
            | material::Material::Dielectric(_)
            | material::Material::Solid(_) => bsdf,
        };
        return leaf_surface(bsdf, &leaf.abaxial_ratio, &leaf.coats, spectra);
    }
    if let MaterialOwner::Solid(solid) = world.owners[material] {
        let solid = &scene.solids[solid].value;
        let bsdf = map_tissue(solid_bsdf(), &id, &table, solid.extrapolate);
        return solid_optics(bsdf, &solid.optics);
    }
    match &scene.materials[material].value {
        Material::Diffuse { reflectance } => {
            let one_side = Element::plugin("bsdf", "diffuse");
            Element::plugin("bsdf", "twosided")
                .called(&id)
                .holding(one_side.holding(spectra.element("reflectance", reflectance, 1.0)))
                .laid_out(Layout::Inline)
        }
        Material::Dielectric { eta, roughness } => {
            let is_rough = *roughness > 0.0;
            let kind = if is_rough {
                "roughdielectric"
            } else {
                "dielectric"
            };
            let bsdf = Element::plugin("bsdf", kind)
                .called(&id)
                .float("int_ior", *eta)
                .float("ext_ior", 1.0);
            if is_rough {
                bsdf.string("distribution", "ggx")
                    .float("alpha", *roughness)
            } else {
                bsdf
            }
        }
        Material::Leaf {
            tissue,
            pigments: _,
            abaxial_ratio,
            coats,
        } => {
            let bsdf = leaf_bsdf();
            let bsdf = match tissue {
                LeafTissue::Contents {
                    contents,
                    extrapolate,
                } => uniform_tissue(bsdf, contents, &table, *extrapolate),
                LeafTissue::Map { extrapolate, .. } => map_tissue(bsdf, &id, &table, *extrapolate),
                LeafTissue::Measured {
                    reflectance,
                    transmittance,
                } => bsdf
                    .string("tissue", "measured")
                    .holding(spectra.element("reflectance", reflectance, 1.0))
                    .holding(spectra.element("transmittance", transmittance, 1.0)),
            };
            leaf_surface(bsdf, abaxial_ratio, coats, spectra)
        }
        Material::Solid {
            tissue,
            pigments: _,
            optics,
        } => {
            let bsdf = solid_bsdf();
            let bsdf = match tissue {
                SolidTissue::Contents {
                    contents,
                    extrapolate,
                } => uniform_tissue(bsdf, contents, &table, *extrapolate),
                SolidTissue::Map { extrapolate, .. } => map_tissue(bsdf, &id, &table, *extrapolate),
            };
            solid_optics(bsdf, optics)
        }
    }
}

fn prospect(bsdf: Element, table: &str, extrapolate: bool) -> Element {
    bsdf.string("prospect", table)
        .boolean("extrapolate", extrapolate)
}

fn uniform_tissue(bsdf: Element, contents: &Contents, table: &str, extrapolate: bool) -> Element {
    let bsdf = prospect(bsdf.string("tissue", "contents"), table, extrapolate);
    let contents = (**contents).into_iter();
    contents.fold(bsdf, |bsdf, (constituent, value)| {
        bsdf.float(constituent.channel(), value)
    })
}

fn map_tissue(bsdf: Element, id: &str, table: &str, extrapolate: bool) -> Element {
    let bsdf = bsdf
        .string("tissue", "map")
        .string("map", format_args!("maps/{id}.exr"));
    prospect(bsdf, table, extrapolate)
}

fn leaf_surface(
    bsdf: Element,
    abaxial_ratio: &Spectrum,
    coats: &[Coat; 2],
    spectra: &mut Spectra,
) -> Element {
    let faces = ["adaxial", "abaxial"].into_iter().zip(coats);
    let bsdf = faces.fold(bsdf, |bsdf, (face, coat)| {
        bsdf.float(&format!("{face}_eta"), coat.eta)
            .float(&format!("{face}_alpha_across"), coat.alpha_across)
            .float(&format!("{face}_alpha_along"), coat.alpha_along)
    });
    bsdf.holding(spectra.element("abaxial_ratio", abaxial_ratio, 1.0))
}

fn solid_optics(bsdf: Element, optics: &SolidOptics) -> Element {
    bsdf.float("depth_mm", optics.tissue.depth_mm)
        .float("scattering_per_mm", optics.tissue.scattering_per_mm)
        .float("eta", optics.tissue.eta)
        .float("coat_eta", optics.coat.eta)
        .float("coat_alpha", optics.coat.alpha_across)
}
