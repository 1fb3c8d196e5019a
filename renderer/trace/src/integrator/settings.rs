//! How light is followed.

/// How light is followed.
#[derive(Clone, Copy, Debug)]
pub struct Integrator {
    /// Greatest number of scattering events of a path; `None` is no limit.
    pub max_depth: Option<u32>,
    /// Number of events after which a path is cut.
    pub max_events: u32,
    /// Throughput below which Russian roulette is applied; 0 switches it off, `None` leaves it to a
    /// trial.
    pub roulette_below: Option<f64>,
    /// Number of paths that continue from the first vertex if no sampled light reaches it; `None`
    /// leaves it to a trial.
    pub branches: Option<u32>,
    /// Number of paths that continue from the first vertex if a sampled light reaches it; `None`
    /// leaves it to a trial.
    pub lit_branches: Option<u32>,
    /// Number of light samples at the first vertex; `None` leaves it to a trial.
    pub light_samples: Option<u32>,
    /// Whether skies and environment pictures are sampled as lamps are, or left to bounces; `None`
    /// leaves it to a trial.
    pub sample_skies: Option<bool>,
}

impl Default for Integrator {
    fn default() -> Self {
        Self {
            max_depth: None,
            // Roulette ends paths long before, unless light is caught in what absorbs nothing, as in a
            // medium so dense that its free paths are below the precision of places.
            max_events: 100_000,
            roulette_below: None,
            branches: None,
            lit_branches: None,
            light_samples: None,
            sample_skies: None,
        }
    }
}
