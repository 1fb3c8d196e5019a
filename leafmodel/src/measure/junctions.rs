//! Junctions: how many veins meet there, at which angles, and how widths add up by order.

use glam::DVec2;

use super::forks::fitted_exponent;
use super::skeleton::Skeleton;
use super::statistics::median;

/// Veins are nearly equal if the finest is at least so wide as a share of the widest.
const ALIKE: f64 = 0.75;

/// Three equal veins in balance leave 120° between them; from this angle on a junction is bent,
/// degrees.
const BENT: f64 = 150.0;

/// Measures of junctions.
pub(super) struct Junctions {
    /// Shares of nodes with 3, 4, and 5 or more edges among those with 3 or more; empty without.
    pub(super) degree_shares: Vec<f64>,
    /// Share of the junctions of three nearly equal veins whose largest angle is 150° or more.
    pub(super) bent_share: Option<f64>,
    /// Median of that largest angle, degrees.
    pub(super) largest_angle_deg: Option<f64>,
    /// Median of the exponent of Murray's law at forks, by the order of the parent.
    pub(super) exponents: Vec<Option<f64>>,
}

impl Junctions {
    pub(super) fn new(skeleton: &Skeleton) -> Self {
        let mut degrees = [0_u32; 3];
        let mut largest = Vec::new();
        let mut exponents: Vec<Vec<f64>> = Vec::new();
        for node in skeleton.nodes() {
            let (out, entering) = (
                skeleton.topology.leaving(node),
                skeleton.topology.entering(node),
            );
            let degree = out.len() + entering.len();
            if degree < 3 {
                continue;
            }
            degrees[(degree - 3).min(2)] += 1;
            if degree == 3 {
                let ways = entering.iter().map(|&edge| -skeleton.arrival(edge));
                let ways = ways.chain(out.iter().map(|&edge| skeleton.departure(edge)));
                let here = entering.iter().map(|&edge| skeleton.edge(edge).radius_to);
                let here = here.chain(out.iter().map(|&edge| skeleton.edge(edge).radius_from));
                let (widest, finest) = here.fold((0.0, f64::INFINITY), |(wide, fine), radius| {
                    (f64::max(wide, radius), f64::min(fine, radius))
                });
                if finest >= ALIKE * widest {
                    largest.push(largest_angle_deg(&ways.collect::<Vec<DVec2>>()));
                }
            }
            let &[parent] = entering else { continue };
            let parent = skeleton.edge(parent);
            let shares = out
                .iter()
                .map(|&edge| skeleton.edge(edge).radius_to / parent.radius_to);
            if let Some(exponent) = fitted_exponent(&shares) {
                let order = usize::from(parent.order);
                exponents.resize(exponents.len().max(order), Vec::new());
                exponents[order - 1].push(exponent);
            }
        }
        let count = f64::from(degrees.iter().sum::<u32>());
        let bent = largest.iter().filter(|&&angle| angle >= BENT).count();
        Self {
            degree_shares: if count > 0.0 {
                degrees.map(|of| f64::from(of) / count).to_vec()
            } else {
                Vec::new()
            },
            bent_share: (!largest.is_empty()).then(|| bent as f64 / largest.len() as f64),
            largest_angle_deg: median(&mut largest),
            exponents: exponents.iter_mut().map(|list| median(list)).collect(),
        }
    }
}

/// The largest angle between neighbours of some directions, degrees.
fn largest_angle_deg(ways: &[DVec2]) -> f64 {
    let mut turns: Vec<f64> = ways
        .iter()
        .map(|way| libm::atan2(way.y, way.x).to_degrees())
        .collect();
    turns.sort_by(f64::total_cmp);
    let around = turns.first().map_or(0.0, |first| first + 360.0);
    let next = turns.iter().skip(1).copied().chain([around]);
    turns
        .iter()
        .zip(next)
        .map(|(a, b)| b - a)
        .fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_angle_is_found_wherever_the_first_vein_points() {
        for turn in [0.0, 1.0, 2.5, 4.0, 6.0] {
            let ways = [0.0_f64, 100.0, 190.0].map(|degrees| {
                let angle = degrees.to_radians() + turn;
                DVec2::new(libm::cos(angle), libm::sin(angle))
            });
            let found = largest_angle_deg(&ways);
            assert!((found - 170.0).abs() < 1e-9, "{found}");
        }
    }
}
