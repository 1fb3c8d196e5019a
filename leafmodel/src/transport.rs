//! A leaf grown as the cheapest transport network.
//!
//! Water comes in at the root and goes to square cells. It is cheaper to carry much together (`α`)
//! and to carry it straight on (`β`). A cell comes into being wherever what it earns, `ε` per area,
//! pays for its transport; then cells look for better parents; and as `ε` rises, the leaf grows.
//! Shape and veins follow from that.
//!
//! - **In**: a [`TransportPlan`].
//! - **Out**: a [`TransportLeaf`]: cells, parents, weights, cost, stages; from it an outline and a
//!   network as of any other leaf. A [`FilledPlan`] turns it around: the outline is given, and the
//!   network that supplies it is looked for.
//! - **Always true**: cells touch by an edge or a corner; weights balance; no change of one parent
//!   (in mirrored leaves of a pair) makes the transport cheaper; with even light both sides are
//!   mirror images; same plan and seed, same bits.
//! - **Left out**: the cheapest network of all, which nobody can find for many cells: this one is
//!   only cheaper than all that differ from it by one parent.
//!
//! # Source
//!
//! \[xia2007\]; `docs/src/theory/transport-leaf.md` tells what it leaves open and how that is
//! settled.
//!
//! ```
//! use leafmodel::transport::{Ladder, TransportPlan};
//!
//! // Carrying much together is cheap (`alpha`), bends are dear (`beta`); cells come as long as they pay for their transport.
//! let plan = TransportPlan { alpha: 0.6, beta: 0.5, epsilon: 5.0, ladder: Ladder::Equal(40), ..TransportPlan::default() };
//! let leaf = plan.grow(1)?;
//! assert!(leaf.is_mirrored());
//! assert!(leaf.cells().len() > 50);
//! // The veins are the ways on which water comes to the cells.
//! let margin = leaf.outline(50.0)?;
//! assert!((margin.length() - 50.0).abs() < 1e-9);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod blade;
mod cells;
mod contour;
mod cost;
mod death_field;
mod examples;
mod filled;
mod growth;
mod leaf;
mod optimiser;
mod plan;
mod revenue;
mod seasons;
mod secondaries;
#[cfg(test)]
mod tests;
mod tree;
mod vein_network;
mod vein_style;
mod walls;
mod year;

pub use self::cells::Cell;
pub use self::cost::TransportSystem;
pub use self::death_field::DeathField;
pub use self::examples::example;
pub use self::filled::{FilledBlade, FilledPlan};
pub use self::leaf::{Stage, TransportLeaf};
pub use self::plan::{Ladder, TransportError, TransportPlan};
pub use self::secondaries::Secondary;
pub use self::vein_style::VeinStyle;
pub use self::year::Year;
