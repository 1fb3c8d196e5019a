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
    // The first is found out once its mosaic is grown, the second at once.
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
