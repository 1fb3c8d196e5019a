//! Following light: one path, and all the paths of a picture.
//!
//! - **In**: a [`World`](crate::world::World), and a [`render::Job`]: pixels, samples, seed.
//! - **Out**: [`render::Rendered`], sums on a film, with one channel after another as [`layers`] lists
//!   them.
//! - **Always true**: the same job gives the same sums, bit for bit, on any number of threads.

pub mod effort;
pub mod features;
mod fluorescence;
pub mod layers;
pub mod mis;
pub mod noise;
pub mod path;
pub mod render;
pub mod sample_map;
pub mod settings;
mod trial;
