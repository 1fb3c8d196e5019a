//! What a file and a command line ask for together.

use std::collections::{HashMap, HashSet};

use leafmodel::document::context::{Context, QUOTED};
use leafmodel::document::error::DocumentError;
use leafmodel::document::report::DocumentErrors;
use leafmodel::document::source::{Place, escaped};

use super::tasks::{Sweep, Target};
use super::values::{Axis, Key, MOST_TASKS, impossible};

/// What a file and the command line ask for, before it is known to be a sweep.
#[derive(Debug, Default)]
pub(super) struct Draft {
    pub(super) target: Option<Target>,
    pub(super) fixed: Vec<String>,
    pub(super) spp: Option<u32>,
    pub(super) noise: Option<f64>,
    pub(super) seeds: Vec<u64>,
    pub(super) axes: Vec<Axis>,
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
                let flags = [("spp", self.spp.is_some()), ("noise", self.noise.is_some())];
                for (flag, is_given) in flags {
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
            let problem = format!("has the seed {seed} twice");
            of_the_file(cx, "seeds", problem, "write each seed once");
        }
        let rows = self.axes.iter().map(|axis| axis.rows.len());
        let mut rows = rows.chain([self.seeds.len().max(1)]);
        let count = rows.try_fold(1, usize::checked_mul);
        if count.is_none_or(|count| count > MOST_TASKS) {
            let told = count.map_or_else(|| "more than 2⁶⁴".to_owned(), |count| count.to_string());
            let problem = format!("the sweep has {told} tasks, more than {MOST_TASKS}");
            let help =
                "take fewer values, or `[latin_hypercube]`, which covers many keys with few tasks";
            of_the_file(cx, "grid", problem, help);
        }
        if keys.is_empty() && self.seeds.is_empty() && cx.error_count() == 0 {
            let help = "add `[grid]`, `[list]`, `[latin_hypercube]`, `rows` or `seeds` to a sweep \
                        file, or give --over KEY=a,b,c or --seeds N";
            of_the_file(cx, "grid", "nothing is varied".to_owned(), help);
        }
    }

    /// The sweep, unless there are errors.
    pub(super) fn finish(self, cx: Context) -> Result<Sweep, DocumentErrors> {
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

/// Reports what is wrong with a sweep as a whole.
fn of_the_file(cx: &Context, key: &str, problem: String, help: &str) {
    cx.error_of_the_file(DocumentError::Impossible {
        key: key.to_owned(),
        problem,
        help: help.to_owned(),
    });
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
