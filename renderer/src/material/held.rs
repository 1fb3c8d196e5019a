//! What tissue holds, everywhere the same or by place.

use glam::Vec2;
use leafmodel::optics::{Contents, Texel};

use super::contents_texture::ContentsTexture;

/// What tissue holds per area of its surface.
#[derive(Clone, Debug)]
pub enum Held {
    /// The same everywhere.
    Uniform(Contents),
    /// What a map gives.
    Map(ContentsTexture),
}

impl Held {
    /// Contents at texture coordinates `uv`.
    #[inline]
    pub fn at(&self, uv: Vec2) -> Texel {
        match self {
            Self::Uniform(contents) => contents.to_texel(),
            Self::Map(map) => map.at(uv),
        }
    }

    /// Mean contents.
    pub fn mean(&self) -> Contents {
        match self {
            Self::Uniform(contents) => *contents,
            Self::Map(map) => map.mean(),
        }
    }

    /// Whether it is the same everywhere.
    pub fn is_uniform(&self) -> bool {
        matches!(self, Self::Uniform(_))
    }
}
