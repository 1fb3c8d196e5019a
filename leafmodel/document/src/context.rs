//! What every block needs while it is read: the texts, the folder, and where errors go.

use std::cell::{Cell, RefCell};
use std::path::PathBuf;
use std::rc::Rc;

use super::assets::Assets;
use super::error::{DocumentError, LocatedError};
use super::sections::Names;
use super::source::{Place, Sources, escaped};
use super::tree::Node;

/// Longest piece of the file that a message repeats, in characters.
pub const QUOTED: usize = 60;

/// Most errors that are kept, and most entries that are searched for suggestions. A malicious file
/// must not slow the program down.
pub const ENOUGH: usize = 1000;

/// Something that is allowed but probably not meant.
#[derive(Clone, Debug, PartialEq)]
pub struct Remark {
    /// Stable name of its kind.
    pub code: &'static str,
    /// What is the matter.
    pub message: String,
    /// What to write instead.
    pub help: String,
    /// Where, if at a place.
    pub at: Option<Place>,
}

/// A key that a file may have.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct KnownKey {
    /// Names of all blocks around it, and its own.
    pub path: String,
    /// Whether the block that it belongs to is in the file.
    pub block_is_there: bool,
}

/// Shared by all blocks of one file.
#[derive(Debug)]
pub struct Context {
    /// The folder that paths start at and must not leave.
    pub folder: PathBuf,
    /// Whether spectra go on with their end values outside their tables.
    pub extrapolate: Cell<bool>,
    /// First and last wavelength that spectra must cover, nm, once it is known.
    pub range_nm: Cell<Option<[f64; 2]>>,
    /// Who needs these wavelengths, as messages say it.
    pub needed_by: Cell<&'static str>,
    /// Whether only a part of what it describes is wanted, so that it may lack others.
    pub is_partial: Cell<bool>,
    /// The document, and all that it is made of.
    pub sources: RefCell<Sources>,
    /// The files that it names, as they are found.
    pub inputs: RefCell<Vec<PathBuf>>,
    /// If what the keys are is asked for: every key of every block, see [`KnownKey`].
    pub survey: RefCell<Option<Vec<KnownKey>>>,
    /// Blocks that overrides add, with names like others': errors if what they add is not whole.
    pub perhaps_misspelt: RefCell<Vec<LocatedError>>,
    /// The names of blocks that others refer to, by section.
    pub sections: RefCell<Vec<(&'static str, Rc<Names>)>>,
    /// Who decodes pictures and meshes, if anybody does.
    pub assets: Option<&'static dyn Assets>,
    errors: RefCell<Vec<LocatedError>>,
    error_count: Cell<usize>,
    remarks: RefCell<Vec<Remark>>,
}

impl Context {
    /// Nothing read yet; paths start at `folder`.
    pub fn new(sources: Sources, folder: PathBuf) -> Self {
        Self {
            folder,
            extrapolate: Cell::new(false),
            range_nm: Cell::new(None),
            needed_by: Cell::new("the film"),
            is_partial: Cell::new(false),
            sources: RefCell::new(sources),
            inputs: RefCell::default(),
            survey: RefCell::default(),
            perhaps_misspelt: RefCell::default(),
            sections: RefCell::default(),
            assets: None,
            errors: RefCell::default(),
            error_count: Cell::new(0),
            remarks: RefCell::default(),
        }
    }

    /// The names of a section, if they are known.
    pub fn names(&self, section: &str) -> Option<Rc<Names>> {
        let sections = self.sections.borrow();
        let found = sections.iter().find(|(name, _)| *name == section);
        found.map(|(_, names)| Rc::clone(names))
    }

    /// Notes an error at a place.
    pub fn error(&self, at: &Place, error: DocumentError) {
        self.keep(error, Some(at));
    }

    /// Notes an error of the file as a whole.
    pub fn error_of_the_file(&self, error: DocumentError) {
        self.keep(error, None);
    }

    fn keep(&self, error: DocumentError, at: Option<&Place>) {
        if !self.is_full() {
            let at = at.cloned();
            self.errors.borrow_mut().push(LocatedError { error, at });
        }
        self.error_count.set(self.error_count.get() + 1);
    }

    /// Notes a warning.
    pub fn warn(&self, at: &Place, code: &'static str, message: String, help: &str) {
        self.remarks.borrow_mut().push(Remark {
            code,
            message,
            help: help.to_owned(),
            at: Some(at.clone()),
        });
    }

    /// Whether so many errors were found that looking for more is a waste of time.
    pub fn is_full(&self) -> bool {
        self.error_count() >= ENOUGH
    }

    /// How many errors there are so far.
    pub fn error_count(&self) -> usize {
        self.error_count.get()
    }

    /// A value as it stands in the file, safe to print.
    pub fn quoted(&self, node: &Node) -> String {
        escaped(self.sources.borrow().slice(&node.at), QUOTED)
    }

    /// A place as `file:line:column`, for messages about what shows only after the file is read.
    pub fn shown(&self, at: &Place) -> String {
        self.sources.borrow().shown(at)
    }

    /// Hands out the texts, the errors and the warnings.
    pub fn into_parts(self) -> (Sources, Vec<LocatedError>, Vec<Remark>) {
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
