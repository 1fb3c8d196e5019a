//! What determines a result, written into its file and read from it.
//!
//! - **In**: what a command was asked for, as far as numbers depend on it; or a file with numbers.
//! - **Out**: a comment of a table, a member of a JSON object, an attribute of an EXR; or [`Kept`].
//! - **Always true**: the same result has the same provenance on every machine and any number of
//!   threads, but for the commit of the program.
//! - **Left out**: command line, paths, times and machine. A provenance is read as data only: it
//!   names no file that anyone opens, and no command that anyone runs.
//!
//! ```
//! use renderer::provenance::{Provenance, Settings};
//!
//! let settings = Settings::from([("seed".to_owned(), vec!["1".to_owned()])]);
//! let provenance = Provenance::of("instruments", "out", &settings);
//! let table = format!("{}a,b\n1,2\n", provenance.comment());
//! assert_eq!(Provenance::in_table(&table).expect("it was written"), Some(provenance));
//! assert_eq!(Provenance::in_table("a,b\n1,2\n").expect("there is none"), None);
//! ```

pub mod deviation;

use std::collections::BTreeMap;
use std::fs::File;
use std::io::Read as _;
use std::path::Path;
use std::sync::OnceLock;

use leafmodel::document::whole_file;
use serde::{Deserialize, Serialize};
use serde_json::Value as Json;
use thiserror::Error;

use crate::checkpoint::PROGRAM;
use crate::image::{Attribute, ImageError, Picture, openexr};
use crate::scene::fingerprint::{fnv1a, hexadecimal};

/// Options of a command by name, without dashes, and their values as written.
pub type Settings = BTreeMap<String, Vec<String>>;
/// Files by name, and [hashes](hash) of what they hold.
pub type Hashes = BTreeMap<String, String>;

/// How the line of a table begins that holds its provenance.
const COMMENT: &str = "# provenance: ";
/// The attribute of a picture.
const ATTRIBUTE: &str = "lamina:provenance";
/// The member of a JSON object.
const MEMBER: &str = "provenance";

/// What determines a result.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Provenance {
    /// Version of the program.
    pub version: String,
    /// Commit that it was built from, with `-dirty` if sources differed; `None` if that is not known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub commit: Option<String>,
    /// The command that makes such results.
    pub result: String,
    /// The option of the command that names the file.
    pub option: String,
    /// [Fingerprint](crate::scene::fingerprint) of the scene, as [`hexadecimal`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scene: Option<String>,
    /// Files that were read: those that the scene names, by their places in its folder; others by
    /// the option that named them.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub files: Hashes,
    /// Overrides of the scene.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub overrides: Vec<String>,
    /// Options on which the numbers depend: seed, rays or samples, contents and so on.
    pub settings: Settings,
    /// Whether nothing but these determines the result: no time limit and no interruption.
    pub complete: bool,
}

/// The commit of the program that runs.
static COMMIT: OnceLock<Option<String>> = OnceLock::new();

/// Takes the commit from what `--version` prints, `0.1.0 (0123456789ab-dirty)`.
pub(crate) fn note_build(version: &str) {
    let commit = version
        .split_once('(')
        .and_then(|(_, commit)| commit.strip_suffix(')'));
    // A process has one program; tests that run several commands have none.
    let _ = COMMIT.set(commit.map(str::to_owned));
}

/// The hash of bytes: FNV-1a, 64 bits. It distinguishes files; it is not a cryptographic hash.
pub fn hash(bytes: &[u8]) -> String {
    hexadecimal(fnv1a(bytes))
}

/// The hash of a file, which is empty for a device or a pipe, because these cannot be read twice.
pub fn hash_of(file: &Path) -> String {
    let read = || whole_file::read(file, whole_file::MOST_BYTES).ok();
    let bytes = file.is_file().then(read).flatten();
    bytes.map_or_else(String::new, |bytes| hash(&bytes))
}

impl Provenance {
    /// That of a result of this program.
    pub fn of(result: &str, option: &str, settings: &Settings) -> Self {
        Self {
            version: PROGRAM.to_owned(),
            commit: COMMIT.get().cloned().flatten(),
            result: result.to_owned(),
            option: option.to_owned(),
            scene: None,
            files: Hashes::new(),
            overrides: Vec::new(),
            settings: settings.clone(),
            complete: true,
        }
    }

    /// As JSON in a line.
    fn line(&self) -> String {
        serde_json::to_string(self).expect("texts are JSON")
    }

    /// The first line of a table.
    pub fn comment(&self) -> String {
        format!("{COMMENT}{}\n", self.line())
    }

    /// An attribute of a picture.
    pub(crate) fn attribute(&self) -> (String, Attribute) {
        (ATTRIBUTE.to_owned(), Attribute::Text(self.line()))
    }

    /// A JSON object, with this as a member.
    pub(crate) fn within(&self, mut report: Json) -> Json {
        report[MEMBER] = serde_json::to_value(self).expect("texts are JSON");
        report
    }

    /// Version and commit.
    pub fn program(&self) -> String {
        let commit = self.commit.as_ref().map(|commit| format!(" ({commit})"));
        format!("{}{}", self.version, commit.unwrap_or_default())
    }

    /// What [`Self::comment`] has written into a table.
    ///
    /// # Errors
    ///
    /// [`NotKept::Damaged`] if such a line holds anything else.
    pub fn in_table(text: &str) -> Result<Option<Self>, NotKept> {
        let mut comments = text.lines().take_while(|line| line.starts_with('#'));
        let line = comments.find_map(|line| line.strip_prefix(COMMENT));
        line.map(|line| serde_json::from_str(line).map_err(NotKept::Damaged))
            .transpose()
    }
}

/// Why a file has no provenance that can be read.
#[derive(Debug, Error)]
pub enum NotKept {
    /// It cannot be read.
    #[error("{0}")]
    File(#[from] std::io::Error),
    /// It is no picture.
    #[error("{0}")]
    Image(#[from] ImageError),
    /// It is no JSON.
    #[error("it begins as JSON and is none: {0}")]
    Json(serde_json::Error),
    /// The provenance is not one.
    #[error("its provenance is damaged: {0}")]
    Damaged(serde_json::Error),
    /// There is none.
    #[error(
        "it has no provenance: pictures, and tables and JSON of instruments, optics and fit have one since \
         version 0.2"
    )]
    Missing,
}

/// What a file holds, by its first bytes.
#[derive(Debug)]
pub enum Contents {
    /// EXR.
    Picture(Picture),
    /// JSON.
    Json(Json),
    /// A table with comments.
    Table(String),
}

/// A result with its provenance.
#[derive(Debug)]
pub struct Kept {
    /// What determines it.
    pub provenance: Provenance,
    /// The numbers.
    pub contents: Contents,
}

impl Kept {
    /// Reads a file.
    ///
    /// # Errors
    ///
    /// [`NotKept`] says why it holds no result with a provenance.
    pub fn read(file: &Path) -> Result<Self, NotKept> {
        const MAGIC: [u8; 4] = [0x76, 0x2f, 0x31, 0x01];
        let mut start = [0; MAGIC.len()];
        // A file that is shorter is no picture.
        let is_picture = File::open(file)?.read_exact(&mut start).is_ok() && start == MAGIC;
        if is_picture {
            let picture = openexr::read(file)?;
            let line = picture.text(ATTRIBUTE).ok_or(NotKept::Missing)?;
            return Ok(Self {
                provenance: serde_json::from_str(line).map_err(NotKept::Damaged)?,
                contents: Contents::Picture(picture),
            });
        }
        let text = whole_file::read_utf8(file, whole_file::MOST_BYTES)?;
        if text.trim_start().starts_with('{') {
            let report: Json = serde_json::from_str(&text).map_err(NotKept::Json)?;
            let member = report.get(MEMBER).ok_or(NotKept::Missing)?;
            return Ok(Self {
                provenance: Provenance::deserialize(member).map_err(NotKept::Damaged)?,
                contents: Contents::Json(report),
            });
        }
        Ok(Self {
            provenance: Provenance::in_table(&text)?.ok_or(NotKept::Missing)?,
            contents: Contents::Table(text),
        })
    }
}
