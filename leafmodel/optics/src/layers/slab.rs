//! What one homogeneous layer does, without its boundaries.

use super::directions::Direction;
use super::matrix::Matrix;
use super::stack::Layer;

/// What a layer sends back, and what it lets through, between its directions, in the variable
/// `√W I / n²`. Both are symmetric, and the same from both sides.
#[derive(Clone, Debug)]
pub(super) struct Slab {
    pub(super) reflection: Matrix,
    pub(super) transmission: Matrix,
}

impl Slab {
    /// By discrete ordinates, for the part of light that goes as `cos mφ` with azimuth.
    ///
    /// With `s`, `d` the sum and the difference of the light down and up, `s′ = −A d` and `d′ = −B
    /// s`, with symmetric `A` (which holds the odd moments of the phase function) and `B` (the even
    /// ones). From `A = L Lᵀ` and the eigenvalues `k²` and vectors `V` of `Lᵀ B L` follow `G = L⁻ᵀ V`
    /// and, for light that is the same from both sides, `d = Y s` at the upper side, `Y = G k tanh(k
    /// b/2) Gᵀ`; for light of opposite sign `coth` stands for `tanh`. So `R ± T = (1 − Y)(1 + Y)⁻¹`
    /// for any depth `b` at once: no thin layer is doubled.
    ///
    /// # Source
    ///
    /// The sum and difference of \[stamnes1988\], in the symmetric form of \[nakajima1986\], whose
    /// exponentials are combined into `tanh` and `coth` here, so that nothing grows with depth.
    pub(super) fn new(
        layer: &Layer,
        directions: &[Direction],
        mode: usize,
        moments: usize,
    ) -> Self {
        let count = directions.len();
        let truncated = Truncated::new(layer, moments);
        let identity = || Matrix::from_fn(count, count, |i, j| f64::from(u8::from(i == j)));
        if truncated.depth == 0.0 {
            return Self {
                reflection: Matrix::zero(count, count),
                transmission: identity(),
            };
        }
        let cosines: Vec<f64> = directions
            .iter()
            .map(|direction| direction.cosine(layer.index))
            .collect();
        let scales: Vec<f64> = directions
            .iter()
            .zip(&cosines)
            .map(|(direction, cosine)| direction.root / (layer.index * cosine))
            .collect();
        let [even, odd] = truncated.kernels(&cosines, &scales, mode);
        let with_depth = |kernel: &Matrix| {
            Matrix::from_fn(count, count, |i, j| {
                let alone = if i == j { 1.0 / cosines[i] } else { 0.0 };
                alone - truncated.albedo * scales[i] * kernel[[i, j]] * scales[j]
            })
        };
        let (a, b) = (with_depth(&odd), with_depth(&even));
        let lower = a.cholesky();
        let upper = lower.transposed();
        let (squares, vectors) = upper.times(&b.times(&lower)).eigen();
        let g = lower.solved_transposed(vectors);
        let half = 0.5 * truncated.depth;
        let answer = |rate: &dyn Fn(f64) -> f64| {
            let rates: Vec<f64> = squares.iter().map(|k2| rate(k2.max(0.0).sqrt())).collect();
            let weighted = Matrix::from_fn(count, count, |i, j| g[[i, j]] * rates[j]);
            let y = weighted.times_transposed(&g);
            let plus = y.zip(&identity(), |y, one| one + y);
            plus.solved(identity())
                .zip(&identity(), |inverse, one| 2.0 * inverse - one)
        };
        let same = answer(&|k| k * libm::tanh(k * half));
        let opposite = answer(&|k| {
            let x = k * half;
            // k coth(k b/2) → 2/b.
            if x < 1e-8 {
                1.0 / half
            } else {
                k / libm::tanh(x)
            }
        });
        Self {
            reflection: same.clone().zip(&opposite, f64::midpoint),
            transmission: same.zip(&opposite, |s, o| 0.5 * (s - o)),
        }
    }

    /// The same layer for light that meets nothing in it.
    pub(super) fn uncollided(layer: &Layer, directions: &[Direction], moments: usize) -> Self {
        let depth = Truncated::new(layer, moments).depth;
        let count = directions.len();
        let through = |i: usize| libm::exp(-depth / directions[i].cosine(layer.index));
        Self {
            reflection: Matrix::zero(count, count),
            transmission: Matrix::from_fn(
                count,
                count,
                |i, j| {
                    if i == j { through(i) } else { 0.0 }
                },
            ),
        }
    }
}

/// A layer whose forward peak counts as not scattered.
///
/// # Source
///
/// The δ–M method, \[wiscombe1977\].
struct Truncated {
    albedo: f64,
    depth: f64,
    /// `χₗ` of what is left of the phase function.
    moments: Vec<f64>,
}

impl Truncated {
    fn new(layer: &Layer, count: usize) -> Self {
        let mut moments = layer.phase.moments(count + 1);
        let peak = moments.pop().expect("there is at least one moment");
        for moment in &mut moments {
            *moment = (*moment - peak) / (1.0 - peak);
        }
        let left = 1.0 - layer.albedo * peak;
        Self {
            albedo: layer.albedo * (1.0 - peak) / left,
            depth: layer.depth * left,
            moments,
        }
    }

    /// `Σ (2l + 1) χₗ Yₗᵐ(µ) Yₗᵐ(µ′)` over even and over odd `l + m`.
    ///
    /// Those for `m = 0` are corrected to `Σ w E = 1` exactly, with `1 + cᵢ + cⱼ`, so that
    /// scattering loses nothing. Quadrature alone leaves a residue only in media with several
    /// ranges.
    fn kernels(&self, cosines: &[f64], scales: &[f64], mode: usize) -> [Matrix; 2] {
        let count = cosines.len();
        let harmonics: Vec<Vec<f64>> = cosines
            .iter()
            .map(|&cosine| legendre(mode, self.moments.len(), cosine))
            .collect();
        let kernel = |parity: usize| {
            Matrix::from_fn(count, count, |i, j| {
                let degrees = (mode + parity..self.moments.len()).step_by(2);
                degrees
                    .map(|l| {
                        let strength = (2 * l + 1) as f64 * self.moments[l];
                        strength * harmonics[i][l - mode] * harmonics[j][l - mode]
                    })
                    .sum()
            })
        };
        let (even, odd) = (kernel(0), kernel(1));
        if mode > 0 {
            return [even, odd];
        }
        let weights: Vec<f64> = scales
            .iter()
            .zip(cosines)
            .map(|(scale, cosine)| scale * scale * cosine)
            .collect();
        let sums: Vec<f64> = (0..count)
            .map(|i| even.row(i).iter().zip(&weights).map(|(e, w)| e * w).sum())
            .collect();
        let system = Matrix::from_fn(count, count, |i, j| {
            let own = if i == j { sums[i] } else { 0.0 };
            own + even[[i, j]] * weights[j]
        });
        let lacking = Matrix::from_fn(count, 1, |i, _| 1.0 - sums[i]);
        let c = system.solved(lacking);
        let corrected = |kernel: Matrix| {
            Matrix::from_fn(count, count, |i, j| {
                kernel[[i, j]] * (1.0 + c[[i, 0]] + c[[j, 0]])
            })
        };
        [corrected(even), corrected(odd)]
    }
}

/// `√((l−m)!/(l+m)!) Pₗᵐ(x)` for `l` from `m` to below `count`.
fn legendre(m: usize, count: usize, x: f64) -> Vec<f64> {
    let sine = (1.0 - x * x).max(0.0).sqrt();
    let mut first = 1.0;
    for k in 1..=m {
        first *= sine * ((2 * k - 1) as f64 / (2 * k) as f64).sqrt();
    }
    let mut values = vec![first];
    let m2 = (m * m) as f64;
    for l in m + 1..count {
        let (degree, before) = (l as f64, (l - 1) as f64);
        let rise = (degree * degree - m2).sqrt();
        let fall = (before * before - m2).sqrt();
        let last = values[values.len() - 1];
        let earlier = if values.len() > 1 {
            values[values.len() - 2]
        } else {
            0.0
        };
        values.push(((2.0 * degree - 1.0) * x * last - fall * earlier) / rise);
    }
    values
}
