//! `[materials.NAME.…]`: diffuse, dielectric, plastic, gltf, leaf, solid.

use std::path::PathBuf;

use leafmodel::document::declared::Declared;
use leafmodel::document::keys::{Keys, Variant};
use leafmodel::document::limits::Limits;
use leafmodel::document::names::NameIn;
use leafmodel::document::value_kind::{FilePath, Number};
use leafmodel::optics::{Contents, Pigments};
use leafmodel::plan_file::{self, require_prospect};
use leafmodel::solid::held_contents;

use super::fluorescence::fluorescence;
use super::leaf::{DARK_LAYERS, faces, impossible};
use super::measured::{measured, set_abaxial};
use super::reflectance::{model, reflectance};
use super::solid::optics;
use crate::scene::description::{
    Held, LeafFaces, LeafOptics, LeafTissue, Material, Reflectance, SolidOptics, Spectrum,
};

/// Largest map of contents that is read, bytes.
const MOST_MAP_BYTES: u64 = 4 << 30;

/// The keys of one of `[materials]`.
pub(super) fn material(material: &mut Material, keys: &mut Keys<'_>) {
    keys.kind(material, &KINDS);
}

const KINDS: [Variant<Material>; 6] = [
    Variant {
        name: "diffuse",
        about: "Lambertian.",
        new: || Material::Diffuse {
            reflectance: Reflectance::Even(Spectrum::Constant(0.0)),
        },
        is: |material| matches!(material, Material::Diffuse { .. }),
        declare: |material, keys| {
            if let Material::Diffuse { reflectance: of } = material {
                reflectance(of, "Share of light that is reflected.", keys);
            }
        },
    },
    Variant {
        name: "dielectric",
        about: "A smooth or rough (GGX) boundary of a transparent medium.",
        new: || Material::Dielectric {
            eta: 1.5,
            roughness: 0.0,
            interior: None,
        },
        is: |material| matches!(material, Material::Dielectric { .. }),
        declare: |material, keys| {
            if let Material::Dielectric {
                eta,
                roughness,
                interior,
            } = material
            {
                dielectric((eta, roughness, interior), keys);
            }
        },
    },
    Variant {
        name: "plastic",
        about: "A diffuse body below a rough clear coat: glaze, varnish, waxy bark and rind.",
        new: || Material::Plastic {
            reflectance: Reflectance::Even(Spectrum::Constant(0.0)),
            eta: 1.5,
            roughness: 0.2,
        },
        is: |material| matches!(material, Material::Plastic { .. }),
        declare: plastic,
    },
    Variant {
        name: "gltf",
        about: "The materials of a mesh from a glTF file: base colour, metal, roughness, normals.",
        // Replaced when the key is read.
        new: || Material::Model { mesh: usize::MAX },
        is: |material| matches!(material, Material::Model { .. }),
        declare: |material, keys| {
            if let Material::Model { mesh } = material {
                let about = "Each part of that mesh has its own material.";
                model(mesh, about, keys);
            }
        },
    },
    Variant {
        name: "leaf",
        about: "A leaf of uniform contents, of a map of contents, or of measured spectra.",
        new: || Material::Leaf {
            tissue: LeafTissue::Held(NOTHING),
            pigments: Box::default(),
            faces: LeafFaces::usual(),
            fluorescence: None,
        },
        is: |material| matches!(material, Material::Leaf { .. }),
        declare: |material, keys| {
            if let Material::Leaf {
                tissue,
                pigments,
                faces: both,
                fluorescence: emission,
            } = material
            {
                let abaxial = leaf_tissue(tissue, keys);
                keys.exclude("measured", "pigments");
                pigments_block(pigments, keys);
                faces(both, keys);
                set_abaxial(both, abaxial, keys);
                keys.exclude("measured", "fluorescence");
                fluorescence(emission, keys);
                if both.optics == LeafOptics::Layers && emission.is_some() {
                    impossible(keys, DARK_LAYERS, "leave `fluorescence` out, or `optics`");
                }
                if both.optics == LeafOptics::Layers
                    && matches!(tissue, LeafTissue::Measured { .. })
                {
                    impossible(
                        keys,
                        "layers need contents, and measured spectra say nothing of the inside",
                        "give contents or a map, or leave `optics` out",
                    );
                }
            }
        },
    },
    Variant {
        name: "solid",
        about: "Solid tissue of uniform contents or of a map of contents.",
        new: || Material::Solid {
            held: NOTHING,
            pigments: Box::default(),
            optics: SolidOptics::usual(),
        },
        is: |material| matches!(material, Material::Solid { .. }),
        declare: |material, keys| {
            if let Material::Solid {
                held,
                pigments,
                optics: solid,
            } = material
            {
                solid_tissue(held, keys);
                pigments_block(pigments, keys);
                optics(solid, keys);
            }
        },
    },
];

fn dielectric(
    (eta, roughness, interior): (&mut f64, &mut f64, &mut Option<usize>),
    keys: &mut Keys<'_>,
) {
    let limits = Number(Limits::closed(0.25, 4.0));
    let about = "Refractive index inside over outside; the normal points outside. 1 is no boundary: \
        light goes straight on.";
    keys.key("eta", eta, limits, about);
    let limits = Number(Limits::closed(0.0, 1.0));
    let about = "GGX roughness; 0 is smooth.";
    keys.key("roughness", roughness, limits, about);
    let kind = NameIn("media", "the name of a medium");
    let about = "What fills the body, whose mesh is closed; left out, it is clear.";
    keys.optional("interior", interior, kind, about);
    if keys.is_sound() && *eta == 1.0 && *roughness > 0.0 {
        let problem = "a boundary with the same index on both sides cannot be rough".to_owned();
        let help = "leave `roughness` out, or write another `eta`";
        keys.refuse(&["roughness"], problem, help);
    }
}

fn plastic(material: &mut Material, keys: &mut Keys<'_>) {
    if let Material::Plastic {
        reflectance: of,
        eta,
        roughness,
    } = material
    {
        let about = "Share of the light that passes the coat which the body sends back.";
        reflectance(of, about, keys);
        let limits = Number(Limits::closed(1.0, 2.5));
        let about = "Refractive index of the coat; 1 is none.";
        keys.key("eta", eta, limits, about);
        let limits = Number(Limits::closed(0.02, 1.0));
        let about = "GGX roughness of the coat: glaze 0.05, satin 0.3, matt 0.6 (our estimates).";
        keys.key("roughness", roughness, limits, about);
    }
}

/// Contents before any are read.
const NOTHING: Held = Held::Contents {
    contents: Contents::NOTHING,
    extrapolate: false,
};

const HELD: &str = "What it holds.";
const MAP: &str = "A map of what it holds.";

fn pigments_block(pigments: &mut Pigments, keys: &mut Keys<'_>) {
    let about = "Which substances its pigments are.";
    keys.block("pigments", about, |keys| {
        pigments.declare(keys);
    });
}

/// The tissue; the ratio of its faces, if both were measured.
fn leaf_tissue(tissue: &mut LeafTissue, keys: &mut Keys<'_>) -> Option<Spectrum> {
    let mut ratio = None;
    let extrapolate = keys
        .reader()
        .is_some_and(|block| block.cx.extrapolate.get());
    // A named preset needs no contents, but contents may be given to change it.
    let mut contents = match tissue {
        LeafTissue::Held(Held::Contents { contents, .. }) => *contents,
        LeafTissue::Held(Held::Map { .. }) | LeafTissue::Measured { .. } => Contents::NOTHING,
    };
    plan_file::colour_preset(&mut contents, keys);
    if keys.base().is_some() {
        for other in ["map", "measured"] {
            keys.exclude("preset", other);
        }
        let about = "What of the preset's contents is different.";
        keys.block("contents", about, |keys| {
            plan_file::contents(&mut contents, keys);
        });
        require_prospect(keys);
        *tissue = LeafTissue::Held(Held::Contents {
            contents,
            extrapolate,
        });
        return ratio;
    }
    for kind in keys.one_of(&["contents", "map", "measured"], Some("contents")) {
        match kind {
            "contents" => keys.required_block("contents", HELD, &[], |keys| {
                require_prospect(keys);
                plan_file::contents(&mut contents, keys);
                *tissue = LeafTissue::Held(Held::Contents {
                    contents,
                    extrapolate,
                });
            }),
            "map" => keys.required_block("map", MAP, &[], |keys| {
                let file = map_file(keys);
                *tissue = LeafTissue::Held(Held::Map { file, extrapolate });
            }),
            _ => {
                let about = "Measured spectra of a leaf.";
                keys.required_block("measured", about, &[], |keys| {
                    (*tissue, ratio) = measured(keys).into_parts();
                });
            }
        }
    }
    ratio
}

fn solid_tissue(held: &mut Held, keys: &mut Keys<'_>) {
    let extrapolate = keys
        .reader()
        .is_some_and(|block| block.cx.extrapolate.get());
    for kind in keys.one_of(&["contents", "map"], Some("contents")) {
        if kind == "contents" {
            keys.required_block("contents", HELD, &[], |keys| {
                require_prospect(keys);
                let mut contents: Contents = Contents::NOTHING;
                held_contents(&mut contents, keys);
                *held = Held::Contents {
                    contents,
                    extrapolate,
                };
            });
        } else {
            keys.required_block("map", MAP, &[], |keys| {
                let file = map_file(keys);
                *held = Held::Map { file, extrapolate };
            });
        }
    }
}

fn map_file(keys: &mut Keys<'_>) -> PathBuf {
    const PATH: FilePath =
        FilePath::of("the path of an EXR with contents", &["exr"], MOST_MAP_BYTES);
    require_prospect(keys);
    let mut file = PathBuf::new();
    super::file(
        keys,
        "file",
        &mut file,
        PATH,
        "A channel for each of the contents, by its name without the unit, over uv; those of betalains may \
         be absent; the first row of the picture is v = 0.",
    );
    file
}
