//! `lamina sweep` as written.

use std::ops::Range;
use std::path::PathBuf;

use clap::Args;

use super::cache::CacheArguments;
use super::grow::FilmArguments;
use super::numbers::{between, samples};

pub(super) const EXAMPLES: &str = "\
Examples:
  lamina sweep sweep.toml --out made
  lamina sweep scenes/flat-leaf/scene.toml --over materials.leaf.leaf.contents.chlorophyll_ug_per_cm2=10..70/7 --out made
  lamina sweep birch --over kill_distance_segments=1,2,4 --seeds 5 --out made
  lamina sweep scene.toml --over camera.perspective.turn_deg=0..350/36 --out made --film turn.gif
  lamina sweep sweep.toml --out made --tasks 3/20
  lamina sweep sweep.toml --list";

/// `lamina sweep`.
#[derive(Args, Clone, Debug, PartialEq)]
pub struct SweepArguments {
    /// A sweep file; or with --over or --seeds a scene, which is rendered, or a leaf as lamina grow
    /// takes it
    #[arg(value_name = "SWEEP.toml|SCENE.toml|LEAF")]
    pub what: String,
    /// Vary a key that -D takes, for a leaf one that --set takes: KEY=a,b,c, or KEY=lo..hi/n for n
    /// values from lo to hi; both ends may be times of one day
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
    #[arg(long, value_name = "SHARE", value_parser = between::<0, 1>)]
    pub noise: Option<f64>,
    /// Folder of the outputs and of sweep.csv; what is done already stays there
    #[arg(long, value_name = "DIR", required_unless_present = "list")]
    pub out: Option<PathBuf>,
    /// Print the tasks as JSON lines instead of doing them, the first line for what they share
    #[arg(long, conflicts_with = "out")]
    pub list: bool,
    /// Join the pictures of a scene's tasks, in their order, to a film (gif, apng or mp4), or number
    /// them (png: STEM-0001.png and so on); may be given several times
    #[arg(long, value_name = "FILE", conflicts_with_all = ["list", "tasks"])]
    pub film: Vec<PathBuf>,
    /// How fast films are.
    #[command(flatten)]
    pub timing: FilmArguments,
    /// Only the tasks number A to B − 1, from 0; or part K of N equal parts, K from 0, for job arrays
    #[arg(long, value_name = "A..B|K/N", value_parser = TaskRange::parse)]
    pub tasks: Option<TaskRange>,
    /// Tasks at a time
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..=256))]
    pub jobs: u16,
    /// Threads of each task; the default is the processors shared among the tasks at a time
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Where grown leaves are kept.
    #[command(flatten)]
    pub cache: CacheArguments,
}

/// Some of the tasks of a sweep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TaskRange {
    /// From `first` to `end − 1`, at least one.
    Numbers {
        /// The first one.
        first: usize,
        /// The number behind the last one.
        end: usize,
    },
    /// Part `number`, from 0, of `of` parts of equal size.
    Part {
        /// Which part, less than `of`.
        number: usize,
        /// The number of parts.
        of: usize,
    },
}

impl TaskRange {
    fn parse(text: &str) -> Result<Self, String> {
        let pair = |separator: &str| {
            let (first, second) = text.split_once(separator)?;
            first.parse().ok().zip(second.parse().ok())
        };
        match (pair(".."), pair("/")) {
            (Some((first, end)), _) if first < end => Ok(Self::Numbers { first, end }),
            (_, Some((number, of))) if number < of => Ok(Self::Part { number, of }),
            _ => Err(
                "write A..B with A < B, as in 0..50 for the first 50 tasks, or K/N with K < N, as in \
                 0/20 for the first of 20 parts"
                    .to_owned(),
            ),
        }
    }

    /// The numbers among so many tasks; they may end beyond the last one, and a part may be empty.
    pub fn of(self, tasks: usize) -> Range<usize> {
        match self {
            Self::Numbers { first, end } => first..end,
            Self::Part { number, of } => {
                // As wide as the product needs.
                let border = |part: usize| (tasks as u128 * part as u128 / of as u128) as usize;
                border(number)..border(number + 1)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_of_equal_size_and_all_tasks_together() {
        for (tasks, of) in [(7, 3), (3, 7), (usize::MAX, 5)] {
            let part = |number| TaskRange::Part { number, of }.of(tasks);
            let parts: Vec<Range<usize>> = (0..of).map(part).collect();
            assert_eq!((parts[0].start, parts[of - 1].end), (0, tasks));
            for (part, next) in parts.iter().zip(&parts[1..]) {
                assert_eq!(part.end, next.start);
                assert!(part.len().abs_diff(next.len()) <= 1);
            }
        }
    }
}
