use super::*;
use crate::mosaic::shapes::{Shape, rounded_cube, sphere};
use crate::random::{self, Use};

pub(in crate::mosaic) fn surface(shape: Shape) -> Surface {
    Surface::new(shape.positions, shape.faces).expect("shapes are surfaces")
}

/// Cells at random places.
pub(in crate::mosaic) fn scattered(surface: &Surface, cells: u64, seed: u64) -> Vec<SurfacePoint> {
    (0..cells)
        .map(|i| {
            surface.sample([0, 1, 2].map(|k| random::uniform(seed, Use::PatternProbe, 3 * i + k)))
        })
        .collect()
}

/// Checks that pieces fill the faces. Random cells are a harder case than evenly spread ones.
fn check_fills(surface: &Surface, cells: u64) {
    let sites = scattered(surface, cells, 7);
    let voronoi = Voronoi::new(surface, &sites);
    let sum: f64 = voronoi.areas().iter().sum();
    let total = surface.total_area();
    assert!((sum / total - 1.0).abs() < 1e-9, "{sum} of {total}");
    assert!(voronoi.areas().iter().all(|&area| area > 0.0));
    for face in 0..surface.faces().len() as u32 {
        let filled: f64 = voronoi.pieces(face).iter().map(Piece::area).sum();
        assert!((filled / surface.area(face) - 1.0).abs() < 1e-9);
    }
    for cell in 0..sites.len() as u32 {
        for &(beside, length) in voronoi.neighbours(cell) {
            let back = voronoi.neighbours(beside).iter();
            let theirs = back
                .filter(|(other, _)| *other == cell)
                .map(|(_, l)| l)
                .sum::<f64>();
            assert!((theirs - length).abs() < 1e-9, "borders belong to both");
        }
    }
}

#[test]
fn the_polygons_of_all_cells_fill_the_surface() {
    check_fills(&surface(sphere(20.0, 2.0).expect("good sizes")), 700);
    check_fills(&surface(sphere(20.0, 9.0).expect("good sizes")), 300);
    check_fills(
        &surface(rounded_cube(30.0, 4.0, 1.5).expect("good sizes")),
        40,
    );
    check_fills(&surface(sphere(5.0, 2.0).expect("good sizes")), 1);
}

#[test]
fn on_a_flat_sheet_the_piece_under_a_point_belongs_to_the_nearest_cell() {
    let positions = (0..=10)
        .flat_map(|i| (0..=10).map(move |j| DVec3::new(f64::from(i), f64::from(j), 0.0)))
        .collect();
    let faces = (0..10)
        .flat_map(|i| (0..10).map(move |j| 11 * i + j))
        .flat_map(|v| [[v, v + 11, v + 12], [v, v + 12, v + 1]])
        .collect();
    let sheet = Surface::new(positions, faces).expect("a sheet");
    let sites = scattered(&sheet, 60, 1);
    let voronoi = Voronoi::new(&sheet, &sites);
    for probe in scattered(&sheet, 2000, 2) {
        let p = sheet.position(&probe);
        let nearest = (0..sites.len())
            .min_by(|&a, &b| {
                let to = |i: usize| sheet.position(&sites[i]).distance_squared(p);
                to(a).total_cmp(&to(b))
            })
            .expect("there are cells") as u32;
        let flat = sheet.flat(&probe);
        assert_eq!(voronoi.nearest(probe.face, flat), Some(nearest));
        let holding = voronoi
            .pieces(probe.face)
            .iter()
            .find(|piece| {
                piece
                    .edges()
                    .all(|(a, b, _)| (b - a).perp_dot(flat - a) >= -1e-12)
            })
            .expect("pieces fill the face");
        assert_eq!(holding.cell, nearest);
    }
    let area: f64 = voronoi
        .polygons(&sheet)
        .map(|polygon| polygon.corners.len() as f64)
        .sum();
    assert!(area >= 3.0 * 200.0, "each face has at least one polygon");
}

#[test]
fn the_two_faces_of_a_blade_do_not_share_cells() {
    let corners = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)];
    let sheet = Surface::new(
        corners.map(|(x, y)| DVec3::new(x, y, 0.0)).to_vec(),
        vec![[0, 1, 2], [0, 2, 3]],
    )
    .expect("a sheet");
    let (sheet, _) = sheet.subdivided(1.0).expect("a good length");
    let both = Surface::both_faces(&sheet).expect("a small sheet");
    let middle = sheet.sample([0.4, 0.5, 0.5]);
    let behind = SurfacePoint {
        face: middle.face + sheet.faces().len() as u32,
        barycentric: [
            middle.barycentric[0],
            middle.barycentric[2],
            middle.barycentric[1],
        ],
    };
    let voronoi = Voronoi::new(&both, &[middle, behind]);
    // Each cell gets its own side, since the way around the margin is equally long from both.
    for area in voronoi.areas() {
        assert!((area - 100.0).abs() < 5.0, "{area}");
    }
}

#[test]
fn cells_at_one_place_go_to_the_first_and_no_cells_leave_all_empty() {
    let ball = surface(sphere(5.0, 2.0).expect("good sizes"));
    let site = ball.centre(3);
    let voronoi = Voronoi::new(&ball, &[site, site]);
    assert!(voronoi.areas()[0] > 300.0 && voronoi.areas()[1] == 0.0);
    let empty = Voronoi::new(&ball, &[]);
    assert!(empty.pieces(0).is_empty() && empty.nearest(0, DVec2::ZERO).is_none());
}

#[test]
fn far_from_all_cells_the_nearest_is_still_found() {
    // Cells along one side of a long strip: its other end is forty mean distances away.
    let corners =
        (0..=12).flat_map(|row| [0.0, 4.0].map(|x| DVec3::new(x, 4.0 * f64::from(row), 0.0)));
    let faces =
        (0..12).flat_map(|row| [[0, 1, 3], [0, 3, 2]].map(|face| face.map(|id| id + 2 * row)));
    let strip = Surface::new(corners.collect(), faces.collect()).expect("a strip");
    let strip = strip.subdivided(0.8).expect("a good length").0;
    let low: Vec<SurfacePoint> = scattered(&strip, 4000, 3)
        .into_iter()
        .filter(|point| strip.position(point).y < 2.0)
        .collect();
    assert!(low.len() > 60);
    let voronoi = Voronoi::new(&strip, &low);
    let total: f64 = voronoi.areas().iter().sum();
    assert!((total / strip.total_area() - 1.0).abs() < 1e-9, "{total}");
    for probe in scattered(&strip, 500, 4) {
        let at = strip.position(&probe);
        let found = voronoi.nearest(probe.face, strip.flat(&probe));
        let found = found.expect("a cell for every place");
        let to = |cell: &SurfacePoint| strip.position(cell).distance(at);
        let least = low.iter().map(to).fold(f64::INFINITY, f64::min);
        let off = to(&low[found as usize]) - least;
        assert!(off < 1e-9, "{at}: {off} mm too far");
    }
}
