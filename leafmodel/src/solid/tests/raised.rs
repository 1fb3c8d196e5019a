//! Tissue that stands out.

use super::*;
use crate::solid::Raised;

const RADIUS_MM: f64 = 10.0;
const HEIGHT_MM: f64 = 0.8;

/// A ball of pale and dark cells, of which some stand out.
fn ball(raised: Option<Raised>) -> SolidPlan {
    let semi_axes_mm = DVec3::splat(RADIUS_MM);
    SolidPlan {
        raised,
        map_size: 512,
        ..plan(SolidShape::Ellipsoid { semi_axes_mm }, Some(pattern(0.0)))
    }
}

fn warts() -> Raised {
    Raised {
        heights_mm: vec![0.0, HEIGHT_MM],
        over_mm: 1.0,
    }
}

#[test]
fn tissue_rises_as_high_as_asked_and_the_rest_stays() {
    // Triangles cut the sphere; how deep, one shows on which no tissue is raised.
    let lies = |body: &Solid| {
        let within = body.positions.iter().map(|position| position.length());
        within.fold(f64::INFINITY, f64::min)
    };
    let level = Raised {
        heights_mm: vec![0.0; 2],
        ..warts()
    };
    let chord = RADIUS_MM - lies(&grow(&ball(Some(level))));
    assert!(chord < 0.05, "{chord}");
    let body = grow(&ball(Some(warts())));
    let mut seen = [0; 2];
    for (position, &uv) in body.positions.iter().zip(&body.uvs) {
        let high = position.length() - RADIUS_MM;
        assert!((-chord - 1e-9..=HEIGHT_MM + 1e-9).contains(&high), "{high}");
        let holds = chlorophyll(&body.contents, uv);
        if high > 0.05 {
            assert!(holds > 10.0, "pale tissue stands {high} mm out");
        }
        seen[0] += usize::from(holds == 10.0);
        seen[1] += usize::from(high > HEIGHT_MM - chord - 1e-9);
    }
    let count = body.positions.len();
    assert!(
        seen.iter().all(|&of| 10 * of > count),
        "{seen:?} of {count}"
    );
}

#[test]
fn a_body_with_warts_is_closed_and_its_normals_are_those_of_its_faces() {
    for shape in closed_shapes() {
        let raised = SolidPlan {
            raised: Some(warts()),
            ..plan(shape, Some(pattern(0.5)))
        };
        let body = grow(&raised);
        let mut edges: BTreeMap<_, i32> = BTreeMap::new();
        let mut around: BTreeMap<_, DVec3> = BTreeMap::new();
        for triangle in &body.triangles {
            let [p, q, r] = triangle.map(|vertex| body.positions[vertex as usize]);
            for (from, to) in [(p, q), (q, r), (r, p)] {
                *edges.entry([bits(from), bits(to)]).or_default() += 1;
                *edges.entry([bits(to), bits(from)]).or_default() -= 1;
            }
            for vertex in triangle {
                *around.entry(*vertex).or_default() += (q - p).cross(r - p);
            }
        }
        assert!(edges.values().all(|&count| count == 0), "an edge is open");
        let cosine = |(&vertex, sum): (&u32, &DVec3)| {
            let normal = body.normals[vertex as usize];
            assert!((normal.length() - 1.0).abs() < 1e-12);
            normal.dot(sum.normalize())
        };
        let cosines: Vec<f64> = around.iter().map(cosine).collect();
        let mean = cosines.iter().sum::<f64>() / cosines.len() as f64;
        let least = cosines.iter().copied().fold(1.0, f64::min);
        // Triangles are a third of a slope long, so that faces around a point differ where the slope
        // begins: 0.9985 and 0.859 on the worst body.
        assert!(mean > 0.998 && least > 0.85, "mean {mean}, least {least}");
    }
}

#[test]
fn heights_that_fit_no_mosaic_are_refused() {
    let refused = |plan: &SolidPlan| Solid::grow(plan).expect_err("it is refused").to_string();
    let without = SolidPlan {
        mosaic: None,
        ..ball(Some(warts()))
    };
    assert!(refused(&without).starts_with("raised: the body has no mosaic"));
    let of = |heights_mm: &[f64], over_mm: f64| {
        refused(&ball(Some(Raised {
            heights_mm: heights_mm.to_vec(),
            over_mm,
        })))
    };
    for (heights_mm, over_mm, wanted) in [
        (&[1.0][..], 1.0, "there are 2 cell types and heights for 1"),
        (
            &[0.0, 1001.0],
            1.0,
            "a height is 1001 mm, it must be from -1000 to 1000",
        ),
        (
            &[0.0, 1.0],
            0.0,
            "over_mm is 0, outside the values above 0 and up to 1000",
        ),
    ] {
        assert_eq!(of(heights_mm, over_mm), format!("raised: {wanted}"));
    }
    // A slope of a thousandth of a millimetre takes more triangles than there may be.
    let narrow = ball(Some(Raised {
        over_mm: 0.001,
        ..warts()
    }));
    let refused = narrow.memory_bytes().expect_err("too many");
    assert!(refused.to_string().contains("less slender"), "{refused}");
}
