//! `[objects.NAME]`: a mesh with a material, a leaf, or a body of solid tissue, with one place or
//! many.

use glam::{DMat3, DMat4, DVec3};
use leafmodel::document::declared::Declared;
use leafmodel::document::error::DocumentError;
use leafmodel::document::keys::Keys;
use leafmodel::document::value_kind::{Flag, Number, Numbers, Vector};
use leafmodel::document::values::{listed, wrong_length};

use super::instances::instances;
use super::placement::{ANGLES_DEG, SCALES, turn};
use super::volume::volume;
use crate::geometry::instance::COORDINATES_M;
use crate::geometry::scatter::Rest;
use crate::scene::authored::Object;
use crate::scene::description::name_list::NamesIn;
use crate::scene::description::{self, ObjectShape};

impl Declared for Object {
    fn declare(&mut self, keys: &mut Keys<'_>) {
        let names = shapes(self, keys);
        let Self {
            plant,
            placed: object,
        } = self;
        placement(object, keys);
        let shapes = keys.is_sound().then_some(names.as_slice());
        let frame = keys.is_sound().then_some(object.to_world);
        let about = "Where the object stands, if in more than one place.";
        keys.optional_block(
            "instances",
            &mut object.instances,
            Vec::new,
            about,
            |places, keys| {
                instances(places, keys, shapes, frame);
            },
        );
        scatter(object, plant.is_some(), keys);
        volume(object, keys);
        let about = "Whether the camera sees a hole in its place: black, with an alpha of 0. It shades \
            and lights everything else as before.";
        keys.key("holdout", &mut object.holdout, Flag, about);
        let in_one_place = object.instances.is_none() && !object.is_spread();
        if in_one_place && names.len() > 1 && keys.is_sound() {
            let problem = format!(
                "names {} shapes ({}) and stands in one place",
                names.len(),
                listed(names.iter().map(String::as_str))
            );
            let help = "name one shape, or say where each stands: `instances.file = \"places.csv\"`, \
            `scatter` or `volume`";
            let error = DocumentError::Impossible {
                key: keys
                    .reader()
                    .map_or_else(String::new, |block| block.path.clone()),
                problem,
                help: help.to_owned(),
            };
            keys.report(&[], error);
        }
    }
}

/// Reads the shapes of the object; returns their names.
fn shapes(object: &mut Object, keys: &mut Keys<'_>) -> Vec<String> {
    let mut named: Vec<(usize, String)> = Vec::new();
    let mut chosen = keys.one_of(&["mesh", "leaf", "solid", "plant"], None);
    if keys.reader().is_some() && chosen.is_empty() {
        // Without a shape it is unknown which keys belong here.
        keys.leave(&["material"]);
    }
    for kind in chosen.drain(..) {
        let (section, what, about) = match kind {
            "mesh" => ("meshes", "the name of a mesh", "Shape."),
            "plant" => (
                "plants",
                "the name of a plant",
                "That plant instead: the foot of its main axis at the origin, z up.",
            ),
            "solid" => (
                "solids",
                "the name of a body of solid tissue",
                "That body instead, in the frame of its shape.",
            ),
            _ => (
                "leaves",
                "the name of a leaf",
                "A grown leaf instead: base at the origin, midrib along +y, adaxial side +z; of a compound \
                 leaf the whole, with the foot of its petiole at the origin.",
            ),
        };
        if kind != "mesh" {
            keys.exclude(kind, "material");
        }
        keys.needed(kind, &mut named, NamesIn(section, what), about);
        let own = named.iter().map(|(number, _)| *number);
        match kind {
            "mesh" => {
                let mut materials = Vec::new();
                let kind = NamesIn("materials", "the name of a material");
                let about = "What it is made of.";
                keys.needed("material", &mut materials, kind, about);
                mesh_shapes(object, keys, &named, &materials);
            }
            "plant" => {
                object.plant = own.clone().next();
                if named.len() > 1 {
                    let problem = "an object is one plant".to_owned();
                    keys.refuse(&["plant"], problem, "write an object for each");
                }
            }
            "solid" => {
                object.placed.shapes = own.map(|solid| ObjectShape::Solid { solid }).collect();
            }
            _ => object.placed.shapes = own.map(|leaf| ObjectShape::Leaf { leaf }).collect(),
        }
    }
    named.into_iter().map(|(_, name)| name).collect()
}

/// Each mesh with its material.
fn mesh_shapes(
    object: &mut Object,
    keys: &Keys<'_>,
    meshes: &[(usize, String)],
    materials: &[(usize, String)],
) {
    if !keys.is_sound() || meshes.is_empty() || materials.is_empty() {
        return;
    }
    if materials.len() != 1 && materials.len() != meshes.len() {
        let wanted = format!("one name, or {}: one for each mesh", meshes.len());
        if let Some(block) = keys.reader() {
            let at = block.node("material").map_or(&block.at, |node| &node.at);
            wrong_length(block.cx, at, "material", "a list", materials.len(), &wanted);
        }
        return;
    }
    let pairs = meshes.iter().zip(materials.iter().cycle());
    let pairs = pairs.map(|((mesh, _), (material, _))| ObjectShape::Mesh {
        mesh: *mesh,
        material: *material,
    });
    object.placed.shapes = pairs.collect();
}

/// The key `scatter` of an object, which may be a plant.
fn scatter(object: &mut description::Object, is_plant: bool, keys: &mut Keys<'_>) {
    keys.exclude("instances", "scatter");
    let about = "Where copies of the object are strewn, instead of its own place.";
    let strewn = &mut object.strewn;
    keys.optional_block("scatter", strewn, Box::default, about, |own, keys| {
        own.declare(keys);
    });
    if let Some(strewn) = &object.strewn {
        let is_leaf = |shape: &ObjectShape| matches!(shape, ObjectShape::Leaf { .. });
        let only_leaves = !is_plant && object.shapes.iter().all(is_leaf);
        let differ = strewn.individuals > 1 || strewn.days.is_some();
        if keys.is_sound() && differ && !only_leaves {
            let key = if strewn.days.is_some() {
                "days"
            } else {
                "individuals"
            };
            let problem = "only leaves are grown apart".to_owned();
            let help = "take it out; a plant has its own `individuals` and `days`";
            keys.refuse(&["scatter", key], problem, help);
        }
        if keys.is_sound() && is_plant && matches!(strewn.plan.rest, Rest::Settled { .. }) {
            let problem = "a plant stands where it grows".to_owned();
            keys.refuse(&["scatter", "settle"], problem, "take it out");
        }
    }
}

/// Local to world: `matrix`, or scale, then rotations about x, y, z, then position.
fn placement(object: &mut description::Object, keys: &mut Keys<'_>) {
    let (mut position, mut rotate, mut scale) = (DVec3::ZERO, [0.0; 3], 1.0);
    let about = "Where the shape's origin goes.";
    keys.key("position_m", &mut position, Vector(COORDINATES_M), about);
    let about = "Turns about x, then y, then z, each right-handed about the axis of the world.";
    keys.key("rotate_deg", &mut rotate, Numbers::<3>(ANGLES_DEG), about);
    keys.key(
        "scale",
        &mut scale,
        Number(SCALES),
        "Factor on the shape; applied first.",
    );
    for key in ["position_m", "rotate_deg", "scale"] {
        keys.exclude("matrix", key);
    }
    let mut matrix = None;
    let about = "Local to world row by row, in metres, instead of the three keys above.";
    keys.optional("matrix", &mut matrix, Numbers::<16>(COORDINATES_M), about);
    object.to_world = match matrix {
        None => DMat4::from_translation(position) * DMat4::from_mat3(turn(rotate) * scale),
        Some(rows) => DMat4::from_cols_array(&rows).transpose(),
    };
    if let Some(rows) = matrix {
        check_matrix(&rows, object.to_world, keys);
    }
}

fn check_matrix(rows: &[f64; 16], matrix: DMat4, keys: &Keys<'_>) {
    if rows[12..] != [0.0, 0.0, 0.0, 1.0] {
        let error = DocumentError::BadMatrix {
            problem: "has a last row other than 0, 0, 0, 1",
            help: "write the rows one behind the other, the position at the end of the first three",
        };
        keys.report(&["matrix"], error);
        return;
    }
    let linear = DMat3::from_mat4(matrix);
    let bounds = linear.x_axis.length() * linear.y_axis.length() * linear.z_axis.length();
    // The determinant is at most the product of the columns' lengths (Hadamard). Far below that,
    // single precision cannot distinguish the shape from a flat one.
    if linear.determinant().abs() <= 1e-6 * bounds || bounds < 1e-30 {
        let error = DocumentError::BadMatrix {
            problem: "is singular: it flattens the object",
            help: "let its first three columns point in three independent directions",
        };
        keys.report(&["matrix"], error);
    }
}
