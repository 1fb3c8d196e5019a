//! Shapes that are given by numbers: the keys of each in scenes, and its mesh.

mod cuboid;
mod disc;
mod drop;
mod globe;
mod lump;
mod masonry;
mod rectangle;
mod terrain;
#[cfg(test)]
mod tests;

pub use self::cuboid::Cuboid;
pub use self::disc::Disc;
pub use self::drop::Drop;
pub use self::globe::Sphere;
pub use self::lump::Lump;
pub use self::masonry::{Masonry, MasonryPart};
pub use self::rectangle::Rectangle;
pub use self::terrain::Terrain;
