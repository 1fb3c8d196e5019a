//! A smooth margin around cells.
//!
//! The contour runs half-way between cells of the leaf and cells outside and cuts corners. It never
//! touches itself, and cells that touch by a corner stay connected. Its steps are then smoothed by
//! Taubin's filter (\[taubin1995\]), which removes detail finer than a few cells and, unlike plain
//! averaging, does not shrink the rest.

use glam::DVec2;

use super::cells::{Cell, CellIndex, NONE};

/// Number of rounds of smoothing.
const ROUNDS: usize = 60;

/// Share by which a point moves towards the middle of its neighbours, and then away from it.
/// Wavelengths above about ten cells pass unchanged.
const TO_AND_FRO: [f64; 2] = [0.5, -0.526];

/// The outermost contour of cells that are connected by edges or corners, counter-clockwise, in
/// cells. Holes are filled.
pub(crate) fn contour(cells: &[Cell]) -> Vec<DVec2> {
    let mut index = CellIndex::new();
    for (number, &cell) in (0..).zip(cells) {
        index.set(cell, number);
    }
    let inside = |cell: Cell| index.get(cell) != NONE;
    let Some(&lowest) = cells.iter().min_by_key(|cell| (cell.n, cell.m)) else {
        return Vec::new();
    };
    // The state of the walk: a cell of the leaf and the step to a neighbour outside. The leaf lies
    // to the left.
    let start = (lowest, Cell::new(0, -1));
    let (mut cell, mut out) = start;
    let mut points = Vec::new();
    loop {
        points.push(place(cell) + 0.5 * place(out));
        let ahead = Cell::new(-out.n, out.m);
        if inside(cell + ahead + out) {
            cell = cell + ahead + out;
            out = Cell::ROOT - ahead;
        } else if inside(cell + ahead) {
            cell = cell + ahead;
        } else {
            out = ahead;
        }
        if (cell, out) == start {
            return points;
        }
    }
}

/// The contour with its steps smoothed; no point moves farther than `most` cells.
pub(crate) fn smoothed(contour: &[DVec2], most: f64) -> Vec<DVec2> {
    let count = 2 * contour.len();
    let before: Vec<DVec2> = (0..count)
        .map(|i| {
            let (here, next) = (contour[i / 2], contour[(i / 2 + 1) % contour.len()]);
            if i % 2 == 0 {
                here
            } else {
                0.5 * (here + next)
            }
        })
        .collect();
    let mut points = before.clone();
    for _ in 0..ROUNDS {
        for share in TO_AND_FRO {
            let moved = |i: usize| {
                let around = points[(i + count - 1) % count] + points[(i + 1) % count];
                points[i] + share * (0.5 * around - points[i])
            };
            points = (0..count).map(moved).collect();
        }
    }
    let tethered = |(now, was): (DVec2, &DVec2)| *was + (now - *was).clamp_length_max(most);
    points.into_iter().zip(&before).map(tethered).collect()
}

/// The centre of a cell.
pub(crate) fn place(cell: Cell) -> DVec2 {
    DVec2::new(f64::from(cell.m), f64::from(cell.n))
}

/// Where the ray from `start` first meets a closed polygon.
pub(crate) fn first_hit(polygon: &[DVec2], start: DVec2, direction: DVec2) -> Option<DVec2> {
    let nearest = hits(polygon, start, direction).min_by(f64::total_cmp)?;
    Some(start + direction * (nearest / direction.length_squared()))
}

/// Whether a point lies inside a closed polygon.
pub(crate) fn is_inside(polygon: &[DVec2], point: DVec2) -> bool {
    hits(polygon, point, DVec2::Y).count() % 2 == 1
}

/// Where a ray meets the edges of a closed polygon, as multiples of `direction`.
fn hits(polygon: &[DVec2], start: DVec2, direction: DVec2) -> impl Iterator<Item = f64> + '_ {
    let edges = (0..polygon.len()).map(|i| (polygon[i], polygon[(i + 1) % polygon.len()]));
    edges.filter_map(move |(a, b)| {
        let (side_a, side_b) = (direction.perp_dot(a - start), direction.perp_dot(b - start));
        // Edges are half-open, so that a ray through a corner meets only one of its two edges.
        let crosses = (side_a < 0.0) != (side_b < 0.0);
        let at = a + (b - a) * (side_a / (side_a - side_b));
        let along = direction.dot(at - start);
        (crosses && along > 0.0).then_some(along)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(points: &[DVec2]) -> f64 {
        let next = |i: usize| points[(i + 1) % points.len()];
        let twice: f64 = (0..points.len()).map(|i| points[i].perp_dot(next(i))).sum();
        0.5 * twice
    }

    #[test]
    fn the_contour_of_a_rectangle_cuts_its_corners_only() {
        let cells: Vec<Cell> = (0..5)
            .flat_map(|m| (0..7).map(move |n| Cell::new(m, n)))
            .collect();
        let around = contour(&cells);
        assert_eq!(around.len(), 24);
        assert_eq!(area(&around), 35.0 - 4.0 / 8.0);
        let smooth = smoothed(&around, 0.45);
        assert!((area(&smooth) / 35.0 - 1.0).abs() < 0.03);
    }

    #[test]
    fn cells_that_touch_by_a_corner_stay_together_and_holes_are_filled() {
        let diagonal = [(0, 0), (1, 1), (2, 0)].map(|(m, n)| Cell::new(m, n));
        assert_eq!(contour(&diagonal).len(), 12);

        assert_eq!(area(&contour(&diagonal)), 3.0 * 0.5 + 2.0 * 0.5);
        let ring: Vec<Cell> = Cell::ROOT.neighbours().collect();
        assert_eq!(area(&contour(&ring)), 9.0 - 0.5);
    }

    #[test]
    fn a_long_wave_passes_and_the_steps_of_the_grid_do_not() {
        let disc: Vec<Cell> = (-30..=30)
            .flat_map(|m| (-30..=30).map(move |n| Cell::new(m, n)))
            .filter(|cell| cell.squared() <= 28 * 28)
            .collect();
        let smooth = smoothed(&contour(&disc), 0.45);
        let radius = (disc.len() as f64 / std::f64::consts::PI).sqrt();
        assert!((area(&smooth) / disc.len() as f64 - 1.0).abs() < 0.005);
        for p in smooth {
            assert!((p.length() - radius).abs() < 0.5, "{p}");
        }
    }

    #[test]
    fn a_ray_meets_the_nearest_edge_once() {
        let square = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)].map(DVec2::from);
        let hit = |start: (f64, f64), way: (f64, f64)| first_hit(&square, start.into(), way.into());
        assert_eq!(hit((0.5, 1.0), (3.0, 0.0)), Some(DVec2::new(2.0, 1.0)));
        assert_eq!(hit((1.0, 1.0), (0.5, 0.5)), Some(DVec2::new(2.0, 2.0)));
        assert_eq!(hit((3.0, 1.0), (1.0, 0.0)), None);
        assert!(is_inside(&square, DVec2::new(1.0, 0.5)));
        assert!(!is_inside(&square, DVec2::new(1.0, -0.5)));
    }
}
