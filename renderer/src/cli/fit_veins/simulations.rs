//! The leaves that were grown, as a table from which an interrupted fit goes on.
//!
//! What is simulated depends on the problem and on earlier simulations alone, so a fit that begins
//! again asks for the same leaves; those that the table has are not grown again.

use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;
use std::sync::{Mutex, MutexGuard, PoisonError};

use leafmodel::document::whole_file;
use leafmodel::inference::{Draw, Outcome, Problem};
use rayon::prelude::*;
use serde_json::Value;

use super::free::Grower;
use crate::checkpoint::PROGRAM;
use crate::cli::places::write_whole;
use crate::cli::progress::Clock;
use crate::cli::signals::Signals;
use crate::cli::terminal::Failure;
use crate::report::vein_fit::simulations::{self, Grown, place};
use crate::scene::fingerprint::hexadecimal;

/// All simulations of a fit.
#[derive(Debug)]
pub(super) struct Simulations<'p> {
    path: PathBuf,
    /// Of the fit, so that the table of another one is not taken for its own.
    identity: String,
    problem: &'p Problem,
    known: Mutex<KnownSimulations>,
    /// Of lines about the progress, and of writings of the table.
    clock: Clock,
}

#[derive(Debug)]
struct KnownSimulations {
    grown: Grown,
    /// How many were there when the fit began.
    before: usize,
}

impl<'p> Simulations<'p> {
    /// Reads the table at `path` if there is one.
    pub(super) fn open(path: &Path, identity: u64, problem: &'p Problem) -> Result<Self, Failure> {
        let identity = hexadecimal(identity);
        let grown = read(path, &identity, problem)?;
        let before = grown.len();
        if before > 0 {
            eprintln!(
                "{before} of {} leaves are grown already",
                problem.simulations()
            );
        }
        Ok(Self {
            path: path.to_owned(),
            identity,
            problem,
            known: Mutex::new(KnownSimulations { grown, before }),
            clock: Clock::new(),
        })
    }

    /// The outcomes of some draws, in order, on all threads.
    pub(super) fn carry_out(
        &self,
        draws: &[Draw],
        grower: &Grower,
        signals: &Signals,
    ) -> Result<Vec<Outcome>, Failure> {
        let outcomes: Vec<Option<Outcome>> = draws
            .par_iter()
            .map(|draw| {
                if let Some((_, outcome)) = self.known().grown.get(&place(draw)) {
                    return Some(outcome.clone());
                }
                let outcome = grower.outcome(draw, self.problem.observed(), &signals.stop)?;
                self.keep(draw, &outcome, signals);
                Some(outcome)
            })
            .collect();
        let all: Option<Vec<Outcome>> = outcomes.into_iter().collect();
        if let Some(outcomes) = all {
            return Ok(outcomes);
        }
        self.save()?;
        eprintln!("interrupted: the same command goes on");
        Err(Failure::Interrupted)
    }

    /// Keeps a simulation; from time to time, or if a signal asks for it, all are written.
    fn keep(&self, draw: &Draw, outcome: &Outcome, signals: &Signals) {
        let mut known = self.known();
        known
            .grown
            .insert(place(draw), (draw.clone(), outcome.clone()));
        if !self.clock.is_due() && !signals.save.swap(false, Ordering::Relaxed) {
            return;
        }
        let (done, all) = (known.grown.len(), self.problem.simulations());
        let each = self.clock.seconds() / (done - known.before) as f64;
        let left = each * all.saturating_sub(done) as f64;
        eprintln!("{done} of {all} leaves, about {left:.0} s to go");
        // The last writing, when all is done, tells what is wrong.
        let _ = write_whole(
            &self.path,
            simulations::table(&known.grown, &self.identity, self.problem),
        );
    }

    fn known(&self) -> MutexGuard<'_, KnownSimulations> {
        self.known.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Writes the table.
    pub(super) fn save(&self) -> Result<(), Failure> {
        let known = self.known();
        write_whole(
            &self.path,
            simulations::table(&known.grown, &self.identity, self.problem),
        )
    }
}

/// The simulations in a file, none if there is no file.
fn read(path: &Path, identity: &str, problem: &Problem) -> Result<Grown, Failure> {
    let text = match whole_file::read_utf8(path, whole_file::MOST_BYTES) {
        Ok(text) => text,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(Grown::new()),
        Err(error) => return Err(Failure::system(format!("{}: {error}", path.display()))),
    };
    let foreign = || {
        // What a fit that came to its end has written beside its table.
        let report = std::fs::read(path.with_file_name("fit.json")).ok();
        let report = report.and_then(|bytes| serde_json::from_slice::<Value>(&bytes).ok());
        let version = report.and_then(|report| Some(report["program"].as_str()?.to_owned()));
        let path = path.display();
        Failure::bad(match version.filter(|version| version != PROGRAM) {
            Some(version) => format!(
                "{path} was written by Lamina {version}: continue the fit with that version, or name \
                 another folder by --out"
            ),
            None => format!(
                "{path} is of another fit: of another leaf, other measures, ranges, a seed, a number of \
                 simulations or a version of its own; name another folder by --out"
            ),
        })
    };
    simulations::read(&text, identity, problem).ok_or_else(foreign)
}
