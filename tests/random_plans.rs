//! Random plans within the documented ranges: each grows, becomes a mesh and is rendered, or is
//! refused with a reason; none panics, takes for ever, or leaves a number that is none.
//!
//! The plans are drawn from the schema that the book's tables are made of, so that a new key is
//! tried without a change here. `LAMINA_PLANS=0..5000` tries others than the test's own 40; the number
//! that a failure tells, over 12, is the plan's.

use std::collections::BTreeMap;
use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{Sender, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use glam::DVec3;
use leafmodel::compound::WholeLeaf;
use renderer::integrator::render::{Halt, Job, render_until};
use renderer::scene::load::parse;
use renderer::scene::world::World;
use tempfile::TempDir;

mod chance;
mod plan;
mod written;

/// Time that one plan may take. The slowest take some 20 s on an idle machine; the rest is for one
/// that is busy.
const LONGEST: Duration = Duration::from_secs(300);

/// Texts that are drawn for one plan, until one of them contradicts itself in nothing that shows
/// when it is read.
const TRIES: u64 = 12;

/// Time that is told of.
const NOTEWORTHY: Duration = Duration::from_secs(20);

/// Plans that are tried at once.
const WORKERS: usize = 2;

/// What became of a plan that was not a failure.
enum Outcome {
    Rendered,
    /// Refused when it was read, which costs little.
    NotRead(String),
    /// Refused when it was grown.
    Refused(String),
}

fn is_finite(points: &[DVec3]) -> bool {
    points.iter().all(|point| point.is_finite())
}

/// Checks the numbers of a grown leaf.
fn check_leaf(leaf: &WholeLeaf) {
    for blade in &leaf.blades {
        assert_eq!(blade.lamina.network.validate(), Ok(()), "the veins");
        assert!(is_finite(&blade.mesh.positions), "a place of the blade");
        assert!(is_finite(&blade.mesh.normals), "a normal of the blade");
        let mut texels = blade.contents.texels.iter();
        let good = |value: f32| value.is_finite() && value >= 0.0;
        assert!(
            texels.all(|texel| texel.iter().all(|(_, value)| good(*value))),
            "contents"
        );
        for stalk in blade.petiole.iter().chain(&leaf.axes) {
            assert!(is_finite(&stalk.positions), "a place of a stalk");
            assert!(is_finite(&stalk.normals), "a normal of a stalk");
        }
        for hairs in &blade.hairs {
            assert!(is_finite(&hairs.positions), "a place of a hair");
        }
    }
}

/// Carries out a plan; if `looks_into`, its leaf is grown once more, to look at every number of it.
fn carry_out(text: &str, folder: &Path, looks_into: bool) -> Outcome {
    let loaded = match parse(text, "plan.toml", folder, &[]) {
        Ok(loaded) => loaded,
        Err(errors) => {
            assert!(!errors.errors().is_empty(), "an error without a reason");
            return Outcome::NotRead(errors.errors()[0].error.to_string());
        }
    };
    let scene = loaded.description;
    for leaf in scene.leaves.iter().filter(|_| looks_into) {
        match WholeLeaf::grow(&leaf.value.plan) {
            Ok(leaf) => check_leaf(&leaf),
            Err(error) => return Outcome::Refused(error.to_string()),
        }
    }
    let world = match World::build(&scene) {
        Ok(world) => world,
        Err(error) => return Outcome::Refused(error.to_string()),
    };
    let (low, high) = world.geometry.bounds();
    assert!(low.is_finite() && high.is_finite(), "bounds: {low} {high}");
    let job = Job {
        width: scene.film.width,
        height: scene.film.height,
        spp: scene.film.spp,
        seed: 1,
    };
    let rendered = render_until(
        &world,
        &job,
        &Halt::default(),
        &AtomicBool::new(false),
        &|_| (),
    );
    let rendered = rendered.expect("a small film fits");
    assert_eq!(rendered.film.rejected(), 0, "samples that are no numbers");
    Outcome::Rendered
}

/// Plans that are tried on threads of their own, so that one that never ends holds up no other.
struct Trial {
    folder: TempDir,
    next: AtomicU64,
    end: u64,
    /// The plans under way, and since when.
    under_way: Mutex<BTreeMap<u64, Instant>>,
}

impl Trial {
    fn under_way(&self) -> MutexGuard<'_, BTreeMap<u64, Instant>> {
        self.under_way
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
    }

    /// Starts a thread that tries one plan after the other.
    fn work(self: &Arc<Self>, told: Sender<(u64, Duration, std::thread::Result<Outcome>)>) {
        let trial = Arc::clone(self);
        std::thread::spawn(move || {
            loop {
                let seed = trial.next.fetch_add(1, Ordering::Relaxed);
                if seed >= trial.end {
                    break;
                }
                let mut attempts = seed * TRIES..(seed + 1) * TRIES;
                while let Some(number) = attempts.next() {
                    let started = Instant::now();
                    trial.under_way().insert(number, started);
                    let text = plan::text(number);
                    // What ends the whole program leaves it here.
                    let note = trial.folder.path().join(format!("{number}.plan"));
                    std::fs::write(&note, &text).expect("a place for temporary files");
                    let tried = || carry_out(&text, trial.folder.path(), seed.is_multiple_of(3));
                    let outcome = catch_unwind(AssertUnwindSafe(tried));
                    let _ = std::fs::remove_file(note);
                    // A plan that was given up has another thread in the place of this one.
                    if trial.under_way().remove(&number).is_none() {
                        return;
                    }
                    if matches!(outcome, Ok(Outcome::NotRead(_))) && !attempts.is_empty() {
                        continue;
                    }
                    if told.send((number, started.elapsed(), outcome)).is_err() {
                        return;
                    }
                    break;
                }
            }
        });
    }

    /// Gives up one of the plans that take too long.
    fn give_up(&self) -> Option<u64> {
        let mut under_way = self.under_way();
        let late = under_way
            .iter()
            .find(|(_, started)| started.elapsed() > LONGEST);
        let seed = *late?.0;
        under_way.remove(&seed);
        Some(seed)
    }
}

/// Tries plans; returns how many were rendered, and why others were refused.
fn try_plans(range: Range<u64>) -> (usize, BTreeMap<String, usize>) {
    let trial = Arc::new(Trial {
        folder: plan::folder(),
        next: AtomicU64::new(range.start),
        end: range.end,
        under_way: Mutex::default(),
    });
    let (told, outcomes) = channel();
    for _ in 0..WORKERS {
        trial.work(told.clone());
    }
    let mut left = range.end - range.start;
    let (mut rendered, mut refused, mut failed) = (0, BTreeMap::new(), Vec::new());
    while left > 0 {
        if let Ok((seed, took, outcome)) = outcomes.recv_timeout(Duration::from_secs(1)) {
            left -= 1;
            if left.is_multiple_of(500) {
                eprintln!("{left} plans are left, {rendered} were rendered");
            }
            if took > NOTEWORTHY {
                eprintln!("plan {seed} took {:.1} s", took.as_secs_f64());
            }
            match outcome {
                Ok(Outcome::Rendered) => rendered += 1,
                Ok(Outcome::Refused(why) | Outcome::NotRead(why)) => {
                    *refused.entry(why).or_default() += 1;
                }
                Err(panic) => {
                    let words = panic.downcast_ref::<String>().map(String::as_str);
                    let words = words.or(panic.downcast_ref::<&str>().copied());
                    let words = words.unwrap_or("a panic").to_owned();
                    // At once, since a long run may be stopped before its end.
                    eprintln!("plan {seed}: {words}");
                    failed.push((seed, words));
                }
            }
        }
        while let Some(seed) = trial.give_up() {
            left -= 1;
            eprintln!("plan {seed}: takes too long");
            failed.push((seed, "takes too long".to_owned()));
            trial.work(told.clone());
        }
    }
    if let Some((seed, why)) = failed.first() {
        let text = plan::text(*seed);
        panic!(
            "{} plans failed, the first, {seed}: {why}\n{text}",
            failed.len()
        );
    }
    (rendered, refused)
}

/// The plans that the environment asks for instead.
fn asked() -> Option<Range<u64>> {
    let asked = std::env::var("LAMINA_PLANS").ok()?;
    let numbers = asked.split_once("..");
    let numbers = numbers.and_then(|(start, end)| Some(start.parse().ok()?..end.parse().ok()?));
    Some(numbers.unwrap_or_else(|| panic!("LAMINA_PLANS is {asked}, not like 0..5000")))
}

fn try_and_tell(range: Range<u64>) {
    let count = range.end - range.start;
    let (rendered, refused) = try_plans(range);
    eprintln!("{rendered} of {count} plans were rendered; the others:");
    for (why, times) in &refused {
        eprintln!("{times:5} {why}");
    }
    // A test that refuses nearly all would try nothing.
    assert!(
        rendered as u64 * 2 >= count || count < 10,
        "{rendered} of {count} were rendered"
    );
}

#[test]
fn random_plans_are_rendered_or_refused() {
    try_and_tell(asked().unwrap_or(0..40));
}
