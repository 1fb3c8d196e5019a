//! Tasks as commands, and the number that tells what a task makes.

use std::ops::Range;

use leafmodel::document::path::allowed;
use leafmodel::document::report::DocumentErrors;
use leafmodel::document::written::Extent;
use leafmodel::plan_file::leaf_to_toml;
use rayon::prelude::*;
use serde_json::json;

use crate::checkpoint::PROGRAM;
use crate::cli::arguments::{Arguments, CacheArguments, Command};
use crate::cli::grow;
use crate::cli::terminal::{Failure, colour};
use crate::scene::fingerprint::fnv1a;
use crate::scene::load::load;
use crate::sweep::{Refused, Sweep, Target, Task};

/// Tasks that are looked at between two looks at the errors: few at first, so that the first are
/// there at once.
const BATCHES: [usize; 2] = [32, 2048];

/// The words behind `lamina` that do a task, but for its outputs.
pub(super) fn words_of(sweep: &Sweep, task: &Task<'_>, cache: &CacheArguments) -> Vec<String> {
    let mut words = Vec::new();
    let mut add = |flag: &str, value: String| words.extend([flag.to_owned(), value]);
    let flag = match &sweep.target {
        Target::Scene(path) => {
            let whole = std::path::absolute(path).unwrap_or_else(|_| path.clone());
            add("render", whole.display().to_string());
            "-D"
        }
        Target::Leaf(leaf) => {
            let whole = std::path::absolute(leaf).ok();
            let file = whole.filter(|_| leaf.contains(['.', '/', '\\', '#']));
            add(
                "grow",
                file.map_or_else(|| leaf.clone(), |file| file.display().to_string()),
            );
            "--set"
        }
    };
    for folder in allowed() {
        add("--allow", folder.display().to_string());
    }
    for setting in &sweep.fixed {
        add("-D", setting.clone());
    }
    for setting in task.overrides() {
        add(flag, setting);
    }
    if let Some(seed) = task.seed {
        add("--seed", seed.to_string());
    }
    if let Target::Scene(_) = &sweep.target {
        if let Some(spp) = sweep.spp {
            add("--spp", spp.to_string());
        }
        if let Some(noise) = sweep.noise {
            add("--noise", noise.to_string());
        }
        words.extend(cache.words());
    }
    words
}

/// What a task makes, told by a number: everything that its outputs depend on, the version of the
/// program among it. For a scene that is its [fingerprint], samples, seed, noise and the picture's
/// tone; for a leaf its plan.
///
/// All tasks of the range are read, so that no error waits for its turn; `found` is called with the
/// number and the identity of each in order, until one is refused or it returns false.
pub(super) fn identities(
    sweep: &Sweep,
    range: Range<usize>,
    mut found: impl FnMut(usize, u64) -> bool,
) -> Result<(), Failure> {
    let mut refused = Refused::default();
    let [mut batch, most] = BATCHES;
    let mut start = range.start;
    while start < range.end {
        let numbers = start..(start + batch).min(range.end);
        (start, batch) = (numbers.end, (2 * batch).min(most));
        let read: Vec<(usize, Result<u64, Why>)> = numbers
            .into_par_iter()
            .map(|number| (number, identity(sweep, &sweep.task(number))))
            .collect();
        for (number, result) in read {
            match result {
                Ok(_) if !refused.is_empty() => {}
                Ok(identity) if found(number, identity) => {}
                Ok(_) => return Ok(()),
                Err(Why::Document(errors)) => refused.add(sweep, &sweep.task(number), &errors),
                Err(Why::Failure(failure)) => return Err(failure),
            }
        }
        if refused.is_enough() {
            break;
        }
    }
    if refused.is_empty() {
        Ok(())
    } else {
        Err(Failure::BadInput(refused.render(sweep, colour())))
    }
}

/// Why a task cannot be done.
enum Why {
    Document(DocumentErrors),
    Failure(Failure),
}

fn identity(sweep: &Sweep, task: &Task<'_>) -> Result<u64, Why> {
    let identity = match &sweep.target {
        Target::Scene(path) => {
            let overrides: Vec<String> = sweep
                .fixed
                .iter()
                .cloned()
                .chain(task.overrides())
                .collect();
            let loaded = load(path, &overrides).map_err(Why::Document)?;
            let print = loaded
                .fingerprint()
                .map_err(|error| Why::Failure(Failure::bad(error)))?;
            let scene = &loaded.description;
            let film = &scene.film;
            let noise = sweep.noise.or(film.noise).filter(|noise| *noise > 0.0);
            json!({
                "program": PROGRAM,
                "scene": scene.name,
                "fingerprint": print,
                "spp": sweep.spp.unwrap_or(film.spp),
                "seed": task.seed.unwrap_or(film.seed),
                "noise": noise,
                "picture": scene.picture,
            })
        }
        Target::Leaf(_) => {
            let mut line = vec!["lamina".to_owned()];
            line.extend(words_of(sweep, task, &CacheArguments::USUAL));
            let parsed = Arguments::of_line(line);
            let Ok(Some(Command::Grow(arguments))) = parsed.map(|parsed| parsed.command) else {
                return Err(Why::Failure(bad!(
                    "the leaf's name is no word of a command"
                )));
            };
            let (name, plan) =
                grow::named_plan((&arguments).into()).map_err(|error| match error {
                    grow::NotChosen::Document(errors) => Why::Document(errors),
                    grow::NotChosen::Failure(failure) => Why::Failure(failure),
                })?;
            json!({ "program": PROGRAM, "leaf": leaf_to_toml(&name, &plan, Extent::All) })
        }
    };
    Ok(fnv1a(identity.to_string().as_bytes()))
}
