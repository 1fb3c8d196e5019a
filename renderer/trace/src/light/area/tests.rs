use super::*;
use crate::light::pattern::Colours;
use crate::light::texels::Texels;

/// Unit square at z = 1 that shines downwards, with u along x and v along y.
const SQUARE: [[Vec3; 3]; 2] = [
    [
        Vec3::new(0.0, 0.0, 1.0),
        Vec3::new(0.0, 1.0, 1.0),
        Vec3::new(1.0, 1.0, 1.0),
    ],
    [
        Vec3::new(1.0, 1.0, 1.0),
        Vec3::new(1.0, 0.0, 1.0),
        Vec3::new(0.0, 0.0, 1.0),
    ],
];

fn uvs() -> [[Vec2; 3]; 2] {
    SQUARE.map(|corners| corners.map(Vec3::truncate))
}

fn gels() -> Pattern {
    let picture = [[4.0, 1.0, 0.5], [0.0; 3], [1.0; 3], [0.2, 0.5, 2.0]];
    let picture = Texels::new(picture.into(), 2);
    Pattern::new(0.3, Some(Colours::Picture(picture)))
}

fn wavelengths() -> Wavelengths<4> {
    Wavelengths::new([450.0, 550.0, 650.0, 750.0])
}

fn floor() -> Receiver {
    Receiver {
        position: Vec3::new(0.2, 0.7, 0.0),
        normal: Vec3::Z,
    }
}

/// Irradiance at the receiver by light samples of all patches.
fn drawn(light: &AreaLight) -> f32 {
    let side = 256;
    let mut sum = 0.0;
    for patch in 0..light.patches().len() {
        for i in 0..side * side {
            let u = Vec2::new((i % side) as f32 + 0.5, (i / side) as f32 + 0.5) / side as f32;
            let sample = light
                .sample(patch, &floor(), &wavelengths(), u)
                .expect("the floor is below");
            sum += sample.radiance.0[2] * sample.wi.z / sample.pdf;
        }
    }
    sum / (side * side) as f32
}

#[test]
fn a_patterned_lamp_gives_what_a_sum_over_its_points_gives() {
    let light = AreaLight::with_pattern(&SQUARE, &uvs(), Curve::Constant(2.0), gels());
    assert_eq!(
        light.patches().len(),
        1,
        "the triangles continue each other"
    );
    let side = 512;
    let mut expected = 0.0_f64;
    for i in 0..side * side {
        let uv = Vec2::new((i % side) as f32 + 0.5, (i / side) as f32 + 0.5) / side as f32;
        let point = uv.extend(1.0);
        let triangle = u32::from(uv.x > uv.y);
        let emitted = light.emitted(Vec3::Z, -Vec3::Z, (triangle, point), &wavelengths());
        let radiance = emitted.expect("it shines downwards").0[2];
        // Both cosines are 1 / distance.
        let distance2 = (point - floor().position).length_squared();
        expected += f64::from(radiance / (distance2 * distance2));
    }
    let expected = (expected / (side * side) as f64) as f32;
    let found = drawn(&light);
    assert!(
        (found / expected - 1.0).abs() < 2e-3,
        "{found}, not {expected}"
    );
}

#[test]
fn two_triangles_with_different_coordinates_are_two_patches_of_the_same_lamp() {
    let [first, mut second] = uvs();
    second.rotate_left(1);
    let light = AreaLight::with_pattern(&SQUARE, &[first, second], Curve::Constant(2.0), gels());
    assert_eq!(light.patches().len(), 2);
    assert_eq!(
        [0, 1].map(|triangle| light.patch_of(triangle)),
        [Some(0), Some(1)]
    );
    let primaries = Primaries::new(Curve::Constant(2.0));
    for (triangle, uvs) in [(0, first), (1, second)] {
        for (corner, uv) in SQUARE[triangle as usize].into_iter().zip(uvs) {
            let emitted = light.emitted(Vec3::Z, -Vec3::Z, (triangle, corner), &wavelengths());
            let expected = primaries.spectrum(gels().at(uv), &wavelengths()).0;
            for (found, expected) in emitted.expect("it shines downwards").0.iter().zip(expected) {
                assert!((found - expected).abs() < 1e-4, "{found}, not {expected}");
            }
        }
    }
}

#[test]
fn an_even_pattern_is_no_pattern() {
    let even = AreaLight::new(&SQUARE, Curve::Constant(2.0));
    let pattern = Pattern::new(1.0, None);
    let patterned = AreaLight::with_pattern(&SQUARE, &uvs(), Curve::Constant(2.0), pattern);
    assert!((drawn(&even) / drawn(&patterned) - 1.0).abs() < 1e-6);
    let intensity = |light: &AreaLight| light.emitters([400.0, 700.0]).map(|e| e.intensity).sum();
    let [even, patterned]: [f32; 2] = [intensity(&even), intensity(&patterned)];
    assert!(
        (even / patterned - 1.0).abs() < 1e-5,
        "{even} and {patterned}"
    );
}

#[test]
fn a_patch_is_chosen_by_its_share_of_the_pattern_but_never_forgotten() {
    // Only the upper half shines, which is the second of two rectangles.
    let lower = SQUARE.map(|corners| corners.map(|p| Vec3::new(p.x, p.y / 2.0, p.z)));
    let upper = lower.map(|corners| corners.map(|p| p + Vec3::Y / 2.0));
    let triangles = [lower, upper].concat();
    let uvs: Vec<_> = triangles
        .iter()
        .map(|face| face.map(Vec3::truncate))
        .collect();
    let picture = Texels::new(vec![[1.0; 3], [1.0; 3], [0.0; 3], [0.0; 3]], 1);
    let pattern = Pattern::new(1.0, Some(Colours::Picture(picture)));
    let light = AreaLight::with_pattern(&triangles, &uvs, Curve::Constant(1.0), pattern);
    let intensities: Vec<f32> = light
        .emitters([400.0, 700.0])
        .map(|e| e.intensity)
        .collect();
    let [dark, bright] = intensities[..] else {
        panic!("two patches, not {intensities:?}");
    };
    assert!(bright > 5.0 * dark && dark > 0.0, "{intensities:?}");
}
