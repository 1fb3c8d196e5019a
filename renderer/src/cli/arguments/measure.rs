//! `lamina measure`, as written.

use crate::report::measures::Wanted;
use std::path::PathBuf;

use clap::Args;
use leafmodel::import::Format;

use super::numbers::{above_0, between, two_numbers};
use super::tables::{self, TableArguments};

pub(super) const EXAMPLES: &str = "\
Examples:
  lamina grow birch --out birch.graphml birch.svg
  lamina measure birch.graphml --outline birch.svg --out birch.csv birch.json
  lamina measure traced.csv --mm-per-unit 0.005 --area 12.5 --distributions all.csv
  lamina measure scan.png --mm-per-pixel 0.01 --out leaf.csv
  lamina measure edges.csv --nodes nodes.csv --root 0,0 --bootstrap 1000";

/// Greatest millimetres to a unit: a kilometre.
const MOST_MM: u32 = 1_000_000;
/// Greatest area of a blade, mm²: a hundred square metres.
const MOST_MM2: u32 = 100_000_000;

/// How a network is read from a file.
#[derive(Args, Clone, Debug, Default, PartialEq)]
pub struct ReadingArguments {
    /// The table of nodes beside a table of edges
    #[arg(long, value_name = "FILE.csv")]
    pub nodes: Option<PathBuf>,
    /// The margin, instead of the file's own: svg (the path called margin, or the first), json or
    /// geojson
    #[arg(long, value_name = "FILE")]
    pub outline: Option<PathBuf>,
    /// Area in which the veins lie, mm², where there is no margin
    #[arg(long, value_name = "MM2", conflicts_with = "outline", value_parser = area)]
    pub area: Option<f64>,
    /// Millimetres to a unit or a pixel, for lengths that the files give without a unit
    #[arg(long, value_name = "MM", visible_alias = "mm-per-pixel", value_parser = scale)]
    pub mm_per_unit: Option<f64>,
    /// y points down in the file, as in pictures; an svg is turned in any case
    #[arg(long)]
    pub y_down: bool,
    /// Where the petiole is, mm, y up; the default is the base of the margin, or else the lowest end
    /// of a wide vein
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true, value_parser = place)]
    pub root: Option<[f64; 2]>,
    /// How tables are written.
    #[command(flatten)]
    pub form: TableArguments,
    /// Fail where there is anything to warn of
    #[arg(long)]
    pub strict: bool,
}

impl ReadingArguments {
    /// The flags as columns of a table of leaves.
    pub const COLUMNS: [&str; 8] = [
        "nodes",
        "outline",
        "area_mm2",
        "mm_per_unit",
        "y_down",
        "root",
        "separator",
        "decimal",
    ];

    /// Sets what a column says.
    ///
    /// # Errors
    ///
    /// What the word of the column should be.
    pub fn set(&mut self, column: &str, word: &str) -> Result<(), String> {
        match column {
            "nodes" => self.nodes = Some(word.into()),
            "outline" => self.outline = Some(word.into()),
            "area_mm2" => self.area = Some(area(word)?),
            "mm_per_unit" => self.mm_per_unit = Some(scale(word)?),
            "y_down" => {
                let is_down = ["true", "false"].iter().position(|known| *known == word);
                self.y_down = is_down.ok_or("it must be true or false")? == 0;
            }
            "root" => self.root = Some(place(word)?),
            "separator" => self.form.separator = Some(tables::separator(word)?),
            "decimal" => self.form.decimal = Some(tables::decimal(word)?),
            _ => return Err(format!("it must be one of {}", Self::COLUMNS.join(", "))),
        }
        Ok(())
    }

    /// The first of the flags that is given, as a column.
    pub fn first(&self) -> Option<&'static str> {
        let given = [
            self.nodes.is_some(),
            self.outline.is_some(),
            self.area.is_some(),
            self.mm_per_unit.is_some(),
            self.y_down,
            self.root.is_some(),
            false,
            false,
        ];
        let mut columns = Self::COLUMNS.into_iter().zip(given);
        columns.find(|(_, given)| *given).map(|(column, _)| column)
    }
}

/// How a network is measured.
#[derive(Args, Clone, Debug, PartialEq)]
pub struct MeasuringArguments {
    /// Leave out the pair statistics of areoles and the supply with water, unless a table of them is
    /// asked for
    #[arg(long)]
    pub quick: bool,
    /// The exponent n of Murray's law that the measured ratio of widths at forks refers to
    #[arg(long, value_name = "N", default_value_t = 3.0, value_parser = between::<0, 100>)]
    pub murray_exponent: f64,
    /// Number of the widest veins that are cut, one at a time
    #[arg(long, value_name = "N", default_value_t = 100, value_parser = clap::value_parser!(u32).range(0..=100_000))]
    pub cut: u32,
}

impl MeasuringArguments {
    /// What is measured, where tables of pair statistics and of cuts are asked for or not.
    pub(crate) fn wanted(&self, [asks_structure, asks_supply]: [bool; 2]) -> Wanted {
        Wanted {
            structure: !self.quick || asks_structure,
            supply: (!self.quick || asks_supply).then_some(self.cut as usize),
            murray_exponent: self.murray_exponent,
        }
    }
}

/// `lamina measure`: a network of veins from a file, its faults and its measures.
#[derive(Args, Clone, Debug, PartialEq)]
pub struct MeasureArguments {
    /// A network, its format by its ending: graphml, json, geojson, csv, tsv (edges with their
    /// places, or with --nodes), svg (paths with stroke widths); or a picture (png, tiff, jpeg),
    /// traced as lamina trace does without further flags
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// How it is read.
    #[command(flatten)]
    pub reading: ReadingArguments,
    /// How it is measured.
    #[command(flatten)]
    pub measuring: MeasuringArguments,
    /// Files to write with all measures, units and definitions, their kind by their ending: csv,
    /// json
    #[arg(long, value_name = "FILE", num_args = 1..)]
    pub out: Vec<PathBuf>,
    /// Write every single value with its place: areas, elongations and circularities of areoles,
    /// lengths and widths of veins between junctions, angles, distances to the nearest vein
    #[arg(long, value_name = "FILE.csv")]
    pub distributions: Option<PathBuf>,
    /// Write the structure factor of the centroids of areoles
    #[arg(long, value_name = "FILE.csv")]
    pub structure_factor: Option<PathBuf>,
    /// Write the tree of loops
    #[arg(long, value_name = "FILE.csv")]
    pub loop_tree: Option<PathBuf>,
    /// Write what is lost when each of the widest veins is cut
    #[arg(long, value_name = "FILE.csv")]
    pub cuts: Option<PathBuf>,
    /// Draw the areoles so many times anew for 95 % intervals of their measures; 0 for none
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u32).range(0..=100_000))]
    pub bootstrap: u32,
    /// Seed of those draws
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
}

impl MeasureArguments {
    /// The endings of files that can be measured, for messages.
    pub fn endings() -> String {
        let endings: Vec<&str> = Format::ENDINGS.iter().map(|(ending, _)| *ending).collect();
        endings.join(", ")
    }
}

/// Millimetres to a unit.
fn scale(text: &str) -> Result<f64, String> {
    above_0::<MOST_MM>(text)
}

/// An area of a blade, mm².
fn area(text: &str) -> Result<f64, String> {
    above_0::<MOST_MM2>(text)
}

/// A place in mm.
fn place(text: &str) -> Result<[f64; 2], String> {
    let wanted = "it must be x and y in mm with a comma between them: 0,-1.5";
    two_numbers(text, wanted)
}
