//! Where outputs go: checked before any work is done, and kept from other programs.

use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::time::Duration;

use serde_json::Value;

use crate::checkpoint::PROGRAM;
use crate::cli::signals::Signals;
use crate::cli::terminal::{Failure, say};
use crate::image::atomic::{self, Destination, destination, folder_of};

/// Fails if `path` could not be written, before any work is done. Half files of programs that were
/// killed are removed from its folder.
pub(super) fn check_writable(path: &Path) -> Result<(), Failure> {
    let shown = path.display();
    if path.is_dir() {
        bail!("{shown} is a folder: name a file");
    }
    let refused = |error: std::io::Error| Failure::system(format!("{shown}: {error}"));
    let path = match destination(path).map_err(refused)? {
        Destination::File(path) => path,
        Destination::Stream => return check_stream(path).map_err(refused),
    };
    let folder = folder_of(&path);
    if !folder.is_dir() {
        bail!(
            "the folder {} of {shown} does not exist: make it or write somewhere else",
            folder.display(),
        );
    }
    atomic::sweep(folder);
    // A file without a name: a program that is killed here leaves none behind.
    tempfile::tempfile_in(folder).map_err(|error| {
        Failure::system(format!(
            "nothing can be written into {}: {error}",
            folder.display()
        ))
    })?;
    Ok(())
}

/// Whether a device or a pipe may be written to. It is not opened: opening a pipe waits for a
/// reader.
fn check_stream(path: &Path) -> std::io::Result<()> {
    #[cfg(unix)]
    rustix::fs::access(path, rustix::fs::Access::WRITE_OK)?;
    #[cfg(not(unix))]
    let _ = path;
    Ok(())
}

/// As [`check_writable`] for all outputs of a command; none may be one of the inputs, which `reader`
/// reads, or be written twice.
pub(super) fn check_outputs<'a, P: AsRef<Path> + ?Sized + 'a>(
    outputs: impl IntoIterator<Item = &'a P>,
    inputs: &[PathBuf],
    reader: &str,
) -> Result<(), Failure> {
    let inputs: Vec<_> = inputs
        .iter()
        .map(|file| fs::canonicalize(file).unwrap_or_else(|_| file.clone()))
        .collect();
    let mut seen: BTreeMap<PathBuf, &Path> = BTreeMap::new();
    for output in outputs.into_iter().map(AsRef::as_ref) {
        check_writable(output)?;
        let Some(place) = place_of(output) else {
            continue;
        };
        if inputs.contains(&place) {
            bail!(
                "{} is a file that {reader} reads: name another output",
                output.display()
            );
        }
        if let Some(other) = seen.insert(place, output) {
            return Err(if other == output {
                Failure::written_twice(output)
            } else {
                let (one, other) = (output.display(), other.display());
                bad!("{one} and {other} are one file: name another")
            });
        }
    }
    Ok(())
}

/// Whether a file has an ending, in letters of any size.
pub(super) fn has_ending(path: &Path, ending: &str) -> bool {
    path.extension()
        .is_some_and(|given| given.eq_ignore_ascii_case(ending))
}

/// Fails if a file, where there is one, has another ending than what is written into it.
pub(super) fn require_ending<'a, P: AsRef<Path> + ?Sized + 'a>(
    file: impl IntoIterator<Item = &'a P>,
    ending: &str,
    what: &str,
) -> Result<(), Failure> {
    let mut files = file.into_iter().map(AsRef::as_ref);
    match files.find(|path| !has_ending(path, ending)) {
        None => Ok(()),
        Some(path) => Err(bad_at!(path, "{what}: let its name end in .{ending}")),
    }
}

/// Whether the ending of an output asks for JSON, not for CSV as without one; others are refused.
pub(super) fn is_json_not_csv(out: Option<&Path>) -> Result<bool, Failure> {
    match out {
        Some(path) if has_ending(path, "json") => Ok(true),
        Some(path) if !has_ending(path, "csv") => Err(bad_at!(
            path,
            "--out writes tables: let its name end in .csv or .json"
        )),
        Some(_) | None => Ok(false),
    }
}

/// Writes a file whole or not at all.
pub(super) fn write_whole(path: &Path, bytes: impl AsRef<[u8]>) -> Result<(), Failure> {
    atomic::replace(path, |file| file.write_all(bytes.as_ref())).map_err(Failure::system)
}

/// As [`write_whole`], and prints the path.
pub(super) fn write_and_say(path: &Path, bytes: impl AsRef<[u8]>) -> Result<(), Failure> {
    write_whole(path, bytes)?;
    say(path.display());
    Ok(())
}

/// The one path of a file that may not exist yet; `None` for devices and pipes.
fn place_of(path: &Path) -> Option<PathBuf> {
    let Ok(Destination::File(path)) = destination(path) else {
        return None;
    };
    let folder = fs::canonicalize(folder_of(&path)).ok()?;
    Some(folder.join(path.file_name()?))
}

/// An output that no other program writes as long as this lives.
#[derive(Debug)]
pub(super) struct Lock {
    path: PathBuf,
    _file: File,
}

impl Lock {
    /// Keeps other programs from an output by a locked file beside it; `None` for devices, and
    /// where the system has no locks.
    pub(super) fn take(output: &Path, signals: &Signals) -> Result<Option<Self>, Failure> {
        let Some(place) = place_of(output) else {
            return Ok(None);
        };
        let name = place.file_name().unwrap_or_default().to_string_lossy();
        let path = place.with_file_name(atomic::lock_name(&name));
        let refused =
            |error: std::io::Error| Failure::system(format!("{}: {error}", path.display()));
        // The one who had the lock may remove the file after it was opened here.
        for attempt in 0..100 {
            let mut options = OpenOptions::new();
            options.read(true).write(true).create(true).truncate(false);
            let mut file = options.open(&path).map_err(refused)?;
            match atomic::locked(&file) {
                Err(_) => {
                    let _ = fs::remove_file(&path);
                    return Ok(None);
                }
                // A program that cleans the folder holds it for a moment.
                Ok(false) if attempt < 5 => {
                    std::thread::sleep(Duration::from_millis(10));
                    continue;
                }
                Ok(false) => {
                    let holder = fs::read_to_string(&path).unwrap_or_default();
                    return Err(Failure::system(format!(
                        "{} is being written by {}: wait for it, or name another output",
                        output.display(),
                        if holder.is_empty() {
                            "another program"
                        } else {
                            holder.trim()
                        }
                    )));
                }
                Ok(true) => {}
            }
            if !is_same(&file, &path) {
                continue;
            }
            let host = fs::read_to_string("/proc/sys/kernel/hostname").unwrap_or_default();
            let holder = format!("process {} on {}\n", std::process::id(), host.trim());
            let written = file
                .set_len(0)
                .and_then(|()| file.write_all(holder.as_bytes()));
            written.map_err(refused)?;
            signals.clean(path.clone());
            return Ok(Some(Self { path, _file: file }));
        }
        Err(Failure::system(format!(
            "{} cannot be locked",
            output.display()
        )))
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        let _ = fs::remove_file(&self.path);
    }
}

/// Whether an open file is still the one at a path.
fn is_same(file: &File, path: &Path) -> bool {
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt;
        let found = file.metadata().ok().zip(fs::metadata(path).ok());
        found.is_some_and(|(own, other)| (own.dev(), own.ino()) == (other.dev(), other.ino()))
    }
    #[cfg(not(unix))]
    {
        let _ = file;
        path.exists()
    }
}

/// Writes a JSON object atomically, with the version of the program as `program`.
pub(super) fn write_json(path: &Path, report: &Value) -> Result<(), Failure> {
    let mut report = report.clone();
    if let Some(members) = report.as_object_mut() {
        members.insert("program".to_owned(), PROGRAM.into());
    }
    write_whole(path, format!("{report:#}\n"))
}

/// Whether a file's name stands for the standard output.
pub(super) fn is_stdout(file: &Path) -> bool {
    file.as_os_str() == "-"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_output_is_written_once_and_is_no_input() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        fs::create_dir(at("sub")).expect("the folder can be written");
        fs::write(at("scene.toml"), b"").expect("the folder can be written");
        let (exr, again) = (at("a.exr"), at("sub/../a.exr"));
        assert!(check_outputs([&exr, &at("a.png")], &[at("scene.toml")], "the test").is_ok());
        assert!(check_outputs([&exr, &again], &[], "the test").is_err());
        assert!(check_outputs([&exr, &exr], &[], "the test").is_err());
        assert!(
            check_outputs([&at("scene.toml")], &[at("sub/../scene.toml")], "the test").is_err()
        );
        assert!(check_outputs([&at("none/a.exr")], &[], "the test").is_err());
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn devices_may_take_several_outputs_and_links_count_as_what_they_lead_to() {
        let null = Path::new("/dev/null");
        assert!(check_outputs([null, null], &[], "the test").is_ok());
        let folder = tempfile::tempdir().expect("a folder");
        let [link, file] = ["link", "file"].map(|name| folder.path().join(name));
        std::os::unix::fs::symlink("file", &link).expect("the folder can be written");
        assert!(check_outputs([&link, &file], &[], "the test").is_err());
    }

    #[cfg(unix)]
    #[test]
    fn a_lock_is_taken_once_and_leaves_nothing() {
        let folder = tempfile::tempdir().expect("a folder");
        let output = folder.path().join("a.exr");
        let signals = Signals::default();
        let lock = Lock::take(&output, &signals).expect("nobody has it");
        assert!(lock.is_some());
        let Err(Failure::System(message)) = Lock::take(&output, &signals) else {
            panic!("it is taken");
        };
        let process = format!("process {}", std::process::id());
        assert!(message.contains(&process), "{message}");
        drop(lock);
        assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 0);
        // A lock file of a program that was killed holds nobody up.
        let left = folder.path().join(atomic::lock_name("a.exr"));
        fs::write(left, "process 1 on moon").expect("it is ours");
        assert!(
            Lock::take(&output, &signals)
                .expect("nobody has it")
                .is_some()
        );
    }
}
