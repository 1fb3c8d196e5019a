//! Signals: to end with the work saved, and to save it and go on.

use std::fmt::Display;
#[cfg(unix)]
use std::io::Write;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
#[cfg(unix)]
use std::time::{Duration, Instant};

use crate::cli::terminal::Failure;

/// What signals ask for.
#[derive(Debug, Default)]
pub(super) struct Signals {
    /// Ctrl-C, SIGTERM or SIGHUP (not under `nohup`): end with the work saved.
    pub(super) stop: AtomicBool,
    /// SIGUSR1: save the work and go on.
    pub(super) save: AtomicBool,
    /// Whether there is work to save. If not, a signal ends the program at once.
    at_work: AtomicBool,
    /// Files that are removed if it does.
    fleeting: Mutex<Vec<PathBuf>>,
}

/// A second Ctrl-C ends the program at once; one that comes sooner is the first one's echo, since
/// some programs send it to a process and to its group.
#[cfg(unix)]
const ECHO: Duration = Duration::from_millis(300);

/// Ends the work if it is to stop.
pub(super) fn check(stop: &AtomicBool) -> Result<(), Failure> {
    if stop.load(Ordering::Relaxed) {
        return Err(Failure::Interrupted);
    }
    Ok(())
}

/// Why work ended with an error: it was to stop, or its input is bad.
pub(super) fn failure(stop: &AtomicBool, error: impl Display) -> Failure {
    check(stop).err().unwrap_or_else(|| Failure::bad(error))
}

impl Signals {
    /// Listens from now on.
    pub(super) fn listen() -> Result<Arc<Self>, Failure> {
        let signals = Arc::new(Self::default());
        #[cfg(unix)]
        {
            use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM, SIGUSR1};
            use signal_hook::iterator::Signals as Arriving;

            let mut wanted = vec![SIGINT, SIGTERM, SIGUSR1];
            if !is_ignored(SIGHUP) {
                wanted.push(SIGHUP);
            }
            let mut arriving = Arriving::new(wanted).map_err(Failure::system)?;
            let told = Arc::clone(&signals);
            std::thread::spawn(move || {
                let mut first: Option<Instant> = None;
                for signal in arriving.forever() {
                    if signal == SIGUSR1 {
                        told.save.store(true, Ordering::Relaxed);
                        continue;
                    }
                    let is_second = first.is_some_and(|first| first.elapsed() > ECHO);
                    if !told.at_work.load(Ordering::SeqCst) || (signal == SIGINT && is_second) {
                        told.leave();
                    }
                    told.stop.store(true, Ordering::Relaxed);
                    first.get_or_insert_with(Instant::now);
                }
            });
        }
        Ok(signals)
    }

    /// From now on there is work to save.
    pub(super) fn begin_work(&self) {
        self.at_work.store(true, Ordering::SeqCst);
    }

    /// The file is removed if a signal ends the program.
    pub(super) fn clean(&self, file: PathBuf) {
        let fleeting = self.fleeting.lock();
        fleeting.unwrap_or_else(PoisonError::into_inner).push(file);
    }

    #[cfg(unix)]
    fn leave(&self) -> ! {
        let fleeting = self.fleeting.lock();
        for file in fleeting.unwrap_or_else(PoisonError::into_inner).iter() {
            let _ = std::fs::remove_file(file);
        }
        // Nobody may read it any more.
        let _ = writeln!(
            std::io::stderr(),
            "{}",
            if self.at_work.load(Ordering::SeqCst) {
                "interrupted at once: what was not saved yet is lost"
            } else {
                "interrupted"
            }
        );
        std::process::exit(130)
    }
}

/// Whether the process was started with a signal ignored, as `nohup` does with SIGHUP.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = line.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.is_some_and(|mask| mask >> (signal - 1) & 1 == 1)
}

/// Ends the program, as SIGTERM does, once the standard input closes. Its other end is held by the
/// process that started this one, and closes however that process ends, SIGKILL included.
pub(super) fn end_with_stdin() {
    std::thread::spawn(|| {
        // What is written there has no meaning, and what cannot be read counts as closed.
        let _ = std::io::copy(&mut std::io::stdin(), &mut std::io::sink());
        #[cfg(unix)]
        let _ =
            rustix::process::kill_process(rustix::process::getpid(), rustix::process::Signal::TERM);
        #[cfg(not(unix))]
        std::process::exit(130);
    });
}

/// Lets a write beyond the limit of file sizes (`ulimit -f`) fail as any other, instead of ending
/// the program.
pub(super) fn survive_file_limits() {
    #[cfg(unix)]
    {
        // If it cannot be had, the program is as it was without.
        let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, Arc::default());
    }
}
