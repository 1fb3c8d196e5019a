//! Choice of the effort of paths by a trial.
//!
//! The best effort differs from scene to scene. On a close-up of a leaf in the sun, light between
//! leaves causes most of the noise. Under a lamp among ten thousand leaves it causes almost none
//! but takes most of the time; there shadows cause most of the noise. So a few candidates are tried
//! on a sample of the pixels, before and apart from the picture, and the one with the least error ×
//! work is chosen: first among the numbers of light samples, with skies among them or left to
//! bounces, then, with that number, among pairs of threshold and branches, then among the numbers of
//! lit branches. Those that are much worse than the best after some of the pixels are tried no
//! further.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;

use crate::integrator::effort::Effort;
use crate::integrator::layers::{Layout, MOST_CHANNELS};
use crate::integrator::path::{self, PathResult};
use crate::integrator::settings::Job;
use crate::sampling::stream::{Pixel, Stream};
use crate::world::World;

/// Numbers of light samples that are tried, each with the pair of `WITHOUT_TRIAL`, with skies and
/// without.
const LIGHT_SAMPLES: [u32; 4] = [1, 2, 4, 8];

/// Pairs of roulette threshold and number of branches that are tried, from most to least work.
const PAIRS: [(f32, u32); 7] = [
    (0.01, 4),
    (0.03, 4),
    (0.06, 3),
    (0.1, 2),
    (0.2, 1),
    (0.4, 1),
    (1.0, 1),
];

/// Numbers of branches at lit first vertices that are tried, each with the best pair.
const LIT_BRANCHES: [u32; 2] = [2, 1];

/// The effort for pictures too small for a trial.
pub(super) const WITHOUT_TRIAL: Effort = Effort {
    roulette_below: 0.1,
    branches: 2,
    lit_branches: 1,
    light_samples: 2,
    sample_skies: true,
};

/// Samples per pixel of a trial: enough for their stratification to have an effect.
const SAMPLES: u32 = 16;

/// Number of independent estimates of a pixel, whose difference gives the error.
const ESTIMATES: u64 = 2;

/// A trial takes at most so many paths for each pixel of the picture, whatever the number of
/// samples: a render that goes on to more, or a part of a picture, must choose alike.
const SHARE: u64 = 2;

/// Pictures with fewer pixels get no trial, which would take longer than many of them.
const FEWEST_PIXELS: u64 = 64 * 64;

/// Number of pixels of a trial; fewer cannot distinguish the candidates, more are not needed.
const PIXELS: std::ops::RangeInclusive<u64> = 96..=2048;

/// Share of a trial's pixels, if that is not too few, after which candidates are left out.
const PREVIEW: f64 = 0.25;

/// Factor on the least cost above which a candidate is left out then.
const MUCH_WORSE: f64 = 1.5;

/// Work of a path besides its rays (camera, film), in rays; estimated, not measured.
const WORK_OF_A_PATH: f64 = 1.0;

/// The effort for a picture: as set by the scene, else the best in a trial. The same for any number
/// of threads.
pub(super) fn choose(world: &World, job: &Job, layout: Layout, stop: &AtomicBool) -> Effort {
    let given = |candidate: Effort| {
        let integrator = &world.integrator;
        Effort {
            roulette_below: integrator
                .roulette_below
                .map_or(candidate.roulette_below, |given| given as f32),
            branches: integrator.branches.unwrap_or(candidate.branches),
            lit_branches: integrator.lit_branches.unwrap_or(candidate.lit_branches),
            light_samples: integrator.light_samples.unwrap_or(candidate.light_samples),
            sample_skies: integrator.sample_skies.unwrap_or(candidate.sample_skies),
        }
    };
    let without_trial = given(WITHOUT_TRIAL);
    let choices = |candidates: Vec<Effort>| {
        let mut candidates: Vec<_> = candidates.into_iter().map(given).collect();
        candidates.dedup();
        candidates
    };
    let by_light_samples = choices(light_samples(world));
    let by_pair = |best: Effort| {
        let of = |&(roulette_below, branches)| Effort {
            roulette_below,
            branches,
            ..best
        };
        choices(PAIRS.iter().map(of).collect())
    };
    let by_lit_branches = |best: Effort| {
        let of = |&lit_branches| Effort {
            lit_branches,
            ..best
        };
        let selection = world.selections.of(best.sample_skies);
        // Where nothing is sampled, nothing is lit.
        let numbers = if selection.always.is_empty() && selection.is_empty() {
            &[1][..]
        } else {
            &LIT_BRANCHES[..]
        };
        choices(numbers.iter().map(of).collect())
    };
    let tried = by_light_samples.len()
        + by_pair(without_trial).len()
        + by_lit_branches(without_trial).len();
    let pixels = u64::from(job.width) * u64::from(job.height);
    if pixels < FEWEST_PIXELS {
        return without_trial;
    }
    let of_a_pixel = tried as u64 * ESTIMATES * u64::from(SAMPLES);
    let pixels = (SHARE * pixels / of_a_pixel).clamp(*PIXELS.start(), *PIXELS.end());
    let trial = Trial {
        world,
        job,
        layout,
        pixels: pixels as u32,
        stop,
    };
    // If the trial was interrupted, the choice does not matter.
    trial
        .best(&by_light_samples)
        .and_then(|best| trial.best(&by_pair(best)))
        .and_then(|best| trial.best(&by_lit_branches(best)))
        .unwrap_or(without_trial)
}

/// The numbers of light samples that can differ, with skies among the lights and without.
fn light_samples(world: &World) -> Vec<Effort> {
    let with_skies: &[bool] = match world.integrator.sample_skies {
        Some(false) => &[false],
        None if world.selections.have_even_skies() => &[true, false],
        Some(true) | None => &[true],
    };
    let of = |&sample_skies: &bool| {
        let numbers = if world.selections.of(sample_skies).is_empty() {
            &LIGHT_SAMPLES[..1]
        } else {
            &LIGHT_SAMPLES[..]
        };
        numbers.iter().map(move |&light_samples| Effort {
            light_samples,
            sample_skies,
            ..WITHOUT_TRIAL
        })
    };
    with_skies.iter().flat_map(of).collect()
}

/// The result of one candidate in one pixel.
#[derive(Clone)]
struct Outcome {
    /// Means of the channels, by estimate.
    means: [Vec<f64>; ESTIMATES as usize],
    rays: u64,
}

struct Trial<'a> {
    world: &'a World,
    job: &'a Job,
    layout: Layout,
    pixels: u32,
    stop: &'a AtomicBool,
}

impl Trial<'_> {
    /// The candidate with the least error × work, among at least one; `None` if the trial was
    /// interrupted.
    fn best(&self, candidates: &[Effort]) -> Option<Effort> {
        if let [only] = candidates {
            return Some(*only);
        }
        let preview = (PREVIEW * f64::from(self.pixels)) as u32;
        let preview = preview.max(*PIXELS.start() as u32).min(self.pixels);
        let mut tried = self.pixels(0..preview, candidates)?;
        let kept = not_much_worse(&costs(&tried, candidates.len()));
        let candidates: Vec<_> = kept.iter().map(|&place| candidates[place]).collect();
        for outcomes in &mut tried {
            *outcomes = kept.iter().map(|&place| outcomes[place].clone()).collect();
        }
        if candidates.len() > 1 {
            tried.extend(self.pixels(preview..self.pixels, &candidates)?);
        }
        Some(candidates[least(&costs(&tried, candidates.len()))])
    }

    /// The results of all candidates in some pixels; `None` if the trial was interrupted.
    fn pixels(&self, numbers: Range<u32>, candidates: &[Effort]) -> Option<Vec<Vec<Outcome>>> {
        let of =
            |number| (!self.stop.load(Ordering::Relaxed)).then(|| self.pixel(number, candidates));
        numbers.into_par_iter().map(of).collect()
    }

    /// The results of all candidates in one pixel, given by its number. All use the same random
    /// numbers, so that common noise cancels in the comparison.
    fn pixel(&self, number: u32, candidates: &[Effort]) -> Vec<Outcome> {
        let [x, y, ..] = Stream::new(self.job.seed, u32::MAX, u32::MAX, number).next4();
        let pixel = [
            ((x * self.job.width as f32) as u32).min(self.job.width - 1),
            ((y * self.job.height as f32) as u32).min(self.job.height - 1),
        ];
        let of = |&effort: &Effort| match self.world.wavelengths.grid().lanes() {
            4 => self.outcome::<4>(pixel, effort),
            8 => self.outcome::<8>(pixel, effort),
            16 => self.outcome::<16>(pixel, effort),
            _ => self.outcome::<32>(pixel, effort),
        };
        candidates.iter().map(of).collect()
    }

    fn outcome<const N: usize>(&self, [x, y]: [u32; 2], effort: Effort) -> Outcome {
        let channels = self.layout.beauty;
        let mut values = [0.0; MOST_CHANNELS];
        let mut rays = 0;
        let means = std::array::from_fn(|estimate| {
            // Far from usual seeds, so that the picture itself uses other numbers.
            let seed = self.job.seed ^ (0x5eed_0000_0000_0000 + estimate as u64);
            let mut sums = vec![0.0_f64; channels];
            let numbers = Pixel::new(seed, x, y, 0);
            for sample in 0..SAMPLES {
                let values = &mut values[..channels];
                let sampler = &self.world.wavelengths;
                for group in 0..sampler.groups() {
                    let mut stream = numbers.stream(sample);
                    let mut found = PathResult::<N>::NOTHING;
                    let of = ([x, y], group);
                    let wavelengths =
                        path::of_pixel(self.world, effort, of, &mut stream, &mut found);
                    sampler.film_values(&wavelengths, &found.radiance, values);
                    rays += u64::from(found.rays);
                }
                // The film rejects such a sample, too.
                if values.iter().all(|value| value.is_finite()) {
                    for (sum, &value) in sums.iter_mut().zip(values.iter()) {
                        *sum += f64::from(value) / f64::from(SAMPLES);
                    }
                }
            }
            sums
        });
        Outcome { means, rays }
    }
}

/// Error × work of each candidate. Error is the mean over pixels and channels of the variance,
/// relative to the square of the pixel's mean and of a tenth of the picture's.
fn costs(tried: &[Vec<Outcome>], candidates: usize) -> Vec<f64> {
    let channels = tried[0][0].means[0].len();
    // The mean over all candidates, so that the reference does not depend on a candidate's own
    // error.
    let mean = |pixel: &[Outcome], channel: usize| {
        let means = pixel.iter().flat_map(|outcome| &outcome.means);
        means.map(|means| means[channel]).sum::<f64>() / (candidates * ESTIMATES as usize) as f64
    };
    let floors: Vec<_> = (0..channels)
        .map(|channel| {
            let sum: f64 = tried.iter().map(|pixel| mean(pixel, channel)).sum();
            (0.1 * sum / tried.len() as f64).powi(2)
        })
        .collect();
    (0..candidates)
        .map(|candidate| {
            let (mut error, mut rays) = (0.0, 0.0);
            for pixel in tried {
                let Outcome { means, rays: of } = &pixel[candidate];
                rays += *of as f64;
                for (channel, floor) in floors.iter().enumerate() {
                    let scale = mean(pixel, channel).powi(2) + floor;
                    if scale > 0.0 {
                        error += (means[0][channel] - means[1][channel]).powi(2) / scale;
                    }
                }
            }
            let paths = (tried.len() as u64 * ESTIMATES * u64::from(SAMPLES)) as f64;
            error * (rays + WORK_OF_A_PATH * paths)
        })
        .collect()
}

/// The indices of the numbers that are not much greater than the least.
fn not_much_worse(numbers: &[f64]) -> Vec<usize> {
    let bound = MUCH_WORSE * numbers[least(numbers)];
    (0..numbers.len())
        .filter(|&place| numbers[place] <= bound)
        .collect()
}

/// The index of the least number; of equal ones the first, which has more work.
fn least(numbers: &[f64]) -> usize {
    let mut best = 0;
    for (place, number) in numbers.iter().enumerate() {
        if *number < numbers[best] {
            best = place;
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An outcome of one channel.
    fn outcome(first: f64, second: f64, rays: u64) -> Outcome {
        Outcome {
            means: [vec![first], vec![second]],
            rays,
        }
    }

    #[test]
    fn the_cost_is_relative_variance_times_work() {
        let paths = ESTIMATES * u64::from(SAMPLES);
        // A bright and a dark pixel; the second candidate has half the difference for three times
        // the rays.
        let pixel = |mean: f64| {
            vec![
                outcome(mean * 0.9, mean * 1.1, paths),
                outcome(mean * 0.95, mean * 1.05, 3 * paths),
            ]
        };
        let costs = costs(&[pixel(10.0), pixel(1.0)], 2);
        // The floor is (0.1 × 5.5)².
        let floor = 0.55_f64.powi(2);
        let error = 4.0 / (100.0 + floor) + 0.04 / (1.0 + floor);
        let expected = [
            error * 2.0 * 2.0 * paths as f64,
            error / 4.0 * 4.0 * 2.0 * paths as f64,
        ];
        for (cost, expected) in costs.iter().zip(expected) {
            assert!((cost / expected - 1.0).abs() < 1e-12, "{costs:?}");
        }
        assert_eq!(least(&costs), 1);
    }

    #[test]
    fn what_is_much_worse_than_the_best_is_left_out() {
        assert_eq!(not_much_worse(&[3.0, 2.0, 3.1, 2.5]), [0, 1, 3]);
        assert_eq!(not_much_worse(&[0.0, 0.0]), [0, 1]);
    }

    #[test]
    fn a_black_picture_takes_the_first_candidate() {
        let costs = costs(&[vec![outcome(0.0, 0.0, 5), outcome(0.0, 0.0, 3)]], 2);
        assert_eq!(costs, [0.0, 0.0]);
        assert_eq!(least(&costs), 0);
    }
}
