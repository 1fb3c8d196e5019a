//! The same scene for other programs, and flat drawings of veins.
//!
//! Exporters read what the tracer reads, the resolved [`Description`](crate::scene::description::Description) and the
//! [`World`](crate::scene::world::World) built from it, so that two programs get one input.

pub mod drawing;
pub mod mitsuba;
