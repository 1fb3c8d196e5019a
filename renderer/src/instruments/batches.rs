//! Sums of paths in independent batches, and the standard errors that they give.
//!
//! Each batch takes scrambled Sobol points of its own, so that batches are independent of each
//! other while the points within one are evenly spread. The error of a figure is estimated from the
//! differences between batches. To get a smaller error, all batches go on to twice their points.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use rayon::prelude::*;

use crate::sampling::stream::Stream;

/// Number of independent batches. The standard error is itself uncertain by 1 part in √(2 · 31), 13
/// percent.
const BATCHES: u32 = 32;

/// Fewest rays of a figure: some points for each batch.
pub const FEWEST_RAYS: u64 = 16 * BATCHES as u64;

/// Points of each batch from which on an error is believed to be below a target: fewer may all have
/// missed what is rare.
const POINTS_TO_TRUST: u32 = 256;

/// Rays after which an experiment ends if none of them counted.
const RAYS_FOR_NOTHING: u64 = 1 << 20;

/// What is met in none of n rays is met in less than 3 / n of them, with a confidence of 95 percent:
/// (1 - 3 / n)^n is e^-3.
const RULE_OF_THREE: f64 = 3.0;

/// How much light is followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Budget {
    /// Rays for each set of wavelengths and each light; with a target error the most.
    pub rays: u64,
    /// Standard error at which a figure is good enough; `None` follows all rays.
    pub error: Option<Target>,
    /// Seed of every random number.
    pub seed: u64,
}

/// Who looks after an instrument while it measures.
pub struct Watch<'a> {
    /// When it is to end, whether or not it is done.
    pub until: Option<Instant>,
    /// Whether it is to end at once.
    pub stop: &'a AtomicBool,
    /// Hears how many rays have been followed of each light and set of wavelengths.
    pub tell: &'a (dyn Fn(u64) + Sync),
}

impl Watch<'_> {
    pub(super) fn is_over(&self) -> bool {
        let is_late = self.until.is_some_and(|until| Instant::now() >= until);
        is_late || self.stop.load(Ordering::Relaxed)
    }
}

/// A budget, and who may end an instrument before it is used up.
pub struct Effort<'a> {
    /// How much light is followed.
    pub budget: Budget,
    /// Nobody ends it early if there is none.
    pub watch: Option<&'a Watch<'a>>,
}

/// Time after which a watch is asked again.
const BETWEEN_LOOKS: Duration = Duration::from_millis(250);

/// Points of each batch before a watch is asked for the first time: [`FEWEST_RAYS`] are followed in
/// any case.
const FIRST_POINTS: u32 = 16;

/// A standard error at which a figure is good enough.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// The same for all figures.
    Absolute(f64),
    /// A fraction of the figure.
    Relative(f64),
}

impl std::fmt::Display for Target {
    /// As it is written after `--error`.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Absolute(error) => write!(f, "{error}"),
            Self::Relative(part) => write!(f, "{}%", 100.0 * part),
        }
    }
}

impl Target {
    /// Figures below this count as this much where an error is a fraction of them: no number of rays
    /// is enough for a figure that is 0.
    pub const LEAST_VALUE: f64 = 1e-4;

    /// The greatest error that is good enough for a figure of this value.
    pub fn allowed(self, value: f64) -> f64 {
        match self {
            Self::Absolute(error) => error,
            Self::Relative(part) => part * value.abs().max(Self::LEAST_VALUE),
        }
    }
}

/// What a ray adds to.
pub(super) trait Experiment: Sync {
    /// Number of sums; the first counts the rays that are figures' denominator.
    fn sums(&self) -> usize;

    /// The experiments with the same number get the same random numbers, so that figures at
    /// neighbouring wavelengths differ by what differs in the leaf.
    fn stream(&self) -> u32;

    /// Follows one ray.
    fn shoot(&self, stream: &mut Stream, sums: &mut [f64]);

    /// So many rays were followed in all.
    fn end(&self, _rays: u64) {}
}

/// A figure with its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Estimate {
    pub(super) value: f64,
    pub(super) error: f64,
    /// By how much each batch moves the value from where it is; the sum is 0.
    deviations: [f64; BATCHES as usize],
    /// The error is not less: what may have been missed by all rays.
    least_error: f64,
}

impl Estimate {
    /// What figures of the same batches make together: its value, and its derivative by each of
    /// them. Batches that move several figures alike count so in its error.
    pub(super) fn derived<'e>(value: f64, parts: impl Iterator<Item = (&'e Self, f64)>) -> Self {
        let mut deviations = [0.0; BATCHES as usize];
        let mut least_error = 0.0;
        for (part, derivative) in parts {
            for (sum, deviation) in deviations.iter_mut().zip(part.deviations) {
                *sum += derivative * deviation;
            }
            least_error += derivative.abs() * part.least_error;
        }
        Self::new(value, deviations, least_error)
    }

    /// A weighted sum of figures of the same batches.
    pub(super) fn weighted<'e>(parts: impl Iterator<Item = (&'e Self, f64)> + Clone) -> Self {
        let value = parts.clone().map(|(part, weight)| weight * part.value);
        Self::derived(value.sum(), parts)
    }

    /// The same fraction of light, 0 if it is within the rounding of single precision, to which
    /// weights of light add up.
    pub(super) fn beyond_rounding(&self) -> Self {
        const ROUNDING: f64 = 1e-6;
        if self.value.abs() >= ROUNDING {
            *self
        } else if self.error >= ROUNDING {
            Self {
                value: 0.0,
                ..*self
            }
        } else {
            Self::exact(0.0)
        }
    }

    /// A figure that is not estimated.
    pub(super) fn exact(value: f64) -> Self {
        Self::new(value, [0.0; BATCHES as usize], 0.0)
    }

    fn new(value: f64, deviations: [f64; BATCHES as usize], least_error: f64) -> Self {
        let count = f64::from(BATCHES);
        let squares: f64 = deviations
            .iter()
            .map(|deviation| deviation * deviation)
            .sum();
        let error = (squares * count / (count - 1.0)).sqrt();
        Self {
            value,
            // Of nothing, both are NaN.
            error: if least_error > 0.0 {
                error.max(least_error)
            } else {
                error
            },
            deviations,
            least_error,
        }
    }
}

/// The batches of one experiment.
struct Batches {
    /// Points of each batch so far.
    points: u32,
    /// Sums of each batch.
    sums: Vec<Vec<f64>>,
}

/// Carries out experiments within a budget, or until their watch ends them: the ratios of all further sums to the first, of each
/// experiment. A denominator of 0 gives NaN.
pub(super) fn estimates<E: Experiment>(
    experiments: &[E],
    effort: &Effort<'_>,
) -> Vec<Vec<Estimate>> {
    let (budget, watch) = (&effort.budget, effort.watch);
    let most = budget.rays.div_ceil(u64::from(BATCHES));
    let most = u32::try_from(most).unwrap_or(u32::MAX).max(1);
    let mut all: Vec<Batches> = experiments
        .iter()
        .map(|experiment| Batches {
            points: 0,
            sums: vec![vec![0.0; experiment.sums()]; BATCHES as usize],
        })
        .collect();
    // Sums are the same however many points are followed between two looks.
    let mut step = watch.map_or(u32::MAX, |_| FIRST_POINTS);
    'goals: loop {
        let is_open = |batches: &Batches| {
            batches.points < most && !batches.is_in_vain() && !batches.is_good(budget.error)
        };
        let open: Vec<usize> = (0..all.len()).filter(|&i| is_open(&all[i])).collect();
        if open.is_empty() {
            break;
        }
        let goal = |points: u32| match budget.error {
            Some(_) => points.saturating_mul(2).clamp(16, most.max(16)).min(most),
            // The same sums in the same order, with one look whether they are in vain.
            None if points == 0 => most.min((RAYS_FOR_NOTHING / u64::from(BATCHES)) as u32),
            None => most,
        };
        // Those that are open have followed as many points.
        let goal = goal(all[open[0]].points);
        while all[open[0]].points < goal {
            let started = Instant::now();
            let end = all[open[0]].points.saturating_add(step).min(goal);
            let work: Vec<(usize, u32)> = open
                .iter()
                .flat_map(|&i| (0..BATCHES).map(move |batch| (i, batch)))
                .collect();
            let found: Vec<Vec<f64>> = work
                .par_iter()
                .map(|&(i, batch)| {
                    let experiment = &experiments[i];
                    let before = &all[i];
                    let mut sums = before.sums[batch as usize].clone();
                    for point in before.points..end {
                        let mut stream =
                            Stream::new(budget.seed, experiment.stream(), batch, point);
                        experiment.shoot(&mut stream, &mut sums);
                    }
                    sums
                })
                .collect();
            for ((i, batch), sums) in work.into_iter().zip(found) {
                all[i].sums[batch as usize] = sums;
            }
            for &i in &open {
                all[i].points = end;
            }
            if let Some(watch) = watch {
                (watch.tell)(u64::from(end) * u64::from(BATCHES));
                if watch.is_over() {
                    break 'goals;
                }
                if started.elapsed() < BETWEEN_LOOKS {
                    step = step.saturating_mul(2);
                } else if started.elapsed() > 4 * BETWEEN_LOOKS {
                    step = (step / 2).max(FIRST_POINTS);
                }
            }
        }
    }
    for (experiment, batches) in experiments.iter().zip(&all) {
        experiment.end(u64::from(batches.points) * u64::from(BATCHES));
    }
    all.iter().map(Batches::estimates).collect()
}

impl Batches {
    /// Whether every figure's error is small enough.
    fn is_good(&self, target: Option<Target>) -> bool {
        let Some(target) = target else {
            return false;
        };
        self.points >= POINTS_TO_TRUST
            && self.total(0) >= FEWEST_RAYS as f64
            && self
                .estimates()
                .iter()
                .all(|estimate| estimate.error <= target.allowed(estimate.value))
    }

    /// Whether many rays were followed and none counted.
    fn is_in_vain(&self) -> bool {
        u64::from(self.points) * u64::from(BATCHES) >= RAYS_FOR_NOTHING && self.total(0) == 0.0
    }

    /// A sum over all batches.
    fn total(&self, number: usize) -> f64 {
        self.sums.iter().map(|sums| sums[number]).sum()
    }

    /// Ratios of sums with their standard errors, from the batches' deviations.
    ///
    /// Deviations say nothing of a share that no ray or every ray had, and little of few rays: the
    /// error is then at least the bound of what may have been missed.
    fn estimates(&self) -> Vec<Estimate> {
        let all = self.total(0);
        let missed = (RULE_OF_THREE / all).min(1.0);
        let figures = 1..self.sums[0].len();
        let estimate = |number: usize| {
            let total = self.total(number);
            let value = total / all;
            let mut deviations = [0.0; BATCHES as usize];
            for (deviation, sums) in deviations.iter_mut().zip(&self.sums) {
                *deviation = (sums[number] - value * sums[0]) / all;
            }
            let is_unknown = total == 0.0 || total == all || all < FEWEST_RAYS as f64;
            let is_any = all > 0.0;
            Estimate::new(
                value,
                deviations,
                if is_unknown && is_any { missed } else { 0.0 },
            )
        };
        figures.map(estimate).collect()
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicU64, Ordering};

    use super::*;

    fn measured<E: Experiment>(experiments: &[E], budget: Budget) -> Vec<Vec<Estimate>> {
        let watch = None;
        estimates(experiments, &Effort { budget, watch })
    }

    #[test]
    fn a_watch_ends_a_measurement_early_and_changes_no_bit_of_one_that_is_done() {
        let budget = Budget {
            rays: 1 << 16,
            error: None,
            seed: 5,
        };
        let stop = AtomicBool::new(false);
        let told = AtomicU64::new(0);
        let tell = |rays: u64| told.store(rays, Ordering::Relaxed);
        let watched = |until: Option<Instant>, budget: Budget| {
            let watch = Watch {
                until,
                stop: &stop,
                tell: &tell,
            };
            let watch = Some(&watch);
            estimates(&[Disc], &Effort { budget, watch })
        };
        for error in [None, Some(Target::Absolute(1e-3))] {
            let budget = Budget { error, ..budget };
            assert_eq!(watched(None, budget), measured(&[Disc], budget));
        }
        let endless = Budget {
            rays: 1 << 40,
            ..budget
        };
        let found = &watched(Some(Instant::now()), endless)[0];
        assert_eq!(told.load(Ordering::Relaxed), FEWEST_RAYS);
        let truth = std::f64::consts::FRAC_PI_4;
        assert!(
            (found[0].value - truth).abs() < 5.0 * found[0].error,
            "{found:?}"
        );
        stop.store(true, Ordering::Relaxed);
        watched(None, endless);
        assert_eq!(told.load(Ordering::Relaxed), FEWEST_RAYS);
    }

    /// A disc in a square: the share of points in it, and half of that.
    struct Disc;

    #[test]
    fn what_is_derived_has_the_error_that_batches_say() {
        let budget = Budget {
            rays: 1 << 12,
            error: None,
            seed: 3,
        };
        let found = &measured(&[Disc], budget)[0];
        let [whole, half] = [found[0], found[1]];
        // The second figure is half of the first in every batch.
        let nothing = Estimate::weighted([(&whole, 0.5), (&half, -1.0)].into_iter());
        assert!(
            nothing.value.abs() < 1e-12 && nothing.error < 1e-12,
            "{nothing:?}"
        );
        let both = Estimate::weighted([(&whole, 1.0), (&half, 2.0)].into_iter());
        assert!((both.error - 2.0 * whole.error).abs() < 1e-12, "{both:?}");
        let sum = whole.value + half.value;
        let ratio = (whole.value - half.value) / sum;
        let by = [2.0 * half.value, -2.0 * whole.value].map(|by| by / (sum * sum));
        let ratio = Estimate::derived(ratio, [(&whole, by[0]), (&half, by[1])].into_iter());
        assert!(
            (ratio.value - 1.0 / 3.0).abs() < 1e-12 && ratio.error < 1e-12,
            "{ratio:?}"
        );
    }

    impl Experiment for Disc {
        fn sums(&self) -> usize {
            3
        }

        fn stream(&self) -> u32 {
            7
        }

        fn shoot(&self, stream: &mut Stream, sums: &mut [f64]) {
            let [x, y, ..] = stream.next4();
            let is_in = (x - 0.5).powi(2) + (y - 0.5).powi(2) < 0.25;
            sums[0] += 1.0;
            sums[1] += f64::from(u8::from(is_in));
            sums[2] += 0.5 * f64::from(u8::from(is_in));
        }
    }

    #[test]
    fn the_error_that_is_reported_is_the_error_that_is_made() {
        // Over many seeds the deviations in units of the told error have a variance of about 1; of
        // 31 degrees of freedom, it is 31 / 29.
        let truth = std::f64::consts::FRAC_PI_4;
        let seeds = 400;
        let mut squares = 0.0;
        for seed in 0..seeds {
            let budget = Budget {
                rays: 2048,
                error: None,
                seed,
            };
            let found = measured(&[Disc], budget)[0][0];
            squares += ((found.value - truth) / found.error).powi(2);
        }
        let variance = squares / seeds as f64;
        // The deviation of a variance over 400 seeds is √(2 / 400) = 0.07.
        assert!((variance - 31.0 / 29.0).abs() < 0.3, "{variance}");
    }

    /// Rays of which a small share counts; of these, half give their light to the first figure and
    /// none to the second.
    struct Needle {
        share: f64,
        rays: AtomicU64,
    }

    impl Needle {
        fn new(share: f64) -> Self {
            let rays = AtomicU64::new(0);
            Self { share, rays }
        }
    }

    impl Experiment for Needle {
        fn sums(&self) -> usize {
            3
        }

        fn stream(&self) -> u32 {
            3
        }

        fn shoot(&self, stream: &mut Stream, sums: &mut [f64]) {
            self.rays.fetch_add(1, Ordering::Relaxed);
            let [x, y, ..] = stream.next4();
            if f64::from(x) < self.share {
                sums[0] += 1.0;
                sums[1] += f64::from(u8::from(y < 0.5));
            }
        }
    }

    #[test]
    fn few_hits_are_not_reported_as_certain() {
        let target = 0.02;
        for seed in 0..4 {
            let mut budget = Budget {
                rays: FEWEST_RAYS,
                error: Some(Target::Absolute(target)),
                seed,
            };
            for doublings in 0..6 {
                budget.rays = 2048 << doublings;
                for figure in &measured(&[Needle::new(1.0 / 3000.0)], budget)[0] {
                    // Some 20 hits of 65536 rays; of no hits both are NaN.
                    assert!(figure.value.is_nan() || figure.error > 0.05, "{figure:?}");
                }
            }
            budget.rays = 1 << 30;
            let found = &measured(&[Needle::new(1.0 / 3000.0)], budget)[0];
            assert!(found[0].error <= target, "{found:?}");
            assert!((found[0].value - 0.5).abs() < 5.0 * target, "{found:?}");
            assert!(found[1].value == 0.0 && found[1].error > 1e-4, "{found:?}");
        }
    }

    #[test]
    fn rays_of_which_none_counts_end_early() {
        for error in [
            None,
            Some(Target::Absolute(1e-3)),
            Some(Target::Relative(0.01)),
        ] {
            let nothing = [Needle::new(0.0)];
            let budget = Budget {
                rays: 1 << 40,
                error,
                seed: 1,
            };
            let found = &measured(&nothing, budget)[0];
            assert!(found[0].value.is_nan(), "{found:?}");
            assert_eq!(nothing[0].rays.load(Ordering::Relaxed), RAYS_FOR_NOTHING);
        }
    }

    #[test]
    fn a_relative_target_holds_for_great_and_small_figures_and_ends_where_there_is_nothing() {
        let budget = Budget {
            rays: 1 << 24,
            error: Some(Target::Relative(0.01)),
            seed: 1,
        };
        let relative = [Needle::new(0.5)];
        let found = &measured(&relative, budget)[0];
        assert!(found[0].error <= 0.01 * found[0].value, "{found:?}");
        // Of a figure of 0 a hundredth of the least value that counts.
        assert!(found[1].value == 0.0 && found[1].error <= 1e-6, "{found:?}");
        let budget = Budget {
            error: Some(Target::Absolute(0.01)),
            ..budget
        };
        let absolute = [Needle::new(0.5)];
        assert!(measured(&absolute, budget)[0][1].error <= 0.01);
        let [more, fewer] = [&relative, &absolute].map(|one| one[0].rays.load(Ordering::Relaxed));
        assert!(more > 100 * fewer, "{more} {fewer}");
    }

    #[test]
    fn what_is_within_rounding_is_nothing() {
        let figure = |value, error| Estimate {
            value,
            error,
            ..Estimate::exact(0.0)
        };
        for (value, error, expected) in [
            (4e-8, 1e-9, (0.0, 0.0)),
            (-3e-7, 2e-8, (0.0, 0.0)),
            (5e-7, 2e-5, (0.0, 2e-5)),
            (2e-6, 1e-9, (2e-6, 1e-9)),
        ] {
            let found = figure(value, error).beyond_rounding();
            assert_eq!((found.value, found.error), expected);
        }
    }

    #[test]
    fn a_target_error_is_reached_with_few_rays_and_figures_keep_their_ratios() {
        let budget = Budget {
            rays: 1 << 24,
            error: Some(Target::Absolute(2e-4)),
            seed: 1,
        };
        let found = &measured(&[Disc], budget)[0];
        assert!(found.iter().all(|figure| figure.error <= 2e-4));
        let truth = std::f64::consts::FRAC_PI_4;
        assert!((found[0].value - truth).abs() < 5.0 * found[0].error);
        assert!((found[1].value - 0.5 * found[0].value).abs() < 1e-12);
    }
}
