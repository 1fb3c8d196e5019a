//! What is known of a table, instead of being guessed from it.

use leafmodel::document::rows::Form;

/// Unit of wavelengths.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WavelengthUnit {
    /// nm.
    Nanometres,
    /// µm.
    Micrometres,
}

/// Unit of reflectances and transmittances.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ValueUnit {
    /// 0 to 1.
    Fraction,
    /// 0 to 100.
    Percent,
}

/// Unit of angles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AngleUnit {
    /// Degrees.
    Degrees,
    /// Radians.
    Radians,
}

/// Which of two detectors counts where both have measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Overlap {
    /// The first up to the middle, then the second.
    Middle,
    /// The first.
    First,
    /// The second.
    Second,
}

impl WavelengthUnit {
    /// With the words of flags.
    pub const ALL: [(&'static str, Self); 2] =
        [("nm", Self::Nanometres), ("um", Self::Micrometres)];
}

impl ValueUnit {
    /// With the words of flags.
    pub const ALL: [(&'static str, Self); 2] =
        [("fraction", Self::Fraction), ("percent", Self::Percent)];
}

impl AngleUnit {
    /// With the words of flags.
    pub const ALL: [(&'static str, Self); 2] =
        [("degrees", Self::Degrees), ("radians", Self::Radians)];
}

impl Overlap {
    /// With the words of flags.
    pub const ALL: [(&'static str, Self); 3] = [
        ("middle", Self::Middle),
        ("first", Self::First),
        ("second", Self::Second),
    ];
}

/// What was measured of a leaf.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// Reflectance of the adaxial face.
    Reflectance,
    /// Reflectance of the abaxial face.
    Abaxial,
    /// Transmittance.
    Transmittance,
}

impl Measure {
    /// With the words of flags.
    pub const ALL: [(&'static str, Self); 3] = [
        ("reflectance", Self::Reflectance),
        ("abaxial", Self::Abaxial),
        ("transmittance", Self::Transmittance),
    ];
}

/// What is known of a table; all else is found from it, and notes say so.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Known {
    /// How it is written.
    pub form: Form,
    /// Unit of wavelengths.
    pub wavelengths: Option<WavelengthUnit>,
    /// Unit of reflectances and transmittances.
    pub values: Option<ValueUnit>,
    /// Unit of angles.
    pub angles: Option<AngleUnit>,
    /// What the values are whose columns do not say it.
    pub quantity: Option<Measure>,
    /// Which detector counts.
    pub overlap: Option<Overlap>,
    /// The value of bands that were masked.
    pub masked: Option<f64>,
}
