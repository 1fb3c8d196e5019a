use std::collections::BTreeMap;
use std::sync::Arc;

use super::shape::creased;
use super::*;
use crate::grow_options::GrowOptions;
use crate::mosaic::plan::{CellType, MosaicPlan};
use crate::mosaic::shapes::ellipsoid;
use crate::mosaic::shapes::rounded_cube;
use crate::optics::{Constituent, Contents};

mod raised;

fn holding(chlorophyll: f64) -> Contents {
    Contents::of(&[(Constituent::Chlorophyll, chlorophyll)])
}

/// Cells of two types with 10 and 50 µg/cm² of chlorophyll.
fn pattern(blend_mm: f64) -> MosaicPattern {
    let kind = |name: &str, own: usize| CellType {
        name: name.to_owned(),
        division_days: 4.0,
        initial_probability: 0.5,
        switching: (0..2).map(|other| f64::from(other == own)).collect(),
        adhesion: vec![0.0, 0.0],
    };
    MosaicPattern {
        plan: MosaicPlan {
            initial_cells: 60,
            days: 4.0,
            types: vec![kind("pale", 0), kind("dark", 1)],
            ..MosaicPlan::default()
        },
        contents: vec![holding(10.0), holding(50.0)],
        blend_mm,
        faces: crate::mosaic::pattern::LeafFaces::Through,
    }
}

fn plan(shape: SolidShape, mosaic: Option<MosaicPattern>) -> SolidPlan {
    SolidPlan {
        shape,
        seed: 7,
        contents: holding(20.0),
        mosaic,
        raised: None,
        pigments: crate::optics::Pigments::default(),
        map_size: 256,
    }
}

fn closed_shapes() -> Vec<SolidShape> {
    let cube = rounded_cube(20.0, 4.0, 2.0).expect("a cube");
    let semi_axes_mm = DVec3::new(12.0, 10.0, 8.0);
    let profile = [
        [0.0, 0.0],
        [9.0, 4.0],
        [10.0, 12.0],
        [4.0, 20.0],
        [0.0, 22.0],
    ];
    vec![
        SolidShape::Ellipsoid { semi_axes_mm },
        SolidShape::RoundedCube {
            side_mm: 20.0,
            corner_radius_mm: 5.0,
        },
        SolidShape::Lathe {
            profile_mm: profile.map(DVec2::from_array).to_vec(),
        },
        SolidShape::Mesh(Arc::new(SolidMesh {
            file: "cube.ply".to_owned(),
            scale_mm: 1.0,
            shape: cube,
        })),
    ]
}

/// The closed bodies, each without a mosaic and with one.
fn bodies() -> Vec<Solid> {
    let plans = closed_shapes().into_iter().flat_map(|shape| {
        let patterned = plan(shape.clone(), Some(pattern(2.0)));
        [plan(shape, None), patterned]
    });
    plans.map(|plan| grow(&plan)).collect()
}

fn grow(plan: &SolidPlan) -> Solid {
    Solid::grow(plan).expect("a good plan")
}

/// The chlorophyll at texture coordinates: bilinear between texel centres, clamped.
fn chlorophyll(map: &ContentsMap, uv: DVec2) -> f64 {
    let along = |value: f64, count: u32| {
        let place = (value * f64::from(count) - 0.5).clamp(0.0, f64::from(count - 1));
        let below = place.floor();
        (below as u32, place - below)
    };
    let ((x, a), (y, b)) = (along(uv.x, map.width), along(uv.y, map.height));
    let texel = |x: u32, y: u32| {
        let (x, y) = (x.min(map.width - 1), y.min(map.height - 1));
        f64::from(map.texels[(y * map.width + x) as usize][Constituent::Chlorophyll])
    };
    let row = |y: u32| texel(x, y) * (1.0 - a) + texel(x + 1, y) * a;
    row(y) * (1.0 - b) + row(y + 1) * b
}

fn bits(at: DVec3) -> [u64; 3] {
    at.to_array().map(f64::to_bits)
}

#[test]
fn closed_bodies_are_watertight_and_turned_outwards() {
    for body in bodies() {
        // Each edge of each face has one that runs along it the other way, at the same places bit
        // for bit.
        let mut edges: BTreeMap<_, i32> = BTreeMap::new();
        let mut volume = 0.0;
        for &[a, b, c] in &body.triangles {
            let [p, q, r] = [a, b, c].map(|vertex| body.positions[vertex as usize]);
            volume += p.dot(q.cross(r)) / 6.0;
            for (from, to) in [(p, q), (q, r), (r, p)] {
                *edges.entry([bits(from), bits(to)]).or_default() += 1;
                *edges.entry([bits(to), bits(from)]).or_default() -= 1;
            }
            let face = (q - p).cross(r - p);
            for vertex in [a, b, c] {
                let normal = body.normals[vertex as usize];
                assert!((normal.length() - 1.0).abs() < 1e-12);
                assert!(normal.dot(face) > 0.5 * face.length(), "{normal} {face}");
            }
        }
        assert!(edges.values().all(|&count| count == 0), "an edge is open");
        assert!(volume > 0.0);
    }
}

#[test]
fn attributes_are_one_a_vertex_and_uvs_lie_in_the_map() {
    for body in bodies() {
        let count = body.positions.len();
        assert_eq!((body.normals.len(), body.uvs.len()), (count, count));
        let unit = 0.0..=1.0;
        let inside = |uv: &DVec2| unit.contains(&uv.x) && unit.contains(&uv.y);
        assert!(body.uvs.iter().all(inside));
        let texels = body.contents.width as usize * body.contents.height as usize;
        assert_eq!(body.contents.texels.len(), texels);
    }
}

#[test]
fn a_body_without_a_mosaic_holds_the_same_everywhere() {
    for shape in closed_shapes() {
        let body = grow(&plan(shape, None));
        assert!(body.mosaic.is_none());
        for &uv in &body.uvs {
            assert_eq!(chlorophyll(&body.contents, uv), 20.0);
        }
    }
}

#[test]
fn the_map_at_a_vertex_holds_what_its_cell_holds() {
    for shape in closed_shapes() {
        let body = grow(&plan(shape, Some(pattern(0.0))));
        let mosaic = body.mosaic.as_ref().expect("it has a mosaic");
        let sites = mosaic.cells.iter();
        let sites: Vec<(DVec3, u16)> = sites
            .map(|cell| (mosaic.surface.position(&cell.at), cell.kind))
            .collect();
        // Some texels, plus the difference between chords and arcs on these bodies.
        let clearance = 1.0;
        let (mut checked, mut dark) = (0, 0);
        for (&position, &uv) in body.positions.iter().zip(&body.uvs) {
            let nearest = |kind: u16| {
                let own = sites.iter().filter(|(_, other)| *other == kind);
                own.map(|(site, _)| site.distance(position))
                    .fold(f64::INFINITY, f64::min)
            };
            let (pale_mm, dark_mm) = (nearest(0), nearest(1));
            if (pale_mm - dark_mm).abs() > clearance {
                let expected = if dark_mm < pale_mm { 50.0 } else { 10.0 };
                assert_eq!(chlorophyll(&body.contents, uv), expected, "at {position}");
                checked += 1;
                dark += usize::from(dark_mm < pale_mm);
            }
        }
        assert!(
            3 * checked > body.positions.len(),
            "only {checked} vertices"
        );
        assert!(
            dark > checked / 10 && dark < 9 * checked / 10,
            "{dark} dark"
        );
    }
}

#[test]
fn charts_agree_along_the_edges_where_they_meet() {
    for shape in closed_shapes() {
        let body = grow(&plan(shape, Some(pattern(3.0))));
        // From the places of an edge's ends to the coordinates that each of its two faces has
        // there.
        let mut seams: BTreeMap<_, Vec<[DVec2; 2]>> = BTreeMap::new();
        for triangle in &body.triangles {
            for corner in 0..3 {
                let [from, to] = [corner, (corner + 1) % 3].map(|corner| triangle[corner] as usize);
                let (p, q) = (bits(body.positions[from]), bits(body.positions[to]));
                let (key, uvs) = if p < q {
                    ([p, q], [from, to])
                } else {
                    ([q, p], [to, from])
                };
                seams
                    .entry(key)
                    .or_default()
                    .push(uvs.map(|vertex| body.uvs[vertex]));
            }
        }
        let (mut worst, mut sum, mut count) = (0.0_f64, 0.0, 0);
        for faces in seams.values() {
            let [one, other] = faces.as_slice() else {
                panic!("an edge of {} faces", faces.len());
            };
            if one == other {
                continue;
            }
            for step in 0..=4 {
                let share = f64::from(step) / 4.0;
                let [one, other] = [one, other].map(|[from, to]| {
                    let uv = from.lerp(*to, share);
                    chlorophyll(&body.contents, uv) / 40.0
                });
                worst = worst.max((one - other).abs());
                sum += (one - other).abs();
                count += 1;
            }
        }
        let mean = sum / f64::from(count);
        eprintln!("{count} places: worst {worst:.4}, mean {mean:.5} of the range");
        // Some fifteen texels make a blend, which two grids of texels sample at different places.
        assert!(count > 100, "only {count} places");
        assert!(worst < 0.04 && mean < 0.0015, "worst {worst}, mean {mean}");
    }
}

#[test]
fn a_coarse_mesh_is_cut_fine_enough_for_its_cells_and_stays_closed_with_hard_edges() {
    // A tetrahedron whose faces share no vertices, each with its own normal.
    let corners = [
        DVec3::ZERO,
        DVec3::X * 20.0,
        DVec3::Y * 20.0,
        DVec3::Z * 20.0,
    ];
    let (mut positions, mut faces) = (Vec::new(), Vec::new());
    for face in [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]] {
        let first = positions.len() as u32;
        positions.extend(face.map(|corner: usize| corners[corner]));
        faces.push([first, first + 1, first + 2]);
    }
    let shape = SolidShape::Mesh(Arc::new(SolidMesh {
        file: "tetrahedron.obj".to_owned(),
        scale_mm: 1.0,
        shape: creased(&positions, &faces),
    }));
    let mut pattern = pattern(1.0);
    pattern.plan.initial_cells = 200;
    let body = grow(&plan(shape, Some(pattern)));
    assert!(body.triangles.len() > 200, "{}", body.triangles.len());
    let mut edges: BTreeMap<_, i32> = BTreeMap::new();
    for triangle in &body.triangles {
        let [p, q, r] = triangle.map(|vertex| body.positions[vertex as usize]);
        for (from, to) in [(p, q), (q, r), (r, p)] {
            *edges.entry([bits(from), bits(to)]).or_default() += 1;
            *edges.entry([bits(to), bits(from)]).or_default() -= 1;
        }
        let flat = (q - p).cross(r - p).normalize();
        for &vertex in triangle {
            assert!(body.normals[vertex as usize].distance(flat) < 1e-9);
        }
    }
    assert!(edges.values().all(|&count| count == 0), "an edge is open");
}

#[test]
fn a_body_has_the_same_bits_on_any_number_of_threads() {
    let plan = plan(closed_shapes().remove(0), Some(pattern(1.0)));
    let grown = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("threads").install(|| grow(&plan))
    };
    let one = grown(1);
    for threads in [2, 5] {
        let other = grown(threads);
        assert_eq!(one.contents, other.contents);
        assert_eq!(one.uvs, other.uvs);
        assert_eq!(one.positions, other.positions);
        assert_eq!(one.triangles, other.triangles);
    }
}

#[test]
fn growth_stops_when_asked_and_says_so() {
    let plan = plan(closed_shapes().remove(0), Some(pattern(1.0)));
    let stopped = GrowOptions::stopped_by(&|| true)
        .solid(&plan)
        .expect_err("it was stopped");
    assert!(stopped.is_stop());
    assert_eq!(stopped.to_string(), "mosaic: stopped");
}

#[test]
fn what_is_too_slender_for_triangles_is_refused_in_words_of_the_plan() {
    let semi_axes_mm = DVec3::new(1e5, 0.01, 0.01);
    let refused = Solid::grow(&plan(SolidShape::Ellipsoid { semi_axes_mm }, None));
    let refused = refused.expect_err("it is refused");
    assert!(refused.to_string().contains("less slender"), "{refused}");
}

#[test]
fn a_body_so_slender_that_its_cells_are_searched_for_minutes_is_refused_before() {
    // A needle, 10,000 times as long as wide, as a mesh of four faces.
    let needle = |length: f64| {
        let corners = [
            [0.0; 3],
            [10.0, 0.0, 0.0],
            [0.0, 10.0, length],
            [0.0, 0.0, 10.0],
        ];
        let positions: Vec<DVec3> = corners.into_iter().map(DVec3::from_array).collect();
        let faces = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        let shape = SolidShape::Mesh(Arc::new(SolidMesh {
            file: String::new(),
            scale_mm: 1.0,
            shape: creased(&positions, &faces),
        }));
        let mut pattern = pattern(0.0);
        pattern.plan.initial_cells = 50;
        pattern.plan.days = 3.0;
        SolidPlan {
            map_size: 32,
            ..plan(shape, Some(pattern))
        }
    };
    grow(&needle(1e3));
    // What it takes to refuse it is to cut it: no cell has been placed.
    let refused = GrowOptions::stopped_by(&|| panic!("cells grow already")).solid(&needle(1e5));
    let error = refused.expect_err("it takes minutes").to_string();
    let expected = "mosaic: the surface has 177148 triangles for ";
    assert!(error.starts_with(expected), "{error}");
    assert!(
        error.ends_with("make the body less slender, or its mesh coarser"),
        "{error}"
    );
}

#[test]
fn how_high_a_turned_body_lies_changes_nothing_but_that() {
    let area = |profile: &[[f64; 2]], up: f64| {
        let points = profile.iter().map(|&[x, y]| DVec2::new(x, y + up));
        let profile_mm = points.collect();
        SolidShape::Lathe { profile_mm }.area().expect("a body")
    };
    let round = [[0.0, -10.0], [10.0, 0.0], [0.0, 10.0]];
    let stem = [[5.0, 0.0], [5.0, 100.0], [5.0, 200.0]];
    let exact = std::f64::consts::TAU * 5.0 * 200.0;
    assert!((area(&stem, 0.0) / exact - 1.0).abs() < 0.1);
    for profile in [&round, &stem] {
        let low = area(profile, 0.0);
        for up in [-5000.0, 5000.0] {
            assert!((area(profile, up) / low - 1.0).abs() < 1e-9, "up {up}");
        }
    }
}

#[test]
fn a_profile_too_crumpled_to_be_measured_is_refused_in_words_of_the_plan() {
    // A profile that runs to and fro so often that its area takes too many triangles.
    let points = (0..8000).map(|i| {
        let radius = if i % 2 == 0 { 1.0 } else { 100.0 };
        DVec2::new(radius, 0.01 * f64::from(i))
    });
    let profile_mm = points.collect();
    let refused = Solid::grow(&plan(SolidShape::Lathe { profile_mm }, None));
    let refused = refused.expect_err("it is refused");
    assert!(refused.to_string().contains("less slender"), "{refused}");
}

#[test]
fn edges_of_a_mesh_without_normals_are_sharp_and_round_parts_smooth() {
    let corner = |i: u32| {
        let side = |bit: u32| if i & bit == 0 { -1.0 } else { 1.0 };
        DVec3::new(side(1), side(2), side(4))
    };
    let cube: Vec<DVec3> = (0..8).map(corner).collect();
    let quads = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let faces: Vec<[u32; 3]> = quads
        .iter()
        .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]])
        .collect();
    let sharp = creased(&cube, &faces);
    assert_eq!(sharp.positions.len(), 24);
    for face in &sharp.faces {
        let [a, b, c] = face.map(|vertex| sharp.positions[vertex as usize]);
        let flat = (b - a).cross(c - a).normalize();
        let leans = |&vertex: &u32| sharp.normals[vertex as usize].dot(flat);
        assert!(face.iter().map(leans).all(|cosine| cosine > 1.0 - 1e-12));
    }
    let ball = ellipsoid(DVec3::splat(10.0), 1.0).expect("a ball");
    let smooth = creased(&ball.positions, &ball.faces);
    assert_eq!(smooth.positions.len(), ball.positions.len());
    let off = smooth.positions.iter().zip(&smooth.normals);
    let least = off.map(|(p, n)| p.normalize().dot(*n));
    assert!(least.fold(1.0, f64::min) > 0.999);
}
