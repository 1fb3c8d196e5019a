//! Measures of a leaf's shape and veins as used in biology.
//!
//! - **In**: an [`Outline`]; for veins also a [`VenationNetwork`] and the exponent of Murray's law.
//! - **Out**: [`Measures`]: a list of keys, units and values, which can be written as JSON or as a
//!   table.
//! - **Always true**: no value is NaN or infinite; a measure that does not exist (the median area
//!   without areoles) is missing. The same network gives the same bits on every machine.
//! - **Left out**: pictures of leaves, of which [`crate::tracing`] makes margins and networks.
//!
//! `docs/src/theory/measures.md` defines every measure.
//!
//! ```
//! use leafmodel::measure::measure;
//! use leafmodel::species;
//!
//! let plan = species::find("poplar").ok_or("the poplar is a preset")?.plan();
//! let lamina = plan.grow_lamina()?;
//! let measures = measure(&lamina.outline, &lamina.network, plan.venation.murray_exponent());
//! for key in ["width_over_length", "vein_density_mm_per_mm2", "areoles_per_mm2"] {
//!     let value = measures.number(key).ok_or("a poplar has a blade, veins and areoles")?;
//!     assert!(value > 0.0, "{key} = {value}");
//! }
//! print!("{}", measures.table());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod bootstrap;
mod bridges;
pub mod comparison;
mod cost;
mod definitions;
pub mod description;
mod distributions;
mod entries;
pub mod fitting;
mod forks;
mod fourier;
mod hierarchy;
mod junctions;
mod laplacian;
mod list;
mod margin;
mod nesting;
pub mod projections;
#[cfg(test)]
mod shape_tests;
mod skeleton;
mod spanning;
mod statistics;
mod structure;
mod subject;
mod supply;
#[cfg(test)]
mod tests;
mod window;

pub use self::bootstrap::Interval;
pub use self::cost::OrderRow;
pub use self::definitions::{definition, keys};
pub use self::distributions::Sample;
pub use self::entries::{Entry, Measures, Row, Value};
use self::list::List;
pub use self::nesting::Merge;
pub use self::structure::{Structure, StructureBin};
pub use self::subject::{Blade, Known, Subject};
pub use self::supply::{Cut, OrderLoss, Supply};
use crate::shape::outline::Outline;
use crate::venation::network::VenationNetwork;

/// Measures the shape of a blade.
///
/// \[kuhl1982\] for the elliptic Fourier descriptors; `docs/src/theory/measures.md` defines all.
pub fn shape(outline: &Outline) -> Measures {
    let mut list = List::new(Some(outline.area()));
    list.shape(Some(outline));
    list.measures()
}

/// Measures the shape and the veins of a leaf.
///
/// `murray_exponent` is the exponent `n` of `murray_ratio_median`; if it is not finite and above 0,
/// that value is missing. Takes about twice as long as finding the areoles.
pub fn measure(outline: &Outline, network: &VenationNetwork, murray_exponent: f64) -> Measures {
    Subject::new(Blade::Margin(outline), network, Known::ALL).measures(murray_exponent)
}
