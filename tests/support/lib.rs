//! What the integration tests share: statistics and quadrature.

pub mod chi_square;
pub mod directional;
pub mod golden;
pub mod picture;
