//! How a blade comes to lie: growth in excess at its margin, drying, wilting, rest on the ground.
//!
//! [`BladeForm`](super::BladeForm) says how the blade of a turgid leaf is bent. A [`Stance`] says
//! what has happened to it since. The blade is then an elastic shell (`crate::shell`) in
//! equilibrium: every undulation, curl and crumple follows from what the tissue wants and from its
//! weight. It keeps clear of itself by its thickness, veins included.
//!
//! - **In**: a [`Stance`], margin and veins, the mass of the tissue, a seed.
//! - **Out**: [`Settled`], which moves each point of the bent blade.
//! - **Always true**: the stance of a leaf of which nothing is said moves nothing; same seed, same
//!   bits.
//! - **Left out**: tears, the time that drying takes.

mod plan;
mod posture;
mod settled;
mod tissue;

pub use plan::{Drying, MarginGrowth, Stance, Wilting};
pub(super) use posture::Posture;
pub use settled::Settled;
