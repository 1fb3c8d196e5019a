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

pub use self::cuboid::cuboid;
pub use self::disc::disc;
pub use self::drop::Drop;
pub use self::globe::sphere;
pub use self::lump::Lump;
pub use self::masonry::{Masonry, MasonryPart};
pub use self::terrain::Terrain;
