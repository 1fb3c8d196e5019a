//! `lamina reproduce` as written.

use std::path::PathBuf;

use clap::Args;

pub(super) const EXAMPLES: &str = "\
Examples:
  lamina reproduce bench.csv --scene bench.toml
  lamina reproduce contents.csv --input leaves.csv
  lamina reproduce leaf.csv
  lamina reproduce first-leaf.exr --scene first-leaf/scene.toml";

/// `lamina reproduce`: a result computed again and compared.
#[derive(Args, Clone, Debug, PartialEq, Eq)]
pub struct ReproduceArguments {
    /// The result: a table or JSON of `lamina instruments`, `optics` or `fit`, or the EXR of a render
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// The scene whose instruments were read out; of a picture, which holds the text of its scene, the
    /// file beside which the files lie that this text names
    #[arg(long, value_name = "SCENE.toml")]
    pub scene: Option<PathBuf>,
    /// A file of spectra or contents that the result was computed from; may be given several times
    #[arg(long, value_name = "FILE")]
    pub input: Vec<PathBuf>,
    /// Threads; the default is one for each processor
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
}
