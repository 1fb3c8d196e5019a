//! Sweeps: one scene, or one leaf, with many settings.
//!
//! - **In**: a sweep file ([`Sweep::file`]), or words `KEY=a,b,c` of a command line
//!   ([`Sweep::words`]).
//! - **Out**: the tasks, each a list of settings `key=value` as overrides are written.
//! - **Always true**: no key is varied twice, every number is finite, there is at least one task.
//!   Which settings task number `i` has depends on nothing but the sweep.
//! - **Left out**: what a key may be set to, which the swept file knows, and what is done with a
//!   task, which the command line does.
//!
//! ```
//! use renderer::sweep::{Sweep, Target, Words};
//!
//! let over = ["film.rgb.spp=16,64", "lights.sun.distant.elevation_deg=10..50/3"];
//! let words = Words { over: &over.map(str::to_owned), ..Words::default() };
//! let sweep = Sweep::words(Target::Scene("scene.toml".into()), "scene.toml", &words)?;
//! assert_eq!(sweep.len(), 6);
//! let last = sweep.task(5);
//! let settings: Vec<String> = last.overrides().collect();
//! assert_eq!(settings, ["film.rgb.spp=64", "lights.sun.distant.elevation_deg=50"]);
//! # Ok::<(), leafmodel::document::report::DocumentErrors>(())
//! ```

mod blame;
mod file;
mod latin;
mod range;
mod rows;
mod words;

use std::collections::{HashMap, HashSet};
use std::path::PathBuf;

use leafmodel::document::context::{Context, QUOTED};
use leafmodel::document::error::DocumentError;
use leafmodel::document::report::DocumentErrors;
use leafmodel::document::source::{Place, Sources, escaped};

pub use self::blame::Refused;
pub use self::file::is_sweep_file;
pub use self::words::Words;

/// Most tasks of a sweep.
pub const MOST_TASKS: usize = 10_000_000;

/// What is swept.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Target {
    /// A scene file, which is rendered.
    Scene(PathBuf),
    /// A leaf as `lamina grow` takes it: a preset, `FILE.toml` or `FILE.toml#NAME`.
    Leaf(String),
}

/// A key that is varied: as much of its path as overrides of the target need.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Key {
    /// The path.
    pub path: String,
    at: Place,
}

/// A value of a key, as an override has it behind `=`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cell {
    /// The value.
    pub text: String,
    at: Place,
}

/// Keys that are set together, and the rows of their values, each as long as `keys`.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Axis {
    keys: Vec<Key>,
    rows: Vec<Vec<Cell>>,
}

/// A sweep: every row of each axis with every row of the others, under every seed.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// What is swept.
    pub target: Target,
    /// Overrides that all tasks share.
    pub fixed: Vec<String>,
    /// Samples a pixel, instead of the scene's.
    pub spp: Option<u32>,
    /// Target noise, instead of the scene's.
    pub noise: Option<f64>,
    /// Seeds; none stands for that of the target.
    /// What was guessed about a table of rows, for people.
    pub notes: Vec<String>,
    seeds: Vec<u64>,
    axes: Vec<Axis>,
    sources: Sources,
}

/// One setting of all keys.
#[derive(Clone, Debug)]
pub struct Task<'s> {
    /// Its number, from 0; the last seed and the last axis change fastest.
    pub number: usize,
    /// The keys with their values, in the sweep's order.
    pub settings: Vec<(&'s Key, &'s Cell)>,
    /// The seed, if the sweep has any.
    pub seed: Option<u64>,
}

impl Task<'_> {
    /// The settings as `key=value`.
    pub fn overrides(&self) -> impl Iterator<Item = String> {
        let settings = self.settings.iter();
        settings.map(|(key, cell)| format!("{}={}", key.path, cell.text))
    }
}

impl Sweep {
    /// The number of tasks, at least 1.
    #[expect(clippy::len_without_is_empty, reason = "a sweep has a task")]
    pub fn len(&self) -> usize {
        let rows = self.axes.iter().map(|axis| axis.rows.len());
        rows.product::<usize>() * self.seeds.len().max(1)
    }

    /// The keys that are varied.
    pub fn keys(&self) -> impl Iterator<Item = &Key> {
        self.axes.iter().flat_map(|axis| &axis.keys)
    }

    /// Whether seeds are varied.
    pub fn has_seeds(&self) -> bool {
        !self.seeds.is_empty()
    }

    /// Task number `number`, which is less than [`Sweep::len`].
    pub fn task(&self, number: usize) -> Task<'_> {
        let mut rest = number;
        let mut seed = None;
        if !self.seeds.is_empty() {
            seed = Some(self.seeds[rest % self.seeds.len()]);
            rest /= self.seeds.len();
        }
        let mut rows = Vec::with_capacity(self.axes.len());
        for axis in self.axes.iter().rev() {
            rows.push(&axis.rows[rest % axis.rows.len()]);
            rest /= axis.rows.len();
        }
        let rows = rows.into_iter().rev();
        let settings = self.axes.iter().zip(rows);
        Task {
            number,
            settings: settings
                .flat_map(|(axis, row)| axis.keys.iter().zip(row))
                .collect(),
            seed,
        }
    }
}

/// What a file and the command line ask for, before it is known to be a sweep.
#[derive(Debug, Default)]
struct Draft {
    target: Option<Target>,
    fixed: Vec<String>,
    spp: Option<u32>,
    noise: Option<f64>,
    seeds: Vec<u64>,
    axes: Vec<Axis>,
}

impl Draft {
    /// Reports what is wrong with the axes together.
    fn check(&self, cx: &Context) {
        let keys: Vec<&Key> = self.axes.iter().flat_map(|axis| &axis.keys).collect();
        for (index, key) in keys.iter().enumerate() {
            if keys[..index].iter().any(|other| other.path == key.path) {
                let problem = "is varied twice";
                impossible(cx, &key.at, &key.path, problem, "keep one of the two");
            } else if is_of_flag(key, "seed") && !self.seeds.is_empty() {
                let help = "keep this one, or the seeds";
                let problem = "is varied twice: by the seeds too";
                impossible(cx, &key.at, &key.path, problem, help);
            } else {
                for (flag, is_given) in
                    [("spp", self.spp.is_some()), ("noise", self.noise.is_some())]
                {
                    if is_given && is_of_flag(key, flag) {
                        let problem = format!("is varied, and --{flag} sets it for all tasks");
                        impossible(cx, &key.at, &key.path, problem, "keep one of the two");
                    }
                }
            }
        }
        for axis in &self.axes {
            refuse_twins(cx, axis);
        }
        let mut seen = HashSet::new();
        if let Some(seed) = self.seeds.iter().find(|seed| !seen.insert(**seed)) {
            cx.error_of_the_file(DocumentError::Impossible {
                key: "seeds".to_owned(),
                problem: format!("has the seed {seed} twice"),
                help: "write each seed once".to_owned(),
            });
        }
        let rows = self.axes.iter().map(|axis| axis.rows.len());
        let mut rows = rows.chain([self.seeds.len().max(1)]);
        let count = rows.try_fold(1, usize::checked_mul);
        if count.is_none_or(|count| count > MOST_TASKS) {
            let told = count.map_or_else(|| "more than 2⁶⁴".to_owned(), |count| count.to_string());
            cx.error_of_the_file(DocumentError::Impossible {
                key: "grid".to_owned(),
                problem: format!("the sweep has {told} tasks, more than {MOST_TASKS}"),
                help: "take fewer values, or `[latin_hypercube]`, which covers many keys with few \
                       tasks"
                    .to_owned(),
            });
        }
        if keys.is_empty() && self.seeds.is_empty() && cx.error_count() == 0 {
            cx.error_of_the_file(DocumentError::Impossible {
                key: "grid".to_owned(),
                problem: "nothing is varied".to_owned(),
                help: "add `[grid]`, `[list]`, `[latin_hypercube]`, `rows` or `seeds` to a sweep \
                       file, or give --over KEY=a,b,c or --seeds N"
                    .to_owned(),
            });
        }
    }

    /// The sweep, unless there are errors.
    fn finish(self, cx: Context) -> Result<Sweep, DocumentErrors> {
        self.check(&cx);
        let (sources, errors, remarks) = cx.into_parts();
        let notes = remarks
            .into_iter()
            .map(|remark| format!("{} ({})", remark.message, remark.help));
        match self.target {
            Some(target) if errors.is_empty() => Ok(Sweep {
                target,
                fixed: self.fixed,
                spp: self.spp,
                noise: self.noise,
                notes: notes.collect(),
                seeds: self.seeds,
                axes: self.axes,
                sources,
            }),
            Some(_) | None => Err(DocumentErrors::new(sources.into(), errors)),
        }
    }
}

/// Whether a key is what a flag of this name sets: of a scene a number of its film.
fn is_of_flag(key: &Key, flag: &str) -> bool {
    let words: Vec<&str> = key.path.split('.').collect();
    matches!(words[..], [last] | ["film", _, last] if last == flag)
}

/// Reports a value that is written twice for one key: both tasks would be the same. Rows of several
/// keys may be the same by chance.
fn refuse_twins(cx: &Context, axis: &Axis) {
    let [key] = &axis.keys[..] else {
        return;
    };
    let mut seen: HashMap<&str, &Place> = HashMap::new();
    for cell in axis.rows.iter().flatten() {
        // The values of a range share its place.
        if let Some(at) = seen.insert(&cell.text, &cell.at)
            && *at != cell.at
        {
            let problem = format!("has the value {} twice", escaped(&cell.text, QUOTED));
            impossible(cx, &cell.at, &key.path, problem, "write each value once");
        }
    }
}

/// Reports a value, or a piece of a word, that cannot be carried out.
fn impossible(cx: &Context, at: &Place, key: &str, problem: impl Into<String>, help: &str) {
    let error = DocumentError::Impossible {
        key: escaped(key, QUOTED),
        problem: problem.into(),
        help: help.to_owned(),
    };
    cx.error(at, error);
}

/// A value as TOML has it, from text that may lack quotes: numbers in the form of TOML (`.5` is
/// 0.5), all else as it is. Reports what is empty or no finite number.
fn cell(cx: &Context, key: &str, text: &str, at: Place) -> Option<Cell> {
    let text = text.trim();
    if text.is_empty() {
        let problem = "has an empty value";
        impossible(cx, &at, key, problem, "write a value, or take it out");
        return None;
    }
    let text = match (text.parse::<i64>(), text.parse::<f64>()) {
        (Ok(whole), _) => whole.to_string(),
        (_, Ok(number)) if number.is_finite() => range::number_text(number),
        (_, Ok(_)) => {
            let error = DocumentError::NotFinite {
                key: escaped(key, QUOTED),
                value: escaped(text, QUOTED),
            };
            cx.error(&at, error);
            return None;
        }
        (Err(_), Err(_)) => text.to_owned(),
    };
    Some(Cell { text, at })
}

#[cfg(test)]
mod tests;
