//! Meshes with their surfaces.

use glam::{Mat3, Vec2, Vec3};
use serde_json::{Value, json};

use super::document::GltfDocument;
use super::surface::{Arrangement, Surface};
use crate::geometry::TriangleMesh;
use crate::material::colour_map::ColourMap;

/// The vertices that some triangles use, as glTF has them.
#[derive(Debug, Default)]
struct Vertices {
    positions: Vec<[f32; 3]>,
    normals: Vec<[f32; 3]>,
    uvs: Vec<[f32; 2]>,
    tangents: Vec<[f32; 4]>,
    colours: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
}

/// How a surface's materials lie in the file, and which of them a mesh takes.
#[derive(Debug)]
pub(super) struct Dressing<'a> {
    pub(super) surface: &'a Surface<'a>,
    /// Numbers of the materials in the file.
    pub(super) materials: &'a [usize],
    /// Whether both faces of a leaf are one surface with the adaxial face's material.
    pub(super) is_one_face: bool,
    /// Whether colours of vertices are factors.
    pub(super) is_tinted: bool,
    /// The first corner and the sides of its place in the pictures of several meshes.
    pub(super) place: [Vec2; 2],
}

/// Adds a mesh, each of whose vertices is moved by `linear`, and returns its number and how many triangles
/// it has.
pub(super) fn add(
    file: &mut GltfDocument,
    name: &str,
    mesh: &TriangleMesh,
    linear: Mat3,
    dressing: &Dressing<'_>,
) -> (usize, usize) {
    let all = mesh.triangles();
    let gather = |triangles: Vec<[u32; 3]>, map: Option<(&ColourMap, usize)>| {
        gathered(mesh, triangles, linear, map, dressing)
    };
    let materials = dressing.materials;
    let primitives: Vec<(Vertices, Vec<(usize, bool)>)> = match &dressing.surface.arrangement {
        Arrangement::Whole => vec![(gather(all.to_vec(), None), vec![(materials[0], false)])],
        Arrangement::Faces if dressing.is_one_face => {
            vec![(gather(all.to_vec(), None), vec![(materials[0], false)])]
        }
        Arrangement::Faces => {
            let faces = vec![(materials[0], false), (materials[1], true)];
            vec![(gather(all.to_vec(), None), faces)]
        }
        Arrangement::Backs => vec![(gather(all.to_vec(), None), vec![(materials[0], true)])],
        Arrangement::Slots(map) => {
            let slot_of = |triangle: &[u32; 3]| {
                let uvs = mesh
                    .uvs()
                    .map(|uvs| triangle.map(|vertex| uvs[vertex as usize]));
                let middle = uvs.map(|[a, b, c]| (a + b + c) / 3.0);
                map.place(middle.unwrap_or_default()).0
            };
            let of_slot = |slot| {
                let own = all
                    .iter()
                    .copied()
                    .filter(|triangle| slot_of(triangle) == slot);
                gather(own.collect(), Some((map, slot)))
            };
            let slots = materials.iter().enumerate();
            let slots = slots.map(|(slot, material)| (of_slot(slot), vec![(*material, false)]));
            slots.filter(|(own, _)| !own.triangles.is_empty()).collect()
        }
    };
    let mut written: Vec<Value> = Vec::new();
    let mut count = 0;
    for (vertices, faces) in primitives {
        count += vertices.triangles.len() * faces.len();
        written.extend(vertices.written(file, &faces));
    }
    let mesh = json!({ "name": name, "primitives": written });
    (file.add("meshes", mesh), count)
}

impl Vertices {
    /// A primitive for each of the materials, on the triangles or on their backs.
    fn written(mut self, file: &mut GltfDocument, faces: &[(usize, bool)]) -> Vec<Value> {
        let positions = file.vectors(&self.positions, true, true);
        let uvs = (!self.uvs.is_empty()).then(|| file.vectors(&self.uvs, true, false));
        let colours = (!self.colours.is_empty()).then(|| file.vectors(&self.colours, true, false));
        let faces = faces.iter().map(|&(material, is_back)| {
            if is_back {
                for normal in &mut self.normals {
                    *normal = normal.map(|value| -value);
                }
                for tangent in &mut self.tangents {
                    tangent[3] = -tangent[3];
                }
                for triangle in &mut self.triangles {
                    triangle.swap(1, 2);
                }
            }
            let mut attributes = json!({ "POSITION": positions });
            if !self.normals.is_empty() {
                attributes["NORMAL"] = file.vectors(&self.normals, true, false).into();
            }
            if !self.tangents.is_empty() {
                attributes["TANGENT"] = file.vectors(&self.tangents, true, false).into();
            }
            for (name, accessor) in [("TEXCOORD_0", uvs), ("COLOR_0", colours)] {
                if let Some(accessor) = accessor {
                    attributes[name] = accessor.into();
                }
            }
            let indices = file.triangles(&self.triangles, self.positions.len());
            json!({ "attributes": attributes, "indices": indices, "material": material })
        });
        faces.collect()
    }
}

/// The vertices of some triangles of a mesh. Of a map of colours, and a slot of it in which they all lie,
/// texture coordinates become those of the slot's picture.
fn gathered(
    mesh: &TriangleMesh,
    mut triangles: Vec<[u32; 3]>,
    linear: Mat3,
    map: Option<(&ColourMap, usize)>,
    dressing: &Dressing<'_>,
) -> Vertices {
    let mut numbers = vec![u32::MAX; mesh.positions().len()];
    let mut used = Vec::new();
    for vertex in triangles.as_flattened_mut() {
        let number = &mut numbers[*vertex as usize];
        if *number == u32::MAX {
            *number = used.len() as u32;
            used.push(*vertex as usize);
        }
        *vertex = *number;
    }
    let positions: Vec<Vec3> = used.iter().map(|&v| linear * mesh.positions()[v]).collect();
    let normals = mesh.normals().map(|normals| {
        let inverse = linear.inverse().transpose();
        let given = used.iter().map(|&v| (inverse * normals[v]).try_normalize());
        let mut all: Vec<Option<Vec3>> = given.collect();
        // One that is missing is that of the face.
        for triangle in &triangles {
            let [a, b, c] = triangle.map(|v| positions[v as usize]);
            for vertex in triangle {
                all[*vertex as usize]
                    .get_or_insert_with(|| (b - a).cross(c - a).normalize_or(Vec3::Z));
            }
        }
        all.into_iter().flatten().collect::<Vec<Vec3>>()
    });
    // Without pictures nobody reads them, and what nobody reads is reported by validators.
    let uvs = mesh.uvs().filter(|_| dressing.surface.has_pictures());
    let uvs: Option<Vec<Vec2>> = uvs.map(|uvs| {
        let own = used.iter().map(|&v| uvs[v]);
        match map {
            Some((map, slot)) => {
                let shift = Vec2::new(map.slots()[slot].shift, 0.0);
                own.map(|uv| (uv - shift) * map.repeats()).collect()
            }
            None => own
                .map(|uv| dressing.place[0] + uv * dressing.place[1])
                .collect(),
        }
    });
    let mut vertices = Vertices::default();
    if let (Some(normals), Some(uvs), true) = (&normals, &uvs, dressing.surface.has_normals()) {
        let given = mesh.tangents();
        let given = given.map(|all| used.iter().map(|&v| all[v]).collect::<Vec<_>>());
        vertices.tangents = tangents(&positions, normals, uvs, &triangles, given.as_deref());
    }
    if let Some(colours) = mesh.colours().filter(|_| dressing.is_tinted) {
        vertices.colours = used.iter().map(|&v| colours[v]).collect();
    }
    vertices.positions = positions.iter().map(Vec3::to_array).collect();
    vertices.normals = normals.iter().flatten().map(Vec3::to_array).collect();
    // The first row of a picture is at v = 1.
    vertices.uvs = uvs.iter().flatten().map(|uv| [uv.x, 1.0 - uv.y]).collect();
    vertices.triangles = triangles;
    vertices
}

/// The direction of u at each vertex, across the normal, and the sign with which the normal times it is
/// that of v. Those that are given hold where they are not zero.
fn tangents(
    positions: &[Vec3],
    normals: &[Vec3],
    uvs: &[Vec2],
    triangles: &[[u32; 3]],
    given: Option<&[[f32; 4]]>,
) -> Vec<[f32; 4]> {
    let mut sums = vec![(Vec3::ZERO, 0.0_f32); positions.len()];
    for triangle in triangles {
        let [a, b, c] = triangle.map(|vertex| vertex as usize);
        let (first, second) = (uvs[b] - uvs[a], uvs[c] - uvs[a]);
        let area = first.perp_dot(second);
        let along_u =
            (positions[b] - positions[a]) * second.y - (positions[c] - positions[a]) * first.y;
        for vertex in [a, b, c] {
            sums[vertex].0 += along_u * area.signum();
            sums[vertex].1 += area;
        }
    }
    let all = sums.into_iter().zip(normals).enumerate();
    all.map(|(vertex, ((along_u, area), normal))| {
        let own = given.map_or([0.0; 4], |given| given[vertex]);
        let [x, y, z, sign] = own;
        let (along, sign) = match Vec3::new(x, y, z) {
            Vec3::ZERO => (along_u, area),
            along => (along, sign),
        };
        let across = (along - *normal * along.dot(*normal)).try_normalize();
        let along = across.unwrap_or_else(|| normal.any_orthonormal_vector());
        along.extend(if sign < 0.0 { -1.0 } else { 1.0 }).to_array()
    })
    .collect()
}
