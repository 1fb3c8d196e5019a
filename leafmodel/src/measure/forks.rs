//! Angles and widths where veins branch.

use super::skeleton::{Skeleton, angle_deg};
use super::statistics::median;

/// Steps of Newton's method; it converges in a handful, in any case from below.
const NEWTON_STEPS: usize = 60;

/// Measures of junctions.
pub(super) struct Forks {
    /// Nodes with three or more edges.
    pub(super) junctions: usize,
    /// Share of them with three.
    pub(super) degree_3_share: Option<f64>,
    /// Median angle between the daughters of a fork.
    pub(super) angle_deg: Option<f64>,
    /// Median deflection of the wider daughter from the parent's direction.
    pub(super) wide_deg: Option<f64>,
    /// Median deflection of the finer daughter.
    pub(super) fine_deg: Option<f64>,
    /// Median of `r_parentⁿ / Σ r_childⁿ`.
    pub(super) murray_ratio: Option<f64>,
    /// Median of the `n` for which that ratio is 1.
    pub(super) murray_exponent: Option<f64>,
}

impl Forks {
    /// Measures every junction. A *fork* is a junction with one vein that leads to it and two or
    /// more that lead away.
    pub(super) fn new(skeleton: &Skeleton, exponent: f64) -> Self {
        let (mut junctions, mut of_degree_3) = (0, 0);
        let (mut angles, mut wides, mut fines) = (Vec::new(), Vec::new(), Vec::new());
        let (mut ratios, mut exponents) = (Vec::new(), Vec::new());
        let murray = exponent.is_finite() && exponent > 0.0;
        for node in skeleton.nodes() {
            let out = skeleton.topology.leaving(node);
            let entering = skeleton.topology.entering(node);
            let degree = out.len() + entering.len();
            if degree < 3 {
                continue;
            }
            junctions += 1;
            of_degree_3 += usize::from(degree == 3);
            let &[parent] = entering else { continue };
            if let &[first, second] = out {
                let radius = |edge| skeleton.edge(edge).radius_to;
                let (wide, fine) = if radius(first) >= radius(second) {
                    (first, second)
                } else {
                    (second, first)
                };
                let arrival = skeleton.arrival(parent);
                let (wide, fine) = (skeleton.departure(wide), skeleton.departure(fine));
                angles.push(angle_deg(wide, fine));
                wides.push(angle_deg(arrival, wide));
                fines.push(angle_deg(arrival, fine));
            }
            // Along its first edge a continuing vein tapers from its parent's radius to its own, so
            // the radius at the far end is used.
            let parent = skeleton.edge(parent).radius_to;
            let shares = out.iter().map(|&e| skeleton.edge(e).radius_to / parent);
            if murray {
                let sum: f64 = shares.clone().map(|x| libm::pow(x, exponent)).sum();
                ratios.push(1.0 / sum);
            }
            exponents.extend(fitted_exponent(&shares));
        }
        let share = of_degree_3 as f64 / f64::max(junctions as f64, 1.0);
        Self {
            junctions,
            degree_3_share: (junctions > 0).then_some(share),
            angle_deg: median(&mut angles),
            wide_deg: median(&mut wides),
            fine_deg: median(&mut fines),
            murray_ratio: median(&mut ratios),
            murray_exponent: median(&mut exponents),
        }
    }
}

/// The `n > 0` for which `Σ xᵢⁿ = 1`. It exists and is unique if there are several `xᵢ`, all
/// below 1.
pub(super) fn fitted_exponent(shares: &(impl Iterator<Item = f64> + Clone)) -> Option<f64> {
    let least = shares.clone().fold(f64::INFINITY, f64::min);
    if shares.clone().any(|x| x >= 1.0) {
        return None;
    }
    // Starts at the solution for all `xᵢ` equal to the least one. The sum is decreasing and convex,
    // so Newton's method converges from the left.
    let mut n = libm::log(shares.clone().count() as f64) / -libm::log(least);
    for _ in 0..NEWTON_STEPS {
        let (mut sum, mut slope) = (-1.0, 0.0);
        for x in shares.clone() {
            let (log, power) = (libm::log(x), libm::pow(x, n));
            sum += power;
            slope += log * power;
        }
        let step = -sum / slope;
        n += step;
        if step.abs() <= 1e-12 * n {
            break;
        }
    }
    n.is_finite().then_some(n)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fitted_exponent_solves_murrays_law() {
        for n in [0.7, 2.0, 3.0, 4.5] {
            for share in [0.5, 0.9, 0.999, 1e-4] {
                let x = libm::pow(share, 1.0 / n);
                let y = libm::pow(1.0 - share, 1.0 / n);
                let fitted = fitted_exponent(&[x, y].into_iter()).expect("both are below 1");
                assert!((fitted - n).abs() < 1e-8, "{fitted} is not {n} at {share}");
            }
        }
        assert_eq!(fitted_exponent(&[1.0, 0.5].into_iter()), None);
    }
}
