//! Nodes: where meshes lie.

use glam::{DAffine3, DMat3, DQuat, DVec3, Mat3};
use serde_json::{Value, json};

use super::document::GltfDocument;

/// From Lamina's frame, +z up, to glTF's, +y up.
const TO_GLTF: DMat3 = DMat3::from_cols(DVec3::X, DVec3::NEG_Z, DVec3::Y);

/// Cosine between axes that are at right angles but for rounding.
const RIGHT_ANGLE: f64 = 1e-5;

/// A place of a mesh.
#[derive(Clone, Copy, Debug)]
pub(super) struct MeshPlace {
    translation: DVec3,
    rotation: DQuat,
    /// Negative along x if the place mirrors.
    scale: DVec3,
}

impl MeshPlace {
    /// The place of a transform of the scene, and what remains to be done with the mesh before: nothing,
    /// unless the transform skews.
    pub(super) fn of(to_scene: &DAffine3) -> (Self, Option<Mat3>) {
        let linear = TO_GLTF * to_scene.matrix3;
        let translation = TO_GLTF * to_scene.translation;
        let side = linear.determinant().signum();
        let columns = [linear.x_axis, linear.y_axis, linear.z_axis];
        let lengths = DVec3::from(columns.map(DVec3::length));
        let [x, y, z] = [0, 1, 2].map(|axis| columns[axis] / lengths[axis]);
        let skew = [x.dot(y), y.dot(z), z.dot(x)];
        if skew.iter().any(|cosine| cosine.abs() > RIGHT_ANGLE) {
            let place = Self {
                translation,
                rotation: DQuat::from_mat3(&TO_GLTF),
                scale: DVec3::ONE,
            };
            return (place, Some(to_scene.matrix3.as_mat3()));
        }
        let rotation = DQuat::from_mat3(&DMat3::from_cols(x * side, y, z)).normalize();
        let scale = lengths * DVec3::new(side, 1.0, 1.0);
        let place = Self {
            translation,
            rotation,
            scale,
        };
        (place, None)
    }

    fn mirrors(&self) -> bool {
        self.scale.x < 0.0
    }

    /// Translation, rotation, scale.
    fn numbers(&self) -> ([f32; 3], [f32; 4], [f32; 3]) {
        (
            self.translation.as_vec3().to_array(),
            self.rotation.as_quat().normalize().to_array(),
            self.scale.as_vec3().to_array(),
        )
    }

    /// The same in a frame that is mirrored in x.
    fn mirrored(self) -> Self {
        let DQuat { x, y, z, w } = self.rotation;
        let mirror = DVec3::new(-1.0, 1.0, 1.0);
        Self {
            translation: self.translation * mirror,
            rotation: DQuat::from_xyzw(x, -y, -z, w),
            scale: self.scale * mirror,
        }
    }

    fn node(&self, name: &str, mesh: usize) -> Value {
        let (translation, rotation, scale) = self.numbers();
        let mut node = json!({ "name": name, "mesh": mesh });
        let parts = [
            ("translation", json!(translation), translation == [0.0; 3]),
            (
                "rotation",
                json!(rotation),
                rotation == [0.0, 0.0, 0.0, 1.0],
            ),
            ("scale", json!(scale), scale == [1.0; 3]),
        ];
        for (key, value, is_usual) in parts {
            if !is_usual {
                node[key] = value;
            }
        }
        node
    }
}

/// Adds nodes for all places of a mesh, one each or, of several, as instances, and returns their numbers.
/// Instances that mirror come under a node that does, because viewers ask that alone for the sides of
/// triangles.
pub(super) fn add(
    file: &mut GltfDocument,
    name: &str,
    mesh: usize,
    places: &[MeshPlace],
    are_plain: bool,
) -> Vec<usize> {
    if are_plain || places.len() == 1 {
        let nodes = places.iter().enumerate().map(|(number, place)| {
            let name = match number {
                0 => name.to_owned(),
                number => format!("{name}.{}", number + 1),
            };
            file.add("nodes", place.node(&name, mesh))
        });
        return nodes.collect();
    }
    let mut nodes = Vec::new();
    for mirrors in [false, true] {
        let own = places.iter().filter(|place| place.mirrors() == mirrors);
        let own: Vec<_> = own
            .map(|place| if mirrors { place.mirrored() } else { *place })
            .map(|place| place.numbers())
            .collect();
        if own.is_empty() {
            continue;
        }
        let translations: Vec<_> = own.iter().map(|(translation, _, _)| *translation).collect();
        let rotations: Vec<_> = own.iter().map(|(_, rotation, _)| *rotation).collect();
        let scales: Vec<_> = own.iter().map(|(_, _, scale)| *scale).collect();
        let attributes = json!({
            "TRANSLATION": file.vectors(&translations, false, false),
            "ROTATION": file.vectors(&rotations, false, false),
            "SCALE": file.vectors(&scales, false, false),
        });
        let extension = file.requires("EXT_mesh_gpu_instancing");
        let mut node = json!({
            "name": name,
            "mesh": mesh,
            "extensions": { extension: { "attributes": attributes } },
        });
        if mirrors {
            node["name"] = format!("{name}.mirrored").into();
            node["scale"] = json!([-1.0, 1.0, 1.0]);
        }
        nodes.push(file.add("nodes", node));
    }
    nodes
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    /// Where a place of a node, or of an instance under a node that mirrors, carries a point.
    fn carried(place: &MeshPlace, point: DVec3) -> DVec3 {
        place.translation + place.rotation * (place.scale * point)
    }

    #[test]
    fn places_carry_points_where_the_scene_does_with_y_up() {
        let point = DVec3::new(0.3, -0.2, 0.7);
        let turned = DMat3::from_rotation_x(0.4) * DMat3::from_rotation_z(2.0);
        let mirror = DMat3::from_diagonal(DVec3::new(1.0, -2.0, 0.5));
        for linear in [
            DMat3::IDENTITY,
            turned,
            turned * mirror,
            turned * mirror * turned,
        ] {
            let to_scene = DAffine3::from_mat3_translation(linear, DVec3::new(1.0, 2.0, 3.0));
            let (place, before) = MeshPlace::of(&to_scene);
            let before = before.map_or(point, |before| (before * point.as_vec3()).as_dvec3());
            let wanted = to_scene.transform_point3(point);
            let wanted = DVec3::new(wanted.x, wanted.z, -wanted.y);
            assert!(carried(&place, before).distance(wanted) < 1e-6, "{linear}");
            let mirrored = carried(&place.mirrored(), before) * DVec3::new(-1.0, 1.0, 1.0);
            assert!(mirrored.distance(wanted) < 1e-6, "{linear}");
        }
        assert_eq!(TO_GLTF.as_mat3() * Vec3::Z, Vec3::Y);
    }
}
