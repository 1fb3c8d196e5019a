//! The files are read by the crate `gltf`, which checks indices, bounds and types.

use std::sync::LazyLock;

use glam::{Mat4, Vec3};
use gltf::json::validation::Error;

use super::*;
use crate::scene::load;
use crate::scene::world::BuildOptions;

/// Four places of a small leaf with small maps, of which the last two are then mirrored, and a floor.
const SCENE: &str = r#"
format = 1
[film.rgb]
size = [8, 8]
spp = 1
[camera.perspective]
position_m = [0, 0, 1]
look_at_m = [0, 0.01, 0]
vertical_fov_deg = 40
[leaves.birch]
preset = "birch-autumn"
length_mm = 20
map_size = 64
light_spread = 0
[leaves.birch.blade]
max_edge_mm = 4
[objects.leaves]
leaf = "birch"
instances = { file = "places.csv" }
[meshes.floor.rectangle]
width_m = 0.4
height_m = 0.2
[materials.grey.diffuse]
reflectance = 0.5
[objects.floor]
mesh = "floor"
material = "grey"
position_m = [0, 0, -0.01]
[lights.sky.constant]
radiance_w_m2_sr_nm = 1
"#;
const PLACES: &str = "x_m,y_m,z_m,rotate_z_deg,scale_x,scale_y,scale_z\n\
    0,0,0.1,30,1,1,1\n0.05,0,0.1,0,2,2,2\n0.1,0.02,0.1,0,1,1,1\n0.1,-0.02,0.1,20,1,1,1\n";

static BUILT: LazyLock<(Description, World)> = LazyLock::new(|| {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("places.csv"), PLACES).expect("written");
    let loaded = load::parse(SCENE, "scene.toml", folder.path(), &[]);
    let mut scene = loaded
        .unwrap_or_else(|errors| panic!("{errors}"))
        .description;
    let places = scene.objects[0].value.instances.as_mut();
    for place in &mut places.expect("those of the file")[2..] {
        place.linear *= Mat3::from_diagonal(Vec3::new(-1.0, 1.0, 1.0));
    }
    let wavelengths = wavelengths();
    let options = BuildOptions {
        wavelengths: Some(&wavelengths),
        ..BuildOptions::default()
    };
    let world = World::build_with(&scene, &options).expect("a good scene");
    (scene, world)
});

/// The document and its bytes; its faults but for extensions that the crate does not know.
fn read(file: &[u8]) -> (gltf::Document, Vec<u8>) {
    let glb = gltf::Glb::from_slice(file).expect("a glb file");
    let json = gltf::json::Root::from_slice(&glb.json).expect("glTF's JSON");
    let mut faults = Vec::new();
    gltf::json::validation::Validate::validate(
        &json,
        &json,
        gltf::json::Path::new,
        &mut |path, error| {
            if error != Error::Unsupported {
                faults.push(format!("{}: {error}", path()));
            }
        },
    );
    assert!(faults.is_empty(), "{faults:?}");
    let document = gltf::Document::from_json_without_validation(json);
    (document, glb.bin.expect("it has bytes").into_owned())
}

/// Corners of all triangles in the file's frame, of plain nodes.
fn corners(document: &gltf::Document, bytes: &[u8]) -> Vec<[Vec3; 3]> {
    fn visit(node: &gltf::Node<'_>, above: Mat4, bytes: &[u8], all: &mut Vec<[Vec3; 3]>) {
        let to_file = above * Mat4::from_cols_array_2d(&node.transform().matrix());
        for primitive in node.mesh().iter().flat_map(gltf::Mesh::primitives) {
            let reader = primitive.reader(|_| Some(bytes));
            let positions: Vec<[f32; 3]> = reader.read_positions().expect("positions").collect();
            let carried = |i: u32| to_file.transform_point3(Vec3::from(positions[i as usize]));
            let indices: Vec<u32> = reader.read_indices().expect("indices").into_u32().collect();
            all.extend(
                indices
                    .as_chunks::<3>()
                    .0
                    .iter()
                    .map(|triangle| triangle.map(carried)),
            );
        }
        for child in node.children() {
            visit(&child, to_file, bytes, all);
        }
    }
    let mut all = Vec::new();
    for node in document.default_scene().expect("a scene").nodes() {
        visit(&node, Mat4::IDENTITY, bytes, &mut all);
    }
    all
}

/// A place to a tenth of a micrometre, in the scene's frame.
fn key(corner: Vec3) -> [i64; 3] {
    [corner.x, -corner.z, corner.y].map(|m| (f64::from(m) * 1e7).round() as i64)
}

#[test]
fn every_place_arrives_in_metres_with_y_up_and_the_same_scene_gives_the_same_bytes() {
    let (scene, world) = &*BUILT;
    let plain = GltfOptions {
        plain_nodes: true,
        ..GltfOptions::default()
    };
    let (file, extent) = glb(scene, world, plain).expect("a file");
    assert!(file == glb(scene, world, plain).expect("a file").0);
    let (document, bytes) = read(&file);
    let found = corners(&document, &bytes);
    assert_eq!(found.len(), extent.triangles);
    let mut low = Vec3::INFINITY;
    let mut high = Vec3::NEG_INFINITY;
    for corner in found.iter().flatten() {
        (low, high) = (low.min(*corner), high.max(*corner));
    }
    let size = DVec3::new(extent.size_m.x, extent.size_m.z, extent.size_m.y);
    // Numbers of 32 bits for places up to 0.2 m; bounds are those of boxes.
    assert!(
        (high - low).as_dvec3().distance(size) < 0.01,
        "{low} {high} {size}"
    );
    assert!(
        (low.y - -0.01).abs() < 1e-6,
        "the floor is the lowest: {low}"
    );
    // Each triangle of the world is there, as often as it has faces that are seen.
    let mut keys: Vec<[[i64; 3]; 3]> = found
        .iter()
        .map(|corners| {
            let mut keys = corners.map(key);
            keys.sort_unstable();
            keys
        })
        .collect();
    keys.sort_unstable();
    let coarse = Coarse {
        world,
        options: plain,
    };
    for instance in 0..world.objects.len() as u32 {
        let placed = world.geometry.instance(instance);
        let (mesh, to_scene) = (world.geometry.mesh(placed.mesh), placed.to_scene());
        let faces = 1 + usize::from(coarse.is_sheet(
            placed.mesh as usize,
            world.objects[instance as usize].material,
        ));
        let first = mesh.triangles()[0].map(|v| {
            to_scene
                .transform_point3(mesh.positions()[v as usize].as_dvec3())
                .as_vec3()
        });
        let near = |keys: &&[[i64; 3]; 3]| {
            let mut own = first.map(|p| p.to_array().map(|m| (f64::from(m) * 1e7).round() as i64));
            own.sort_unstable();
            keys.as_flattened()
                .iter()
                .zip(own.as_flattened())
                .all(|(a, b)| (a - b).abs() <= 3)
        };
        assert_eq!(
            keys.iter().filter(near).count(),
            faces,
            "instance {instance}"
        );
    }
}

#[test]
fn instances_are_the_plain_nodes_and_those_that_mirror_are_under_a_node_that_does() {
    let (scene, world) = &*BUILT;
    let (file, extent) = glb(scene, world, GltfOptions::default()).expect("a file");
    let (document, _) = read(&file);
    let of = |name: &str| {
        let node = document.nodes().find(|node| node.name() == Some(name));
        let node = node.unwrap_or_else(|| panic!("there is no node {name}"));
        let instances = node.extension_value("EXT_mesh_gpu_instancing").cloned();
        let instances = instances.unwrap_or_else(|| panic!("{name} has no instances"));
        let number = |key| instances["attributes"][key].as_u64().expect("an accessor") as usize;
        let count = |key| {
            document
                .accessors()
                .nth(number(key))
                .expect("it is there")
                .count()
        };
        assert_eq!(count("TRANSLATION"), count("ROTATION"));
        assert_eq!(count("TRANSLATION"), count("SCALE"));
        (count("TRANSLATION"), node.transform().decomposed().2)
    };
    assert_eq!(of("leaves"), (2, [1.0; 3]));
    assert_eq!(of("leaves.mirrored"), (2, [-1.0, 1.0, 1.0]));
    assert!(
        document
            .extensions_required()
            .any(|name| name == "EXT_mesh_gpu_instancing")
    );
    assert!(extent.stored < extent.triangles);
}

#[test]
fn textures_hold_the_colours_of_the_tissue_below_its_coat() {
    let (scene, world) = &*BUILT;
    let (file, _) = glb(scene, world, GltfOptions::default()).expect("a file");
    let (document, bytes) = read(&file);
    let is_map = |own: &&LeafMaterial| own.tissue.map().is_some();
    let mut leaves = world.materials.iter().filter_map(|material| {
        let own = if let Material::Leaf(leaf) = material {
            Some(&**leaf)
        } else {
            None
        };
        own.filter(is_map)
    });
    let leaf = leaves.next().expect("a blade");
    let colorimetry = Colorimetry::under(Illuminant::D65);
    for (face, name) in ["leaf-birch.adaxial", "leaf-birch.abaxial"]
        .into_iter()
        .enumerate()
    {
        let written = document
            .materials()
            .find(|material| material.name() == Some(name));
        let written = written.expect("it is there");
        let light = written
            .extension_value("KHR_materials_diffuse_transmission")
            .expect("it lets light through");
        let fraction = light["diffuseTransmissionFactor"]
            .as_f64()
            .expect("a number") as f32;
        let light = light["diffuseTransmissionColorTexture"]["index"]
            .as_u64()
            .expect("a texture");
        let base = written
            .pbr_metallic_roughness()
            .base_color_texture()
            .expect("a texture");
        let pictures = [
            (base.texture().index(), 1.0 - fraction),
            (light as usize, fraction),
        ];
        let bsdf = leaf.whole_bsdf::<{ colours::WAVELENGTHS }>(
            glam::Vec2::new(0.5 + 0.5 / 64.0, 0.5 + 0.5 / 64.0),
            &world.wavelengths.grid().set(0),
        );
        for ((texture, part), spectrum) in pictures.into_iter().zip(bsdf.below_coat(face)) {
            let texture = document.textures().nth(texture).expect("it is there");
            let gltf::image::Source::View { view, .. } = texture.source().source() else {
                panic!("pictures are in the file");
            };
            let png = &bytes[view.offset()..][..view.length()];
            let picture = image::load_from_memory(png).expect("a picture").to_rgb8();
            assert_eq!(picture.dimensions(), (64, 64));
            let texel = picture.get_pixel(32, 31).0;
            for (stored, wanted) in texel.into_iter().zip(colorimetry.linear(&spectrum)) {
                let found = part * crate::image::tone::from_srgb(f64::from(stored) / 255.0) as f32;
                // A mean over the texel, of 8 bits, against its middle.
                assert!(
                    (found - wanted).abs() < 0.02,
                    "{name}: {found} for {wanted}"
                );
            }
        }
    }
}
