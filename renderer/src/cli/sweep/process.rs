//! A task as a process.

use std::io::{Read as _, Seek as _};
use std::process::{Child, Command, ExitStatus, Stdio};
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

/// Runs this program with other words. It is told to save its work when a signal asks this one to.
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
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(messages.try_clone()?)
        .spawn()?;
    let mut pause = Duration::from_millis(1);
    let mut is_told = false;
    let status = loop {
        if let Some(status) = child.try_wait()? {
            break status;
        }
        if !is_told && signals.stop.load(Ordering::Relaxed) {
            end(&mut child);
            is_told = true;
        }
        std::thread::sleep(pause);
        pause = (pause * 2).min(PAUSE);
    };
    messages.rewind()?;
    let mut said = Vec::new();
    messages.read_to_end(&mut said)?;
    Ok((status, String::from_utf8_lossy(&said).into_owned()))
}

/// Asks a process to save its work and leave.
fn end(child: &mut Child) {
    #[cfg(unix)]
    if let Ok(id) = i32::try_from(child.id())
        && let Some(id) = rustix::process::Pid::from_raw(id)
    {
        // It may just have ended by itself.
        let _ = rustix::process::kill_process(id, rustix::process::Signal::TERM);
    }
    #[cfg(not(unix))]
    let _ = child.kill();
}
