use std::f32::consts::PI;

use glam::Vec3;

use super::*;
use crate::bsdf::leaf::{LeafBsdf, LeafShape, Tissue};
use crate::bsdf::relief::ReliefBsdf;
use crate::spectrum::Lanes;

const SIZE: usize = 64;

fn coats() -> [Coat; 2] {
    [Coat::new(1.45, 0.3, 0.3), Coat::new(1.45, 0.45, 0.45)]
}

/// Waves in both directions, of greatest slope `steep`.
fn waves(steep: f32) -> ReliefMap {
    let wave = |i: usize| steep * libm::sinf(2.0 * PI * (i as f32 + 0.5) / 8.0);
    let texel = |i: usize| {
        let (x, y) = (wave(i % SIZE), wave(i / SIZE));
        [[x, y, x * x, y * y]; 2]
    };
    ReliefMap {
        size: [SIZE; 2],
        texels: (0..SIZE * SIZE).map(texel).collect(),
        size_mm: [20.0; 2],
        cells: [0.0, 1.0, 0.5],
        bloom: [0.0; 2],
        cover: Vec::new(),
        stomata: StomataNumbers::NONE,
        dust_brightness: None,
    }
}

fn scale(is_mirrored: bool) -> TextureScale {
    TextureScale {
        metres_per_v: 0.02,
        is_mirrored,
    }
}

#[test]
fn what_a_level_does_not_resolve_is_roughness() {
    let relief = Relief::new(waves(0.2), &coats());
    let texel = 0.02 / SIZE as f32;
    let near = relief.faces(&relief.seen(Vec2::splat(0.5), Some(scale(false)), 0.1 * texel));
    let [x, y] = near.each_ref().map(|face| face.coat.ggx);
    assert!((x.alpha_x - 0.3).abs() < 0.05 && (y.alpha_x - 0.45).abs() < 0.05);
    let far = relief.faces(&relief.seen(Vec2::splat(0.5), Some(scale(false)), 64.0 * texel));
    assert!(far[0].slope.length() < 1e-6);
    // The mean square of a sine is half that of its height.
    let expected = (0.3_f32 * 0.3 + 3.0 * 0.5 * 0.2 * 0.2).sqrt();
    assert!((far[0].coat.ggx.alpha_x - expected).abs() < 1e-3);
}

#[test]
fn a_mirrored_leaf_has_mirrored_slopes() {
    let relief = Relief::new(waves(0.2), &coats());
    let uv = Vec2::new(0.26, 0.4);
    let [own, _] = relief.faces(&relief.seen(uv, Some(scale(false)), 0.0));
    let [mirrored, _] = relief.faces(&relief.seen(uv, Some(scale(true)), 0.0));
    assert_eq!(mirrored.slope, own.slope * Vec2::new(-1.0, 1.0));
}

/// The mean over the map of what the leaf sends to `wo` of light from `wi`, for rays of this width
/// in texels.
fn mean(relief: &Relief, wo: Vec3, wi: Vec3, width: f32) -> f32 {
    let coats = coats();
    let shape = LeafShape::measured();
    let tissue = Tissue::new(&coats, &shape, Lanes([0.08]), Lanes([0.06]), Lanes([1.5]));
    let texel = 0.02 / SIZE as f32;
    let mut sum = 0.0;
    for i in 0..SIZE * SIZE {
        let at = Vec2::new((i % SIZE) as f32 + 0.5, (i / SIZE) as f32 + 0.5) / SIZE as f32;
        let bsdf = ReliefBsdf {
            leaf: LeafBsdf::new(&coats, &shape, tissue),
            faces: relief.faces(&relief.seen(at, Some(scale(false)), width * texel)),
            grains: Lanes::ZERO,
        };
        let view = bsdf.seen_from(wo).expect("it is seen");
        sum += view.scatter(wi).f.0[0] * wi.z.abs();
    }
    sum / (SIZE * SIZE) as f32
}

#[test]
fn a_leaf_far_away_sends_out_what_it_does_from_nearby() {
    let relief = Relief::new(waves(0.2), &coats());
    let at = |x: f32, y: f32, z: f32| Vec3::new(x, y, z).normalize();
    // At and beside the highlight, oblique, and through the leaf.
    for (wo, wi, tolerance) in [
        (at(0.3, 0.0, 1.0), at(-0.3, 0.0, 1.0), 0.06),
        (at(0.3, 0.0, 1.0), at(0.1, 0.2, 1.0), 0.06),
        (at(0.5, 0.5, 1.0), at(-0.9, 0.2, 1.0), 0.06),
        (at(0.3, 0.0, 1.0), at(0.1, 0.4, -1.0), 0.05),
    ] {
        let near = mean(&relief, wo, wi, 0.5);
        for width in [3.0, 12.0, 64.0] {
            let far = mean(&relief, wo, wi, width);
            assert!(
                (far / near - 1.0).abs() < tolerance,
                "{far} {near} at {width}: {wo} {wi}"
            );
        }
    }
}
