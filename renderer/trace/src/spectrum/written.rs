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

impl Spectrum {
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
