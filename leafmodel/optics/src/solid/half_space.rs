//! The half-space behind a smooth boundary.

use crate::quadrature::gauss;

/// Nodes of each half of the directions.
const NODES: usize = 28;

/// A direction inside, and what the boundary does there.
#[derive(Clone, Copy, Debug)]
struct Direction {
    /// Cosine inside.
    mu: f64,
    /// Weight of `dµ`.
    weight: f64,
    /// Fresnel's reflectance, 1 where reflection is total.
    reflectance: f64,
}

/// Directions and boundary of a half-space of one refractive index; albedo and skin vary.
#[derive(Clone, Debug)]
pub struct HalfSpace {
    eta: f64,
    directions: Vec<Direction>,
}

/// Share of light that comes back, specular part included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reflected {
    /// At normal incidence, in [0, 1].
    pub normal: f64,
    /// At diffuse (Lambertian) incidence, in [0, 1].
    pub diffuse: f64,
}

impl HalfSpace {
    /// Of refractive index `eta`, 1 to 2.
    ///
    /// Inside the critical angle the nodes are spaced in the cosine outside, where Fresnel's
    /// formulae are smooth. Both sets are denser towards grazing directions, where `H` behaves as
    /// `µ ln µ`.
    pub fn new(eta: f64) -> Self {
        let rule = gauss(NODES);
        let critical = (1.0 - 1.0 / (eta * eta)).sqrt();
        let mut directions = Vec::with_capacity(2 * NODES);
        if critical > 0.0 {
            directions.extend(rule.iter().map(|(x, weight)| Direction {
                mu: critical * x * x,
                weight: critical * 2.0 * x * weight,
                reflectance: 1.0,
            }));
        }
        directions.extend(rule.iter().map(|(x, weight)| {
            let outside = x * x;
            let mu = (1.0 - (1.0 - outside * outside) / (eta * eta)).sqrt();
            Direction {
                mu,
                weight: 2.0 * x * weight * outside / (eta * eta * mu),
                reflectance: fresnel(outside, mu, eta),
            }
        }));
        Self { eta, directions }
    }

    /// Reflectance for a single-scattering albedo `a` in [0, 1] below a clear skin of optical depth
    /// `skin` ≥ 0.
    ///
    /// With `J` the radiance that enters the scatterer and `I` the one that leaves it,
    /// `I(µ) = a/2 ∫ H(µ) H(µ') µ' / (µ + µ') J(µ') dµ'` and `J = E t L + E² r I`, where
    /// `E = exp(−skin/µ)`, `r` and `t = 1 − r` are Fresnel's and `L` comes from outside; at normal
    /// incidence `L` is a single direction.
    ///
    /// # Source
    ///
    /// \[chandrasekhar1960\] for the half-space; `docs/src/theory/solid-tissue.md` for the
    /// boundary.
    pub fn reflected(&self, a: f64, skin: f64) -> Reflected {
        let directions = &self.directions;
        let count = directions.len();
        let h = self.h(a);
        let through: Vec<f64> = directions
            .iter()
            .map(|direction| libm::exp(-skin / direction.mu))
            .collect();
        let kernel = |i: usize, j: usize| {
            let (to, from) = (directions[i].mu, directions[j].mu);
            0.5 * a * h[i] * h[j] * from / (to + from) * directions[j].weight
        };
        // Unit flux at normal incidence, and unit irradiance of uniform radiance 1/π (n²/π inside).
        let straight = 1.0 - fresnel(1.0, 1.0, self.eta);
        let h_one = self.h_at(1.0, a, &h);
        let entering_straight = straight * libm::exp(-skin) / (2.0 * std::f64::consts::PI);
        let n2_over_pi = self.eta * self.eta * std::f64::consts::FRAC_1_PI;
        let mut rows: Vec<Vec<f64>> = (0..count)
            .map(|i| {
                let mut row: Vec<f64> = (0..count)
                    .map(|j| {
                        let back = through[j] * through[j] * directions[j].reflectance;
                        f64::from(u8::from(i == j)) - kernel(i, j) * back
                    })
                    .collect();
                let normal = 0.5 * a * h[i] * h_one / (directions[i].mu + 1.0);
                row.push(normal * entering_straight);
                let diffuse: f64 = (0..count)
                    .map(|j| kernel(i, j) * through[j] * (1.0 - directions[j].reflectance))
                    .sum();
                row.push(diffuse * n2_over_pi);
                row
            })
            .collect();
        solve(&mut rows);
        let leaving = |column: usize| -> f64 {
            (0..count)
                .map(|i| {
                    let direction = &directions[i];
                    let out = through[i] * (1.0 - direction.reflectance);
                    direction.mu * direction.weight * out * rows[i][count + column]
                })
                .sum::<f64>()
                * 2.0
                * std::f64::consts::PI
        };
        let entering: f64 = directions
            .iter()
            .map(|direction| direction.mu * direction.weight * (1.0 - direction.reflectance))
            .sum::<f64>()
            * 2.0
            * self.eta
            * self.eta;
        Reflected {
            normal: (1.0 - straight + leaving(0)).clamp(0.0, 1.0),
            diffuse: (1.0 - entering + leaving(1)).clamp(0.0, 1.0),
        }
    }

    /// Chandrasekhar's `H` at the nodes, from `1/H(µ) = √(1−a) + a/2 ∫ µ' H(µ') / (µ + µ') dµ'`.
    ///
    /// The iteration swings about its limit, so each step goes half of the way.
    fn h(&self, a: f64) -> Vec<f64> {
        let mut h = vec![1.0; self.directions.len()];
        for _ in 0..400 {
            let mut change = 0.0_f64;
            let next: Vec<f64> = self
                .directions
                .iter()
                .zip(&h)
                .map(|(direction, old)| {
                    let new = f64::midpoint(*old, self.h_at(direction.mu, a, &h));
                    change = change.max((new - old).abs() / new);
                    new
                })
                .collect();
            h = next;
            if change < 1e-13 {
                break;
            }
        }
        h
    }

    /// `H(µ)` from its values at the nodes.
    fn h_at(&self, mu: f64, a: f64, h: &[f64]) -> f64 {
        let integral: f64 = self
            .directions
            .iter()
            .zip(h)
            .map(|(direction, value)| direction.weight * direction.mu * value / (mu + direction.mu))
            .sum();
        1.0 / ((1.0 - a).max(0.0).sqrt() + 0.5 * a * integral)
    }
}

/// Unpolarised reflectance between cosines outside and inside.
fn fresnel(outside: f64, inside: f64, eta: f64) -> f64 {
    let s = (outside - eta * inside) / (outside + eta * inside);
    let p = (eta * outside - inside) / (eta * outside + inside);
    f64::midpoint(s * s, p * p)
}

/// Gauss' elimination with row exchange; what stands right of the square becomes the solutions.
fn solve(rows: &mut [Vec<f64>]) {
    let count = rows.len();
    for pivot in 0..count {
        let best = (pivot..count)
            .max_by(|&i, &j| rows[i][pivot].abs().total_cmp(&rows[j][pivot].abs()))
            .expect("the pivot's own row is there");
        rows.swap(pivot, best);
        let (above, below) = rows.split_at_mut(pivot + 1);
        let row = &mut above[pivot];
        let scale = 1.0 / row[pivot];
        for value in &mut row[pivot..] {
            *value *= scale;
        }
        for other in below {
            let factor = other[pivot];
            for (value, from) in other[pivot..].iter_mut().zip(&row[pivot..]) {
                *value -= factor * from;
            }
        }
    }
    for pivot in (1..count).rev() {
        let (above, below) = rows.split_at_mut(pivot);
        for row in above {
            let factor = row[pivot];
            for (value, from) in row[count..].iter_mut().zip(&below[0][count..]) {
                *value -= factor * from;
            }
        }
    }
}
