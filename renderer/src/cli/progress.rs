//! The progress of a render, on a terminal or in a log.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

use crate::cli::{needs, on_a_screen};
use crate::integrator::render::Progress;
use crate::scene::world::BuildOptions;

/// A bar on a terminal, a line every ten seconds elsewhere.
pub(super) struct Reporter {
    bar: Option<ProgressBar>,
    started: Instant,
    /// Time that the render may take.
    time: Option<Duration>,
    last_line: Mutex<Instant>,
}

/// Prints a line every ten seconds about work whose length nobody knows, until it is dropped.
pub(super) struct Patience {
    grown: Arc<AtomicUsize>,
    at_rest: Arc<AtomicUsize>,
    most_bytes: Option<f64>,
    /// Nothing is sent: the thread ends when this is dropped.
    _until: Sender<()>,
}

impl Patience {
    /// About some work.
    pub(super) fn about(work: &'static str) -> Self {
        Self::new(work, 0, None)
    }

    /// About the building of a scene with so many leaves, which may take `memory` GiB, or what is
    /// free.
    pub(super) fn building(leaves: usize, memory: Option<f64>) -> Self {
        let most_bytes = needs::most_bytes(memory);
        Self::new("growing and building the scene", leaves, most_bytes)
    }

    fn new(work: &'static str, leaves: usize, most_bytes: Option<f64>) -> Self {
        let (until, dropped) = channel();
        let [grown, at_rest] = [(); 2].map(|()| Arc::new(AtomicUsize::new(0)));
        let counted = [&grown, &at_rest].map(Arc::clone);
        std::thread::spawn(move || {
            let started = Instant::now();
            while dropped.recv_timeout(BETWEEN_LINES) == Err(RecvTimeoutError::Timeout) {
                let seconds = started.elapsed().as_secs_f64();
                let [grown, at_rest] = counted
                    .each_ref()
                    .map(|count| count.load(Ordering::Relaxed));
                let mut line = format!("{work}: {seconds:.0} s");
                if leaves > 0 {
                    line += &format!(", {grown} of {leaves} leaves");
                }
                if at_rest > 0 {
                    line += &format!(", {at_rest} things at rest");
                }
                eprintln!("{line}");
            }
        });
        Self {
            grown,
            at_rest,
            most_bytes,
            _until: until,
        }
    }

    /// So that the leaves that have grown are counted and memory is limited.
    pub(super) fn options(&self) -> BuildOptions<'_> {
        BuildOptions {
            cache: None,
            grown: Some(&self.grown),
            at_rest: Some(&self.at_rest),
            wavelengths: None,
            most_bytes: self.most_bytes,
        }
    }
}

/// Time between two lines where there is no terminal.
pub(super) const BETWEEN_LINES: Duration = Duration::from_secs(10);

impl Reporter {
    pub(super) fn new(time: Option<Duration>) -> Self {
        let bar = on_a_screen().then(|| {
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
            time,
            last_line: Mutex::new(now),
        }
    }

    pub(super) fn tell(&self, progress: Progress) {
        if let Some(bar) = &self.bar {
            let share = self.share(progress, self.started.elapsed());
            // The expected total: fewer paths than asked for if the time is up before.
            bar.set_length((progress.paths as f64 / share) as u64);
            bar.set_position(progress.paths);
            return;
        }
        // A thread that cannot lock at once has nothing new to report.
        let Ok(mut last) = self.last_line.try_lock() else {
            return;
        };
        if last.elapsed() < BETWEEN_LINES || progress.paths == 0 {
            return;
        }
        *last = Instant::now();
        let elapsed = self.started.elapsed();
        let share = self.share(progress, elapsed);
        let elapsed = elapsed.as_secs_f64();
        eprintln!(
            "{:.1} % after {elapsed:.0} s, about {:.0} s to go",
            100.0 * share,
            elapsed * (1.0 - share) / share
        );
    }

    /// Share of the render that is done, of its paths or of its time, whichever ends it first.
    fn share(&self, progress: Progress, elapsed: Duration) -> f64 {
        let of_paths = progress.paths as f64 / progress.total.max(1) as f64;
        let of_time = self.time.map_or(0.0, |time| {
            elapsed.as_secs_f64() / time.as_secs_f64().max(1e-9)
        });
        of_paths.max(of_time).clamp(1e-9, 1.0)
    }

    pub(super) fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}
