//! Contents of tissue, uniform or from a map.

use glam::Vec2;
use optics::{Contents, Texel};

use super::contents_texture::ContentsTexture;

/// Contents of tissue per area of its surface.
#[derive(Clone, Debug)]
pub enum Held {
    /// Uniform contents.
    Uniform(Contents),
    /// Contents from a map.
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

    /// Whether the contents are uniform.
    pub fn is_uniform(&self) -> bool {
        matches!(self, Self::Uniform(_))
    }
}
