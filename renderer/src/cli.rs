//! The `lamina` command: parse, call the library, print reports.
//!
//! stdout carries the paths of written files and requested tables, stderr all messages. Exit codes:
//! 0 done, 1 failure of the system, 2 bad input, 130 interrupted with the work saved.
//!
//! ```
//! use std::process::ExitCode;
//!
//! let command = ["lamina", "check", "no-such-scene.toml"].map(Into::into);
//! assert_eq!(renderer::cli::run(command), ExitCode::from(2));
//! ```

pub mod arguments;
mod check;
mod columns;
mod export;
mod grow;
mod interrupt;
mod optics;
mod pictures;
mod progress;
mod render;
mod schema;
mod stats;

use std::ffi::OsString;
use std::io::{IsTerminal, Write as _};
use std::path::Path;
use std::process::ExitCode;

use clap::Parser;

use crate::scene::load::{self, Loaded};
use arguments::{Arguments, Command, ExportCommand, GREETING, SceneArguments};
use leafmodel::document::report::DocumentErrors;

/// Why a command failed.
#[derive(Debug)]
enum Failure {
    /// An error in the input, which the user can mend.
    BadInput(String),
    /// The system failed: disk full, folder read-only, …
    System(String),
    /// Interrupted by Ctrl-C; finished samples are saved.
    Interrupted,
}

impl Failure {
    fn bad(error: impl std::fmt::Display) -> Self {
        Self::BadInput(format!("error: {error}\n"))
    }

    fn written_twice(path: &Path) -> Self {
        let path = path.display();
        Self::bad(format!("{path} is to be written twice: name another file"))
    }

    fn system(error: impl std::fmt::Display) -> Self {
        Self::System(format!("error: {error}\n"))
    }
}

impl From<DocumentErrors> for Failure {
    fn from(errors: DocumentErrors) -> Self {
        let report = errors.render(colour());
        Self::BadInput(format!("{report}\n"))
    }
}

/// Runs the command line `arguments` (the program's name first) and returns the exit code.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    let arguments = match Arguments::try_parse_from(arguments) {
        Ok(arguments) => arguments,
        Err(error) => {
            // Help and version are requests, not errors; clap chooses the stream for each.
            let code = if error.use_stderr() { 2 } else { 0 };
            let _ = error.print();
            return ExitCode::from(code);
        }
    };
    let Some(command) = arguments.command else {
        say(GREETING);
        return ExitCode::SUCCESS;
    };
    let result = match &command {
        Command::Render(render) => render::run(render),
        Command::Check(scene) => check::run(scene),
        Command::Optics(optics) => optics::run(optics),
        Command::Export(ExportCommand::Mitsuba(mitsuba)) => export::run(mitsuba),
        Command::Compare(compare) => pictures::compare(compare),
        Command::Info(info) => pictures::info(info),
        Command::Grow(grow) => grow::run(grow),
        Command::Schema(schema) => schema::run(schema),
    };
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

/// Writes a result, such as a path or a table, to stdout.
fn say(text: impl std::fmt::Display) {
    // A pipe that is closed early (`lamina info x.exr | head`) is not an error.
    let _ = writeln!(std::io::stdout(), "{text}");
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

/// Fails if `path` could not be written, before any work is done.
fn check_writable(path: &Path) -> Result<(), Failure> {
    if path.is_dir() {
        return Err(Failure::bad(format!(
            "{} is a folder: name a file",
            path.display()
        )));
    }
    let folder = path
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty());
    let folder = folder.unwrap_or(Path::new("."));
    if !folder.is_dir() {
        return Err(Failure::bad(format!(
            "the folder {} of {} does not exist: make it or write somewhere else",
            folder.display(),
            path.display()
        )));
    }
    tempfile::NamedTempFile::new_in(folder).map_err(|error| {
        Failure::system(format!(
            "nothing can be written into {}: {error}",
            folder.display()
        ))
    })?;
    Ok(())
}
