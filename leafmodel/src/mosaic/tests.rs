//! Patterns measured, and what the paper claims of them.

mod claims;
mod statistics;
