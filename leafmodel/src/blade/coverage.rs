//! The texels of a map that a blade can look up: those inside its margin and some beyond.

use glam::DVec2;

use super::frame::UvFrame;
use crate::plane::polygon;

/// Number of texels beyond the margin that are painted too, so that interpolation at the margin
/// uses the leaf's own contents.
const BEYOND: usize = 2;

/// A flag for each texel.
#[derive(Clone, Debug)]
pub(super) struct Coverage {
    width: usize,
    flags: Vec<bool>,
}

impl Coverage {
    /// The coverage of a closed margin (mm) on a map of `width × height` texels over a frame.
    /// Without a margin every texel is covered.
    pub(super) fn new(margin: &[DVec2], frame: &UvFrame, [width, height]: [usize; 2]) -> Self {
        let mut coverage = Self {
            width,
            flags: vec![margin.is_empty(); width * height],
        };
        // In texels: the centre of the first is at ½.
        let scale = DVec2::new(width as f64, height as f64) / frame.size;
        let places: Vec<DVec2> = margin.iter().map(|p| (*p - frame.min) * scale).collect();
        let mut crossings = vec![Vec::new(); height];
        for (from, to) in polygon::sides(&places) {
            coverage.border(from, to, height);
            // Rows whose centres lie from the lower end to below the upper.
            let (low, high) = if from.y <= to.y {
                (from, to)
            } else {
                (to, from)
            };
            let row = |y: f64| ((y - 0.5).ceil().max(0.0) as usize).min(height);
            for (number, crossings) in crossings[..row(high.y)]
                .iter_mut()
                .enumerate()
                .skip(row(low.y))
            {
                let share = (number as f64 + 0.5 - low.y) / (high.y - low.y);
                crossings.push(low.x + share * (high.x - low.x));
            }
        }
        for (row, mut crossings) in crossings.into_iter().enumerate() {
            crossings.sort_by(f64::total_cmp);
            for pair in crossings.chunks_exact(2) {
                let column = |x: f64| ((x - 0.5).ceil().max(0.0) as usize).min(width);
                let (first, end) = (column(pair[0]), column(pair[1]));
                coverage.flags[row * width..][first..end].fill(true);
            }
        }
        coverage
    }

    /// Texels about a side of the margin.
    fn border(&mut self, from: DVec2, to: DVec2, height: usize) {
        let steps = (2.0 * from.distance(to)).ceil().max(1.0);
        for step in 0..=steps as usize {
            let p = from.lerp(to, step as f64 / steps);
            // A float below 0 becomes the index 0.
            let span = |x: f64, count: usize| {
                let at = (x as usize).min(count - 1);
                at.saturating_sub(BEYOND)..(at + BEYOND + 1).min(count)
            };
            for row in span(p.y, height) {
                self.flags[row * self.width..][span(p.x, self.width)].fill(true);
            }
        }
    }

    /// The flags of a row.
    pub(super) fn row(&self, row: usize) -> &[bool] {
        &self.flags[row * self.width..][..self.width]
    }
}

/// Gives each texel that is not covered the value of the nearest covered one in its row. A row
/// without covered texels is left unchanged.
pub(super) fn extend<T: Copy>(texels: &mut [T], covered: &[bool]) {
    let found: Vec<usize> = (0..covered.len()).filter(|&i| covered[i]).collect();
    let mut next = 0;
    for i in 0..texels.len() {
        if found.is_empty() || covered[i] {
            continue;
        }
        while next < found.len() && found[next] < i {
            next += 1;
        }
        let before = next.checked_sub(1).map(|left| found[left]);
        let nearest = match (before, found.get(next)) {
            (Some(left), Some(&right)) if i - left <= right - i => left,
            (_, Some(&right)) => right,
            (Some(left), None) => left,
            (None, None) => continue,
        };
        texels[i] = texels[nearest];
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::outline::Outline;
    use crate::species::find;

    #[test]
    fn all_texels_of_the_leaf_and_two_beyond_are_covered_and_few_others() {
        let plan = find("maple").expect("a preset").plan();
        let outline: Outline = plan
            .outline
            .grow(plan.length_mm, plan.seed)
            .expect("a good outline");
        let frame = UvFrame::around(outline.points());
        let size = [173, 160];
        let coverage = Coverage::new(outline.points(), &frame, size);
        let texel = frame.size / DVec2::new(173.0, 160.0);
        let mut covered = 0;
        for row in 0..160 {
            for column in 0..173 {
                let uv = DVec2::new((column as f64 + 0.5) / 173.0, (row as f64 + 0.5) / 160.0);
                let p = frame.point(uv);
                let is_covered = coverage.row(row)[column];
                let distance = outline.distance_to_margin(p) / texel.max_element();
                if outline.contains(p) || distance < 1.4 {
                    assert!(is_covered, "{row} {column}");
                } else if distance > 4.5 {
                    assert!(!is_covered, "{row} {column}");
                }
                covered += usize::from(is_covered);
            }
        }
        assert!(covered < 173 * 160 * 7 / 10, "{covered}");
    }

    #[test]
    fn without_a_margin_all_is_covered() {
        let frame = UvFrame {
            min: DVec2::ZERO,
            size: DVec2::ONE,
        };
        let coverage = Coverage::new(&[], &frame, [4, 3]);
        assert!((0..3).all(|row| coverage.row(row) == [true; 4]));
    }

    #[test]
    fn what_is_not_covered_takes_the_nearest_value_of_its_row() {
        let covered = [false, true, false, false, false, true, false];
        let mut texels = [0, 1, 0, 0, 0, 5, 0];
        extend(&mut texels, &covered);
        assert_eq!(texels, [1, 1, 1, 1, 5, 5, 5]);
        let mut none = [3, 4];
        extend(&mut none, &[false, false]);
        assert_eq!(none, [3, 4]);
    }
}
