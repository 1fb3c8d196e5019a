//! How a picture is read.

use glam::DVec2;

use super::error::TraceError;
use super::grid::Raster;

/// Whether veins are darker or brighter than the tissue between them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Ink {
    /// Darker: stained veins, a drawing.
    #[default]
    Dark,
    /// Brighter: a leaf against the light, a mask in white.
    Bright,
}

/// The level that parts veins from tissue.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Threshold {
    /// The level that parts the grey values of the blade best (\[otsu1979\]).
    Otsu {
        /// Whether the light is made even before.
        even_light: bool,
    },
    /// A level for each pixel from the mean and the deviation about it (\[sauvola2000\]).
    Sauvola {
        /// Side of the window, pixels.
        window_px: f64,
        /// How far the level is below the mean where nothing varies, as a share of it.
        k: f64,
    },
    /// A grey value, 0 to 1.
    Level(f64),
}

/// What the blade is.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Blade {
    /// What stands out from the background at the picture's frame.
    #[default]
    Silhouette,
    /// What stands out from the background of another picture of the same size.
    Of(Raster),
    /// The whole picture: a piece cut out of a leaf.
    Frame,
}

/// How a picture is traced.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Side of a pixel, mm, > 0.
    pub mm_per_pixel: f64,
    /// What the blade is.
    pub blade: Blade,
    /// Whether veins are dark or bright.
    pub veins: Ink,
    /// The level that parts veins from tissue.
    pub threshold: Threshold,
    /// Standard deviation of the Gaussian against noise before the level is taken, pixels, 0 to 20.
    pub smoothing_px: f64,
    /// By how much of its own radius a vein with a free end must jut out of the vein on which it
    /// stands; what juts out less is a spur, 0 to 100.
    pub spur_radii: f64,
    /// Two junctions are one crossing if they are nearer than so many times the sum of the radii of
    /// the finest veins at both, 0 to 10.
    pub crossing_radii: f64,
    /// Area of the largest hole between veins that is filled, and of the largest speck that is left
    /// out, pixels.
    pub speck_px: usize,
    /// Length of the pieces of veins, mm, at least a pixel; `None` takes the median width of the
    /// veins, but at least
    /// 4 pixels.
    pub segment_mm: Option<f64>,
    /// Where the petiole meets the blade, pixels from the upper left corner, if it is known.
    pub base_px: Option<DVec2>,
    /// Where the apex is, pixels from the upper left corner; else it is the point of the margin
    /// farthest from the base.
    pub apex_px: Option<DVec2>,
}

impl Settings {
    /// The usual settings for a picture with pixels of a size in millimetres.
    pub fn new(mm_per_pixel: f64) -> Self {
        Self {
            mm_per_pixel,
            blade: Blade::default(),
            veins: Ink::default(),
            threshold: Threshold::Otsu { even_light: true },
            smoothing_px: 0.7,
            spur_radii: 2.5,
            crossing_radii: 1.5,
            speck_px: 16,
            segment_mm: None,
            base_px: None,
            apex_px: None,
        }
    }

    pub(super) fn check(&self) -> Result<(), TraceError> {
        if !(self.mm_per_pixel.is_finite() && self.mm_per_pixel > 0.0) {
            return Err(TraceError::BadScale(self.mm_per_pixel));
        }
        let bad = |name, value, allowed| {
            Err(TraceError::BadSetting {
                name,
                value,
                allowed,
            })
        };
        for (name, value, most, allowed) in [
            ("smoothing_px", self.smoothing_px, 20.0, "0 to 20"),
            ("spur_radii", self.spur_radii, 100.0, "0 to 100"),
            ("crossing_radii", self.crossing_radii, 10.0, "0 to 10"),
        ] {
            if !(0.0..=most).contains(&value) {
                return bad(name, value, allowed);
            }
        }
        if let Some(value) = self.segment_mm
            && !(value.is_finite() && value >= self.mm_per_pixel)
        {
            return bad("segment_mm", value, "the side of a pixel and above");
        }
        match self.threshold {
            Threshold::Level(value) if !(0.0..=1.0).contains(&value) => {
                bad("threshold", value, "0 to 1")
            }
            Threshold::Sauvola { window_px, .. } if !(3.0..=1e5).contains(&window_px) => {
                bad("window_px", window_px, "3 to 100000")
            }
            Threshold::Sauvola { k, .. } if !(0.0..=1.0).contains(&k) => bad("k", k, "0 to 1"),
            Threshold::Level(_) | Threshold::Sauvola { .. } | Threshold::Otsu { .. } => Ok(()),
        }
    }
}
