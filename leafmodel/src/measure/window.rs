//! The largest upright rectangle within a blade and the hull of some points.

use glam::DVec2;

use crate::plane::{bounds, polygon, turn};
use crate::shape::outline::Outline;

/// Cells along the longer side of the raster.
const CELLS: usize = 192;

/// Lower left and upper right corner, mm, of the largest rectangle of a raster of 192 cells along
/// the longer side whose cells lie within the convex hull of the points and, if there is one, within
/// the margin. `None` if no cell does.
pub(super) fn largest(points: &[DVec2], outline: Option<&Outline>) -> Option<(DVec2, DVec2)> {
    let hull = polygon::hull(points);
    if hull.len() < 3 {
        return None;
    }
    let (low, high) = bounds(hull.iter().copied());
    let cell = (high - low).max_element() / CELLS as f64;
    let columns = (((high.x - low.x) / cell) as usize).max(1);
    let rows = (((high.y - low.y) / cell) as usize).max(1);
    let corner = |column: usize, row: usize| low + DVec2::new(column as f64, row as f64) * cell;
    let is_inside = |p: DVec2| {
        polygon::sides(&hull).all(|(a, b)| turn(a, b, p) >= 0.0)
            && outline.is_none_or(|outline| outline.contains(p))
    };
    let width = columns + 1;
    let inside: Vec<bool> = (0..width * (rows + 1))
        .map(|i| is_inside(corner(i % width, i / width)))
        .collect();
    let is_free = |column: usize, row: usize| {
        let four = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(dx, dy)| (column + dx, row + dy));
        four.iter().all(|&(x, y)| inside[y * width + x])
            && (0..4).all(|i| {
                let ((ax, ay), (bx, by)) = (four[i], four[(i + 1) % 4]);
                outline.is_none_or(|outline| !outline.is_crossed_by(corner(ax, ay), corner(bx, by)))
            })
    };
    // For each row the height of free cells above each column; the largest rectangle under them.
    let mut heights = vec![0_usize; columns];
    let mut best: Option<(usize, [usize; 4])> = None;
    for row in 0..rows {
        for (column, height) in heights.iter_mut().enumerate() {
            *height = if is_free(column, row) { *height + 1 } else { 0 };
        }
        let mut open: Vec<(usize, usize)> = Vec::new();
        for column in 0..=columns {
            let height = heights.get(column).copied().unwrap_or(0);
            let mut start = column;
            while let Some(&(left, tall)) = open.last().filter(|(_, tall)| *tall > height) {
                let area = tall * (column - left);
                if best.is_none_or(|(most, _)| area > most) {
                    best = Some((area, [left, row + 1 - tall, column, row + 1]));
                }
                start = left;
                open.pop();
            }
            if height > 0 && open.last().is_none_or(|(_, tall)| *tall < height) {
                open.push((start, height));
            }
        }
    }
    best.map(|(_, [left, bottom, right, top])| (corner(left, bottom), corner(right, top)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn circle(radius: f64) -> Vec<DVec2> {
        let corner = |i: i32| {
            let angle = std::f64::consts::TAU * f64::from(i) / 720.0;
            radius * DVec2::new(libm::cos(angle), libm::sin(angle))
        };
        (0..720).map(corner).collect()
    }

    #[test]
    fn the_largest_rectangle_in_a_circle_is_its_square() {
        let (low, high) = largest(&circle(5.0), None).expect("there is room");
        let area = (high - low).x * (high - low).y;
        // Twice the squared radius, less what a raster of 192 cells loses along four sides.
        assert!((47.0..=50.0).contains(&area), "{area}");
        assert!([low, high].iter().all(|p| p.length() <= 5.0));
    }

    #[test]
    fn the_margin_cuts_the_rectangle() {
        // A blade with a bay from the right almost to its left side.
        let corners = [
            (0.0, 0.0),
            (8.0, 0.0),
            (8.0, 3.0),
            (1.0, 3.5),
            (8.0, 4.0),
            (8.0, 10.0),
            (0.0, 10.0),
        ];
        let outline = Outline::new(
            corners.map(DVec2::from).to_vec(),
            (4.0, 0.0).into(),
            (4.0, 10.0).into(),
        )
        .expect("a margin");
        let points = [(0.0, 0.0), (8.0, 0.0), (8.0, 10.0), (0.0, 10.0)].map(DVec2::from);
        let (low, high) = largest(&points, Some(&outline)).expect("there is room");
        // The part above the bay: 8 by 6.
        let area = (high - low).x * (high - low).y;
        assert!(
            (45.0..=48.0).contains(&area) && low.y >= 3.9,
            "{low} {high}"
        );
        assert_eq!(largest(&points[..2], None), None);
    }
}
