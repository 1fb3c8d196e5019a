//! `lamina example`, as written.

use std::path::PathBuf;

use clap::Args;

/// Examples of the command.
pub(super) const EXAMPLES: &str = "\
Examples:
  lamina example first-leaf && lamina render first-leaf/scene.toml
  lamina example --list";

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
