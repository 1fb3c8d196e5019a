//! Meshes of shapes that are given by numbers.

mod cuboid;
mod disc;
mod drop;
mod globe;
mod lump;
mod masonry;
mod terrain;
#[cfg(test)]
mod tests;

use super::scramble::scramble;

pub use self::cuboid::cuboid;
pub use self::disc::disc;
pub use self::drop::Drop;
pub use self::globe::sphere;
pub use self::lump::Lump;
pub use self::masonry::{Masonry, MasonryPart};
pub use self::terrain::Terrain;

/// Number `number` of a sequence of random numbers in [0, 1).
fn random(seed: u64, number: u64) -> f64 {
    let bits = scramble(scramble(seed) ^ number);
    (bits >> 11) as f64 / (1_u64 << 53) as f64
}
