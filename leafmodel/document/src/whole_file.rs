//! Whole files, up to a size.

use std::fs::{File, FileType};
use std::io::{self, Read as _};
use std::path::Path;

/// Largest table, network or drawing that a command line may name, bytes.
pub const MOST_BYTES: u64 = 512 << 20;

/// The bytes of a file that a person names.
///
/// Pipes are read as files are, since a shell gives one for the output of a command. Devices are not,
/// because they may never end.
///
/// # Errors
///
/// What the system reports; that it is neither a regular file nor a pipe; that it has more than
/// `most` bytes. Messages are written to follow the name of the file.
pub fn read(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    let file = File::open(path)?;
    let found = file.metadata()?;
    if !found.is_file() && !is_pipe(found.file_type()) {
        return Err(io::Error::other("is not a regular file"));
    }
    let mut bytes = Vec::new();
    // A pipe has no size, and a file may grow.
    if found.len() <= most {
        file.take(most + 1).read_to_end(&mut bytes)?;
    }
    if found.len().max(bytes.len() as u64) > most {
        let problem = format!("has more than {most} bytes, the most that are read");
        return Err(io::Error::other(problem));
    }
    Ok(bytes)
}

/// As [`read`], of text in UTF-8.
///
/// # Errors
///
/// As [`read`], and for other text.
pub fn read_utf8(path: &Path, most: u64) -> io::Result<String> {
    String::from_utf8(read(path, most)?).map_err(|error| {
        let byte = error.utf8_error().valid_up_to();
        io::Error::other(format!("is not in UTF-8 at byte {byte}"))
    })
}

fn is_pipe(kind: FileType) -> bool {
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt as _;
        kind.is_fifo()
    }
    #[cfg(not(unix))]
    {
        let _ = kind;
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_read_up_to_the_limit() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("table.csv");
        std::fs::write(&path, "12345").expect("the folder can be written");
        assert_eq!(read(&path, 5).expect("it is small enough"), b"12345");
        let error = read(&path, 4).expect_err("it is too large");
        assert!(error.to_string().contains("more than 4 bytes"), "{error}");
        let error = read(folder.path(), 5).expect_err("it is a folder");
        assert!(!error.to_string().is_empty());
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn what_never_ends_is_refused_and_pipes_are_read() {
        let error = read(Path::new("/dev/zero"), MOST_BYTES).expect_err("it is a device");
        assert_eq!(error.to_string(), "is not a regular file");
        let (reader, mut writer) = io::pipe().expect("the system has pipes");
        let path = {
            use std::os::fd::AsRawFd as _;
            format!("/proc/self/fd/{}", reader.as_raw_fd())
        };
        io::Write::write_all(&mut writer, b"nm,value").expect("the pipe is open");
        drop(writer);
        assert_eq!(read(Path::new(&path), 8).expect("it ends"), b"nm,value");
    }
}
