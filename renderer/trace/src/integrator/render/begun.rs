//! A render on its way.

use std::sync::atomic::AtomicBool;
use std::time::Duration;

use crate::film::{Film, FilmError};
use crate::integrator::effort::Effort;
use crate::integrator::layers::Layout;
use crate::integrator::noise::NoiseWatch;
use crate::integrator::sample_map::SampleMap;
use crate::integrator::settings::Job;

/// The progress of a render.
#[derive(Clone, Copy, Debug)]
pub struct Progress {
    /// Number of paths done.
    pub paths: u64,
    /// Total number of paths, by present knowledge; it changes if there is a target noise.
    pub total: u64,
}

/// A render as far as it has come: what it takes to go on with the same bits.
#[derive(Clone, Debug)]
pub struct Begun {
    /// The sums. Blocks may have different numbers of samples.
    pub film: Film,
    /// Number of the first sample, 0 except for a part of a picture.
    pub first: u32,
    /// The effort of paths.
    pub effort: Effort,
    /// Rays traced.
    pub rays: u64,
    /// What is known of the noise, if there is a target.
    pub watch: Option<NoiseWatch>,
    /// Samples by block, if they are not the same everywhere; then there is no target noise.
    pub map: Option<SampleMap>,
    /// Time that was spent on it.
    pub elapsed: Duration,
}

impl Begun {
    /// A render without any samples whose effort was chosen.
    ///
    /// # Errors
    ///
    /// [`FilmError`] if the film would be too large.
    pub fn new(
        job: &Job,
        layout: Layout,
        aim: Option<f64>,
        effort: Effort,
    ) -> Result<Self, FilmError> {
        let film = Film::new(job.width, job.height, &layout.luminance(), &layout.sums())?;
        let watch = aim.map(|aim| NoiseWatch::new(&film, aim, job.spp));
        Ok(Self {
            film,
            first: 0,
            effort,
            rays: 0,
            watch,
            map: None,
            elapsed: Duration::ZERO,
        })
    }

    /// This render without any samples, as a part of a picture that begins with sample `first`.
    pub fn from_sample(self, first: u32) -> Self {
        Self { first, ..self }
    }

    /// This render, going on to the samples of a job.
    pub fn up_to(mut self, job: &Job) -> Self {
        if let Some(watch) = &mut self.watch {
            watch.set_most(job.spp);
        }
        self
    }

    /// This render, going on to a lower noise; `None` is all samples for every pixel.
    ///
    /// With `None` the bits are those of a render that never had a target. With a lower target they
    /// may differ from those of a render that always had it: an error is relative to the mean of the
    /// whole picture too, which is known better now.
    pub fn down_to(mut self, aim: Option<f64>) -> Self {
        match (aim, &mut self.watch) {
            (Some(aim), Some(watch)) if aim < watch.aim() => watch.set_aim(aim),
            (None, _) => self.watch = None,
            (Some(_), _) => {}
        }
        self
    }

    /// This render, going on to the samples that a map has for each block, or to those of the job
    /// where they are fewer. Blocks that have more keep them.
    pub fn by_map(self, map: SampleMap) -> Self {
        Self {
            watch: None,
            map: Some(map),
            ..self
        }
    }

    /// Number of the sample behind the last one of a block.
    pub(super) fn end_of(&self, block: usize) -> u32 {
        self.first + self.film.drawn_of(block)
    }

    /// Number of the sample at which a block stops.
    pub(super) fn goal(&self, block: usize, job: &Job) -> u32 {
        match (&self.map, &self.watch) {
            (Some(map), _) => map.goal(block).min(job.spp),
            (None, Some(watch)) => watch.goal(block),
            (None, None) => job.spp,
        }
    }

    /// Number of paths from the first one to the end, by present knowledge.
    pub(super) fn expected_paths(&self, job: &Job) -> u64 {
        let blocks = 0..self.film.blocks();
        let of_block = |block| {
            let samples = self.goal(block, job).max(self.end_of(block)) - self.first;
            u64::from(samples) * u64::from(self.film.pixels_of(block))
        };
        blocks.map(of_block).sum()
    }

    /// Number of the first sample that a block still lacks; `None` if all have theirs.
    pub(super) fn next(&self, job: &Job) -> Option<u32> {
        (0..self.film.blocks())
            .filter(|&block| self.end_of(block) < self.goal(block, job))
            .map(|block| self.end_of(block))
            .min()
    }
}

/// What a render tells while it goes on, and is told.
#[derive(Clone, Copy)]
pub struct Contact<'a> {
    /// Once it is set, blocks not yet begun in this pass are skipped.
    pub stop: &'a AtomicBool,
    /// Called after each block of pixels.
    pub progress: &'a (dyn Fn(Progress) + Sync),
    /// Whether the state is to be kept; asked before each block of pixels.
    pub is_due: &'a (dyn Fn() -> bool + Sync),
    /// Keeps the state.
    pub keep: &'a (dyn Fn(&Begun) + Sync),
}
