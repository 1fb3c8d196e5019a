//! Why a picture is not traced.

use thiserror::Error;

use crate::shape::outline::OutlineError;
use crate::venation::network::NetworkError;

/// Why a picture cannot be traced.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum TraceError {
    /// The raster is too small or too large, or its values are not numbers (what is wrong).
    #[error("the picture cannot be traced: {0}")]
    BadRaster(String),
    /// The size of a pixel is not finite and above 0 (the size given, mm).
    #[error("a pixel is {0} mm wide; it must be finite and above 0")]
    BadScale(f64),
    /// A setting is out of its range.
    #[error("{name} is {value}; allowed is {allowed}")]
    BadSetting {
        /// Its name.
        name: &'static str,
        /// The value given.
        value: f64,
        /// Its range.
        allowed: &'static str,
    },
    /// The picture of the blade has another size.
    #[error(
        "the picture of the blade has {} × {} pixels, that of the veins {} × {}: they must be of \
         one size", .blade[0], .blade[1], .veins[0], .veins[1]
    )]
    OtherSize {
        /// Pixels across and down of the picture of the blade.
        blade: [usize; 2],
        /// Of the picture of the veins.
        veins: [usize; 2],
    },
    /// Nothing stands out from the background (share of the picture that stands out).
    #[error(
        "there is no leaf in the picture: what stands out from the background at its frame takes \
         {:.2} % of it", 100.0 * .0
    )]
    NoLeaf(f64),
    /// Nothing is background.
    #[error("the leaf fills the whole picture, so that it has no margin in it")]
    NoBackground,
    /// All of the blade has one grey value.
    #[error("no veins stand out from the tissue between them: the blade has one grey value")]
    NoContrast,
    /// What was taken for the blade is not where the veins are (share of the ends and junctions of
    /// veins that lie outside).
    #[error(
        "{:.0} % of the veins lie outside of what was taken for the blade: the background is uneven, or \
         the frame cuts the leaf. Cut the picture to the leaf and a rim of background, or give the blade \
         as a picture of its own", 100.0 * .0
    )]
    VeinsOutside(f64),
    /// No line is left (what was there).
    #[error("no vein is long enough to be a line: {0}")]
    NoVeins(String),
    /// A place that was given is not in the picture.
    #[error("the {end}, ({x}, {y}), is not within the {width} × {height} pixels of the picture")]
    OffPicture {
        /// `base` or `apex`.
        end: &'static str,
        /// Pixels from the left.
        x: f64,
        /// Pixels from the top.
        y: f64,
        /// Pixels across.
        width: usize,
        /// Pixels down.
        height: usize,
    },
    /// The margin is no outline of a blade.
    #[error("the margin that was traced is none: {0}")]
    Outline(#[from] OutlineError),
    /// The veins are no network.
    #[error("the veins that were traced are no network: {0}")]
    Network(#[from] NetworkError),
}
