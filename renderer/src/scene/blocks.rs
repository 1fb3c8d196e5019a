//! The blocks of a scene file, each declared once: see [`leafmodel::document`].
//!
//! - **In**: the tree of a file, with overrides applied.
//! - **Out**: an [`Authored`] scene with names resolved and units in SI, or every error of the file;
//!   the same declarations as a schema.
//! - **Always true**: a scene is returned only if there is no error; its numbers are finite
//!   and in range, indices are valid, files lie in the scene's folder.

mod camera;
mod daylight;
mod film;
mod fluorescence;
mod gltf;
mod instances;
mod instrument;
mod integrator;
mod leaf;
mod light;
mod material;
mod measured;
mod medium;
mod mesh;
mod name_list;
mod object;
mod picture;
mod placement;
mod plant;
mod references;
mod reflectance;
mod rig;
mod scatter;
mod sensitivities;
mod solid;
mod spectrum;
mod table_file;
mod volume;

use std::path::PathBuf;
use std::rc::Rc;

use leafmodel::document::context::Context;
use leafmodel::document::error::DocumentError;
use leafmodel::document::keys::{Keys, NamedList};
use leafmodel::document::names::{Named, require_title};
use leafmodel::document::reader::Block;
use leafmodel::document::schema::BlockSchema;
use leafmodel::document::sections::Names;
use leafmodel::document::source::Place;
use leafmodel::document::tree::Table;
use leafmodel::document::value_kind::{FilePath, Flag, NamedFile, Text};
use leafmodel::leaf::LeafPlan;
use leafmodel::plan_file::{self, EXTRAPOLATE, read_leaves};

pub(crate) use self::solid::solid;
use super::authored::{Authored, Light, Object, Plant};
use super::description::{
    self, Instrument, InstrumentKind, Leaf, Material, Medium, Mesh, Picture, Reflectance, Sample,
    Solid, Spectrum,
};

/// All keys at the top of a scene file.
const SECTIONS: [&str; 16] = [
    "format",
    "name",
    "extrapolate",
    "film",
    "picture",
    "camera",
    "integrator",
    "instruments",
    "media",
    "materials",
    "meshes",
    "leaves",
    "solids",
    "plants",
    "lights",
    "objects",
];

/// What a scene is read for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Purpose {
    /// A picture: spectra must cover the wavelengths of the film.
    Picture,
    /// Its instruments: spectra of surfaces must cover their wavelengths. Lights do nothing.
    Instruments,
}

/// Reads a whole file. Errors are left in the context; if there is none, the scene is returned.
pub(crate) fn read(
    cx: &Context,
    tree: &Table,
    default_name: &str,
    text: String,
    purpose: Purpose,
) -> Option<Authored> {
    let mut authored = Authored::empty(default_name, text);
    let root = root(cx, tree);
    Keys::read(root, None, |keys| {
        if let Some(root) = keys.reader() {
            let names = references::SECTIONS.map(|section| {
                let names = Names::of(root, section, &SECTIONS);
                (section, Rc::new(names))
            });
            cx.sections.borrow_mut().extend(names);
        }
        scene(&mut authored, keys, purpose);
    });
    (cx.error_count() == 0).then_some(authored)
}

/// Reports why a scene that was read cannot be expanded.
pub(crate) fn refuse(cx: &Context, tree: &Table, path: &[String], problem: String, help: &str) {
    Keys::read(root(cx, tree), None, |keys| {
        let path: Vec<&str> = path.iter().map(String::as_str).collect();
        keys.refuse(&path, problem, help);
        keys.leave(&SECTIONS);
    });
}

/// Reads only the leaves of a file, which may lack everything else. Errors are left in the context.
pub(crate) fn read_only_leaves(cx: &Context, tree: &Table) -> Option<Vec<Named<Leaf>>> {
    // The other sections of a scene are not checked here.
    read_leaves(cx, tree, &plan_file::SECTIONS, leaf::leaf)
}

/// Reads only `[picture]` of a file. Errors are left in the context.
pub(crate) fn read_only_picture(cx: &Context, tree: &Table) -> Option<Picture> {
    let mut picture = Picture::default();
    Keys::read(root(cx, tree), None, |keys| {
        let about = "How the picture to look at is made from the film.";
        keys.block("picture", about, |keys| {
            picture::picture(&mut picture, keys);
        });
        keys.leave(&SECTIONS);
    });
    (cx.error_count() == 0).then_some(picture)
}

/// The schema of a scene file.
pub(crate) fn schema() -> BlockSchema {
    let mut empty = Authored::empty("", String::new());
    Keys::describe(|keys| scene(&mut empty, keys, Purpose::Picture))
}

fn root<'a>(cx: &'a Context, tree: &'a Table) -> Block<'a> {
    let start = Place {
        source: 0,
        span: 0..0,
    };
    Block::new(cx, tree, String::new(), start)
}

/// The keys of a scene.
fn scene(scene: &mut Authored, keys: &mut Keys<'_>, purpose: Purpose) {
    plan_file::format(keys);
    let mut name = None;
    let about = "What the scene is called, and its pictures; left out, as the folder or file is.";
    keys.optional("name", &mut name, Text("a name"), about);
    if let (Some(name), Some(root)) = (name, keys.reader()) {
        let at = root.node("name").map_or(&root.at, |node| &node.at);
        require_title(root.cx, &name, at);
        scene.name = name;
    }
    let mut extrapolate = false;
    keys.key("extrapolate", &mut extrapolate, Flag, EXTRAPOLATE);
    if let Some(root) = keys.reader() {
        root.cx.extrapolate.set(extrapolate);
    }
    // The film comes first, since it sets the wavelengths that spectra must cover.
    let about = "What is recorded, and how well.";
    keys.required_block("film", about, &["rgb", "spectral"], |keys| {
        film::film(&mut scene.film, keys);
    });
    fluorescence::tell_range(keys);
    let about = "How the picture to look at is made from the film.";
    keys.block("picture", about, |keys| {
        picture::picture(&mut scene.picture, keys);
    });
    let about = "Where the scene is seen from.";
    keys.required_block("camera", about, &camera::NAMES, |keys| {
        camera::camera(&mut scene.camera, keys);
    });
    let about = "How light is followed.";
    keys.block("integrator", about, |keys| {
        integrator::integrator(&mut scene.integrator, keys);
    });
    let about = "Instruments, which `lamina instruments` reads out.";
    let new = || Instrument::usual(InstrumentKind::Sphere(Sample::usual()));
    section(
        keys,
        "instruments",
        &mut scene.instruments,
        &new,
        about,
        instrument::instrument,
    );
    if purpose == Purpose::Instruments {
        instrument::tell_range(scene, keys);
    }
    sections(scene, keys, purpose);
    if keys.reader().is_some() {
        references::check(scene, keys, purpose);
    }
}

/// The named blocks.
fn sections(scene: &mut Authored, keys: &mut Keys<'_>, purpose: Purpose) {
    let about = "What fills bodies.";
    section(
        keys,
        "media",
        &mut scene.media,
        &Medium::clear,
        about,
        medium::medium,
    );
    let about = "What surfaces are made of.";
    let new = || Material::Diffuse {
        reflectance: Reflectance::Even(Spectrum::Constant(0.0)),
    };
    section(
        keys,
        "materials",
        &mut scene.materials,
        &new,
        about,
        material::material,
    );
    let about = "Shapes as triangles.";
    section(
        keys,
        "meshes",
        &mut scene.meshes,
        &Mesh::unit_sphere,
        about,
        mesh::mesh,
    );
    let about = "Leaves that are grown.";
    let new = || Leaf::from(LeafPlan::of_length(100.0));
    section(keys, "leaves", &mut scene.leaves, &new, about, leaf::leaf);
    let about = "Bodies of solid tissue.";
    section(
        keys,
        "solids",
        &mut scene.solids,
        &Solid::usual,
        about,
        solid,
    );
    let about = "Boughs and shoots that bear leaves.";
    let new = || Plant {
        plan: plan_file::usual_plant(),
        leaves: Vec::new(),
        days: None,
        bark: None,
        perianth: [None; 2],
        potting: [None; 2],
        walls: Vec::new(),
    };
    section(keys, "plants", &mut scene.plants, &new, about, plant::plant);
    if purpose == Purpose::Instruments
        && let Some(root) = keys.reader()
    {
        root.cx.range_nm.set(None);
    }
    let about = "Lights; there is one at least.";
    let new = || {
        Light::Single(description::Light::Constant {
            radiance: Spectrum::Constant(0.0),
        })
    };
    section(keys, "lights", &mut scene.lights, &new, about, light::light);
    let about = "What stands in the scene; there is one at least.";
    section(
        keys,
        "objects",
        &mut scene.objects,
        &Object::nowhere,
        about,
        object::object,
    );
}

fn section<T>(
    keys: &mut Keys<'_>,
    name: &'static str,
    blocks: &mut Vec<Named<T>>,
    new: &dyn Fn() -> T,
    about: &'static str,
    declare: impl Fn(&mut T, &mut Keys<'_>),
) {
    let list = NamedList {
        required: false,
        new: &|name: &str| Named {
            name: name.to_owned(),
            value: new(),
        },
        name_of: |block: &Named<T>| &block.name,
    };
    keys.named(name, blocks, &list, about, |block, keys| {
        declare(&mut block.value, keys);
    });
}

/// Reports an error at a key of the present block, or at the block if the key is missing.
fn report(keys: &Keys<'_>, key: &str, error: DocumentError) {
    keys.report(&[key], error);
}

/// The key `layer` of a picture.
fn picture_layer(layer: &mut Option<String>, keys: &mut Keys<'_>) {
    const LAYER: Text = Text("the name of a layer of the EXR");
    let about = "The layer of an EXR whose channels R, G and B, or Y alone, are used: `sky` has `sky.R`. \
        Without it the channels without a layer are.";
    keys.optional("layer", layer, LAYER, about);
}

/// A key with the path of a file that must exist.
fn file(
    keys: &mut Keys<'_>,
    key: &'static str,
    file: &mut PathBuf,
    path: FilePath,
    about: &'static str,
) {
    let mut named = NamedFile::default();
    keys.required(key, &mut named, path, about);
    *file = named.file;
}
