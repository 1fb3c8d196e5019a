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
mod texts;
mod tonemap;
mod trace;

use std::ffi::OsString;
use std::io::{self, ErrorKind, IsTerminal, Write as _};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

use clap::{CommandFactory, FromArgMatches};

use crate::scene::load::{self, Loaded};
use arguments::{Arguments, Command, ExportCommand, GREETING, SceneArguments};
use leafmodel::document::nearest::nearest;
use leafmodel::document::path;
use leafmodel::document::report::{DocumentErrors, SHOWN, Warning};
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
        .try_get_matches_from(Arguments::joined(line.iter().cloned()));
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

/// Whether the pipe that reads stdout was closed.
static HAS_NO_READER: AtomicBool = AtomicBool::new(false);

/// Whether nobody reads stdout any more, so that a long list may end.
fn has_no_reader() -> bool {
    HAS_NO_READER.load(Ordering::Relaxed)
}

fn note_output(result: io::Result<()>) {
    if let Err(error) = result.and_then(|()| io::stdout().flush()) {
        // A pipe that is closed early (`lamina info x.exr | head`) is not an error.
        if error.kind() == ErrorKind::BrokenPipe {
            HAS_NO_READER.store(true, Ordering::Relaxed);
            return;
        }
        let mut first = OUTPUT_ERROR.lock().unwrap_or_else(PoisonError::into_inner);
        first.get_or_insert(error);
    }
}

fn output_failure() -> Option<Failure> {
    let mut first = OUTPUT_ERROR.lock().unwrap_or_else(PoisonError::into_inner);
    let told = |error| Failure::system(format!("the results cannot be printed: {error}"));
    first.take().map(told)
}

/// Does work on so many threads; without a number on one for each processor.
fn on_threads<T: Send>(
    threads: Option<u16>,
    work: impl FnOnce() -> Result<T, Failure> + Send,
) -> Result<T, Failure> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.map_or(0, usize::from));
    pool.build().map_err(Failure::system)?.install(work)
}

/// Words about the known name that is nearest to a wrong one; nothing if none is near.
fn did_you_mean<'a>(wrong: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    let near = nearest(wrong, known);
    near.map_or_else(String::new, |near| format!("; did you mean `{near}`?"))
}

/// Loads a scene and prints its warnings.
fn load_scene(arguments: &SceneArguments) -> Result<Loaded, Failure> {
    let loaded = load::load(&arguments.scene, &arguments.overrides)?;
    warn(&loaded.warnings);
    Ok(loaded)
}

/// Prints warnings.
fn warn(warnings: &[Warning]) {
    let texts = warnings.iter().map(|warning| warning.render(colour()));
    eprint!("{}", listed("warning", texts));
}

/// Prints notes.
fn note(notes: impl IntoIterator<Item = impl std::fmt::Display>) {
    let lines = notes.into_iter().map(|note| format!("note: {note}"));
    eprint!("{}", listed("note", lines));
}

/// Texts of a kind, each on lines of its own; of many the first ones, and how many more there are.
fn listed(kind: &str, texts: impl Iterator<Item = String>) -> String {
    let mut texts = texts.fuse();
    let mut listed: String = texts.by_ref().take(SHOWN).map(|text| text + "\n").collect();
    match texts.count() {
        0 => {}
        1 => listed += &format!("… and 1 more {kind}\n"),
        more => listed += &format!("… and {more} more {kind}s\n"),
    }
    listed
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_warning_ends_its_line() {
        let scene = "format = 1\n[film.rgb]\nsize = [2, 2]\nspp = 1\n[camera.perspective]\n\
            position_m = [0, 1, 0]\nlook_at_m = [0, 0, 0]\nvertical_fov_deg = 40\n\
            [lights.sky.constant]\nradiance_w_m2_sr_nm = 1\n[meshes.dot.sphere]\nradius_m = 0.1\n\
            [materials.used.diffuse]\nreflectance = 0\n[materials.one.diffuse]\nreflectance = 0\n\
            [materials.two.diffuse]\nreflectance = 0\n[objects.dot]\nmesh = \"dot\"\nmaterial = \"used\"\n";
        let loaded = load::parse(scene, "scene.toml", Path::new("."), &[]);
        let loaded = loaded.unwrap_or_else(|errors| panic!("{errors}"));
        assert_eq!(loaded.warnings.len(), 2);
        let texts = loaded.warnings.iter().map(|warning| warning.render(false));
        let text = listed("warning", texts);
        let first: Vec<&str> = text
            .lines()
            .filter(|line| line.contains("warning"))
            .collect();
        assert_eq!(first.len(), 2, "{text}");
        assert!(
            first.iter().all(|line| line.starts_with("warning[")),
            "{text}"
        );
        assert!(text.ends_with('\n'), "{text}");
    }

    #[test]
    fn of_many_notes_the_first_are_listed_and_the_others_counted() {
        let texts = |count: usize| listed("note", (0..count).map(|number| format!("{number}")));
        assert_eq!(texts(2), "0\n1\n");
        assert!(texts(SHOWN).ends_with("98\n99\n"));
        assert!(texts(SHOWN + 1).ends_with("99\n… and 1 more note\n"));
        assert_eq!(texts(100_000).lines().count(), SHOWN + 1);
        assert!(texts(100_000).ends_with("… and 99900 more notes\n"));
    }
}
