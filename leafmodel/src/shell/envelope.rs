//! Symmetric positive definite systems whose entries lie near the diagonal.
//!
//! Each row is kept from its first entry to the diagonal (its envelope), within which Cholesky's
//! factor stays. On a grid that is numbered across its shorter side this needs no more work than a
//! nested dissection at the sizes of a leaf, and its inner loop is a product of two runs of memory.
//! Sums are taken in a fixed order, so the bits do not depend on the machine.

/// A matrix of rows that end on the diagonal.
#[derive(Clone, Debug)]
pub(super) struct Envelope {
    /// Column of each row's first entry.
    first: Vec<usize>,
    /// Place of each row's column 0, were it kept; the diagonal of row `i` is at `start[i] + i`.
    start: Vec<isize>,
    entries: Vec<f64>,
}

impl Envelope {
    /// A matrix of zeros whose row `i` begins at column `first[i]` ≤ `i`.
    pub(super) fn new(first: Vec<usize>) -> Self {
        let mut start = Vec::with_capacity(first.len());
        let mut length = 0_isize;
        for (row, &from) in first.iter().enumerate() {
            start.push(length - from as isize);
            length += (row - from + 1) as isize;
        }
        Self {
            first,
            start,
            entries: vec![0.0; length as usize],
        }
    }

    pub(super) fn clear(&mut self) {
        self.entries.fill(0.0);
    }

    /// Adds to the entry at `row`, `column` ≤ `row`.
    pub(super) fn add(&mut self, row: usize, column: usize, value: f64) {
        self.entries[(self.start[row] + column as isize) as usize] += value;
    }

    fn row(&self, row: usize) -> &[f64] {
        let from = (self.start[row] + self.first[row] as isize) as usize;
        &self.entries[from..=(self.start[row] + row as isize) as usize]
    }

    /// Replaces the matrix by its Cholesky factor; whether it is positive definite.
    pub(super) fn factor(&mut self) -> bool {
        for i in 0..self.first.len() {
            let from = self.first[i];
            let at = (self.start[i] + from as isize) as usize;
            let (before, rest) = self.entries.split_at_mut(at);
            let row = &mut rest[..=i - from];
            for j in from..i {
                let other_from = self.first[j].max(from);
                let base = self.start[j];
                let other =
                    &before[(base + other_from as isize) as usize..=(base + j as isize) as usize];
                let (other, diagonal) = other.split_at(j - other_from);
                let sum = dot(&row[other_from - from..j - from], other);
                row[j - from] = (row[j - from] - sum) / diagonal[0];
            }
            let (left, diagonal) = row.split_at_mut(i - from);
            let square = diagonal[0] - dot(left, left);
            if square.is_nan() || square <= 0.0 {
                return false;
            }
            diagonal[0] = square.sqrt();
        }
        true
    }

    /// Solves the system whose matrix has been factored.
    pub(super) fn solve(&self, right: &mut [f64]) {
        for i in 0..right.len() {
            let row = self.row(i);
            let (left, diagonal) = row.split_at(row.len() - 1);
            right[i] = (right[i] - dot(left, &right[self.first[i]..i])) / diagonal[0];
        }
        for i in (0..right.len()).rev() {
            let row = self.row(i);
            let (left, diagonal) = row.split_at(row.len() - 1);
            let value = right[i] / diagonal[0];
            right[i] = value;
            for (below, entry) in right[self.first[i]..i].iter_mut().zip(left) {
                *below -= value * entry;
            }
        }
    }
}

/// The product of two runs, in eight sums that a processor can add side by side.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 8];
    let (a, b) = (a.chunks_exact(8), b.chunks_exact(8));
    let rest: f64 = a
        .remainder()
        .iter()
        .zip(b.remainder())
        .map(|(x, y)| x * y)
        .sum();
    for (x, y) in a.zip(b) {
        for lane in 0..8 {
            sums[lane] += x[lane] * y[lane];
        }
    }
    ((sums[0] + sums[4]) + (sums[1] + sums[5])) + ((sums[2] + sums[6]) + (sums[3] + sums[7])) + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_banded_system_is_solved() {
        let count = 40;
        let first: Vec<usize> = (0..count).map(|i: usize| i.saturating_sub(11)).collect();
        let mut matrix = Envelope::new(first.clone());
        let mut full = vec![vec![0.0; count]; count];
        for i in 0..count {
            for j in (0..=i).skip(first[i]) {
                let value = if i == j {
                    20.0
                } else {
                    libm::sin((7 * i + 3 * j) as f64)
                };
                matrix.add(i, j, value);
                full[i][j] = value;
                full[j][i] = value;
            }
        }
        let wanted: Vec<f64> = (0..count).map(|i| libm::cos(i as f64)).collect();
        let mut right: Vec<f64> = full
            .iter()
            .map(|row| row.iter().zip(&wanted).map(|(a, x)| a * x).sum())
            .collect();
        assert!(matrix.factor());
        matrix.solve(&mut right);
        for (x, y) in right.iter().zip(&wanted) {
            assert!((x - y).abs() < 1e-12, "{x} is not {y}");
        }
    }

    #[test]
    fn what_is_not_positive_definite_is_reported() {
        let mut matrix = Envelope::new(vec![0, 0]);
        for (row, column, value) in [(0, 0, 1.0), (1, 0, 2.0), (1, 1, 1.0)] {
            matrix.add(row, column, value);
        }
        assert!(!matrix.factor());
    }
}
