//! What a venation simulation is told. Lengths are in vein segments, `D = 1`.

/// Whether veins may meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pattern {
    /// Veins branch and never meet (section 3).
    Open,
    /// Veins meet and enclose areoles (section 4).
    Closed,
}

/// How the lamina grows while veins form.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Growth {
    /// The lamina has its final size from the start.
    None,
    /// The margin moves outward, tissue inside stays where it is; `σ` is linear in time.
    Marginal {
        /// Length of the leaf at the start, in segments.
        initial_length: f64,
        /// What is added to the length each step, in segments.
        length_step: f64,
    },
    /// The whole lamina is scaled, veins and sources with it.
    Isogonic {
        /// Length of the leaf at the start, in segments.
        initial_length: f64,
        /// What is added to the length each step, in segments.
        length_step: f64,
    },
}

/// Parameters of Runions et al. 2005; the letters are the paper's.
#[derive(Clone, Debug, PartialEq)]
pub struct VenationPlan {
    /// Open or closed.
    pub pattern: Pattern,
    /// Length of the full-grown leaf in vein segments, > 0; fixes the segment's length in mm.
    pub final_length: f64,
    /// `dk`, a source is used up when a vein comes nearer than this, > 0.
    pub kill_distance: f64,
    /// `bs`, least distance of a new source from other sources, > 0.
    pub source_birth_distance: f64,
    /// `bv`, least distance of a new source from vein nodes, > 0.
    pub vein_birth_distance: f64,
    /// `ρ`, darts per unit area (segments squared) per step, > 0.
    pub darts_per_area: f64,
    /// How the lamina grows.
    pub growth: Growth,
    /// Murray's exponent `n`, > 0; 2 in most of the paper's leaves, 3 in Murray's law.
    pub murray_exponent: f64,
    /// Radius of the finest veins in mm, > 0.
    pub veinlet_radius_mm: f64,
}
