//! The scene of a command.

use std::path::PathBuf;

use clap::Args;

/// A scene file with overrides.
#[derive(Args, Clone, Debug, PartialEq, Eq)]
pub struct SceneArguments {
    /// The scene file
    #[arg(value_name = "SCENE.toml")]
    pub scene: PathBuf,
    /// Override a value, written as in the file: -D film.rgb.spp=16
    #[arg(short = 'D', value_name = "KEY=VALUE")]
    pub overrides: Vec<String>,
}
