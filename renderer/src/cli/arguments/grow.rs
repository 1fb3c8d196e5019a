//! `lamina grow`, as written.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::numbers::{MOST_GIB, between, number};
use crate::export::blade::LengthUnit;
use crate::image::animation::Timing;

/// Examples of the command.
pub(super) const EXAMPLES: &str = "\
Examples:
  lamina grow poplar --out poplar.png poplar.graphml
  lamina grow birch --set seed=7 --out birch.ply --measure birch.json
  lamina grow first-leaf/scene.toml#aspen --frames 24 --out aspen.png
  lamina grow poplar --frames 72 --sources --colour age --size 800 --out poplar.gif
  lamina grow birch-autumn --ages 48 --size 600 --out autumn.apng";

/// What the colour of a vein tells.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum VeinColour {
    /// Nothing: all are dark green
    #[default]
    Plain,
    /// The order of the vein
    Order,
    /// When it has grown
    Age,
}

/// Which pictures have a caption.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum CaptionedKinds {
    /// Films, but no png
    #[default]
    Films,
    /// All
    All,
    /// None
    None,
}

/// `lamina grow`.
#[derive(Args, Clone, Debug, PartialEq)]
#[expect(clippy::struct_excessive_bools, reason = "each is a flag of its own")]
pub struct GrowArguments {
    /// A preset, or a file with leaves or a scene, and which leaf if there are several:
    /// scene.toml#beech
    #[arg(
        value_name = "PRESET|FILE.toml[#LEAF]",
        required_unless_present = "list"
    )]
    pub leaf: Option<String>,
    /// Name the presets
    #[arg(long, exclusive = true)]
    pub list: bool,
    /// Tell what a preset is and where its numbers are from
    #[arg(long, requires = "leaf")]
    pub about: bool,
    /// Change a value of the leaf: --set blade.ruffle=0.02; the end of a path is enough where only
    /// one key has it
    #[arg(long, value_name = "KEY=VALUE")]
    pub set: Vec<String>,
    /// Override a value of the file, written as in it: -D leaves.beech.seed=3
    #[arg(short = 'D', value_name = "KEY=VALUE")]
    pub overrides: Vec<String>,
    /// Files to write, their kind by their ending: svg, png, json, graphml, geojson, csv (veins),
    /// gif, apng, mp4 (films, with --frames or --ages), ply, obj (blade; obj with mtl and pictures beside it), toml (plan)
    #[arg(long, value_name = "FILE", num_args = 1..)]
    pub out: Vec<PathBuf>,
    /// Unit of lengths in ply and obj
    #[arg(long, value_name = "UNIT", value_enum, default_value_t)]
    pub units: LengthUnit,
    /// Write every number of the plan into a toml, not only what differs from the preset
    #[arg(long)]
    pub full: bool,
    /// Write drawings and veins at N times from the first step to the last, as STEM-0001.png and so
    /// on, or as a film
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub frames: Option<u32>,
    /// Write the flat leaf in daylight (png or a film) and its maps of contents (--contents) on N
    /// days from green to litter, as STEM-0001.png and so on; for leaves that age by days
    #[arg(long, value_name = "N", conflicts_with = "frames", value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub ages: Option<u32>,
    /// Write N leaves of the plant of which this is one, numbered from 1: their plans into one file
    /// (toml), their margins and veins side by side (svg, png)
    #[arg(long, value_name = "N", conflicts_with_all = ["frames", "ages", "measure", "describe", "fields", "contents", "stats"], value_parser = clap::value_parser!(u16).range(1..=400))]
    pub individuals: Option<u16>,
    /// Write measures of the veins as JSON, and print them as a table
    #[arg(long, value_name = "FILE.json")]
    pub measure: Option<PathBuf>,
    /// Describe the veins that have grown in the terms of the Manual of Leaf Architecture
    #[arg(long)]
    pub describe: bool,
    /// Write what splines (`vein`, `net`, `fac`) or the cells of a transport leaf (`death`) tell
    /// about every point, as an EXR texture
    #[arg(long, value_name = "FILE.exr")]
    pub fields: Option<PathBuf>,
    /// Write the maps of contents into a folder
    #[arg(long, value_name = "DIR")]
    pub contents: Option<PathBuf>,
    /// Write times, memory and counts as JSON
    #[arg(long, value_name = "FILE.json")]
    pub stats: Option<PathBuf>,
    /// Seed, instead of the leaf's
    #[arg(long, value_name = "N")]
    pub seed: Option<u64>,
    /// Threads; the default is one for each processor
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Memory that growing may take; the default is what the machine has free
    #[arg(long, value_name = "GIB", value_parser = between::<0, MOST_GIB>)]
    pub memory: Option<f64>,
    /// What the colour of a vein tells in pictures and films
    #[arg(long, value_name = "WHAT", value_enum, default_value_t)]
    pub colour: VeinColour,
    /// Show the auxin sources of each stage in pictures and films
    #[arg(long)]
    pub sources: bool,
    /// Which pictures have a strip below with scale bar, step or day, and key of colours
    #[arg(long, value_name = "WHICH", value_enum, default_value_t)]
    pub caption: CaptionedKinds,
    /// How fast films are.
    #[command(flatten)]
    pub film: FilmArguments,
    /// Pixels along the longer side of a png, or of a frame without its caption
    #[arg(long, value_name = "PIXELS", default_value_t = 1600, value_parser = clap::value_parser!(u32).range(16..=16_384))]
    pub size: u32,
}

/// How fast films are.
#[derive(Args, Clone, Copy, Debug, PartialEq)]
pub struct FilmArguments {
    /// Frames a second of a film
    #[arg(long, value_name = "N", default_value_t = 12.0, value_parser = frames_a_second)]
    pub fps: f64,
    /// Seconds for which a film shows its last frame
    #[arg(long, value_name = "SECONDS", default_value_t = 1.5, value_parser = between::<0, 60>)]
    pub hold: f64,
}

impl FilmArguments {
    /// The same as the writers of films take it.
    pub fn timing(self) -> Timing {
        Timing {
            frames_per_second: self.fps,
            last_frame_seconds: self.hold,
        }
    }
}

/// Frames a second that films can hold and programs show.
fn frames_a_second(text: &str) -> Result<f64, String> {
    let messages = [
        format!("`{text}` is not a number"),
        "it must be 0.1 to 50".to_owned(),
    ];
    number(text, |value| (0.1..=50.0).contains(&value), messages)
}

impl GrowArguments {
    /// Whether a file of any kind is asked for.
    pub fn writes_anything(&self) -> bool {
        let files = [&self.measure, &self.fields, &self.contents, &self.stats];
        !self.out.is_empty() || self.describe || files.into_iter().any(Option::is_some)
    }
}
