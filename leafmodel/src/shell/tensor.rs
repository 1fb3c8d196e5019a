//! Symmetric tensors of two dimensions, and quadratic forms on them.

use glam::DVec3;

/// Poisson's ratio of the tissue.
const POISSON: f64 = 0.3;

/// A symmetric tensor on the flat state: entries 11, 22, 12.
pub(super) type Tensor = [f64; 3];
/// A quadratic form on such tensors.
pub(crate) type Stiffness = [[f64; 3]; 3];

/// `C^{ijkl} = ν a^{ij} a^{kl} + ½ (1 − ν) (a^{ik} a^{jl} + a^{il} a^{jk})` over `1 − ν²` on the
/// entries 11, 22 and 12, the last of which counts twice.
pub(super) fn isotropic(metric: Tensor) -> Stiffness {
    let [a, b, c] = inverse(metric);
    let at = |i: usize, j: usize| [[a, c], [c, b]][i][j];
    let pairs = [(0, 0), (1, 1), (0, 1)];
    let times = [1.0, 1.0, 2.0];
    std::array::from_fn(|row| {
        std::array::from_fn(|column| {
            let ((i, j), (k, l)) = (pairs[row], pairs[column]);
            let shear = at(i, k) * at(j, l) + at(i, l) * at(j, k);
            let value = POISSON * at(i, j) * at(k, l) + 0.5 * (1.0 - POISSON) * shear;
            times[row] * times[column] * value / (1.0 - POISSON * POISSON)
        })
    })
}

/// `U A U` for symmetric tensors.
pub(super) fn between(u: Tensor, a: Tensor) -> Tensor {
    let [p, q, r] = u;
    let rows = [
        [p * a[0] + r * a[2], p * a[2] + r * a[1]],
        [r * a[0] + q * a[2], r * a[2] + q * a[1]],
    ];
    [
        rows[0][0] * p + rows[0][1] * r,
        rows[1][0] * r + rows[1][1] * q,
        rows[0][0] * r + rows[0][1] * q,
    ]
}

pub(super) fn determinant([a, b, c]: Tensor) -> f64 {
    a * b - c * c
}

pub(super) fn inverse(tensor: Tensor) -> Tensor {
    let whole = determinant(tensor).max(1e-12);
    [tensor[1] / whole, tensor[0] / whole, -tensor[2] / whole]
}

/// The part of a symmetric tensor with positive principal values; its entry 12 counts twice.
pub(super) fn positive([a, b, twice]: Tensor) -> Tensor {
    let c = 0.5 * twice;
    let (mean, half) = (f64::midpoint(a, b), 0.5 * (a - b));
    let radius = (half * half + c * c).sqrt();
    if mean >= radius {
        return [a, b, twice];
    }
    if mean <= -radius {
        return [0.0; 3];
    }
    // Only the greater principal value is positive.
    let value = mean + radius;
    let (cos2, sin2) = (half / radius, c / radius);
    [
        0.5 * value * (1.0 + cos2),
        0.5 * value * (1.0 - cos2),
        value * sin2,
    ]
}

pub(super) fn dot(a: Tensor, b: Tensor) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn less(a: Tensor, b: Tensor) -> Tensor {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(super) fn added(a: Tensor, b: Tensor) -> Tensor {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub(super) fn applied(matrix: &Stiffness, tensor: Tensor) -> Tensor {
    matrix.map(|row| dot(row, tensor))
}

pub(super) fn scaled(matrix: &Stiffness, factor: f64) -> Stiffness {
    matrix.map(|row| row.map(|value| factor * value))
}

pub(super) fn sum(a: &Stiffness, b: &Stiffness) -> Stiffness {
    std::array::from_fn(|i| added(a[i], b[i]))
}

/// The solution of a system with a positive definite matrix.
pub(super) fn solved(matrix: &Stiffness, right: Tensor) -> Tensor {
    let [a, b, c] = matrix.map(DVec3::from_array);
    let whole = a.dot(b.cross(c));
    let r = DVec3::from_array(right);
    // Symmetric: rows are columns.
    [
        r.dot(b.cross(c)) / whole,
        a.dot(r.cross(c)) / whole,
        a.dot(b.cross(r)) / whole,
    ]
}
