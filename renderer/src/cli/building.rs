//! From a scene file to the world that a command works with.

use crate::cli::arguments::{CacheArguments, SceneArguments};
use crate::cli::progress::Patience;
use crate::cli::terminal::{Failure, warn};
use crate::scene::description::Description;
use crate::scene::load::{self, Loaded};
use crate::scene::world::{BuildOptions, World};
use crate::spectrum::WavelengthSampler;

/// Loads a scene and prints its warnings.
pub(super) fn load_scene(arguments: &SceneArguments) -> Result<Loaded, Failure> {
    let loaded = load::load(&arguments.scene, &arguments.overrides)?;
    warn(&loaded.warnings);
    Ok(loaded)
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
