//! The lamina in space: mesh, relief, and what the tissue holds where.

pub mod tissue;

/// How a flat lamina is bent, and how finely it is meshed. Angles are radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BladeForm {
    /// Angle by which each half is raised about the midrib, towards the adaxial side (0 flat).
    pub fold: f64,
    /// Angle through which the midrib bends from base to apex, towards the abaxial side (0 straight).
    pub curl: f64,
    /// Amplitude of the wave along the margin as a share of the leaf's length, ≥ 0.
    pub ruffle: f64,
    /// Waves along each side of the margin.
    pub ruffle_waves: f64,
    /// Height of vein relief on the abaxial side over the vein's diameter, ≥ 0 (0 none).
    pub relief: f64,
    /// Thickness of the lamina between veins, mm, > 0.
    pub thickness_mm: f64,
    /// Longest edge of the mesh, mm, > 0.
    pub max_edge_mm: f64,
    /// Veins at least this wide (radius, mm) are edges of the mesh and have relief.
    pub meshed_vein_radius_mm: f64,
}
