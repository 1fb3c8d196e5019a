//! Leaves grown from biology, as data: outline, veins, blade, contents, optics.
//!
//! Lengths are millimetres, angles radians, numbers `f64`. The crate knows nothing of light
//! paths or images.

pub mod blade;
pub mod compound;
pub mod document;
pub mod export;
pub mod leaf;
pub mod measure;
pub mod mosaic;
pub mod optics;
pub mod plan_file;
pub mod shape;
pub mod solid;
pub mod species;
pub mod transport;
pub mod venation;
