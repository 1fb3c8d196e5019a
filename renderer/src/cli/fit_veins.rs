//! `lamina fit-veins`: parameters of growth that bring forth the measures of a given leaf.

mod free;
mod observed;
mod simulations;

use leafmodel::inference::{FitError, Problem, Role, fit};
use serde_json::json;

use self::free::Grower;
use self::observed::Observed;
use self::simulations::Simulations;
use crate::checkpoint::PROGRAM;
use crate::cli::arguments::FitVeinsArguments;
use crate::cli::needs::on_threads;
use crate::cli::places::{Lock, check_writable, write_json, write_whole};
use crate::cli::signals::Signals;
use crate::cli::terminal::{Failure, note, say};
use crate::report::vein_fit;
use crate::scene::fingerprint::fnv1a;

pub(super) fn run(arguments: &FitVeinsArguments) -> Result<(), Failure> {
    let observed = Observed::read(arguments)?;
    let grower = Grower::new(arguments)?;
    let problem = Problem::new(
        grower.parameters().to_vec(),
        observed.list.clone(),
        arguments.simulations as usize,
        arguments.seed,
    );
    let problem = problem.map_err(Failure::bad)?;
    note(observed.notes.iter().chain(&grower.notes(&observed)));
    let folder = arguments.out.as_path();
    let refused = Failure::system_at(folder);
    std::fs::create_dir_all(folder).map_err(refused)?;
    let [json, sample, picture, table] =
        ["fit.json", "posterior.csv", "fit.svg", "simulations.csv"].map(|name| folder.join(name));
    for path in [&json, &sample, &picture, &table] {
        check_writable(path)?;
    }
    let signals = Signals::listen()?;
    let _lock = Lock::take(&json, &signals)?;
    let parameters = problem.parameters().iter();
    let parameters = parameters.map(|one| json!([one.name(), one.range(), one.is_whole()]));
    let observed = problem.observed().iter();
    let observed = observed.map(|one| json!([one.key, one.value, one.role == Role::HeldOut]));
    let identity = json!({
        "program": PROGRAM,
        "leaf": grower.file(),
        "memory": arguments.memory,
        "parameters": parameters.collect::<Vec<_>>(),
        "observed": observed.collect::<Vec<_>>(),
        "simulations": problem.simulations(),
        "seed": problem.seed(),
    });
    let identity = fnv1a(identity.to_string().as_bytes());
    let simulations = Simulations::open(&table, identity, &problem)?;
    signals.begin_work();
    let work = || {
        fit(&problem, |draws| {
            simulations.carry_out(draws, &grower, &signals)
        })
    };
    let found = match on_threads(arguments.threads, || Ok(work()))? {
        Ok(found) => found,
        Err(FitError::Stopped(failure)) => return Err(failure),
        Err(error @ (FitError::TooFew { .. } | FitError::NothingVaries)) => {
            simulations.save()?;
            return Err(Failure::bad(reason(&error)));
        }
    };
    simulations.save()?;
    write_whole(&sample, vein_fit::sample(&problem, &found))?;
    let mut report = vein_fit::json(&problem, &found);
    report["leaf"] = grower.name().into();
    report["measures"] = arguments.measures.display().to_string().into();
    let settings = arguments.set.iter().chain(&arguments.overrides);
    report["settings"] = settings.map(String::as_str).collect();
    write_json(&json, &report)?;
    write_whole(&picture, vein_fit::marginals(&problem, &found))?;
    eprint!("{}", vein_fit::table(&found));
    for path in [&json, &sample, &picture, &table] {
        say(path.display());
    }
    Ok(())
}

/// Why there is no fit, in words.
fn reason(error: &FitError<Failure>) -> String {
    match error {
        FitError::Stopped(_) => String::new(),
        FitError::NothingVaries => {
            "no measure that is fitted changes when the free keys or the seed do".to_owned()
        }
        FitError::TooFew {
            usable,
            needed,
            all,
            failed,
            first_failure,
            missing,
        } => {
            let mut text = format!(
                "only {usable} of {all} leaves can be compared with the one that was measured, \
                 fewer than {needed}"
            );
            if *failed > 0 {
                let first = first_failure.as_deref().unwrap_or_default();
                text += &format!("; {failed} failed, the first one: {first}");
            }
            if let Some((key, count)) = missing {
                text += &format!("; {count} have nothing to measure for `{key}`");
            }
            text + ": let --free begin and end nearer to the leaf, or name other measures by --fit"
        }
    }
}
