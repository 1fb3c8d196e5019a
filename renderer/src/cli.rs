//! The `lamina` command: parse, call the library, print reports.
//!
//! stdout carries the paths of written files and requested tables, stderr all messages. Exit codes:
//! 0 done, 1 failure of the system, 2 bad input, 130 interrupted with the work saved.
//!
//! ```
//! use std::process::ExitCode;
//!
//! let command = ["lamina", "check", "no-such-scene.toml"].map(Into::into);
//! assert_eq!(renderer::cli::run(command, "0.1.0"), ExitCode::from(2));
//! ```

// These take the place of the standard ones in this module and below: a render must not end because
// nobody reads its messages any more.

/// Prints a message to stderr; one that cannot be printed is lost.
macro_rules! eprint {
    ($($message:tt)*) => {{
        use std::io::Write as _;
        let _ = write!(std::io::stderr(), $($message)*);
    }};
}
/// Prints a line to stderr; one that cannot be printed is lost.
macro_rules! eprintln {
    ($($message:tt)*) => {{
        use std::io::Write as _;
        let _ = writeln!(std::io::stderr(), $($message)*);
    }};
}

/// A failure by an input that the user can correct, from the format and the arguments of a message.
macro_rules! bad {
    ($($message:tt)*) => {
        $crate::cli::terminal::Failure::bad(format_args!($($message)*))
    };
}
/// Ends a command with the failure that `bad!` makes.
macro_rules! bail {
    ($($message:tt)*) => {
        return Err(bad!($($message)*))
    };
}
/// The same for a message about a file, which begins with its name.
macro_rules! bad_at {
    ($path:expr, $($message:tt)*) => {
        bad!("{}: {}", $path.display(), format_args!($($message)*))
    };
}
/// Ends a command with the failure that `bad_at!` makes.
macro_rules! bail_at {
    ($path:expr, $($message:tt)*) => {
        return Err(bad_at!($path, $($message)*))
    };
}

pub mod arguments;
mod building;
mod cache;
mod check;
mod check_bsdf;
mod compare_networks;
mod example;
mod export;
mod fit;
mod fit_veins;
mod grow;
mod instruments;
mod measure;
mod merge;
mod model;
mod needs;
mod optics;
mod picture_files;
mod pictures;
mod places;
mod progress;
mod render;
mod reproduce;
mod schema;
mod shell;
mod signals;
mod sweep;
mod terminal;
mod texts;
mod trace;

use std::ffi::OsString;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{CommandFactory, FromArgMatches};
use leafmodel::document::path;

use self::arguments::{Arguments, Command, ExportCommand, GREETING};
use self::terminal::{Failure, note_output, output_failure, say};
use crate::provenance;

/// Runs the command line `arguments` (the program's name first) and returns the exit code.
/// `version` is what `--version` prints: the package's version and, of a checkout, the commit.
pub fn run(arguments: impl IntoIterator<Item = OsString>, version: &'static str) -> ExitCode {
    signals::survive_file_limits();
    provenance::note_build(version);
    let line: Vec<OsString> = arguments.into_iter().collect();
    let matches = Arguments::command()
        .version(version)
        .try_get_matches_from(Arguments::joined(line.iter().cloned()));
    let parsed = matches.and_then(|matches| {
        let settings = reproduce::settings(&matches);
        Arguments::from_arg_matches(&matches).map(|arguments| (arguments, settings))
    });
    let (arguments, settings) = match parsed {
        Ok(parsed) => parsed,
        Err(error) => {
            // Help and version are requests, not errors; clap chooses the stream for each.
            let code = if error.use_stderr() { 2 } else { 0 };
            note_output(error.print());
            return if output_failure().is_some() {
                ExitCode::from(1)
            } else {
                ExitCode::from(code)
            };
        }
    };
    if arguments.end_with_stdin {
        signals::end_with_stdin();
    }
    if let Err(failure) = allow(&arguments.allow) {
        return exit_code(Err(failure));
    }
    let Some(command) = arguments.command else {
        say(GREETING);
        return exit_code(Ok(()));
    };
    exit_code(match &command {
        Command::Render(render) => render::run(render, &line),
        Command::Merge(merge) => merge::run(merge),
        Command::Check(scene) => check::run(scene),
        Command::Tonemap(tonemap) => pictures::tonemap(tonemap),
        Command::Optics(optics) => optics::run(optics, &settings),
        Command::Fit(fit) => fit::run(fit, &settings),
        Command::CheckBsdf(table) => check_bsdf::run(table),
        Command::Instruments(instruments) => instruments::run(instruments, &settings),
        Command::Reproduce(result) => reproduce::run(result),
        Command::Export(ExportCommand::Gltf(gltf)) => export::gltf(gltf),
        Command::Export(ExportCommand::Mitsuba(mitsuba)) => export::mitsuba(mitsuba),
        Command::Compare(compare) => pictures::compare(compare),
        Command::Info(info) => pictures::info(info),
        Command::Grow(grow) => grow::run(grow),
        Command::Measure(measure) => measure::run(measure),
        Command::CompareNetworks(compare) => compare_networks::run(compare),
        Command::Trace(picture) => trace::run(picture),
        Command::Example(example) => example::run(example),
        Command::Schema(schema) => schema::run(schema),
        Command::Sweep(sweep) => sweep::run(sweep),
        Command::FitVeins(fit) => fit_veins::run(fit),
        Command::Completions(shell) => {
            shell::completions(shell);
            Ok(())
        }
        Command::Man(man) => shell::man(man),
        Command::Cache(cache) => cache::run(cache),
        Command::Licenses => {
            shell::licenses();
            Ok(())
        }
    })
}

/// Lets documents name files in the folders that the command line and the environment name.
fn allow(folders: &[PathBuf]) -> Result<(), Failure> {
    let listed = std::env::var_os("LAMINA_ALLOW").unwrap_or_default();
    let listed = std::env::split_paths(&listed).filter(|folder| !folder.as_os_str().is_empty());
    let mut all: Vec<PathBuf> = Vec::new();
    for (by, folder) in folders
        .iter()
        .map(|folder| ("--allow", folder.clone()))
        .chain(listed.map(|folder| ("LAMINA_ALLOW", folder)))
    {
        let whole = std::fs::canonicalize(&folder);
        let is_folder = whole.as_ref().is_ok_and(|whole| whole.is_dir());
        match whole {
            Ok(whole) if is_folder => all.push(whole),
            Ok(_) => {
                return Err(Failure::bad(format!(
                    "{by}: {} is not a folder",
                    folder.display()
                )));
            }
            Err(error) => return Err(Failure::bad(format!("{by}: {}: {error}", folder.display()))),
        }
    }
    path::allow(all);
    Ok(())
}

/// Prints why a command failed; the exit code.
fn exit_code(result: Result<(), Failure>) -> ExitCode {
    let result = result.and_then(|()| output_failure().map_or(Ok(()), Err));
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(Failure::BadInput(message)) => {
            eprint!("{message}");
            ExitCode::from(2)
        }
        Err(Failure::System(message)) => {
            eprint!("{message}");
            ExitCode::from(1)
        }
        Err(Failure::Interrupted) => ExitCode::from(130),
    }
}
