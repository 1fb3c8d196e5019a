//! `lamina fit-veins` as written.

use std::path::PathBuf;

use clap::Args;
use leafmodel::inference::FEWEST;

use super::numbers::between;

pub(super) const EXAMPLES: &str = "\
Examples:
  lamina fit-veins poplar --measures leaf.json --free kill_distance_segments=0.5..4,birth_distance_segments=1..8 --out fitted
  lamina fit-veins leaf.toml#mine --measures leaf.json --free darts_per_segment2=1e-4..1e-2 --fit areoles_per_mm2,areole_area_cv --out fitted";

/// Most GiB that the veins of one leaf may take unless `--memory` says otherwise: a number of its
/// own, so that a fit is the same on every machine.
const USUAL_GIB: f64 = 2.0;

/// `lamina fit-veins`.
#[derive(Args, Clone, Debug, PartialEq)]
pub struct FitVeinsArguments {
    /// The leaf whose veins grow, as lamina grow takes it: a preset, or a file with leaves
    #[arg(value_name = "PRESET|FILE.toml[#LEAF]")]
    pub leaf: String,
    /// The measures of the leaf that is to be matched, as lamina grow --measure writes them
    #[arg(long, value_name = "FILE.json")]
    pub measures: PathBuf,
    /// Keys of the leaf that are free, as --set takes them, and from where to where
    #[arg(long, value_name = "KEY=LO..HI", required = true, num_args = 1.., value_delimiter = ',')]
    pub free: Vec<String>,
    /// Measures that are fitted, instead of the usual ones
    #[arg(long, value_name = "MEASURE", num_args = 1.., value_delimiter = ',')]
    pub fit: Vec<String>,
    /// Measures that the fit does not see, to test it, instead of the usual ones
    #[arg(long, value_name = "MEASURE", num_args = 1.., value_delimiter = ',')]
    pub hold_out: Vec<String>,
    /// Folder of the results; an interrupted fit goes on from what is there
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Leaves that are grown
    #[arg(long, value_name = "N", default_value_t = 1000, value_parser = clap::value_parser!(u32).range(FEWEST as i64..=1_000_000))]
    pub simulations: u32,
    /// Seed of the fit
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
    /// Change a value of the leaf, with the keys that --free takes
    #[arg(long, value_name = "KEY=VALUE")]
    pub set: Vec<String>,
    /// Override a value of the file, written as in it: -D leaves.mine.seed=3
    #[arg(short = 'D', value_name = "KEY=VALUE")]
    pub overrides: Vec<String>,
    /// Threads; the default is one for each processor
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Memory that the veins of one leaf may take; one that needs more counts as failed
    #[arg(long, value_name = "GIB", default_value_t = USUAL_GIB, value_parser = between::<0, 1024>)]
    pub memory: f64,
}
