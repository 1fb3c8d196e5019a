//! Materials.

use crate::export::element::{Element, Layout};
use crate::material;
use crate::material::held::Held;
use crate::scene::description::material::leaf::LeafTissue;
use crate::scene::description::{
    Description, LeafFaces, LeafOptics, Material, Reflectance, SolidOptics,
};
use crate::scene::world::{MaterialOwner, World};

use super::colours;
use super::spectra::Spectra;
use super::units::material_id;
use super::{absorption_file, relief_file};

/// Plugin for leaves, in `reference/`.
const LEAF: &str = "lamina_leaf";
/// Plugin for leaves with a relief, in `reference/`.
const RELIEF: &str = "lamina_relief";
/// Plugin for diffuse bodies below a coat, in `reference/`.
const PLASTIC: &str = "lamina_plastic";
/// Plugin for the materials of models, in `reference/`.
const MODEL: &str = "lamina_model";
/// Plugin for solid tissue, in `reference/`.
const SOLID: &str = "lamina_solid";

/// The faces of a leaf.
const FACES: [&str; 2] = ["adaxial", "abaxial"];

/// The block of a leaf through whose layers light is followed, which Mitsuba does not do.
pub(super) fn layered(scene: &Description) -> Option<String> {
    let leaves = scene.leaves.iter();
    let leaves = leaves.map(|leaf| ("leaves", &leaf.name, Some(&leaf.value.faces)));
    let materials = scene.materials.iter().map(|material| {
        let faces = if let Material::Leaf(leaf) = &material.value {
            Some(&leaf.faces)
        } else {
            None
        };
        ("materials", &material.name, faces)
    });
    let mut all = leaves.chain(materials);
    let found =
        all.find(|(_, _, faces)| faces.is_some_and(|faces| faces.optics == LeafOptics::Layers));
    found.map(|(block, name, _)| match block {
        "materials" => format!("{block}.{name}.leaf"),
        _ => format!("{block}.{name}"),
    })
}

/// Whether light that a material takes up comes out at other wavelengths. Measured spectra do not
/// say what chlorophyll absorbs.
pub(super) fn fluoresces(material: &Material) -> bool {
    matches!(material, Material::Leaf(leaf) if leaf.fluorescence.is_some() && material.held().is_some())
}

/// Whether a material becomes a BSDF of Mitsuba's own that scatters.
pub(super) fn is_stock(material: &material::Material) -> bool {
    match material {
        material::Material::Diffuse(_) => true,
        material::Material::Dielectric(dielectric) => dielectric.eta != 1.0,
        material::Material::Plastic(_)
        | material::Material::Model(_)
        | material::Material::Leaf(_)
        | material::Material::Solid(_) => false,
    }
}

/// The material with this number.
pub(super) fn bsdf(
    scene: &Description,
    world: &World,
    material: usize,
    spectra: &mut Spectra,
) -> Element {
    let id = material_id(scene, world, material);
    let own = &world.materials[material];
    let plugin = |name, extrapolate| {
        let bsdf = Element::plugin("bsdf", name).called(&id);
        tissue(bsdf, &id, own, extrapolate)
    };
    let number = match world.owners[material] {
        MaterialOwner::Leaf { leaf, .. } => {
            let leaf = &scene.leaves[leaf].value;
            let kind = if own.relief().is_some() { RELIEF } else { LEAF };
            let mut bsdf = light_spread(plugin(kind, leaf.extrapolate), own);
            if own.relief().is_some() {
                bsdf = bsdf.string("relief", relief_file(&id));
            }
            if let material::Material::Leaf(leaf) = own
                && let Some(face) = leaf.half_face()
            {
                bsdf = bsdf.string("half", FACES[face]);
            }
            return leaf_faces(bsdf, &leaf.faces_by_age(), spectra);
        }
        MaterialOwner::Solid(solid) => {
            let solid = &scene.solids[solid].value;
            return solid_optics(plugin(SOLID, solid.extrapolate), &solid.optics);
        }
        MaterialOwner::Scene(number) => number,
    };
    match &scene.materials[number].value {
        Material::Diffuse(of) => {
            let one_side = Element::plugin("bsdf", "diffuse");
            Element::plugin("bsdf", "twosided")
                .called(&id)
                .holding(one_side.holding(shared(&id, own, &of.reflectance, spectra)))
                .laid_out(Layout::Inline)
        }
        // Mitsuba's boundary without a change of index; it is no event on a path either.
        Material::Dielectric(of) if of.eta == 1.0 => Element::plugin("bsdf", "null").called(&id),
        Material::Dielectric(of) => {
            let is_rough = of.roughness > 0.0;
            let kind = if is_rough {
                "roughdielectric"
            } else {
                "dielectric"
            };
            let bsdf = Element::plugin("bsdf", kind)
                .called(&id)
                .float("int_ior", of.eta)
                .float("ext_ior", 1.0);
            if is_rough {
                bsdf.string("distribution", "ggx")
                    .float("alpha", of.roughness)
            } else {
                bsdf
            }
        }
        Material::Plastic(of) => Element::plugin("bsdf", PLASTIC)
            .called(&id)
            .float("eta", of.eta)
            .float("alpha", of.roughness)
            .holding(shared(&id, own, &of.reflectance, spectra)),
        Material::Model(_) => model(&id, own),
        Material::Leaf(leaf) => {
            let bsdf = match &leaf.tissue {
                LeafTissue::Held(held) => plugin(LEAF, held.extrapolates()),
                LeafTissue::Measured {
                    reflectance,
                    transmittance,
                } => plugin(LEAF, false)
                    .holding(spectra.element("reflectance", reflectance, 1.0))
                    .holding(spectra.element("transmittance", transmittance, 1.0)),
            };
            leaf_faces(bsdf, &leaf.faces, spectra)
        }
        Material::Solid(solid) => {
            solid_optics(plugin(SOLID, solid.held.extrapolates()), &solid.optics)
        }
    }
}

/// The materials of a model.
fn model(id: &str, own: &material::Material) -> Element {
    let material::Material::Model(model) = own else {
        unreachable!("it was built of one")
    };
    let maps = ["colours", "finish", "normals"].into_iter();
    let maps = maps.zip(colours::maps(id, own));
    let maps = maps.map(|(name, (id, map))| colours::texture(&id, name, Some(&map)));
    let bsdf = Element::plugin("bsdf", MODEL).called(id).holding_all(maps);
    let scales = model.normal_scales().enumerate();
    scales.fold(bsdf, |bsdf, (slot, scale)| {
        bsdf.float(&format!("normal_scale_{slot}"), f64::from(scale))
    })
}

/// The parameter `reflectance`: a spectrum, or a texture that is written to files beside.
fn shared(
    id: &str,
    material: &material::Material,
    reflectance: &Reflectance,
    spectra: &mut Spectra,
) -> Element {
    match (reflectance, material.colour_map()) {
        (Reflectance::Even(spectrum), _) => spectra.element("reflectance", spectrum, 1.0),
        (Reflectance::Picture(_) | Reflectance::OfMesh(_), map) => {
            colours::texture(id, "reflectance", map)
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
    match tissue.held {
        Some(Held::Uniform(contents)) => {
            let bsdf = prospect(bsdf.string("tissue", "contents"));
            let contents = (**contents).into_iter();
            contents.fold(bsdf, |bsdf, (constituent, value)| {
                bsdf.float(constituent.channel(), value)
            })
        }
        Some(Held::Map(_)) => {
            let bsdf = bsdf.string("tissue", "map");
            prospect(bsdf.string("map", format_args!("maps/{id}.exr")))
        }
        None => bsdf.string("tissue", "measured"),
    }
}

/// Adds one thickness of the blade in texture coordinates, if light spreads sideways in it.
fn light_spread(bsdf: Element, material: &material::Material) -> Element {
    let material::Material::Leaf(leaf) = material else {
        return bsdf;
    };
    let Some(spread) = leaf.spread() else {
        return bsdf;
    };
    let [u, v] = spread.thickness_uv().to_array();
    bsdf.float("spread_u", f64::from(u))
        .float("spread_v", f64::from(v))
}

fn leaf_faces(bsdf: Element, faces: &LeafFaces, spectra: &mut Spectra) -> Element {
    let coats = FACES.into_iter().zip(&faces.coats);
    let bsdf = coats.fold(bsdf, |bsdf, (face, coat)| {
        bsdf.float(&format!("{face}_eta"), coat.eta)
            .float(&format!("{face}_alpha_across"), coat.alpha_across)
            .float(&format!("{face}_alpha_along"), coat.alpha_along)
    });
    let known = [
        ("abaxial_ratio", &faces.abaxial_ratio),
        ("abaxial_reflectance", &faces.abaxial_reflectance),
    ];
    let known = known.into_iter();
    let known = known.filter_map(|(name, spectrum)| Some((name, spectrum.as_ref()?)));
    known.fold(bsdf, |bsdf, (name, spectrum)| {
        bsdf.holding(spectra.element(name, spectrum, 1.0))
    })
}

fn solid_optics(bsdf: Element, optics: &SolidOptics) -> Element {
    bsdf.float("depth_mm", optics.tissue.depth_mm)
        .float("scattering_per_mm", optics.tissue.scattering_per_mm)
        .float("eta", optics.tissue.eta)
        .float("coat_eta", optics.coat.eta)
        .float("coat_alpha", optics.coat.alpha_across)
}
