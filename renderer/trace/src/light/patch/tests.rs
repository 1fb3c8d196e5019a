use proptest::prelude::*;

use super::*;
use properties::fixed;

fn quad(corners: [Vec3; 4]) -> [[Vec3; 3]; 2] {
    let [a, b, c, d] = corners;
    [[a, b, c], [a, c, d]]
}

fn square() -> [[Vec3; 3]; 2] {
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    quad(corners.map(|(x, y)| Vec3::new(x, y, 0.0)))
}

fn receiver(position: Vec3) -> Receiver {
    let normal = Vec3::new(0.3, -0.5, 0.6).normalize();
    Receiver { position, normal }
}

#[test]
fn two_triangles_with_right_angles_are_one_rectangle_however_they_are_turned() {
    let [first, second] = square();
    let turned = |[a, b, c]: [Vec3; 3]| [b, c, a];
    for first in [first, turned(first), turned(turned(first))] {
        for second in [second, turned(second), turned(turned(second))] {
            let (patches, patch_of) = patches(&[first, second]);
            assert!(matches!(patches[..], [Patch::Rectangle(_)]));
            assert_eq!(patch_of, [Some(0), Some(0)]);
            assert!((patches[0].area() - 4.0).abs() < 1e-6);
            assert!((patches[0].normal() - Vec3::Z).length() < 1e-6);
        }
    }
}

#[test]
fn a_sheared_square_a_kite_and_a_fold_stay_triangles_and_what_has_no_area_is_no_patch() {
    let sheared = square().map(|triangle| triangle.map(|p| Vec3::new(p.x + 0.1 * p.y, p.y, 0.0)));
    assert_eq!(patches(&sheared).1, [Some(0), Some(1)]);
    let [first, mut second] = square();
    second[2] *= 1.1;
    assert_eq!(patches(&[first, second]).1, [Some(0), Some(1)]);
    second = square()[1];
    second[2].z = 0.3;
    assert_eq!(patches(&[first, second]).1, [Some(0), Some(1)]);
    let line = [Vec3::ZERO, Vec3::X, Vec3::X];
    let (found, patch_of) = patches(&[line, first, line, second]);
    assert_eq!(patch_of, [None, Some(0), None, Some(1)]);
    assert_eq!(found.len(), 2);
}

#[test]
fn known_solid_angles_are_found() {
    // A face of a cube from its centre, and an octant.
    let (faces, _) = patches(&square());
    let sixth = 4.0 * std::f64::consts::PI / 6.0;
    assert!((faces[0].solid_angle(Vec3::Z) - sixth).abs() < 1e-12);
    let (octant, _) = patches(&[[Vec3::X, Vec3::Z, Vec3::Y]]);
    let eighth = 0.5 * std::f64::consts::PI;
    assert!((octant[0].solid_angle(Vec3::ZERO) - eighth).abs() < 1e-12);
    // Nearly the whole half space, and nearly nothing.
    assert!(
        (faces[0].solid_angle(1e-4 * Vec3::Z) / (2.0 * std::f64::consts::PI) - 1.0).abs() < 1e-4
    );
    assert!((faces[0].solid_angle(1e4 * Vec3::Z) * 1e8 / 4.0 - 1.0).abs() < 1e-6);
}

#[test]
fn nothing_is_drawn_from_behind_or_in_the_plane() {
    let (mut all, _) = patches(&square());
    all.extend(patches(&square()[..1]).0);
    for patch in all {
        for z in [-1.0, -1e-6, 0.0] {
            for x in [0.0, 0.5, 3.0] {
                let receiver = receiver(Vec3::new(x, 0.2, z));
                assert!(patch.sample(&receiver, Vec2::new(0.3, 0.7)).is_none());
                assert_eq!(patch.pdf(&receiver, Vec3::new(0.1, 0.1, 0.0)), 0.0);
            }
        }
    }
}

proptest! {
    #![proptest_config(fixed(256))]

    #[test]
    fn a_rectangle_fills_the_solid_angle_of_its_two_triangles(
        x in -5.0_f32..5.0, y in -5.0_f32..5.0, height in -3.0_f32..1.0
    ) {
        let from = Vec3::new(x, y, libm::powf(10.0, height));
        let (one, _) = patches(&square());
        let [first, second] = square();
        let (two, _) = patches(&[first, [Vec3::ZERO; 3], second]);
        let sum = two[0].solid_angle(from) + two[1].solid_angle(from);
        prop_assert!((one[0].solid_angle(from) / sum - 1.0).abs() < 1e-6, "{sum}");
    }

    #[test]
    fn a_drawn_point_lies_on_the_patch_in_the_reported_direction_with_the_reported_density(
        place in prop::array::uniform3(-4.0_f32..4.0), size in -3.0_f32..1.0,
        u in prop::array::uniform2(0.0_f32..1.0), triangle in prop::bool::ANY
    ) {
        let scale = libm::powf(10.0, size);
        let [first, second] = square().map(|triangle| triangle.map(|p| scale * p));
        let (patches, _) = if triangle { patches(&[first]) } else { patches(&[first, second]) };
        let receiver = receiver(Vec3::from(place));
        if let Some(sample) = patches[0].sample(&receiver, Vec2::from(u)) {
            let slack = 1e-5 * (scale + receiver.position.length());
            prop_assert!(sample.point.abs().max_element() <= scale + slack, "{}", sample.point);
            prop_assert!(sample.point.z.abs() <= slack, "{}", sample.point);
            prop_assert!(!triangle || sample.point.x >= sample.point.y - slack);
            let way = (sample.point - receiver.position).normalize();
            prop_assert!((way - sample.wi).length() < 1e-5);
            let pdf = patches[0].pdf(&receiver, sample.point);
            prop_assert!((pdf / sample.pdf - 1.0).abs() < 1e-4, "{pdf}, not {}", sample.pdf);
        } else {
            prop_assert!(receiver.position.z < 1e-3);
        }
    }
}
