//! A file of sums that is read: its heading first, its sections as they are needed.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use thiserror::Error;

use super::heading::{Heading, Progress};
use crate::codec::{self, SectionHead};
use crate::film::{BLOCK_SIDE, DamagedRow, Film, FilmError};
use crate::integrator::layers::Layout;
use crate::integrator::render::{Begun, Job};
use crate::spectrum::WavelengthSampler;

/// The first bytes of a file.
pub(super) const MAGIC: [u8; 16] = *b"lamina sums 11\n\n";

/// The first bytes of files of older programs, and the versions that wrote them.
const OLDER: [([u8; 16], &str); 1] = [(*b"lamina sums 10\n\n", "0.1.0")];

/// Why a checkpoint cannot be read.
#[derive(Debug, Error)]
pub enum CheckpointError {
    /// The system refuses.
    #[error("{}: {source}", .path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// It does not begin as one.
    #[error("{} is no checkpoint or part of this format", .path.display())]
    Foreign {
        /// The file.
        path: PathBuf,
    },
    /// An older program has written it.
    #[error("{} was written by Lamina {version}: continue it, or merge it, with that version", .path.display())]
    Older {
        /// The file.
        path: PathBuf,
        /// The version.
        version: &'static str,
    },
    /// It begins as one.
    #[error("{} is damaged: {what}", .path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// Where.
        what: &'static str,
    },
    /// It claims to be larger than any film.
    #[error("{}: {source}", .path.display())]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// Of which size.
        source: FilmError,
    },
}

/// A file whose heading was read, and the places of its sections.
pub(super) struct Opened {
    pub(super) path: PathBuf,
    pub(super) heading: Heading,
    pub(super) progress: Progress,
    /// Places of the sections behind the heading, and what stands before each.
    pub(super) sections: Vec<(u64, SectionHead)>,
}

impl Opened {
    pub(super) fn new(path: &Path) -> Result<Self, CheckpointError> {
        let refuse = |source| CheckpointError::File {
            path: path.to_owned(),
            source,
        };
        let damaged = |what| CheckpointError::Damaged {
            path: path.to_owned(),
            what,
        };
        let foreign = || CheckpointError::Foreign {
            path: path.to_owned(),
        };
        // The type is checked before opening, since opening a pipe would wait for a writer.
        let found = std::fs::metadata(path).map_err(refuse)?;
        if !found.is_file() {
            return Err(foreign());
        }
        let mut file = File::open(path).map_err(refuse)?;
        let size = file.metadata().map_err(refuse)?.len();
        let mut magic = [0; MAGIC.len()];
        if size < MAGIC.len() as u64 {
            return Err(foreign());
        }
        file.read_exact(&mut magic).map_err(refuse)?;
        if magic != MAGIC {
            let older = OLDER.into_iter().find(|(older, _)| magic == *older);
            return Err(
                older.map_or_else(foreign, |(_, version)| CheckpointError::Older {
                    path: path.to_owned(),
                    version,
                }),
            );
        }
        let mut at = MAGIC.len() as u64;
        let mut sections = Vec::new();
        while at < size {
            if size - at < SectionHead::LENGTH {
                return Err(damaged("its end is missing"));
            }
            file.seek(SeekFrom::Start(at)).map_err(refuse)?;
            let head = SectionHead::read(&mut file).map_err(refuse)?;
            at += SectionHead::LENGTH;
            if size - at < head.length {
                return Err(damaged("its end is missing"));
            }
            sections.push((at, head));
            at += head.length;
        }
        if sections.is_empty() {
            return Err(damaged("its end is missing"));
        }
        let heading = section_of(path, sections.remove(0))?;
        let (heading, progress) =
            Heading::from_bytes(&heading).ok_or_else(|| damaged("its heading says nothing"))?;
        Ok(Self {
            path: path.to_owned(),
            heading,
            progress,
            sections,
        })
    }

    pub(super) fn damaged(&self, what: &'static str) -> CheckpointError {
        CheckpointError::Damaged {
            path: self.path.clone(),
            what,
        }
    }

    fn section(&self, number: usize) -> Result<Vec<u8>, CheckpointError> {
        section_of(&self.path, self.sections[number])
    }

    /// Whether there is a section for each row of blocks, long enough for its blocks.
    fn has_all_rows(&self, layout: Layout) -> bool {
        let Job { width, height, .. } = self.heading.job;
        let (across, rows) = (width.div_ceil(BLOCK_SIDE), height.div_ceil(BLOCK_SIDE));
        // The counts of samples and of open batches, and two bytes for each kind of number.
        let kinds = 2 * layout.beauty + 2 + layout.sums().len();
        let least = u64::from(across) * (4 + 2 + 2 * kinds as u64);
        let rows = rows as usize;
        self.sections.len() == rows + 2
            && self.sections[..rows]
                .iter()
                .all(|(_, head)| head.length >= least)
    }

    /// The sums of several files of one render, this one among them, with the first of their
    /// samples. Rows of blocks are added up on all threads.
    pub(super) fn begun(&self, parts: &[Self]) -> Result<Begun, CheckpointError> {
        let layout = Layout::new(&WavelengthSampler::new(&self.heading.caption.kind));
        // Before any memory is taken for what a heading claims.
        if let Some(part) = parts.iter().find(|part| !part.has_all_rows(layout)) {
            return Err(part.damaged("it has not all rows"));
        }
        let begun = Begun::new(
            &self.heading.job,
            layout,
            self.heading.aim,
            self.progress.effort,
        );
        let mut begun = begun.map_err(|source| CheckpointError::TooLarge {
            path: self.path.clone(),
            source,
        })?;
        let rows = begun.film.rows();
        begun.film.add_rows(|row, sums| {
            for part in parts {
                let told = |DamagedRow| part.damaged("a row has impossible sums");
                sums.add(&part.section(row)?).map_err(told)?;
            }
            Ok(())
        })?;
        for part in parts {
            part.add_faults(&mut begun.film, rows)?;
            begun.rays = begun.rays.saturating_add(part.progress.rays);
            begun.elapsed = begun.elapsed.saturating_add(part.progress.elapsed);
        }
        if !begun.film.is_sound() {
            return Err(self.damaged("more samples are rejected than drawn"));
        }
        begun.first = self.progress.first;
        if let Some(watch) = begun.watch.take() {
            let words: Option<Option<Vec<u32>>> = codec::from_bytes(&self.section(rows + 1)?);
            let watch = words.flatten().and_then(|words| watch.restored(&words));
            begun.watch = Some(watch.ok_or_else(|| self.damaged("its noise is impossible"))?);
        }
        Ok(begun)
    }

    fn add_faults(&self, film: &mut Film, section: usize) -> Result<(), CheckpointError> {
        let counts: Option<Vec<u64>> = codec::from_bytes(&self.section(section)?);
        let added = counts.and_then(|counts| film.add_fault_counts(&counts).ok());
        added.ok_or_else(|| self.damaged("its counts of rejected samples are impossible"))
    }
}

/// The bytes of a section, if its checksum is right.
fn section_of(path: &Path, (at, head): (u64, SectionHead)) -> Result<Vec<u8>, CheckpointError> {
    let read = File::open(path).and_then(|mut file| {
        file.seek(SeekFrom::Start(at))?;
        head.bytes(&mut file)
    });
    let path = || path.to_owned();
    let bytes = read.map_err(|source| CheckpointError::File {
        path: path(),
        source,
    })?;
    bytes.ok_or_else(|| CheckpointError::Damaged {
        path: path(),
        what: "a checksum is wrong",
    })
}
