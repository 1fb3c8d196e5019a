//! How the veins of a transport leaf are drawn.

use crate::document::Declared;
/// How the veins are drawn from the numbers of cells that they supply.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct VeinStyle {
    /// Radius of the midrib at the base; elsewhere it goes with the root of what is supplied.
    #[key("base_radius_mm", required, 1e-4..=100.0)]
    pub base_radius_mm: f64,
    /// Veins that supply fewer cells are left out.
    #[key("least_cells", 1..=1_000_000)]
    pub least_cells: u32,
}

impl Default for VeinStyle {
    fn default() -> Self {
        Self {
            base_radius_mm: 0.6,
            least_cells: 3,
        }
    }
}
