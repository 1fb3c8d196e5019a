//! The triangles of a glTF file's scene, where its nodes place them.

use std::collections::BTreeSet;

use glam::{DMat3, DMat4, DQuat, DVec3, Vec2, Vec3};
use gltf_json::mesh::{Mode, Primitive, Semantic};
use gltf_json::scene::Node;
use gltf_json::validation::Checked;
use gltf_json::{Accessor, Index, Root};

use super::ModelError;
use super::accessors::Accessors;
use super::textures::{Of, Place, texture};
use crate::geometry::TriangleMesh;

/// Greatest number of triangles of a model.
const MOST_TRIANGLES: u64 = 1 << 27;

/// The triangles of one primitive at one node, m, +z up.
#[derive(Debug)]
pub(super) struct Patch {
    /// Number of its material; `None` is the one that glTF gives to what has none.
    pub(super) material: Option<usize>,
    pub(super) positions: Vec<Vec3>,
    /// Zero where the file has none.
    pub(super) normals: Vec<Vec3>,
    /// Where its base colour's picture is looked up, v upwards.
    pub(super) uvs: Option<Vec<Vec2>>,
    /// Factors on the base colour, each in [0, 1].
    pub(super) colours: Option<Vec<[f32; 3]>>,
    /// Directions of the x axis of a map of normals, and the sign of its y axis.
    pub(super) tangents: Option<Vec<[f32; 4]>>,
    pub(super) triangles: Vec<[u32; 3]>,
}

impl Patch {
    /// Number of its vertices.
    pub(super) fn vertices(&self) -> usize {
        self.positions.len()
    }
}

/// All triangles of the file's scene, or of all its nodes if it has no scene.
pub(super) fn patches(
    root: &Root,
    accessors: &Accessors<'_>,
    scale: f64,
    left_out: &mut BTreeSet<String>,
) -> Result<Vec<Patch>, ModelError> {
    let mut patches = Vec::new();
    let mut triangles = 0_u64;
    for (node, to_scene) in placed(root, upright(scale))? {
        let Some(mesh) = node.mesh else {
            continue;
        };
        for (part, primitive) in root.meshes[mesh.value()].primitives.iter().enumerate() {
            let place = format!("meshes[{}].primitives[{part}]", mesh.value());
            let Some(corners) = corners(primitive, accessors, &place, &mut triangles, left_out)?
            else {
                continue;
            };
            patches.push(patch(root, accessors, primitive, &corners, to_scene)?);
        }
    }
    Ok(patches)
}

/// From metres with +y up, as glTF has it, to those of a scene with +z up.
fn upright(scale: f64) -> DMat4 {
    DMat4::from_mat3(DMat3::from_cols(DVec3::X, DVec3::Z, -DVec3::Y) * scale)
}

/// The nodes of the scene, each with its transform.
fn placed(root: &Root, upright: DMat4) -> Result<Vec<(&Node, DMat4)>, ModelError> {
    let chosen = root.scene.map(|scene| scene.value());
    let chosen = chosen.or((!root.scenes.is_empty()).then_some(0));
    let roots: Vec<usize> = if let Some(scene) = chosen {
        let nodes = root.scenes[scene].nodes.iter();
        nodes.map(Index::value).collect()
    } else {
        let nodes = root.nodes.iter();
        let inner = nodes.flat_map(|node| node.children.iter().flatten());
        let inner: BTreeSet<usize> = inner.map(Index::value).collect();
        let all = 0..root.nodes.len();
        all.filter(|number| !inner.contains(number)).collect()
    };
    let mut open: Vec<(usize, DMat4)> = roots.into_iter().rev().map(|n| (n, upright)).collect();
    let mut seen = vec![false; root.nodes.len()];
    let mut placed = Vec::new();
    while let Some((number, parent)) = open.pop() {
        if std::mem::replace(&mut seen[number], true) {
            let what = "has two parents, or is its own";
            return Err(ModelError::invalid(format!("nodes[{number}]"), what));
        }
        let node = &root.nodes[number];
        let to_scene = parent * local(node);
        if !to_scene.is_finite() {
            let what = "its transform is not finite";
            return Err(ModelError::invalid(format!("nodes[{number}]"), what));
        }
        placed.push((node, to_scene));
        let children = node.children.iter().flatten().rev();
        open.extend(children.map(|child| (child.value(), to_scene)));
    }
    Ok(placed)
}

/// A node's own transform.
fn local(node: &Node) -> DMat4 {
    if let Some(matrix) = node.matrix {
        return DMat4::from_cols_array(&matrix.map(f64::from));
    }
    let vector = |of: Option<[f32; 3]>, usual: DVec3| {
        of.map_or(usual, |of| DVec3::from_array(of.map(f64::from)))
    };
    let rotation = node.rotation.unwrap_or_default().0.map(f64::from);
    DMat4::from_scale_rotation_translation(
        vector(node.scale, DVec3::ONE),
        // One of no length becomes NaN, which is refused.
        DQuat::from_array(rotation).normalize(),
        vector(node.translation, DVec3::ZERO),
    )
}

/// The vertices of a primitive's triangles; `None` if it has none.
fn corners(
    primitive: &Primitive,
    accessors: &Accessors<'_>,
    place: &str,
    triangles: &mut u64,
    left_out: &mut BTreeSet<String>,
) -> Result<Option<Vec<[u32; 3]>>, ModelError> {
    let claimed = match (primitive.indices, attribute(primitive, Semantic::Positions)) {
        (Some(of), _) | (None, Some(of)) => accessors.claimed(of),
        (None, None) => 0,
    };
    // A strip has one for each vertex.
    *triangles = triangles.saturating_add(match primitive.mode {
        Checked::Valid(Mode::Triangles) => claimed / 3,
        Checked::Valid(_) | Checked::Invalid => claimed,
    });
    if *triangles > MOST_TRIANGLES {
        let what = format!("the scene has more than {MOST_TRIANGLES} triangles up to here");
        return Err(ModelError::invalid(place, what));
    }
    let Checked::Valid(mode) = primitive.mode else {
        return Err(ModelError::invalid(place, "has an unknown mode"));
    };
    if matches!(
        mode,
        Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip
    ) {
        left_out.insert("lines and points".to_owned());
        return Ok(None);
    }
    let indices = if let Some(indices) = primitive.indices {
        accessors.indices(indices)?
    } else {
        let count = u32::try_from(claimed);
        let count = count.map_err(|_| ModelError::invalid(place, "has too many vertices"))?;
        (0..count).collect()
    };
    let fan = |pair: &[u32]| [indices[0], pair[0], pair[1]];
    Ok(Some(match mode {
        Mode::TriangleStrip => {
            let three = indices.windows(3).enumerate();
            let turned = |(number, three): (usize, &[u32])| match number % 2 {
                0 => [three[0], three[1], three[2]],
                _ => [three[1], three[0], three[2]],
            };
            three.map(turned).collect()
        }
        Mode::TriangleFan => indices
            .get(1..)
            .unwrap_or(&[])
            .windows(2)
            .map(fan)
            .collect(),
        Mode::Triangles | Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip => {
            let (whole, rest) = indices.as_chunks::<3>();
            if !rest.is_empty() {
                let what = format!("has {} corners, which is no multiple of 3", indices.len());
                return Err(ModelError::invalid(place, what));
            }
            whole.to_vec()
        }
    }))
}

fn attribute(primitive: &Primitive, semantic: Semantic) -> Option<Index<Accessor>> {
    let found = primitive.attributes.get(&Checked::Valid(semantic));
    found.copied()
}

/// A primitive at a node.
fn patch(
    root: &Root,
    accessors: &Accessors<'_>,
    primitive: &Primitive,
    corners: &[[u32; 3]],
    to_scene: DMat4,
) -> Result<Patch, ModelError> {
    // Primitives may share one large array of vertices.
    let mut used: Vec<u32> = corners.iter().flatten().copied().collect();
    used.sort_unstable();
    used.dedup();
    let own = |vertex: u32| used.partition_point(|&other| other < vertex) as u32;
    let positions = attribute(primitive, Semantic::Positions).expect("it was opened with them");
    let positions = accessors.vectors::<3>(positions, &used)?;
    let at = |position: [f32; 3]| {
        let position = DVec3::from_array(position.map(f64::from));
        to_scene.transform_point3(position).as_vec3()
    };
    let linear = DMat3::from_mat4(to_scene);
    let mirrors = linear.determinant() < 0.0;
    let normals = match attribute(primitive, Semantic::Normals) {
        Some(normals) => {
            // Its cofactors are its inverse, transposed, times its determinant.
            let side = if mirrors { -1.0 } else { 1.0 };
            let [x, y, z] = [linear.x_axis, linear.y_axis, linear.z_axis];
            let turned = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * side;
            let normal = |normal: [f32; 3]| {
                let normal = turned * DVec3::from_array(normal.map(f64::from));
                normal.normalize_or_zero().as_vec3()
            };
            let normals = accessors.vectors::<3>(normals, &used)?;
            normals.into_iter().map(normal).collect()
        }
        None => vec![Vec3::ZERO; used.len()],
    };
    let material = primitive.material.map(|material| material.value());
    let place = Place::of(root, material);
    let uvs = match attribute(primitive, Semantic::TexCoords(place.set)) {
        Some(uvs) => {
            let uvs = accessors.vectors::<2>(uvs, &used)?.into_iter();
            Some(uvs.map(|uv| place.uv(uv)).collect())
        }
        None => None,
    };
    let colours = match attribute(primitive, Semantic::Colors(0)) {
        Some(colours) => Some(accessors.colours(colours, &used)?),
        None => None,
    };
    let tangents = match attribute(primitive, Semantic::Tangents) {
        Some(tangents) if texture(root, material, Of::Normals).is_some() => {
            let turned = |[x, y, z, sign]: [f32; 4]| {
                let tangent = linear * DVec3::from([x, y, z].map(f64::from));
                let [x, y, z] = tangent.normalize_or_zero().as_vec3().to_array();
                [x, y, z, if mirrors { -sign } else { sign }]
            };
            let tangents = accessors.vectors::<4>(tangents, &used)?;
            Some(tangents.into_iter().map(turned).collect())
        }
        Some(_) | None => None,
    };
    let triangles = corners.iter().map(|corners| {
        let [a, b, c] = corners.map(own);
        if mirrors { [a, c, b] } else { [a, b, c] }
    });
    Ok(Patch {
        material,
        positions: positions.into_iter().map(at).collect(),
        normals,
        uvs,
        colours,
        tangents,
        triangles: triangles.collect(),
    })
}

/// All patches as one mesh.
pub(super) fn joined(patches: Vec<Patch>) -> Result<TriangleMesh, ModelError> {
    let has_normals = patches
        .iter()
        .any(|patch| patch.normals.iter().any(|normal| *normal != Vec3::ZERO));
    let has_uvs = patches.iter().any(|patch| patch.uvs.is_some());
    let has_colours = patches.iter().any(|patch| patch.colours.is_some());
    let (mut positions, mut normals) = (Vec::new(), Vec::new());
    let (mut uvs, mut triangles) = (Vec::new(), Vec::new());
    let has_tangents = patches.iter().any(|patch| patch.tangents.is_some());
    let (mut colours, mut tangents) = (Vec::new(), Vec::new());
    for patch in patches {
        let first = positions.len() as u32;
        let count = patch.vertices();
        triangles.extend(patch.triangles.iter().map(|face| face.map(|i| i + first)));
        positions.extend(patch.positions);
        normals.extend(patch.normals);
        uvs.extend(patch.uvs.unwrap_or_else(|| vec![Vec2::ZERO; count]));
        if has_colours {
            colours.extend(patch.colours.unwrap_or_else(|| vec![[1.0; 3]; count]));
        }
        if has_tangents {
            tangents.extend(patch.tangents.unwrap_or_else(|| vec![[0.0; 4]; count]));
        }
    }
    let normals = has_normals.then_some(normals);
    let uvs = has_uvs.then_some(uvs);
    let mut mesh = TriangleMesh::new(positions, normals, uvs, triangles)?;
    if has_colours {
        mesh = mesh.with_colours(colours);
    }
    if has_tangents {
        mesh = mesh.with_tangents(tangents);
    }
    Ok(mesh)
}
