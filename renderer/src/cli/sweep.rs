//! `lamina sweep`: one scene rendered, or one leaf grown, with many settings.
//!
//! Each task is a process of its own, the same command that a person would give; what kills one
//! kills no other. A task is done when its record is there, which is written last. Files and
//! records are named by what they are made from, so whatever else the sweep becomes, nothing is
//! done twice.

mod film;
mod list;
mod process;
mod record;
mod table;
mod tasks;

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

use leafmodel::species;
use serde_json::json;

use self::process::Ended;
use self::record::Record;
use self::table::{Row, State};
use self::tasks::words_of;
use crate::cli::arguments::{SweepArguments, file_and_leaf};
use crate::cli::grow;
use crate::cli::places::{check_writable, write_json};
use crate::cli::progress::Clock;
use crate::cli::signals::Signals;
use crate::cli::terminal::{Failure, say};
use crate::scene::fingerprint::hexadecimal;
use crate::sweep::{Sweep, Target, Words, is_sweep_file};

pub(super) fn run(arguments: &SweepArguments) -> Result<(), Failure> {
    let sweep = opened(arguments)?;
    for note in &sweep.notes {
        eprintln!("note: {note}");
    }
    let count = sweep.len();
    let range = arguments.tasks.map_or(0..count, |tasks| tasks.of(count));
    if range.end > count {
        let (first, end, last) = (range.start, range.end, count - 1);
        bail!("--tasks {first}..{end}: the sweep has {count} tasks, from 0 to {last}");
    }
    if range.is_empty() {
        eprintln!("this part of the {count} tasks is empty");
        return Ok(());
    }
    eprintln!("{} of {count} tasks", range.len());
    let films = film::planned(&sweep, arguments)?;
    let Some(folder) = &arguments.out else {
        return list::print(&sweep, arguments, range);
    };
    let mut identities = Vec::new();
    let clock = Clock::new();
    tasks::identities(&sweep, range.clone(), |_, identity| {
        identities.push(identity);
        if clock.is_due() {
            eprintln!("{} of {} tasks are read", identities.len(), range.len());
        }
        true
    })?;
    let made = folder.join("tasks");
    let refused = Failure::system_at(&made);
    std::fs::create_dir_all(&made).map_err(refused)?;
    record::check_version(&made)?;
    let table = folder.join(match arguments.tasks {
        None => "sweep.csv".to_owned(),
        Some(_) => format!("sweep-{}-{}.csv", range.start, range.end),
    });
    check_writable(&table)?;
    check_writable(&made.join("record"))?;
    let signals = Signals::listen()?;
    signals.begin_work();
    let work = Work {
        sweep: &sweep,
        arguments,
        signals: &signals,
        range,
        identities,
        made,
    };
    let result = work.carry_out();
    // Whatever has happened, the table tells what there is.
    let rows = work.rows(&result.failed)?;
    table::write(&table, &sweep, &rows)?;
    write_json(&folder.join("sweep.json"), &work.about())?;
    say(table.display());
    result.report(&work)?;
    let timing = arguments.timing.timing();
    film::write(&films, &work.identities, &work.made, timing, &signals.stop)
}

/// The sweep that the command line asks for.
fn opened(arguments: &SweepArguments) -> Result<Sweep, Failure> {
    let what = arguments.what.as_str();
    let words = Words {
        over: &arguments.over,
        seeds: arguments.seeds,
        fixed: &arguments.overrides,
        spp: arguments.spp,
        noise: arguments.noise,
    };
    let (path, leaf) = file_and_leaf(what);
    let leaf_target = || Target::Leaf(what.to_owned());
    if leaf.is_some() || species::find(what).is_some() {
        return Ok(Sweep::words(leaf_target(), what, &words)?);
    }
    if grow::is_word(what) && !path.exists() {
        return Err(grow::unknown_preset(what));
    }
    let (is_sweep, is_scene) = is_sweep_file(&path)?;
    if is_sweep {
        return Ok(Sweep::file(&path, &words)?);
    }
    let target = if is_scene {
        Target::Scene(path)
    } else {
        leaf_target()
    };
    Ok(Sweep::words(target, what, &words)?)
}

/// Tasks to be done.
struct Work<'a> {
    sweep: &'a Sweep,
    arguments: &'a SweepArguments,
    signals: &'a Signals,
    range: Range<usize>,
    /// Of each task of the range.
    identities: Vec<u64>,
    /// The folder of their files.
    made: PathBuf,
}

/// What has become of the tasks.
#[derive(Debug, Default)]
struct Outcome {
    done: usize,
    /// Those that were done before.
    before: usize,
    failed: BTreeMap<u64, String>,
    interrupted: bool,
}

impl Work<'_> {
    fn carry_out(&self) -> Outcome {
        let is_open = |identity: &u64| !Record::is_there(&self.made, *identity);
        let mut seen = BTreeSet::new();
        // Tasks that are the same are done once.
        let numbered = self.range.clone().zip(self.identities.iter().copied());
        let numbered = numbered.filter(|(_, identity)| seen.insert(*identity));
        let open: Vec<(usize, u64)> = numbered.filter(|(_, own)| is_open(own)).collect();
        let (all, before) = (self.range.len(), seen.len() - open.len());
        let twins = all - seen.len();
        if twins > 0 {
            eprintln!("{twins} of {all} tasks are the same as others: each is done once");
        }
        if !open.is_empty() && before > 0 {
            eprintln!("{before} of {all} tasks are done already");
        }
        let outcome = Mutex::new(Outcome {
            before,
            ..Outcome::default()
        });
        let next = AtomicUsize::new(0);
        let clock = Clock::new();
        let jobs = usize::from(self.arguments.jobs).min(open.len());
        let work = || {
            while let Some(&(number, identity)) = open.get(next.fetch_add(1, Ordering::Relaxed)) {
                if self.signals.stop.load(Ordering::Relaxed) {
                    break;
                }
                let began = Instant::now();
                let ended = self.one(number, identity, jobs);
                let mut outcome = outcome.lock().unwrap_or_else(PoisonError::into_inner);
                outcome.take(identity, ended);
                let count = outcome.done + outcome.failed.len();
                let problem = outcome.failed.get(&identity).map(String::as_str);
                let is_due = open.len() <= 100 || clock.is_due() || count == open.len();
                if problem.is_some() || is_due {
                    self.report(number, problem, [count, open.len()], began);
                }
            }
        };
        std::thread::scope(|scope| {
            for _ in 0..jobs {
                scope.spawn(work);
            }
        });
        let mut outcome = outcome.into_inner().unwrap_or_else(PoisonError::into_inner);
        outcome.interrupted |= self.signals.stop.load(Ordering::Relaxed);
        outcome
    }

    /// Does a task: its process, then its record.
    fn one(&self, number: usize, identity: u64, jobs: usize) -> Ended {
        let task = self.sweep.task(number);
        let mut words = words_of(self.sweep, &task, &self.arguments.cache);
        let default = || (rayon::current_num_threads() / jobs).max(1);
        let threads = self.arguments.threads.map_or_else(default, usize::from);
        words.extend(["--threads".to_owned(), threads.to_string()]);
        let files = record::files(self.sweep, &self.made, identity, &mut words);
        let ended = process::run(&words, self.signals);
        if !matches!(ended, Ended::Done) {
            return ended;
        }
        let record = Record::of(self.sweep, &task, identity, &self.made, files);
        match record.and_then(|record| record.write(&self.made)) {
            Ok(()) => Ended::Done,
            Err(problem) => Ended::Failed(problem),
        }
    }

    /// Prints a line about a task that has ended.
    fn report(
        &self,
        number: usize,
        problem: Option<&str>,
        [count, all]: [usize; 2],
        began: Instant,
    ) {
        let task = self.sweep.task(number);
        let mut settings: Vec<String> = task.overrides().collect();
        settings.extend(task.seed.map(|seed| format!("seed {seed}")));
        let settings = settings.join(" ");
        if let Some(problem) = problem {
            eprintln!("task {number} failed: {settings}\n{}", problem.trim_end());
            return;
        }
        let seconds = began.elapsed().as_secs_f64();
        eprintln!("{count} of {all}: task {number}, {seconds:.1} s  {settings}");
    }

    /// The table's rows.
    fn rows(&self, failed: &BTreeMap<u64, String>) -> Result<Vec<Row<'_>>, Failure> {
        let numbered = self.range.clone().zip(&self.identities);
        let rows = numbered.map(|(number, identity)| {
            let record = Record::read(&self.made, *identity).map_err(Failure::system)?;
            let state = match &record {
                Some(_) => State::Done,
                None if failed.contains_key(identity) => State::Failed,
                None => State::Open,
            };
            Ok(Row {
                task: self.sweep.task(number),
                identity: *identity,
                state,
                record,
            })
        });
        rows.collect()
    }

    /// What the sweep is, for those who find its folder.
    fn about(&self) -> serde_json::Value {
        let mut about = list::about(self.sweep);
        about["what"] = json!(self.arguments.what);
        about["words"] = json!(self.words());
        about
    }

    /// What the command line adds to a sweep file, or says instead of one.
    fn words(&self) -> Vec<String> {
        let arguments = self.arguments;
        let pair = |flag: &str, value: String| [flag.to_owned(), value];
        let over = arguments.over.iter().map(|own| pair("--over", own.clone()));
        let fixed = arguments
            .overrides
            .iter()
            .map(|own| pair("-D", own.clone()));
        let numbers = [
            ("--seeds", arguments.seeds.map(|seeds| seeds.to_string())),
            ("--spp", arguments.spp.map(|spp| spp.to_string())),
            ("--noise", arguments.noise.map(|noise| noise.to_string())),
        ];
        let numbers = numbers.into_iter();
        let numbers = numbers.filter_map(|(flag, number)| Some(pair(flag, number?)));
        over.chain(fixed).chain(numbers).flatten().collect()
    }
}

impl Outcome {
    fn take(&mut self, identity: u64, ended: Ended) {
        match ended {
            Ended::Done => self.done += 1,
            Ended::Interrupted => self.interrupted = true,
            Ended::Failed(problem) => {
                self.failed.insert(identity, problem);
            }
        }
    }

    /// The result of the command.
    fn report(&self, work: &Work<'_>) -> Result<(), Failure> {
        let all = work.range.len();
        let Self { done, before, .. } = self;
        eprintln!(
            "{done} tasks done now, {before} before, {} failed, {all} in all",
            self.failed.len()
        );
        if self.interrupted {
            eprintln!("interrupted: the same command goes on");
            return Err(Failure::Interrupted);
        }
        if let Some(identity) = self.failed.keys().next() {
            return Err(Failure::system(format!(
                "{} of {all} tasks failed, {} first: the same command tries them again",
                self.failed.len(),
                hexadecimal(*identity)
            )));
        }
        Ok(())
    }
}
