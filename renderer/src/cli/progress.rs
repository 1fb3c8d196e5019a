//! The progress of a render, on a terminal or in a log.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

use crate::cli::needs;
use crate::cli::terminal::on_a_screen;
use crate::integrator::render::Progress;
use crate::scene::world::BuildOptions;

/// A bar on a terminal, a line every ten seconds elsewhere.
pub(super) struct Reporter {
    bar: Option<ProgressBar>,
    clock: Clock,
    /// Time that the render may take.
    time: Option<Duration>,
}

/// Time between two lines where there is no terminal.
const BETWEEN_LINES: Duration = Duration::from_secs(10);

/// Says when a line about progress is due, every ten seconds, and how long work will take.
#[derive(Debug)]
pub(super) struct Clock {
    started: Instant,
    last_line: Mutex<Instant>,
}

impl Clock {
    pub(super) fn new() -> Self {
        let started = Instant::now();
        Self {
            started,
            last_line: Mutex::new(started),
        }
    }

    /// Whether a line is due, which is then taken as printed. A thread that cannot lock at once has
    /// nothing new to report.
    pub(super) fn is_due(&self) -> bool {
        self.last_line.try_lock().is_ok_and(|mut last| {
            let is_due = last.elapsed() >= BETWEEN_LINES;
            if is_due {
                *last = Instant::now();
            }
            is_due
        })
    }

    /// How long work has taken, s.
    pub(super) fn seconds(&self) -> f64 {
        self.started.elapsed().as_secs_f64()
    }

    /// How long work has taken of which this fraction is done, and how long the rest will take.
    pub(super) fn after(&self, fraction: f64) -> String {
        let seconds = self.seconds();
        let left = seconds * ((1.0 - fraction) / fraction).max(0.0);
        format!("after {seconds:.0} s, about {left:.0} s to go")
    }
}

/// Prints a line every ten seconds about work whose length nobody knows, until it is dropped.
pub(super) struct Patience {
    grown: Arc<AtomicUsize>,
    at_rest: Arc<[AtomicUsize; 2]>,
    most_bytes: Option<f64>,
    /// Nothing is sent: the thread ends when this is dropped.
    _until: Sender<()>,
}

impl Patience {
    /// About some work.
    pub(super) fn about(work: &'static str) -> Self {
        Self::new(work, 0, None)
    }

    /// About the reading of a scene's files.
    pub(super) fn reading() -> Self {
        Self::new("reading meshes and pictures", 0, None)
    }

    /// About the building of a scene with so many leaves, which may take `memory` GiB, or what is
    /// free.
    pub(super) fn building(leaves: usize, memory: Option<f64>) -> Self {
        let most_bytes = needs::most_bytes(memory);
        Self::new("growing and building the scene", leaves, most_bytes)
    }

    fn new(work: &'static str, leaves: usize, most_bytes: Option<f64>) -> Self {
        let (until, dropped) = channel();
        let grown = Arc::new(AtomicUsize::new(0));
        let at_rest = Arc::new([(); 2].map(|()| AtomicUsize::new(0)));
        let (leaves_grown, things) = (Arc::clone(&grown), Arc::clone(&at_rest));
        std::thread::spawn(move || {
            let started = Instant::now();
            let mut before = 0;
            while dropped.recv_timeout(BETWEEN_LINES) == Err(RecvTimeoutError::Timeout) {
                let seconds = started.elapsed().as_secs_f64();
                let grown = leaves_grown.load(Ordering::Relaxed);
                let [at_rest, all] = things.each_ref().map(|count| count.load(Ordering::Relaxed));
                let mut line = format!("{work}: {seconds:.0} s");
                if leaves > 0 {
                    line += &format!(", {grown} of {leaves} leaves");
                }
                if at_rest > 0 {
                    line += &format!(", {at_rest} of {all} things at rest");
                }
                // The heap gets higher and things slower, so only the last ones count.
                if let Some(last) = at_rest.checked_sub(before).filter(|last| *last > 0) {
                    let left = all.saturating_sub(at_rest) as f64 / last as f64;
                    let seconds = left * BETWEEN_LINES.as_secs_f64();
                    line += &format!(", about {seconds:.0} s to go");
                }
                before = at_rest;
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

/// Prints a line every ten seconds about work of so many steps.
pub(super) struct Steps {
    /// Their name, in the plural.
    what: &'static str,
    all: u32,
    done: u32,
    clock: Clock,
}

impl Steps {
    pub(super) fn new(what: &'static str, all: u32) -> Self {
        Self {
            what,
            all,
            done: 0,
            clock: Clock::new(),
        }
    }

    /// So many more are done.
    pub(super) fn add(&mut self, more: usize) {
        self.done += more as u32;
        if self.clock.is_due() {
            let (done, all, what) = (self.done, self.all, self.what);
            let after = self.clock.after(f64::from(done.max(1)) / f64::from(all));
            eprintln!("{done} of {all} {what} {after}");
        }
    }
}

impl Reporter {
    pub(super) fn new(time: Option<Duration>) -> Self {
        let bar = on_a_screen().then(|| {
            let style = ProgressStyle::with_template(
                "{bar:40} {percent}% of {len} paths, {elapsed_precise} gone, {eta} to go {msg}",
            )
            .expect("the template is well formed");
            ProgressBar::new(0).with_style(style)
        });
        Self {
            bar,
            clock: Clock::new(),
            time,
        }
    }

    pub(super) fn report(&self, progress: Progress) {
        if let Some(bar) = &self.bar {
            // The expected total: fewer paths than asked for if the time is up before.
            bar.set_length((progress.paths as f64 / self.fraction(progress)) as u64);
            bar.set_position(progress.paths);
        } else if progress.paths > 0 && self.clock.is_due() {
            let fraction = self.fraction(progress);
            eprintln!("{:.1} % {}", 100.0 * fraction, self.clock.after(fraction));
        }
    }

    /// Fraction of the render that is done, of its paths or of its time, whichever ends it first.
    fn fraction(&self, progress: Progress) -> f64 {
        let of_paths = progress.paths as f64 / progress.total.max(1) as f64;
        let of_time = self.time.map_or(0.0, |time| {
            self.clock.seconds() / time.as_secs_f64().max(1e-9)
        });
        of_paths.max(of_time).clamp(1e-9, 1.0)
    }

    pub(super) fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}
