//! All the paths of a picture, on all threads, pass by pass.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use glam::Vec2;

use crate::film::{Film, FilmError, PixelSums};
use crate::integrator::features::{self, Layout, MOST_CHANNELS};
use crate::integrator::path;
use crate::sampling::stream::Stream;
use crate::scene::world::World;
use crate::spectrum::Spectrum;

/// Which samples of which picture.
#[derive(Clone, Copy, Debug)]
pub struct Job {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Samples a pixel.
    pub spp: u32,
    /// Seed of every random number.
    pub seed: u64,
}

/// What was rendered.
#[derive(Debug)]
pub struct Rendered {
    /// The sums.
    pub film: Film,
    /// What its channels are.
    pub layout: Layout,
    /// Rays traced, shadow rays included.
    pub rays: u64,
    /// Whether it was broken off.
    pub interrupted: bool,
}

/// How far a render is.
#[derive(Clone, Copy, Debug)]
pub struct Progress {
    /// Paths done.
    pub paths: u64,
    /// Paths in all.
    pub total: u64,
}

/// Samples a pixel of the longest pass: short enough to stop soon, long enough to keep threads busy.
const LONGEST_PASS: u32 = 16;

/// Renders on the current thread pool.
///
/// After each block of pixels `progress` is told; once `stop` is set, blocks that were not yet begun in this pass are left
/// as they are, and what was rendered is returned.
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
    let layout = Layout::new(&world.wavelengths);
    let mut film = Film::new(job.width, job.height, layout.beauty, layout.albedo)?;
    let rays = AtomicU64::new(0);
    let paths = AtomicU64::new(0);
    let total = u64::from(job.width) * u64::from(job.height) * u64::from(job.spp);
    let white = features::white(&world.wavelengths);
    let mut first = 0;
    while first < job.spp && !stop.load(Ordering::Relaxed) {
        let pass = first.clamp(1, LONGEST_PASS).min(job.spp - first);
        film.expose(|block| {
            if stop.load(Ordering::Relaxed) {
                return;
            }
            let mut traced = 0;
            block.expose(pass, |x, y, pixel| {
                let samples = Samples {
                    world,
                    job,
                    layout,
                    white: &white,
                    x,
                    y,
                };
                traced += match world.wavelengths.grid().lanes() {
                    4 => samples.add::<4>(first, first + pass, pixel),
                    8 => samples.add::<8>(first, first + pass, pixel),
                    16 => samples.add::<16>(first, first + pass, pixel),
                    _ => samples.add::<32>(first, first + pass, pixel),
                };
            });
            rays.fetch_add(traced, Ordering::Relaxed);
            let added = u64::from(pass) * u64::from(block.pixels());
            let paths = paths.fetch_add(added, Ordering::Relaxed) + added;
            progress(Progress { paths, total });
        });
        first += pass;
    }
    progress(Progress {
        paths: paths.load(Ordering::Relaxed),
        total,
    });
    let interrupted = film.drawn() < total;
    Ok(Rendered {
        film,
        layout,
        rays: rays.into_inner(),
        interrupted,
    })
}

/// The samples of one pixel.
struct Samples<'a> {
    world: &'a World,
    job: &'a Job,
    layout: Layout,
    white: &'a Spectrum,
    x: u32,
    y: u32,
}

impl Samples<'_> {
    /// Adds samples number `first` to `end − 1`; gives the number of rays.
    fn add<const N: usize>(&self, first: u32, end: u32, pixel: &mut PixelSums<'_>) -> u64 {
        let mut rays = 0;
        let mut values = [0.0; MOST_CHANNELS];
        let values = &mut values[..self.layout.beauty];
        for sample in first..end {
            let mut stream = Stream::new(self.job.seed, self.x, self.y, sample);
            let [film_x, film_y, wavelength, _] = stream.next4();
            let [lens_x, lens_y, ..] = if self.world.camera.has_lens() {
                stream.next4()
            } else {
                [0.5; 4]
            };
            let wavelengths = self.world.wavelengths.draw::<N>(wavelength);
            let offset = self.world.filter.sample(Vec2::new(film_x, film_y));
            let place = Vec2::new(self.x as f32, self.y as f32) + offset;
            let ray = self.world.camera.ray(place, Vec2::new(lens_x, lens_y));
            let found = path::trace(self.world, ray, wavelengths, &mut stream);
            rays += u64::from(found.rays);
            let sampler = &self.world.wavelengths;
            sampler.film_values(&wavelengths, &found.radiance, values);
            let feature = self
                .layout
                .feature(sample, sampler, &wavelengths, &found, self.white);
            pixel.add(sample, values, feature.as_ref());
        }
        rays
    }
}
