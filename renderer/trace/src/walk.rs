//! One walk of light through a scene: what pictures and instruments share.
//!
//! - **In**: surfaces and media of a [`World`](crate::world::World), a ray with what it
//!   carries, random numbers.
//! - **Out**: whatever a walk makes of what the light meets: radiance of a path from the camera,
//!   or the flux that a detector counts.
//! - **Always true**: light meets the same surfaces, flies through media, passes boundaries and ends
//!   by Russian roulette in the same way, wherever it comes from.
//! - **Left out**: light samples and their weights, which pictures add; detectors and ledgers, which
//!   instruments add.

pub mod cone;
pub mod encounter;
pub mod facet;
mod flight;
mod follow;
pub mod leaf_walk;
mod roulette;
mod scatterer;

pub use self::flight::{Ahead, Boundary, Collision, Passage};
pub use self::follow::{Arrival, Leg, Walk};
pub use self::roulette::roulette;
pub use self::scatterer::Scatterer;
