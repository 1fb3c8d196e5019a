//! What the integration tests share: statistics, quadrature, pictures and random bits.

pub mod chi_square;
pub mod directional;
pub mod golden;
pub mod mixer;
pub mod picture;
