//! Objects that are strewn on others: what their keys mean, and plants as a whole.

use glam::{DMat4, DVec3};
use leafmodel::blade::senescence::AgeSource;
use renderer::geometry::scatter::{Amount, Rest};
use renderer::scene::description::{InstancePlace, ObjectShape};
use renderer::scene::world::World;

use super::accepted::assert_near;
use super::{accept, text_of};

#[test]
fn what_is_strewn_has_its_numbers_in_si_units_and_its_leaves_apart() {
    let scene = accept(&text_of("whole.toml"), "whole.toml", &[]).description;
    let [crumbs, litter] = [12, 14].map(|object| &scene.objects[object].value);
    let strewn = crumbs.strewn.as_ref().expect("crumbs are strewn");
    assert_eq!(
        (strewn.on, strewn.plan.amount),
        (11, Amount::PerSquareMetre(500.0))
    );
    assert_near(strewn.plan.least_distance, 0.002);
    assert_near(strewn.plan.tilt, std::f64::consts::FRAC_PI_3);
    assert_near(strewn.plan.turn, std::f64::consts::FRAC_PI_2);
    assert_eq!(strewn.plan.rest, Rest::Fixed { sink: 0.001 });
    let strewn = litter.strewn.as_ref().expect("leaves are strewn");
    assert_eq!(strewn.over, [12, 5]);
    assert_eq!(strewn.plan.rest, Rest::Settled { gap: 0.0002 });
    // The second individual, after the four leaves of the file and that of the plant's.
    assert_eq!(litter.shapes.len(), 2);
    let days = litter.shapes.iter().map(|shape| {
        let ObjectShape::Leaf { leaf } = shape else {
            panic!("a leaf is strewn");
        };
        let age = scene.leaves[*leaf].value.plan.senescence.expect("it ages");
        match age.source {
            AgeSource::Day { day, .. } => day,
            AgeSource::Revenue { .. } => panic!("it ages by days"),
        }
    });
    assert_eq!(days.collect::<Vec<_>>(), [1.0, 20.0]);
}

#[test]
fn a_plant_is_strewn_as_a_whole() {
    let plant = r#"
[leaves.blade]
preset = "birch"
map_size = 64
[plants.twig]
preset = "birch-twig"
leaf = "blade"
[objects.twigs]
plant = "twig"
scale = 0.5
scatter = { on = "floor", count = 3, upright = true, sink_mm = 2 }
"#;
    let text = text_of("minimal.toml") + plant;
    let scene = accept(&text, "plant.toml", &[]).description;
    let parts = scene.objects[1].value.instances.as_ref();
    let parts = parts.expect("a plant has parts");
    assert!(parts.len() > 5, "{}", parts.len());
    let world = World::build(&scene).expect("a small scene");
    let strewn = &world.strewn[&1];
    assert_eq!(strewn.len(), 3 * parts.len());
    let mut feet = Vec::new();
    for copy in strewn.chunks(parts.len()) {
        let own: Vec<DMat4> = parts.iter().map(InstancePlace::matrix).collect();
        // Where the plant stands: what carries its first part carries all the others.
        let stand = copy[0].1 * own[0].inverse();
        for ((shape, place), (part, own)) in copy.iter().zip(parts.iter().zip(&own)) {
            assert_eq!(*shape, part.shape);
            let off = *place - stand * *own;
            let off = off
                .to_cols_array()
                .into_iter()
                .map(f64::abs)
                .fold(0.0, f64::max);
            assert!(off < 1e-9, "{off}");
        }
        assert!(stand.z_axis.truncate().distance(DVec3::Z) < 1e-9, "{stand}");
        assert!((stand.w_axis.z + 0.002).abs() < 1e-9, "{stand}");
        feet.push(stand.w_axis.truncate());
    }
    assert!(feet[0].distance(feet[1]) > 1e-3 && feet[1].distance(feet[2]) > 1e-3);
}
