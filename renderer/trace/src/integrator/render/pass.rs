//! One pass: some more samples for every block of pixels.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use super::begun::{Begun, Contact, Progress};
use crate::film::{FEATURE_SAMPLES, PixelSums};
use crate::integrator::effort::Effort;
use crate::integrator::features::Sight;
use crate::integrator::layers::{Layout, MOST_CHANNELS};
use crate::integrator::path::{self, PathResult};
use crate::integrator::settings::Job;
use crate::sampling::stream::Pixel;
use crate::spectrum::{Lanes, Spectrum};
use crate::world::World;

/// Data that all passes share.
pub(super) struct PassOfPaths<'a> {
    pub(super) world: &'a World,
    pub(super) job: &'a Job,
    pub(super) layout: Layout,
    pub(super) white: Spectrum,
    pub(super) effort: Effort,
    pub(super) contact: &'a Contact<'a>,
    pub(super) rays: AtomicU64,
    pub(super) paths: AtomicU64,
    pub(super) total: AtomicU64,
}

impl PassOfPaths<'_> {
    /// Adds to every block the samples up to number `end − 1` or its goal; returns whether no block
    /// was skipped, because the render is to be stopped or kept.
    pub(super) fn run(&self, begun: &mut Begun, end: u32) -> bool {
        let whole = AtomicBool::new(true);
        let contact = self.contact;
        let ranges: Vec<[u32; 2]> = (0..begun.film.blocks())
            .map(|block| [begun.end_of(block), end.min(begun.goal(block, self.job))])
            .collect();
        begun.film.expose(|block| {
            let [first, end] = ranges[block.number()];
            if first >= end {
                return;
            }
            let was_whole = whole.load(Ordering::Relaxed);
            if !was_whole || contact.stop.load(Ordering::Relaxed) || (contact.is_due)() {
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
            (contact.progress)(Progress { paths, total });
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
        let numbers = Pixel::new(self.job.seed, self.x, self.y, first);
        for sample in first..end {
            let sampler = &self.world.wavelengths;
            let mut trace = |group, values: &mut [f32]| {
                let mut stream = numbers.stream(sample);
                let (of, mut found) = (([self.x, self.y], group), PathResult::<N>::NOTHING);
                let wavelengths =
                    path::of_pixel(self.world, self.effort, of, &mut stream, &mut found);
                rays += u64::from(found.rays);
                sampler.film_values(&wavelengths, &found.radiance, values);
                (found, wavelengths)
            };
            // All groups take the same random numbers; the first says what is met.
            let (mut found, wavelengths) = trace(0, values);
            let mut others = 0.0;
            for group in 1..sampler.groups() {
                let (of_group, wavelengths) = trace(group, values);
                if let Some(hit) = &of_group.first {
                    others += sampler.sum_of_seen(&wavelengths, &hit.albedo);
                }
                found.cuts += of_group.cuts;
                let most = |lane: usize| found.cut.0[lane].max(of_group.cut.0[lane]);
                found.cut = Lanes::from_fn(most);
            }
            let features = found.first.as_ref().map(|hit| {
                let sight = Sight {
                    hit,
                    wavelengths: &wavelengths,
                    sampler,
                    white: self.white,
                    others,
                    recorded: sample < FEATURE_SAMPLES,
                };
                self.layout.features(&sight)
            });
            pixel.add(sample, values, features.as_ref());
            if found.cuts > 0 {
                values.fill(0.0);
                sampler.film_values(&wavelengths, &found.cut, values);
                let most = values
                    .iter()
                    .fold(0.0_f32, |most, value| most.max(value.abs()));
                pixel.add_cut(
                    found.cuts,
                    f64::from(most) * f64::from(self.world.brightest),
                );
            }
        }
        rays
    }
}
