//! The radiance of a light at infinity as a table, for programs that have no such light.

use crate::spectrum::Curve;

/// Radiance by direction: three weights in the table, each times its spectrum, and a fourth times
/// the ground's.
///
/// Columns run with the azimuth from +x towards +y, rows from the zenith down, as a texel's middle;
/// between the middles weights are linear. A sum of the three below 0 counts as 0.
#[derive(Clone, Debug)]
pub struct RadianceTable<'a> {
    /// Columns and rows.
    pub size: [usize; 2],
    /// Row by row.
    pub weights: Vec<[f32; 4]>,
    /// Spectra where the weights are 1 0 0, 0 1 0 and 0 0 1, W m⁻² sr⁻¹ nm⁻¹.
    pub spectra: [Curve; 3],
    /// Radiance of the ground, and below the horizon; the rows end at the horizon then, not at the nadir.
    pub ground: Option<&'a Curve>,
    /// Azimuth of the left border of the first column, rad.
    pub rotation: f32,
}
