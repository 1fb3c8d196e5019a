//! The triangles of a glTF file's scene, where its nodes place them.

use std::collections::BTreeSet;

use glam::{DMat3, DMat4, DQuat, DVec3, Vec2, Vec3};
use gltf_json::mesh::{Mode, Primitive, Semantic};
use gltf_json::scene::Node;
use gltf_json::validation::Checked;
use gltf_json::{Accessor, Index, Root};

use super::accessors::Accessors;
use super::error::ModelError;
use super::textures::{Of, Place, texture};
use crate::geometry::TriangleMesh;

/// Greatest number of triangles of a model.
const MOST_TRIANGLES: u64 = 1 << 27;

/// The triangles of one primitive at one node, m, +z up.
#[derive(Debug)]
pub(super) struct Patch {
    /// Number of its material; `None` is the one that glTF gives to what has none.
    pub(super) material: Option<usize>,
    pub(super) vertices: Vec<Vertex>,
    pub(super) has_uvs: bool,
    pub(super) has_colours: bool,
    pub(super) has_tangents: bool,
    pub(super) triangles: Vec<[u32; 3]>,
}

/// A vertex, with defaults for what the file does not have.
#[derive(Clone, Copy, Debug)]
pub(super) struct Vertex {
    pub(super) position: Vec3,
    /// Zero where the file has none.
    pub(super) normal: Vec3,
    /// Where its base colour's picture is looked up, v upwards.
    pub(super) uv: Vec2,
    /// Factors on the base colour, each in [0, 1].
    pub(super) colour: [f32; 3],
    /// Direction of the x axis of a map of normals, and the sign of its y axis.
    pub(super) tangent: [f32; 4],
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
            let Some(corners) =
                corners(root, primitive, accessors, &place, &mut triangles, left_out)?
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

/// How many corners a primitive claims to have.
fn claimed_corners(root: &Root, primitive: &Primitive) -> u64 {
    let positions = attribute(primitive, Semantic::Positions);
    let listed = primitive.indices.or(positions);
    listed.map_or(0, |of| root.accessors[of.value()].count.0)
}

/// The same in triangles; a strip has one for each vertex.
fn claimed_triangles(root: &Root, primitive: &Primitive) -> u64 {
    let corners = claimed_corners(root, primitive);
    match primitive.mode {
        Checked::Valid(Mode::Triangles) => corners / 3,
        Checked::Valid(_) | Checked::Invalid => corners,
    }
}

/// How many triangles all nodes together claim to have.
pub(super) fn claimed(root: &Root) -> Result<u64, ModelError> {
    let nodes = placed(root, DMat4::IDENTITY)?.into_iter();
    let meshes = nodes.filter_map(|(node, _)| node.mesh);
    let primitives = meshes.flat_map(|mesh| &root.meshes[mesh.value()].primitives);
    Ok(primitives
        .map(|primitive| claimed_triangles(root, primitive))
        .fold(0, u64::saturating_add))
}

/// The vertices of a primitive's triangles; `None` if it has none.
fn corners(
    root: &Root,
    primitive: &Primitive,
    accessors: &Accessors<'_>,
    place: &str,
    triangles: &mut u64,
    left_out: &mut BTreeSet<String>,
) -> Result<Option<Vec<[u32; 3]>>, ModelError> {
    let claimed = claimed_corners(root, primitive);
    *triangles = triangles.saturating_add(claimed_triangles(root, primitive));
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
    let positions = accessors.vectors::<3>(positions, &used)?.into_iter();
    let mut vertices: Vec<Vertex> = positions
        .map(|position| Vertex {
            position: to_scene
                .transform_point3(DVec3::from_array(position.map(f64::from)))
                .as_vec3(),
            normal: Vec3::ZERO,
            uv: Vec2::ZERO,
            colour: [1.0; 3],
            tangent: [0.0; 4],
        })
        .collect();
    let linear = DMat3::from_mat4(to_scene);
    let mirrors = linear.determinant() < 0.0;
    if let Some(normals) = attribute(primitive, Semantic::Normals) {
        // Its cofactors are its inverse, transposed, times its determinant.
        let side = if mirrors { -1.0 } else { 1.0 };
        let [x, y, z] = [linear.x_axis, linear.y_axis, linear.z_axis];
        let turned = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * side;
        let normals = accessors.vectors::<3>(normals, &used)?;
        for (vertex, normal) in vertices.iter_mut().zip(normals) {
            let normal = turned * DVec3::from_array(normal.map(f64::from));
            vertex.normal = normal.normalize_or_zero().as_vec3();
        }
    }
    let material = primitive.material.map(|material| material.value());
    let place = Place::of(root, material);
    let uvs = attribute(primitive, Semantic::TexCoords(place.set));
    if let Some(uvs) = uvs {
        let uvs = accessors.vectors::<2>(uvs, &used)?;
        for (vertex, uv) in vertices.iter_mut().zip(uvs) {
            vertex.uv = place.uv(uv);
        }
    }
    let colours = attribute(primitive, Semantic::Colors(0));
    if let Some(colours) = colours {
        let colours = accessors.colours(colours, &used)?;
        for (vertex, colour) in vertices.iter_mut().zip(colours) {
            vertex.colour = colour;
        }
    }
    let tangents = attribute(primitive, Semantic::Tangents);
    let tangents = tangents.filter(|_| texture(root, material, Of::Normals).is_some());
    if let Some(tangents) = tangents {
        let tangents = accessors.vectors::<4>(tangents, &used)?;
        for (vertex, [x, y, z, sign]) in vertices.iter_mut().zip(tangents) {
            let tangent = linear * DVec3::from([x, y, z].map(f64::from));
            let [x, y, z] = tangent.normalize_or_zero().as_vec3().to_array();
            vertex.tangent = [x, y, z, if mirrors { -sign } else { sign }];
        }
    }
    let triangles = corners.iter().map(|corners| {
        let [a, b, c] = corners.map(own);
        if mirrors { [a, c, b] } else { [a, b, c] }
    });
    Ok(Patch {
        material,
        vertices,
        has_uvs: uvs.is_some(),
        has_colours: colours.is_some(),
        has_tangents: tangents.is_some(),
        triangles: triangles.collect(),
    })
}

/// All patches as one mesh.
pub(super) fn joined(patches: &[Patch]) -> Result<TriangleMesh, ModelError> {
    let mut triangles = Vec::new();
    let mut first = 0;
    for patch in patches {
        triangles.extend(patch.triangles.iter().map(|face| face.map(|i| i + first)));
        first += patch.vertices.len() as u32;
    }
    let vertices = || patches.iter().flat_map(|patch| &patch.vertices);
    let any = |has: fn(&Patch) -> bool| patches.iter().any(has);
    let has_normals = vertices().any(|vertex| vertex.normal != Vec3::ZERO);
    let positions = vertices().map(|vertex| vertex.position).collect();
    let normals = has_normals.then(|| vertices().map(|vertex| vertex.normal).collect());
    let uvs = any(|patch| patch.has_uvs).then(|| vertices().map(|vertex| vertex.uv).collect());
    let mut mesh = TriangleMesh::new(positions, normals, uvs, triangles)?;
    if any(|patch| patch.has_colours) {
        mesh = mesh.with_colours(vertices().map(|vertex| vertex.colour).collect());
    }
    if any(|patch| patch.has_tangents) {
        mesh = mesh.with_tangents(vertices().map(|vertex| vertex.tangent).collect());
    }
    Ok(mesh)
}
