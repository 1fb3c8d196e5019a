//! What a sheet is made of.

use super::tensor::{Stiffness, Tensor};

/// What a cell of the sheet is made of. Forces are newtons, lengths millimetres.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Patch {
    /// Young's modulus times thickness, N/mm.
    pub(crate) stretch: f64,
    /// Young's modulus times the cube of the thickness over 12, N mm.
    pub(crate) bend: f64,
    /// How the lamina has grown: a symmetric factor on lengths; 1, 1, 0 is not at all.
    pub(crate) growth: Tensor,
    /// Curvature that the lamina has acquired, 1/mm, positive where it is concave above.
    pub(crate) curvature: Tensor,
    /// Stiffness of veins against stretching and bending along themselves, over the cell's area.
    pub(crate) veins: [Stiffness; 2],
    /// Factor by which veins have grown.
    pub(crate) veins_growth: f64,
    /// Curvature along themselves that veins have acquired, 1/mm, positive if concave above.
    pub(crate) veins_curvature: f64,
    /// Weight over area, N/mm².
    pub(crate) weight: f64,
}
