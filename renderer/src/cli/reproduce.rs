//! `lamina reproduce`: a result is computed again from its provenance, and compared.
//!
//! The file that is checked may come from anywhere. Its provenance gives values to options that are
//! known here to change numbers and nothing else. Every path is one that the person gave, or lies in
//! a folder for temporary files.

use std::collections::BTreeSet;
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};

use clap::builder::ValueParser;
use clap::{ArgMatches, Command as Line, CommandFactory};

use super::arguments::{Arguments, Command, ReproduceArguments};
use super::building::Building;
use super::needs::{self, on_threads};
use super::signals::Signals;
use super::terminal::{Failure, quietly, say};
use super::{fit, instruments, optics};
use crate::image::Picture;
use crate::image::atomic::folder_of;
use crate::integrator::caption::Caption;
use crate::integrator::develop::develop;
use crate::integrator::render::{Ended, Halt, Job, render_until};
use crate::provenance::deviation::Deviation;
use crate::provenance::{Contents, Hashes, Kept, Provenance, Settings, hash_of};
use crate::scene::fingerprint::hexadecimal;
use crate::scene::load;

/// The commands whose results are computed again as they are, and the options that name files of results.
const RESULTS: [(&str, &[&str]); 3] = [
    ("instruments", &["out"]),
    ("optics", &["out", "colour", "layers", "angles"]),
    ("fit", &["out", "spectra-out", "covariance-out"]),
];
/// The options of `render` that a picture's provenance has.
const OF_PICTURES: [&str; 3] = ["spp", "seed", "noise"];
/// Options on which no number depends.
const INCIDENTAL: [&str; 3] = ["threads", "memory", "time"];

/// The options of a command on which numbers depend: those that take a value which is no path.
fn determining(command: &Line) -> impl Iterator<Item = (&clap::Arg, &str)> {
    let path = ValueParser::path_buf().type_id();
    let options = command
        .get_arguments()
        .filter_map(|arg| Some((arg, arg.get_long()?)));
    options.filter(move |(arg, name)| {
        arg.get_action().takes_values()
            && arg.get_value_parser().type_id() != path
            && !INCIDENTAL.contains(name)
    })
}

/// What a command line gives to the options on which numbers depend, by itself or as defaults.
pub(super) fn settings(matches: &ArgMatches) -> Settings {
    let line = Arguments::command();
    let Some((name, matches)) = matches.subcommand() else {
        return Settings::new();
    };
    // Commands of commands and those without results have no place in files.
    let command = line.find_subcommand(name);
    let command = command.filter(|_| RESULTS.iter().any(|(result, _)| *result == name));
    let options = command.into_iter().flat_map(determining);
    let given = options.filter_map(|(arg, long)| {
        let values = matches.get_raw(arg.get_id().as_str())?;
        let values = values.map(|value| value.to_string_lossy().into_owned());
        Some((long.to_owned(), values.collect()))
    });
    given.collect()
}

pub(super) fn run(arguments: &ReproduceArguments) -> Result<(), Failure> {
    let file = &arguments.file;
    let kept = Kept::read(file).map_err(Failure::at(file))?;
    let own = &kept.provenance;
    let this = Provenance::of("", "", &Settings::new()).program();
    eprintln!(
        "{}: {} by version {} of Lamina; this is {this}",
        file.display(),
        own.result,
        own.program()
    );
    if !own.complete {
        bail_at!(
            file,
            "it ended early, or followed a map of samples: that cannot be repeated from its provenance"
        );
    }
    let again = on_threads(arguments.threads, || match &kept.contents {
        Contents::Picture(picture) => picture_again(arguments, own, picture).map(Contents::Picture),
        Contents::Json(_) => table_again(arguments, own, "json"),
        Contents::Table(_) => table_again(arguments, own, "csv"),
    })?;
    report(file, own, &Deviation::between(&kept.contents, &again))
}

/// Prints how far the two results are from each other, which is a failure unless they are equal.
fn report(file: &Path, own: &Provenance, found: &Deviation) -> Result<(), Failure> {
    let shown = file.display();
    if found.texts > 0 {
        eprintln!("note: {} texts differ, such as names", found.texts);
    }
    if found.is_none() {
        say(format_args!("{shown}: equal, {} numbers", found.numbers));
        return Ok(());
    }
    let this = crate::checkpoint::PROGRAM;
    let why = if own.version == this {
        String::new()
    } else {
        format!("; version {} wrote it, this is {this}", own.version)
    };
    let unlike = found.unlike.as_ref().map(|what| format!(", {what}"));
    let most = (found.different > 0).then(|| {
        format!(
            ", by up to {:.3e} of the value ({})",
            found.greatest, found.place
        )
    });
    Err(Failure::system(format_args!(
        "{shown}: {} of {} numbers differ{}{}{why}",
        found.different,
        found.numbers,
        most.unwrap_or_default(),
        unlike.unwrap_or_default()
    )))
}

fn damaged(what: impl std::fmt::Display) -> Failure {
    bad!("the provenance is damaged: {what}")
}

/// An option with its value, in one word so that no value becomes an option.
fn option_of(name: &str, value: impl AsRef<OsStr>) -> OsString {
    let mut word = OsString::from(format!("--{name}="));
    word.push(value);
    word
}

/// The command of such words, whose values are checked as those of a person are.
fn command_of(words: Vec<OsString>) -> Result<Command, Failure> {
    let parsed = Arguments::of_line(words).map_err(|error| {
        let text = error.to_string();
        let line = text.lines().next().unwrap_or_default();
        damaged(line.trim_start_matches("error: "))
    })?;
    parsed.command.ok_or_else(|| damaged("it names no command"))
}

/// The picture of the scene whose text another one holds.
fn picture_again(
    arguments: &ReproduceArguments,
    own: &Provenance,
    picture: &Picture,
) -> Result<Picture, Failure> {
    let signals = Signals::listen()?;
    let text = picture.text("lamina:scene").unwrap_or_default();
    let empty = tempfile::tempdir().map_err(Failure::system)?;
    let folder = arguments.scene.as_deref().map_or(empty.path(), folder_of);
    let loaded = load::parse(text, "lamina:scene", folder, &[]).inspect_err(|_| {
        if arguments.scene.is_none() {
            eprintln!("note: if its scene names files, --scene says where they are");
        }
    })?;
    let found = hexadecimal(loaded.fingerprint().map_err(Failure::bad)?);
    if own.scene.as_ref() != Some(&found) {
        let names: Vec<String> = loaded
            .files(folder)
            .map_err(Failure::bad)?
            .into_keys()
            .collect();
        bail_at!(
            arguments.file,
            "its scene is another one here: {} or a preset of another version has changed",
            if names.is_empty() {
                "its text".to_owned()
            } else {
                names.join(", ")
            }
        );
    }
    let scene = loaded.description;
    needs::check(&scene, None)?;
    let words = own
        .settings
        .iter()
        .filter(|(name, _)| OF_PICTURES.contains(&name.as_str()));
    let words =
        words.flat_map(|(name, values)| values.iter().map(move |value| option_of(name, value)));
    let words = ["lamina", "render", "scene.toml"]
        .map(OsString::from)
        .into_iter()
        .chain(words);
    let Command::Render(asked) = command_of(words.collect())? else {
        unreachable!("the line is one of render");
    };
    let (Some(spp), Some(seed)) = (asked.spp, asked.seed) else {
        return Err(damaged("it needs spp and seed"));
    };
    let film = &scene.film;
    let job = Job {
        width: film.width,
        height: film.height,
        spp,
        seed,
    };
    let halt = Halt {
        noise: asked.noise,
        time: None,
    };
    let world = Building::default().world(&scene)?;
    signals.begin_work();
    let rendered =
        render_until(&world, &job, &halt, &signals.stop, &|_| ()).map_err(Failure::bad)?;
    if rendered.ended == Ended::Interrupted {
        return Err(Failure::Interrupted);
    }
    let caption = Caption::of(&scene, &world.view, &world.light_colours);
    Ok(develop(&caption, &job, &rendered))
}

/// What the command of a table or of JSON writes this time.
fn table_again(
    arguments: &ReproduceArguments,
    own: &Provenance,
    ending: &str,
) -> Result<Contents, Failure> {
    let (result, option) = (own.result.as_str(), own.option.as_str());
    let known = RESULTS.into_iter().find(|(name, _)| *name == result);
    let Some((_, true)) = known.map(|(name, options)| (name, options.contains(&option))) else {
        return Err(damaged(format_args!(
            "there is no result `{result}` of an option `{option}`"
        )));
    };
    let folder = tempfile::tempdir().map_err(Failure::system)?;
    let again = folder.path().join(format!("again.{ending}"));
    let mut words: Vec<OsString> = ["lamina", result].map(OsString::from).to_vec();
    let line = Arguments::command();
    let command = line
        .find_subcommand(result)
        .expect("results are of commands");
    let determining: BTreeSet<&str> = determining(command).map(|(_, name)| name).collect();
    for (name, values) in &own.settings {
        if !determining.contains(name.as_str()) {
            return Err(damaged(format_args!(
                "`{name}` is no option of {result} that counts"
            )));
        }
        words.extend(values.iter().map(|value| option_of(name, value)));
    }
    words.push(option_of(option, &again));
    let mut last: Vec<OsString> = Vec::new();
    if result == "instruments" {
        last.push(scene_of(arguments, own)?.into());
    } else {
        for (role, input) in inputs_of(arguments, own)? {
            match role.as_str() {
                "spectra" => last.push(input.into()),
                "table" | "adaxial" | "abaxial" | "transmittance" => {
                    words.push(option_of(&role, input));
                }
                _ => return Err(damaged(format_args!("no command reads a file as `{role}`"))),
            }
        }
    }
    for setting in &own.overrides {
        words.push(format!("-D{setting}").into());
    }
    words.extend(
        arguments
            .threads
            .filter(|_| result == "instruments")
            .map(|threads| OsString::from(format!("--threads={threads}"))),
    );
    if !last.is_empty() {
        words.push("--".into());
        words.append(&mut last);
    }
    let command = command_of(words)?;
    quietly(|| {
        if let Command::Instruments(again) = &command {
            instruments::run(again, &own.settings)
        } else if let Command::Optics(again) = &command {
            optics::run(again, &own.settings)
        } else if let Command::Fit(again) = &command {
            fit::run(again, &own.settings)
        } else {
            unreachable!("the command is one of those with results")
        }
    })?;
    let again = Kept::read(&again).map_err(Failure::system)?;
    Ok(again.contents)
}

/// The scene that was given, if it is the one of the result.
fn scene_of<'a>(arguments: &'a ReproduceArguments, own: &Provenance) -> Result<&'a Path, Failure> {
    let file = &arguments.file;
    let Some(scene) = &arguments.scene else {
        bail_at!(
            file,
            "--scene SCENE.toml is needed: the scene whose instruments were read out"
        );
    };
    let loaded = load::load_for_instruments(scene, &own.overrides)?;
    let files = loaded.files(folder_of(scene)).map_err(Failure::bad)?;
    let found = hexadecimal(loaded.fingerprint().map_err(Failure::bad)?);
    if own.scene.as_ref() == Some(&found) {
        return Ok(scene);
    }
    let names = own
        .files
        .keys()
        .chain(files.keys())
        .collect::<BTreeSet<_>>();
    let changed = names
        .into_iter()
        .filter(|name| own.files.get(*name) != files.get(*name));
    let changed: Vec<&str> = changed.map(String::as_str).collect();
    let what = if changed.is_empty() {
        format!(
            "{} itself, or a preset of another version, has changed",
            scene.display()
        )
    } else {
        format!("{} has changed", changed.join(", "))
    };
    Err(bad_at!(file, "it is of another state of the scene: {what}"))
}

/// The inputs that were given, each with the option that had named it.
fn inputs_of(
    arguments: &ReproduceArguments,
    own: &Provenance,
) -> Result<Vec<(String, PathBuf)>, Failure> {
    let file = &arguments.file;
    let mut open: Hashes = own.files.clone();
    let mut found = Vec::new();
    if open.values().any(String::is_empty) {
        bail_at!(
            file,
            "its input came from a pipe, so that nothing says what that was"
        );
    }
    for input in &arguments.input {
        let hash = hash_of(input);
        let role = open
            .iter()
            .find(|(_, known)| **known == hash)
            .map(|(role, _)| role.clone());
        let Some(role) = role else {
            let open: Vec<&str> = open.keys().map(String::as_str).collect();
            bail_at!(
                input,
                "it is none of the files that {} was computed from, or has changed since; missing: {}",
                file.display(),
                open.join(", ")
            );
        };
        open.remove(&role);
        found.push((role, input.clone()));
    }
    if let Some((role, hash)) = open.first_key_value() {
        bail_at!(
            file,
            "--input FILE is needed: the file of `{role}`, whose hash is {hash}"
        );
    }
    Ok(found)
}
