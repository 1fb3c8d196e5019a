//! Materials.

use crate::export::element::{Element, Layout};
use crate::material::{self, Holds};
use crate::scene::description::{
    Coat, Description, LeafTissue, Material, SolidOptics, SolidTissue, Spectrum,
};
use crate::scene::world::{MaterialOwner, World};

use super::absorption_file;
use super::spectra::Spectra;
use super::units::material_id;

/// The material with this number.
pub(super) fn bsdf(
    scene: &Description,
    world: &World,
    material: usize,
    spectra: &mut Spectra,
) -> Element {
    let id = material_id(scene, world, material);
    let own = &world.materials[material];
    let leaf_bsdf = |extrapolate| {
        let bsdf = Element::plugin("bsdf", "lamina_leaf").called(&id);
        tissue(bsdf, &id, own, extrapolate)
    };
    let solid_bsdf = |extrapolate| {
        let bsdf = Element::plugin("bsdf", "lamina_solid").called(&id);
        tissue(bsdf, &id, own, extrapolate)
    };
    let number = match world.owners[material] {
        MaterialOwner::Leaf { leaf, .. } => {
            let leaf = &scene.leaves[leaf].value;
            let bsdf = leaf_bsdf(leaf.extrapolate);
            return leaf_surface(bsdf, &leaf.abaxial_ratio, &leaf.coats, spectra);
        }
        MaterialOwner::Solid(solid) => {
            let solid = &scene.solids[solid].value;
            return solid_optics(solid_bsdf(solid.extrapolate), &solid.optics);
        }
        MaterialOwner::Scene(number) => number,
    };
    match &scene.materials[number].value {
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
            let bsdf = match tissue {
                LeafTissue::Contents { extrapolate, .. } | LeafTissue::Map { extrapolate, .. } => {
                    leaf_bsdf(*extrapolate)
                }
                LeafTissue::Measured {
                    reflectance,
                    transmittance,
                } => leaf_bsdf(false)
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
            let (SolidTissue::Contents { extrapolate, .. } | SolidTissue::Map { extrapolate, .. }) =
                tissue;
            solid_optics(solid_bsdf(*extrapolate), optics)
        }
    }
}

/// Adds the contents of tissue: uniform contents, the file of a map, or measured spectra.
fn tissue(bsdf: Element, id: &str, material: &material::Material, extrapolate: bool) -> Element {
    let Some(tissue) = material.tissue() else {
        return bsdf;
    };
    let prospect = |bsdf: Element| {
        bsdf.string("prospect", absorption_file(tissue.palette))
            .boolean("extrapolate", extrapolate)
    };
    match tissue.holds {
        Holds::Contents(contents) => {
            let bsdf = prospect(bsdf.string("tissue", "contents"));
            let contents = (**contents).into_iter();
            contents.fold(bsdf, |bsdf, (constituent, value)| {
                bsdf.float(constituent.channel(), value)
            })
        }
        Holds::Map(_) => {
            let bsdf = bsdf.string("tissue", "map");
            prospect(bsdf.string("map", format_args!("maps/{id}.exr")))
        }
        Holds::Unknown => bsdf.string("tissue", "measured"),
    }
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
