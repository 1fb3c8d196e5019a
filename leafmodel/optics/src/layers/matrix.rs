//! Dense matrices of a few dozen rows.
//!
//! Own code, since libraries choose instructions by the processor they run on, and so give other
//! bits on another machine.

use std::ops::{Index, IndexMut};

/// A matrix, row by row.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Matrix {
    rows: usize,
    columns: usize,
    data: Vec<f64>,
}

impl Index<[usize; 2]> for Matrix {
    type Output = f64;

    fn index(&self, [row, column]: [usize; 2]) -> &f64 {
        &self.data[row * self.columns + column]
    }
}

impl IndexMut<[usize; 2]> for Matrix {
    fn index_mut(&mut self, [row, column]: [usize; 2]) -> &mut f64 {
        &mut self.data[row * self.columns + column]
    }
}

impl Matrix {
    pub(super) fn from_fn(
        rows: usize,
        columns: usize,
        mut entry: impl FnMut(usize, usize) -> f64,
    ) -> Self {
        let mut data = Vec::with_capacity(rows * columns);
        for row in 0..rows {
            data.extend((0..columns).map(|column| entry(row, column)));
        }
        Self {
            rows,
            columns,
            data,
        }
    }

    pub(super) fn zero(rows: usize, columns: usize) -> Self {
        Self {
            rows,
            columns,
            data: vec![0.0; rows * columns],
        }
    }

    pub(super) fn rows(&self) -> usize {
        self.rows
    }

    pub(super) fn columns(&self) -> usize {
        self.columns
    }

    pub(super) fn row(&self, row: usize) -> &[f64] {
        &self.data[row * self.columns..(row + 1) * self.columns]
    }

    fn row_mut(&mut self, row: usize) -> &mut [f64] {
        &mut self.data[row * self.columns..(row + 1) * self.columns]
    }

    /// Two rows, the first of which stands above the second.
    fn two_rows(&mut self, above: usize, below: usize) -> (&mut [f64], &mut [f64]) {
        let (head, tail) = self.data.split_at_mut(below * self.columns);
        let first = &mut head[above * self.columns..(above + 1) * self.columns];
        (first, &mut tail[..self.columns])
    }

    /// `A B`.
    pub(super) fn times(&self, other: &Self) -> Self {
        let mut product = Self::zero(self.rows, other.columns);
        for row in 0..self.rows {
            let into = &mut product.data[row * other.columns..(row + 1) * other.columns];
            for (factor, from) in self.row(row).iter().zip(other.data.chunks(other.columns)) {
                if *factor != 0.0 {
                    for (sum, value) in into.iter_mut().zip(from) {
                        *sum += factor * value;
                    }
                }
            }
        }
        product
    }

    /// `A Bᵀ`.
    pub(super) fn times_transposed(&self, other: &Self) -> Self {
        Self::from_fn(self.rows, other.rows, |i, j| dot(self.row(i), other.row(j)))
    }

    pub(super) fn transposed(&self) -> Self {
        Self::from_fn(self.columns, self.rows, |i, j| self[[j, i]])
    }

    pub(super) fn zip(mut self, other: &Self, to: impl Fn(f64, f64) -> f64) -> Self {
        for (value, with) in self.data.iter_mut().zip(&other.data) {
            *value = to(*value, *with);
        }
        self
    }

    /// `X` of `A X = B`, by elimination with exchange of rows. Where nothing fixes an unknown, it is
    /// 0: light that clear layers would keep for ever has no way into them.
    pub(super) fn solved(mut self, mut right: Self) -> Self {
        let count = self.rows;
        for pivot in 0..count {
            let best = (pivot..count)
                .max_by(|&i, &j| self[[i, pivot]].abs().total_cmp(&self[[j, pivot]].abs()))
                .expect("the pivot's own row is there");
            if best != pivot {
                let (one, other) = self.two_rows(pivot, best);
                one.swap_with_slice(other);
                let (one, other) = right.two_rows(pivot, best);
                one.swap_with_slice(other);
            }
            let scale = inverse_or_nothing(self[[pivot, pivot]]);
            for row in pivot + 1..count {
                let factor = scale * self[[row, pivot]];
                if factor != 0.0 {
                    let (from, into) = self.two_rows(pivot, row);
                    for (value, above) in into[pivot..].iter_mut().zip(&from[pivot..]) {
                        *value -= factor * above;
                    }
                    let (from, into) = right.two_rows(pivot, row);
                    for (value, above) in into.iter_mut().zip(from) {
                        *value -= factor * *above;
                    }
                }
            }
        }
        for pivot in (0..count).rev() {
            let scale = inverse_or_nothing(self[[pivot, pivot]]);
            for value in right.row_mut(pivot) {
                *value *= scale;
            }
            for row in 0..pivot {
                let factor = self[[row, pivot]];
                if factor != 0.0 {
                    let (into, from) = right.two_rows(row, pivot);
                    for (value, below) in into.iter_mut().zip(from) {
                        *value -= factor * *below;
                    }
                }
            }
        }
        right
    }

    /// The lower triangle `L` of `A = L Lᵀ`, for a symmetric positive definite `A`.
    pub(super) fn cholesky(&self) -> Self {
        let mut lower = Self::zero(self.rows, self.rows);
        for i in 0..self.rows {
            for j in 0..=i {
                let rest = self[[i, j]] - dot(&lower.row(i)[..j], &lower.row(j)[..j]);
                lower[[i, j]] = if i == j {
                    // Rounding alone can make it negative.
                    rest.max(f64::MIN_POSITIVE).sqrt()
                } else {
                    rest / lower[[j, j]]
                };
            }
        }
        lower
    }

    /// `X` of `Lᵀ X = B` for a lower triangle `L`.
    pub(super) fn solved_transposed(&self, mut right: Self) -> Self {
        for pivot in (0..self.rows).rev() {
            let scale = 1.0 / self[[pivot, pivot]];
            for value in right.row_mut(pivot) {
                *value *= scale;
            }
            for row in 0..pivot {
                let factor = self[[pivot, row]];
                let (into, from) = right.two_rows(row, pivot);
                for (value, below) in into.iter_mut().zip(from) {
                    *value -= factor * *below;
                }
            }
        }
        right
    }

    /// Eigenvalues of a symmetric matrix, and its eigenvectors as columns, by Jacobi's rotations.
    ///
    /// Jacobi's method keeps small eigenvalues of a graded matrix accurate, as methods that go by
    /// way of a tridiagonal matrix do not; nearly conservative scattering needs them.
    pub(super) fn eigen(mut self) -> (Vec<f64>, Self) {
        const SWEEPS: usize = 60;
        let count = self.rows;
        // Eigenvectors as rows while turning, so that a rotation runs along memory.
        let mut vectors = Self::from_fn(count, count, |i, j| f64::from(u8::from(i == j)));
        for _ in 0..SWEEPS {
            let mut turned = false;
            for p in 0..count {
                for q in p + 1..count {
                    let (off, first, second) = (self[[p, q]], self[[p, p]], self[[q, q]]);
                    if off.abs() <= f64::EPSILON * (first.abs().sqrt() * second.abs().sqrt()) * 0.25
                        || off.abs() < f64::MIN_POSITIVE
                    {
                        continue;
                    }
                    turned = true;
                    let theta = (second - first) / (2.0 * off);
                    let t = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
                    let t = if theta == 0.0 { 1.0 } else { t };
                    let c = 1.0 / (t * t + 1.0).sqrt();
                    self.rotate(p, q, c, t * c);
                    self[[p, p]] = first - t * off;
                    self[[q, q]] = second + t * off;
                    self[[p, q]] = 0.0;
                    self[[q, p]] = 0.0;
                    let (one, other) = vectors.two_rows(p, q);
                    turn(one, other, c, t * c);
                }
            }
            if !turned {
                break;
            }
        }
        let values = (0..count).map(|i| self[[i, i]]).collect();
        (values, vectors.transposed())
    }

    /// Turns rows and columns `p` and `q` of a symmetric matrix but for where they cross.
    fn rotate(&mut self, p: usize, q: usize, c: f64, s: f64) {
        let (one, other) = self.two_rows(p, q);
        turn(one, other, c, s);
        for k in 0..self.rows {
            if k != p && k != q {
                self[[k, p]] = self[[p, k]];
                self[[k, q]] = self[[q, k]];
            }
        }
    }
}

fn inverse_or_nothing(value: f64) -> f64 {
    if value == 0.0 { 0.0 } else { 1.0 / value }
}

fn turn(one: &mut [f64], other: &mut [f64], c: f64, s: f64) {
    for (x, y) in one.iter_mut().zip(other) {
        (*x, *y) = (c * *x - s * *y, s * *x + c * *y);
    }
}

fn dot(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(x, y)| x * y).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A symmetric positive definite matrix whose rows differ in size by 1e8.
    fn graded(count: usize) -> Matrix {
        let size = |i: usize| libm::pow(10.0, 4.0 * i as f64 / count as f64);
        Matrix::from_fn(count, count, |i, j| {
            let shape = if i == j {
                2.0
            } else {
                0.3 * libm::cos((i * j) as f64) / count as f64
            };
            let shape = if i > j {
                0.3 * libm::cos((j * i) as f64) / count as f64
            } else {
                shape
            };
            shape * size(i) * size(j)
        })
    }

    #[test]
    fn what_is_solved_gives_the_right_side_back() {
        let a = Matrix::from_fn(7, 7, |i, j| libm::sin((3 * i + 5 * j + i * j) as f64));
        let x = Matrix::from_fn(7, 3, |i, j| 1.0 + (i + 2 * j) as f64);
        let found = a.clone().solved(a.times(&x));
        for (found, wanted) in found.data.iter().zip(&x.data) {
            assert!((found - wanted).abs() < 1e-11, "{found} for {wanted}");
        }
    }

    #[test]
    fn a_triangle_times_its_transpose_is_the_matrix() {
        let a = graded(9);
        let lower = a.cholesky();
        let back = lower.times_transposed(&lower);
        for i in 0..9 {
            for j in 0..9 {
                let size = (a[[i, i]] * a[[j, j]]).sqrt();
                assert!((back[[i, j]] - a[[i, j]]).abs() < 1e-14 * size);
            }
        }
        let x = lower.solved_transposed(lower.transposed());
        assert!((x[[3, 3]] - 1.0).abs() < 1e-12 && x[[2, 5]].abs() < 1e-9);
    }

    #[test]
    fn eigenvectors_are_stretched_by_their_eigenvalues() {
        let a = graded(12);
        let (values, vectors) = a.clone().eigen();
        let stretched = a.times(&vectors);
        for k in 0..12 {
            let length: f64 = (0..12).map(|i| vectors[[i, k]] * vectors[[i, k]]).sum();
            assert!((length - 1.0).abs() < 1e-13);
            for i in 0..12 {
                let size = (a[[i, i]] * values[k]).sqrt();
                let off = stretched[[i, k]] - values[k] * vectors[[i, k]];
                assert!(off.abs() < 1e-12 * size, "{k} {i} {off}");
            }
        }
    }
}
