//! A picture of veins becomes a margin and a network with radii.
//!
//! - **In**: a [`Raster`] of a cleared leaf, a drawing or a mask, and [`Settings`].
//! - **Out**: [`Traced`]: an [`Outline`] and a [`VenationNetwork`] in millimetres, and what was
//!   found on the way, with places.
//! - **Always true**: the network is valid, its loops are the holes between the veins; the same
//!   picture gives the same bits on every machine and any number of threads.
//! - **Left out**: veins that are narrower than two pixels or as pale as the tissue beside them,
//!   veins that hide behind others: a line drawing is seen, not a leaf. Files and their formats.
//!
//! The steps, each a published one, stand in `docs/src/theory/tracing.md`: blade against
//! background, light made even, a level (\[otsu1979\] or \[sauvola2000\]), distances
//! (\[felzenszwalb2012\]), thinning in the order of distances (\[pudney1998\]), a graph, spurs and
//! crossings, radii across the veins, smooth lines, directions and orders.
//!
//! ```
//! use leafmodel::tracing::{Blade, Raster, Settings, trace};
//!
//! // A dark cross, 5 pixels wide, on a bright square that is the whole picture.
//! let dark = |at: usize| (48..53).contains(&(at % 101)) || (48..53).contains(&(at / 101));
//! let values = (0..101 * 101).map(|at| if dark(at) { 0.2 } else { 0.9 });
//! let picture = Raster::new(101, 101, values.collect())?;
//! let settings = Settings { blade: Blade::Frame, ..Settings::new(0.01) };
//! let traced = trace(&picture, &settings)?;
//! assert_eq!(traced.network.loops(), 0);
//! let radius = traced.network.edges()[0].radius_from;
//! assert!((radius - 0.025).abs() < 0.002, "{radius} mm");
//! # Ok::<(), leafmodel::tracing::TraceError>(())
//! ```

mod assembly;
mod components;
mod curves;
mod distance;
mod findings;
mod frame;
mod graph;
mod grid;
mod light;
mod lines;
mod margin;
mod pruning;
mod radii;
mod silhouette;
#[cfg(test)]
mod testing;
#[cfg(test)]
mod tests;
mod thinning;
mod through;

use glam::DVec2;
use thiserror::Error;

pub use self::findings::{Finding, FindingKind};
pub use self::frame::Frame;
use self::grid::Mask;
pub use self::grid::Raster;
use crate::shape::outline::{Outline, OutlineError};
use crate::venation::network::{NetworkError, VenationNetwork};

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

    fn check(&self) -> Result<(), TraceError> {
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

/// What a picture shows.
#[derive(Clone, Debug)]
pub struct Traced {
    /// The margin, mm: the base is the origin, the apex lies on +y.
    pub outline: Outline,
    /// The veins, mm, in the same frame.
    pub network: VenationNetwork,
    /// What was found on the way.
    pub findings: Vec<Finding>,
    /// How places of the picture become millimetres.
    pub frame: Frame,
}

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

/// Traces the margin and the veins of a picture.
///
/// # Errors
///
/// [`TraceError`].
pub fn trace(picture: &Raster, settings: &Settings) -> Result<Traced, TraceError> {
    settings.check()?;
    let (width, height) = (picture.width(), picture.height());
    for (end, place) in [("base", settings.base_px), ("apex", settings.apex_px)] {
        let Some(DVec2 { x, y }) = place else {
            continue;
        };
        if !((0.0..=width as f64).contains(&x) && (0.0..=height as f64).contains(&y)) {
            return Err(TraceError::OffPicture {
                end,
                x,
                y,
                width,
                height,
            });
        }
    }
    let mut blade = match &settings.blade {
        Blade::Silhouette => silhouette::silhouette(picture)?,
        Blade::Of(other) => {
            if [other.width(), other.height()] != [width, height] {
                return Err(TraceError::OtherSize {
                    blade: [other.width(), other.height()],
                    veins: [width, height],
                });
            }
            silhouette::silhouette(other)?
        }
        Blade::Frame => Mask::new(width, height, |_, _| true),
    };
    let mut findings = Vec::new();
    let ink = light::ink(picture, &blade, settings)?;
    let hairlines = light::hairlines(picture, settings);
    let mut veins = Mask::new(width, height, |x, y| {
        let at = y * width + x;
        let is_vein = ink.values()[at] > 0.0 || hairlines.as_ref().is_some_and(|lines| lines[at]);
        is_vein && blade.cells[blade.cell(x, y)]
    });
    findings::clean(&mut veins, settings.speck_px, &mut findings);
    let mut squares = distance::squared_distances(&veins);
    let joint = if matches!(settings.blade, Blade::Frame) {
        None
    } else {
        let widest = f64::from(squares.iter().copied().max().unwrap_or(0)).sqrt();
        let joint = silhouette::take_off_petiole(&mut blade, &veins, widest);
        if joint.is_some() {
            for (vein, in_blade) in veins.cells.iter_mut().zip(&blade.cells) {
                *vein &= in_blade;
            }
            squares = distance::squared_distances(&veins);
        }
        joint
    };
    if veins.count() == 0 {
        return Err(TraceError::NoVeins(
            "no pixel of the blade is one of a vein".to_owned(),
        ));
    }
    let thin = thinning::thinned(veins, &squares);
    let graph = graph::graph_of(&thin, &squares);
    drop((thin, squares));
    let lines = lines::lines(graph, &ink, settings, &mut findings)?;
    frame::in_millimetres(&lines, &blade, joint, settings, findings)
}
