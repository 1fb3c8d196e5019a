//! How far simulations are from the observation, and the sample of those that are near.

use super::linear::{Factor, moments};
use super::problem::Problem;
use super::random::{member, uniform};
use super::regression::{Lesson, Regression};
use super::simulated::{Counts, Particle, Shortage};
use crate::random::Use;

/// Regressions, each of which learns from the nearer half of what the one before learned from.
const ROUNDS: usize = 3;

/// Share of the simulations that are in the sample.
const ACCEPTED: f64 = 0.3;

/// Share of the sample within the prior's range below which its members are put there.
const LEAST_INSIDE: f64 = 0.05;

/// What fits.
#[derive(Clone, Debug)]
pub(super) struct Located {
    /// Places within the prior's range, moved to the observation, and weights > 0.
    pub(super) sample: Vec<(Vec<f64>, f64)>,
    /// Where the measures let expect the parameters, which may be beyond the prior's range.
    pub(super) expected: Vec<f64>,
    /// Largest distance in the sample.
    pub(super) tolerance: f64,
    /// Measures that are the same in all simulations, and whether the observation has that value.
    pub(super) constant: Vec<(String, bool)>,
}

impl Located {
    /// Sums of weights up to each member; the last one is 1.
    pub(super) fn sums(&self) -> Vec<f64> {
        let total: f64 = self.sample.iter().map(|(_, weight)| weight).sum();
        let mut sum = 0.0;
        let sums = self.sample.iter().map(|(_, weight)| {
            sum += weight / total;
            sum
        });
        sums.collect()
    }

    /// Places drawn from the sample.
    pub(super) fn resampled(&self, seed: u64, generation: u32, count: usize) -> Vec<Vec<f64>> {
        let sums = self.sums();
        let one = |number: u32| {
            let share = uniform(seed, Use::Member, generation, number, 0);
            let share = (f64::from(number) + share) / count as f64;
            self.sample[member(&sums, share)].0.clone()
        };
        (0..count as u32).map(one).collect()
    }
}

/// Simulations that can be compared.
struct Comparable {
    places: Vec<Vec<f64>>,
    weights: Vec<f64>,
    /// Fitted measures of each simulation, on their scales.
    measures: Vec<Vec<f64>>,
    /// The same of the observation.
    observed: Vec<f64>,
}

/// The simulations nearest to the observation, moved to it.
///
/// Distance is that of the parameters that a regression lets expect from the measures
/// (\[fearnhead2012\]), in units of the errors of that regression. The regression learns from all
/// simulations first and then from those that are near. Weights are those given, times
/// Epanechnikov's kernel; a place is moved by what the regression expects between its measures and
/// the observed ones (\[beaumont2002\]), where what it expects of a simulation is learned from the
/// others.
pub(super) fn locate(
    problem: &Problem,
    particles: &[Particle],
    weights: &[f64],
    counts: impl Fn() -> Counts,
) -> Result<Located, Shortage> {
    let parameters = problem.parameters.len();
    let needed = 30 + 5 * parameters;
    let (comparable, constant) = comparable(problem, particles, weights);
    let count = comparable.places.len();
    if count < needed {
        return Err(Shortage::TooFew {
            usable: count,
            needed,
            counts: counts(),
        });
    }
    if comparable.observed.is_empty() {
        return Err(Shortage::NothingVaries);
    }
    // Four rows for each number that is learned, where there are as many.
    let fewest = needed.max(4 * (comparable.observed.len() + 1)).min(count);
    let mut nearest: Vec<usize> = (0..count).collect();
    let mut learned = comparable.learn(&nearest);
    for round in 1..ROUNDS {
        let room = (count >> round).max(fewest);
        nearest = order(&learned.distances);
        nearest.truncate(room);
        // In the order of the simulations, so that sums are.
        nearest.sort_unstable();
        learned = comparable.learn(&nearest);
    }
    let accepted = ((ACCEPTED * count as f64) as usize).max(needed).min(count);
    let order = order(&learned.distances);
    let tolerance = learned.distances[order[accepted - 1]];
    let mut members: Vec<usize> = order[..accepted].to_vec();
    members.sort_unstable();
    let weighed = |kernel: &dyn Fn(f64) -> f64| -> Vec<(Vec<f64>, f64)> {
        let members = members.iter().map(|i| {
            let weight = comparable.weights[*i] * kernel(learned.distances[*i]);
            (learned.moved[*i].clone(), weight)
        });
        members.filter(|(_, weight)| *weight > 0.0).collect()
    };
    let mut moved = weighed(&|distance| {
        let share = distance / tolerance;
        1.0 - share * share
    });
    // Where the nearest are all equally far, all are alike.
    if moved.len() < 2 {
        moved = weighed(&|_| 1.0);
    }
    Ok(Located {
        sample: within_range(truncated(moved)),
        expected: learned.expected,
        tolerance,
        constant,
    })
}

/// Weights cut at their mean times the root of their number (\[ionides2008\]): one simulation from
/// where few were proposed would outweigh all others.
fn truncated(mut sample: Vec<(Vec<f64>, f64)>) -> Vec<(Vec<f64>, f64)> {
    let count = sample.len() as f64;
    let sum: f64 = sample.iter().map(|(_, weight)| weight).sum();
    let most = sum / count.sqrt();
    for (_, weight) in &mut sample {
        *weight = weight.min(most);
    }
    sample
}

/// The members within the prior's range, outside of which the posterior is 0. If next to none are,
/// or one alone, the measures ask for something that lies beyond; then all are put to the nearest
/// place within.
fn within_range(moved: Vec<(Vec<f64>, f64)>) -> Vec<(Vec<f64>, f64)> {
    let is_inside = |place: &[f64]| place.iter().all(|x| (0.0..=1.0).contains(x));
    let total: f64 = moved.iter().map(|(_, weight)| weight).sum();
    let inside: Vec<f64> = moved
        .iter()
        .filter(|(place, _)| is_inside(place))
        .map(|(_, weight)| *weight)
        .collect();
    if inside.len() > 1 && inside.iter().sum::<f64>() >= LEAST_INSIDE * total {
        let mut moved = moved;
        moved.retain(|(place, _)| is_inside(place));
        return moved;
    }
    let clamped = |(place, weight): (Vec<f64>, f64)| {
        let place = place.into_iter().map(|x| x.clamp(0.0, 1.0));
        (place.collect(), weight)
    };
    moved.into_iter().map(clamped).collect()
}

/// Indices from the smallest distance to the largest; of equal ones the first comes first.
fn order(distances: &[f64]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..distances.len()).collect();
    order.sort_by(|a, b| distances[*a].total_cmp(&distances[*b]));
    order
}

/// What a regression says of all simulations.
struct Learned {
    distances: Vec<f64>,
    /// Places moved to the observation.
    moved: Vec<Vec<f64>>,
    /// What the observation lets expect.
    expected: Vec<f64>,
}

impl Comparable {
    /// Learns from the simulations with these indices, which ascend.
    fn learn(&self, from: &[usize]) -> Learned {
        let measures: Vec<&[f64]> = from.iter().map(|i| self.measures[*i].as_slice()).collect();
        let places: Vec<&[f64]> = from.iter().map(|i| self.places[*i].as_slice()).collect();
        let weights: Vec<f64> = from.iter().map(|i| self.weights[*i]).collect();
        let lesson = Lesson {
            measures: &measures,
            places: &places,
            weights: &weights,
        };
        let (regression, left_out) = Regression::learn(lesson);
        let dimensions = self.places[0].len();
        let errors = left_out.iter().map(Vec::as_slice);
        let errors = errors.zip(weights.iter().copied());
        let (_, mut covariance) = moments(errors, dimensions);
        for (i, row) in covariance.iter_mut().enumerate() {
            // The prior has variance 1/12.
            row[i] = row[i] * (1.0 + 1e-9) + 1e-12;
        }
        let factor = Factor::of(&covariance);
        let factor = factor.expect("a covariance with something added to its diagonal has one");
        let expected = regression.estimate(&self.observed);
        let mut taught = from.iter().zip(&left_out).peekable();
        let mut learned = Learned {
            distances: Vec::with_capacity(self.places.len()),
            moved: Vec::with_capacity(self.places.len()),
            expected: Vec::new(),
        };
        for (i, place) in self.places.iter().enumerate() {
            let taught = taught.next_if(|(index, _)| **index == i);
            let error: Vec<f64> = if let Some((_, error)) = taught {
                error.clone()
            } else {
                let estimate = regression.estimate(&self.measures[i]);
                place.iter().zip(estimate).map(|(x, e)| x - e).collect()
            };
            let moved: Vec<f64> = expected.iter().zip(&error).map(|(x, e)| x + e).collect();
            let apart: Vec<f64> = place.iter().zip(&moved).map(|(x, m)| x - m).collect();
            let squares = factor.whitened(&apart).iter().map(|x| x * x).sum::<f64>();
            learned.distances.push(squares.sqrt());
            learned.moved.push(moved);
        }
        learned.expected = expected;
        learned
    }
}

/// The simulations that have all fitted measures, these on their scales without those that do not
/// vary, which are named.
fn comparable(
    problem: &Problem,
    particles: &[Particle],
    weights: &[f64],
) -> (Comparable, Vec<(String, bool)>) {
    let fitted = problem.fitted();
    let mut found = Comparable {
        places: Vec::new(),
        weights: Vec::new(),
        measures: Vec::new(),
        observed: Vec::new(),
    };
    for (particle, weight) in particles.iter().zip(weights) {
        let Ok(outcome) = &particle.outcome else {
            continue;
        };
        let measures: Option<Vec<f64>> = fitted
            .iter()
            .map(|index| {
                outcome
                    .get(*index)
                    .copied()
                    .flatten()
                    .filter(|x| x.is_finite())
            })
            .collect();
        if let Some(measures) = measures {
            let placed = problem.parameters.iter().zip(&particle.place);
            let settled = placed.map(|(parameter, place)| parameter.settled(*place));
            found.places.push(settled.collect());
            found.weights.push(*weight);
            found.measures.push(measures);
        }
    }
    let mut constant = Vec::new();
    let mut kept = vec![Vec::new(); found.measures.len()];
    for (column, index) in fitted.iter().enumerate() {
        let observation = &problem.observed[*index];
        let values = || found.measures.iter().map(|row| row[column]);
        let low = values().fold(f64::INFINITY, f64::min);
        let high = values().fold(f64::NEG_INFINITY, f64::max);
        if high - low <= 1e-12 * high.abs() {
            let is_same = (observation.value - low).abs() <= 1e-6 * low.abs();
            constant.push((observation.key.clone(), is_same));
            continue;
        }
        let scale = Scale::of(low.min(observation.value));
        found.observed.push(scale.at(observation.value));
        for (row, value) in kept.iter_mut().zip(values()) {
            row.push(scale.at(value));
        }
    }
    found.measures = kept;
    (found, constant)
}

/// The scale on which a measure is compared.
#[derive(Clone, Copy, Debug)]
enum Scale {
    /// Measures that are positive: equal ratios.
    Logarithm,
    /// Measures that may be 0, such as counts: equal deviations of Poisson's distribution.
    Root,
    /// Measures that may be negative.
    Plain,
}

impl Scale {
    /// The scale of measures that are `lowest` at least.
    fn of(lowest: f64) -> Self {
        if lowest > 0.0 {
            Self::Logarithm
        } else if lowest == 0.0 {
            Self::Root
        } else {
            Self::Plain
        }
    }

    fn at(self, value: f64) -> f64 {
        match self {
            Self::Logarithm => libm::log(value),
            Self::Root => value.sqrt(),
            Self::Plain => value,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_member_within_the_range_is_no_sample() {
        let beyond = |x: f64| (vec![x], 1.0);
        // A tenth of the weight, but one place: an interval of it would have no width.
        let mut moved: Vec<_> = (0..9).map(|i| beyond(1.5 + f64::from(i))).collect();
        moved.push(beyond(0.7));
        let sample = within_range(moved.clone());
        assert_eq!(sample.len(), 10);
        assert!(
            sample
                .iter()
                .all(|(place, _)| (0.0..=1.0).contains(&place[0]))
        );
        // Two are one.
        moved.push(beyond(0.6));
        assert_eq!(within_range(moved).len(), 2);
    }
}
