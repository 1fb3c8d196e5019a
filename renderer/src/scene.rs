//! From a scene file to the immutable scene that is traced.
//!
//! - **In**: a TOML file with `format = 1` ([`load::load`]), and overrides from the command line.
//! - **Out**: a [`description::Description`], which both the tracer and the exporters read.
//! - **Always true**: a scene is accepted whole or refused with every error that it has, each at
//!   its place; no file outside the scene's folder is touched.

mod angle;
pub mod assets;
mod blocks;
pub mod description;
pub mod load;
pub mod plant_cache;
pub mod plants;
pub mod world;
