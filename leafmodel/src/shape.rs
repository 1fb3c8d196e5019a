//! The flat lamina: its margin, and how it comes to be.

pub mod outline;
