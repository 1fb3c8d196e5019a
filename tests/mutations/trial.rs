//! A parser's trial: many changed files, each of which it reads or refuses.

use std::fs::{self, File};
use std::io::{Seek, SeekFrom, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use super::changed::changed;
use crate::MEMORY;

/// Longest time for a file.
const LONGEST: Duration = Duration::from_secs(10);
/// Most memory for a file of the corpus' size, bytes.
const MOST_MEMORY: usize = 64 << 20;

/// A parser and what it is tried with.
pub(crate) struct Parser<'p> {
    /// Its name, and that of its folder in the corpus.
    pub(crate) name: &'static str,
    pub(crate) seeds: Vec<Vec<u8>>,
    /// Reads a file: whether it was accepted. A refusal must say something.
    pub(crate) read: &'p dyn Fn(&[u8]) -> bool,
    /// Puts checksums right, in every other file, so that changes get past them.
    pub(crate) mend: Option<fn(&mut [u8])>,
}

/// Memory is counted for one parser at a time.
static ALONE: Mutex<()> = Mutex::new(());

/// What the last refusal said.
static SAID: Mutex<String> = Mutex::new(String::new());

/// Notes what a parser says to a file.
///
/// # Panics
///
/// If that is nothing.
pub(crate) fn refuse(said: String) {
    assert!(!said.is_empty(), "refused without a word");
    *SAID.lock().unwrap_or_else(PoisonError::into_inner) = said;
}

/// Tries a parser with the files kept for it and with changed ones.
///
/// # Panics
///
/// If one made it panic, took too long or took too much memory; the files are kept in the system's
/// folder for temporary files.
pub(crate) fn run(parser: &Parser<'_>) {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    let count = std::env::var("LAMINA_MUTATIONS").ok();
    let count = count.map_or(500, |text| {
        text.parse().expect("LAMINA_MUTATIONS is a number")
    });
    for (number, seed) in parser.seeds.iter().enumerate() {
        let is_read = (parser.read)(seed);
        let said = SAID.lock().unwrap_or_else(PoisonError::into_inner);
        assert!(is_read, "seed {number} of {}: {said}", parser.name);
    }
    let under_way = watch(parser.name);
    let mut totals = Totals::default();
    for (number, file) in (0..).zip(files_of(&kept(), parser.name)) {
        // Numbers that no changed file has.
        under_way.store(u64::MAX - 1, Ordering::Relaxed);
        let bytes = fs::read(file).expect("a committed file");
        totals.add(parser, u64::MAX - 1 - number, &bytes);
    }
    totals.read = 0;
    // A case that ends the whole program can be told from this file.
    let place = std::env::temp_dir().join(format!(
        "lamina-mutations-{}-{}",
        parser.name,
        std::process::id()
    ));
    let mut note = File::create(&place).expect("a place for temporary files");
    for case in 0..count {
        let mut bytes = changed(&parser.seeds, case);
        if let (Some(mend), 1) = (parser.mend, case % 2) {
            mend(&mut bytes);
        }
        note.seek(SeekFrom::Start(0)).expect("a file");
        write!(note, "{case:>20}").expect("a file");
        under_way.store(case, Ordering::Relaxed);
        totals.add(parser, case, &bytes);
    }
    let _ = fs::remove_file(place);
    let Totals {
        read,
        longest,
        most,
        ref faults,
    } = totals;
    eprintln!(
        "{}: {read} of {count} read, {} refused; longest {:.3} s, most memory {:.1} MiB",
        parser.name,
        count - read,
        longest.as_secs_f64(),
        most as f64 / f64::from(1 << 20),
    );
    assert!(faults.is_empty(), "{}: {}", parser.name, faults.join("\n"));
    assert!(
        0 < read && read < count,
        "{}: {read} of {count} were read",
        parser.name
    );
}

#[derive(Default)]
struct Totals {
    read: u64,
    longest: Duration,
    most: usize,
    faults: Vec<String>,
}

impl Totals {
    fn add(&mut self, parser: &Parser<'_>, case: u64, bytes: &[u8]) {
        MEMORY.reset_peak_usage();
        let before = MEMORY.current_usage();
        let started = Instant::now();
        let outcome = catch_unwind(AssertUnwindSafe(|| (parser.read)(bytes)));
        let time = started.elapsed();
        let memory = MEMORY.peak_usage().saturating_sub(before);
        self.read += u64::from(outcome.as_ref().is_ok_and(|read| *read));
        self.longest = self.longest.max(time);
        self.most = self.most.max(memory);
        let fault = if outcome.is_err() {
            "a panic".to_owned()
        } else if time > LONGEST {
            format!("{:.1} s", time.as_secs_f64())
        } else if memory > MOST_MEMORY {
            format!("{} MiB", memory >> 20)
        } else {
            return;
        };
        let file = std::env::temp_dir().join(format!("lamina-{}-{case}", parser.name));
        fs::write(&file, bytes).expect("a place for temporary files");
        self.faults.push(format!("{fault}: {}", file.display()));
    }
}

/// Ends the program if one case is under way for much longer than it may; the number to tell the
/// case in, which ends the watch when it goes.
fn watch(name: &'static str) -> Arc<AtomicU64> {
    let under_way = Arc::new(AtomicU64::new(u64::MAX));
    let watched = Arc::downgrade(&under_way);
    thread::spawn(move || {
        let mut last = u64::MAX;
        loop {
            thread::sleep(3 * LONGEST);
            let Some(under_way) = watched.upgrade() else {
                return;
            };
            let now = under_way.load(Ordering::Relaxed);
            if now == last {
                eprintln!("{name}: case {now} hangs");
                std::process::exit(1);
            }
            last = now;
        }
    });
    under_way
}

/// Files that once did harm.
fn kept() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("mutations/kept")
}

/// The files of a folder's folder in the order of their names; none if it is not there.
pub(crate) fn files_of(folder: &Path, name: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder.join(name)).into_iter().flatten();
    let mut files: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    files.sort();
    files
}
