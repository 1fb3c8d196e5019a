//! Following light: one path, and all the paths of a picture.

pub mod develop;
pub mod effort;
pub mod features;
pub mod layers;
pub mod mis;
pub mod noise;
pub mod path;
pub mod render;
