//! Whether directions are drawn with the density that is told of them.

use std::f64::consts::PI;
use std::fmt;

use glam::Vec3;

/// A chi-square test over cells of the sphere of directions.
#[derive(Clone, Copy, Debug)]
pub struct ChiSquare {
    /// Cells from pole to pole.
    pub rings: usize,
    /// Cells around.
    pub spokes: usize,
    /// Directions drawn.
    pub draws: usize,
    /// Midpoints along each side of a cell, for the integral of the density.
    pub midpoints: usize,
}

/// What a test found.
#[derive(Clone, Copy, Debug)]
pub struct Outcome {
    /// Probability of a statistic at least this great if the density is right.
    pub p_value: f64,
    /// The statistic.
    pub statistic: f64,
    /// Cells that counted, less one.
    pub degrees_of_freedom: usize,
    /// Integral of the density over the sphere.
    pub total_density: f64,
    /// Share of draws that gave a direction.
    pub drawn: f64,
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "p = {:.3e}, chi² = {:.1} at {} degrees of freedom, density integrates to {:.5}, {:.5} drawn",
            self.p_value, self.statistic, self.degrees_of_freedom, self.total_density, self.drawn
        )
    }
}

/// The significance for one of `tests` tests such that all together err with probability `level`
/// (Šidák).
pub fn sidak(level: f64, tests: usize) -> f64 {
    1.0 - libm::pow(1.0 - level, 1.0 / tests as f64)
}

impl ChiSquare {
    /// Compares `sample(i)`, the direction of draw number `i`, with `pdf` over solid angle.
    pub fn run(
        &self,
        mut sample: impl FnMut(usize) -> Option<Vec3>,
        pdf: impl Fn(Vec3) -> f32,
    ) -> Outcome {
        let cells = self.rings * self.spokes;
        let mut counts = vec![0.0_f64; cells];
        let mut drawn = 0;
        for draw in 0..self.draws {
            let Some(w) = sample(draw) else { continue };
            let theta = f64::from(w.z).clamp(-1.0, 1.0).acos();
            let phi = f64::from(w.y).atan2(f64::from(w.x)).rem_euclid(2.0 * PI);
            let ring = ((theta / PI * self.rings as f64) as usize).min(self.rings - 1);
            let spoke = ((phi / (2.0 * PI) * self.spokes as f64) as usize).min(self.spokes - 1);
            counts[ring * self.spokes + spoke] += 1.0;
            drawn += 1;
        }
        let expected: Vec<f64> = (0..cells)
            .map(|cell| self.mass(cell, &pdf) * self.draws as f64)
            .collect();
        let total_density = expected.iter().sum::<f64>() / self.draws as f64;
        let (statistic, degrees_of_freedom) = pooled(&counts, &expected);
        Outcome {
            p_value: upper_gamma_ratio(0.5 * degrees_of_freedom as f64, 0.5 * statistic),
            statistic,
            degrees_of_freedom,
            total_density,
            drawn: f64::from(drawn) / self.draws as f64,
        }
    }

    fn mass(&self, cell: usize, pdf: &impl Fn(Vec3) -> f32) -> f64 {
        let (ring, spoke) = (cell / self.spokes, cell % self.spokes);
        let height = PI / self.rings as f64 / self.midpoints as f64;
        let width = 2.0 * PI / self.spokes as f64 / self.midpoints as f64;
        let mut sum = 0.0;
        for i in 0..self.midpoints {
            let theta = height * ((ring * self.midpoints + i) as f64 + 0.5);
            for j in 0..self.midpoints {
                let phi = width * ((spoke * self.midpoints + j) as f64 + 0.5);
                let w = Vec3::new(
                    (theta.sin() * phi.cos()) as f32,
                    (theta.sin() * phi.sin()) as f32,
                    theta.cos() as f32,
                );
                sum += f64::from(pdf(w)) * theta.sin() * height * width;
            }
        }
        sum
    }
}

/// The statistic with cells of small expectation pooled, and its degrees of freedom.
fn pooled(counts: &[f64], expected: &[f64]) -> (f64, usize) {
    const LEAST: f64 = 5.0;
    let mut order: Vec<usize> = (0..counts.len()).collect();
    order.sort_by(|&a, &b| expected[a].total_cmp(&expected[b]));
    let (mut statistic, mut cells) = (0.0, 0_usize);
    let (mut pool_count, mut pool_expected) = (0.0, 0.0);
    for cell in order {
        if expected[cell] <= 0.0 {
            // Where nothing may be drawn, one draw is a failure.
            statistic += if counts[cell] > 0.0 {
                f64::INFINITY
            } else {
                0.0
            };
        } else if expected[cell] < LEAST || (pool_expected > 0.0 && pool_expected < LEAST) {
            pool_count += counts[cell];
            pool_expected += expected[cell];
        } else {
            let difference = counts[cell] - expected[cell];
            statistic += difference * difference / expected[cell];
            cells += 1;
        }
    }
    if pool_expected > 0.0 {
        let difference = pool_count - pool_expected;
        statistic += difference * difference / pool_expected;
        cells += 1;
    }
    (statistic, cells.saturating_sub(1))
}

/// `Γ(a, x) / Γ(a)`, by series or continued fraction (Abramowitz and Stegun 6.5.29, 6.5.31).
pub fn upper_gamma_ratio(a: f64, x: f64) -> f64 {
    if x.is_infinite() {
        return 0.0;
    }
    if x <= 0.0 {
        return 1.0;
    }
    let scale = libm::exp(a * libm::log(x) - x - libm::lgamma(a));
    if x < a + 1.0 {
        let (mut term, mut sum, mut n) = (1.0 / a, 1.0 / a, a);
        while term > sum * 1e-16 {
            n += 1.0;
            term *= x / n;
            sum += term;
        }
        return 1.0 - scale * sum;
    }
    // Lentz's method.
    let tiny = 1e-300;
    let mut b = x + 1.0 - a;
    let mut c = 1.0 / tiny;
    let mut d = 1.0 / b;
    let mut fraction = d;
    for i in 1..10_000 {
        let numerator = -f64::from(i) * (f64::from(i) - a);
        b += 2.0;
        d = 1.0 / (numerator * d + b);
        c = b + numerator / c;
        fraction *= d * c;
        if (d * c - 1.0).abs() < 1e-15 {
            break;
        }
    }
    scale * fraction
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn p_values_match_the_tables() {
        // Chi-square quantiles at 95 %: 3.841 (1), 18.307 (10), 124.342 (100).
        for (degrees, quantile) in [(1.0, 3.841_459), (10.0, 18.307_038), (100.0, 124.342_113)] {
            let p = upper_gamma_ratio(0.5 * degrees, 0.5 * quantile);
            assert!((p - 0.05).abs() < 1e-6, "{degrees}: {p}");
        }
    }

    #[test]
    fn a_wrong_density_is_found_and_a_right_one_is_not() {
        let test = ChiSquare {
            rings: 10,
            spokes: 20,
            draws: 100_000,
            midpoints: 4,
        };
        let sample = |i: usize| {
            let z = 1.0 - 2.0 * (i as f32 + 0.5) / 100_000.0;
            let phi = i as f32 * 2.399_963_2 % (2.0 * std::f32::consts::PI);
            let radius = (1.0 - z * z).sqrt();
            Some(Vec3::new(radius * phi.cos(), radius * phi.sin(), z))
        };
        let even = 1.0 / (4.0 * std::f32::consts::PI);
        assert!(test.run(sample, |_| even).p_value > 0.01);
        assert!(test.run(sample, |w| even * (1.0 + 0.1 * w.z)).p_value < 1e-6);
    }
}
