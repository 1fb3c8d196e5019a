//! Atomic replacement of files.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

use super::error::ImageError;

/// What temporary names begin with; the number of the process follows.
const PREFIX: &str = ".lamina-";
/// What temporary names end with.
const SUFFIX: &str = ".part";
/// What the names of files end with that keep other programs from an output.
const LOCK: &str = ".lock";

/// Replaces the file at `path` by the output of `write`.
///
/// The output goes to a temporary file in the same folder, which is flushed, synced and renamed;
/// then the folder is synced. If anything fails, the old file stays as it was and the temporary one
/// is removed. A new file has the mode that the umask leaves of 0666.
///
/// A symbolic link stays, and what it leads to is replaced. A device or a pipe is written to.
///
/// # Errors
///
/// [`ImageError::File`] with `path`, from `write` or from the system.
pub fn replace(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<&mut File>) -> io::Result<()>,
) -> Result<(), ImageError> {
    replace_or_fail(path, write).map_err(|source| ImageError::File {
        path: path.to_owned(),
        source,
    })
}

/// Where output for a path goes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Destination {
    /// A regular file at this path, behind all links, which may not exist yet.
    File(PathBuf),
    /// Something that takes bytes and must stay: a device, a pipe.
    Stream,
}

/// Where output for `path` goes.
///
/// # Errors
///
/// A folder, a circle of links, or what the system says.
pub fn destination(path: &Path) -> io::Result<Destination> {
    let mut path = path.to_owned();
    // As many links as the system itself follows.
    for _ in 0..40 {
        match fs::symlink_metadata(&path) {
            Ok(found) if found.is_symlink() => {
                let target = fs::read_link(&path)?;
                // A name in /proc/self/fd may lead to a pipe, which has no path.
                if fs::metadata(&path).is_ok_and(|found| !found.is_file() && !found.is_dir()) {
                    return Ok(Destination::Stream);
                }
                path = folder_of(&path).join(target);
            }
            Ok(found) if found.is_file() => return Ok(Destination::File(path)),
            Ok(found) if found.is_dir() => return Err(io::ErrorKind::IsADirectory.into()),
            Ok(_) => return Ok(Destination::Stream),
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                return Ok(Destination::File(path));
            }
            Err(error) => return Err(error),
        }
    }
    Err(io::Error::other("too many symbolic links"))
}

/// The folder of a file.
pub fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        Some(_) | None => Path::new("."),
    }
}

fn replace_or_fail(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<&mut File>) -> io::Result<()>,
) -> io::Result<()> {
    let path = match destination(path)? {
        Destination::File(path) => path,
        Destination::Stream => {
            let mut stream = OpenOptions::new().write(true).open(path)?;
            let mut writer = BufWriter::new(&mut stream);
            write(&mut writer)?;
            return writer.flush();
        }
    };
    let folder = folder_of(&path);
    let mut temporary = temporary_in(folder)?;
    let mut writer = BufWriter::new(temporary.as_file_mut());
    write(&mut writer)?;
    writer.flush()?;
    drop(writer);
    temporary.as_file().sync_all()?;
    temporary.persist(&path).map_err(|error| error.error)?;
    // Until the folder's entry is on the disk, a power cut may bring back the old file.
    #[cfg(unix)]
    File::open(folder)?.sync_all()?;
    Ok(())
}

/// A temporary file, locked as long as it is open so that nobody takes it for a dead program's.
fn temporary_in(folder: &Path) -> io::Result<tempfile::NamedTempFile> {
    let prefix = format!("{PREFIX}{}-", std::process::id());
    let mut builder = tempfile::Builder::new();
    builder.prefix(&prefix).suffix(SUFFIX);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    let temporary = builder.tempfile_in(folder)?;
    // Without locks (some network folders) it is written all the same, and never swept.
    let _ = locked(temporary.as_file());
    Ok(temporary)
}

/// Locks an open file against other programs until it is closed; returns whether nobody else has
/// it locked.
///
/// # Errors
///
/// The system's, if it cannot lock.
pub fn locked(file: &File) -> io::Result<bool> {
    #[cfg(unix)]
    {
        use rustix::fs::{FlockOperation, flock};
        match flock(file, FlockOperation::NonBlockingLockExclusive) {
            Ok(()) => Ok(true),
            Err(rustix::io::Errno::WOULDBLOCK) => Ok(false),
            Err(error) => Err(error.into()),
        }
    }
    #[cfg(not(unix))]
    {
        let _ = file;
        Err(io::ErrorKind::Unsupported.into())
    }
}

/// The file beside an output of this name that is locked as long as a program writes the output.
pub fn lock_name(output: &str) -> String {
    format!("{PREFIX}{output}{LOCK}")
}

/// Removes what programs which were killed have left in a folder, temporary files and locks; errors
/// are not worth a word.
pub fn sweep(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else {
        return;
    };
    for entry in entries.flatten() {
        let name = entry.file_name();
        let Some(rest) = name.to_str().and_then(|name| name.strip_prefix(PREFIX)) else {
            continue;
        };
        let writer = if rest.ends_with(SUFFIX) {
            rest.split('-').next().and_then(|pid| pid.parse().ok())
        } else if rest.ends_with(LOCK) {
            let holder = fs::read_to_string(entry.path()).unwrap_or_default();
            let words = holder.strip_prefix("process ");
            words.and_then(|words| words.split(' ').next()?.parse().ok())
        } else {
            continue;
        };
        remove_abandoned(&entry.path(), writer);
    }
}

/// Removes a file if the program that wrote it is dead: nobody holds its lock, and nobody can be
/// about to take it, because the process has ended or the file is a minute old.
fn remove_abandoned(path: &Path, writer: Option<i32>) {
    let is_old = || {
        let changed = fs::metadata(path).and_then(|found| found.modified());
        let age = changed.ok().and_then(|changed| changed.elapsed().ok());
        age.is_some_and(|age| age > Duration::from_secs(60))
    };
    let is_file = fs::symlink_metadata(path).is_ok_and(|found| found.is_file());
    let file = is_file.then(|| OpenOptions::new().write(true).open(path));
    // The lock is held until the file is gone, so that nobody takes it meanwhile.
    if let Some(Ok(file)) = file
        && locked(&file).unwrap_or(false)
        && (writer.is_some_and(|writer| !is_running(writer)) || is_old())
    {
        let _ = fs::remove_file(path);
    }
}

/// Whether a process of this machine has the number.
fn is_running(process: i32) -> bool {
    #[cfg(unix)]
    {
        use rustix::process::{Pid, test_kill_process};
        let process = Pid::from_raw(process);
        process.is_some_and(|process| {
            !matches!(test_kill_process(process), Err(rustix::io::Errno::SRCH))
        })
    }
    #[cfg(not(unix))]
    {
        let _ = process;
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let entries = std::fs::read_dir(folder).expect("the folder is there");
        let mut names: Vec<_> = entries
            .map(|entry| {
                entry
                    .expect("an entry")
                    .file_name()
                    .to_string_lossy()
                    .into_owned()
            })
            .collect();
        names.sort();
        names
    }

    #[test]
    fn a_failure_at_any_byte_leaves_the_old_file() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("picture.exr");
        replace(&path, |file| file.write_all(b"old and good")).expect("the folder can be written");
        for whole in [0, 1, 100, 100_000] {
            let error = replace(&path, |file| {
                file.write_all(&vec![7; whole])?;
                Err(io::Error::from(io::ErrorKind::StorageFull))
            })
            .expect_err("the writer failed");
            assert!(error.to_string().contains("picture.exr"), "{error}");
            assert_eq!(std::fs::read(&path).expect("it is there"), b"old and good");
            assert_eq!(names(folder.path()), ["picture.exr"]);
        }
        replace(&path, |file| file.write_all(b"new")).expect("the folder can be written");
        assert_eq!(std::fs::read(&path).expect("it is there"), b"new");
    }

    #[test]
    fn a_panic_while_writing_leaves_the_old_file() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("picture.exr");
        replace(&path, |file| file.write_all(b"old")).expect("the folder can be written");
        let panicked = std::panic::catch_unwind(|| replace(&path, |_| panic!("on purpose")));
        assert!(panicked.is_err());
        assert_eq!(std::fs::read(&path).expect("it is there"), b"old");
        assert_eq!(names(folder.path()), ["picture.exr"]);
    }

    #[test]
    fn a_missing_folder_is_an_error_with_the_path() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("nowhere/picture.png");
        let error = replace(&path, |_| Ok(())).expect_err("there is no such folder");
        assert!(error.to_string().contains("nowhere"), "{error}");
    }

    #[cfg(unix)]
    #[test]
    fn a_new_file_has_the_mode_of_any_new_file() {
        use std::os::unix::fs::PermissionsExt;

        let folder = tempfile::tempdir().expect("a folder");
        let (ours, plain) = (folder.path().join("ours"), folder.path().join("plain"));
        replace(&ours, |_| Ok(())).expect("the folder can be written");
        File::create(&plain).expect("the folder can be written");
        let mode = |path: &Path| {
            std::fs::metadata(path)
                .expect("it is there")
                .permissions()
                .mode()
        };
        assert_eq!(mode(&ours), mode(&plain));
    }

    #[cfg(unix)]
    #[test]
    fn links_stay_and_what_they_lead_to_is_replaced() {
        use std::os::unix::fs::symlink;

        let folder = tempfile::tempdir().expect("a folder");
        let [link, other, file] = ["link", "other", "file"].map(|name| folder.path().join(name));
        symlink("other", &link).expect("the folder can be written");
        symlink("file", &other).expect("the folder can be written");
        // First it leads nowhere, then to a file.
        for text in [&b"new"[..], b"newer"] {
            replace(&link, |out| out.write_all(text)).expect("the folder can be written");
            assert_eq!(fs::read(&file).expect("it is there"), text);
            assert_eq!(fs::read_link(&link).expect("a link"), Path::new("other"));
            assert_eq!(names(folder.path()), ["file", "link", "other"]);
        }
        symlink("round", folder.path().join("round")).expect("the folder can be written");
        let error = replace(&folder.path().join("round"), |_| Ok(())).expect_err("a circle");
        assert!(error.to_string().contains("links"), "{error}");
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn devices_and_pipes_are_written_to() {
        use std::io::Read as _;
        use std::os::unix::fs::FileTypeExt;

        let null = Path::new("/dev/null");
        replace(null, |out| out.write_all(b"nothing")).expect("it takes everything");
        let found = fs::metadata(null).expect("it is there");
        assert!(found.file_type().is_char_device());
        let full = replace(Path::new("/dev/full"), |out| out.write_all(b"too much"));
        assert!(full.is_err());
        let folder = tempfile::tempdir().expect("a folder");
        let pipe = folder.path().join("pipe");
        rustix::fs::mknodat(
            rustix::fs::CWD,
            &pipe,
            rustix::fs::FileType::Fifo,
            rustix::fs::Mode::RUSR | rustix::fs::Mode::WUSR,
            0,
        )
        .expect("a pipe");
        let writer = {
            let pipe = pipe.clone();
            std::thread::spawn(move || replace(&pipe, |out| out.write_all(b"through")))
        };
        let mut text = String::new();
        let mut reader = File::open(&pipe).expect("the pipe is there");
        reader.read_to_string(&mut text).expect("it is text");
        assert_eq!(text, "through");
        writer.join().expect("no panic").expect("it is written");
        assert!(fs::metadata(&pipe).expect("it stays").file_type().is_fifo());
    }

    #[cfg(unix)]
    #[test]
    fn only_files_of_the_dead_are_swept() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        // No process has the greatest number.
        let dead = at(&format!(".lamina-{}-x.part", i32::MAX));
        let [left, taken, of_others] =
            [&lock_name("a.exr"), &lock_name("b.exr"), ".c.exr.lock"].map(at);
        for path in [&left, &taken, &of_others] {
            let holder = format!("process {} on moon\n", i32::MAX);
            fs::write(path, holder).expect("the folder can be written");
        }
        let held = OpenOptions::new().write(true).open(&taken);
        let held = held.expect("it is there");
        assert!(locked(&held).expect("this system has locks"));
        let [ours, foreign, picture] = [
            &format!(".lamina-{}-x.part", std::process::id()),
            "x.part",
            "y.exr",
        ]
        .map(at);
        for path in [&dead, &ours, &foreign, &picture] {
            fs::write(path, b"half").expect("the folder can be written");
        }
        replace(&at("z.exr"), |out| {
            sweep(folder.path());
            out.write_all(b"in the middle of it")
        })
        .expect("its temporary file is still there");
        assert!(!dead.exists() && !left.exists());
        assert!(taken.exists() && of_others.exists());
        assert!(ours.exists() && foreign.exists() && picture.exists());
        // Numbers of processes are used again: after a minute an unlocked file is nobody's.
        let old = std::time::SystemTime::now() - Duration::from_secs(61);
        let file = OpenOptions::new().write(true).open(&ours);
        let file = file.expect("it is there");
        file.set_modified(old).expect("it is ours");
        drop(file);
        sweep(folder.path());
        assert!(!ours.exists() && foreign.exists() && picture.exists());
    }
}
