//! Spectra as written in a scene; paths use a [`Curve`](super::Curve) made from them.

/// A spectrum as written. Its quantity (reflectance, radiance …) depends on its use.
#[derive(Clone, Debug)]
pub enum Spectrum {
    /// The same value at every wavelength.
    Constant(f64),
    /// Linear between wavelengths in nm, which rise strictly.
    Table {
        /// (nm, value) pairs.
        points: Vec<(f64, f64)>,
        /// Whether the end values hold outside the table.
        extrapolate: bool,
    },
    /// CIE standard illuminant D65, relative, 1 at 560 nm, times a factor.
    D65 {
        /// Value at 560 nm.
        scale: f64,
    },
    /// Planck's law, relative, 1 at 560 nm, times a factor.
    Blackbody {
        /// Temperature, K.
        kelvin: f64,
        /// Value at 560 nm.
        scale: f64,
    },
}

impl Default for Spectrum {
    /// No light, or none of it.
    fn default() -> Self {
        Self::Constant(0.0)
    }
}

impl Spectrum {
    /// Whether it is 0 at every wavelength of a range, or at all.
    pub fn is_dark(&self, range_nm: Option<[f64; 2]>) -> bool {
        match self {
            Self::Constant(value) => *value == 0.0,
            Self::Table { points, .. } => {
                let [low, high] = range_nm.unwrap_or([0.0, f64::INFINITY]);
                // A table is 0 between two rows only if both are 0, so the rows just outside the range
                // count too.
                let first = points
                    .partition_point(|(nm, _)| *nm <= low)
                    .saturating_sub(1);
                let last = points
                    .partition_point(|(nm, _)| *nm < high)
                    .min(points.len() - 1);
                points[first.min(last)..=last]
                    .iter()
                    .all(|(_, value)| *value == 0.0)
            }
            Self::D65 { .. } | Self::Blackbody { .. } => false,
        }
    }

    /// This spectrum times a factor.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        match self {
            Self::Constant(value) => Self::Constant(factor * value),
            Self::Table {
                mut points,
                extrapolate,
            } => {
                for (_, value) in &mut points {
                    *value *= factor;
                }
                Self::Table {
                    points,
                    extrapolate,
                }
            }
            Self::D65 { scale } => Self::D65 {
                scale: factor * scale,
            },
            Self::Blackbody { kelvin, scale } => Self::Blackbody {
                kelvin,
                scale: factor * scale,
            },
        }
    }
}
