//! Clonal mosaic: the pattern that dividing cells of several types leave on a surface.

pub mod noise_pattern;
pub mod shapes;
