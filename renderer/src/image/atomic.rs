//! Atomic replacement of files.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use super::ImageError;

/// Replaces the file at `path` by the output of `write`.
///
/// The output goes to a temporary file in the same folder, which is flushed, synced and renamed;
/// then the folder is synced. If anything fails, the old file stays as it was and the temporary one
/// is removed. A new file has the mode that the umask leaves of 0666.
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

fn replace_or_fail(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<&mut File>) -> io::Result<()>,
) -> io::Result<()> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        Some(_) | None => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".lamina-").suffix(".part");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    let mut temporary = builder.tempfile_in(folder)?;
    let mut writer = BufWriter::new(temporary.as_file_mut());
    write(&mut writer)?;
    writer.flush()?;
    drop(writer);
    temporary.as_file().sync_all()?;
    temporary.persist(path).map_err(|error| error.error)?;
    // Until the folder's entry is on the disk, a power cut may bring back the old file.
    #[cfg(unix)]
    File::open(folder)?.sync_all()?;
    Ok(())
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
}
