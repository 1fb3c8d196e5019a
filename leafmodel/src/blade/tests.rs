//! Blades over many outlines and veins; and the shapes that the tests of this folder share.

use crate::venation::conformal_map::ConformalMap;
use glam::DVec2;
use proptest::prelude::*;

use super::*;
use crate::shape::outline::Outline;
use crate::venation::network::VeinSegment;
use properties::fixed;

/// A form without any bend, which tests modify.
pub(super) fn flat() -> BladeForm {
    BladeForm {
        fold: 0.0,
        curl: 0.0,
        ruffle: 0.0,
        ruffle_waves: 0.0,
        pleat: 0.0,
        relief: 0.0,
        thickness_mm: 0.2,
        margin: MarginThickness::EVEN,
        closed: false,
        max_edge_mm: 1.0,
        meshed_vein_radius_mm: 0.05,
    }
}

/// An elliptic leaf with its base at the origin.
pub(super) fn ellipse(width: f64, length: f64, points: usize) -> Outline {
    let margin = (0..points)
        .map(|i| {
            let angle = std::f64::consts::TAU * i as f64 / points as f64;
            DVec2::new(
                0.5 * width * libm::sin(angle),
                0.5 * length * (1.0 - libm::cos(angle)),
            )
        })
        .collect();
    Outline::new(margin, DVec2::ZERO, DVec2::new(0.0, length)).expect("an ellipse is simple")
}

/// A midrib with `pairs` of straight side veins that leave it at 45° and extend beyond most leaves.
pub(super) fn herringbone(length: f64, pairs: usize, radius: f64) -> Vec<VeinSegment> {
    let steps = 12 * (pairs + 1);
    let node = |i: usize| DVec2::new(0.0, length * i as f64 / steps as f64);
    let mut veins = Vec::new();
    for i in 0..steps {
        let left = |i: usize| radius * (1.0 - 0.9 * i as f64 / steps as f64);
        veins.push(VeinSegment {
            from: node(i),
            to: node(i + 1),
            radius_from: left(i),
            radius_to: left(i + 1),
            order: 1,
        });
    }
    for pair in 1..=pairs {
        for side in [-1.0, 1.0] {
            let start = node(12 * pair);
            let step = DVec2::new(side, 1.0) * (0.35 * length / 40.0);
            for i in 0..20 {
                let thin = |i: usize| 0.5 * radius * (1.0 - 0.8 * f64::from(i as u32) / 20.0);
                veins.push(VeinSegment {
                    from: start + step * i as f64,
                    to: start + step * (i + 1) as f64,
                    radius_from: thin(i),
                    radius_to: thin(i + 1),
                    order: 2,
                });
            }
        }
    }
    veins
}

/// Smallest angle of a flat triangle, degrees.
fn smallest_angle(mesh: &BladeMesh, triangle: &[u32; 3]) -> f64 {
    let corners = triangle.map(|v| mesh.lamina[v as usize]);
    (0..3)
        .map(|i| {
            let (u, v) = (
                corners[(i + 1) % 3] - corners[i],
                corners[(i + 2) % 3] - corners[i],
            );
            u.perp_dot(v).atan2(u.dot(v)).to_degrees()
        })
        .fold(f64::INFINITY, f64::min)
}

fn longest_edge(mesh: &BladeMesh) -> f64 {
    mesh.triangles
        .iter()
        .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
        .map(|edge| {
            let [a, b] = edge.map(|v| mesh.lamina[v as usize]);
            a.distance(b)
        })
        .fold(0.0, f64::max)
}

#[test]
fn a_pleated_leaf_with_a_thin_margin_is_sound_and_has_the_slope_of_its_folds() {
    let outline = ellipse(24.0, 60.0, 120);
    let form = BladeForm {
        pleat: 0.25,
        relief: 0.5,
        fold: 0.3,
        curl: 0.5,
        margin: MarginThickness {
            share: 0.5,
            width_mm: 1.0,
        },
        ..flat()
    };
    let veins = herringbone(60.0, 9, 0.5);
    let mesh = |form: &BladeForm| {
        BladeMesh::from_veins(&outline, &veins, ConformalMap::FLAT, form).expect("a leaf")
    };
    assert_eq!(mesh(&form).validate(outline.area()), Ok(()));
    let least = mesh(&form).thickness_mm.iter().copied().fold(1.0, f64::min);
    assert!((least - 0.1).abs() < 1e-9, "{least} at the margin");
    // Laid flat but for its folds, the blade slopes by their angle between the rounded creases.
    let folded = mesh(&BladeForm {
        pleat: 0.25,
        ..flat()
    });
    let mut slopes: Vec<f64> = folded.normals.iter().map(|n| n.z.acos()).collect();
    slopes.sort_by(f64::total_cmp);
    let steep = slopes[slopes.len() * 9 / 10];
    assert!((steep - 0.25).abs() < 0.03, "{steep}");
}

#[test]
fn a_leaf_with_raised_veins_is_well_meshed() {
    let outline = ellipse(24.0, 60.0, 120);
    let form = BladeForm {
        relief: 0.5,
        fold: 0.4,
        curl: 0.6,
        ..flat()
    };
    let mesh = BladeMesh::from_veins(
        &outline,
        &herringbone(60.0, 9, 0.5),
        ConformalMap::FLAT,
        &form,
    )
    .expect("an ordinary leaf");
    assert_eq!(mesh.validate(outline.area()), Ok(()));
    let angles: Vec<f64> = mesh
        .triangles
        .iter()
        .map(|t| smallest_angle(&mesh, t))
        .collect();
    let least = angles.iter().copied().fold(f64::INFINITY, f64::min);
    assert!(least > 15.0, "an angle of {least}°");
    assert!(
        longest_edge(&mesh) <= form.max_edge_mm,
        "{}",
        longest_edge(&mesh)
    );
    let raised = mesh.thickness_mm.iter().copied().fold(0.0, f64::max);
    assert!(
        (raised - (0.2 + 0.5)).abs() < 0.05,
        "midrib {raised} mm thick"
    );
}

#[test]
fn the_same_leaf_has_the_same_bits() {
    let outline = ellipse(24.0, 60.0, 120);
    let veins = herringbone(60.0, 9, 0.5);
    let form = BladeForm {
        relief: 0.5,
        ruffle: 0.02,
        ruffle_waves: 4.0,
        ..flat()
    };
    assert_eq!(
        BladeMesh::from_veins(&outline, &veins, ConformalMap::FLAT, &form),
        BladeMesh::from_veins(&outline, &veins, ConformalMap::FLAT, &form)
    );
}

#[test]
fn each_number_out_of_range_is_refused_by_name() {
    type Spoil = fn(&mut BladeForm, f64);
    let spoils: [(&str, Spoil, f64); 8] = [
        ("fold_deg", |f, v| f.fold = v, 1.5),
        ("curl_deg", |f, v| f.curl = v, -6.3),
        ("ruffle", |f, v| f.ruffle = v, -0.01),
        ("ruffle_waves", |f, v| f.ruffle_waves = v, 101.0),
        ("relief", |f, v| f.relief = v, -0.1),
        ("thickness_mm", |f, v| f.thickness_mm = v, 0.0),
        ("max_edge_mm", |f, v| f.max_edge_mm = v, 0.0),
        (
            "meshed_vein_radius_mm",
            |f, v| f.meshed_vein_radius_mm = v,
            0.0,
        ),
    ];
    for (name, spoil, bad) in spoils {
        for bad in [bad, f64::NAN, f64::INFINITY] {
            let mut form = flat();
            spoil(&mut form, bad);
            let Err(BladeError::Range(error)) = form.validate() else {
                panic!("{name} = {bad} was taken");
            };
            assert_eq!(error.path, name);
        }
    }
}

#[test]
fn a_mesh_too_fine_is_refused_before_it_is_built() {
    let form = BladeForm {
        max_edge_mm: 0.01,
        ..flat()
    };
    let answer = BladeMesh::from_veins(&ellipse(24.0, 60.0, 120), &[], ConformalMap::FLAT, &form);
    assert!(matches!(answer, Err(BladeError::TooFine(_))));
}

#[test]
fn a_blade_curled_into_itself_is_refused() {
    let form = BladeForm {
        fold: -80_f64.to_radians(),
        curl: 355_f64.to_radians(),
        max_edge_mm: 2.0,
        ..flat()
    };
    let answer = BladeMesh::from_veins(&ellipse(60.0, 60.0, 120), &[], ConformalMap::FLAT, &form);
    assert!(
        matches!(answer, Err(BladeError::TurnedOver(_))),
        "{answer:?}"
    );
}

/// A margin whose distance from a centre oscillates: lobes, teeth, narrow sinuses, no symmetry.
fn lobed(points: usize, lobes: f64, depth: f64, skew: f64) -> Outline {
    let margin = (0..points)
        .map(|i| {
            let angle = std::f64::consts::TAU * i as f64 / points as f64;
            let swing = 1.0 + depth * libm::cos(lobes * angle + skew * libm::sin(angle));
            let r = 14.0 * swing;
            DVec2::new(0.7 * r * libm::sin(angle), 20.0 - r * libm::cos(angle))
        })
        .collect::<Vec<_>>();
    let base = margin[0];
    Outline::new(margin.clone(), base, margin[points / 2]).expect("a star is simple")
}

proptest! {
    #![proptest_config(fixed(24))]
    #[test]
    fn no_outline_and_no_veins_make_cracks_flips_or_slivers(
        points in 12_usize..160,
        lobes in 0.0..7.0_f64,
        depth in 0.0..0.75,
        skew in 0.0..2.0,
        pairs in 0_usize..12,
        radius in 0.1..0.8,
        shift in -6.0..6.0,
        relief in 0.0..0.6,
        fold in -0.6..0.6,
        curl in -0.8..0.8,
        ruffle in 0.0..0.015,
    ) {
        let outline = lobed(points, lobes.round(), depth, skew);
        let mut veins = herringbone(45.0, pairs, radius);
        for vein in &mut veins {
            vein.from.x += shift;
            vein.to.x += shift;
        }
        let form = BladeForm {
            relief, fold, curl, ruffle, ruffle_waves: 4.0, max_edge_mm: 1.5, ..flat()
        };
        let mesh = BladeMesh::from_veins(&outline, &veins, ConformalMap::FLAT, &form).expect("gently bent");
        prop_assert_eq!(mesh.validate(outline.area()), Ok(()));
        let pointed = mesh.triangles.iter().filter(|t| smallest_angle(&mesh, t) < 15.0).count();
        // The margin's own corners may be sharper; there are fewer of them than of its points.
        prop_assert!(pointed <= points / 4, "{} of {}", pointed, mesh.triangles.len());
        let least = mesh.triangles.iter().map(|t| smallest_angle(&mesh, t)).fold(90.0, f64::min);
        prop_assert!(least > 2.0, "an angle of {}°", least);
    }
}
