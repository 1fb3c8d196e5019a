//! All the paths of a picture, on all threads, pass by pass.

mod begun;
mod pass;

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

pub use self::begun::{Begun, Contact, Progress};
use self::pass::PassOfPaths;
use crate::film::{Film, FilmError, LEAST_LUMINANCE, MOST_RADIANCE};
use crate::integrator::effort::Effort;
use crate::integrator::layers::Layout;
use crate::integrator::noise::{self, NoiseWatch};
use crate::integrator::sample_map::SampleMap;
pub use crate::integrator::settings::Job;
use crate::integrator::{features, trial};
use crate::world::World;

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
    /// Every pixel has the job's samples, or those that the map has for it.
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
    /// The map of samples, if there was one.
    pub map: Option<SampleMap>,
    first: u32,
    watch: Option<NoiseWatch>,
    elapsed: Duration,
}

/// Relative errors: root mean square over the picture's pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    /// The target of each block.
    pub aim: f64,
    /// The picture's estimated error; `None` if there were too few samples for an estimate.
    pub reached: Option<f64>,
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
/// bits as one whose job has as many samples as the pixels with most.
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
    let contact = Contact {
        stop,
        progress,
        is_due: &|| false,
        keep: &|_| (),
    };
    let begun = begin(world, job, halt.noise, stop)?;
    let (begun, ended) = go_on(world, job, begun, halt.time, &contact);
    Ok(Rendered::new(begun, Layout::new(&world.wavelengths), ended))
}

/// A render without any samples: the effort of its paths is chosen by a trial.
///
/// # Errors
///
/// [`FilmError`] if the film would be too large.
pub fn begin(
    world: &World,
    job: &Job,
    aim: Option<f64>,
    stop: &AtomicBool,
) -> Result<Begun, FilmError> {
    let started = Instant::now();
    let layout = Layout::new(&world.wavelengths);
    // The film first: whether it is too large is known at once.
    let mut begun = Begun::new(job, layout, aim, trial::WITHOUT_TRIAL)?;
    begun.effort = trial::choose(world, job, layout, stop);
    begun.elapsed = started.elapsed();
    Ok(begun)
}

/// Adds samples until every pixel has those up to number `job.spp − 1`, or enough, or the time
/// is up, which counts from the beginning of the render, or it is stopped.
///
/// The bits do not depend on how often a render was interrupted: blocks go on behind their last
/// sample, and noise is judged at the same numbers of samples.
pub fn go_on(
    world: &World,
    job: &Job,
    mut begun: Begun,
    time: Option<Duration>,
    contact: &Contact<'_>,
) -> (Begun, Ended) {
    let (started, before) = (Instant::now(), begun.elapsed);
    let drawn = begun.film.drawn();
    let pass = PassOfPaths {
        world,
        job,
        layout: Layout::new(&world.wavelengths),
        white: features::white(&world.wavelengths),
        effort: begun.effort,
        contact,
        rays: AtomicU64::new(begun.rays),
        paths: AtomicU64::new(0),
        total: AtomicU64::new(0),
    };
    let ended = 'passes: loop {
        let Some(next) = begun.next(job) else {
            let [_, most] = begun.film.drawn_range();
            break if begun.map.is_some() || begun.first + most >= job.spp {
                Ended::Samples
            } else {
                Ended::Noise
            };
        };
        if contact.stop.load(Ordering::Relaxed) {
            break Ended::Interrupted;
        }
        let elapsed = before + started.elapsed();
        let Some(longest) = longest_pass(next, next - begun.first, elapsed, time) else {
            break Ended::Time;
        };
        let end = job.spp.min(next.saturating_add(longest));
        let total = begun.expected_paths(job);
        pass.total
            .store(total - drawn.min(total), Ordering::Relaxed);
        // A pass that was left to keep the state goes on where it was.
        while !pass.run(&mut begun, end) {
            begun.rays = pass.rays.load(Ordering::Relaxed);
            begun.elapsed = before + started.elapsed();
            if contact.stop.load(Ordering::Relaxed) {
                break 'passes Ended::Interrupted;
            }
            (contact.keep)(&begun);
        }
        if let Some(watch) = &mut begun.watch
            && NoiseWatch::is_border(end)
        {
            watch.look(&begun.film, end);
        }
    };
    let paths = pass.paths.into_inner();
    (contact.progress)(Progress {
        paths,
        total: paths,
    });
    begun.rays = pass.rays.into_inner();
    begun.elapsed = before + started.elapsed();
    (begun, ended)
}

impl Rendered {
    /// What limits and faults did to the picture, in sentences for users.
    pub fn notes(&self) -> Vec<String> {
        let film = &self.film;
        let mut notes = Vec::new();
        if film.cut() > 0 {
            // The greatest channel's mean.
            let count = f64::from(film.width()) * f64::from(film.height());
            let of_channel = |channel| film.mean(channel).into_iter().map(f64::from).sum::<f64>();
            let sums = (0..film.channels()).map(of_channel);
            let mean = sums.fold(0.0, f64::max) / count;
            let missing = film.missing();
            let lost = if missing.is_infinite() {
                "the light that they would have found has no bound, because a light has no extent"
                    .to_owned()
            } else if missing > mean && mean > 0.0 {
                format!(
                    "how much light is missing is not known, since its bound ({missing:.2e}) is above the \
                     mean of the picture ({mean:.2e}): raise that limit, and see what changes"
                )
            } else if mean > 0.0 {
                let percent = 100.0 * missing / mean;
                format!("at most {missing:.2e} is missing of a mean of {mean:.2e} ({percent:.2} %)")
            } else {
                format!("at most {missing:.2e} is missing on average")
            };
            notes.push(format!(
                "{} paths were cut by `integrator.max_depth` or `max_events`: {lost}",
                film.cut()
            ));
        }
        if film.clamped() > 0 {
            notes.push(format!(
                "{} values were beyond {MOST_RADIANCE:.1e} and are recorded as that: the picture is too \
                 dark there; scale all lights down",
                film.clamped()
            ));
        }
        if film.overflowed() > 0 {
            notes.push(format!(
                "the variance of {} values is not known, because they are too bright; it is written \
                 as infinite",
                film.overflowed()
            ));
        }
        let pixels = film.map(|pixel| pixel.luminance().abs());
        let mean = pixels.iter().sum::<f64>() / pixels.len() as f64;
        if 0.0 < mean && mean < LEAST_LUMINANCE {
            notes.push(format!(
                "the mean of the picture ({mean:.2e}) is below {LEAST_LUMINANCE:.0e}: its variance and its \
                 noise are not known; scale all lights up"
            ));
        }
        if film.rejected() > 0 {
            notes.push(format!(
                "{} samples were not finite and are left out",
                film.rejected()
            ));
        }
        notes
    }

    /// The result of a render that ended.
    pub fn new(begun: Begun, layout: Layout, ended: Ended) -> Self {
        Self {
            noise: begun.watch.as_ref().map(|watch| Noise {
                aim: watch.aim(),
                reached: watch.reached(&begun.film),
            }),
            film: begun.film,
            layout,
            effort: begun.effort,
            rays: begun.rays,
            ended,
            first: begun.first,
            watch: begun.watch,
            map: begun.map,
            elapsed: begun.elapsed,
        }
    }

    /// The render as far as it came, which can go on.
    pub fn into_begun(self) -> Begun {
        Begun {
            film: self.film,
            first: self.first,
            effort: self.effort,
            rays: self.rays,
            watch: self.watch,
            map: self.map,
            elapsed: self.elapsed,
        }
    }
}

/// Greatest number of samples of the next pass, whose first one is `next`, after `done` samples
/// that took `elapsed`; `None` once the time is up, except for the first pass.
///
/// Passes double up to [`LONGEST_PASS`] and end at its multiples, where noise is judged. Towards
/// the end of the time they get shorter, so that the last one ends soon after it.
fn longest_pass(next: u32, done: u32, elapsed: Duration, time: Option<Duration>) -> Option<u32> {
    let longest = next.clamp(1, LONGEST_PASS - next % LONGEST_PASS);
    let Some(time) = time.filter(|_| done > 0) else {
        return Some(longest);
    };
    let left = time.checked_sub(elapsed).filter(|left| !left.is_zero())?;
    let of_one = elapsed.as_secs_f64() / f64::from(done);
    let fit = (left.as_secs_f64() / of_one.max(1e-9)) as u32;
    Some(longest.min(fit).max(1))
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
            ends.push(done + longest_pass(done, done, SECOND, None).expect("no time is set"));
        }
        assert_eq!(ends, [0, 1, 2, 4, 8, 16, 32, 48, 64]);
        // Every place where a pass shortened by time may have ended.
        for done in 1..200 {
            let pass = longest_pass(done, done, SECOND, None).expect("no time is set");
            assert_eq!((done + pass - 1) / LONGEST_PASS, done / LONGEST_PASS);
        }
    }

    #[test]
    fn passes_get_shorter_towards_the_end_of_the_time_and_then_there_are_none() {
        let of_32 = |elapsed, time| longest_pass(32, 32, SECOND * elapsed, Some(SECOND * time));
        // 32 samples in 32 seconds: as many more as seconds are left.
        assert_eq!(of_32(32, 100), Some(16));
        assert_eq!(of_32(32, 37), Some(5));
        assert_eq!(of_32(64, 65), Some(1));
        assert_eq!(of_32(32, 32), None);
        assert_eq!(of_32(40, 32), None);
        // There is always a first pass.
        assert_eq!(longest_pass(0, 0, SECOND, Some(Duration::ZERO)), Some(1));
    }
}
