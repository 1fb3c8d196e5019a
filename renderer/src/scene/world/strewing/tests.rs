use std::path::Path;

use crate::scene::load::parse;
use crate::scene::world::{BuildOptions, World};

const STREWN: &str = r#"
format = 1
[film.rgb]
size = [16, 16]
spp = 1
[camera.perspective]
position_m = [2, -1, 1]
look_at_m = [2, 0, 0.5]
vertical_fov_deg = 40
[lights.sky.constant]
radiance_w_m2_sr_nm = 1
[materials.grey.diffuse]
reflectance = 0.4
[meshes.floor.rectangle]
width_m = 0.6
height_m = 0.6
[meshes.crumb.lump]
radius_m = 0.004
[meshes.card.rectangle]
width_m = 0.05
height_m = 0.08
[objects.floor]
mesh = "floor"
material = "grey"
position_m = [2, 0, 0.5]
[objects.crumbs]
mesh = "crumb"
material = "grey"
scatter = { on = "floor", count = 300, settle = true, seed = 3 }
[objects.cards]
mesh = ["card", "crumb"]
material = "grey"
rotate_deg = [0, 0, 30]
scale = 0.8
scatter = { on = "floor", over = "crumbs", per_m2 = 50, settle = true, tilt_deg = 20 }
"#;

fn strewn(overrides: &[String]) -> Result<World, String> {
    let loaded = parse(STREWN, "scene.toml", Path::new("."), overrides);
    let scene = loaded
        .unwrap_or_else(|errors| panic!("{errors}"))
        .description;
    World::build(&scene).map_err(|error| error.to_string())
}

#[test]
fn things_lie_on_the_floor_and_on_those_before_them() {
    let world = strewn(&[]).expect("there is room");
    let [crumbs, cards] = [1, 2].map(|object| &world.strewn[&object]);
    assert_eq!((crumbs.len(), cards.len()), (300, 18));
    assert_eq!(world.objects.len(), 1 + 300 + 18);
    for (_, place) in crumbs {
        let at = place.w_axis;
        assert!((1.7..=2.3).contains(&at.x) && at.y.abs() <= 0.3, "{at}");
        assert!((0.5..0.52).contains(&at.z), "{at}");
    }
    let on_crumbs = cards.iter().filter(|(_, place)| place.w_axis.z > 0.503);
    assert!(on_crumbs.count() > 2);
    for (_, place) in cards {
        let scale = place.x_axis.length();
        assert!((scale - 0.8).abs() < 1e-6, "{scale}");
    }
}

#[test]
fn what_is_strewn_lies_the_same_wherever_the_camera_is() {
    let near = strewn(&[]).expect("there is room");
    let far = ["camera.perspective.position_m=[1000,-1,1]".to_owned()];
    let far = strewn(&far).expect("there is room");
    assert_ne!(far.view.near, near.view.near);
    assert_eq!(near.strewn, far.strewn);
    for instance in 0..near.objects.len() as u32 {
        let [near_at, far_at] = [&near, &far].map(|world| *world.geometry.instance(instance));
        assert_eq!(near_at, far_at);
    }
}

#[test]
fn a_floor_that_is_full_is_reported() {
    let crowd = ["objects.crumbs.scatter.least_distance_mm=100".to_owned()];
    let error = strewn(&crowd).expect_err("there is no room");
    assert!(
        error.starts_with("objects.crumbs.scatter: there is room for ") && error.contains("of 300"),
        "{error}"
    );
}

#[test]
fn a_heap_is_reported_and_a_litter_is_not() {
    let notes = strewn(&[]).expect("there is room").notes;
    // The camera looks elsewhere.
    let mut of_objects = notes.iter().filter(|note| !note.starts_with("camera: "));
    assert_eq!(of_objects.next(), None);
    let narrow = [
        "objects.crumbs.scatter.within_m=[1.998,-0.002,2.002,0.002]".to_owned(),
        "objects.crumbs.scatter.count=12".to_owned(),
    ];
    let heaped = strewn(&narrow).expect("there is room");
    let of_objects = heaped
        .notes
        .iter()
        .filter(|note| !note.starts_with("camera: "));
    let of_objects: Vec<&String> = of_objects.collect();
    let [note] = of_objects[..] else {
        panic!("one note: {of_objects:?}");
    };
    let tallest = heaped.strewn[&1]
        .iter()
        .map(|(_, place)| place.w_axis.z - 0.5);
    let tallest = tallest.fold(0.0, f64::max);
    let expected = format!("objects.crumbs: its things are heaped {tallest:.2} m high");
    assert!(note.starts_with(&expected), "{note} is not {expected}");
}

#[test]
fn what_is_too_fine_to_strew_on_is_reported_before_anything_falls() {
    // A lump has hundreds of triangles; more than a hundred thousand do not come to rest.
    let fine = [
        "objects.crumbs.scatter.count=100000".to_owned(),
        "objects.cards.scatter.on=\"crumbs\"".to_owned(),
    ];
    let error = strewn(&fine).expect_err("too many triangles");
    assert!(
        error.starts_with("objects.cards.scatter: `on`: the surface has over 20000000 triangles"),
        "{error}"
    );
}

#[test]
fn places_and_meshes_that_need_more_memory_than_is_allowed_are_refused_before_they_are_made() {
    let text = STREWN.replace(
        "scatter = ",
        "volume = { within_m = [0, 0, 0, 1, 1, 1], lai = 100 }\n#",
    );
    let built = |text: &str, overrides: &[String], most_bytes: f64| {
        let loaded = parse(text, "scene.toml", Path::new("."), overrides);
        let scene = loaded
            .unwrap_or_else(|errors| panic!("{errors}"))
            .description;
        let options = BuildOptions {
            most_bytes: Some(most_bytes),
            ..BuildOptions::default()
        };
        let world = World::build_with(&scene, &options);
        world.map(|_| ()).map_err(|error| error.to_string())
    };
    // A lump of 4 mm has some 2 cm²: half a million of them float in the box.
    let error = built(&text, &[], 1e8).expect_err("more than there is memory for");
    assert!(
        error.starts_with("objects.crumbs.volume: `lai`: this takes ")
            && error.contains("for which there is memory")
            && error.contains("--memory"),
        "{error}"
    );
    let fine = "meshes.crumb.lump={ radius_m=0.004, segments=256 }".to_owned();
    let error = built(STREWN, &[fine], 1e7).expect_err("more than there is memory for");
    assert!(
        error.contains("triangles") && error.contains("--memory 1"),
        "{error}"
    );
    let loose = STREWN
        .replace("settle = true, ", "")
        .replace("over = \"crumbs\", ", "");
    built(&loose, &[], 2e6).expect("318 things fit");
    let error = built(&loose, &[], 5e5).expect_err("more than there is memory for");
    assert!(error.contains("objects.crumbs.scatter: `count`"), "{error}");
}
