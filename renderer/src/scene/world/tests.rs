use std::path::Path;

use super::World;
use crate::scene::load::parse;

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
[solids.first.shape.sphere]
radius_mm = 20
[solids.first.contents]
[solids.first.mosaic]
cells = 2000
days = 0
[solids.first.mosaic.types.one]
initial_share = 1
[solids.second.shape.sphere]
radius_mm = 20
[solids.second.contents]
[objects.first]
solid = "first"
[objects.second]
solid = "second"
"#;

#[test]
fn of_several_bodies_that_cannot_be_grown_the_first_of_the_scene_is_told() {
    let loaded = parse(SCENE, "scene.toml", Path::new("."), &[]);
    let mut scene = loaded
        .unwrap_or_else(|errors| panic!("{errors}"))
        .description;
    // The first error is found only when the mosaic is grown, the second at once.
    let pattern = scene.solids[0].value.plan.mosaic.clone();
    scene.solids[0].value.plan.map_size = 1;
    let pattern = scene.solids[1]
        .value
        .plan
        .mosaic
        .insert(pattern.expect("a mosaic"));
    pattern.contents.clear();
    let threads = rayon::ThreadPoolBuilder::new().num_threads(2).build();
    let built = threads
        .expect("two threads")
        .install(|| World::build(&scene));
    let error = built.expect_err("neither can be grown").to_string();
    assert!(error.starts_with("solids.first: map_size"), "{error}");
}

const MESHES: &str = r#"
format = 1
[film.rgb]
size = [4, 4]
spp = 1
[camera.perspective]
position_m = [0, -1, 0]
look_at_m = [0, 0, 0]
vertical_fov_deg = 40
[materials.grey.diffuse]
reflectance = 0.5
[materials.red.diffuse]
reflectance = 0.3
[meshes.floor.rectangle]
width_m = 1
height_m = 2
[meshes.ball.sphere]
radius_m = 0.1
[objects.row]
mesh = ["floor", "ball"]
material = ["grey", "red"]
position_m = [0, 0, 1]
rotate_deg = [0, 90, 0]
scale = 2
instances.file = "row.csv"
[objects.lamp]
mesh = "floor"
material = "grey"
[lights.lamp.area]
object = "lamp"
radiance_w_m2_sr_nm = 1
"#;

#[test]
fn instances_stand_where_their_object_and_their_row_say() {
    let folder = tempfile::tempdir().expect("a folder");
    let rows = "x_m y_m z_m rotate_z_deg scale shape\n0.5 0 0 90 3 ball\n0 0 0 0 1 floor\n\
                0 0.5 0 0 1 ball\n";
    std::fs::write(folder.path().join("row.csv"), rows).expect("a file");
    let loaded = parse(MESHES, "scene.toml", folder.path(), &[]);
    let scene = loaded
        .unwrap_or_else(|errors| panic!("{errors}"))
        .description;
    let world = World::build(&scene).expect("a scene that can be built");
    // The lamp stands in one place, so it comes first, and it alone shines.
    let of = |instance: usize| {
        let is = &world.objects[instance];
        let mesh = world.geometry.instance(instance as u32).mesh;
        (
            is.object,
            mesh,
            is.material,
            is.light,
            world.objects.place_of(instance as u32),
        )
    };
    assert_eq!(world.objects.len(), 4);
    assert_eq!(of(0), (1, 0, 0, Some(0), 0));
    assert_eq!(of(1), (0, 1, 1, None, 0));
    assert_eq!(of(2), (0, 0, 0, None, 1));
    assert_eq!(of(3), (0, 1, 1, None, 2));
    // (0.1, 0, 0) of the first row's ball: three times as large, turned to y, moved to x = 0.5;
    // then the object's: twice as large, x to −z, one up.
    let point = world
        .geometry
        .instance(1)
        .to_world
        .transform_point3(glam::Vec3::new(0.1, 0.0, 0.0));
    let expected = glam::Vec3::new(0.0, 0.6, 1.0 - 1.0);
    assert!(point.distance(expected) < 1e-6, "{point} is not {expected}");
}
