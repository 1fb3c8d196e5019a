//! The size, samples and seed of a picture.

use serde::{Deserialize, Serialize};

/// The size, samples and seed of a picture.
#[derive(Clone, Copy, Debug, Deserialize, Serialize)]
pub struct Job {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Samples a pixel; for a part of a picture the number behind its last sample.
    pub spp: u32,
    /// Seed of every random number.
    pub seed: u64,
}
