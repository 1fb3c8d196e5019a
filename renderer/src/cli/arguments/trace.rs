//! `lamina trace`, as written.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::numbers::{MOST_GIB, between, number, two_numbers};

/// Examples of the command.
pub(super) const EXAMPLES: &str = "\
Examples:
  lamina trace scan.tif --mm-per-pixel 0.00635 --out veins.graphml veins.svg --overlay seen.png
  lamina trace cleared.png --mm-per-pixel 0.002 --cut-out --measure veins.json
  lamina trace veins.png --mask --bright --margin blade.png --mm-per-pixel 0.01 --out veins.json";

/// How veins are parted from tissue.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ThresholdKind {
    /// By Otsu's level after the light was made even
    Otsu,
    /// By Otsu's level in the grey values as they are
    OtsuPlain,
    /// By the mean and the deviation in a window about each pixel
    Sauvola,
}

/// `lamina trace`.
#[derive(Args, Clone, Debug, PartialEq)]
pub struct TraceArguments {
    /// The picture: a cleared leaf, a drawing or a mask of veins, as PNG, TIFF or JPEG
    #[arg(value_name = "PICTURE")]
    pub picture: PathBuf,
    /// Side of a pixel, mm: 25.4 over the dots per inch of a scan
    #[arg(long, value_name = "MM", value_parser = positive)]
    pub mm_per_pixel: f64,
    /// Files to write, their kind by their ending: svg, png, json, graphml, geojson
    #[arg(long, value_name = "FILE", num_args = 1..)]
    pub out: Vec<PathBuf>,
    /// Write measures of margin and veins as JSON, and print them as a table
    #[arg(long, value_name = "FILE.json")]
    pub measure: Option<PathBuf>,
    /// Exponent of Murray's law for the measures
    #[arg(long, value_name = "N", default_value_t = 3.0, value_parser = positive)]
    pub murray_exponent: f64,
    /// Write the picture with the margin and the veins drawn over it, to look at
    #[arg(long, value_name = "FILE.png")]
    pub overlay: Option<PathBuf>,
    /// Write what was found on the way, with its places in pixels, as JSON
    #[arg(long, value_name = "FILE.json")]
    pub findings: Option<PathBuf>,
    /// The picture is a mask: its level is the middle grey. It shows no blade, so --margin or
    /// --cut-out says what that is
    #[arg(long)]
    pub mask: bool,
    /// A picture of the same size in which the blade stands out from its background
    #[arg(long, value_name = "PICTURE", conflicts_with = "cut_out")]
    pub margin: Option<PathBuf>,
    /// The picture is a piece cut out of a leaf: all of it is blade
    #[arg(long)]
    pub cut_out: bool,
    /// Veins are brighter than the tissue between them
    #[arg(long)]
    pub bright: bool,
    /// How veins are parted from tissue
    #[arg(
        long,
        value_name = "KIND",
        value_enum,
        default_value_t = ThresholdKind::Otsu,
        conflicts_with_all = ["level", "mask"]
    )]
    pub threshold: ThresholdKind,
    /// The grey value that parts veins from tissue, 0 (black) to 1 (white), instead of one that is
    /// found
    #[arg(long, value_name = "GREY", conflicts_with = "mask")]
    pub level: Option<f64>,
    /// Side of the window of --threshold sauvola, pixels; 61 if it is not given
    #[arg(long, value_name = "PIXELS", conflicts_with_all = ["level", "mask"])]
    pub window_px: Option<f64>,
    /// How far the level of --threshold sauvola lies below the mean where nothing varies, as a
    /// share of it; 0.2 if it is not given
    #[arg(long, value_name = "SHARE", conflicts_with_all = ["level", "mask"])]
    pub sauvola_k: Option<f64>,
    /// Standard deviation of the Gaussian against noise, pixels, 0 to 20
    #[arg(long, value_name = "PIXELS", default_value_t = 0.7)]
    pub smoothing_px: f64,
    /// By how many of its own radii a vein with a free end must jut out of the vein on which it
    /// stands; what juts out less is cut off
    #[arg(long, value_name = "RADII", default_value_t = 2.5)]
    pub spur_radii: f64,
    /// Two junctions are one crossing if they are nearer than so many times the radii of the finest
    /// veins at both
    #[arg(long, value_name = "RADII", default_value_t = 1.5)]
    pub crossing_radii: f64,
    /// Area of the largest speck that is left out and of the largest hole in a vein that is filled,
    /// pixels
    #[arg(long, value_name = "PIXELS", default_value_t = 16)]
    pub speck_px: u32,
    /// Length of the pieces of veins, mm; the default is the veins' median width, at least 4 pixels
    #[arg(long, value_name = "MM", value_parser = positive)]
    pub segment_mm: Option<f64>,
    /// Where the petiole meets the blade, pixels from the upper left corner, if it is not where the
    /// widest vein meets the margin
    #[arg(long, value_name = "X,Y", value_parser = place)]
    pub base: Option<[f64; 2]>,
    /// Where the apex is, pixels from the upper left corner, if it is not the point of the margin
    /// farthest from the base
    #[arg(long, value_name = "X,Y", value_parser = place)]
    pub apex: Option<[f64; 2]>,
    /// Pixels along the longer side of a png
    #[arg(
        long,
        value_name = "PIXELS",
        default_value_t = 1600,
        value_parser = clap::value_parser!(u32).range(16..=16_384)
    )]
    pub size: u32,
    /// Memory that tracing may take; the default is what the machine has free
    #[arg(long, value_name = "GIB", value_parser = between::<0, MOST_GIB>)]
    pub memory: Option<f64>,
    /// Threads; the default is one for each processor
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
}

/// A number above 0.
fn positive(text: &str) -> Result<f64, String> {
    let messages = [
        "not a number; write one above 0",
        "must be finite and above 0",
    ];
    number(text, |number| number.is_finite() && number > 0.0, messages)
}

/// A place in pixels.
fn place(text: &str) -> Result<[f64; 2], String> {
    let wanted = "not a place; write pixels from the left and from the top: 512,1800";
    two_numbers(text, wanted)
}
