//! Models made here, whole and damaged.

use std::collections::BTreeMap;

use glam::{DAffine3, DMat3, DVec3, Vec2, Vec3};
use serde_json::{Value, json};

use super::*;
use crate::bsdf::Bsdf;
use crate::geometry::{Geometry, Instance, Ray};
use crate::image::portable_network;
use crate::material::Material;
use crate::material::model::ModelMaterial;
use crate::material::reflectance::Reflectance;
use crate::spectrum::rgb::Primaries;
use crate::spectrum::{Curve, Lanes, Wavelengths};
use crate::walk::cone::Cone;
use crate::walk::encounter::Encounter;

/// What all but a few tests look at.
const COLOURS: Wanted = Wanted {
    colours: true,
    finishes: false,
    emission: false,
};

fn wavelengths() -> Wavelengths<4> {
    Wavelengths::new([450.0, 530.0, 610.0, 700.0])
}

/// A document under construction: JSON and the bytes of its buffer.
struct Made {
    json: Value,
    bytes: Vec<u8>,
}

impl Made {
    /// One node with one mesh without primitives.
    fn empty() -> Self {
        let json = json!({
            "asset": { "version": "2.0" },
            "scenes": [{ "nodes": [0] }],
            "nodes": [{ "mesh": 0 }],
            "meshes": [{ "primitives": [] }],
            "accessors": [], "bufferViews": [], "materials": [],
            "textures": [], "images": [], "samplers": [],
        });
        Self {
            json,
            bytes: Vec::new(),
        }
    }

    fn push(&mut self, list: &str, value: Value) -> usize {
        let list = self.json[list].as_array_mut().expect("a list");
        list.push(value);
        list.len() - 1
    }

    fn view(&mut self, bytes: &[u8]) -> usize {
        let start = self.bytes.len();
        self.bytes.extend(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let view = json!({ "buffer": 0, "byteOffset": start, "byteLength": bytes.len() });
        self.push("bufferViews", view)
    }

    fn floats<const N: usize>(&mut self, values: &[[f32; N]]) -> usize {
        let bytes: Vec<u8> = values
            .iter()
            .flatten()
            .flat_map(|v| v.to_le_bytes())
            .collect();
        let view = self.view(&bytes);
        let kind = ["", "SCALAR", "VEC2", "VEC3", "VEC4"][N];
        let accessor = json!({
            "bufferView": view, "componentType": 5126, "count": values.len(), "type": kind,
        });
        self.push("accessors", accessor)
    }

    fn indices(&mut self, values: &[u16]) -> usize {
        let bytes: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
        let view = self.view(&bytes);
        let accessor = json!({
            "bufferView": view, "componentType": 5123, "count": values.len(), "type": "SCALAR",
        });
        self.push("accessors", accessor)
    }

    /// Adds a square of 1 m around the origin in the file's xy plane, z = `z`, to the mesh.
    fn square(&mut self, z: f32, material: Option<usize>) -> &mut Value {
        let corners = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]];
        let positions = self.floats(&corners.map(|[x, y]| [x, y, z]));
        let normals = self.floats(&[[0.0, 0.0, 1.0]; 4]);
        // v runs down.
        let uvs = self.floats(&corners.map(|[x, y]| [x + 0.5, 0.5 - y]));
        let indices = self.indices(&[0, 1, 2, 0, 2, 3]);
        let mut primitive = json!({
            "attributes": { "POSITION": positions, "NORMAL": normals, "TEXCOORD_0": uvs },
            "indices": indices,
        });
        if let Some(material) = material {
            primitive["material"] = json!(material);
        }
        let list = self.json["meshes"][0]["primitives"].as_array_mut();
        let list = list.expect("a list");
        list.push(primitive);
        list.last_mut().expect("it was just added")
    }

    /// A picture of 2 × 1 pixels, black and white, in the buffer, as a texture.
    fn texture(&mut self, wrap: u32) -> usize {
        let png = portable_network::encoded(2, 1, &[0, 0, 0, 255, 255, 255]).expect("two pixels");
        let view = self.view(&png);
        let image = self.push(
            "images",
            json!({ "bufferView": view, "mimeType": "image/png" }),
        );
        let sampler = self.push("samplers", json!({ "wrapS": wrap, "wrapT": wrap }));
        self.push("textures", json!({ "source": image, "sampler": sampler }))
    }

    fn paint(&mut self, factor: [f32; 4], texture: Option<Value>) -> usize {
        let mut colour = json!({ "baseColorFactor": factor, "metallicFactor": 0 });
        if let Some(texture) = texture {
            colour["baseColorTexture"] = texture;
        }
        self.push("materials", json!({ "pbrMetallicRoughness": colour }))
    }

    fn glb(&self) -> Vec<u8> {
        let mut json = self.json.clone();
        json["buffers"] = json!([{ "byteLength": self.bytes.len() }]);
        let mut json = json.to_string().into_bytes();
        json.resize(json.len().next_multiple_of(4), b' ');
        let mut glb = b"glTF".to_vec();
        let length = 12 + 8 + json.len() + 8 + self.bytes.len();
        for number in [2, length as u32, json.len() as u32] {
            glb.extend(number.to_le_bytes());
        }
        glb.extend(b"JSON");
        glb.extend(json);
        glb.extend((self.bytes.len() as u32).to_le_bytes());
        glb.extend(b"BIN\0");
        glb.extend(&self.bytes);
        glb
    }

    /// As JSON that holds its bytes.
    fn text(&self) -> Vec<u8> {
        use base64::Engine as _;
        let data = base64::engine::general_purpose::STANDARD.encode(&self.bytes);
        let uri = format!("data:application/octet-stream;base64,{data}");
        let mut json = self.json.clone();
        json["buffers"] = json!([{ "byteLength": self.bytes.len(), "uri": uri }]);
        json.to_string().into_bytes()
    }

    fn model(&self) -> Result<Model, ModelError> {
        opened(&self.glb())
    }

    /// The message of the error that it gives.
    fn refused(&self) -> String {
        let error = self.model().map(|_| ()).expect_err("it is damaged");
        error.to_string()
    }
}

fn opened(bytes: &[u8]) -> Result<Model, ModelError> {
    read(&Container::open(bytes)?, &|_| None, 1.0, COLOURS)
}

fn square() -> Made {
    let mut made = Made::empty();
    made.square(0.0, None);
    made
}

fn near(found: Vec3, expected: Vec3) {
    assert!((found - expected).length() < 1e-6, "{found} {expected}");
}

#[test]
fn a_square_that_is_in_the_file_is_in_the_scene() {
    for bytes in [square().glb(), square().text()] {
        let model = opened(&bytes).expect("a good model");
        assert_eq!(model.mesh.triangles(), [[0, 1, 2], [0, 2, 3]]);
        // +y of the file is up, and its +z towards −y.
        near(model.mesh.positions()[0], Vec3::new(-0.5, 0.0, -0.5));
        near(model.mesh.positions()[2], Vec3::new(0.5, 0.0, 0.5));
        near(model.mesh.normals().expect("it has them")[0], -Vec3::Y);
        // v is upwards.
        let uvs = model.mesh.uvs().expect("it has them");
        assert_eq!([uvs[0], uvs[2]], [Vec2::ZERO, Vec2::ONE]);
        assert_eq!(model.left_out, Vec::<String>::new());
    }
}

#[test]
fn nodes_move_what_hangs_below_them() {
    let mut made = square();
    // Turned about y by 90°, twice as large, and moved; below a node that is moved too.
    let half = std::f32::consts::FRAC_1_SQRT_2;
    made.json["nodes"] = json!([
        { "children": [1], "translation": [0, 1, 0] },
        { "mesh": 0, "scale": [2, 2, 2], "rotation": [0, half, 0, half], "translation": [3, 0, 0] },
    ]);
    let model = made.model().expect("a good model");
    // (−½, −½, 0) becomes (−1, −1, 0), (0, −1, 1), (3, 0, 1) in the file.
    near(model.mesh.positions()[0], Vec3::new(3.0, -1.0, 0.0));
    near(model.mesh.normals().expect("it has them")[0], Vec3::X);
    let matrix = [0, 0, -2, 0, 0, 2, 0, 0, 2, 0, 0, 0, 3, 1, 0, 1];
    made.json["nodes"] = json!([{ "mesh": 0, "matrix": matrix }]);
    near(
        made.model().expect("a good model").mesh.positions()[0],
        Vec3::new(3.0, -1.0, 0.0),
    );
    // A mirror image has its outside outside, and uneven scales turn normals.
    made.json["nodes"] = json!([{ "mesh": 0, "scale": [-1, 2, 3] }]);
    let model = made.model().expect("a good model");
    let [a, b, c] = model.mesh.triangles()[0].map(|i| model.mesh.positions()[i as usize]);
    let outward = (b - a).cross(c - a).normalize();
    near(outward, -Vec3::Y);
    near(model.mesh.normals().expect("it has them")[0], -Vec3::Y);
}

#[test]
fn strips_fans_and_lists_without_indices_are_the_same_triangles() {
    for (mode, corners) in [(5, [0_u16, 1, 3, 2]), (6, [0, 1, 2, 3])] {
        let mut made = square();
        let indices = made.indices(&corners);
        let primitive = &mut made.json["meshes"][0]["primitives"][0];
        primitive["mode"] = json!(mode);
        primitive["indices"] = json!(indices);
        let mesh = made.model().expect("a good model").mesh;
        assert_eq!(mesh.triangles().len(), 2);
        for triangle in mesh.triangles() {
            let [a, b, c] = triangle.map(|i| mesh.positions()[i as usize]);
            near((b - a).cross(c - a), -Vec3::Y);
        }
    }
    let mut made = square();
    let primitive = &mut made.json["meshes"][0]["primitives"][0];
    primitive
        .as_object_mut()
        .expect("an object")
        .remove("indices");
    assert!(
        made.refused()
            .contains("4 corners, which is no multiple of 3")
    );
}

#[test]
fn shorts_and_bytes_stand_for_shares() {
    let mut made = square();
    let view = made.view(&[0, 255, 255, 255, 255, 0, 0, 0]);
    let uvs = made.push(
        "accessors",
        json!({ "bufferView": view, "componentType": 5121, "count": 4, "type": "VEC2", "normalized": true }),
    );
    made.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = json!(uvs);
    made.json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    let model = made.model().expect("a good model");
    let uvs = model.mesh.uvs().expect("it has them");
    assert_eq!([uvs[0], uvs[2]], [Vec2::ZERO, Vec2::ONE]);
}

/// The colours that a model has at a place of each square, by the square's height.
fn colours(model: &Model, at: Vec2) -> Vec<[f32; 3]> {
    let map = model.colours.as_ref().expect("they were asked for");
    let uvs = model.mesh.uvs().expect("it has them");
    let squares = uvs.chunks(4);
    let at = squares.map(|uvs| map.colour(uvs[0] + at * (uvs[2] - uvs[0])));
    at.collect()
}

#[test]
fn each_part_of_a_mesh_has_the_colour_of_its_own_material() {
    let mut made = Made::empty();
    let texture = made.texture(10497);
    let red = made.paint([0.8, 0.1, 0.1, 1.0], None);
    let grey = made.paint([0.5, 0.5, 0.25, 1.0], Some(json!({ "index": texture })));
    made.square(0.0, Some(red));
    made.square(1.0, Some(grey));
    made.square(2.0, None);
    made.square(3.0, Some(red));
    let model = made.model().expect("a good model");
    let red = [0.8, 0.1, 0.1];
    let dark = colours(&model, Vec2::new(0.25, 0.5));
    assert_eq!(dark, [red, [0.0; 3], [1.0; 3], red]);
    let bright = colours(&model, Vec2::new(0.75, 0.5));
    assert_eq!(bright, [red, [0.5, 0.5, 0.25], [1.0; 3], red]);
    // One material alone keeps its texture coordinates.
    let mut made = Made::empty();
    let texture = made.texture(33071);
    let alone = made.paint([1.0; 4], Some(json!({ "index": texture })));
    made.square(0.0, Some(alone));
    let model = made.model().expect("a good model");
    assert_eq!(model.mesh.uvs().expect("it has them")[2], Vec2::ONE);
    let map = model.colours.expect("they were asked for");
    assert_eq!(map.colour(Vec2::new(5.0, 0.0)), [1.0; 3]);
}

#[test]
fn a_transform_of_a_texture_turns_counter_clockwise_as_one_looks_at_it() {
    let mut made = Made::empty();
    let texture = made.texture(10497);
    let transform =
        json!({ "offset": [0.5, 0], "scale": [2, 1], "rotation": std::f64::consts::FRAC_PI_2 });
    let info = json!({ "index": texture, "extensions": { "KHR_texture_transform": transform } });
    let paint = made.paint([1.0; 4], Some(info));
    made.square(0.0, Some(paint));
    made.json["extensionsRequired"] = json!(["KHR_texture_transform"]);
    let model = made.model().expect("a good model");
    // The corner (u, v) = (1, 0): twice as far, turned to (0, −2), moved to (½, −2); v upwards is 3.
    let uv = model.mesh.uvs().expect("it has them")[2];
    assert!((uv - Vec2::new(0.5, 3.0)).length() < 1e-6, "{uv}");
}

#[test]
fn pictures_may_be_files_beside_and_names_may_be_written_in_percent() {
    let mut made = Made::empty();
    let texture = made.texture(10497);
    made.json["images"][0] = json!({ "uri": "the%20bark.png" });
    let paint = made.paint([1.0; 4], Some(json!({ "index": texture })));
    made.square(0.0, Some(paint));
    let mut json = made.json.clone();
    json["buffers"] = json!([{ "byteLength": made.bytes.len(), "uri": "pot.bin" }]);
    let text = json.to_string();
    let container = Container::open(text.as_bytes()).expect("good JSON");
    let expected = [
        ("pot.bin".to_owned(), FileKind::Buffer),
        ("the bark.png".to_owned(), FileKind::Picture),
    ];
    assert_eq!(container.files(), expected);
    let png = portable_network::encoded(1, 1, &[255, 0, 0]).expect("one pixel");
    let files = BTreeMap::from([("pot.bin", made.bytes), ("the bark.png", png)]);
    let bytes_of = |name: &str| files.get(name).map(Vec::as_slice);
    let model = read(&container, &bytes_of, 0.5, COLOURS).expect("a good model");
    assert_eq!(colours(&model, Vec2::splat(0.5)), [[1.0, 0.0, 0.0]]);
    near(model.mesh.positions()[2], Vec3::new(0.25, 0.0, 0.25));
    let none = read(&container, &|_| None, 1.0, Wanted::default()).map(|_| ());
    let text = none.expect_err("its buffer is not there").to_string();
    assert_eq!(text, "buffers[0]: the file \"pot.bin\" is not there");
}

#[test]
fn what_is_left_out_is_reported_by_name() {
    let mut made = square();
    made.json["animations"] = json!([{ "channels": [], "samplers": [] }]);
    made.json["materials"] = json!([{
        "alphaMode": "BLEND", "emissiveFactor": [1, 0, 0], "occlusionTexture": { "index": 0 },
        "pbrMetallicRoughness": { "roughnessFactor": 0.5 },
    }]);
    made.texture(10497);
    made.json["extensionsUsed"] = json!(["KHR_texture_transform", "KHR_materials_sheen"]);
    // Lights and materials may be required: shapes and pictures are there without them.
    made.json["extensionsRequired"] = json!(["KHR_lights_punctual", "KHR_materials_sheen"]);
    let line = json!({ "attributes": { "POSITION": 0 }, "mode": 1 });
    let list = made.json["meshes"][0]["primitives"].as_array_mut();
    list.expect("a list").push(line);
    let expected = [
        "animations",
        "emitted light (`emission = true` of an area light uses it)",
        "extension \"KHR_lights_punctual\"",
        "extension \"KHR_materials_sheen\"",
        "lines and points",
        "maps of occlusion",
        "metal (its base colour is taken as that of paint; the material `gltf` uses it)",
        "partial transparency (alpha mode BLEND is taken as opaque)",
        "roughness (that of the scene's material holds; the material `gltf` uses it)",
    ];
    assert_eq!(made.model().expect("a good model").left_out, expected);
}

/// Area of a model's triangles.
fn area(model: &Model) -> f32 {
    let faces = model.mesh.triangles().iter();
    let doubled = faces.map(|face| {
        let [a, b, c] = face.map(|corner| model.mesh.positions()[corner as usize]);
        (b - a).cross(c - a).length()
    });
    0.5 * doubled.sum::<f32>()
}

#[test]
fn an_alpha_mask_cuts_its_material_out_of_the_mesh() {
    use crate::image::pixels::{Depth, Pixels};
    // Two pixels side by side, the left one clear.
    let pixels = Pixels {
        width: 2,
        height: 1,
        depth: Depth::Eight,
        channels: 4,
        values: vec![255, 0, 0, 0, 0, 255, 0, 255],
    };
    let png = portable_network::encoded_pixels(&pixels).expect("two pixels");
    let model = |mode: &str, factor: f32, cutoff: Option<f32>| {
        let mut made = Made::empty();
        let texture = made.texture(33071);
        let view = made.view(&png);
        made.json["images"][0]["bufferView"] = json!(view);
        let paint = made.paint([1.0, 1.0, 1.0, factor], Some(json!({ "index": texture })));
        made.json["materials"][paint]["alphaMode"] = json!(mode);
        if let Some(cutoff) = cutoff {
            made.json["materials"][paint]["alphaCutoff"] = json!(cutoff);
        }
        made.square(0.0, Some(paint));
        made.model()
    };
    let whole = model("OPAQUE", 1.0, None).expect("a good model");
    assert_eq!((area(&whole), whole.mesh.triangles().len()), (1.0, 2));
    // Between the middles of the pixels, at 1/4 and 3/4, alpha is linear.
    let half = model("MASK", 1.0, None).expect("a good model");
    assert!((area(&half) - 0.5).abs() < 1e-5, "{}", area(&half));
    let least = |a: Vec3, b: Vec3| a.min(b);
    let left = half.mesh.positions().iter().skip(4).copied().reduce(least);
    assert!(
        left.expect("it has corners").x.abs() < 1e-6,
        "the right half is left"
    );
    assert!(
        half.mesh
            .normals()
            .expect("it has them")
            .iter()
            .all(|normal| *normal == -Vec3::Y)
    );
    let later = model("MASK", 1.0, Some(0.75)).expect("a good model");
    assert!((area(&later) - 0.375).abs() < 1e-5, "{}", area(&later));
    let faint = model("MASK", 0.4, None)
        .map(|_| ())
        .expect_err("nothing is left");
    assert!(faint.to_string().contains("alpha masks"), "{faint}");
}

/// What light meets at a place of the file's xy plane, seen from a direction of the scene.
fn met<T>(
    (mesh, material): (&TriangleMesh, &Material),
    [x, y]: [f32; 2],
    from: Vec3,
    look: impl FnOnce(Encounter<'_, 4>) -> T,
) -> T {
    let place = Instance::new(0, &DAffine3::IDENTITY);
    let geometry = Geometry::build(vec![mesh.clone()], vec![place]).expect("a square");
    let ray = Ray::new(Vec3::new(x, 0.0, y) + from, -from);
    let hit = geometry.intersect(&ray).expect("it is there");
    let beam = (&ray, &Cone::of_pixel([1e-3; 2]));
    look(Encounter::new(
        &geometry,
        material,
        beam,
        &hit,
        &wavelengths(),
    ))
}

/// The spectrum of a colour.
fn spectrum(colour: [f32; 3]) -> Lanes<4> {
    let primaries = Primaries::new(Curve::Constant(1.0));
    primaries.spectrum(colour, &wavelengths())
}

#[test]
fn colours_of_vertices_are_linear_over_each_triangle_and_factors_on_a_picture() {
    let corners = [
        [1.0, 0.0, 0.0, 1.0],
        [0.0, 1.0, 0.0, 1.0],
        [0.0, 0.0, 1.0, 1.0],
        [1.0; 4],
    ];
    for has_picture in [false, true] {
        let mut made = Made::empty();
        let picture = has_picture.then(|| json!({ "index": made.texture(33071) }));
        let paint = made.paint([0.5, 1.0, 1.0, 1.0], picture);
        made.square(0.0, Some(paint));
        let colours = made.floats(&corners);
        made.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = json!(colours);
        let model = made.model().expect("a good model");
        assert_eq!(model.left_out, Vec::<String>::new());
        let map = model.colours.clone().expect("they were asked for");
        let paint = Material::Diffuse(Reflectance::Picture(Box::new(map)));
        for (place, colour) in [
            // 0.2 of the first, 0.3 of the second, 0.5 of the third corner.
            ([0.3, 0.0], [0.2, 0.3, 0.5]),
            // 0.25 of the first, 0.5 of the third, 0.25 of the fourth.
            ([0.0, 0.25], [0.5, 0.25, 0.75]),
        ] {
            let [x, _] = place;
            // The picture is black at u = 1/4 and white at 3/4.
            let [r, g, b] = colour.map(|of: f32| {
                let shade: f32 = if has_picture { 2.0 * x + 0.5 } else { 1.0 };
                of * shade.clamp(0.0, 1.0)
            });
            let found = met((&model.mesh, &paint), place, -Vec3::Y, |met| {
                met.bsdf.albedo(met.wo)
            });
            let expected = spectrum([0.5 * r, g, b]);
            for (found, expected) in found.0.into_iter().zip(expected.0) {
                assert!((found - expected).abs() < 1e-5, "{found}, not {expected}");
            }
        }
    }
}

/// The surface of a model with all that its materials say.
fn whole(made: &Made) -> (TriangleMesh, Material, Vec<String>) {
    let glb = made.glb();
    let container = Container::open(&glb).expect("good JSON");
    let model = read(&container, &|_| None, 1.0, Wanted::ALL).expect("a good model");
    let colours = model.colours.expect("they were asked for");
    let finishes = model.finishes.expect("they were asked for").into();
    let material = Material::Model(Box::new(ModelMaterial::new(colours, finishes)));
    (model.mesh, material, model.left_out)
}

#[test]
fn roughness_and_metal_are_factors_times_channels_of_a_picture() {
    let mut made = Made::empty();
    // Left: roughness 0.6, metal 0.2; right: roughness 0.2, metal 1. Red is of another use.
    let png = portable_network::encoded(2, 1, &[255, 153, 51, 0, 51, 255]).expect("two pixels");
    let texture = made.texture(33071);
    let view = made.view(&png);
    made.json["images"][0]["bufferView"] = json!(view);
    let paint = made.paint([0.5, 0.5, 0.5, 1.0], None);
    let of = &mut made.json["materials"][paint]["pbrMetallicRoughness"];
    of["metallicRoughnessTexture"] = json!({ "index": texture });
    of["roughnessFactor"] = json!(0.5);
    of["metallicFactor"] = json!(0.75);
    made.square(0.0, Some(paint));
    // One more without a picture, beside it.
    let plain = made.paint([0.2, 0.2, 0.2, 1.0], None);
    made.json["materials"][plain]["pbrMetallicRoughness"]["roughnessFactor"] = json!(0.9);
    made.square(-1.0, Some(plain));
    made.json["nodes"] = json!([{ "mesh": 0 }]);
    let (mesh, material, left_out) = whole(&made);
    assert_eq!(left_out, Vec::<String>::new());
    for (place, from, roughness, metallic) in [
        ([-0.3, 0.1], -Vec3::Y, 0.3, 0.15),
        ([0.3, 0.1], -Vec3::Y, 0.1, 0.75),
        // From behind, where the other one is.
        ([0.3, 0.1], 2.0 * Vec3::Y, 0.9, 0.0),
    ] {
        met((&mesh, &material), place, from, |met| {
            let Bsdf::Metallic(surface) = &met.bsdf else {
                panic!("{:?}", met.bsdf);
            };
            let alpha: f32 = (roughness * roughness) as f32;
            assert!(
                (surface.coat.ggx.alpha_x - alpha.max(0.02)).abs() < 1e-5,
                "{place:?}"
            );
            assert!((surface.metallic - metallic).abs() < 1e-5, "{place:?}");
        });
    }
}

#[test]
fn a_map_of_normals_turns_them_along_u_and_v_on_mirrored_parts_too() {
    // 0.6 along u, 0 along v, 0.8 away from the surface.
    let png = portable_network::encoded(1, 1, &[204, 128, 230]).expect("one pixel");
    for (mirrored, scale) in [(false, 1.0), (true, 1.0), (false, 0.5)] {
        let mut made = Made::empty();
        let texture = made.texture(33071);
        let view = made.view(&png);
        made.json["images"][0]["bufferView"] = json!(view);
        let paint = made.paint([0.5; 4], None);
        made.json["materials"][paint]["normalTexture"] =
            json!({ "index": texture, "scale": scale });
        made.square(0.0, Some(paint));
        if mirrored {
            let corners = [[0.5, -0.5], [-0.5, -0.5], [-0.5, 0.5], [0.5, 0.5]];
            let uvs = made.floats(&corners.map(|[x, y]| [x + 0.5, 0.5 - y]));
            made.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = json!(uvs);
        }
        let (mesh, material, left_out) = whole(&made);
        assert_eq!(left_out, Vec::<String>::new());
        let along_u = if mirrored { -Vec3::X } else { Vec3::X };
        let expected = (0.6 * scale * along_u - 0.8 * Vec3::Y).normalize();
        for side in [1.0, -1.0] {
            let found = met((&mesh, &material), [0.1, 0.2], -Vec3::Y * side, |met| {
                met.frame.to_world(met.bsdf.normal(met.wo))
            });
            // A channel has 256 steps.
            assert!(
                (found - side * expected).length() < 0.01,
                "{found} {expected}"
            );
        }
    }
}

#[test]
fn emitted_light_is_a_factor_times_a_strength_times_a_picture() {
    let mut made = Made::empty();
    let texture = made.texture(33071);
    let paint = made.paint([1.0; 4], None);
    let of = &mut made.json["materials"][paint];
    of["emissiveFactor"] = json!([1.0, 0.5, 0.0]);
    of["emissiveTexture"] = json!({ "index": texture });
    of["extensions"] = json!({ "KHR_materials_emissive_strength": { "emissiveStrength": 3 } });
    made.square(0.0, Some(paint));
    made.square(1.0, None);
    made.json["extensionsUsed"] = json!(["KHR_materials_emissive_strength"]);
    let read = |made: &Made| {
        let glb = made.glb();
        let container = Container::open(&glb).expect("good JSON");
        read(&container, &|_| None, 1.0, Wanted::ALL)
    };
    let model = read(&made).expect("a good model");
    assert_eq!(model.left_out, Vec::<String>::new());
    let map = model.emission.as_ref().expect("it was asked for");
    let uvs = model.mesh.uvs().expect("it has them");
    // Half way between the middles of black and white; the other square has no material.
    assert_eq!(map.colour(uvs[0].lerp(uvs[2], 0.5)), [1.5, 0.75, 0.0]);
    assert_eq!(map.colour(uvs[4].lerp(uvs[6], 0.5)), [0.0; 3]);
    assert_eq!(map.greatest(), [3.0, 1.5, 0.0]);
    made.json["materials"][paint]["doubleSided"] = json!(true);
    let left_out = read(&made).expect("a good model").left_out;
    assert_eq!(
        left_out,
        ["light that backs of faces emit (lamps shine from the front)"]
    );
    let of = &mut made.json["materials"][paint]["extensions"];
    of["KHR_materials_emissive_strength"]["emissiveStrength"] = json!(-1);
    let error = read(&made).map(|_| ()).expect_err("light is not negative");
    assert!(
        error
            .to_string()
            .contains("emissiveStrength: is -1; allowed is 0 to"),
        "{error}"
    );
}

#[test]
fn a_map_of_normals_follows_the_tangents_of_the_file_as_nodes_turn_and_mirror_them() {
    // 0.6 along x of the map, 0.48 along y, 0.64 away from the surface.
    let png = portable_network::encoded(1, 1, &[204, 189, 209]).expect("one pixel");
    let half = std::f32::consts::FRAC_1_SQRT_2;
    for (sign, node, tangent) in [
        (1.0, json!({ "mesh": 0 }), Vec3::Z),
        (-1.0, json!({ "mesh": 0 }), Vec3::Z),
        // The tangent, up in the file, is turned about its z axis, which is −y of the scene.
        (
            1.0,
            json!({ "mesh": 0, "rotation": [0, 0, half, half] }),
            -Vec3::X,
        ),
        (1.0, json!({ "mesh": 0, "scale": [-1, 1, 1] }), Vec3::Z),
    ] {
        let mut made = Made::empty();
        let texture = made.texture(33071);
        let view = made.view(&png);
        made.json["images"][0]["bufferView"] = json!(view);
        let paint = made.paint([0.5; 4], None);
        made.json["materials"][paint]["normalTexture"] = json!({ "index": texture });
        let mirrors = node["scale"][0] == json!(-1);
        made.json["nodes"] = json!([node]);
        made.square(0.0, Some(paint));
        let tangents = made.floats(&[[0.0, 1.0, 0.0, sign]; 4]);
        made.json["meshes"][0]["primitives"][0]["attributes"]["TANGENT"] = json!(tangents);
        let (mesh, material, left_out) = whole(&made);
        assert_eq!(left_out, Vec::<String>::new());
        let normal = -Vec3::Y;
        let sign = if mirrors { -sign } else { sign };
        let bitangent = sign * normal.cross(tangent);
        let expected = 0.6 * tangent + 0.48 * bitangent + 0.64 * normal;
        let found = met((&mesh, &material), [0.1, 0.2], normal, |met| {
            met.frame.to_world(met.bsdf.normal(met.wo))
        });
        assert!((found - expected).length() < 0.01, "{found} {expected}");
        // Twice as large, turned about z, and mirrored in x after that, alone and among others.
        let turn = DMat3::from_rotation_z(0.5 * std::f64::consts::PI);
        let placed = DMat3::from_diagonal(DVec3::new(-2.0, 2.0, 2.0)) * turn;
        for count in [1, 2] {
            let place = Instance::new(0, &DAffine3::from_mat3(placed));
            let places = vec![place; count];
            let geometry = Geometry::build(vec![mesh.clone()], places).expect("squares");
            let ray = Ray::new(Vec3::new(-1.0, 0.2, 0.4), Vec3::X);
            let hit = geometry.intersect(&ray).expect("it is there");
            let (found, found_sign) = geometry.tangent(&hit).expect("it has them");
            let tangent = placed.as_mat3() * tangent;
            assert!(
                found.normalize().dot(tangent.normalize()) > 0.999,
                "{found} {tangent}"
            );
            assert_eq!(found_sign, -sign);
        }
    }
}

#[test]
fn a_map_with_other_texture_coordinates_than_the_first_is_left_out_by_name() {
    let mut made = Made::empty();
    let texture = made.texture(33071);
    let paint = made.paint([1.0; 4], Some(json!({ "index": texture })));
    let transform = json!({ "KHR_texture_transform": { "scale": [2, 2] } });
    made.json["materials"][paint]["normalTexture"] =
        json!({ "index": texture, "extensions": transform });
    made.square(0.0, Some(paint));
    let (_, material, left_out) = whole(&made);
    assert!(!material.has_normals());
    let what =
        "maps of normals with other texture coordinates than the first map of their material";
    assert_eq!(left_out, [what]);
}

#[test]
fn damaged_models_are_refused_with_the_place() {
    let mut cases: Vec<(Made, &str)> = Vec::new();
    let mut case = |change: &dyn Fn(&mut Value), message: &'static str| {
        let mut made = square();
        change(&mut made.json);
        cases.push((made, message));
    };
    case(
        &|json| json["asset"]["version"] = json!("1.0"),
        "only version 2",
    );
    case(
        &|json| json["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]),
        "requires the extension \"KHR_draco_mesh_compression\"",
    );
    case(
        &|json| json["nodes"][0]["mesh"] = json!(7),
        "nodes[0].mesh: names what is not there",
    );
    case(
        &|json| json["nodes"] = json!([{ "mesh": 0, "children": [0] }]),
        "nodes[0]: has two parents, or is its own",
    );
    case(
        &|json| json["nodes"][0]["rotation"] = json!([0, 0, 0, 0]),
        "nodes[0]: its transform is not finite",
    );
    case(
        &|json| json["meshes"][0]["primitives"][0]["attributes"] = json!({ "NORMAL": 1 }),
        "meshes[0].primitives[0]: has no POSITION",
    );
    case(
        &|json| json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = json!(99),
        "POSITION is accessor 99, but there are 4",
    );
    case(
        &|json| json["accessors"][0]["count"] = json!(3),
        "accessors[0]: vertex 3 is used, but there are 3",
    );
    case(
        &|json| json["accessors"][0]["count"] = json!(u64::MAX),
        "accessors[0]: claims 18446744073709551615 elements",
    );
    case(
        &|json| json["bufferViews"][0]["byteLength"] = json!(u64::MAX),
        "bufferViews[0]: shows bytes 0 to",
    );
    case(
        &|json| json["accessors"][0]["type"] = json!("VEC2"),
        "accessors[0]: has not the 3 numbers",
    );
    case(
        &|json| json["accessors"][3]["componentType"] = json!(5126),
        "accessors[3]: claims 6 elements",
    );
    case(
        &|json| json["meshes"][0]["primitives"][0]["mode"] = json!(0),
        "its scene has no triangles, only lines and points",
    );
    case(
        &|json| json["nodes"] = json!([{}]),
        "its scene has no triangles",
    );
    for (made, message) in cases {
        let text = made.refused();
        assert!(text.contains(message), "{text} has not: {message}");
    }
    // Positions that are not numbers.
    let mut made = square();
    made.bytes[..4].copy_from_slice(&f32::NAN.to_le_bytes());
    assert!(made.refused().contains("not finite"), "{}", made.refused());
    // Colours beyond white, and a picture of no known kind.
    let mut made = Made::empty();
    let paint = made.paint([2.0, 0.0, 0.0, 1.0], None);
    made.square(0.0, Some(paint));
    assert!(made.refused().contains("baseColorFactor: is [2, 0, 0]"));
    let mut made = Made::empty();
    let texture = made.texture(10497);
    let start = made.json["bufferViews"][0]["byteOffset"].as_u64();
    made.bytes[start.expect("a number") as usize] = b'?';
    let paint = made.paint([1.0; 4], Some(json!({ "index": texture })));
    made.square(0.0, Some(paint));
    assert!(made.refused().contains("images[0]: not a picture"));
}

#[test]
fn a_file_that_is_cut_short_is_refused_at_any_length() {
    let whole = square().glb();
    assert!(opened(&whole).is_ok());
    for length in 0..whole.len() {
        assert!(opened(&whole[..length]).is_err(), "{length} bytes");
    }
    let text = square().text();
    for length in 0..text.len() {
        assert!(opened(&text[..length]).is_err(), "{length} bytes");
    }
}
