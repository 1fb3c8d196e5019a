//! How plans are carried out, as far as the plans themselves do not say it.
//!
//! What has a plan grows with default options by its own `grow`, such as
//! [`Leaf::grow`](crate::leaf::Leaf::grow). A program that must be able to stop makes options first:
//!
//! ```
//! use std::cell::Cell;
//!
//! use leafmodel::grow_options::GrowOptions;
//! use leafmodel::species;
//!
//! let plan = species::find("birch").ok_or("the birch is a preset")?.plan();
//! let steps = Cell::new(0);
//! let is_stopped = || {
//!     steps.set(steps.get() + 1);
//!     steps.get() > 5
//! };
//! let options = GrowOptions { is_stopped: &is_stopped, ..GrowOptions::default() };
//! let error = options.leaf(&plan).expect_err("its veins take more steps");
//! assert!(error.is_stop());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

/// Most cells of a mosaic by default.
pub(crate) const MOST_CELLS: usize = 4_000_000;

/// What decides how far growth goes, beside a plan.
///
/// Its methods grow laminas, leaves, their mosaics and bodies of solid tissue. Results that are complete do not depend on it.
#[derive(Clone, Copy)]
pub struct GrowOptions<'a> {
    /// Growth ends with an error once this function returns true. It is called at each step of veins and at
    /// each event of a mosaic.
    pub is_stopped: &'a dyn Fn() -> bool,
    /// A mosaic with more cells is refused.
    pub most_cells: usize,
    /// Where the results of expensive stages are kept from one run to another; nowhere if it is `None`.
    pub kept: Option<&'a dyn Kept>,
}

/// A store of results of stages of growth.
pub trait Kept: Sync {
    /// The value that was kept under a key; `None` if there is none, or none that can be trusted.
    fn take(&self, stage: &str, key: &str) -> Option<Vec<u8>>;

    /// Keeps a value, if it can.
    fn keep(&self, stage: &str, key: &str, value: &[u8]);
}

impl Default for GrowOptions<'_> {
    /// Growth that nobody stops, with at most 4 million cells.
    fn default() -> Self {
        Self {
            is_stopped: &|| false,
            most_cells: MOST_CELLS,
            kept: None,
        }
    }
}

impl<'a> GrowOptions<'a> {
    /// Default options, but for growth that this function stops.
    pub fn stopped_by(is_stopped: &'a dyn Fn() -> bool) -> Self {
        Self {
            is_stopped,
            ..Self::default()
        }
    }
}
