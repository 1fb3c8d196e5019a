//! All simulations so far, from where they were proposed, and what they weigh.

use std::f64::consts::TAU;

use super::distances::{Located, locate};
use super::linear::{Factor, moments};
use super::outcome::Outcome;
use super::problem::Problem;
use super::random::{member, normal, uniform};
use super::simulated::{Counts, Particle, Shortage};
use crate::random::Use;

/// A density from which places were drawn.
#[derive(Clone, Debug)]
enum Proposal {
    /// Uniform from 0 to 1 in each parameter.
    Prior,
    /// Normal distributions of one covariance around weighted points, as far as they lie in the
    /// prior's range.
    Around {
        points: Vec<Vec<f64>>,
        /// Sums of weights up to each point; the last is 1.
        sums: Vec<f64>,
        covariance: Factor,
        /// The points divided by the covariance's root.
        whitened: Vec<Vec<f64>>,
        /// The share of them in that range.
        inside: f64,
    },
}

/// Fewest draws from which the share of a proposal within the prior's range is estimated: its
/// error is 1 % at most.
const TRIALS: u32 = 10_000;

/// Simulations of all generations.
#[derive(Clone, Debug)]
pub(super) struct Population<'p> {
    problem: &'p Problem,
    particles: Vec<Particle>,
    /// Of each generation, and how many places were drawn from it.
    proposals: Vec<(Proposal, usize)>,
    /// Where the next generation comes from.
    next: Proposal,
}

impl<'p> Population<'p> {
    pub(super) fn new(problem: &'p Problem) -> Self {
        Self {
            problem,
            particles: Vec::new(),
            proposals: Vec::new(),
            next: Proposal::Prior,
        }
    }

    /// Places of the next generation.
    pub(super) fn propose(&mut self, generation: u32, count: usize) -> Vec<Vec<f64>> {
        let (seed, dimensions) = (self.problem.seed, self.problem.parameters.len());
        let mut places = Vec::with_capacity(count);
        match &mut self.next {
            Proposal::Prior => places.extend((0..count as u32).map(|number| {
                let one = |dimension| uniform(seed, Use::Prior, generation, number, dimension);
                (0..dimensions as u32).map(one).collect()
            })),
            Proposal::Around {
                points,
                sums,
                covariance,
                inside,
                ..
            } => {
                let (mut within, mut trial) = (0_u32, 0);
                while trial < TRIALS || places.len() < count {
                    let share = uniform(seed, Use::Member, generation, trial, 0);
                    let step = covariance.coloured(&normal(seed, generation, trial, dimensions));
                    let point = points[member(sums, share)].iter().zip(step);
                    let place: Vec<f64> = point.map(|(x, step)| x + step).collect();
                    trial += 1;
                    if is_inside(&place) {
                        within += 1;
                        if places.len() < count {
                            places.push(place);
                        }
                    }
                }
                *inside = f64::from(within) / f64::from(trial);
            }
        }
        self.proposals.push((self.next.clone(), count));
        places
    }

    /// Takes in what became of the places of the last generation.
    pub(super) fn take(&mut self, places: Vec<Vec<f64>>, outcomes: Vec<Outcome>) {
        let pairs = places.into_iter().zip(outcomes);
        self.particles
            .extend(pairs.map(|(place, outcome)| Particle { place, outcome }));
    }

    /// What fits, from all simulations.
    pub(super) fn locate(&self) -> Result<Located, Shortage> {
        locate(self.problem, &self.particles, &self.weights(), || {
            self.counts()
        })
    }

    /// Lets the next generation come from around what fits: a normal distribution around each point
    /// of the sample, with twice the sample's covariance (\[beaumont2009\]). The sample is the one
    /// that was moved to the observation, where the paper has the one before that; what is left of
    /// it by simulations that are not near enough is made up for by the weights.
    pub(super) fn centre(&mut self, located: &Located) {
        let dimensions = self.problem.parameters.len();
        let sample = located.sample.iter();
        let (_, mut covariance) =
            moments(sample.map(|(place, w)| (place.as_slice(), *w)), dimensions);
        for (i, row) in covariance.iter_mut().enumerate() {
            for x in row.iter_mut() {
                *x *= 2.0;
            }
            // A parameter that a simulator without chance tells exactly keeps some room.
            row[i] = row[i] * (1.0 + 1e-9) + 1e-12;
        }
        let Some(covariance) = Factor::of(&covariance) else {
            return;
        };
        let points: Vec<Vec<f64>> = located.sample.iter().map(|(p, _)| p.clone()).collect();
        self.next = Proposal::Around {
            whitened: points.iter().map(|p| covariance.whitened(p)).collect(),
            sums: located.sums(),
            points,
            covariance,
            inside: 1.0,
        };
    }

    /// Prior over the mixture of all proposals, for each simulation: the weights of
    /// \[cornuet2012\], at most all simulations over those from the prior.
    fn weights(&self) -> Vec<f64> {
        let all = self.particles.len() as f64;
        let weight = |particle: &Particle| {
            let proposals = self.proposals.iter();
            let mixture: f64 = proposals
                .map(|(proposal, count)| *count as f64 / all * proposal.over_prior(&particle.place))
                .sum();
            1.0 / mixture
        };
        self.particles.iter().map(weight).collect()
    }

    pub(super) fn counts(&self) -> Counts {
        let mut counts = Counts {
            all: self.particles.len(),
            ..Counts::default()
        };
        let mut missing = vec![0; self.problem.observed.len()];
        for particle in &self.particles {
            match &particle.outcome {
                Ok(measures) => {
                    for (count, measure) in missing.iter_mut().zip(measures) {
                        *count += usize::from(measure.is_none_or(|value| !value.is_finite()));
                    }
                }
                Err(problem) => {
                    counts.failed += 1;
                    counts.first_failure.get_or_insert_with(|| problem.clone());
                }
            }
        }
        let keyed = self.problem.observed.iter().zip(missing);
        counts.missing = keyed
            .filter(|(_, count)| *count > 0)
            .map(|(one, count)| (one.key.clone(), count))
            .collect();
        counts
    }
}

impl Proposal {
    /// Its density over that of the prior, which is 1, at a place within the prior's range.
    fn over_prior(&self, place: &[f64]) -> f64 {
        match self {
            Self::Prior => 1.0,
            Self::Around {
                sums,
                covariance,
                whitened,
                inside,
                ..
            } => {
                let at = covariance.whitened(place);
                let mut before = 0.0;
                let mut density = 0.0;
                for (point, sum) in whitened.iter().zip(sums) {
                    let pairs = point.iter().zip(&at);
                    let apart: f64 = pairs.map(|(a, b)| (a - b) * (a - b)).sum();
                    density += (sum - before) * libm::exp(-0.5 * apart);
                    before = *sum;
                }
                let normal = libm::pow(TAU, 0.5 * place.len() as f64) * covariance.volume();
                density / (normal * inside)
            }
        }
    }
}

/// Whether a place lies in the prior's range.
fn is_inside(place: &[f64]) -> bool {
    place.iter().all(|x| (0.0..=1.0).contains(x))
}
