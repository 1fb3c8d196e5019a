//! Piecewise constant distributions in one and two dimensions.

/// Steps of equal width over [0, 1) with given weights.
#[derive(Clone, Debug)]
pub struct Piecewise1d {
    /// From 0 to 1, one more than there are steps.
    cumulative: Box<[f32]>,
    mean: f64,
}

impl Piecewise1d {
    /// From weights, each finite and ≥ 0; all zero means even.
    pub fn new(weights: &[f32]) -> Self {
        let total: f64 = weights.iter().map(|&weight| f64::from(weight)).sum();
        let mut sum = 0.0;
        let cumulative = std::iter::once(0.0)
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

    /// The step that `u` in [0, 1) falls into, and where in it, in [0, 1).
    pub fn sample(&self, u: f32) -> (usize, f32) {
        let steps = self.cumulative.len() - 1;
        let mut step = self
            .cumulative
            .partition_point(|&border| border <= u)
            .clamp(1, steps)
            - 1;
        // The last step that u can reach may be empty when rounding closes the sum early.
        while step > 0 && self.probability(step) <= 0.0 {
            step -= 1;
        }
        let within = (u - self.cumulative[step]) / self.probability(step);
        (step, within.clamp(0.0, 1.0 - f32::EPSILON))
    }
}

/// Cells of equal size over the unit square with given weights.
#[derive(Clone, Debug)]
pub struct Piecewise2d {
    rows: Piecewise1d,
    columns: Box<[Piecewise1d]>,
}

impl Piecewise2d {
    /// From weights row by row, each finite and ≥ 0.
    pub fn new(weights: &[f32], width: usize) -> Self {
        let columns: Box<[_]> = weights.chunks(width).map(Piecewise1d::new).collect();
        let sums: Vec<f32> = columns.iter().map(|row| row.mean() as f32).collect();
        Self {
            rows: Piecewise1d::new(&sums),
            columns,
        }
    }

    /// A point of the unit square and its density.
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

    fn density_of(&self, column: usize, row: usize) -> f32 {
        let width = (self.columns[row].cumulative.len() - 1) as f32;
        self.rows.probability(row)
            * self.columns[row].probability(column)
            * width
            * self.columns.len() as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
