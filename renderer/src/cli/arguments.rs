//! The command line as written: what can be asked for, and nothing of how it is done.

mod cache;
mod compare_networks;
mod fit_veins;
mod grow;
mod instruments;
mod measure;
mod measured;
mod model;
mod numbers;
mod optics;
mod reproduce;
mod scene;
mod sweep;
mod tables;
mod tonemap;
mod trace;

use std::ffi::OsString;
use std::path::PathBuf;

use clap::{Args, CommandFactory, FromArgMatches, Parser, Subcommand};
use clap_complete::Shell;

use self::numbers::{MOST_GIB, MOST_SECONDS, between, power_of_two, samples, size};
use crate::export::gltf::Illuminant;
use crate::scene::portrait::Stage;

pub use cache::{CacheArguments, CacheCommandArguments};
pub use compare_networks::{Alignment, CompareNetworksArguments, Group, Groups};
pub use fit_veins::FitVeinsArguments;
pub use grow::{CaptionedKinds, FilmArguments, GrowArguments, VeinColour};
pub use instruments::InstrumentsArguments;
pub use measure::{MeasureArguments, MeasuringArguments, ReadingArguments};
pub use measured::{CheckBsdfArguments, FitArguments};
pub use model::ModelArguments;
pub use numbers::SampleRange;
pub use optics::OpticsArguments;
pub use reproduce::ReproduceArguments;
pub use scene::SceneArguments;
pub use sweep::{SweepArguments, TaskRange};
pub use tables::{ReadingTablesArguments, TableArguments};
pub use tonemap::TonemapArguments;
pub use trace::{ThresholdKind, TraceArguments};

/// What `lamina` prints when nothing is asked for: what it is, the first command, the guide.
pub const GREETING: &str = "\
Lamina renders leaves: grown from biology, lit by spectra, recorded as light.
Render the first leaf:  lamina example first-leaf && lamina render first-leaf/scene.toml
Check a scene file:     lamina check SCENE.toml
All commands:           lamina help
The guide starts at:    docs/src/guide.md";

const EXAMPLE_EXAMPLES: &str = "\
Examples:
  lamina example first-leaf && lamina render first-leaf/scene.toml
  lamina example --list";

const CACHE_EXAMPLES: &str = "\
Examples:
  lamina cache
  lamina cache --clear

The environment variable LAMINA_CACHE names another folder; empty, it turns the cache off.";

const RENDER_EXAMPLES: &str = "\
Examples:
  lamina render first-leaf/scene.toml --spp 16 --out draft
  lamina render first-leaf/scene.toml -D picture.tone=linear -D leaves.aspen.seed=3
  lamina render first-leaf/scene.toml --spp 4096 --noise 0.01 --time 600
  lamina render first-leaf/scene.toml --spp 4096 --resume";

const MERGE_EXAMPLES: &str = "\
Examples:
  lamina render first-leaf/scene.toml --spp 64 --samples 0..32 --out a
  lamina render first-leaf/scene.toml --spp 64 --samples 32..64 --out b
  lamina merge a.part b.part --out leaf";

const CHECK_EXAMPLES: &str = "\
Examples:
  lamina check first-leaf/scene.toml
  lamina check first-leaf/scene.toml -D leaves.aspen.length_mm=120
  lamina check trillium/scene.toml --build";

const TONEMAP_EXAMPLES: &str = "\
Examples:
  lamina tonemap leaf.exr --out leaf.jpg
  lamina tonemap leaf.exr --out leaf.png --tone standard --exposure-ev -0.5 --sixteen-bits";

const OPTICS_EXAMPLES: &str = "\
Examples:
  lamina optics --cab 45 --car 10 --cw 0.011 --cm 0.006 --out leaf.csv
  lamina optics --table leaves.csv --out spectra.csv --preset sun-green
  lamina optics --preset birch-yellow --colour
  lamina optics --preset sun-green --layers layers.csv";

const FIT_EXAMPLES: &str = "\
Examples:
  lamina optics --cab 30 --out leaf.csv && lamina fit leaf.csv
  lamina fit leaves.csv --out contents.csv --spectra-out fitted.csv --plot fitted.svg
  lamina fit visible.csv --range 400..800 --fix water=0.012 --fix dry_matter=0.006
  lamina fit --adaxial upper.sig --abaxial lower.sig --transmittance through.sig";

const GLTF_EXAMPLES: &str = "\
Examples:
  lamina export gltf birch-autumn --out birch.glb
  lamina export gltf first-leaf/scene.toml --out leaves.glb --texture 2048";

const SCHEMA_EXAMPLES: &str = "\
Examples:
  lamina schema --out scene.schema.json
  lamina schema --pages docs/src/format/*.md";

/// An offline spectral renderer of leaves.
#[derive(Clone, Debug, Parser)]
#[command(name = "lamina", version, about, long_about = None)]
pub struct Arguments {
    /// What is to be done; without it the greeting is printed.
    #[command(subcommand)]
    pub command: Option<Command>,
    /// End, with the work saved, when the standard input closes: for programs that start this one,
    /// because their end of it closes however they end
    #[arg(long, global = true, hide_short_help = true)]
    pub end_with_stdin: bool,
    /// A folder outside of a scene's own whose files scenes and leaves may name; may be given several
    /// times; the environment may list more of them
    #[arg(long, global = true, value_name = "DIR", hide_short_help = true)]
    pub allow: Vec<PathBuf>,
}

impl Arguments {
    /// A line as the program reads it: a value that begins as a negative number does (`-3`, `-5%`,
    /// `-5..3`) is joined to the option before it, so that the range of the option is named instead of
    /// a flag that nobody meant.
    pub fn joined(line: impl IntoIterator<Item = impl Into<OsString>>) -> Vec<OsString> {
        let is_option = |word: &OsString| {
            let word = word.as_encoded_bytes();
            word.starts_with(b"--") && word.len() > 2 && !word.contains(&b'=')
        };
        let is_negative = |word: &OsString| match word.as_encoded_bytes() {
            [b'-', b'.', digit, ..] | [b'-', digit, ..] => digit.is_ascii_digit(),
            _ => false,
        };
        let mut joined: Vec<OsString> = Vec::new();
        for word in line.into_iter().map(Into::into) {
            match joined.last_mut() {
                Some(option) if is_option(option) && is_negative(&word) => {
                    option.push("=");
                    option.push(word);
                }
                Some(_) | None => joined.push(word),
            }
        }
        joined
    }

    /// The arguments of a line, the program's name first.
    ///
    /// # Errors
    ///
    /// What is wrong with it, or what it asks to be printed.
    pub fn of_line(
        line: impl IntoIterator<Item = impl Into<OsString>>,
    ) -> Result<Self, clap::Error> {
        Self::from_arg_matches(&Self::command().try_get_matches_from(Self::joined(line))?)
    }
}

/// The subcommands.
#[derive(Clone, Debug, Subcommand)]
pub enum Command {
    /// Write a scene that the program carries into a folder
    #[command(after_help = EXAMPLE_EXAMPLES)]
    Example(ExampleArguments),
    /// Render a scene to STEM.exr and STEM.png, or STEM.jpg
    #[command(after_help = RENDER_EXAMPLES)]
    Render(RenderArguments),
    /// Add up parts of a picture, rendered with --samples, to STEM.exr and STEM.png
    #[command(after_help = MERGE_EXAMPLES)]
    Merge(MergeArguments),
    /// Render a scene, or grow a leaf, with many settings
    #[command(after_help = sweep::EXAMPLES)]
    Sweep(SweepArguments),
    /// Report every error of a scene file, or of a file of leaves
    #[command(after_help = CHECK_EXAMPLES)]
    Check(CheckArguments),
    /// Make a picture to look at from an EXR, without rendering again
    #[command(after_help = TONEMAP_EXAMPLES)]
    Tonemap(TonemapArguments),
    /// Write reflectance and transmittance of a leaf by PROSPECT-D
    #[command(after_help = OPTICS_EXAMPLES)]
    Optics(OpticsArguments),
    /// Find what leaves hold from their reflectance and transmittance
    #[command(after_help = FIT_EXAMPLES)]
    Fit(FitArguments),
    /// Check a measured BRDF or BTDF: reciprocity, its error, its energy
    #[command(after_help = measured::CHECK_BSDF_EXAMPLES)]
    CheckBsdf(CheckBsdfArguments),
    /// Read out the instruments of a scene: what it reflects, transmits and absorbs
    #[command(after_help = instruments::EXAMPLES)]
    Instruments(InstrumentsArguments),
    /// Compute a result again from what its file says, and compare
    #[command(after_help = reproduce::EXAMPLES)]
    Reproduce(ReproduceArguments),
    /// Hand a scene or a leaf to another program
    #[command(subcommand)]
    Export(ExportCommand),
    /// Compare two pictures number by number
    Compare(CompareArguments),
    /// Print what an EXR file holds
    Info(InfoArguments),
    /// Grow a leaf and write its veins, its blade, its contents and measures
    #[command(after_help = grow::EXAMPLES)]
    Grow(GrowArguments),
    /// Measure a network of veins from a file of another program
    #[command(after_help = measure::EXAMPLES)]
    Measure(MeasureArguments),
    /// Compare networks of veins, or groups of leaves: measures, effects, tests, a report
    #[command(after_help = compare_networks::EXAMPLES)]
    CompareNetworks(CompareNetworksArguments),
    /// Find parameters of growth that bring forth the measures of a given leaf
    #[command(after_help = fit_veins::EXAMPLES)]
    FitVeins(FitVeinsArguments),
    /// Trace the margin and the veins of a picture of a leaf: a network with radii, and measures
    #[command(after_help = trace::EXAMPLES)]
    Trace(TraceArguments),
    /// Write what a scene file may hold, as a JSON Schema
    #[command(after_help = SCHEMA_EXAMPLES)]
    Schema(SchemaArguments),
    /// Print what a shell needs to complete commands and flags
    Completions(CompletionsArguments),
    /// Write manual pages
    Man(ManArguments),
    /// Print what is kept of grown leaves, or delete it
    #[command(after_help = CACHE_EXAMPLES)]
    Cache(CacheCommandArguments),
    /// Print the licences of the program and of what it is built from
    Licenses,
}

/// `lamina check`.
#[derive(Args, Clone, Debug, PartialEq)]
pub struct CheckArguments {
    /// Scene and overrides.
    #[command(flatten)]
    pub scene: SceneArguments,
    /// Grow what the scene grows and build it as well, as a render would: tells its size, and what
    /// only then shows
    #[arg(long)]
    pub build: bool,
    /// Memory that a render may take; the default is what the machine has free
    #[arg(long, value_name = "GIB", value_parser = between::<0, MOST_GIB>)]
    pub memory: Option<f64>,
}

/// `lamina render`.
#[derive(Args, Clone, Debug, PartialEq)]
pub struct RenderArguments {
    /// Scene and overrides.
    #[command(flatten)]
    pub scene: SceneArguments,
    /// Stem of the files that are written, with or without `.exr` or `.png`; with `.jpg` a JPEG is
    /// written instead of the PNG; the default is the scene's name in this folder
    #[arg(long, value_name = "STEM")]
    pub out: Option<PathBuf>,
    /// Where a preset is shown that is named instead of a scene
    #[arg(long, value_name = "STAGE", value_enum, default_value_t)]
    pub stage: Stage,
    /// Width and height of the film in pixels, instead of the scene's
    #[arg(long, value_name = "WIDTHxHEIGHT", value_parser = size)]
    pub size: Option<[u32; 2]>,
    /// Samples a pixel, instead of the scene's
    #[arg(long, value_name = "N", value_parser = samples())]
    pub spp: Option<u32>,
    /// Relative error at which a part of the picture has enough samples, instead of the scene's:
    /// 0.01 is one percent, 0 gives every pixel all its samples
    #[arg(long, value_name = "SHARE", value_parser = between::<0, 1>)]
    pub noise: Option<f64>,
    /// Samples by a map instead of a target noise: an EXR of the picture's size with a channel
    /// `samples.Y`, as every picture has one; a block of 8 × 8 pixels gets the most that is named in
    /// it, and of --spp and the map the fewer
    #[arg(long, value_name = "MAP.exr", conflicts_with_all = ["noise", "samples"])]
    pub samples_map: Option<PathBuf>,
    /// Stop rendering after this time, at the end of the pass that is under way; the checkpoint
    /// stays, so that --resume goes on
    #[arg(long, value_name = "SECONDS", value_parser = between::<0, MOST_SECONDS>)]
    pub time: Option<f64>,
    /// Seed of every random number, instead of the scene's
    #[arg(long, value_name = "N")]
    pub seed: Option<u64>,
    /// Threads; the default is one for each processor
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Where grown leaves are kept.
    #[command(flatten)]
    pub cache: CacheArguments,
    /// Write times, memory and speed as JSON
    #[arg(long, value_name = "FILE.json")]
    pub stats: Option<PathBuf>,
    /// Go on from the checkpoint of an earlier run, to the bytes of a run that was never
    /// interrupted
    #[arg(long)]
    pub resume: bool,
    /// The checkpoint, which then stays when the picture is done, for more samples later; the
    /// default is STEM.checkpoint, which is removed unless --time ended the render
    #[arg(long, value_name = "FILE")]
    pub checkpoint: Option<PathBuf>,
    /// Time between checkpoints; longer if to write one takes more than a fiftieth of it
    #[arg(long, value_name = "SECONDS", default_value_t = 60.0, value_parser = between::<0, MOST_SECONDS>)]
    pub checkpoint_every: f64,
    /// Write the picture to look at anew while it is rendered, every 5 seconds or as many as are
    /// given; less often if that takes more than a fiftieth of the time
    #[arg(
        long,
        value_name = "SECONDS",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "5",
        value_parser = between::<0, MOST_SECONDS>,
        conflicts_with = "samples"
    )]
    pub preview: Option<f64>,
    /// Send the picture while it is rendered to the viewer tev, which usually listens at
    /// 127.0.0.1:14158
    #[arg(long, value_name = "HOST:PORT")]
    pub tev: Option<String>,
    /// Memory that the render may take; the default is what the machine has free
    #[arg(long, value_name = "GIB", value_parser = between::<0, MOST_GIB>)]
    pub memory: Option<f64>,
    /// Render only the samples number A to B − 1 of each pixel, into STEM.part for lamina merge
    #[arg(long, value_name = "A..B", value_parser = SampleRange::parse)]
    pub samples: Option<SampleRange>,
}

/// `lamina merge`.
#[derive(Args, Clone, Debug, PartialEq, Eq)]
pub struct MergeArguments {
    /// The parts, in any order
    #[arg(value_name = "FILE.part", required = true)]
    pub parts: Vec<PathBuf>,
    /// Stem of the pictures that are written, with or without `.exr` or `.png`; with `.jpg` a JPEG is
    /// written instead of the PNG
    #[arg(long, value_name = "STEM")]
    pub out: PathBuf,
}

/// `lamina export`.
#[derive(Clone, Debug, Subcommand)]
pub enum ExportCommand {
    /// One glTF file of a scene or of a preset leaf: meshes, textures, instances
    #[command(after_help = GLTF_EXAMPLES)]
    Gltf(GltfArguments),
    /// XML, meshes, maps and spectra for Mitsuba 3
    Mitsuba(MitsubaArguments),
}

/// `lamina export gltf`.
#[derive(Args, Clone, Debug, PartialEq)]
#[expect(clippy::struct_excessive_bools, reason = "each is a flag of its own")]
pub struct GltfArguments {
    /// The scene file, or a preset of a leaf, which becomes an object of its name
    #[arg(value_name = "SCENE.toml|PRESET")]
    pub scene: PathBuf,
    /// Override a value of the scene, written as in the file: -D leaves.birch.seed=3
    #[arg(short = 'D', value_name = "KEY=VALUE")]
    pub overrides: Vec<String>,
    /// File to write
    #[arg(long, value_name = "FILE.glb")]
    pub out: PathBuf,
    /// Light under which colours are seen, to which the eye has adapted
    #[arg(long, value_name = "NAME", value_enum, default_value_t)]
    pub illuminant: Illuminant,
    /// Most texels along a side of a texture, a power of two
    #[arg(long, value_name = "SIZE", default_value_t = 1024, value_parser = power_of_two)]
    pub texture: u32,
    /// Most triangles of a blade, whose margin and holes a mask then shows, and of a stalk, an axis or a hair
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..))]
    pub triangles: Option<u32>,
    /// Write each blade as a card of two triangles, with the pictures of all blades in one
    #[arg(long)]
    pub cards: bool,
    /// Write a node for each place, instead of instances (`EXT_mesh_gpu_instancing`)
    #[arg(long)]
    pub plain_nodes: bool,
    /// Write a leaf as one surface with the adaxial face's colours on both sides, for path tracers,
    /// instead of two surfaces back to back
    #[arg(long)]
    pub one_face: bool,
    /// Add the mean reflectance and transmittance of each material, 400 to 2500 nm, as its `extras`
    #[arg(long, conflicts_with = "cards")]
    pub spectra: bool,
    /// Memory that building the scene may take; the default is what the machine has free
    #[arg(long, value_name = "GIB", value_parser = between::<0, MOST_GIB>)]
    pub memory: Option<f64>,
}

/// `lamina export mitsuba`.
#[derive(Args, Clone, Debug, PartialEq)]
pub struct MitsubaArguments {
    /// Scene and overrides.
    #[command(flatten)]
    pub scene: SceneArguments,
    /// Folder to write into
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Use materials of Mitsuba's own alone, with colours under D65 instead of spectra
    #[arg(long)]
    pub stock: bool,
    /// Memory that building the scene may take; the default is what the machine has free
    #[arg(long, value_name = "GIB", value_parser = between::<0, MOST_GIB>)]
    pub memory: Option<f64>,
}

/// `lamina compare`.
#[derive(Args, Clone, Debug, PartialEq, Eq)]
pub struct CompareArguments {
    /// One picture
    #[arg(value_name = "A.exr")]
    pub first: PathBuf,
    /// The other
    #[arg(value_name = "B.exr")]
    pub second: PathBuf,
}

/// `lamina info`.
#[derive(Args, Clone, Debug, PartialEq, Eq)]
pub struct InfoArguments {
    /// The picture
    #[arg(value_name = "FILE.exr")]
    pub picture: PathBuf,
}

/// `lamina schema`.
#[derive(Args, Clone, Debug, PartialEq, Eq)]
pub struct SchemaArguments {
    /// File to write; the default is stdout
    #[arg(long, value_name = "FILE.json")]
    pub out: Option<PathBuf>,
    /// Write the tables of keys into these pages instead, each behind its marker
    /// `<!-- keys: BLOCK -->`
    #[arg(long, value_name = "FILE.md", num_args = 1.., conflicts_with = "out")]
    pub pages: Vec<PathBuf>,
}

/// `lamina example`.
#[derive(Args, Clone, Debug, PartialEq, Eq)]
pub struct ExampleArguments {
    /// The scene
    #[arg(required_unless_present = "list")]
    pub name: Option<String>,
    /// The folder that is made; the default is the scene's name in this folder
    #[arg(long, value_name = "FOLDER")]
    pub out: Option<PathBuf>,
    /// Name the scenes
    #[arg(long, exclusive = true)]
    pub list: bool,
}

/// `lamina completions`.
#[derive(Args, Clone, Debug, PartialEq, Eq)]
pub struct CompletionsArguments {
    /// The shell
    pub shell: Shell,
}

/// `lamina man`.
#[derive(Args, Clone, Debug, PartialEq, Eq)]
pub struct ManArguments {
    /// Folder for a page of each command; without it the page of `lamina` itself goes to stdout
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

/// The file, and the leaf in it if one is named behind `#`.
pub fn file_and_leaf(leaf: &str) -> (PathBuf, Option<&str>) {
    match leaf.rsplit_once('#') {
        // A folder may have `#` in its name; what is behind a leaf's is never a path.
        Some((file, leaf)) if !leaf.contains(['/', '\\']) => (PathBuf::from(file), Some(leaf)),
        Some(_) | None => (PathBuf::from(leaf), None),
    }
}

#[cfg(test)]
mod tests;
