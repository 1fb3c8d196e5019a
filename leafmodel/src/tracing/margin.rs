//! The margin of a silhouette: the line between its pixels and those outside.

use glam::DVec2;

use super::curves::{smooth_ring, within_bound};
use super::grid::Mask;

/// The outer line around a connected set, in pixels, counter-clockwise as seen with y down, through
/// the middles of the sides between pixels inside and outside. Pixels that only touch at corners
/// are kept apart.
pub(super) fn boundary(set: &Mask) -> Vec<DVec2> {
    let Some(first) = set.cells.iter().position(|cell| *cell) else {
        return Vec::new();
    };
    let row = set.stride as isize;
    // Ways along sides: right, down, left, up; the set is on the right of each, so that the line
    // runs clockwise on the screen.
    let ways = [DVec2::X, DVec2::Y, -DVec2::X, -DVec2::Y];
    // The cells to the right and to the left ahead of a corner, for each way, from the cell whose
    // upper left corner it is.
    let right_of = [0, -1, -1 - row, -row];
    let left_of = [-row, 0, -1, -1 - row];
    let (x, y) = set.pixel(first);
    let start = (DVec2::new(x as f64, y as f64), 0_usize);
    let cell_of = |corner: DVec2| (corner.y as usize + 1) * set.stride + corner.x as usize + 1;
    let is_in = |corner: DVec2, step: isize| set.cells[cell_of(corner).wrapping_add_signed(step)];
    let mut points = Vec::new();
    let (mut corner, mut way) = start;
    loop {
        points.push(corner + ways[way] * 0.5);
        corner += ways[way];
        way = if !is_in(corner, right_of[way]) {
            (way + 1) % 4
        } else if is_in(corner, left_of[way]) {
            (way + 3) % 4
        } else {
            way
        };
        if (corner, way) == start {
            return points;
        }
    }
}

/// The line smoothed, with as few points as leave none of it farther off than `bound`, pixels.
pub(super) fn simplified(line: &[DVec2], bound: f64) -> Vec<DVec2> {
    let smooth = smooth_ring(line);
    // Halves are simplified on their own: from the first point and the one farthest from it.
    let far = (0..smooth.len())
        .max_by(|&a, &b| {
            let off = |i: usize| smooth[i].distance_squared(smooth[0]);
            off(a).total_cmp(&off(b)).then(b.cmp(&a))
        })
        .unwrap_or(0);
    let mut closed = smooth;
    closed.extend(closed.first().copied());
    let mut kept = vec![0];
    within_bound(&closed, 0, far, bound, &mut kept);
    kept.push(far);
    within_bound(&closed, far, closed.len() - 1, bound, &mut kept);
    kept.into_iter().map(|i| closed[i]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn measures(line: &[DVec2]) -> (f64, f64) {
        let pairs = || line.iter().zip(line.iter().cycle().skip(1));
        let area: f64 = pairs().map(|(a, b)| 0.5 * a.perp_dot(*b)).sum();
        (area, pairs().map(|(a, b)| a.distance(*b)).sum())
    }

    #[test]
    fn the_line_around_pixels_encloses_them() {
        let set = Mask::new(7, 5, |x, y| {
            (1..6).contains(&x) && (1..4).contains(&y) && (x, y) != (3, 2)
        });
        let line = boundary(&set);
        assert_eq!(line.len(), 16);
        // Cut corners are an eighth of a pixel each.
        assert!((measures(&line).0 - 14.5).abs() < 1e-12);
        let corner = Mask::new(4, 4, |x, y| (x, y) == (1, 1) || (x, y) == (2, 2));
        assert_eq!(boundary(&corner).len(), 4);
    }

    #[test]
    fn an_ellipse_has_its_area_and_perimeter() {
        let (a, b) = (170.3, 61.7);
        let set = Mask::new(400, 150, |x, y| {
            let p = DVec2::new(x as f64 + 0.5 - 200.0, y as f64 + 0.5 - 75.0);
            (p.x / a).powi(2) + (p.y / b).powi(2) < 1.0
        });
        let (area, perimeter) = measures(&simplified(&boundary(&set), 0.25));
        // Ramanujan's second formula, exact here to ten digits.
        let h = ((a - b) / (a + b)).powi(2);
        let around =
            std::f64::consts::PI * (a + b) * (1.0 + 3.0 * h / (10.0 + (4.0 - 3.0 * h).sqrt()));
        assert!(
            (area / (std::f64::consts::PI * a * b) - 1.0).abs() < 2e-3,
            "{area}"
        );
        assert!(
            (perimeter / around - 1.0).abs() < 3e-3,
            "{perimeter} {around}"
        );
    }
}
