//! Clonal mosaic: the pattern that dividing cells of several types leave on a surface.

pub mod atlas;
pub mod noise_pattern;
pub mod patch;
pub mod shapes;
pub mod surface;
pub use self::surface::Surface;
