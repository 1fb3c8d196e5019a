//! All the paths of a picture, on all threads, pass by pass.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

use crate::film::{FEATURE_SAMPLES, Film, FilmError, PixelSums};
use crate::integrator::effort::Effort;
use crate::integrator::features::{self, Sight};
pub use crate::integrator::job::Job;
use crate::integrator::layers::{Layout, MOST_CHANNELS};
use crate::integrator::noise::{self, NoiseWatch};
use crate::integrator::path;
use crate::integrator::trial;
use crate::sampling::stream::Stream;
use crate::scene::world::World;
use crate::spectrum::Spectrum;

/// Conditions that end a render before every pixel has all the samples of its [`Job`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Halt {
    /// Relative error at which a block of pixels has enough samples; `None` if all get the same
    /// number. See [`crate::integrator::noise`].
    pub noise: Option<f64>,
    /// Time after which no further pass begins.
    pub time: Option<Duration>,
}

/// Why a render ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ended {
    /// Every pixel has the job's samples.
    Samples,
    /// Every block has the samples that it needs for the target error, or the job's.
    Noise,
    /// The time was up.
    Time,
    /// It was interrupted.
    Interrupted,
}

/// The result of a render.
#[derive(Debug)]
pub struct Rendered {
    /// The sums.
    pub film: Film,
    /// The meaning of its channels.
    pub layout: Layout,
    /// The effort of paths.
    pub effort: Effort,
    /// Rays traced, shadow rays included, without those of the trial that chose the effort.
    pub rays: u64,
    /// Why the render ended.
    pub ended: Ended,
    /// The noise reached, if there was a target.
    pub noise: Option<Noise>,
}

/// Relative errors: root mean square over the picture's pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    /// The target of each block.
    pub aim: f64,
    /// The picture's estimated error; `None` if there were too few samples for an estimate.
    pub reached: Option<f64>,
}

/// The progress of a render.
#[derive(Clone, Copy, Debug)]
pub struct Progress {
    /// Number of paths done.
    pub paths: u64,
    /// Total number of paths, by present knowledge; it changes if there is a target noise.
    pub total: u64,
}

/// Samples per pixel of the longest pass: few enough to stop soon, enough to keep threads busy.
const LONGEST_PASS: u32 = noise::STEP;

/// Renders on the current thread pool, as [`render_until`] with no condition that ends it early
/// except `stop`.
///
/// # Errors
///
/// [`FilmError`] if the film would be too large.
pub fn render(
    world: &World,
    job: &Job,
    stop: &AtomicBool,
    progress: &(dyn Fn(Progress) + Sync),
) -> Result<Rendered, FilmError> {
    render_until(world, job, &Halt::default(), stop, progress)
}

/// Renders on the current thread pool, pass by pass, until every pixel has enough samples or a
/// condition of `halt` holds.
///
/// `progress` is called after each block of pixels. Once `stop` is set, blocks not yet begun in
/// this pass are skipped, and the film so far is returned. A render that ends by time has the same
/// bits as one whose job has as many samples as the pixels with most, and whose scene sets the
/// effort that was chosen here.
///
/// # Errors
///
/// [`FilmError`] if the film would be too large.
pub fn render_until(
    world: &World,
    job: &Job,
    halt: &Halt,
    stop: &AtomicBool,
    progress: &(dyn Fn(Progress) + Sync),
) -> Result<Rendered, FilmError> {
    let started = Instant::now();
    let layout = Layout::new(&world.wavelengths);
    let mut film = Film::new(job.width, job.height, layout.beauty, &layout.sums())?;
    let mut watch = halt
        .noise
        .map(|aim| NoiseWatch::new(&film, aim, job.spp, layout.colour));
    let effort = trial::choose(world, job, layout, stop);
    let pass = PassOfPaths {
        world,
        job,
        layout,
        white: features::white(&world.wavelengths),
        effort,
        stop,
        progress,
        rays: AtomicU64::new(0),
        paths: AtomicU64::new(0),
        total: AtomicU64::new(0),
    };
    let all = u64::from(job.width) * u64::from(job.height) * u64::from(job.spp);
    let mut first = 0;
    let ended = loop {
        let goal = watch.as_ref().map_or(job.spp, NoiseWatch::last_goal);
        if first >= goal {
            break if first >= job.spp {
                Ended::Samples
            } else {
                Ended::Noise
            };
        }
        if stop.load(Ordering::Relaxed) {
            break Ended::Interrupted;
        }
        let Some(longest) = longest_pass(first, started.elapsed(), halt.time) else {
            break Ended::Time;
        };
        let end = goal.min(first + longest);
        let total = watch
            .as_ref()
            .map_or(all, |watch| watch.expected_paths(&film));
        pass.total.store(total, Ordering::Relaxed);
        let goals = |block| watch.as_ref().map_or(end, |watch| watch.goal(block));
        if !pass.run(&mut film, first, end, &goals) {
            break Ended::Interrupted;
        }
        first = end;
        if let Some(watch) = watch.as_mut().filter(|_| NoiseWatch::is_border(first)) {
            watch.look(&film, first);
        }
    };
    let paths = pass.paths.into_inner();
    progress(Progress {
        paths,
        total: paths,
    });
    Ok(Rendered {
        noise: watch.zip(halt.noise).map(|(watch, aim)| Noise {
            aim,
            reached: watch.reached(&film),
        }),
        film,
        layout,
        effort,
        rays: pass.rays.into_inner(),
        ended,
    })
}

/// Greatest number of samples of the next pass, after `done` samples that took `elapsed`; `None`
/// once the time is up, except for the first pass.
///
/// Passes double up to [`LONGEST_PASS`] and end at its multiples, where noise is judged. Towards
/// the end of the time they get shorter, so that the last one ends soon after it.
fn longest_pass(done: u32, elapsed: Duration, time: Option<Duration>) -> Option<u32> {
    let longest = done.clamp(1, LONGEST_PASS - done % LONGEST_PASS);
    let Some(time) = time.filter(|_| done > 0) else {
        return Some(longest);
    };
    let left = time.checked_sub(elapsed).filter(|left| !left.is_zero())?;
    let of_one = elapsed.as_secs_f64() / f64::from(done);
    let fit = (left.as_secs_f64() / of_one.max(1e-9)) as u32;
    Some(longest.min(fit).max(1))
}

/// Data that all passes share.
struct PassOfPaths<'a> {
    world: &'a World,
    job: &'a Job,
    layout: Layout,
    white: Spectrum,
    effort: Effort,
    stop: &'a AtomicBool,
    progress: &'a (dyn Fn(Progress) + Sync),
    rays: AtomicU64,
    paths: AtomicU64,
    total: AtomicU64,
}

impl PassOfPaths<'_> {
    /// Adds samples number `first` to `end − 1` of every block that has not yet reached its goal;
    /// returns whether it was not interrupted.
    fn run(
        &self,
        film: &mut Film,
        first: u32,
        end: u32,
        goal: &(dyn Fn(usize) -> u32 + Sync),
    ) -> bool {
        let whole = AtomicBool::new(true);
        film.expose(|block| {
            let end = end.min(goal(block.number()));
            if first >= end {
                return;
            }
            if self.stop.load(Ordering::Relaxed) {
                whole.store(false, Ordering::Relaxed);
                return;
            }
            let mut traced = 0;
            block.expose(end - first, |x, y, pixel| {
                let samples = Samples {
                    world: self.world,
                    job: self.job,
                    layout: self.layout,
                    white: &self.white,
                    effort: self.effort,
                    x,
                    y,
                };
                traced += match self.world.wavelengths.grid().lanes() {
                    4 => samples.add::<4>(first, end, pixel),
                    8 => samples.add::<8>(first, end, pixel),
                    16 => samples.add::<16>(first, end, pixel),
                    _ => samples.add::<32>(first, end, pixel),
                };
            });
            self.rays.fetch_add(traced, Ordering::Relaxed);
            let added = u64::from(end - first) * u64::from(block.pixels());
            let paths = self.paths.fetch_add(added, Ordering::Relaxed) + added;
            let total = self.total.load(Ordering::Relaxed);
            (self.progress)(Progress { paths, total });
        });
        whole.into_inner()
    }
}

/// The samples of one pixel.
struct Samples<'a> {
    world: &'a World,
    job: &'a Job,
    layout: Layout,
    white: &'a Spectrum,
    effort: Effort,
    x: u32,
    y: u32,
}

impl Samples<'_> {
    /// Adds samples number `first` to `end − 1`; returns the number of rays.
    fn add<const N: usize>(&self, first: u32, end: u32, pixel: &mut PixelSums<'_>) -> u64 {
        let mut rays = 0;
        let mut values = [0.0; MOST_CHANNELS];
        let values = &mut values[..self.layout.beauty];
        for sample in first..end {
            let mut stream = Stream::new(self.job.seed, self.x, self.y, sample);
            let (wavelengths, found) =
                path::of_pixel::<N>(self.world, self.effort, self.x, self.y, &mut stream);
            rays += u64::from(found.rays);
            let sampler = &self.world.wavelengths;
            sampler.film_values(&wavelengths, &found.radiance, values);
            let features = found.first.as_ref().map(|hit| {
                let sight = Sight {
                    hit,
                    wavelengths: &wavelengths,
                    sampler,
                    white: self.white,
                    recorded: sample < FEATURE_SAMPLES,
                };
                self.layout.features(&sight)
            });
            pixel.add(sample, values, features.as_ref());
        }
        rays
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SECOND: Duration = Duration::from_secs(1);

    #[test]
    fn passes_double_and_never_cross_a_multiple_of_the_longest() {
        let mut ends = vec![0];
        while ends[ends.len() - 1] < 64 {
            let done = ends[ends.len() - 1];
            ends.push(done + longest_pass(done, SECOND, None).expect("no time is set"));
        }
        assert_eq!(ends, [0, 1, 2, 4, 8, 16, 32, 48, 64]);
        // Every place where a pass shortened by time may have ended.
        for done in 1..200 {
            let pass = longest_pass(done, SECOND, None).expect("no time is set");
            assert_eq!((done + pass - 1) / LONGEST_PASS, done / LONGEST_PASS);
        }
    }

    #[test]
    fn passes_get_shorter_towards_the_end_of_the_time_and_then_there_are_none() {
        let of_32 = |elapsed, time| longest_pass(32, SECOND * elapsed, Some(SECOND * time));
        // 32 samples in 32 seconds: as many more as seconds are left.
        assert_eq!(of_32(32, 100), Some(16));
        assert_eq!(of_32(32, 37), Some(5));
        assert_eq!(of_32(64, 65), Some(1));
        assert_eq!(of_32(32, 32), None);
        assert_eq!(of_32(40, 32), None);
        // There is always a first pass.
        assert_eq!(longest_pass(0, SECOND, Some(Duration::ZERO)), Some(1));
    }
}
