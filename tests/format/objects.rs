//! What objects of valid scenes mean: their places, and the parts of plants.

use glam::DVec3;
use renderer::geometry::scatter::{Inclination, InclinationTable};
use renderer::scene::description::{ObjectShape, Shape};

use super::{accept, text_of};

#[test]
fn instances_are_the_rows_of_their_file_in_the_frame_of_their_object() {
    let scene = accept(&text_of("whole.toml"), "whole.toml", &[]).description;
    assert!(scene.objects[0].value.instances.is_none());
    let places = scene.objects[9].value.instances.as_ref();
    let places = places.expect("the object has a file");
    let shapes: Vec<u32> = places.iter().map(|place| place.shape).collect();
    assert_eq!(shapes, [0, 1]);
    // Half as large, x to y, y to −x; one metre higher than the row says.
    let linear = [0.0, 0.5, 0.0, -0.5, 0.0, 0.0, 0.0, 0.0, 0.5];
    assert_eq!(places[1].linear.to_cols_array(), linear);
    assert_eq!(places[1].translation, DVec3::new(1.0, 2.0, 4.0));
    let moved = accept(
        &text_of("whole.toml"),
        "whole.toml",
        &["objects.row.position_m=[0, 0, -3]"],
    );
    let places = moved.description.objects[9].value.instances.clone();
    assert_eq!(places.expect("it still has them")[1].translation.z, 0.0);
}

#[test]
fn inclinations_of_a_file_are_those_of_the_same_rows_in_the_scene() {
    let inclined = |rows: &str| {
        let kind = "objects.afloat.volume.inclination=table";
        let rows = format!("objects.afloat.volume.inclinations={rows}");
        let scene = accept(&text_of("whole.toml"), "whole.toml", &[kind, &rows]).description;
        let mut volumes = scene
            .objects
            .iter()
            .filter_map(|object| object.value.volume.as_ref());
        volumes
            .next()
            .expect("something floats")
            .inclination
            .clone()
    };
    let table = InclinationTable::new(vec![[0.0, 0.5], [45.0, 2.0], [90.0, 1.0]]);
    let expected = Inclination::Table(table.expect("it is sound"));
    assert_eq!(
        inclined("{ table = [[0, 0.5], [45, 2], [90, 1]] }"),
        expected
    );
    assert_eq!(inclined("{ file = 'angles.csv' }"), expected);
}

#[test]
fn a_spreadsheet_may_put_quotes_around_its_fields() {
    let places = |file: &str| {
        let file = format!("objects.row.instances.file='{file}'");
        let scene = accept(&text_of("whole.toml"), "whole.toml", &[&file]).description;
        scene.objects[9].value.instances.clone()
    };
    assert_eq!(places("quoted.csv"), places("places.csv"));
}

#[test]
fn a_plant_is_an_object_with_its_leaves_and_axes_as_instances() {
    let scene = accept(&text_of("whole.toml"), "whole.toml", &[]).description;
    let shoot = &scene.objects[10].value;
    // The axes of paper, then two individuals of both leaves.
    assert!(matches!(
        shoot.shapes[0],
        ObjectShape::Mesh { mesh, material: 0 } if matches!(scene.meshes[mesh].value, Shape::Body(_))
    ));
    assert_eq!(shoot.shapes.len(), 5);
    let names: Vec<&str> = scene.leaves.iter().map(|leaf| leaf.name.as_str()).collect();
    assert!(
        names.contains(&"simple.shoot.2") && names.contains(&"beech.shoot.2"),
        "{names:?}"
    );
    let places = shoot.instances.as_ref().expect("it has many places");
    assert!(places.len() > 30, "{}", places.len());
    assert!(places.iter().all(|place| (place.shape as usize) < 5));
}

#[test]
fn objects_are_scaled_then_turned_about_x_y_z_then_moved() {
    let scene = accept(&text_of("whole.toml"), "whole.toml", &[]).description;
    let panel = scene.objects[0].value.to_world;
    // Half as large; x = (1, 0, 0) stays under the half turn about x and becomes y about z.
    assert_eq!(panel.transform_point3(DVec3::X), DVec3::new(0.0, 0.5, 2.0));
    assert_eq!(panel.transform_point3(DVec3::Z), DVec3::new(0.0, 0.0, 1.5));
    let bottle = scene.objects[1].value.to_world;
    assert_eq!(
        bottle.transform_point3(DVec3::ZERO),
        DVec3::new(5.0, 6.0, 7.0)
    );
    assert_eq!(bottle.transform_vector3(DVec3::Y), DVec3::Z);
    let turned = accept(
        &text_of("minimal.toml"),
        "minimal.toml",
        &["objects.floor.rotate_deg=[90,90,0]"],
    );
    // About x first: z becomes −y, which a turn about y leaves alone.
    let to_world = turned.description.objects[0].value.to_world;
    assert_eq!(to_world.transform_vector3(DVec3::Z), DVec3::NEG_Y);
}
