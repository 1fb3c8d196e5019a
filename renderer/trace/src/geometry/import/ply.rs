//! Stanford PLY, ASCII and binary.

mod header;
mod values;

use glam::{Vec2, Vec3};

use super::raw::{ImportError, MOST_CORNERS, RawMesh};
use header::{Element, Header, Kind};
use values::Values;

use crate::geometry::stored_number::StoredNumber;

/// The meaning of a property of a vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Role {
    Position(usize),
    Normal(usize),
    Uv(usize),
    PassedOver,
}

impl Role {
    fn of(name: &str) -> Self {
        match name {
            "x" => Self::Position(0),
            "y" => Self::Position(1),
            "z" => Self::Position(2),
            "nx" => Self::Normal(0),
            "ny" => Self::Normal(1),
            "nz" => Self::Normal(2),
            "u" | "s" | "texture_u" => Self::Uv(0),
            "v" | "t" | "texture_v" => Self::Uv(1),
            _ => Self::PassedOver,
        }
    }
}

/// Reads a PLY file.
pub(super) fn parse(bytes: &[u8]) -> Result<RawMesh, ImportError> {
    let (header, body) = Header::parse(bytes)?;
    let mut values = Values::new(header.format, bytes, body);
    let mut raw = RawMesh::default();
    for element in &header.elements {
        match element.name.as_str() {
            "vertex" => vertices(element, &mut values, &mut raw)?,
            "face" => faces(element, &mut values, &mut raw)?,
            "tristrips" => strips(element, &mut values, &mut raw)?,
            _ => pass_over(element, &mut values)?,
        }
    }
    Ok(raw)
}

fn vertices(element: &Element, values: &mut Values, raw: &mut RawMesh) -> Result<(), ImportError> {
    let roles: Vec<_> = element
        .properties
        .iter()
        .map(|property| Role::of(&property.name))
        .collect();
    let has = |role| roles.contains(&role);
    if !(0..3).all(|axis| has(Role::Position(axis))) {
        return Err(values.wrong("the vertices have no x, y and z".to_owned()));
    }
    let mut normals = (0..3).all(|axis| has(Role::Normal(axis))).then(Vec::new);
    let mut uvs = (0..2).all(|axis| has(Role::Uv(axis))).then(Vec::new);
    for _ in 0..element.count {
        let (mut position, mut normal, mut uv) = (Vec3::ZERO, Vec3::ZERO, Vec2::ZERO);
        for (property, role) in element.properties.iter().zip(&roles) {
            let Kind::Scalar(scalar) = property.kind else {
                values.pass_over(property.kind)?;
                continue;
            };
            let value = values.scalar(scalar)? as f32;
            match *role {
                Role::Position(axis) => position[axis] = value,
                Role::Normal(axis) => normal[axis] = value,
                Role::Uv(axis) => uv[axis] = value,
                Role::PassedOver => {}
            }
        }
        values.end_of_item()?;
        raw.positions.push(position);
        if let Some(normals) = &mut normals {
            normals.push(normal);
        }
        if let Some(uvs) = &mut uvs {
            uvs.push(uv);
        }
    }
    raw.normals = normals;
    raw.uvs = uvs;
    Ok(())
}

/// The vertex of a corner. f64 holds every integer type of the format exactly.
fn vertex(value: f64) -> Result<u32, String> {
    if value < 0.0 || value > f64::from(u32::MAX) || value.fract() != 0.0 {
        return Err(format!("{value} is not the number of a vertex"));
    }
    Ok(value as u32)
}

/// Strips of triangles: each corner makes one with the two before it, until -1 ends a strip.
fn strips(element: &Element, values: &mut Values, raw: &mut RawMesh) -> Result<(), ImportError> {
    each_list(element, values, |values, count, item| {
        let mut last = Vec::with_capacity(3);
        let mut is_turned = false;
        values.list(count, item, |value| {
            if value == -1.0 {
                last.clear();
                is_turned = false;
                return Ok(());
            }
            last.push(vertex(value)?);
            if let [a, b, c] = last[..] {
                // Every other triangle has its corners the other way round.
                let corners = if is_turned { [b, a, c] } else { [a, b, c] };
                raw.push_face(&corners);
                is_turned = !is_turned;
                last.remove(0);
            }
            Ok(())
        })
    })
}

fn faces(element: &Element, values: &mut Values, raw: &mut RawMesh) -> Result<(), ImportError> {
    let mut corners = Vec::new();
    each_list(element, values, |values, count, item| {
        corners.clear();
        values.list(count, item, |value| {
            if corners.len() == MOST_CORNERS {
                return Err(format!("the face has more than {MOST_CORNERS} corners"));
            }
            corners.push(vertex(value)?);
            Ok(())
        })?;
        if corners.len() < 3 {
            return Err(values.wrong(format!(
                "the face has {} corners; it takes 3",
                corners.len()
            )));
        }
        raw.push_face(&corners);
        Ok(())
    })
}

/// Reads an element whose items have lists of corners, each with the types of its length and items.
fn each_list(
    element: &Element,
    values: &mut Values,
    mut read: impl FnMut(&mut Values, StoredNumber, StoredNumber) -> Result<(), ImportError>,
) -> Result<(), ImportError> {
    let plural = element.name.strip_suffix('s').unwrap_or(&element.name);
    let is_corners = |name: &str| ["vertex_indices", "vertex_index"].contains(&name);
    if !(element.properties.iter()).any(|property| is_corners(&property.name)) {
        return Err(values.wrong(format!("the {plural}s have no vertex_indices")));
    }
    for _ in 0..element.count {
        for property in &element.properties {
            match property.kind {
                Kind::List { count, item } if is_corners(&property.name) => {
                    read(values, count, item)?;
                }
                Kind::List { .. } | Kind::Scalar(_) => values.pass_over(property.kind)?,
            }
        }
        values.end_of_item()?;
    }
    Ok(())
}

fn pass_over(element: &Element, values: &mut Values) -> Result<(), ImportError> {
    if element.properties.is_empty() {
        return Ok(());
    }
    for _ in 0..element.count {
        for property in &element.properties {
            values.pass_over(property.kind)?;
        }
        values.end_of_item()?;
    }
    Ok(())
}
