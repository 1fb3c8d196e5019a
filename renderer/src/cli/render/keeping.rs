//! When the state of a render is kept as a file, and what becomes of the file.

use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use crate::checkpoint::{self, Heading};
use crate::cli::signals::Signals;
use crate::image::ImageError;
use crate::integrator::render::{Begun, Ended};

/// Keeping may take one part in so many of the time.
const SHARE: u32 = 50;

/// Time for some blocks of pixels between two checkpoints, however often they are asked for.
const SHORTEST: Duration = Duration::from_millis(50);

/// The checkpoint of a render.
pub(super) struct Keeping<'a> {
    path: PathBuf,
    /// Whether it stays when the render is done, to be taken up with more samples.
    stays: bool,
    every: Duration,
    heading: &'a Heading,
    signals: &'a Signals,
    state: Mutex<State>,
}

struct State {
    /// When it was last tried.
    last: Instant,
    /// What it took then.
    cost: Duration,
    /// Whether the file is of this render.
    is_ours: bool,
    effort: Effort,
}

/// What keeping has cost so far.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Effort {
    pub(super) count: u32,
    pub(super) seconds: f64,
    pub(super) bytes: u64,
}

impl<'a> Keeping<'a> {
    /// `is_taken_up`: the render goes on from the file.
    pub(super) fn new(
        path: &Path,
        [stays, is_taken_up]: [bool; 2],
        every: Duration,
        heading: &'a Heading,
        signals: &'a Signals,
    ) -> Self {
        Self {
            path: path.to_owned(),
            stays,
            every,
            heading,
            signals,
            state: Mutex::new(State {
                last: Instant::now(),
                cost: Duration::ZERO,
                is_ours: is_taken_up,
                effort: Effort::default(),
            }),
        }
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub(super) fn effort(&self) -> Effort {
        self.state().effort
    }

    /// The file, if it holds samples of this render.
    pub(super) fn file(&self) -> Option<&Path> {
        self.state().is_ours.then_some(&self.path)
    }

    /// Whether it is time, or was asked for by a signal.
    pub(super) fn is_due(&self) -> bool {
        // A thread that cannot lock at once learns it with the next block.
        self.state.try_lock().is_ok_and(|state| {
            let since = state.last.elapsed();
            let is_asked_for = self.signals.save.load(Ordering::Relaxed);
            since >= SHORTEST && (is_asked_for || since >= self.every.max(state.cost * SHARE))
        })
    }

    /// Writes the file in the midst of the render. A failure is told and tried again later.
    pub(super) fn keep(&self, begun: &Begun) {
        let asked_for = self.signals.save.swap(false, Ordering::Relaxed);
        match self.save(begun) {
            Ok(()) if asked_for => eprintln!("{}: the checkpoint is written", self.path.display()),
            Ok(()) => {}
            Err(error) => eprintln!("warning: no checkpoint: {error}; rendering goes on"),
        }
    }

    /// Writes the file.
    pub(super) fn save(&self, begun: &Begun) -> Result<(), ImageError> {
        let started = Instant::now();
        let result = if begun.film.drawn() == 0 {
            Ok(())
        } else {
            checkpoint::write(&self.path, self.heading, begun)
        };
        let mut state = self.state();
        state.cost = started.elapsed();
        state.last = Instant::now();
        state.effort.seconds += state.cost.as_secs_f64();
        if result.is_ok() && begun.film.drawn() > 0 {
            state.is_ours = true;
            state.effort.count += 1;
            let written = std::fs::metadata(&self.path);
            state.effort.bytes = written.map_or(0, |file| file.len());
        }
        result
    }

    /// The pictures are written: the file is brought up to date if it stays, as it does too if only
    /// the time was over, else removed. Whether it stays without having been asked for.
    pub(super) fn finish(&self, begun: &Begun, ended: Ended) -> Result<bool, ImageError> {
        let goes_on = ended == Ended::Time;
        if self.stays || goes_on {
            self.save(begun)?;
            return Ok(!self.stays);
        }
        if self.file().is_some() {
            // What is left does no harm.
            let _ = std::fs::remove_file(&self.path);
        }
        Ok(false)
    }
}
