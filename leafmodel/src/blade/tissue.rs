//! What the tissue holds at every point of the lamina.

use crate::optics::Contents;

/// Contents between veins, and factors on them in veins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tissue {
    /// Contents of the lamina between veins.
    pub lamina: Contents,
    /// Factor on each of the contents over the middle of a fully developed vein (each ≥ 0; structure ≥ 0,
    /// and the result at least 1). Below 1 for chlorophyll makes veins bright in transmitted light, above 1 dark.
    pub vein_factors: Contents,
    /// Radius, mm, from which a vein counts as fully developed; finer ones take part of the factors.
    pub full_vein_radius_mm: f64,
    /// Width, mm, over which a vein's edge (bundle sheath extension) blends into the lamina, > 0.
    pub sheath_width_mm: f64,
    /// Share by which chlorophyll and carotenoids vary from patch to patch, 0 to 1.
    pub mottle: f64,
    /// Size of those patches, mm, > 0.
    pub mottle_scale_mm: f64,
}
