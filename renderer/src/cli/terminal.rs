//! What a command reports to the person who runs it: results, warnings, notes, and why it failed.

use std::fmt::Display;
use std::io::{self, ErrorKind, IsTerminal, Write as _};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

use leafmodel::document::nearest::nearest;
use leafmodel::document::report::{DocumentErrors, SHOWN, Warning};
use leafmodel::document::source::printable;

/// Why a command failed.
#[derive(Debug)]
pub(super) enum Failure {
    /// An error in the input, which the user can mend.
    BadInput(String),
    /// The system failed: disk full, folder read-only, …
    System(String),
    /// Interrupted by a signal; finished samples are saved.
    Interrupted,
}

impl Failure {
    pub(super) fn bad(error: impl Display) -> Self {
        Self::BadInput(format!("error: {}\n", printable(&error.to_string())))
    }

    /// What an error is as a failure by the input file of that name.
    pub(super) fn at<E: Display>(path: &Path) -> impl Fn(E) -> Self {
        move |error| Self::bad(format_args!("{}: {error}", path.display()))
    }

    /// What an error is as a failure of the system with the file of that name.
    pub(super) fn system_at<E: Display>(path: &Path) -> impl Fn(E) -> Self {
        move |error| Self::system(format_args!("{}: {error}", path.display()))
    }

    pub(super) fn written_twice(path: &Path) -> Self {
        bad!(
            "{} is to be written twice: name another file",
            path.display()
        )
    }

    pub(super) fn system(error: impl Display) -> Self {
        Self::System(format!("error: {}\n", printable(&error.to_string())))
    }
}

impl From<DocumentErrors> for Failure {
    fn from(errors: DocumentErrors) -> Self {
        let report = errors.render(colour());
        Self::BadInput(format!("{report}\n"))
    }
}

/// Whether stderr is a terminal, which supports colours and overwriting a line.
pub(super) fn on_a_screen() -> bool {
    let is_dumb = std::env::var_os("TERM").is_some_and(|terminal| terminal == "dumb");
    io::stderr().is_terminal() && !is_dumb
}

/// Whether reports have colours: on a terminal, unless `NO_COLOR` is set (no-color.org).
pub(super) fn colour() -> bool {
    on_a_screen() && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty())
}

/// Writes a result, such as a path or a table, to stdout. If that fails, so does the command when
/// its work is done.
pub(super) fn say(text: impl Display) {
    if IS_QUIET.load(Ordering::Relaxed) {
        return;
    }
    note_output(writeln!(io::stdout(), "{text}"));
}

/// Whether results are for this program itself.
static IS_QUIET: AtomicBool = AtomicBool::new(false);

/// What a part of a command returns, which prints no results of its own.
pub(super) fn quietly<T>(work: impl FnOnce() -> T) -> T {
    IS_QUIET.store(true, Ordering::Relaxed);
    let found = work();
    IS_QUIET.store(false, Ordering::Relaxed);
    found
}

/// Why stdout could not be written, for the first time.
static OUTPUT_ERROR: Mutex<Option<io::Error>> = Mutex::new(None);

/// Whether the pipe that reads stdout was closed.
static HAS_NO_READER: AtomicBool = AtomicBool::new(false);

/// Whether nobody reads stdout any more, so that a long list may end.
pub(super) fn has_no_reader() -> bool {
    HAS_NO_READER.load(Ordering::Relaxed)
}

pub(super) fn note_output(result: io::Result<()>) {
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

pub(super) fn output_failure() -> Option<Failure> {
    let mut first = OUTPUT_ERROR.lock().unwrap_or_else(PoisonError::into_inner);
    let told = |error| Failure::system(format!("the results cannot be printed: {error}"));
    first.take().map(told)
}

/// Words about the known name that is nearest to a wrong one; nothing if none is near.
pub(super) fn did_you_mean<'a>(wrong: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    let near = nearest(wrong, known);
    near.map_or_else(String::new, |near| format!("; did you mean `{near}`?"))
}

/// Prints warnings.
pub(super) fn warn(warnings: &[Warning]) {
    let texts = warnings.iter().map(|warning| warning.render(colour()));
    eprint!("{}", listed("warning", texts));
}

/// Prints notes.
pub(super) fn note(notes: impl IntoIterator<Item = impl Display>) {
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
    use crate::scene::load;

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
