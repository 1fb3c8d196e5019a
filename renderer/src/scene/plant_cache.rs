//! A cache of grown leaves in a folder, for scenes that are rendered repeatedly with other light or
//! other cameras.
//!
//! A file holds one leaf and is named by a digest of its plan. It begins with all that the plan says and
//! the identity of the program that wrote it, and ends with a checksum, so it is never used for
//! another leaf.
//!
//! - **In**: a plan, and how to grow it.
//! - **Out**: the leaf's data, from the file or grown.
//! - **Always true**: a leaf from a file has the same bits as a grown one. A file of another plan
//!   or program, or a damaged one, is not used but replaced atomically, so programs that run at the
//!   same time always read complete files.
//! - **Left out**: bodies of solid tissue; a limit on the size of the folder. Its files may be
//!   deleted at any time.

#[cfg(test)]
mod tests;

use std::fs::File;
use std::io::{self, BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::time::UNIX_EPOCH;

use leafmodel::document::written::Extent;
use leafmodel::leaf::LeafPlan;
use leafmodel::plan_file;
use thiserror::Error;

use super::fingerprint::fnv1a;
use super::plants::parts::{LeafParts, MapParts, Piece, PlantError, SurfaceParts};
use crate::codec::{self, SectionHead, write_section};
use crate::image::atomic;

/// The first bytes of a file.
const MAGIC: [u8; 16] = *b"lamina leaf  2\n\n";

/// The first bytes of files of Lamina 0.1.0.
const OLDER: [u8; 16] = *b"lamina leaf  1\n\n";

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
    #[error("it was written by Lamina 0.1.0, which alone can read it")]
    Older,
    #[error("it is another plan's, another program's, or no leaf at all")]
    Foreign,
}

/// A folder of grown leaves.
#[derive(Debug)]
pub struct PlantCache {
    folder: PathBuf,
    /// Identity of the program, including its build.
    program: String,
    notes: Mutex<Vec<String>>,
}

impl PlantCache {
    /// The cache in a folder, which is made if it does not exist.
    ///
    /// # Errors
    ///
    /// [`CacheError`] if it cannot be made.
    pub fn open(folder: &Path) -> Result<Self, CacheError> {
        let made = std::fs::create_dir_all(folder);
        made.map_err(|source| CacheError {
            folder: folder.to_owned(),
            source,
        })?;
        Ok(Self {
            folder: folder.to_owned(),
            program: program(),
            notes: Mutex::new(Vec::new()),
        })
    }

    /// Notes for the user since the last call: files that were not used or could not be written.
    pub fn take_notes(&self) -> Vec<String> {
        let mut notes = self.lock_notes();
        // Leaves grow on several threads.
        notes.sort();
        std::mem::take(&mut *notes)
    }

    fn lock_notes(&self) -> std::sync::MutexGuard<'_, Vec<String>> {
        // A list of texts is valid even if a thread panicked while it held the lock.
        self.notes
            .lock()
            .unwrap_or_else(std::sync::PoisonError::into_inner)
    }

    /// The leaf of a plan: from its file if that exists and is valid, else from `grow`, after which
    /// it is stored.
    ///
    /// # Errors
    ///
    /// Those of `grow`.
    pub(super) fn take_or_grow(
        &self,
        plan: &LeafPlan,
        grow: impl FnOnce() -> Result<LeafParts, PlantError>,
    ) -> Result<LeafParts, PlantError> {
        let identity = identity(plan);
        let key = format!("{}\n{identity}", self.program).into_bytes();
        let path = self.path(&identity);
        match read(&path, &key) {
            Ok(parts) => return Ok(parts),
            Err(RefusedEntry::Missing) => {}
            Err(refused) => self.lock_notes().push(format!(
                "{}: {refused}; the leaf was grown anew",
                path.display()
            )),
        }
        let parts = grow()?;
        if let Err(error) = atomic::replace(&path, |file| write(file, &key, &parts)) {
            self.lock_notes()
                .push(format!("the leaf is not kept: {error}"));
        }
        Ok(parts)
    }

    /// The file for the leaf of a plan with this identity.
    fn path(&self, identity: &str) -> PathBuf {
        let digest = fnv1a(identity.as_bytes());
        self.folder.join(format!("{digest:016x}.leaf"))
    }
}

/// All that a plan says, each number with all its digits, and a hash of the pictures that it names.
fn identity(plan: &LeafPlan) -> String {
    let pictures = plan.pictures().into_iter();
    let pictures: Vec<u8> = pictures.flat_map(f64::to_le_bytes).collect();
    let said = plan_file::leaf_to_toml("leaf", plan, Extent::All);
    format!("{said}\npictures {:016x}\n", fnv1a(&pictures))
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

fn write(file: &mut impl Write, key: &[u8], parts: &LeafParts) -> io::Result<()> {
    file.write_all(&MAGIC)?;
    write_section(file, key)?;
    write_section(file, &codec::to_bytes(parts))
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

fn read(path: &Path, key: &[u8]) -> Result<LeafParts, RefusedEntry> {
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
    if start.starts_with(&OLDER) {
        return Err(RefusedEntry::Older);
    }
    if is_whole.is_ok() && start != expected || !expected.starts_with(&start[..MAGIC.len()]) {
        return Err(RefusedEntry::Foreign);
    }
    is_whole.map_err(refused)?;
    let head = SectionHead::read(&mut file).map_err(refused)?;
    let leaf = head.bytes(&mut file).map_err(refused)?;
    let is_at_end = file.read(&mut [0]).map_err(refused)? == 0;
    let leaf = leaf.filter(|_| is_at_end).ok_or(RefusedEntry::Damaged)?;
    parts_from(&leaf).ok_or(RefusedEntry::Damaged)
}

/// The leaf that these bytes encode; `None` if they are not a leaf.
fn parts_from(bytes: &[u8]) -> Option<LeafParts> {
    let parts: LeafParts = codec::from_bytes(bytes)?;
    let is_whole = |map: &MapParts| {
        let texels = map.texels.len();
        let covers = |surface: &SurfaceParts| {
            surface.texels.len() == texels && [0, texels].contains(&surface.cover.len())
        };
        texels > 0
            && map.width.checked_mul(map.height) == Some(texels)
            && map.surface.as_ref().is_none_or(covers)
    };
    let materials = parts.maps.len() + usize::from(parts.stalk.is_some()) + parts.hairs.len();
    let is_there = |piece: &Piece| piece.mesh < parts.meshes.len() && piece.material < materials;
    // A leaf has at least one blade.
    let is_sound = !parts.pieces.is_empty()
        && parts.pieces.iter().all(is_there)
        && parts.maps.iter().all(is_whole);
    is_sound.then_some(parts)
}
