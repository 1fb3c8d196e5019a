//! `[objects.NAME]`: a mesh with a material, a leaf, or a body of solid tissue, and where it stands.

use glam::{DMat3, DMat4, DVec3};

use super::angle::sin_cos_deg;
use super::camera::COORDINATES_M;
use super::limits::Limits;
use super::names::Names;
use super::reader::Block;
use crate::scene::description::{Object, ObjectShape};
use crate::scene::error::SceneError;

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
    let cx = block.cx;
    let shape = match block.exactly_one(&["mesh", "leaf", "solid"]) {
        Some("mesh") => {
            let mesh = block.text("mesh", "the name of a mesh");
            let mesh = mesh.and_then(|name| shapes.meshes.find(cx, name));
            let material = block.text("material", "the name of a material");
            let material = material.and_then(|name| shapes.materials.find(cx, name));
            mesh.zip(material)
                .map(|(mesh, material)| ObjectShape::Mesh { mesh, material })
        }
        Some("solid") => {
            block.exclude("solid", "material");
            let solid = block.text("solid", "the name of a body of solid tissue");
            let solid = solid.and_then(|name| shapes.solids.find(cx, name));
            solid.map(|solid| ObjectShape::Solid { solid })
        }
        Some(_) => {
            block.exclude("leaf", "material");
            let leaf = block.text("leaf", "the name of a leaf");
            let leaf = leaf.and_then(|name| shapes.leaves.find(cx, name));
            leaf.map(|leaf| ObjectShape::Leaf { leaf })
        }
        None => {
            // Which keys belong here cannot be said without knowing the shape.
            block.node("material");
            None
        }
    };
    let to_world = read_placement(block);
    block.finish();
    Some(Object {
        shape: shape?,
        to_world: to_world?,
    })
}

/// Local to world: `matrix`, or scale, then turns about x, y, z, then position.
fn read_placement(block: &Block<'_>) -> Option<DMat4> {
    const ANGLES_DEG: Limits = Limits::closed(-3600.0, 3600.0);
    let position = block.optional_numbers("position_m", COORDINATES_M);
    let rotate = block.optional_numbers("rotate_deg", ANGLES_DEG);
    let scale = block.number_or("scale", Limits::above(0.0, 1e6), 1.0);
    if block.entry("matrix").is_some() {
        for key in ["position_m", "rotate_deg", "scale"] {
            block.exclude("matrix", key);
        }
        return read_matrix(block);
    }
    let [x, y, z] = rotate.unwrap_or([0.0; 3]);
    let turn = turn_about_z(z) * turn_about_y(y) * turn_about_x(x);
    let position = DVec3::from_array(position.unwrap_or([0.0; 3]));
    Some(DMat4::from_translation(position) * DMat4::from_mat3(turn * scale))
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
