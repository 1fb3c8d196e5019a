//! When the state of a render is kept as a file, and what becomes of the file.

use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use serde_json::Value;

use super::pace::Pace;
use crate::checkpoint::{self, Heading};
use crate::cli::signals::Signals;
use crate::image::ImageError;
use crate::integrator::render::{Begun, Ended};

/// The checkpoint of a render.
pub(super) struct Keeping<'a> {
    path: PathBuf,
    /// Whether it stays when the render is done, to be taken up with more samples.
    stays: bool,
    heading: &'a Heading,
    signals: &'a Signals,
    state: Mutex<KeepingState>,
}

struct KeepingState {
    pace: Pace,
    /// Whether the file is of this render.
    is_ours: bool,
    /// How often it was written, and its size then.
    count: u32,
    bytes: u64,
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
            heading,
            signals,
            state: Mutex::new(KeepingState {
                pace: Pace::new(every),
                is_ours: is_taken_up,
                count: 0,
                bytes: 0,
            }),
        }
    }

    fn state(&self) -> MutexGuard<'_, KeepingState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Adds what keeping has cost to a report.
    pub(super) fn report(&self, stats: &mut Value) {
        let state = self.state();
        stats["checkpoints"] = state.count.into();
        stats["checkpoint_seconds"] = state.pace.seconds.into();
        stats["checkpoint_bytes"] = state.bytes.into();
    }

    /// The file, if it holds samples of this render.
    pub(super) fn file(&self) -> Option<&Path> {
        self.state().is_ours.then_some(&self.path)
    }

    /// Whether it is time, or was asked for by a signal.
    pub(super) fn is_due(&self) -> bool {
        // A thread that cannot lock at once learns it with the next block.
        let is_asked_for = self.signals.save.load(Ordering::Relaxed);
        let state = self.state.try_lock();
        state.is_ok_and(|state| state.pace.is_due(is_asked_for))
    }

    /// Writes the file in the midst of the render. A failure is reported and tried again later.
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
        state.pace.add(started);
        if result.is_ok() && begun.film.drawn() > 0 {
            state.is_ours = true;
            state.count += 1;
            state.bytes = std::fs::metadata(&self.path).map_or(0, |file| file.len());
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
