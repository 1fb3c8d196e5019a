//! `lamina instruments` as written.

use std::path::PathBuf;

use clap::Args;

use super::cache::CacheArguments;
use super::numbers::{MOST_GIB, MOST_SECONDS, between};
use super::scene::SceneArguments;
use crate::instruments::Target;

pub(super) const EXAMPLES: &str = "\
Examples:
  lamina instruments bench.toml --out bench.csv
  lamina instruments bench.toml --error 1e-3 --only ball --out ball.json --plot ball.svg
  lamina instruments bench.toml --error 1% --time 600 --out bench.csv
  lamina instruments bench.toml --rays 1000000 -D objects.leaves.volume.seed=2 --out canopy.csv";

/// Greatest number of rays: 2³⁶.
const MOST_RAYS: u64 = 1 << 36;

/// `lamina instruments`: figures of a scene's instruments with their standard errors.
#[derive(Args, Clone, Debug, PartialEq)]
// Portraits of presets have no instruments.
#[command(mut_arg("scene", |scene| scene.value_name("SCENE.toml").help("The scene file")))]
pub struct InstrumentsArguments {
    /// Scene and overrides.
    #[command(flatten)]
    pub scene: SceneArguments,
    /// Files to write with all figures, their kind by their ending: csv, json
    #[arg(long, value_name = "FILE", num_args = 1.., required = true)]
    pub out: Vec<PathBuf>,
    /// Draw the figures too: spectra, planes of view angles, depth
    #[arg(long, value_name = "FILE.svg")]
    pub plot: Option<PathBuf>,
    /// Read out this instrument only; may be given several times
    #[arg(long, value_name = "NAME")]
    pub only: Vec<String>,
    /// Rays for each eight wavelengths, each light and each face; the default is 65536, or with
    /// --error 2^32 at most
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(crate::instruments::FEWEST_RAYS..=MOST_RAYS))]
    pub rays: Option<u64>,
    /// Standard error at which a figure is good enough, as 1e-3, or as a part of the figure, as 1%;
    /// rays are added until all figures are
    #[arg(long, value_name = "ERROR", value_parser = error)]
    pub error: Option<Target>,
    /// Stop following rays after this time; what has been measured is written
    #[arg(long, value_name = "SECONDS", value_parser = between::<0, MOST_SECONDS>)]
    pub time: Option<f64>,
    /// Seed of every random number
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
    /// Threads; the default is one for each processor
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Where grown leaves are kept.
    #[command(flatten)]
    pub cache: CacheArguments,
    /// Memory that building the scene may take; the default is what the machine has free
    #[arg(long, value_name = "GIB", value_parser = between::<0, MOST_GIB>)]
    pub memory: Option<f64>,
}

/// A standard error above 0 and up to 1, or up to 100 % of a figure.
fn error(text: &str) -> Result<Target, String> {
    let (number, target) = match text.strip_suffix('%') {
        None => (between::<0, 1>(text)?, Target::Absolute as fn(f64) -> _),
        Some(percent) => {
            let part = between::<0, 100>(percent.trim_end())? / 100.0;
            (part, Target::Relative as fn(f64) -> _)
        }
    };
    let allowed = "must be above 0 and at most 1, or 100%".to_owned();
    (number > 0.0).then(|| target(number)).ok_or(allowed)
}
