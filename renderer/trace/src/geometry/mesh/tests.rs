use glam::{Vec2, Vec3};
use proptest::prelude::*;

use super::super::testing::{Numbers, alone, blade, ray_through};
use super::{DropCause, DroppedFaces, MeshError, TriangleMesh};
use properties::fixed;

fn square() -> (Vec<Vec3>, Vec<[u32; 3]>) {
    (
        vec![Vec3::ZERO, Vec3::X, Vec3::ONE, Vec3::Y],
        vec![[0, 1, 2], [0, 2, 3]],
    )
}

fn refused(positions: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> MeshError {
    TriangleMesh::new(positions, None, None, triangles)
        .map(|_| ())
        .expect_err("this is not a mesh")
}

#[test]
fn an_empty_mesh_is_refused() {
    let dropped = DroppedFaces::default();
    assert_eq!(
        refused(Vec::new(), Vec::new()),
        MeshError::Empty { given: 0, dropped }
    );
    let nothing_left = refused(
        vec![Vec3::ZERO, Vec3::X, Vec3::NAN],
        vec![[0, 1, 2], [0, 1, 1]],
    );
    assert_eq!(
        nothing_left,
        MeshError::Empty {
            given: 2,
            dropped: DroppedFaces {
                not_finite: 1,
                degenerate: 1,
                duplicate: 0,
                free_form: 0,
                first: Some((0, DropCause::NotFinite)),
            },
        }
    );
}

#[test]
fn an_index_out_of_range_is_named() {
    let (positions, mut triangles) = square();
    triangles.push([0, 1, 4]);
    let expected = MeshError::IndexOutOfRange {
        face: 2,
        index: 4,
        vertices: 4,
    };
    assert_eq!(refused(positions, triangles), expected);
}

#[test]
fn attributes_must_be_one_a_vertex() {
    let (positions, triangles) = square();
    let normals = Some(vec![Vec3::Z; 3]);
    let error = TriangleMesh::new(positions.clone(), normals, None, triangles.clone()).map(|_| ());
    assert!(matches!(
        error,
        Err(MeshError::AttributeCount {
            attribute: "normals",
            count: 3,
            ..
        })
    ));
    let error =
        TriangleMesh::new(positions, None, Some(vec![Vec2::ZERO; 5]), triangles).map(|_| ());
    assert!(matches!(
        error,
        Err(MeshError::AttributeCount {
            attribute: "uvs",
            count: 5,
            ..
        })
    ));
}

#[test]
fn more_than_a_hundredth_not_finite_is_refused_and_a_hundredth_is_not() {
    let mesh = blade(10, 10, 1.0, 1.0, Vec3::ZERO);
    let (mut positions, good) = (mesh.positions().to_vec(), mesh.triangles().to_vec());
    let nowhere = positions.len() as u32;
    positions.push(Vec3::NAN);
    for (bad, accepted) in [(2, true), (3, false)] {
        let mut triangles = good.clone();
        triangles.extend(vec![[5, nowhere, 7]; bad]);
        let mesh = TriangleMesh::new(positions.clone(), None, None, triangles);
        assert_eq!(mesh.is_ok(), accepted, "{bad} bad faces");
        if let Err(error) = mesh {
            assert!(
                error.to_string().contains("the first is face 200"),
                "{error}"
            );
        }
    }
}

#[test]
fn faces_without_area_are_left_out_and_counted_whatever_their_fraction() {
    let (positions, good) = square();
    let mut triangles = vec![[0, 0, 1]; 50];
    triangles.extend(&good);
    let mesh = TriangleMesh::new(positions.clone(), None, None, triangles).expect("two are left");
    assert_eq!(mesh.triangles(), good);
    assert_eq!(
        (mesh.dropped().degenerate, mesh.dropped().total()),
        (50, 50)
    );
    let none = refused(positions, vec![[0, 0, 1]; 50]);
    assert!(none.to_string().contains("50 without area"), "{none}");
}

#[test]
fn a_corner_at_the_end_of_the_world_is_refused() {
    let error = refused(vec![Vec3::ZERO, Vec3::X, Vec3::Y * 2e9], vec![[0, 1, 2]]);
    assert_eq!(
        error,
        MeshError::TooFar {
            face: 0,
            reach: 2e9
        }
    );
}

#[test]
fn a_small_mesh_far_from_its_origin_is_reported_that_it_has_lost_its_detail() {
    let far = |x: f32, y: f32| Vec3::new(1e7 + x, y, 0.0);
    let error = refused(
        vec![far(0.0, 0.0), far(0.3, 0.0), far(0.0, 0.3)],
        vec![[0, 1, 2]],
    );
    assert_eq!(error, MeshError::DetailLost { reach: 1e7 });
    // A line near by is only a line.
    let error = refused(vec![Vec3::ZERO, Vec3::X, 2.0 * Vec3::X], vec![[0, 1, 2]]);
    assert!(matches!(error, MeshError::Empty { .. }), "{error}");
}

#[test]
fn the_same_three_positions_are_one_face_whatever_the_vertices() {
    let mesh = blade(10, 10, 1.0, 1.0, Vec3::ZERO);
    let (mut positions, mut triangles) = (mesh.positions().to_vec(), mesh.triangles().to_vec());
    // The third face again, from vertices of its own, turned round, with −0 for 0.
    let [a, b, c] = triangles[2].map(|index| positions[index as usize]);
    let first = positions.len() as u32;
    positions.extend([c, b, a].map(|p| Vec3::select(p.cmpeq(Vec3::ZERO), -p, p)));
    triangles.insert(0, [first, first + 1, first + 2]);
    let mesh =
        TriangleMesh::new(positions, None, None, triangles.clone()).expect("one in 200 may go");
    assert_eq!(mesh.dropped().duplicate, 1);
    assert_eq!(mesh.dropped().first, Some((3, DropCause::Duplicate)));
    triangles.remove(3);
    assert_eq!(mesh.triangles(), triangles);
}

#[test]
fn tiny_and_thin_faces_are_kept() {
    for scale in [1e-12_f32, 1e-6, 1e6] {
        let positions = vec![
            Vec3::ZERO,
            Vec3::X * scale,
            Vec3::new(0.5, 1e-5, 0.0) * scale,
        ];
        let mesh =
            TriangleMesh::new(positions, None, None, vec![[0, 1, 2]]).expect("the face has area");
        assert_eq!(mesh.dropped(), DroppedFaces::default());
    }
}

proptest! {
    #![proptest_config(fixed(24))]

    #[test]
    fn bad_faces_among_good_ones_change_no_hit(seed in 0_u64..1 << 40) {
        let clean = blade(16, 16, 1.0, 1.0, Vec3::ZERO);
        let (mut positions, mut triangles) = (clean.positions().to_vec(), clean.triangles().to_vec());
        let bad = positions.len() as u32;
        positions.extend([Vec3::NAN, Vec3::INFINITY]);
        let mut numbers = Numbers::new(seed);
        for face in [[0, 1, bad], [3, bad + 1, 9], [4, 4, 4], [7, 20, 7], triangles[9]] {
            let at = numbers.below(triangles.len());
            triangles.insert(at, face);
        }
        let dirty = TriangleMesh::new(positions, None, None, triangles).expect("5 of 517 may go");
        prop_assert_eq!(dirty.dropped().total(), 5);
        let (clean, dirty) = (alone(clean), alone(dirty));
        for _ in 0..50 {
            let ray = ray_through(&mut numbers, &clean);
            prop_assert_eq!(clean.intersect(&ray).map(|hit| hit.t), dirty.intersect(&ray).map(|hit| hit.t));
        }
    }
}
