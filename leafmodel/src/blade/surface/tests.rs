use proptest::prelude::*;

use crate::blade::frame::UvFrame;
use crate::venation::network::VeinSegment;

use super::*;
use crate::blade::tissue::tests::GREEN;
use properties::fixed;

const FRAME: UvFrame = UvFrame {
    min: DVec2::new(-5.0, 0.0),
    size: DVec2::new(10.0, 10.0),
};

fn vein(from: [f64; 2], to: [f64; 2], radius: f64) -> VeinSegment {
    VeinSegment {
        from: DVec2::from(from),
        to: DVec2::from(to),
        radius_from: radius,
        radius_to: radius,
        order: 1,
    }
}

fn map(plan: &SurfacePlan, veins: &[VeinSegment], size: u32) -> SurfaceMap {
    SurfaceMap::of(plan, &bare(veins), [size; 2]).expect("a good plan")
}

/// A blade without a mesh.
fn bare(veins: &[VeinSegment]) -> SurfaceOf<'_> {
    SurfaceOf {
        frame: &FRAME,
        margin: &[],
        veins,
        tissue: &GREEN,
        mesh: None,
        withering: None,
        seed: 1,
    }
}

fn sheet(veins: &[VeinSegment]) -> HeldSheet<'_> {
    HeldSheet {
        frame: &FRAME,
        veins,
        full_vein_radius_mm: GREEN.full_vein_radius_mm,
    }
}

/// The heights of both faces along a row of the map, mm, from 0 at its start.
fn profile(map: &SurfaceMap, row: u32) -> Vec<[f64; 2]> {
    let texel = f64::from(map.size_mm[0]) / f64::from(map.width);
    let mut at = [0.0; 2];
    let texels = &map.texels[(row * map.width) as usize..][..map.width as usize];
    let step = |texel_of: &[SlopeMoments; 2]| {
        for (height, slopes) in at.iter_mut().zip(texel_of) {
            *height += f64::from(slopes[0]) * texel;
        }
        at
    };
    texels.iter().map(step).collect()
}

#[test]
fn a_vein_is_a_groove_above_and_a_ridge_below_of_the_asked_height() {
    let plan = SurfacePlan {
        impressed: 0.25,
        raised: 0.5,
        ..SurfacePlan::SMOOTH
    };
    for radius in [0.4, 0.15] {
        let map = map(&plan, &[vein([0.0, -1.0], [0.0, 11.0], radius)], 400);
        let heights = profile(&map, 200);
        for (face, over) in [(0, 0.25), (1, 0.5)] {
            let lowest = heights.iter().map(|h| h[face]).fold(0.0, f64::min);
            let expected = -over * 2.0 * radius;
            assert!(
                (lowest / expected - 1.0).abs() < 0.02,
                "{lowest} {expected}"
            );
            // Beyond 1.5 radii the face is level again.
            assert!(heights[399][face].abs() < 1e-6);
        }
        // Half-way down a cosine lies half the height.
        let texel = 10.0 / 400.0;
        let column = ((5.0 - 0.75 * radius) / texel) as usize;
        let half = heights[column][1] / (-0.5 * 2.0 * radius);
        assert!((half - 0.5).abs() < 0.12, "{half}");
    }
}

#[test]
fn veins_below_a_texel_keep_the_mean_square_of_their_slopes() {
    let plan = SurfacePlan {
        raised: 0.4,
        ..SurfacePlan::SMOOTH
    };
    let veins: Vec<_> = (0..40)
        .map(|i| {
            let x = -4.9 + 0.251 * f64::from(i);
            vein([x, -1.0], [x + 0.1, 11.0], 0.03)
        })
        .collect();
    let total = |size: u32| {
        let map = map(&plan, &veins, size);
        let sum: f64 = map.texels.iter().map(|faces| f64::from(faces[1][2])).sum();
        sum / f64::from(size * size)
    };
    let fine = total(1000);
    // One mound: ∫ slope² dx = (h π / 2w)² w for the height h and half-width w.
    let (height, width) = (0.4 * 0.06, 0.045);
    let one = (height * std::f64::consts::PI / (2.0 * width)).powi(2) * width;
    let expected = one / 0.251;
    assert!((fine / expected - 1.0).abs() < 0.05, "{fine} {expected}");
    for size in [37, 100, 256] {
        let coarse = total(size);
        assert!(
            (coarse / fine - 1.0).abs() < 0.1,
            "{coarse} {fine} at {size}"
        );
    }
}

#[test]
fn between_two_veins_the_bulge_is_that_of_the_equation() {
    // Parallel veins of strength σ at distance a: h = H − (H − h₀) cosh(x/L)/cosh(a/2L).
    let (bulge_mm, width) = (0.3, 1.0);
    let plan = SurfacePlan {
        bulge_mm,
        bulge_width_mm: width,
        ..SurfacePlan::SMOOTH
    };
    let veins: Vec<_> = (-10..=10)
        .map(|i| {
            let x = 2.0 * f64::from(i);
            vein([x, -40.0], [x, 50.0], 0.3)
        })
        .collect();
    let bulge = bulge::Bulge::of(&plan, &sheet(&veins), 0.05);
    // GREEN's veins are full from 0.25 mm on: σ = 20/L. At a vein 2 h' = σ h₀.
    let (half, sigma) = (1.0, 20.0 / width);
    let tanh = (half / width).tanh();
    let held = bulge_mm * 2.0 * tanh / width / (sigma + 2.0 * tanh / width);
    for x in [0.0, 0.3, 0.7] {
        let expected = bulge_mm - (bulge_mm - held) * (x / width).cosh() / (half / width).cosh();
        let found = bulge.height(DVec2::new(1.0 + x, 5.0));
        assert!(
            (found - expected).abs() < 0.006,
            "{found} {expected} at {x}"
        );
    }
}

#[test]
fn a_wide_areole_bulges_more_than_a_small_one() {
    let plan = SurfacePlan {
        bulge_mm: 0.2,
        bulge_width_mm: 0.5,
        ..SurfacePlan::SMOOTH
    };
    let height = |spacing: f64| {
        let veins: Vec<_> = (0..=(20.0 / spacing) as i32)
            .map(|i| {
                let x = -10.0 + spacing * f64::from(i);
                vein([x, -1.0], [x, 11.0], 0.3)
            })
            .collect();
        bulge::Bulge::of(&plan, &sheet(&veins), 0.05).height(DVec2::new(0.5 * spacing, 5.0))
    };
    assert!(height(0.5) < 0.5 * height(2.0));
}

proptest! {
    #![proptest_config(fixed(24))]

    #[test]
    fn moments_are_finite_ordered_and_the_same_again(
        impressed in -1.0..1.0, raised in -1.0..1.0, bulge_mm in 0.0..1.0,
        vein_roughness in 0.0..1.0,
        ends in prop::collection::vec(([-6.0..6.0, -1.0..11.0], [-6.0..6.0, -1.0..11.0], 0.005..1.0), 0..8),
    ) {
        let plan = SurfacePlan { impressed, raised, bulge_mm, vein_roughness, ..SurfacePlan::SMOOTH };
        let veins: Vec<_> = ends.into_iter().map(|(from, to, r)| vein(from, to, r)).collect();
        let one = map(&plan, &veins, 48);
        for [x, y, xx, yy] in one.texels.iter().flatten() {
            prop_assert!([x, y, xx, yy].iter().all(|value| value.is_finite()));
            prop_assert!(*xx >= x * x && *yy >= y * y);
        }
        prop_assert_eq!(one, map(&plan, &veins, 48));
    }
}

#[test]
fn numbers_out_of_range_are_refused_by_name() {
    let refused = |plan: SurfacePlan| plan.validate().expect_err("out of range").path;
    let smooth = SurfacePlan::SMOOTH;
    assert_eq!(
        refused(SurfacePlan {
            impressed: f64::NAN,
            ..smooth
        }),
        "impressed"
    );
    assert_eq!(
        refused(SurfacePlan {
            bulge_mm: -0.1,
            ..smooth
        }),
        "bulge_mm"
    );
    assert_eq!(
        refused(SurfacePlan {
            cells_um: 2.0,
            ..smooth
        }),
        "cells_um"
    );
    let mut pitted = smooth;
    pitted.stomata.row_um = 5.0;
    assert_eq!(refused(pitted), "stomata.row_um");
    let mut dusty = smooth;
    dusty.dust.load_g_per_m2 = [0.0, 51.0];
    assert_eq!(refused(dusty), "dust.abaxial_g_per_m2");
    assert_eq!(smooth.validate(), Ok(()));
}
