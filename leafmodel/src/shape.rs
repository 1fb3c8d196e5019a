//! The flat lamina: its margin, and how it comes to be.

pub mod growth_shape;
pub mod outline;
