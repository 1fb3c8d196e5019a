//! How far it is to the nearest of many segments, fast at millions of points.

use glam::DVec2;

use super::frame::UvFrame;

/// Distances to segments over a frame.
///
/// A grid knows the segment nearest to the centre of each cell: cells that a segment crosses are
/// seeded with it, two sweeps hand candidates on to all eight neighbours, compared by true distance
/// (the vector distance transform of \[danielsson1980\]). A query takes the least of the exact
/// distances to the segments of the four cells around it. It is never less than the true distance.
/// It is more only where the nearest segment is nearest to no cell centre nearby; the error is then
/// below a cell's width.
///
/// \[danielsson1980\] Computer Graphics and Image Processing 14:227.
#[derive(Clone, Debug)]
pub(super) struct Distances {
    segments: Vec<[DVec2; 2]>,
    origin: DVec2,
    cell: f64,
    columns: usize,
    rows: usize,
    nearest: Vec<u32>,
}

const NONE: u32 = u32::MAX;

impl Distances {
    /// Sorts segments; the frame says where distances will be asked for.
    pub(super) fn new(segments: Vec<[DVec2; 2]>, frame: &UvFrame) -> Self {
        // About three cells a side for each segment of a net that fills the frame.
        let wanted = 3.0 * (segments.len() as f64).sqrt();
        let cell = frame.size.max_element() / wanted.clamp(192.0, 1024.0);
        let cells = |side: f64| (side / cell) as usize + 3;
        let (columns, rows) = (cells(frame.size.x), cells(frame.size.y));
        let mut field = Self {
            segments,
            origin: frame.min - DVec2::splat(cell),
            cell,
            columns,
            rows,
            nearest: vec![NONE; columns * rows],
        };
        field.seed();
        field.sweep();
        field
    }

    fn centre(&self, cell: usize) -> DVec2 {
        let (column, row) = (cell % self.columns, cell / self.columns);
        self.origin + self.cell * DVec2::new(column as f64 + 0.5, row as f64 + 0.5)
    }

    /// Squared distance of a point to a segment; infinite to none.
    fn square(&self, segment: u32, p: DVec2) -> f64 {
        let Some(&[from, to]) = self.segments.get(segment as usize) else {
            return f64::INFINITY;
        };
        let (along, offset) = (to - from, p - from);
        let length = along.length_squared();
        let share = if length > 0.0 {
            (offset.dot(along) / length).clamp(0.0, 1.0)
        } else {
            0.0
        };
        (offset - share * along).length_squared()
    }

    fn offer(&mut self, cell: usize, segment: u32) {
        let centre = self.centre(cell);
        if self.square(segment, centre) < self.square(self.nearest[cell], centre) {
            self.nearest[cell] = segment;
        }
    }

    fn seed(&mut self) {
        for index in 0..self.segments.len() {
            let [from, to] = self.segments[index];
            let steps = ((to - from).length() / (0.5 * self.cell)) as usize + 1;
            for step in 0..=steps {
                let p = from.lerp(to, step as f64 / steps as f64);
                // What lies outside counts at the edge; a float below 0 becomes the index 0.
                let place = (p - self.origin) / self.cell;
                let column = (place.x as usize).min(self.columns - 1);
                let row = (place.y as usize).min(self.rows - 1);
                self.offer(row * self.columns + column, index as u32);
            }
        }
    }

    /// From the first cell to the last and back, each time from all cells around.
    fn sweep(&mut self) {
        let (columns, rows) = (self.columns, self.rows);
        for pass in 0..4 {
            for number in 0..columns * rows {
                let cell = if pass % 2 == 0 {
                    number
                } else {
                    columns * rows - 1 - number
                };
                let (column, row) = (cell % columns, cell / columns);
                for r in row.saturating_sub(1)..=(row + 1).min(rows - 1) {
                    for c in column.saturating_sub(1)..=(column + 1).min(columns - 1) {
                        let candidate = self.nearest[r * columns + c];
                        if candidate != self.nearest[cell] {
                            self.offer(cell, candidate);
                        }
                    }
                }
            }
        }
    }

    /// Distance of a point (mm) to the nearest segment; infinite if there are none.
    pub(super) fn at(&self, p: DVec2) -> f64 {
        let place = (p - self.origin) / self.cell - DVec2::splat(0.5);
        let column = (place.x.max(0.0) as usize).min(self.columns - 2);
        let row = (place.y.max(0.0) as usize).min(self.rows - 2);
        let first = row * self.columns + column;
        let mut least = f64::INFINITY;
        let mut before = NONE;
        for cell in [
            first,
            first + 1,
            first + self.columns,
            first + self.columns + 1,
        ] {
            let segment = self.nearest[cell];
            if segment != before {
                least = least.min(self.square(segment, p));
                before = segment;
            }
        }
        least.sqrt()
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const FRAME: UvFrame = UvFrame {
        min: DVec2::new(-10.0, 0.0),
        size: DVec2::new(20.0, 30.0),
    };

    proptest! {
        #[test]
        fn distances_are_those_of_a_search_over_all_segments_within_a_cell(
            ends in prop::collection::vec((-10.0..10.0, 0.0..30.0, -3.0..3.0, -3.0..3.0), 1..40),
            points in prop::collection::vec((-10.0..10.0, 0.0..30.0), 50),
        ) {
            let segments: Vec<[DVec2; 2]> = ends.iter()
                .map(|&(x, y, dx, dy)| [DVec2::new(x, y), DVec2::new(x + dx, y + dy)]).collect();
            let field = Distances::new(segments.clone(), &FRAME);
            for (x, y) in points {
                let p = DVec2::new(x, y);
                let all = (0..segments.len() as u32).map(|i| field.square(i, p)).fold(f64::INFINITY, f64::min).sqrt();
                let found = field.at(p);
                prop_assert!(found >= all && found <= all + field.cell, "{found} for {all}");
            }
        }
    }

    #[test]
    fn without_segments_everything_is_infinitely_far() {
        assert_eq!(
            Distances::new(Vec::new(), &FRAME).at(DVec2::ONE),
            f64::INFINITY
        );
    }
}
