//! What a path does at its first vertex and after it.

/// What a path does at its first vertex and after it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// Throughput below which roulette is played; 0 switches it off.
    pub roulette_below: f32,
    /// Paths that go on from the first vertex where no sampled light reached it, ≥ 1.
    pub branches: u32,
    /// Light samples at the first vertex, apart from those of suns, ≥ 1.
    pub light_samples: u32,
}
