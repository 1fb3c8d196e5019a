//! The scene of a command.

use std::path::PathBuf;

use clap::Args;

/// A scene file with overrides.
#[derive(Args, Clone, Debug, PartialEq, Eq)]
pub struct SceneArguments {
    /// The scene file, or the preset of a leaf or a plant, which is then shown by itself
    #[arg(value_name = "SCENE.toml|PRESET")]
    pub scene: PathBuf,
    /// Override a value, written as in the file: -D film.rgb.spp=16
    #[arg(short = 'D', value_name = "KEY=VALUE")]
    pub overrides: Vec<String>,
}
