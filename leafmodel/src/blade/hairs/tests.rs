use super::tube::SIDES;
use super::*;
use crate::blade::BladeForm;
use crate::blade::tests::flat;
use crate::optics::Contents;
use crate::shape::outline::Outline;
use crate::venation::conformal_map::ConformalMap;

const SIDE: f64 = 20.0;

fn blade(veins: &[VeinSegment]) -> BladeMesh {
    let square = [[-10.0, 0.0], [10.0, 0.0], [10.0, 20.0], [-10.0, 20.0]];
    let outline = Outline::new(
        square.map(DVec2::from).to_vec(),
        DVec2::ZERO,
        DVec2::new(0.0, 20.0),
    );
    let form = BladeForm {
        max_edge_mm: 2.0,
        ..flat()
    };
    BladeMesh::from_veins(
        &outline.expect("a square"),
        veins,
        ConformalMap::FLAT,
        &form,
    )
    .expect("a good form")
}

fn plan() -> HairPlan {
    HairPlan {
        name: "down".to_owned(),
        adaxial_per_mm2: 3.0,
        abaxial_per_mm2: 0.0,
        fringe_per_mm: 0.0,
        place: HairPlace::All,
        length_mm: 0.8,
        length_spread: 0.25,
        diameter_um: 20.0,
        lean: 40_f64.to_radians(),
        bend: 20_f64.to_radians(),
        stray: 30_f64.to_radians(),
        contents: Contents::NOTHING,
    }
}

/// Foot and tip of each hair.
fn hairs(mesh: &HairMesh) -> Vec<[DVec3; 2]> {
    let own = mesh.positions.chunks_exact(HairMesh::VERTICES);
    own.map(|v| {
        let foot = v[..SIDES].iter().sum::<DVec3>() / SIDES as f64;
        [foot, v[HairMesh::VERTICES - 1]]
    })
    .collect()
}

#[test]
fn hairs_have_the_density_length_and_side_that_was_asked_for() {
    let blade = blade(&[]);
    let plan = plan();
    let mesh = plan.grow(&blade, &[], 0.1, 7).expect("a good plan");
    let expected = plan.adaxial_per_mm2 * SIDE * SIDE;
    assert!(
        (mesh.count() as f64 / expected - 1.0).abs() < 0.03,
        "{}",
        mesh.count()
    );
    let mut mean = 0.0;
    for [foot, tip] in hairs(&mesh) {
        assert!(foot.z.abs() < 1e-9 && foot.x.abs() <= 10.0 && (0.0..=20.0).contains(&foot.y));
        // They stand on the adaxial face and lean to the apex, within 30°.
        assert!(tip.z > 0.1 && tip.y > foot.y, "{foot} {tip}");
        let reach = tip.distance(foot);
        assert!((0.9 * 0.6..=1.0 + 1e-9).contains(&reach), "{reach}");
        mean += reach;
    }
    mean /= mesh.count() as f64;
    // A bent hair's chord is a little shorter than the hair.
    assert!((0.76..=0.8).contains(&mean), "{mean}");
    let below = HairPlan {
        adaxial_per_mm2: 0.0,
        abaxial_per_mm2: 3.0,
        ..plan
    };
    let below = below.grow(&blade, &[], 0.1, 7).expect("a good plan");
    assert!(hairs(&below).iter().all(|[_, tip]| tip.z < -0.1));
}

#[test]
fn a_fringe_stands_along_the_margin_and_points_outwards() {
    let plan = HairPlan {
        adaxial_per_mm2: 0.0,
        fringe_per_mm: 4.0,
        ..plan()
    };
    let mesh = plan.grow(&blade(&[]), &[], 0.1, 1).expect("a good plan");
    let expected = 4.0 * 4.0 * SIDE;
    assert!(
        (mesh.count() as f64 / expected - 1.0).abs() < 0.05,
        "{}",
        mesh.count()
    );
    let beyond = |p: DVec3| (p.x.abs() - 10.0).max(-p.y).max(p.y - 20.0);
    for [foot, tip] in hairs(&mesh) {
        assert!(beyond(foot).abs() < 0.02, "{foot}");
        assert!(beyond(tip) > 0.1, "{tip}");
    }
}

#[test]
fn hairs_of_veins_stand_on_veins_and_the_others_between() {
    let vein = VeinSegment {
        from: DVec2::ZERO,
        to: DVec2::new(0.0, 18.0),
        radius_from: 0.5,
        radius_to: 0.5,
        order: 1,
    };
    let blade = blade(&[vein]);
    for (place, on_vein) in [(HairPlace::Veins, true), (HairPlace::Between, false)] {
        let plan = HairPlan { place, ..plan() };
        let mesh = plan.grow(&blade, &[vein], 0.1, 1).expect("a good plan");
        assert!(mesh.count() > 20);
        for [foot, _] in hairs(&mesh) {
            let near = foot.x.abs() <= 0.75 && foot.y <= 18.75;
            assert!(near || !on_vein, "{foot}");
            assert!(!near || on_vein || foot.y > 17.9, "{foot}");
        }
    }
}

#[test]
fn hairs_are_closed_outwards_and_the_same_again() {
    let (blade, plan) = (blade(&[]), plan());
    let mesh = plan.grow(&blade, &[], 0.1, 7).expect("a good plan");
    assert_eq!(mesh, plan.grow(&blade, &[], 0.1, 7).expect("a good plan"));
    assert_ne!(mesh, plan.grow(&blade, &[], 0.1, 8).expect("a good plan"));
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|v| mesh.positions[v as usize]);
        let normal = (b - a).cross(c - a);
        let sum: DVec3 = triangle[..2]
            .iter()
            .map(|&v| mesh.normals[v as usize])
            .sum();
        assert!(normal.dot(sum) > 0.0);
    }
}

#[test]
fn too_many_hairs_are_refused_and_so_are_bad_numbers() {
    let blade = blade(&[]);
    let dense = HairPlan {
        adaxial_per_mm2: 1000.0,
        abaxial_per_mm2: 1000.0,
        ..plan()
    };
    let message = dense
        .grow(&blade, &[], 0.1, 7)
        .expect_err("too many")
        .to_string();
    assert!(message.starts_with("number of hairs is 400"), "{message}");
    let bad = HairPlan {
        length_mm: f64::NAN,
        ..plan()
    };
    assert_eq!(bad.in_range().expect_err("no length").path, "hair_mm");
}
