//! From a scene file to the world that a command works with.

use std::path::Path;

use crate::cli::arguments::{CacheArguments, SceneArguments};
use crate::cli::grow::{is_word, unknown_preset};
use crate::cli::progress::Patience;
use crate::cli::terminal::{Failure, warn};
use crate::scene::description::Description;
use crate::scene::load::{self, Loaded};
use crate::scene::portrait::{Stage, portrait};
use crate::scene::world::{BuildOptions, World};
use crate::spectrum::WavelengthSampler;

/// Loads a scene, or makes one of a preset, and prints its warnings.
pub(super) fn load_scene(arguments: &SceneArguments) -> Result<Loaded, Failure> {
    load_on(arguments, Stage::default())
}

/// As [`load_scene`], with the stage on which a preset is shown.
pub(super) fn load_on(arguments: &SceneArguments, stage: Stage) -> Result<Loaded, Failure> {
    let loaded = match preset_of(&arguments.scene) {
        Some(preset) => {
            let text = portrait(preset, stage).ok_or_else(|| unknown_preset(preset))?;
            let file = format!("{preset}.toml");
            load::parse(&text, &file, Path::new("."), &arguments.overrides)?
        }
        None => load::load(&arguments.scene, &arguments.overrides)?,
    };
    warn(&loaded.warnings);
    Ok(loaded)
}

/// The preset that a command names in place of a scene: a word that is not the name of a file.
pub(super) fn preset_of(scene: &Path) -> Option<&str> {
    scene
        .to_str()
        .filter(|word| is_word(word) && !scene.exists())
}

/// What the command line says about building a world.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Building<'a> {
    /// The memory that is allowed, GiB.
    pub(super) memory: Option<f64>,
    /// Where grown leaves are kept; nowhere if it is `None`.
    pub(super) cache: Option<&'a CacheArguments>,
    /// The wavelengths, if they are others than those of the film.
    pub(super) wavelengths: Option<&'a WavelengthSampler>,
}

impl Building<'_> {
    /// Builds a scene's world; lines on stderr report how far it is.
    pub(super) fn world(self, scene: &Description) -> Result<World, Failure> {
        let cache = self.cache.map(CacheArguments::open).transpose();
        let cache = cache.map_err(Failure::bad)?.flatten();
        let patience = Patience::building(scene.leaves.len(), self.memory);
        let options = BuildOptions {
            cache: cache.as_ref(),
            wavelengths: self.wavelengths,
            ..patience.options()
        };
        World::build_with(scene, &options).map_err(Failure::bad)
    }
}
