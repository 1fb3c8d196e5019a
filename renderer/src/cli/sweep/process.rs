//! A task as a process.

use std::io::{Read as _, Seek as _};
use std::process::{Command, ExitStatus, Stdio};
use std::sync::atomic::Ordering;
use std::time::Duration;

use crate::cli::signals::Signals;

/// How a task has ended.
#[derive(Debug)]
pub(super) enum Ended {
    Done,
    Interrupted,
    /// With what it said.
    Failed(String),
}

/// Longest pause between two looks at a process.
const PAUSE: Duration = Duration::from_millis(10);

/// Runs this program with other words. It saves its work and leaves when a signal asks this one to, or when this one is killed.
pub(super) fn run(words: &[String], signals: &Signals) -> Ended {
    match try_run(words, signals) {
        Ok((status, _)) if status.success() => Ended::Done,
        Ok((status, _)) if status.code() == Some(130) => Ended::Interrupted,
        Ok((status, said)) if said.trim().is_empty() => Ended::Failed(status.to_string()),
        Ok((_, said)) => Ended::Failed(said),
        Err(error) => Ended::Failed(format!("error: {error}")),
    }
}

fn try_run(words: &[String], signals: &Signals) -> std::io::Result<(ExitStatus, String)> {
    // A pipe would have to be read while the process runs.
    let mut messages = tempfile::tempfile()?;
    let mut child = Command::new(std::env::current_exe()?)
        .args(words)
        .arg("--end-with-stdin")
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(messages.try_clone()?)
        .spawn()?;
    let mut pause = Duration::from_millis(1);
    let status = loop {
        if let Some(status) = child.try_wait()? {
            break status;
        }
        if signals.stop.load(Ordering::Relaxed) {
            drop(child.stdin.take());
        }
        std::thread::sleep(pause);
        pause = (pause * 2).min(PAUSE);
    };
    messages.rewind()?;
    let mut said = Vec::new();
    messages.read_to_end(&mut said)?;
    Ok((status, String::from_utf8_lossy(&said).into_owned()))
}
