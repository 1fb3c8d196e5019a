//! How the veins of a transport leaf are drawn.

use super::TransportError;

/// How the veins are drawn from the numbers of cells that they supply.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VeinStyle {
    /// Radius of the midrib at the base, mm, 0.0001 to 100. Elsewhere `r ∝ w^½`, with the number of
    /// supplied cells `w`.
    pub base_radius_mm: f64,
    /// Veins that supply fewer cells are left out; with 1 every cell has a vein. 1 to 1 000 000.
    pub least_cells: u32,
}

impl VeinStyle {
    /// Checks every number.
    ///
    /// # Errors
    ///
    /// [`TransportError::OutOfRange`].
    pub fn validate(&self) -> Result<(), TransportError> {
        let radius = self.base_radius_mm;
        check("base_radius_mm", radius, 1e-4, 100.0, "0.0001 to 100 mm")?;
        let least = f64::from(self.least_cells);
        check("least_cells", least, 1.0, 1e6, "1 to 1000000")
    }
}

/// Checks that a number is in its range.
///
/// # Errors
///
/// [`TransportError::OutOfRange`].
pub(crate) fn check(
    key: &'static str,
    value: f64,
    low: f64,
    high: f64,
    range: &'static str,
) -> Result<(), TransportError> {
    let good = (low..=high).contains(&value);
    good.then_some(())
        .ok_or(TransportError::OutOfRange { key, value, range })
}
