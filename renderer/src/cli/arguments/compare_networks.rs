//! `lamina compare-networks`, as written.

use std::path::PathBuf;

use clap::{Arg, ArgAction, ArgMatches, Args, Command, FromArgMatches};

use super::measure::{MeasuringArguments, ReadingArguments};
pub use crate::report::comparison::overlay::Alignment;

pub(super) const EXAMPLES: &str = "\
Examples:
  lamina compare-networks leaf.svg traced.svg --out report.html
  lamina compare-networks scan.png poplar --mm-per-pixel 0.01 --out report.html table.csv
  lamina compare-networks --group sun sun/*.svg --group shade shade/*.svg --out report.html table.csv
  lamina compare-networks --group real real/*.svg --group grown leaf.toml#mine --seeds 8 --out report.html
  lamina compare-networks --table leaves.csv --only vein_density_mm_per_mm2,areole_area --out report.html";

/// `lamina compare-networks`: measures of networks side by side.
#[derive(Args, Clone, Debug, PartialEq)]
pub struct CompareNetworksArguments {
    /// Networks, two or more, each by itself: files as lamina measure takes them, or leaves that are
    /// grown, as lamina grow takes them (a preset, leaf.toml#NAME)
    #[arg(value_name = "NETWORK")]
    pub networks: Vec<String>,
    /// Groups of leaves.
    #[command(flatten)]
    pub groups: Groups,
    /// A table with a row for each leaf: `file`, and where wanted `group`, `name`, `nodes`,
    /// `outline`, `area_mm2`, `mm_per_unit`, `y_down`, `root`, `separator`, `decimal`; --separator and
    /// --decimal say how the table itself is written
    #[arg(long, value_name = "FILE.csv", conflicts_with_all = ["networks", "group"])]
    pub table: Option<PathBuf>,
    /// How files are read; a table has its own.
    #[command(flatten)]
    pub reading: ReadingArguments,
    /// How networks are measured.
    #[command(flatten)]
    pub measuring: MeasuringArguments,
    /// Grow each leaf that is grown N times, with seeds from 1 to N instead of its own
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub seeds: Option<u32>,
    /// Compare these measures and distributions only: the fewer tests, the less is lost to their
    /// correction
    #[arg(long, value_name = "MEASURE", num_args = 1.., value_delimiter = ',')]
    pub only: Vec<String>,
    /// Compare each with each, not all with the first
    #[arg(long)]
    pub all_pairs: bool,
    /// How networks are laid over each other; the default is base-and-apex where both have a margin,
    /// else as-given
    #[arg(long, value_name = "HOW", value_enum)]
    pub align: Option<Alignment>,
    /// The two leaves that are laid over each other, by name; the default is the first of each pair
    #[arg(long, value_names = ["NAME", "NAME"], num_args = 2)]
    pub overlay: Vec<String>,
    /// Title of the report
    #[arg(long, value_name = "TEXT")]
    pub title: Option<String>,
    /// Files to write, their kind by their ending: html (the report), csv, json (all numbers)
    #[arg(long, value_name = "FILE", num_args = 1..)]
    pub out: Vec<PathBuf>,
    /// Write the measures of each leaf, a row for each value
    #[arg(long, value_name = "FILE.csv")]
    pub values: Option<PathBuf>,
    /// Seed of the divisions of leaves that are drawn where there are too many to try all
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
    /// Threads; the default is one for each processor
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
}

/// A group of leaves as the command line names it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Group {
    /// Its name.
    pub name: String,
    /// Its leaves, one or more.
    pub leaves: Vec<String>,
}

/// All `--group NAME FILE…`. Each is told from the next, which a derived list cannot.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Groups(pub Vec<Group>);

impl FromArgMatches for Groups {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let groups = matches.get_occurrences::<String>("group");
        let groups = groups.into_iter().flatten().map(|mut words| {
            let name = words.next().cloned().unwrap_or_default();
            let leaves = words.cloned().collect();
            Group { name, leaves }
        });
        Ok(Self(groups.collect()))
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl Args for Groups {
    fn augment_args(command: Command) -> Command {
        let group = Arg::new("group")
            .long("group")
            .value_names(["NAME", "NETWORK"])
            .num_args(2..)
            .action(ArgAction::Append)
            .conflicts_with("networks")
            .help("A group of leaves, two or more times: its name, then its networks");
        command.arg(group)
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}
