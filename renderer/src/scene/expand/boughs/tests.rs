use std::path::Path;

use glam::{DMat4, DVec3};
use leafmodel::blade::senescence::AgeSource;

use crate::scene::description::{Description, InstancePlace, ObjectShape, Shape};
use crate::scene::load::parse;
use crate::scene::world::World;

const SCENE: &str = r#"
format = 1
[film.rgb]
size = [4, 4]
spp = 1
[camera.perspective]
position_m = [0, -1, 0]
look_at_m = [0, 0, 0]
vertical_fov_deg = 40
[lights.sky.constant]
radiance_w_m2_sr_nm = 1
[leaves.leaf]
length_mm = 40
map_size = 16
[leaves.leaf.outline.growth_algorithm]
rate_ratio = 1.2
widest_at = 0.4
falloff = 2.5
[leaves.leaf.venation.arcuate]
[leaves.leaf.contents]
structure = 1.5
chlorophyll_ug_per_cm2 = 35
carotenoids_ug_per_cm2 = 9
water_cm = 0.008
dry_matter_g_per_cm2 = 0.005
[leaves.leaf.blade]
max_edge_mm = 4
[leaves.leaf.petiole]
length = 0.4
curl_deg = 40
[plants.shoot]
leaf = "leaf"
individuals = 3
nodes = 7
stray_deg = 5
"#;

fn scene(objects: &str, folder: &Path) -> Description {
    let loaded = parse(&format!("{SCENE}{objects}"), "scene.toml", folder, &[]);
    loaded
        .unwrap_or_else(|errors| panic!("{errors}"))
        .description
}

fn places(scene: &Description) -> &[InstancePlace] {
    let places = scene.objects[0].value.instances.as_deref();
    places.expect("a plant has instances")
}

#[test]
fn the_petiole_of_each_leaf_ends_in_the_axis_that_bears_it() {
    let scene = scene("[objects.shoot]\nplant = \"shoot\"\n", Path::new("."));
    let object = &scene.objects[0].value;
    assert_eq!((object.shapes.len(), places(&scene).len()), (4, 8));
    let ObjectShape::Mesh { mesh, .. } = object.shapes[0] else {
        panic!("the axes come first");
    };
    let Shape::Body(axes) = &scene.meshes[mesh].value else {
        panic!("the mesh is that of the axes");
    };
    let world = World::build(&scene).expect("a good scene");
    for place in &places(&scene)[1..] {
        let pieces = world.pieces.of(object.shapes[place.shape as usize]);
        // Blade, then petiole.
        let petiole = world.geometry.mesh(pieces[1].mesh as u32);
        let matrix = place.matrix();
        // The vertex farthest from the blade's base is at the foot.
        let foot = petiole.positions().iter();
        let foot = foot.max_by(|a, b| a.length().total_cmp(&b.length()));
        let foot = matrix.transform_point3(foot.expect("it has vertices").as_dvec3()) * 1e3;
        let axis = axes.positions.iter().map(|p| p.distance(foot));
        let nearest = axis.fold(f64::INFINITY, f64::min);
        assert!(nearest < 2.5, "{nearest} mm from a vertex of the axis");
    }
}

#[test]
fn a_plant_stands_in_as_many_places_as_its_object() {
    let folder = tempfile::tempdir().expect("a place for temporary files");
    let rows = "x_m,y_m,z_m\n0,0,0\n1,2,3\n";
    std::fs::write(folder.path().join("places.csv"), rows).expect("the folder is writable");
    let objects = "[objects.shoot]\nplant = \"shoot\"\nposition_m = [0, 0, 5]\n\
                   [objects.shoot.instances]\nfile = \"places.csv\"\n";
    let two = scene(objects, folder.path());
    let one = scene("[objects.shoot]\nplant = \"shoot\"\n", Path::new("."));
    let count = places(&one).len();
    assert_eq!(places(&two).len(), 2 * count);
    for (number, place) in places(&two).iter().enumerate() {
        let by = if number < count {
            DVec3::ZERO
        } else {
            DVec3::new(1.0, 2.0, 3.0)
        };
        let of_one = &places(&one)[number % count];
        assert_eq!(place.shape, of_one.shape);
        let moved = DMat4::from_translation(by + DVec3::Z * 5.0) * of_one.matrix();
        let off = (place.matrix() - moved).to_cols_array().map(f64::abs);
        assert!(off.into_iter().fold(0.0, f64::max) < 1e-6);
    }
}

#[test]
fn two_objects_of_a_plant_share_its_leaves() {
    let objects = "[objects.a]\nplant = \"shoot\"\n[objects.b]\nplant = \"shoot\"\n\
                   position_m = [1, 0, 0]\n";
    let scene = scene(objects, Path::new("."));
    assert_eq!((scene.leaves.len(), scene.meshes.len()), (3, 1));
    assert_eq!(scene.objects[0].value.shapes, scene.objects[1].value.shapes);
}

/// The days of the leaves of an object's shapes.
fn days(scene: &Description, object: usize) -> Vec<f64> {
    let shapes = scene.objects[object].value.shapes.iter();
    let leaves = shapes.filter_map(|shape| match shape {
        ObjectShape::Leaf { leaf } => Some(&scene.leaves[*leaf].value),
        ObjectShape::Mesh { .. } | ObjectShape::Solid { .. } => None,
    });
    let sources = leaves.map(|leaf| leaf.plan.senescence.expect("it ages").source);
    let days = sources.map(|source| match source {
        AgeSource::Day { day, .. } => day,
        AgeSource::Revenue { .. } => panic!("it ages by days"),
    });
    days.collect()
}

#[test]
fn individuals_of_a_plant_age_between_its_days_in_mixed_order() {
    let text = "[leaves.leaf.senescence]\ncourse = \"yellow\"\nday = 7\n\
                [plants.old]\nleaf = \"leaf\"\nindividuals = 5\nnodes = 7\ndays = [4, 20]\n\
                [objects.old]\nplant = \"old\"\n";
    let alone = scene(text, Path::new("."));
    // In the order in which they follow one another along the axis.
    assert_eq!(days(&alone, 0), [4.0, 12.0, 20.0, 8.0, 16.0]);
    assert_eq!(alone.leaves.len(), 5);
    let shown = format!("{text}[objects.flat]\nleaf = \"leaf\"\n");
    let beside = scene(&shown, Path::new("."));
    assert_eq!(days(&beside, 0), days(&alone, 0));
    assert_eq!(days(&beside, 1), [7.0]);
    assert_eq!(beside.leaves.len(), 6);
}
