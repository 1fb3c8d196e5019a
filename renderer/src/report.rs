//! What commands have found, written for people and for other programs: tables, JSON, drawings, pages.
//!
//! - **In**: findings of other modules.
//! - **Out**: texts and bytes of files.
//! - **Always true**: the same findings give the same bytes; no name is read as markup or as a column.
//! - **Left out**: where files go, and what is found.

pub(crate) mod bsdf_check;
pub(crate) mod comparison;
pub(crate) mod fit;
pub(crate) mod instruments;
pub(crate) mod measures;
pub(crate) mod optics;
pub(crate) mod page;
pub(crate) mod table;
pub(crate) mod tracing;
pub(crate) mod vein_fit;
pub(crate) mod warnings;
