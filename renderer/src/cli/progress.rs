//! How far a render is, for a person or for a log.

use std::io::IsTerminal;
use std::sync::Mutex;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

use crate::integrator::render::Progress;

/// A bar on a terminal, a line every ten seconds elsewhere.
pub(super) struct Reporter {
    bar: Option<ProgressBar>,
    started: Instant,
    last_line: Mutex<Instant>,
}

const BETWEEN_LINES: Duration = Duration::from_secs(10);

impl Reporter {
    pub(super) fn new() -> Self {
        let bar = std::io::stderr().is_terminal().then(|| {
            let style = ProgressStyle::with_template(
                "{bar:40} {percent}% of {len} paths, {elapsed_precise} gone, {eta} to go {msg}",
            )
            .expect("the template is well formed");
            ProgressBar::new(0).with_style(style)
        });
        let now = Instant::now();
        Self {
            bar,
            started: now,
            last_line: Mutex::new(now),
        }
    }

    pub(super) fn tell(&self, progress: Progress) {
        if let Some(bar) = &self.bar {
            bar.set_length(progress.total);
            bar.set_position(progress.paths);
            return;
        }
        // Whoever cannot have the lock at once has nothing new to say.
        let Ok(mut last) = self.last_line.try_lock() else {
            return;
        };
        if last.elapsed() < BETWEEN_LINES || progress.paths == 0 {
            return;
        }
        *last = Instant::now();
        let share = progress.paths as f64 / progress.total as f64;
        let elapsed = self.started.elapsed().as_secs_f64();
        eprintln!(
            "{:.1} % after {elapsed:.0} s, about {:.0} s to go",
            100.0 * share,
            elapsed * (1.0 - share) / share
        );
    }

    pub(super) fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}
