use std::f32::consts::{PI, TAU};

use super::*;
use crate::bsdf::coat_table::{Bloom, CoatTable};
use crate::bsdf::dust::DustTable;
use crate::bsdf::leaf::{Coat, LeafShape, Tissue, usual_abaxial_ratio};
use crate::spectrum::{Curve, library};

const ALPHA: f32 = 0.3;

/// A leaf of reflectance `r` and transmittance `t` with these slopes, under coats of `eta`.
fn with_leaf<T>(
    [r, t]: [f32; 2],
    slopes: [Vec2; 2],
    [eta, alpha, tau]: [f32; 3],
    then: impl Fn(&ReliefBsdf<'_, 1>) -> T,
) -> T {
    let coats = [Coat::new(eta, ALPHA, ALPHA), Coat::new(eta, 0.45, 0.45)];
    let [r, t] = [Lanes([r]), Lanes([t])];
    let shape = if eta == 1.0 {
        LeafShape::EVEN
    } else {
        LeafShape::measured()
    };
    let tissue = Tissue::new(&coats, &shape, r, t, usual_abaxial_ratio(r, t));
    let table = CoatTable::of(eta);
    let bloom = Bloom::new(tau, &table);
    then(&ReliefBsdf {
        leaf: LeafBsdf::new(&coats, &shape, tissue),
        faces: slopes.map(|slope| ReliefFace {
            slope,
            coat: table.coat(eta, [alpha; 2], &bloom),
            dust: None,
        }),
        grains: Lanes::ZERO,
    })
}

/// The same with dust of these optical thicknesses on its faces, whose grains have this albedo.
fn with_dust<T>(
    leaf: [f32; 2],
    [eta, alpha, bloom]: [f32; 3],
    (taus, albedo): ([f32; 2], f32),
    then: impl Fn(&ReliefBsdf<'_, 1>) -> T,
) -> T {
    with_leaf(leaf, [Vec2::ZERO; 2], [eta, alpha, bloom], |clean| {
        let table = CoatTable::of(eta);
        let dusty = DustTable::new(&table, &Bloom::new(bloom, &table));
        let mut leaf = clean.clone();
        leaf.grains = Lanes([albedo]);
        for (face, tau) in leaf.faces.iter_mut().zip(taus) {
            face.dust = (tau > 0.0).then(|| dusty.dust(tau, &face.coat));
        }
        then(&leaf)
    })
}

fn direction(theta: f32, phi: f32) -> Vec3 {
    let sin = libm::sinf(theta);
    Vec3::new(
        sin * libm::cosf(phi),
        sin * libm::sinf(phi),
        libm::cosf(theta),
    )
}

/// `∫ f(wo, wi) |cos| dwi` over the sphere.
fn sent_out(bsdf: &ReliefBsdf<'_, 1>, wo: Vec3) -> f32 {
    let (rings, spokes) = (240, 120);
    let Some(view) = bsdf.seen_from(wo) else {
        return 0.0;
    };
    let mut sum = 0.0;
    for i in 0..rings {
        let theta = PI * (i as f32 + 0.5) / rings as f32;
        for j in 0..spokes {
            let wi = direction(theta, TAU * (j as f32 + 0.5) / spokes as f32);
            let f = view.scatter(wi).f.0[0];
            sum += f * wi.z.abs() * libm::sinf(theta) * (PI / rings as f32) * (TAU / spokes as f32);
        }
    }
    sum
}

#[test]
fn in_a_white_furnace_no_relief_sends_out_more_than_comes_in_and_little_is_lost() {
    for (steep, most_lost) in [(0.0, 0.015), (0.1, 0.025), (0.3, 0.05), (0.8, 0.2)] {
        for eta in [1.0, 1.45, 1.6] {
            for alpha in [0.15, 0.5] {
                let slopes = [Vec2::new(steep, 0.5 * steep), Vec2::new(-steep, 0.0)];
                with_leaf([0.6, 0.4], slopes, [eta, alpha, 0.0], |leaf| {
                    for theta in [0.1, 0.7, 1.2] {
                        for phi in [0.0, 2.5, 4.0] {
                            // At a slope of 0 what is lost is due to coats other than
                            // those that the tissue was made for.
                            for wo in [direction(theta, phi), -direction(theta, phi)] {
                                let sent = sent_out(leaf, wo);
                                let about = format!("{sent} at {steep} {eta} {alpha} {wo}");
                                assert!(sent <= 1.003, "{about}");
                                // Grazing views of steep slopes lose more of the coat's lobe.
                                let lost = most_lost * if theta > 1.0 { 2.0 } else { 1.0 };
                                assert!(sent >= 1.0 - lost, "{about}");
                            }
                        }
                    }
                });
            }
        }
    }
}

#[test]
fn no_light_leaks_to_the_other_face() {
    // Nothing passes the tissue: light of the other side is not seen, whatever the slopes.
    let slopes = [Vec2::new(0.9, -0.4), Vec2::new(-0.7, 0.8)];
    with_leaf([0.5, 0.0], slopes, [1.45, 0.3, 0.1], |leaf| {
        for i in 0..500 {
            let wo = direction(0.003 * i as f32, 0.7 * i as f32);
            let view = leaf.seen_from(wo).expect("it is not edge-on");
            for j in 0..200 {
                let wi = -direction(0.0075 * j as f32, 1.3 * j as f32);
                assert_eq!(view.scatter(wi).f.0[0], 0.0);
                let u = Vec2::new((0.37 * j as f32).fract(), (0.61 * j as f32).fract());
                if let Some(sample) = view.sample((0.17 * j as f32).fract(), u) {
                    assert!(sample.wi.z > 0.0);
                }
            }
        }
    });
}

#[test]
fn samples_have_the_density_and_the_value_that_they_say() {
    let slopes = [Vec2::new(0.4, -0.2), Vec2::new(-0.3, 0.1)];
    with_leaf([0.4, 0.3], slopes, [1.45, 0.3, 0.1], |leaf| {
        for wo in [direction(0.5, 1.0), -direction(1.1, 3.0)] {
            let view = leaf.seen_from(wo).expect("it is not edge-on");
            let (mut mean, count) = (0.0, 20_000);
            for i in 0..count {
                let at = |step: f64| ((f64::from(i) + 0.5) * step).fract() as f32;
                let lobe = (i as f32 + 0.5) / count as f32;
                let u = Vec2::new(at(0.754_877_666_246_7), at(0.569_840_290_998_05));
                if let Some(sample) = view.sample(lobe, u) {
                    let there = view.scatter(sample.wi);
                    assert!((there.pdf / sample.pdf - 1.0).abs() < 1e-4);
                    mean += sample.weight.0[0] / count as f32;
                }
            }
            let expected = sent_out(leaf, wo);
            assert!((mean / expected - 1.0).abs() < 0.01, "{mean} {expected}");
        }
    });
}

#[test]
fn a_level_face_is_the_plain_leaf() {
    let coats = [Coat::new(1.45, ALPHA, ALPHA), Coat::new(1.45, 0.45, 0.45)];
    let shape = LeafShape::measured();
    let tissue = Tissue::new(&coats, &shape, Lanes([0.1]), Lanes([0.08]), Lanes([1.5]));
    let plain = LeafBsdf::new(&coats, &shape, tissue);
    let table = CoatTable::of(1.45);
    let bloom = Bloom::new(0.0, &table);
    let bsdf = ReliefBsdf {
        leaf: plain.clone(),
        faces: [ALPHA, 0.45].map(|alpha| ReliefFace {
            slope: Vec2::ZERO,
            coat: table.coat(1.45, [alpha; 2], &bloom),
            dust: None,
        }),
        grains: Lanes::ZERO,
    };
    for wo in [direction(0.3, 0.2), -direction(1.0, 2.0)] {
        for wi in [direction(0.6, 1.0), -direction(0.9, 4.0)] {
            let expected = plain.eval(wo, wi).0[0];
            let found = bsdf.seen_from(wo).expect("seen").scatter(wi).f.0[0];
            assert!((found / expected - 1.0).abs() < 0.01, "{found} {expected}");
        }
    }
}

#[test]
fn a_slope_away_from_the_view_is_lowered_until_the_face_is_seen() {
    with_leaf(
        [0.4, 0.3],
        [Vec2::new(5.0, 0.0); 2],
        [1.45, 0.3, 0.1],
        |leaf| {
            for wo in [
                direction(1.4, 0.0),
                direction(1.4, PI),
                -direction(1.4, 0.0),
            ] {
                assert!(leaf.normal(wo).dot(wo) > 0.0, "{wo}");
                assert!(leaf.seen_from(wo).is_some());
            }
        },
    );
}

#[test]
fn a_white_leaf_with_bloom_sends_out_what_comes_in_but_for_some_gloss() {
    for tau in [0.1, 0.5, 3.0] {
        with_leaf([0.6, 0.4], [Vec2::ZERO; 2], [1.45, 0.3, tau], |leaf| {
            for theta in [0.1, 0.7, 1.2] {
                for wo in [direction(theta, 1.0), -direction(theta, 1.0)] {
                    let sent = sent_out(leaf, wo);
                    assert!((0.95..=1.003).contains(&sent), "{sent} at {tau} {wo}");
                }
            }
        });
    }
}

#[test]
fn bloom_is_reciprocal_and_brightens_a_dark_leaf_by_what_it_sends_back() {
    let at = |tau: f32, wo: Vec3, wi: Vec3| {
        with_leaf([0.05, 0.0], [Vec2::ZERO; 2], [1.0, 0.3, tau], |leaf| {
            leaf.seen_from(wo).expect("it is seen").scatter(wi).f.0[0]
        })
    };
    let (wo, wi) = (direction(0.4, 0.3), direction(1.1, 2.0));
    assert!((at(0.3, wo, wi) / at(0.3, wi, wo) - 1.0).abs() < 1e-5);
    let sent = with_leaf([0.0, 0.0], [Vec2::ZERO; 2], [1.0, 0.3, 0.3], |leaf| {
        sent_out(leaf, direction(0.0, 0.0))
    });
    let expected = 0.5 * (1.0 - libm::expf(-0.3));
    assert!((sent / expected - 1.0).abs() < 0.01, "{sent} {expected}");
}

#[test]
fn a_white_leaf_under_white_dust_sends_out_what_comes_in_and_never_more() {
    for taus in [[0.02, 0.0], [0.3, 0.0], [0.5, 0.2], [3.0, 8.0]] {
        for (eta, bloom, most_lost) in [(1.0, 0.0, 0.004), (1.45, 0.0, 0.06), (1.45, 0.3, 0.08)] {
            for rt in [[0.6, 0.4], [1.0, 0.0], [0.2, 0.8]] {
                with_dust(rt, [eta, 0.3, bloom], (taus, 1.0), |leaf| {
                    for theta in [0.1, 0.7, 1.2, 1.5] {
                        for wo in [direction(theta, 1.0), -direction(theta, 1.0)] {
                            let sent = sent_out(leaf, wo);
                            let about = format!("{sent} at {taus:?} {eta} {bloom} {rt:?} {wo}");
                            assert!(sent <= 1.003, "{about}");
                            // The veiled part of the gloss is lost, more of it at grazing angles;
                            // and where coats are dissimilar, what passes.
                            let lost = most_lost * if theta > 1.0 { 4.0 } else { 1.0 };
                            assert!(sent >= 1.0 - lost || rt[1] > 0.5, "{about}");
                        }
                    }
                });
            }
        }
    }
}

#[test]
fn dust_is_reciprocal() {
    let at = |wo: Vec3, wi: Vec3| {
        with_dust([0.3, 0.2], [1.45, 0.3, 0.1], ([0.4, 0.2], 0.6), |leaf| {
            leaf.seen_from(wo).expect("it is seen").scatter(wi).f.0[0]
        })
    };
    for wi in [direction(1.1, 2.0), -direction(1.1, 2.0)] {
        let wo = direction(0.4, 0.3);
        assert!((at(wo, wi) / at(wi, wo) - 1.0).abs() < 1e-5);
    }
}

#[test]
fn samples_of_a_dusty_leaf_have_the_value_that_they_say() {
    with_dust([0.4, 0.3], [1.45, 0.3, 0.0], ([0.6, 0.3], 0.7), |leaf| {
        for wo in [direction(0.5, 1.0), -direction(1.1, 3.0)] {
            let view = leaf.seen_from(wo).expect("it is not edge-on");
            let (mut mean, count) = (0.0, 20_000);
            for i in 0..count {
                let at = |step: f64| ((f64::from(i) + 0.5) * step).fract() as f32;
                let lobe = (i as f32 + 0.5) / count as f32;
                let u = Vec2::new(at(0.754_877_666_246_7), at(0.569_840_290_998_05));
                if let Some(sample) = view.sample(lobe, u) {
                    mean += sample.weight.0[0] / count as f32;
                }
            }
            let expected = sent_out(leaf, wo);
            assert!((mean / expected - 1.0).abs() < 0.01, "{mean} {expected}");
        }
    });
}

#[test]
fn dust_brightens_a_green_leaf_in_the_visible_and_darkens_it_beyond_the_red_edge() {
    // R and T of a green leaf, and the albedo of grains of a dry soil, by wavelength.
    use optics::dust::grain_albedo;
    let dry_soil = Curve::from_points(&library::soil(0.0));
    for (nm, leaf, sign) in [
        (450.0, [0.05, 0.01], 1.0),
        (550.0, [0.11, 0.10], 1.0),
        (680.0, [0.05, 0.01], 1.0),
        (800.0, [0.47, 0.48], -1.0),
        (900.0, [0.46, 0.48], -1.0),
        (1940.0, [0.07, 0.04], 1.0),
    ] {
        let albedo = grain_albedo(f64::from(dry_soil.at(nm))) as f32;
        let sent = |tau: f32| {
            with_dust(leaf, [1.45, 0.3, 0.0], ([tau, 0.0], albedo), |leaf| {
                let view = direction(0.1, 0.0);
                let (mut back, rings) = (0.0, 180);
                let seen = leaf.seen_from(view).expect("it is seen");
                for i in 0..rings {
                    let theta = 0.5 * PI * (i as f32 + 0.5) / rings as f32;
                    for j in 0..120 {
                        let wi = direction(theta, TAU * (j as f32 + 0.5) / 120.0);
                        let patch = 0.5 * PI / rings as f32 * TAU / 120.0;
                        let cosine = wi.z * libm::sinf(theta);
                        back += seen.scatter(wi).f.0[0] * cosine * patch;
                    }
                }
                back
            })
        };
        let [clean, some, more] = [0.0, 0.15, 0.4].map(sent);
        let about = format!("{clean} {some} {more} at {nm} nm");
        assert!(sign * (some - clean) > 0.004, "{about}");
        assert!(sign * (more - some) > 0.004, "{about}");
    }
}
