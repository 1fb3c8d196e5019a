//! The size, samples and seed of a picture.

/// The size, samples and seed of a picture.
#[derive(Clone, Copy, Debug)]
pub struct Job {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Samples a pixel.
    pub spp: u32,
    /// Seed of every random number.
    pub seed: u64,
}
