//! A leaf grown as a cost-minimising transport network.
//!
//! Water enters at the root and is carried to square cells. Carrying water together saves cost
//! (`α`), and turning costs extra (`β`). A cell is added wherever its revenue, `ε` per area, pays
//! for its transport. Then every cell looks for a cheaper parent. The leaf grows as `ε` rises; its
//! shape and its veins follow from that.
//!
//! - **In**: a [`TransportPlan`].
//! - **Out**: a [`TransportLeaf`]: cells, parents, weights, cost and stages. It gives an outline
//!   and a vein network like those of any other leaf. A [`FilledPlan`] grows the network inside a
//!   given outline instead.
//! - **Always true**: cells touch by an edge or a corner; weights balance; no change of a single
//!   parent (in mirrored leaves, of a pair) lowers the cost; with even light both sides are mirror
//!   images; the same plan and seed give the same bits.
//! - **Left out**: the global minimum, which is out of reach for many cells. The network is a local
//!   minimum: no network that differs from it by one parent is cheaper.
//!
//! # Source
//!
//! \[xia2007\]; `docs/src/theory/transport-leaf.md` says what the paper leaves open and what is
//! done here.
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

pub use self::cells::Cell;
pub use self::cost::TransportSystem;
pub use self::death_field::DeathField;
pub use self::examples::example;
pub use self::filled::{FilledBlade, FilledPlan};
pub use self::leaf::{Stage, TransportLeaf};
pub use self::plan::{Ladder, TransportPlan};
pub use self::secondaries::Secondary;
pub use self::vein_style::VeinStyle;
