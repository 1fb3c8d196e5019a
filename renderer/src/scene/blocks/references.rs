//! Conditions between the blocks of a scene.

use std::collections::BTreeSet;

use leafmodel::document::context::{ENOUGH, QUOTED};
use leafmodel::document::error::DocumentError;
use leafmodel::document::keys::Keys;
use leafmodel::document::nearest::nearest;
use leafmodel::document::sections::singular;
use leafmodel::document::source::escaped;
use leafmodel::document::values::listed;

use crate::scene::authored::{Authored, Light};
use crate::scene::description::instrument::incident::{covers_par, is_dark};
use crate::scene::description::{self, InstrumentKind, Material, Mesh, Named, ObjectShape};

/// Sections to whose blocks others refer.
pub(super) const SECTIONS: [&str; 8] = [
    "media",
    "meshes",
    "materials",
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

/// Checks the scene as a whole; `keys` are those at its top.
pub(super) fn check(scene: &Authored, keys: &Keys<'_>, purpose: Purpose) {
    let Some(root) = keys.reader() else {
        return;
    };
    let cx = root.cx;
    let are_missing = |section| cx.names(section).is_some_and(|names| names.are_missing());
    if are_missing("lights") && purpose == Purpose::Picture {
        cx.error_of_the_file(DocumentError::NoLight);
    }
    if are_missing("objects") {
        cx.error_of_the_file(DocumentError::NoObject);
    }
    check_cards(scene, keys);
    check_white_light(scene, keys);
    check_shining(scene, keys);
    check_strewn(scene, keys);
    check_colours(scene, keys);
    check_samples(scene, keys);
    check_draws(scene, keys);
    check_incident(scene, keys);
    if cx.error_count() == 0 {
        warn_of_the_unused(scene, keys);
    }
}

/// The objects by which the picture is balanced and exposed are there.
fn check_cards(scene: &Authored, keys: &Keys<'_>) {
    let picture = &scene.picture;
    for (key, name) in [
        ("grey_object", &picture.grey_object),
        ("white_object", &picture.white_object),
    ] {
        let Some(name) = name else { continue };
        if !scene.objects.iter().any(|object| object.name == *name) {
            let problem = format!("there is no object `{}`", escaped(name, QUOTED));
            let help = "write the name of one of `[objects]` that the camera sees";
            keys.refuse(&["picture", key], problem, help);
        }
    }
}

/// The light by which the picture is balanced is there.
fn check_white_light(scene: &Authored, keys: &Keys<'_>) {
    let Some(name) = &scene.picture.white_light else {
        return;
    };
    let mut known = Vec::new();
    for light in &scene.lights {
        known.push(light.name.clone());
        if matches!(light.value, Light::Single(description::Light::Daylight(_))) {
            known.extend(["sun", "sky"].map(|part| format!("{}.{part}", light.name)));
        }
    }
    // That there is no light at all is reported already.
    if known.is_empty() || known.contains(name) {
        return;
    }
    let names = || known.iter().map(String::as_str);
    let error = DocumentError::UnknownName {
        kind: "light",
        name: escaped(name, QUOTED),
        nearest: nearest(name, names().take(ENOUGH)).map(|name| escaped(name, QUOTED)),
        known: listed(names()),
    };
    keys.report(&["picture", "white_light"], error);
}

/// An area light needs a mesh object, and an object has at most one area light.
fn check_shining(scene: &Authored, keys: &Keys<'_>) {
    let mut shining = BTreeSet::new();
    let is_plain = |mesh: usize| {
        let mesh = scene.meshes.get(mesh);
        mesh.is_some_and(|mesh| !matches!(mesh.value, Mesh::Gltf(_)))
    };
    for light in &scene.lights {
        let Light::Single(description::Light::Area(area)) = &light.value else {
            continue;
        };
        // An unknown name is reported where it is written.
        let Some(named) = scene.objects.get(area.object) else {
            continue;
        };
        let placed = &named.value.placed;
        let shape = placed.shapes.first();
        let problem = if named.value.plant.is_some() {
            "is a plant, and plants do not shine"
        } else if placed.instances.is_some() || placed.is_spread() {
            "has instances, and those do not shine"
        } else if matches!(shape, Some(ObjectShape::Leaf { .. })) {
            "is a leaf, and leaves do not shine"
        } else if matches!(shape, Some(ObjectShape::Solid { .. })) {
            "is a body of solid tissue, and those do not shine"
        } else if shape.is_some_and(|shape| is_no_surface(scene, *shape)) {
            "is the boundary of a medium, and those do not shine"
        } else if shining.insert(area.object) {
            if area.pattern.emission && placed.first_mesh().is_some_and(is_plain) {
                let problem = format!("`{}` has no mesh from a glTF file", named.name);
                let help = "leave `emission` out, or name an object with a mesh of the kind `gltf`";
                let path = ["lights", &light.name, "area", "emission"];
                keys.refuse(&path, problem, help);
            }
            continue;
        } else {
            "has an area light already"
        };
        let error = DocumentError::CannotShine {
            object: named.name.clone(),
            problem: problem.to_owned(),
        };
        keys.report_at_key(&["lights", &light.name], error);
    }
}

/// Whether a shape is a mesh whose material is the boundary of a medium or no boundary at all.
fn is_no_surface(scene: &Authored, shape: ObjectShape) -> bool {
    let material = shape.mesh().and_then(|(_, own)| scene.materials.get(own));
    material.is_some_and(|named| named.value.is_transparent_to_paths())
}

/// What is strewn on something that is strewn itself stands behind it in the file.
fn check_strewn(scene: &Authored, keys: &Keys<'_>) {
    for (number, object) in scene.objects.iter().enumerate() {
        let Some(strewn) = &object.value.placed.strewn else {
            continue;
        };
        let on = std::iter::once(("on", strewn.on));
        for (key, below) in on.chain(strewn.over.iter().map(|below| ("over", *below))) {
            let Some(named) = scene.objects.get(below) else {
                continue;
            };
            let problem = if below == number {
                "an object cannot lie on itself".to_owned()
            } else if below > number && named.value.placed.is_spread() {
                format!("`{}` is strewn later itself", named.name)
            } else {
                continue;
            };
            let help = "name an object in its place, or one that is strewn further up in the file";
            keys.refuse(&["objects", &object.name, "scatter", key], problem, help);
        }
    }
}

/// The sample of a sphere or a goniometer stands in one place.
fn check_samples(scene: &Authored, keys: &Keys<'_>) {
    for instrument in &scene.instruments {
        let sample = match &instrument.value.kind {
            InstrumentKind::Sphere(sample) => sample,
            InstrumentKind::Gonio(gonio) => &gonio.sample,
            InstrumentKind::Canopy(_) | InstrumentKind::Depth(_) => continue,
        };
        // An unknown name is reported where it is written.
        let Some(object) = scene.objects.get(sample.object) else {
            continue;
        };
        let placed = &object.value.placed;
        if placed.instances.is_some() || object.value.plant.is_some() || placed.is_spread() {
            let problem = format!("`{}` stands in more than one place", object.name);
            let help = "name an object with one mesh, leaf or solid in one place";
            let path = [
                "instruments",
                &instrument.name,
                instrument.value.word(),
                "object",
            ];
            keys.refuse(&path, problem, help);
        }
    }
}

/// Several draws of the leaves need something that is drawn.
fn check_draws(scene: &Authored, keys: &Keys<'_>) {
    let mut objects = scene.objects.iter();
    if objects.any(|object| object.value.placed.is_spread()) {
        return;
    }
    for instrument in &scene.instruments {
        if instrument.value.realisations() > 1 {
            let kind = instrument.value.word();
            let path = ["instruments", &instrument.name, kind, "realisations"];
            let problem =
                "nothing in the scene is scattered or floats: all draws would be alike".to_owned();
            keys.refuse(
                &path,
                problem,
                "leave it out, or give an object a `scatter` or a `volume`",
            );
        }
    }
}

/// A light whose spectrum an instrument takes has one, with light in it.
fn check_incident(scene: &Authored, keys: &Keys<'_>) {
    for instrument in &scene.instruments {
        let incident = instrument.value.incident.as_ref();
        let light = incident.and_then(|incident| scene.lights.get(incident.light?));
        let Some(light) = light else { continue };
        let name = &light.name;
        let spectrum = match &light.value {
            Light::Single(light) => Some(light.relative_spectrum()),
            Light::Rig(_) => None,
        };
        let problem = match spectrum {
            None => format!("`{name}` is a rig of several lights"),
            Some(spectrum) if !covers_par(&spectrum) => {
                format!("the spectrum of `{name}` does not cover 400 to 700 nm")
            }
            Some(spectrum) if is_dark(&spectrum) => {
                format!("`{name}` has no light from 400 to 700 nm")
            }
            Some(_) => continue,
        };
        let kind = instrument.value.word();
        let path = ["instruments", &instrument.name, kind, "incident", "light"];
        keys.refuse(&path, problem, "write a `spectrum` instead");
    }
}

/// A material that takes the colours of a mesh needs one from a glTF file, and is made for that.
fn check_colours(scene: &Authored, keys: &Keys<'_>) {
    let taken = |material: &Named<Material>| material.value.colours_of();
    for material in &scene.materials {
        // An unknown name is reported where it is written.
        let Some(mesh) = taken(material).and_then(|mesh| scene.meshes.get(mesh)) else {
            continue;
        };
        if !matches!(mesh.value, Mesh::Gltf(_)) {
            let problem = format!(
                "the mesh `{}` is from no glTF file and has no colours",
                mesh.name
            );
            let help = if material.value.reflectance().is_some() {
                "write `reflectance` or `picture` instead, or name a mesh of the kind `gltf`"
            } else {
                "name a mesh of the kind `gltf`"
            };
            let kind = material.value.kind();
            keys.refuse(&["materials", &material.name, kind, "mesh"], problem, help);
        }
    }
    for plant in &scene.plants {
        let [pot, soil] = plant.value.potting;
        let own = [
            ("bark", plant.value.bark),
            ("pot_material", pot),
            ("soil_material", soil),
        ];
        for (key, material) in own {
            let material = material.and_then(|material| scene.materials.get(material));
            if let Some(material) = material.filter(|material| taken(material).is_some()) {
                let problem = format!("the material `{}` has the colours of a mesh", material.name);
                let help = "use a material with a reflectance of its own";
                keys.refuse(&["plants", &plant.name, key], problem, help);
            }
        }
    }
    for object in &scene.objects {
        for shape in &object.value.placed.shapes {
            let Some((mesh, material)) = shape.mesh() else {
                continue;
            };
            let Some(material) = scene.materials.get(material) else {
                continue;
            };
            let Some(own) = taken(material).filter(|own| *own != mesh) else {
                continue;
            };
            let Some(own) = scene.meshes.get(own) else {
                continue;
            };
            let problem = format!(
                "the material `{}` has the colours of the mesh `{}`, and fits no other",
                material.name, own.name
            );
            let help = "name that mesh here, or another material";
            keys.refuse(&["objects", &object.name, "material"], problem, help);
        }
    }
}

/// Warns of unused blocks, which are allowed but usually a mistake.
fn warn_of_the_unused(scene: &Authored, keys: &Keys<'_>) {
    let Some(root) = keys.reader() else {
        return;
    };
    let objects = scene.objects.iter();
    let shapes = objects.flat_map(|object| object.value.placed.shapes.iter().copied());
    let used = |wanted: fn(ObjectShape) -> Option<usize>| -> BTreeSet<usize> {
        shapes.clone().filter_map(wanted).collect()
    };
    let meshes = used(|shape| Some(shape.mesh()?.0));
    let mut materials = used(|shape| Some(shape.mesh()?.1));
    let mut leaves = used(ObjectShape::leaf);
    let solids = used(ObjectShape::solid);
    let objects = scene.objects.iter();
    let plants: BTreeSet<usize> = objects.filter_map(|object| object.value.plant).collect();
    for plant in plants.iter().filter_map(|&plant| scene.plants.get(plant)) {
        leaves.extend(&plant.value.leaves);
        leaves.extend(plant.value.perianth.iter().flatten());
        materials.extend(plant.value.bark);
        materials.extend(plant.value.potting.iter().flatten());
    }
    let media = scene.materials.iter();
    let media = media.filter_map(|named| named.value.interior());
    let media: BTreeSet<usize> = media.collect();
    for (section, used) in [
        ("media", media),
        ("plants", plants),
        ("meshes", meshes),
        ("materials", materials),
        ("leaves", leaves),
        ("solids", solids),
    ] {
        let kind = singular(section);
        let entries = root.table.get(section).and_then(|entry| entry.node.table());
        let entries = entries.into_iter().flat_map(|table| &table.0);
        for (_, entry) in entries
            .enumerate()
            .filter(|(index, _)| !used.contains(index))
        {
            let (user, help) = if section == "media" {
                (
                    "material",
                    "take it out, or write `interior` in a dielectric",
                )
            } else {
                ("object", "take it out, or add an object with it")
            };
            let message = format!("no {user} uses the {kind} `{}`", entry.key);
            root.cx.warn(&entry.key_at, "scene::unused", message, help);
        }
    }
}
