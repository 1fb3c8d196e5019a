//! `lamina sweep` as written.

use std::path::PathBuf;

use clap::Args;

use super::{between, samples};

pub(super) const EXAMPLES: &str = "\
Examples:
  lamina sweep sweep.toml --out made
  lamina sweep scenes/flat-leaf/scene.toml --over materials.leaf.leaf.contents.chlorophyll_ug_per_cm2=10..70/7 --out made
  lamina sweep birch --over kill_distance_segments=1,2,4 --seeds 5 --out made
  lamina sweep sweep.toml --list";

/// `lamina sweep`.
#[derive(Args, Clone, Debug, PartialEq)]
pub struct SweepArguments {
    /// A sweep file; or with --over or --seeds a scene, which is rendered, or a leaf as lamina grow
    /// takes it
    #[arg(value_name = "SWEEP.toml|SCENE.toml|LEAF")]
    pub what: String,
    /// Vary a key that -D takes, for a leaf one that --set takes: KEY=a,b,c, or KEY=lo..hi/n for n
    /// values from lo to hi
    #[arg(long, value_name = "KEY=VALUES")]
    pub over: Vec<String>,
    /// Do each task under the seeds 1 to N
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub seeds: Option<u16>,
    /// Override a value in all tasks, written as in the file: -D film.rgb.spp=16
    #[arg(short = 'D', value_name = "KEY=VALUE")]
    pub overrides: Vec<String>,
    /// Samples a pixel of each picture, instead of the scene's
    #[arg(long, value_name = "N", value_parser = samples())]
    pub spp: Option<u32>,
    /// Target noise of each picture, instead of the scene's
    #[arg(long, value_name = "SHARE", value_parser = between::<0, 1>, allow_negative_numbers = true)]
    pub noise: Option<f64>,
    /// Folder of the outputs and of sweep.csv; what is done already stays there
    #[arg(long, value_name = "DIR", required_unless_present = "list")]
    pub out: Option<PathBuf>,
    /// Print the tasks as JSON lines instead of doing them, the first line for what they share
    #[arg(long, conflicts_with = "out")]
    pub list: bool,
    /// Only the tasks number A to B − 1, from 0
    #[arg(long, value_name = "A..B", value_parser = TaskRange::parse)]
    pub tasks: Option<TaskRange>,
    /// Tasks at a time
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..=256))]
    pub jobs: u16,
    /// Threads of each task; the default is the processors shared among the tasks at a time
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Keep grown leaves of scenes in a folder, so that tasks with the same leaves grow them once
    #[arg(long, value_name = "DIR")]
    pub cache: Option<PathBuf>,
}

/// Numbers of tasks, from `first` to `end − 1`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TaskRange {
    /// The first one.
    pub first: usize,
    /// The number behind the last one, greater than `first`.
    pub end: usize,
}

impl TaskRange {
    fn parse(text: &str) -> Result<Self, String> {
        let ends = text.split_once("..");
        let ends = ends.and_then(|(first, end)| first.parse().ok().zip(end.parse().ok()));
        match ends {
            Some((first, end)) if first < end => Ok(Self { first, end }),
            Some(_) | None => {
                Err("write A..B with A < B, as in 0..50 for the first 50 tasks".to_owned())
            }
        }
    }
}
