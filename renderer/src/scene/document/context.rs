//! What every block needs while it is read: the texts, the folder, and where errors go.

use std::cell::{Cell, RefCell};
use std::path::PathBuf;

use super::tree::Node;
use crate::scene::error::{LocatedError, SceneError};
use crate::scene::source::{Place, Sources, escaped};

/// Longest piece of the file that a message repeats, in characters.
pub(crate) const QUOTED: usize = 60;

/// Errors after which no more are kept, and entries among which suggestions are looked for: a
/// file that was made to be slow must not be.
pub(crate) const ENOUGH: usize = 1000;

/// Something that is allowed and hardly meant.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Remark {
    pub(crate) code: &'static str,
    pub(crate) message: String,
    pub(crate) help: String,
    pub(crate) at: Option<Place>,
}

/// A key that a file may have.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct KnownKey {
    /// Names of all blocks around it, and its own.
    pub(crate) path: String,
    /// Whether the block that it belongs to is in the file.
    pub(crate) block_is_there: bool,
}

/// Shared by all blocks of one file.
#[derive(Debug)]
pub(crate) struct Context {
    /// The folder that paths start at and must not leave.
    pub(crate) folder: PathBuf,
    /// Whether spectra go on with their end values outside their tables.
    pub(crate) extrapolate: Cell<bool>,
    /// First and last wavelength of the film, nm, once it is known.
    pub(crate) range_nm: Cell<Option<[f64; 2]>>,
    pub(crate) sources: RefCell<Sources>,
    /// The files that it names, as they are found.
    pub(crate) inputs: RefCell<Vec<PathBuf>>,
    /// If what the keys are is asked for: every key of every block, see [`KnownKey`].
    pub(crate) survey: RefCell<Option<Vec<KnownKey>>>,
    /// Blocks that overrides add, with names like others': errors if what they add is not whole.
    pub(crate) perhaps_misspelt: RefCell<Vec<LocatedError>>,
    errors: RefCell<Vec<LocatedError>>,
    error_count: Cell<usize>,
    remarks: RefCell<Vec<Remark>>,
}

impl Context {
    pub(crate) fn new(sources: Sources, folder: PathBuf) -> Self {
        Self {
            folder,
            extrapolate: Cell::new(false),
            range_nm: Cell::new(None),
            sources: RefCell::new(sources),
            inputs: RefCell::default(),
            survey: RefCell::default(),
            perhaps_misspelt: RefCell::default(),
            errors: RefCell::default(),
            error_count: Cell::new(0),
            remarks: RefCell::default(),
        }
    }

    /// Notes an error at a place.
    pub(crate) fn error(&self, at: &Place, error: SceneError) {
        self.keep(error, Some(at));
    }

    /// Notes an error of the file as a whole.
    pub(crate) fn error_of_the_file(&self, error: SceneError) {
        self.keep(error, None);
    }

    fn keep(&self, error: SceneError, at: Option<&Place>) {
        if !self.is_full() {
            let at = at.cloned();
            self.errors.borrow_mut().push(LocatedError { error, at });
        }
        self.error_count.set(self.error_count.get() + 1);
    }

    /// Notes a warning.
    pub(crate) fn warn(&self, at: &Place, code: &'static str, message: String, help: &str) {
        self.remarks.borrow_mut().push(Remark {
            code,
            message,
            help: help.to_owned(),
            at: Some(at.clone()),
        });
    }

    /// Whether so many errors were found that looking for more is a waste of time.
    pub(crate) fn is_full(&self) -> bool {
        self.error_count() >= ENOUGH
    }

    /// How many errors there are so far.
    pub(crate) fn error_count(&self) -> usize {
        self.error_count.get()
    }

    /// A value as it stands in the file, safe to print.
    pub(crate) fn quoted(&self, node: &Node) -> String {
        escaped(self.sources.borrow().slice(&node.at), QUOTED)
    }

    /// Hands out the texts, the errors and the warnings.
    pub(crate) fn into_parts(self) -> (Sources, Vec<LocatedError>, Vec<Remark>) {
        let mut errors = self.errors.into_inner();
        for misspelt in self.perhaps_misspelt.into_inner() {
            let count = errors.len();
            errors.retain(|error| error.at != misspelt.at);
            // Whoever adds a whole block means it.
            if errors.len() < count {
                errors.push(misspelt);
            }
        }
        (self.sources.into_inner(), errors, self.remarks.into_inner())
    }
}
