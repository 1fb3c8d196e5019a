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

pub mod arguments;
mod check;
mod check_bsdf;
mod columns;
mod compare_networks;
mod example;
mod export;
mod fit;
mod fit_veins;
mod grow;
mod instruments;
mod licenses;
mod measure;
mod merge;
mod needs;
mod optics;
mod picture_files;
mod pictures;
mod places;
mod progress;
mod render;
mod schema;
mod shell;
mod signals;
mod stats;
mod sweep;
mod tonemap;
mod trace;

use std::ffi::OsString;
use std::io::{self, ErrorKind, IsTerminal, Write as _};
use std::path::Path;
use std::process::ExitCode;
use std::sync::{Mutex, PoisonError};

use clap::{CommandFactory, FromArgMatches};

use crate::scene::load::{self, Loaded};
use arguments::{Arguments, Command, ExportCommand, GREETING, SceneArguments};
use leafmodel::document::report::DocumentErrors;
use leafmodel::document::source::printable;
use places::check_writable;

/// Why a command failed.
#[derive(Debug)]
enum Failure {
    /// An error in the input, which the user can mend.
    BadInput(String),
    /// The system failed: disk full, folder read-only, …
    System(String),
    /// Interrupted by a signal; finished samples are saved.
    Interrupted,
}

impl Failure {
    fn bad(error: impl std::fmt::Display) -> Self {
        Self::BadInput(format!("error: {}\n", printable(&error.to_string())))
    }

    fn written_twice(path: &Path) -> Self {
        let path = path.display();
        Self::bad(format!("{path} is to be written twice: name another file"))
    }

    fn system(error: impl std::fmt::Display) -> Self {
        Self::System(format!("error: {}\n", printable(&error.to_string())))
    }
}

impl From<DocumentErrors> for Failure {
    fn from(errors: DocumentErrors) -> Self {
        let report = errors.render(colour());
        Self::BadInput(format!("{report}\n"))
    }
}

/// Runs the command line `arguments` (the program's name first) and returns the exit code.
/// `version` is what `--version` prints: the package's version and, of a checkout, the commit.
pub fn run(arguments: impl IntoIterator<Item = OsString>, version: &'static str) -> ExitCode {
    signals::survive_file_limits();
    let line: Vec<OsString> = arguments.into_iter().collect();
    let matches = Arguments::command()
        .version(version)
        .try_get_matches_from(&line);
    let arguments = match matches.and_then(|matches| Arguments::from_arg_matches(&matches)) {
        Ok(arguments) => arguments,
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
    let Some(command) = arguments.command else {
        say(GREETING);
        return exit_code(Ok(()));
    };
    exit_code(match &command {
        Command::Render(render) => render::run(render, &line),
        Command::Merge(merge) => merge::run(merge),
        Command::Check(scene) => check::run(scene),
        Command::Tonemap(tonemap) => tonemap::run(tonemap),
        Command::Optics(optics) => optics::run(optics),
        Command::Fit(fit) => fit::run(fit),
        Command::CheckBsdf(table) => check_bsdf::run(table),
        Command::Instruments(instruments) => instruments::run(instruments),
        Command::Export(ExportCommand::Mitsuba(mitsuba)) => export::run(mitsuba),
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
        Command::Licenses => {
            licenses::run();
            Ok(())
        }
    })
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

/// Whether stderr is a terminal, which supports colours and overwriting a line.
fn on_a_screen() -> bool {
    let is_dumb = std::env::var_os("TERM").is_some_and(|terminal| terminal == "dumb");
    std::io::stderr().is_terminal() && !is_dumb
}

/// Whether reports have colours: on a terminal, unless `NO_COLOR` is set (no-color.org).
fn colour() -> bool {
    on_a_screen() && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty())
}

/// Writes a result, such as a path or a table, to stdout. If that fails, so does the command when
/// its work is done.
fn say(text: impl std::fmt::Display) {
    note_output(writeln!(io::stdout(), "{text}"));
}

/// Why stdout could not be written, for the first time.
static OUTPUT_ERROR: Mutex<Option<io::Error>> = Mutex::new(None);

fn note_output(result: io::Result<()>) {
    // A pipe that is closed early (`lamina info x.exr | head`) is not an error.
    if let Err(error) = result.and_then(|()| io::stdout().flush())
        && error.kind() != ErrorKind::BrokenPipe
    {
        let mut first = OUTPUT_ERROR.lock().unwrap_or_else(PoisonError::into_inner);
        first.get_or_insert(error);
    }
}

fn output_failure() -> Option<Failure> {
    let mut first = OUTPUT_ERROR.lock().unwrap_or_else(PoisonError::into_inner);
    let told = |error| Failure::system(format!("the results cannot be printed: {error}"));
    first.take().map(told)
}

/// Loads a scene and prints its warnings.
fn load_scene(arguments: &SceneArguments) -> Result<Loaded, Failure> {
    let loaded = load::load(&arguments.scene, &arguments.overrides)?;
    let colour = colour();
    for warning in &loaded.warnings {
        eprint!("{}", warning.render(colour));
    }
    Ok(loaded)
}
