use std::collections::BTreeMap;

use glam::DMat4;

use super::shapes::MeshFile;
use super::*;
use crate::scene::load;
use leafmodel::optics::Texel;

const SCENE: &str = r#"
format = 1
[film.spectral]
size = [8, 4]
spp = 1
bands_nm = [450, 550]
[camera.perspective]
position_m = [0, 0, 0.5]
look_at_m = [0, 0, 0]
up = [0, 1, 0]
vertical_fov_deg = 20
[materials.mapped.leaf.map]
file = "map.exr"
[materials.plain.leaf.measured]
reflectance = 0.4
transmittance = 0.5
[meshes.blade.rectangle]
width_m = 0.05
height_m = 0.1
[objects.left]
mesh = "blade"
material = "mapped"
position_m = [-0.1, 0, 0]
[objects.right]
mesh = "blade"
material = "plain"
position_m = [0.1, 0, 0]
[lights.sun.distant]
irradiance_w_m2_nm = { blackbody_k = 5800, scale = 1.5 }
towards = [0, 0, 1]
"#;

/// A contents map of 2 × 3 texels, each of its numbers different.
fn map() -> ContentsTexture {
    let texel = |i: u16| Texel::from_fn(|channel| 1.0 + f32::from(i) + channel as u8 as f32 / 8.0);
    ContentsTexture::new(2, 3, (0..6).map(texel).collect())
}

fn scene(folder: &Path) -> (Description, World) {
    scene_with("", folder)
}

/// The scene with more blocks.
fn scene_with(blocks: &str, folder: &Path) -> (Description, World) {
    openexr::write(&map_picture(&map()), &folder.join("map.exr")).expect("a map");
    let text = SCENE.to_owned() + blocks;
    let scene = load::parse(&text, "scene.toml", folder, &[])
        .unwrap_or_else(|errors| panic!("{errors}"))
        .description;
    let world = World::build(&scene).expect("a scene that can be built");
    (scene, world)
}

#[test]
fn an_export_holds_all_that_its_xml_names() {
    let folder = tempfile::tempdir().expect("a folder");
    let (scene, world) = scene(folder.path());
    let out = folder.path().join("out");
    write(&scene, &world, &out).expect("it is written");
    let xml = fs::read_to_string(out.join("scene.xml")).expect("scene.xml");
    let mut files = 0;
    for word in xml.split('"') {
        let ending = Path::new(word)
            .extension()
            .and_then(|ending| ending.to_str());
        if ending.is_some_and(|ending| ["ply", "exr", "spd", "csv"].contains(&ending)) {
            assert!(out.join(word).is_file(), "{word} is missing");
            files += 1;
        }
    }
    assert_eq!(
        files, 5,
        "a mesh for each of two materials, a map, the sun's spectrum, PROSPECT's table: {xml}"
    );
    assert!(out.join("lamina.json").is_file());
}

#[test]
fn each_palette_has_a_table_which_its_leaves_name() {
    const PALETTES: &str = r#"
[materials.mapped.leaf.pigments.chlorophyll]
a_to_b = 8
[materials.red.leaf.contents]
structure = 1.5
chlorophyll_ug_per_cm2 = 1
carotenoids_ug_per_cm2 = 5
anthocyanins_ug_per_cm2 = 20
water_cm = 0.01
dry_matter_g_per_cm2 = 0.006
[materials.red.leaf.pigments.anthocyanins]
shift_nm = 15
[materials.same.leaf.map]
file = "map.exr"
[materials.same.leaf.pigments.chlorophyll]
a_to_b = 8
"#;
    let folder = tempfile::tempdir().expect("a folder");
    let (scene, world) = scene_with(PALETTES, folder.path());
    let out = folder.path().join("out");
    write(&scene, &world, &out).expect("it is written");
    let xml = fs::read_to_string(out.join("scene.xml")).expect("scene.xml");
    assert_eq!(xml.matches("value=\"pigments-1.csv\"").count(), 2);
    assert_eq!(xml.matches("value=\"pigments-2.csv\"").count(), 1);
    assert!(!out.join("pigments-3.csv").exists());
    let row = |file: &str, nm: &str| -> Vec<f64> {
        let text = fs::read_to_string(out.join(file)).expect("a table");
        let line = text.lines().find(|line| line.starts_with(nm)).expect(nm);
        let figures = line.split(',').skip(1);
        figures
            .map(|figure| figure.parse().expect("a number"))
            .collect()
    };
    let (own, shifted) = (row("prospect_d.csv", "600,"), row("pigments-2.csv", "600,"));
    let differ: Vec<usize> = (0..own.len()).filter(|i| own[*i] != shifted[*i]).collect();
    assert_eq!(differ, [3], "anthocyanins alone: {own:?} and {shifted:?}");
    assert!(shifted[3] > own[3], "moved towards the red");
}

#[test]
fn a_map_is_exported_as_it_is() {
    let folder = tempfile::tempdir().expect("a folder");
    let (scene, world) = scene(folder.path());
    let out = folder.path().join("out");
    write(&scene, &world, &out).expect("it is written");
    let back = crate::scene::assets::contents_map(&out.join("maps/material-mapped.exr"))
        .expect("a contents map");
    assert_eq!(back.size(), map().size());
    assert_eq!(back.texels(), map().texels());
}

#[test]
fn every_part_of_a_compound_leaf_is_a_shape_and_mirrored_ones_are_mirrored_in_their_files() {
    const LEAF: &str = r#"
[leaves.trefoil]
length_mm = 20
map_size = 16
[leaves.trefoil.outline.cubic]
[leaves.trefoil.venation.arcuate]
[leaves.trefoil.contents]
structure = 1.5
chlorophyll_ug_per_cm2 = 40
carotenoids_ug_per_cm2 = 9
water_cm = 0.01
dry_matter_g_per_cm2 = 0.006
[leaves.trefoil.compound.palmate]
leaflets = 3
spread_deg = 240
petiolule = 1
petiole = 1
variants = 2
[objects.clover]
leaf = "trefoil"
position_m = [0, 0, 0.1]
"#;
    let folder = tempfile::tempdir().expect("a folder");
    let (scene, world) = scene_with(LEAF, folder.path());
    // Two rectangles; three blades with a stalk each, and the petiole.
    assert_eq!(world.objects.len(), 2 + 7);
    let out = folder.path().join("out");
    write(&scene, &world, &out).expect("it is written");
    let xml = fs::read_to_string(out.join("scene.xml")).expect("scene.xml");
    assert_eq!(xml.matches("<shape type=\"ply\"").count(), 9);
    // Two blades' materials and that of the stalks; each shape refers to one.
    assert_eq!(
        xml.matches("<bsdf type=\"lamina_leaf\" id=\"leaf-trefoil")
            .count(),
        3
    );
    assert_eq!(xml.matches("<ref id=\"leaf-trefoil").count(), 7);
    for word in xml
        .split('"')
        .filter(|word| word.starts_with("meshes/") || word.starts_with("maps/"))
    {
        assert!(out.join(word).is_file(), "{word} is missing");
    }
    let mut of_both_kinds = [0, 0];
    for number in 0..world.objects.len() {
        let instance = world.geometry.instance(number as u32);
        let file = MeshFile {
            mesh: instance.mesh as usize,
            mirrored: instance.linear.determinant() < 0.0,
        };
        let bytes = fs::read(out.join(file.path(&scene, &world))).expect("its mesh");
        let mesh = crate::geometry::import(&bytes, "ply", 1.0).expect("a mesh");
        let own = world.geometry.mesh(instance.mesh);
        let side = if file.mirrored { -1.0 } else { 1.0 };
        assert_eq!(mesh.positions()[0].x, side * own.positions()[0].x);
        of_both_kinds[usize::from(file.mirrored)] += 1;
    }
    assert!(
        of_both_kinds.iter().all(|count| *count > 0),
        "{of_both_kinds:?}"
    );
}

/// The 4 × 4 matrices of a text, by the id of the shape that each belongs to.
fn matrices(xml: &str) -> BTreeMap<String, DMat4> {
    let mut found = BTreeMap::new();
    let mut id = "";
    for line in xml.lines() {
        let quoted: Vec<&str> = line.split('"').collect();
        if line.starts_with("<shape") {
            // The sun's disk has none.
            id = quoted.get(3).copied().unwrap_or("");
        } else if line.trim_start().starts_with("<matrix") {
            let numbers: Vec<f64> = quoted[1]
                .split(' ')
                .map(|number| number.parse().expect("a number"))
                .collect();
            let rows: [f64; 16] = numbers.try_into().expect("sixteen numbers");
            found.insert(id.to_owned(), DMat4::from_cols_array(&rows).transpose());
        }
    }
    found
}

#[test]
fn what_is_in_several_places_is_written_once_and_its_parts_lie_where_they_are_traced() {
    const LEAF: &str = r#"
[leaves.trefoil]
length_mm = 20
map_size = 16
[leaves.trefoil.outline.cubic]
[leaves.trefoil.venation.arcuate]
[leaves.trefoil.contents]
structure = 1.5
chlorophyll_ug_per_cm2 = 40
carotenoids_ug_per_cm2 = 9
water_cm = 0.01
dry_matter_g_per_cm2 = 0.006
[leaves.trefoil.compound.palmate]
leaflets = 3
spread_deg = 240
petiolule = 1
petiole = 1
variants = 2
[objects.clovers]
leaf = "trefoil"
instances.file = "places.csv"
rotate_deg = [0, 0, 30]
[objects.mirrored]
leaf = "trefoil"
matrix = [-1, 0, 0, 0.05,  0, 1, 0, 0,  0, 0, 1, 0.1,  0, 0, 0, 1]
[objects.panel]
mesh = "blade"
material = "plain"
position_m = [0, 0.3, 0]
[lights.panel.area]
object = "panel"
radiance_w_m2_sr_nm = 1
"#;
    let folder = tempfile::tempdir().expect("a folder");
    let places = "x_m y_m z_m rotate_x_deg scale_x scale_y scale_z\n\
                  0 0 0.1 0 1 1 1\n0.1 0 0 40 1 2 1\n0 0.1 0 0 1 1 0.5\n";
    fs::write(folder.path().join("places.csv"), places).expect("a file");
    let (scene, world) = scene_with(LEAF, folder.path());
    // Two rectangles and the panel; four leaves of three blades with a stalk each, and the petiole.
    assert_eq!(world.objects.len(), 3 + 4 * 7);
    let out = folder.path().join("out");
    write(&scene, &world, &out).expect("it is written");
    let xml = fs::read_to_string(out.join("scene.xml")).expect("scene.xml");
    assert_eq!(xml.matches("type=\"shapegroup\"").count(), 1, "{xml}");
    assert_eq!(xml.matches("type=\"instance\"").count(), 3);
    // The mirror image is another shape, used once; the panel emits light, so it is written
    // separately.
    assert_eq!(xml.matches("<shape type=\"ply\"").count(), 3 + 7 + 7);
    let group = xml.find("<shape type=\"shapegroup\"").expect("a group");
    let emitter = xml.find("<emitter type=\"area\">").expect("a light");
    let groups_end = group + xml[group..].find("</shape>\n</shape>").expect("its end");
    assert!(!(group..groups_end).contains(&emitter), "{xml}");
    // Every vertex of the world, through the files and matrices of the export and as it is traced.
    let matrices = matrices(&xml);
    assert!(matrices.values().all(|matrix| matrix.determinant() > 0.0));
    let same = |id: &str, to_world: DMat4, instance: usize| {
        let mut shapes = xml.split("<shape ");
        let shape = shapes.find(|shape| shape.contains(&format!("id=\"{id}\"")));
        let name = shape
            .expect(id)
            .split('"')
            .find(|word| word.starts_with("meshes/"));
        let bytes = fs::read(out.join(name.expect("its file"))).expect("its mesh");
        let exported = crate::geometry::import(&bytes, "ply", 1.0).expect("a mesh");
        let instance = world.geometry.instance(instance as u32);
        let traced = world.geometry.mesh(instance.mesh);
        let to_scene = instance.to_scene();
        for (theirs, ours) in exported.positions().iter().zip(traced.positions()) {
            let theirs = to_world.transform_point3(theirs.as_dvec3());
            let ours = 1000.0 * to_scene.transform_point3(ours.as_dvec3());
            // Millimetres; coordinates reach 300 of them.
            assert!(theirs.distance(ours) < 2e-4, "{id}: {theirs} is not {ours}");
        }
    };
    let alone = ["left", "right", "mirrored", "panel"].map(|name| format!("object-{name}"));
    let parts = (2..=7).map(|part| format!("object-mirrored.part-{part}"));
    let alone: Vec<String> = alone.into_iter().chain(parts).collect();
    for (instance, id) in alone.iter().enumerate() {
        same(id, matrices[id], instance);
    }
    for place in 0..3 {
        for part in 0..7 {
            let id = format!("group-leaf-trefoil.part-{}", part + 1);
            let to_world = matrices[&format!("object-clovers.{}", place + 1)] * matrices[&id];
            same(&id, to_world, alone.len() + 7 * place + part);
        }
    }
}

#[test]
fn bodies_and_solid_materials_become_plugins_with_their_maps() {
    const BODY: &str = r#"
[solids.plum]
map_size = 64
depth_mm = 0.5
coat = { eta = 1.33, alpha = 0.1 }
[solids.plum.shape.sphere]
radius_mm = 20
[solids.plum.contents]
anthocyanins_ug_per_cm2 = 20
[solids.plum.mosaic]
cells = 50
days = 0
[solids.plum.mosaic.types.one]
initial_share = 1
[materials.flesh.solid.contents]
carotenoids_ug_per_cm2 = 5
[objects.plum]
solid = "plum"
[objects.slab]
mesh = "blade"
material = "flesh"
position_m = [0, 0, 0.1]
"#;
    let folder = tempfile::tempdir().expect("a folder");
    let (scene, world) = scene_with(BODY, folder.path());
    let out = folder.path().join("out");
    write(&scene, &world, &out).expect("it is written");
    let xml = fs::read_to_string(out.join("scene.xml")).expect("scene.xml");
    for id in ["solid-plum", "material-flesh"] {
        let bsdf = format!("<bsdf type=\"lamina_solid\" id=\"{id}\">");
        assert_eq!(xml.matches(&bsdf).count(), 1, "{xml}");
        assert_eq!(xml.matches(&format!("<ref id=\"{id}\"/>")).count(), 1);
    }
    let numbers = [("depth_mm", 0.5), ("coat_eta", 1.33), ("coat_alpha", 0.1)];
    for (name, value) in numbers {
        assert!(xml.contains(&format!("name=\"{name}\" value=\"{value}\"")));
    }
    let map = crate::scene::assets::contents_map(&out.join("maps/solid-plum.exr"));
    assert_eq!(map.expect("a contents map").size(), (64, 64));
    assert!(out.join("meshes/solid-plum.ply").is_file());
}

#[test]
fn models_are_exported_with_what_their_materials_say_and_without_tangents() {
    const BLOCKS: &str = "
[meshes.pot.gltf]
path = \"pot.gltf\"
[materials.pot.gltf]
mesh = \"pot\"
[objects.pot]
mesh = \"pot\"
material = \"pot\"
position_m = [0, 0, 0.1]
[lights.pot.area]
object = \"pot\"
radiance_w_m2_sr_nm = 1
emission = true
";
    // Three corners, then a tangent for each.
    const BYTES: &str = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAACAPwAAAAAAAAAAAACAPwAAgD8AAAAAAAAAAAAAgD8AAIA/AAAAAAAAAAAAAIA/";
    // One pixel.
    const PNG: &str = "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGNoaPgPAAODAgAApfuJAAAAAElFTkSuQmCC";
    let model = |attributes: &str, material: &str| {
        format!(
            r#"{{"asset":{{"version":"2.0"}},"nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{{"attributes":
            {{"POSITION":0{attributes}}},"material":0}}]}}],"accessors":[
            {{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}},
            {{"bufferView":0,"byteOffset":36,"componentType":5126,"count":3,"type":"VEC4"}},
            {{"bufferView":0,"componentType":5126,"count":3,"type":"VEC2"}}],
            "bufferViews":[{{"buffer":0,"byteLength":84}}],
            "buffers":[{{"byteLength":84,"uri":"data:;base64,{BYTES}"}}],"textures":[{{"source":0}}],
            "images":[{{"uri":"data:image/png;base64,{PNG}"}}],"materials":[{{"emissiveFactor":[1,0.5,0],
            "pbrMetallicRoughness":{{"roughnessFactor":0.5,"metallicFactor":0.25}}{material}}}]}}"#
        )
    };
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("pot.gltf");
    fs::write(&file, model("", "")).expect("a folder");
    let (scene, world) = scene_with(BLOCKS, folder.path());
    let out = folder.path().join("out");
    write(&scene, &world, &out).expect("it is written");
    let xml = fs::read_to_string(out.join("scene.xml")).expect("scene.xml");
    for part in [
        "<bsdf type=\"lamina_model\" id=\"material-pot\">",
        // Nothing is 0 of 1: base colour, roughness and metal, the surface's own normal, and light.
        "name=\"slot_0\" value=\"-3.4028235e38 0e0 1e0 1e0 1e0\"/>",
        "name=\"slot_0\" value=\"-3.4028235e38 0e0 1e0 5e-1 2.5e-1\"/>",
        "name=\"slot_0\" value=\"-3.4028235e38 0e0 5e-1 5e-1 1e0\"/>",
        "<float name=\"normal_scale_0\" value=\"1\"/>",
        "<texture type=\"lamina_colours\" name=\"colours\">",
        "name=\"slot_0\" value=\"-3.4028235e38 0e0 1e0 5e-1 0e0\"/>",
    ] {
        assert!(xml.contains(part), "{part} is not in {xml}");
    }
    let tangents = (
        ",\"TANGENT\":1,\"TEXCOORD_0\":2",
        ",\"normalTexture\":{\"index\":0}",
    );
    fs::write(&file, model(tangents.0, tangents.1)).expect("a folder");
    let (scene, world) = scene_with(BLOCKS, folder.path());
    let error = write(&scene, &world, &out).expect_err("it has tangents");
    assert!(
        error
            .to_string()
            .contains("the object `pot` has a map of normals with tangents")
    );
}

#[test]
fn an_earlier_export_is_replaced_and_another_folder_is_left_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let (scene, world) = scene(folder.path());
    let out = folder.path().join("out");
    write(&scene, &world, &out).expect("it is written");
    fs::write(out.join("stale"), "").expect("a file");
    write(&scene, &world, &out).expect("it is written again");
    assert!(
        !out.join("stale").exists(),
        "the folder is the new export alone"
    );

    let other = folder.path().join("photographs");
    fs::create_dir(&other).expect("a folder");
    fs::write(other.join("leaf.jpg"), "dear").expect("a file");
    let refused = write(&scene, &world, &other);
    assert!(
        matches!(refused, Err(ExportError::NotOurs(_))),
        "{refused:?}"
    );
    assert_eq!(
        fs::read(other.join("leaf.jpg")).expect("still there"),
        b"dear"
    );
}

#[test]
fn what_is_strewn_is_exported_where_it_is_traced() {
    let folder = tempfile::tempdir().expect("a folder");
    let blocks = r#"
[meshes.crumb.lump]
radius_m = 0.001
[objects.crumbs]
mesh = "crumb"
material = "plain"
scatter = { on = "left", count = 25, settle = true }
"#;
    let (scene, world) = scene_with(blocks, folder.path());
    let out = folder.path().join("out");
    write(&scene, &world, &out).expect("an export");
    let xml = fs::read_to_string(out.join("scene.xml")).expect("a scene");
    assert_eq!(xml.matches("type=\"instance\"").count(), 25, "{xml}");
    for (number, (_, place)) in world.strewn[&2].iter().enumerate() {
        let id = format!("object-crumbs.{}", number + 1);
        let at = xml.find(&format!("id=\"{id}\"")).expect("an instance");
        let matrix = &xml[at..][..600];
        let x = place.w_axis.x * plugin::UNITS_PER_METRE;
        let numbers = matrix.split(|c: char| !"-.0123456789e".contains(c));
        let mut numbers = numbers.filter_map(|word| word.parse::<f64>().ok());
        assert!(
            numbers.any(|number| (number - x).abs() < 1e-5 * x.abs()),
            "{x} {matrix}"
        );
    }
}

const MILK: &str = r#"
[media.milk]
scattering_per_mm = 0.2
absorption_per_mm = { table = [[300, 0.1], [500, 0.1], [600, 0]] }
g = 0.7
[media.air]
scattering_per_m = 2
phase = "rayleigh"
[materials.milk.dielectric]
eta = 1.35
interior = "milk"
[materials.air.dielectric]
eta = 1
interior = "air"
[meshes.ball.sphere]
radius_m = 0.01
[objects.milk]
mesh = "ball"
material = "milk"
[objects.air]
mesh = "ball"
material = "air"
position_m = [0.05, 0, 0]
"#;

#[test]
fn media_are_extinction_in_inverse_millimetres_and_albedo_and_fill_their_shapes() {
    let folder = tempfile::tempdir().expect("a folder");
    let (scene, world) = scene_with(MILK, folder.path());
    let out = folder.path().join("out");
    write(&scene, &world, &out).expect("it is written");
    let xml = fs::read_to_string(out.join("scene.xml")).expect("scene.xml");
    for part in [
        "<integrator type=\"volpath\">",
        "<medium type=\"homogeneous\" id=\"medium-milk\">",
        "<ref name=\"interior\" id=\"medium-milk\"/>",
        "<ref name=\"interior\" id=\"medium-air\"/>",
        "<phase type=\"rayleigh\"/>",
        "<float name=\"g\" value=\"0.7\"/>",
        "<bsdf type=\"null\" id=\"material-air\"/>",
        "name=\"sigma_t\" value=\"300:0.002, 2600:0.002\"",
    ] {
        assert!(xml.contains(part), "{part} is missing: {xml}");
    }
    let spectra = fs::read_dir(out.join("spectra")).expect("spectra");
    let texts: Vec<String> = spectra
        .map(|file| fs::read_to_string(file.expect("a file").path()).expect("text"))
        .collect();
    // At 550 nm half of the absorption is left: 0.05 of 0.25 per mm.
    let has = |nm: &str, value: f64| {
        texts.iter().any(|text| {
            let line = text.lines().find_map(|line| line.strip_prefix(nm));
            line.is_some_and(|line| {
                let found: f64 = line.trim().parse().expect("a number");
                (found - value).abs() < 1e-6
            })
        })
    };
    assert!(has("550 ", 0.25) && has("550 ", 0.8), "{texts:?}");
}

#[test]
fn bodies_within_each_other_and_a_camera_in_a_body_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("out");
    let nested = MILK.replace("0.05, 0, 0", "0.005, 0, 0");
    let (scene, world) = scene_with(&nested, folder.path());
    let error = write(&scene, &world, &out).expect_err("they overlap");
    assert!(matches!(error, ExportError::Nested { .. }), "{error}");
    let around = MILK.replace("0.05, 0, 0", "0, 0, 0.5");
    let (scene, world) = scene_with(&around, folder.path());
    let error = write(&scene, &world, &out).expect_err("the camera is in the air");
    assert!(matches!(error, ExportError::CameraInside), "{error}");
}

#[test]
fn what_cannot_be_exported_shows_before_anything_is_grown() {
    let folder = tempfile::tempdir().expect("a folder");
    openexr::write(&map_picture(&map()), &folder.path().join("map.exr")).expect("a map");
    let checked = |overrides: &[&str]| {
        let overrides: Vec<String> = overrides.iter().map(|text| (*text).to_owned()).collect();
        let loaded = load::parse(SCENE, "scene.toml", folder.path(), &overrides);
        let scene = loaded.unwrap_or_else(|errors| panic!("{errors}"));
        check(&scene.description).map_err(|error| error.to_string())
    };
    assert_eq!(checked(&[]), Ok(()));
    for (overrides, part) in [
        (
            &[
                "camera.perspective.f_number=4",
                "camera.perspective.blades=5",
            ][..],
            "camera.perspective.blades",
        ),
        (
            &["materials.mapped.leaf.optics=\"layers\""],
            "materials.mapped.leaf.optics",
        ),
        (&["materials.mapped.leaf.fluorescence={}"], "fluoresces"),
        (&["objects.left.holdout=true"], "objects.left.holdout"),
    ] {
        let error = checked(overrides).expect_err(part);
        assert!(error.contains(part), "{error}");
    }
}

#[test]
fn smooth_objects_of_mitsubas_own_bsdfs_are_reported_as_leaking() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut blocks = "
[meshes.ball.sphere]
radius_m = 0.01
[meshes.cube.box]
size_m = [0.01, 0.01, 0.01]
[materials.paint.diffuse]
reflectance = 0.5
[materials.glass.dielectric]
eta = 1.5
[materials.air.dielectric]
eta = 1
[materials.glaze.plastic]
reflectance = 0.5
"
    .to_owned();
    for (number, (name, mesh, material)) in [
        ("painted", "ball", "paint"),
        ("flat", "cube", "paint"),
        ("clear", "ball", "glass"),
        ("absent", "ball", "air"),
        ("pot", "ball", "glaze"),
        ("leaf", "ball", "plain"),
    ]
    .into_iter()
    .enumerate()
    {
        blocks += &format!(
            "[objects.{name}]\nmesh = \"{mesh}\"\nmaterial = \"{material}\"\n\
             position_m = [0, {number}, 1]\n"
        );
    }
    let (scene, world) = scene_with(&blocks, folder.path());
    assert_eq!(leaking(&scene, &world, false), ["painted", "clear"]);
}

#[test]
fn stock_materials_need_no_plugin_and_hold_the_colours_of_both_faces() {
    let folder = tempfile::tempdir().expect("a folder");
    let (scene, _) = scene(folder.path());
    let wavelengths = crate::export::gltf::wavelengths();
    let options = crate::scene::world::BuildOptions {
        wavelengths: Some(&wavelengths),
        ..Default::default()
    };
    let world = World::build_with(&scene, &options).expect("a scene that can be built");
    let out = folder.path().join("out");
    write_stock(&scene, &world, &out).expect("it is written");
    let xml = fs::read_to_string(out.join("scene.xml")).expect("scene.xml");
    assert!(!xml.contains("lamina_"), "{xml}");
    let pictures: Vec<&str> = xml
        .split('"')
        .filter(|file| {
            Path::new(file)
                .extension()
                .is_some_and(|ending| ending == "png")
        })
        .collect();
    assert_eq!(pictures.len(), 3, "{pictures:?}");
    for picture in pictures {
        assert!(out.join(picture).is_file(), "{picture} is missing");
    }
    let after = xml.split("<float name=\"weight\" value=\"").skip(1);
    let weights = after.map(|text| text.split('"').next().expect("a value"));
    let weights: Vec<f64> = weights
        .map(|text| text.parse().expect("a number"))
        .collect();
    // The plain leaf lets half of the light through, more than it sends back.
    assert_eq!(weights.len(), 2);
    assert!(
        weights.iter().any(|weight| (weight - 0.5).abs() < 0.05),
        "{weights:?}"
    );
}
