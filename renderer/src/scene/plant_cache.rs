//! A cache of the stages of grown leaves in a folder: veins, forms, contents and faces.
//!
//! A file holds the result of one stage and is named by a digest of the program and of the part of the plan that
//! decides the stage. It begins with all of that, and ends with a checksum, so it is never used for
//! anything else.
//!
//! - **In**: a folder. Growth asks for results and gives new ones, see [`Kept`].
//! - **Out**: results of stages.
//! - **Always true**: a result from a file has the same bits as a new one. A damaged file is not used
//!   but replaced atomically, so programs that run at the same time always read complete files. In a folder with
//!   a limit, files that were not used for longest go first.
//! - **Left out**: bodies of solid tissue. Files may be deleted at any time.

#[cfg(test)]
mod tests;

use std::fs::File;
use std::io::{self, BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::time::{SystemTime, UNIX_EPOCH};

use leafmodel::grow_options::Kept;
use thiserror::Error;

use super::fingerprint::fnv1a;
use crate::codec::{SectionHead, write_section};
use crate::image::atomic;

/// The first bytes of a file.
const MAGIC: [u8; 16] = *b"lamina leaf  3\n\n";

/// How the names of files end.
const ENDING: &str = "leaf";

/// What the user's folder may hold, bytes.
pub const MOST_BYTES: u64 = 1_000_000_000;

/// Fraction of a limit down to which a full folder is emptied.
const ROOM: f64 = 0.9;

/// Why a cache cannot be used.
#[derive(Debug, Error)]
#[error("--cache {}: the folder cannot be used: {source}; name one that can be written into", folder.display())]
pub struct CacheError {
    folder: PathBuf,
    source: io::Error,
}

/// Why a file is not used.
#[derive(Debug, Error)]
enum RefusedEntry {
    /// There is no such file, which is not an error.
    #[error("it is not there")]
    Missing,
    #[error("it cannot be read: {0}")]
    Unreadable(io::Error),
    #[error("it is damaged")]
    Damaged,
    #[error("it is another leaf's, or no leaf at all")]
    Foreign,
}

/// A folder of results of stages.
#[derive(Debug)]
pub struct PlantCache {
    folder: PathBuf,
    /// What it may hold, bytes.
    most_bytes: Option<u64>,
    /// What it holds, bytes; not known before something is kept.
    held: Mutex<Option<u64>>,
    /// Identity of the program, including its build.
    program: String,
    notes: Mutex<Vec<String>>,
}

/// A file of a folder.
#[derive(Debug)]
struct Entry {
    path: PathBuf,
    bytes: u64,
    used: SystemTime,
}

impl PlantCache {
    /// The cache in a folder, which is made if it does not exist. It may hold `most_bytes`, or anything.
    ///
    /// # Errors
    ///
    /// [`CacheError`] if it cannot be made.
    pub fn open(folder: &Path, most_bytes: Option<u64>) -> Result<Self, CacheError> {
        let made = std::fs::create_dir_all(folder);
        made.map_err(|source| CacheError {
            folder: folder.to_owned(),
            source,
        })?;
        Ok(Self {
            folder: folder.to_owned(),
            most_bytes,
            held: Mutex::new(None),
            program: program(),
            notes: Mutex::new(Vec::new()),
        })
    }

    /// The user's cache folder: what the environment says in `LAMINA_CACHE`, else the system's usual place; `None` if
    /// that is empty or not to be found.
    pub fn usual_folder() -> Option<PathBuf> {
        let variable = |name: &str| std::env::var_os(name).filter(|value| !value.is_empty());
        if let Some(named) = std::env::var_os("LAMINA_CACHE") {
            return Some(PathBuf::from(named)).filter(|folder| !folder.as_os_str().is_empty());
        }
        let home = || variable("HOME").map(PathBuf::from);
        let caches = if cfg!(windows) {
            variable("LOCALAPPDATA").map(PathBuf::from)
        } else if cfg!(target_os = "macos") {
            home().map(|home| home.join("Library/Caches"))
        } else {
            let named = variable("XDG_CACHE_HOME").map(PathBuf::from);
            named.or_else(|| home().map(|home| home.join(".cache")))
        };
        // A relative folder would be another one in each working folder.
        let caches = caches.filter(|folder| folder.is_absolute());
        Some(caches?.join("lamina"))
    }

    /// Number and bytes of the files in a folder.
    pub fn content(folder: &Path) -> (usize, u64) {
        let entries = entries(folder);
        (entries.len(), entries.iter().map(|entry| entry.bytes).sum())
    }

    /// Deletes the files in a folder, and nothing else.
    ///
    /// # Errors
    ///
    /// What the system reports of the first file that cannot be deleted.
    pub fn clear(folder: &Path) -> io::Result<()> {
        let mut entries = entries(folder).into_iter();
        entries.try_for_each(|entry| std::fs::remove_file(entry.path))
    }

    /// Notes for the user since the last call: files that were not used or could not be written.
    pub fn take_notes(&self) -> Vec<String> {
        let mut notes = lock(&self.notes);
        // Leaves grow on several threads.
        notes.sort();
        std::mem::take(&mut *notes)
    }

    /// The key of a result in files, and its file.
    fn place(&self, stage: &str, key: &str) -> (Vec<u8>, PathBuf) {
        let key = format!("{}\n{stage}\n{key}", self.program).into_bytes();
        let name = format!("{stage}-{:016x}.{ENDING}", fnv1a(&key));
        let path = self.folder.join(name);
        (key, path)
    }

    /// Counts what was written, and makes room if that is too much.
    fn grew_by(&self, bytes: u64) {
        let Some(most) = self.most_bytes else {
            return;
        };
        let mut held = lock(&self.held);
        let now = match *held {
            Some(before) => before + bytes,
            None => Self::content(&self.folder).1,
        };
        *held = Some(if now > most {
            make_room(&self.folder, (most as f64 * ROOM) as u64)
        } else {
            now
        });
    }
}

/// The value behind a lock; it is valid even if a thread panicked while it held it.
fn lock<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex
        .lock()
        .unwrap_or_else(std::sync::PoisonError::into_inner)
}

/// The files of a cache in a folder.
fn entries(folder: &Path) -> Vec<Entry> {
    let files = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let files = files.filter(|file| {
        file.path()
            .extension()
            .is_some_and(|ending| ending == ENDING)
    });
    files
        .filter_map(|file| {
            let found = file.metadata().ok().filter(std::fs::Metadata::is_file)?;
            Some(Entry {
                path: file.path(),
                bytes: found.len(),
                used: found.modified().unwrap_or(UNIX_EPOCH),
            })
        })
        .collect()
}

/// Deletes the files that were not used for longest until at most so many bytes are left; returns how many are.
fn make_room(folder: &Path, most: u64) -> u64 {
    let mut entries = entries(folder);
    entries.sort_by(|a, b| (a.used, &a.path).cmp(&(b.used, &b.path)));
    let mut held: u64 = entries.iter().map(|entry| entry.bytes).sum();
    for entry in entries {
        if held <= most {
            break;
        }
        // Another program may have deleted it already.
        let _ = std::fs::remove_file(&entry.path);
        held -= entry.bytes;
    }
    held
}

impl Kept for PlantCache {
    fn take(&self, stage: &str, key: &str) -> Option<Vec<u8>> {
        let (key, path) = self.place(stage, key);
        match read(&path, &key) {
            Ok(value) => Some(value),
            Err(RefusedEntry::Missing) => None,
            Err(refused) => {
                let note = format!("{}: {refused}; the leaf was grown again", path.display());
                lock(&self.notes).push(note);
                None
            }
        }
    }

    fn keep(&self, stage: &str, key: &str, value: &[u8]) {
        let (key, path) = self.place(stage, key);
        let packed = lz4_flex::compress_prepend_size(value);
        match atomic::replace(&path, |file| write(file, &key, &packed)) {
            Ok(()) => self.grew_by(packed.len() as u64),
            Err(error) => lock(&self.notes).push(format!("the leaf is not kept: {error}")),
        }
    }
}

/// Version and build: another build of the same version may grow another leaf.
fn program() -> String {
    let build = std::env::current_exe().and_then(std::fs::metadata);
    let build = build.ok().map(|file| {
        let changed = file.modified().ok();
        let changed = changed.and_then(|time| time.duration_since(UNIX_EPOCH).ok());
        (file.len(), changed.map_or(0, |since| since.as_nanos()))
    });
    format!("lamina {} {build:?}", env!("CARGO_PKG_VERSION"))
}

fn write(file: &mut impl Write, key: &[u8], packed: &[u8]) -> io::Result<()> {
    file.write_all(&MAGIC)?;
    write_section(file, key)?;
    write_section(file, packed)
}

/// The reason of refusal for an error of reading.
fn refused(error: io::Error) -> RefusedEntry {
    if error.kind() == io::ErrorKind::NotFound {
        RefusedEntry::Missing
    } else if error.kind() == io::ErrorKind::UnexpectedEof {
        RefusedEntry::Damaged
    } else {
        RefusedEntry::Unreadable(error)
    }
}

fn read(path: &Path, key: &[u8]) -> Result<Vec<u8>, RefusedEntry> {
    // The file's type is checked before opening it, since opening a pipe would wait for a writer.
    let found = std::fs::metadata(path).map_err(refused)?;
    if !found.is_file() {
        return Err(RefusedEntry::Foreign);
    }
    let mut file = BufReader::new(File::open(path).map_err(refused)?);
    // All that stands before the leaf is known, so a foreign file cannot determine how much is read.
    let mut expected = MAGIC.to_vec();
    write_section(&mut expected, key).map_err(refused)?;
    let mut start = vec![0; expected.len()];
    let is_whole = file.read_exact(&mut start);
    if is_whole.is_ok() && start != expected || !expected.starts_with(&start[..MAGIC.len()]) {
        return Err(RefusedEntry::Foreign);
    }
    is_whole.map_err(refused)?;
    let head = SectionHead::read(&mut file).map_err(refused)?;
    let packed = head.bytes(&mut file).map_err(refused)?;
    let is_at_end = file.read(&mut [0]).map_err(refused)? == 0;
    let packed = packed.filter(|_| is_at_end).ok_or(RefusedEntry::Damaged)?;
    // What was used last goes last. A folder that cannot be written into keeps its order.
    let _ = file.get_ref().set_modified(SystemTime::now());
    lz4_flex::decompress_size_prepended(&packed).map_err(|_| RefusedEntry::Damaged)
}
