//! Random plans of leaves and random scenes within the documented ranges: each is grown, built and
//! rendered, or measured, or it is refused with a reason; none panics, takes for ever, or leaves a
//! number that is not finite.
//!
//! They are drawn from the schema that the book's tables are made of, so that a new key is
//! tried without a change here. `LAMINA_PLANS=0..5000` and `LAMINA_SCENES=0..2000` try others than the
//! tests' own; the number of a failure, over 12, is that of the plan or scene. `LAMINA_TRIED=FILE`
//! keeps what was tried, so that a range that is interrupted goes on, also after what ends the
//! program.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::{File, OpenOptions};
use std::io::Write as _;
use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{Sender, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use glam::DVec3;
use leafmodel::compound::WholeLeaf;
use renderer::instruments::{Budget, FEWEST_RAYS, read_out, sets_of};
use renderer::integrator::render::{Halt, Job, render_until};
use renderer::scene::description::{Description, Mesh, Shape};
use renderer::scene::load::{parse, parse_for_instruments};
use renderer::scene::world::{BuildOptions, World};
use tempfile::TempDir;

mod chance;
mod plan;
mod scene;
mod written;

/// Time that one plan may take. The slowest take some 20 s on an idle machine; the rest is for one
/// that is busy.
const LONGEST: Duration = Duration::from_secs(300);

/// The same in a long run, on a machine that does nothing else.
const LONGEST_ALONE: Duration = Duration::from_secs(60);

/// Most memory that a scene may take, bytes.
const MOST_BYTES: f64 = 2e9;

/// Most squares of a ground or a wall: more are refused by their memory.
const MOST_SQUARES: f64 = 1e6;

/// Texts that are drawn for one plan or scene, until one of them contradicts itself in nothing that shows
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

/// Refuses what the program refuses by the memory that it needs.
fn check_memory(scene: &Description) -> Result<(), String> {
    let mut bytes = 0.0;
    for leaf in &scene.leaves {
        let memory = leaf.value.plan.memory();
        let memory = memory.map_err(|error| error.to_string())?;
        bytes += memory.veins + memory.blade + memory.kept;
    }
    for solid in &scene.solids {
        let own = solid.value.plan.memory_bytes();
        bytes += own.map_err(|error| error.to_string())?;
    }
    let squares = scene.meshes.iter().map(|mesh| match &mesh.value {
        Shape::Mesh(Mesh::Terrain(terrain)) => terrain.squares().iter().product(),
        Shape::Mesh(Mesh::Masonry(wall)) => wall.squares(),
        Shape::Mesh(_) | Shape::Body(_) => 0.0,
    });
    if bytes > MOST_BYTES || squares.sum::<f64>() > MOST_SQUARES {
        return Err("more than the memory that is allowed".to_owned());
    }
    Ok(())
}

/// Renders a scene.
fn render(scene: &Description) -> Result<(), String> {
    let options = BuildOptions {
        most_bytes: Some(MOST_BYTES),
        ..BuildOptions::default()
    };
    let world = World::build_with(scene, &options).map_err(|error| error.to_string())?;
    let (low, high) = world.geometry.bounds();
    assert!(low.is_finite() && high.is_finite(), "bounds: {low} {high}");
    let job = Job {
        width: scene.film.width,
        height: scene.film.height,
        spp: scene.film.spp,
        seed: 1,
    };
    let never = AtomicBool::new(false);
    let rendered = render_until(&world, &job, &Halt::default(), &never, &|_| ());
    let rendered = rendered.expect("a small film fits");
    assert_eq!(rendered.film.rejected(), 0, "samples that are not finite");
    Ok(())
}

/// Reads out the instruments of a scene with few rays.
fn measure(scene: &Description) -> Result<(), String> {
    let Some((sampler, first)) = sets_of(scene) else {
        return Ok(());
    };
    let options = BuildOptions {
        wavelengths: Some(&sampler),
        most_bytes: Some(MOST_BYTES),
        ..BuildOptions::default()
    };
    let world = World::build_with(scene, &options).map_err(|error| error.to_string())?;
    let budget = Budget {
        rays: FEWEST_RAYS,
        error: None,
        seed: 1,
    };
    for (number, &first) in first.iter().enumerate() {
        let reading = read_out(&world, scene, number, first, &budget);
        for row in reading.map_err(|error| error.to_string())?.rows {
            let is_good = row.value.is_finite() && row.error.is_finite() && row.error >= 0.0;
            assert!(is_good, "{row:?}");
        }
    }
    Ok(())
}

/// Carries out a scene; if `looks_into`, its leaves are grown once more, to look at every number of
/// them.
fn carry_out(text: &str, folder: &Path, looks_into: bool) -> Outcome {
    let read = |text: &str| {
        if text.contains("[instruments.") {
            parse_for_instruments(text, "plan.toml", folder, &[])
        } else {
            parse(text, "plan.toml", folder, &[])
        }
    };
    let scene = match read(text) {
        Ok(loaded) => loaded.description,
        Err(errors) => {
            assert!(!errors.errors().is_empty(), "an error without a reason");
            return Outcome::NotRead(errors.errors()[0].error.to_string());
        }
    };
    if let Err(error) = check_memory(&scene) {
        return Outcome::Refused(error);
    }
    for leaf in scene.leaves.iter().filter(|_| looks_into) {
        match WholeLeaf::grow(&leaf.value.plan) {
            Ok(leaf) => check_leaf(&leaf),
            Err(error) => return Outcome::Refused(error.to_string()),
        }
    }
    let done = if scene.instruments.is_empty() {
        render(&scene)
    } else {
        measure(&scene)
    };
    done.map_or_else(Outcome::Refused, |()| Outcome::Rendered)
}

/// What is tried: its name, and the text of a number.
#[derive(Clone, Copy)]
struct Kind {
    name: &'static str,
    text: fn(u64) -> String,
}

/// What was tried of a range, in a file if one is asked for.
struct Tried {
    file: Option<Mutex<File>>,
    /// What needs no other trial: it is done, or has ended the program twice.
    done: BTreeSet<u64>,
    /// What has ended the program twice.
    fatal: Vec<u64>,
}

impl Tried {
    fn of(kind: Kind) -> Self {
        let Some(path) = std::env::var_os("LAMINA_TRIED") else {
            return Self {
                file: None,
                done: BTreeSet::new(),
                fatal: Vec::new(),
            };
        };
        let text = std::fs::read_to_string(&path).unwrap_or_default();
        let mut begun: BTreeMap<u64, usize> = BTreeMap::new();
        let mut done = BTreeSet::new();
        for line in text.lines() {
            let mut words = line.split(' ');
            let (name, seed, what) = (words.next(), words.next(), words.next());
            let Some(seed) = seed.and_then(|seed| seed.parse().ok()) else {
                continue;
            };
            if name == Some(kind.name) && what == Some("begun") {
                *begun.entry(seed).or_default() += 1;
            } else if name == Some(kind.name) {
                done.insert(seed);
            }
        }
        let fatal = begun
            .into_iter()
            .filter(|(seed, times)| *times > 1 && !done.contains(seed));
        let fatal: Vec<u64> = fatal.map(|(seed, _)| seed).collect();
        done.extend(&fatal);
        let file = OpenOptions::new().create(true).append(true).open(&path);
        let file = file.unwrap_or_else(|error| panic!("LAMINA_TRIED: {error}"));
        Self {
            file: Some(Mutex::new(file)),
            done,
            fatal,
        }
    }

    fn note(&self, kind: Kind, seed: u64, what: &str) {
        if let Some(file) = &self.file {
            let mut file = file.lock().unwrap_or_else(PoisonError::into_inner);
            let _ = writeln!(file, "{} {seed} {what}", kind.name);
        }
    }
}

/// Plans that are tried on threads of their own, so that one that never ends holds up no other.
struct Trial {
    kind: Kind,
    tried: Tried,
    longest: Duration,
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
                if trial.tried.done.contains(&seed) {
                    continue;
                }
                trial.tried.note(trial.kind, seed, "begun");
                let mut attempts = seed * TRIES..(seed + 1) * TRIES;
                while let Some(number) = attempts.next() {
                    let started = Instant::now();
                    trial.under_way().insert(number, started);
                    let text = (trial.kind.text)(number);
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
                    let what = match &outcome {
                        Ok(Outcome::Rendered) => "carried out",
                        Ok(Outcome::NotRead(_) | Outcome::Refused(_)) => "refused",
                        Err(_) => "failed",
                    };
                    trial.tried.note(trial.kind, seed, what);
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
            .find(|(_, started)| started.elapsed() > self.longest);
        let seed = *late?.0;
        under_way.remove(&seed);
        Some(seed)
    }
}

/// What came of a range.
struct Found {
    rendered: usize,
    /// How often others were refused, by the reason.
    refused: BTreeMap<String, usize>,
    count: u64,
}

/// Tries plans.
fn try_plans(kind: Kind, range: Range<u64>, longest: Duration) -> Found {
    let tried = Tried::of(kind);
    let count = range
        .clone()
        .filter(|seed| !tried.done.contains(seed))
        .count() as u64;
    let fatal = tried.fatal.clone();
    let trial = Arc::new(Trial {
        kind,
        tried,
        longest,
        folder: plan::folder(),
        next: AtomicU64::new(range.start),
        end: range.end,
        under_way: Mutex::default(),
    });
    let (told, outcomes) = channel();
    for _ in 0..WORKERS {
        trial.work(told.clone());
    }
    let mut left = count;
    let (mut rendered, mut refused, mut failed) = (0, BTreeMap::new(), Vec::new());
    for seed in fatal {
        failed.push((seed * TRIES, "ends the program".to_owned()));
    }
    while left > 0 {
        if let Ok((seed, took, outcome)) = outcomes.recv_timeout(Duration::from_secs(1)) {
            left -= 1;
            if left.is_multiple_of(500) {
                eprintln!("{left} {}s are left, {rendered} were rendered", kind.name);
            }
            if took > NOTEWORTHY {
                eprintln!("{} {seed} took {:.1} s", kind.name, took.as_secs_f64());
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
                    eprintln!("{} {seed}: {words}", kind.name);
                    failed.push((seed, words));
                }
            }
        }
        while let Some(seed) = trial.give_up() {
            left -= 1;
            eprintln!("{} {seed}: takes too long", kind.name);
            trial.tried.note(kind, seed / TRIES, "takes too long");
            failed.push((seed, "takes too long".to_owned()));
            trial.work(told.clone());
        }
    }
    if let Some((seed, why)) = failed.first() {
        let text = (kind.text)(*seed);
        let (count, name) = (failed.len(), kind.name);
        panic!("{count} {name}s failed, the first, {seed}: {why}\n{text}");
    }
    Found {
        rendered,
        refused,
        count,
    }
}

/// The range that the environment asks for instead.
fn asked(variable: &str) -> Option<Range<u64>> {
    let asked = std::env::var(variable).ok()?;
    let numbers = asked.split_once("..");
    let numbers = numbers.and_then(|(start, end)| Some(start.parse().ok()?..end.parse().ok()?));
    Some(numbers.unwrap_or_else(|| panic!("{variable} is {asked}, not like 0..5000")))
}

/// Tries a range; `least` is the fraction that has to be carried out: a test that refuses nearly all
/// would try nothing.
fn try_range(kind: Kind, range: Range<u64>, longest: Duration, least: f64) {
    let Found {
        rendered,
        refused,
        count,
    } = try_plans(kind, range, longest);
    eprintln!(
        "{rendered} of {count} {}s were carried out; the others:",
        kind.name
    );
    for (why, times) in &refused {
        eprintln!("{times:5} {why}");
    }
    assert!(
        rendered as f64 >= least * count as f64 || count < 10,
        "{rendered} of {count} were carried out"
    );
}

#[test]
fn random_plans_are_rendered_or_refused() {
    let kind = Kind {
        name: "plan",
        text: plan::text,
    };
    match asked("LAMINA_PLANS") {
        Some(range) => try_range(kind, range, LONGEST_ALONE, 0.5),
        None => try_range(kind, 0..40, LONGEST, 0.5),
    }
}

#[test]
fn random_scenes_are_rendered_or_measured_or_refused() {
    let kind = Kind {
        name: "scene",
        text: scene::text,
    };
    match asked("LAMINA_SCENES") {
        Some(range) => try_range(kind, range, LONGEST_ALONE, 0.3),
        None => try_range(kind, 0..40, LONGEST, 0.3),
    }
}
