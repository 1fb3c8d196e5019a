//! `[objects.NAME]`: a mesh with a material, a leaf, or a body of solid tissue, and where it stands, once or many times.

use glam::{DMat3, DMat4, DVec3};

use super::angle::sin_cos_deg;
use super::camera::COORDINATES_M;
use super::context::ENOUGH;
use super::instances::read_instances;
use super::limits::Limits;
use super::names::Names;
use super::reader::Block;
use super::tree::Value;
use super::values::{listed, text_at, wrong_length, wrong_type};
use crate::scene::description::{Object, ObjectShape};
use crate::scene::error::SceneError;
use crate::scene::source::Place;

/// Angles of a turn, degrees.
pub(crate) const ANGLES_DEG: Limits = Limits::closed(-3600.0, 3600.0);
/// Factors on a shape.
pub(crate) const SCALES: Limits = Limits::above(0.0, 1e6);

/// Sections that an object refers to.
#[derive(Debug)]
pub(crate) struct Shapes<'a> {
    pub(crate) meshes: Names<'a>,
    pub(crate) materials: Names<'a>,
    pub(crate) leaves: Names<'a>,
    pub(crate) solids: Names<'a>,
}

/// Reads one block of `[objects]`.
pub(crate) fn read_object(block: &Block<'_>, shapes: &Shapes<'_>) -> Option<Object> {
    let chosen = read_shapes(block, shapes);
    let to_world = read_placement(block);
    let places = block.optional_block("instances");
    let names = chosen.as_ref().map(|(_, names)| names.as_slice());
    if places.is_none() {
        require_one_shape(block, names.unwrap_or_default());
    }
    let instances = places.map(|places| read_instances(&places, names, to_world));
    block.finish();
    Some(Object {
        shapes: chosen?.0,
        to_world: to_world?,
        // Read and wrong is another thing than not there.
        instances: match instances {
            Some(places) => Some(places?),
            None => None,
        },
    })
}

/// Reports an object without instances that names several shapes.
fn require_one_shape(block: &Block<'_>, names: &[&str]) {
    if names.len() <= 1 {
        return;
    }
    let error = SceneError::Impossible {
        key: block.path.clone(),
        problem: format!(
            "names {} shapes ({}) and stands in one place",
            names.len(),
            listed(names.iter().copied())
        ),
        help: "name one shape, or say where each stands: `instances.file = \"places.csv\"`"
            .to_owned(),
    };
    block.cx.error(&block.at, error);
}

/// What the object is, and under which names; several only of an object with instances.
fn read_shapes<'a>(
    block: &Block<'a>,
    shapes: &Shapes<'_>,
) -> Option<(Vec<ObjectShape>, Vec<&'a str>)> {
    match block.exactly_one(&["mesh", "leaf", "solid"]) {
        Some("mesh") => {
            let meshes = find_all(block, "mesh", "the name of a mesh", &shapes.meshes);
            let wanted = "the name of a material";
            let materials = find_all(block, "material", wanted, &shapes.materials);
            let ((meshes, names), (materials, _)) = meshes.zip(materials)?;
            if materials.len() != 1 && materials.len() != meshes.len() {
                let wanted = format!("one name, or {}: one for each mesh", meshes.len());
                let at = block.node("material").map_or(&block.at, |node| &node.at);
                let found = materials.len();
                wrong_length(block.cx, at, "material", "a list", found, &wanted);
                return None;
            }
            let materials = materials.into_iter().cycle();
            let pairs = meshes.into_iter().zip(materials);
            let pairs = pairs.map(|(mesh, material)| ObjectShape::Mesh { mesh, material });
            Some((pairs.collect(), names))
        }
        Some("solid") => {
            block.exclude("solid", "material");
            let wanted = "the name of a body of solid tissue";
            let (solids, names) = find_all(block, "solid", wanted, &shapes.solids)?;
            let solids = solids.into_iter();
            Some((
                solids.map(|solid| ObjectShape::Solid { solid }).collect(),
                names,
            ))
        }
        Some(_) => {
            block.exclude("leaf", "material");
            let (leaves, names) = find_all(block, "leaf", "the name of a leaf", &shapes.leaves)?;
            let leaves = leaves.into_iter();
            Some((
                leaves.map(|leaf| ObjectShape::Leaf { leaf }).collect(),
                names,
            ))
        }
        None => {
            // Which keys belong here cannot be said without knowing the shape.
            block.node("material");
            None
        }
    }
}

/// The blocks that a name, or a list of names, stands for, and the names.
fn find_all<'a>(
    block: &Block<'a>,
    key: &'static str,
    wanted: &str,
    known: &Names<'_>,
) -> Option<(Vec<usize>, Vec<&'a str>)> {
    let cx = block.cx;
    let node = block.needed(key, || format!("`{key} = \"…\"`, {wanted}"))?;
    let written: Vec<Option<(&str, &Place)>> = match &node.value {
        Value::List(list) if !(1..=ENOUGH).contains(&list.len()) => {
            let wanted = format!("a list of 1 to {ENOUGH} names");
            wrong_length(cx, &node.at, key, "a list", list.len(), &wanted);
            return None;
        }
        Value::List(list) => list.iter().map(|name| text_at(cx, name, key)).collect(),
        Value::Text(_) => vec![text_at(cx, node, key)],
        Value::Integer(_)
        | Value::Number(_)
        | Value::Flag(_)
        | Value::Other(..)
        | Value::Table(_) => {
            wrong_type(cx, node, key, "text in quotes");
            return None;
        }
    };
    let found: Vec<Option<(usize, &str)>> = written
        .into_iter()
        .map(|name| Some((known.find(cx, name?)?, name?.0)))
        .collect();
    found
        .into_iter()
        .collect::<Option<Vec<_>>>()
        .map(|found| found.into_iter().unzip())
}

/// Local to world: `matrix`, or scale, then turns about x, y, z, then position.
fn read_placement(block: &Block<'_>) -> Option<DMat4> {
    let position = block.optional_numbers("position_m", COORDINATES_M);
    let rotate = block.optional_numbers("rotate_deg", ANGLES_DEG);
    let scale = block.number_or("scale", SCALES, 1.0);
    if block.entry("matrix").is_some() {
        for key in ["position_m", "rotate_deg", "scale"] {
            block.exclude("matrix", key);
        }
        return read_matrix(block);
    }
    let position = DVec3::from_array(position.unwrap_or([0.0; 3]));
    let linear = turn(rotate.unwrap_or([0.0; 3])) * scale;
    Some(DMat4::from_translation(position) * DMat4::from_mat3(linear))
}

/// Turns about x, then y, then z, by angles in degrees.
pub(crate) fn turn([x, y, z]: [f64; 3]) -> DMat3 {
    turn_about_z(z) * turn_about_y(y) * turn_about_x(x)
}

fn read_matrix(block: &Block<'_>) -> Option<DMat4> {
    let rows: [f64; 16] = block.optional_numbers("matrix", COORDINATES_M)?;
    let matrix = DMat4::from_cols_array(&rows).transpose();
    let at = block.node("matrix").map_or(&block.at, |node| &node.at);
    if rows[12..] != [0.0, 0.0, 0.0, 1.0] {
        let error = SceneError::BadMatrix {
            problem: "has a last row other than 0, 0, 0, 1",
            help: "write the rows one behind the other, the position at the end of the first three",
        };
        block.cx.error(at, error);
        return None;
    }
    let linear = DMat3::from_mat4(matrix);
    let bounds = linear.x_axis.length() * linear.y_axis.length() * linear.z_axis.length();
    // The determinant is at most the product of the columns' lengths (Hadamard). Far below that,
    // single precision no longer tells the shape from a flat one.
    if linear.determinant().abs() <= 1e-6 * bounds || bounds < 1e-30 {
        let error = SceneError::BadMatrix {
            problem: "is singular: it flattens the object",
            help: "let its first three columns point in three independent directions",
        };
        block.cx.error(at, error);
        return None;
    }
    Some(matrix)
}

fn turn_about_x(deg: f64) -> DMat3 {
    let (sin, cos) = sin_cos_deg(deg);
    DMat3::from_cols(
        DVec3::X,
        DVec3::new(0.0, cos, sin),
        DVec3::new(0.0, -sin, cos),
    )
}

fn turn_about_y(deg: f64) -> DMat3 {
    let (sin, cos) = sin_cos_deg(deg);
    DMat3::from_cols(
        DVec3::new(cos, 0.0, -sin),
        DVec3::Y,
        DVec3::new(sin, 0.0, cos),
    )
}

fn turn_about_z(deg: f64) -> DMat3 {
    let (sin, cos) = sin_cos_deg(deg);
    DMat3::from_cols(
        DVec3::new(cos, sin, 0.0),
        DVec3::new(-sin, cos, 0.0),
        DVec3::Z,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_are_right_handed() {
        assert_eq!(turn_about_x(90.0) * DVec3::Y, DVec3::Z);
        assert_eq!(turn_about_y(90.0) * DVec3::Z, DVec3::X);
        assert_eq!(turn_about_z(90.0) * DVec3::X, DVec3::Y);
    }
}
