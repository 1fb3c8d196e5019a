//! Piecewise constant distributions in one and two dimensions.

/// An index for searches among rising borders (the cutpoint method, \[chen1974\]): it divides [0,
/// 1] into as many equal parts as there are borders and stores the range of borders for each. So a
/// search takes a few steps for any number of borders.
#[derive(Clone, Debug)]
pub struct Guide {
    /// For each part the number of borders in the parts before it; at the end the number of all
    /// borders.
    before: Box<[u32]>,
}

impl Guide {
    /// The index of rising borders within [0, 1], at least one and fewer than 2³².
    pub fn new<T: Copy + Into<f64>>(borders: &[T]) -> Self {
        let mut before = vec![0; borders.len() + 2];
        for &border in borders {
            before[Self::part(borders.len(), border.into()) + 1] += 1;
        }
        let mut sum = 0;
        for count in &mut before {
            sum += *count;
            *count = sum;
        }
        Self {
            before: before.into(),
        }
    }

    /// The number of borders ≤ `u`, which is in [0, 1]; `borders` must be those of which the guide
    /// was made.
    pub(crate) fn count_up_to<T: Copy + PartialOrd + Into<f64>>(
        &self,
        borders: &[T],
        u: T,
    ) -> usize {
        // The part is a monotonic function of the number, so all borders in earlier parts are
        // smaller and all in later ones greater, exactly.
        let part = Self::part(borders.len(), u.into());
        let [first, last] = [self.before[part], self.before[part + 1]].map(|count| count as usize);
        first + borders[first..last].partition_point(|&border| border <= u)
    }

    fn part(parts: usize, u: f64) -> usize {
        (u * parts as f64) as usize
    }
}

/// A piecewise constant distribution: steps of equal width over [0, 1) with given weights.
#[derive(Clone, Debug)]
pub struct Piecewise1d {
    /// Cumulative probabilities from 0 to 1, one more than there are steps.
    cumulative: Box<[f32]>,
    guide: Guide,
    mean: f64,
}

impl Piecewise1d {
    /// The distribution with these weights, each finite and ≥ 0. If all are zero it is uniform.
    pub fn new(weights: &[f32]) -> Self {
        let total: f64 = weights.iter().map(|&weight| f64::from(weight)).sum();
        let mut sum = 0.0;
        let cumulative: Box<[f32]> = std::iter::once(0.0)
            .chain(weights.iter().map(|&weight| {
                sum += if total > 0.0 {
                    f64::from(weight) / total
                } else {
                    1.0 / weights.len() as f64
                };
                sum.min(1.0) as f32
            }))
            .collect();
        Self {
            guide: Guide::new(&cumulative),
            cumulative,
            mean: total / weights.len() as f64,
        }
    }

    /// Mean of the weights.
    pub fn mean(&self) -> f64 {
        self.mean
    }

    /// Probability of step `i`.
    pub fn probability(&self, i: usize) -> f32 {
        self.cumulative[i + 1] - self.cumulative[i]
    }

    /// The step into which `u` in [0, 1) falls, and the place within it, in [0, 1).
    pub fn sample(&self, u: f32) -> (usize, f32) {
        let steps = self.cumulative.len() - 1;
        let below = self.guide.count_up_to(&self.cumulative, u);
        let mut step = below.clamp(1, steps) - 1;
        // The last step that u can reach may be empty when rounding closes the sum early.
        while step > 0 && self.probability(step) <= 0.0 {
            step -= 1;
        }
        let within = (u - self.cumulative[step]) / self.probability(step);
        (step, within.clamp(0.0, 1.0 - f32::EPSILON))
    }
}

/// A piecewise constant distribution: cells of equal size over the unit square with given weights.
#[derive(Clone, Debug)]
pub struct Piecewise2d {
    rows: Piecewise1d,
    columns: Box<[Piecewise1d]>,
}

impl Piecewise2d {
    /// The distribution with these weights, row by row, each finite and ≥ 0.
    pub fn new(weights: &[f32], width: usize) -> Self {
        let columns: Box<[_]> = weights.chunks(width).map(Piecewise1d::new).collect();
        let sums: Vec<f32> = columns.iter().map(|row| row.mean() as f32).collect();
        Self {
            rows: Piecewise1d::new(&sums),
            columns,
        }
    }

    /// Samples a point of the unit square; returns it with its density.
    pub fn sample(&self, u: [f32; 2]) -> ([f32; 2], f32) {
        let (row, within_row) = self.rows.sample(u[1]);
        let (column, within_column) = self.columns[row].sample(u[0]);
        let width = (self.columns[row].cumulative.len() - 1) as f32;
        let height = self.columns.len() as f32;
        let point = [
            (column as f32 + within_column) / width,
            (row as f32 + within_row) / height,
        ];
        (point, self.density_of(column, row))
    }

    /// Density at a point of the unit square.
    pub fn density(&self, point: [f32; 2]) -> f32 {
        let row = ((point[1] * self.columns.len() as f32) as usize).min(self.columns.len() - 1);
        let width = self.columns[row].cumulative.len() - 1;
        let column = ((point[0] * width as f32) as usize).min(width - 1);
        self.density_of(column, row)
    }

    /// Columns and rows.
    pub fn size(&self) -> [usize; 2] {
        [self.columns[0].cumulative.len() - 1, self.columns.len()]
    }

    /// Probability of a cell.
    pub fn probability(&self, column: usize, row: usize) -> f32 {
        self.rows.probability(row) * self.columns[row].probability(column)
    }

    fn density_of(&self, column: usize, row: usize) -> f32 {
        let [width, height] = self.size().map(|cells| cells as f32);
        self.probability(column, row) * width * height
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_guided_search_finds_what_a_search_through_all_borders_finds() {
        let mut borders = vec![0.0_f32; 40];
        borders.extend((1..300_u16).map(|i| (f32::from(i) / 300.0).powi(3)));
        borders.extend([0.999_999_9, 1.0, 1.0]);
        let guide = Guide::new(&borders);
        let near = |x: f32| [x.next_down(), x, x.next_up()];
        let even = (0..=5000).map(|i| i as f32 / 5000.0);
        for u in borders.iter().copied().flat_map(near).chain(even) {
            let u = u.clamp(0.0, 1.0);
            let expected = borders.partition_point(|&border| border <= u);
            assert_eq!(guide.count_up_to(&borders, u), expected, "{u}");
        }
    }

    #[test]
    fn steps_are_drawn_as_often_as_they_weigh() {
        let weights = [0.0, 1.0, 3.0, 0.0, 4.0, 0.0];
        let distribution = Piecewise1d::new(&weights);
        let mut counts = [0; 6];
        for i in 0..8000 {
            counts[distribution.sample((i as f32 + 0.5) / 8000.0).0] += 1;
        }
        assert_eq!(counts, [0, 1000, 3000, 0, 4000, 0]);
        assert_eq!(distribution.sample(1.0 - f32::EPSILON / 2.0).0, 4);
    }

    #[test]
    fn the_density_in_the_square_integrates_to_one_and_matches_the_samples() {
        let weights = [1.0, 2.0, 0.0, 5.0, 0.5, 3.0];
        let distribution = Piecewise2d::new(&weights, 3);
        let mut integral = 0.0;
        let mut counts = [0.0; 6];
        let side = 300;
        for i in 0..side {
            for j in 0..side {
                let u = [
                    (i as f32 + 0.5) / side as f32,
                    (j as f32 + 0.5) / side as f32,
                ];
                integral += f64::from(distribution.density(u)) / f64::from(side * side);
                let (point, density) = distribution.sample(u);
                assert!((distribution.density(point) - density).abs() < 1e-4);
                counts[(point[1] * 2.0) as usize * 3 + (point[0] * 3.0) as usize] += 1.0;
            }
        }
        assert!((integral - 1.0).abs() < 1e-3, "{integral}");
        for (count, weight) in counts.iter().zip(weights) {
            let expected = weight / 11.5 * (side * side) as f32;
            // Borders of the cells cut through the grid of numbers.
            assert!(
                (count - expected).abs() <= 0.03 * expected + 1.0,
                "{count} for {expected}"
            );
        }
    }
}
