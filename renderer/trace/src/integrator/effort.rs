//! The amount of work of a path at its first vertex and after it.

use serde::{Deserialize, Serialize};

/// The amount of work of a path at its first vertex and after it.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct Effort {
    /// Throughput below which Russian roulette is applied; 0 switches it off.
    pub roulette_below: f32,
    /// Number of paths that continue from the first vertex if no sampled light reaches it, ≥ 1.
    pub branches: u32,
    /// Number of paths that continue from the first vertex if a sampled light reaches it, ≥ 1.
    pub lit_branches: u32,
    /// Number of light samples at the first vertex, besides those of suns, ≥ 1.
    pub light_samples: u32,
    /// Whether skies and environment pictures are among what is sampled, at every vertex; if not,
    /// bounces find them.
    pub sample_skies: bool,
}

impl Effort {
    /// Whether more than one path may continue from the first vertex.
    pub(super) fn may_branch(&self) -> bool {
        self.branches.max(self.lit_branches) > 1
    }
}
