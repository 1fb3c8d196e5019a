//! Pixels of a display: what files for looking at hold.

use serde::{Deserialize, Serialize};

/// Bits of a value.
#[derive(Clone, Copy, Debug, Deserialize, Eq, PartialEq, Serialize)]
pub enum Depth {
    /// 0 to 255.
    Eight,
    /// 0 to 65535.
    Sixteen,
}

impl Depth {
    /// The greatest value.
    pub fn most(self) -> u16 {
        match self {
            Self::Eight => 255,
            Self::Sixteen => 65535,
        }
    }
}

/// Pixels to be written: sRGB values, by row from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pixels {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Bits of each value.
    pub depth: Depth,
    /// 3 for colours, 4 with alpha behind them.
    pub channels: u8,
    /// `channels` values for each pixel.
    pub values: Vec<u16>,
}
