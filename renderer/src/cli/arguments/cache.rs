//! Where grown leaves are kept, and `lamina cache`.

use std::path::PathBuf;

use clap::Args;

use crate::scene::plant_cache::{CacheError, MOST_BYTES, PlantCache};

/// Where grown leaves are kept.
#[derive(Args, Clone, Debug, Default, PartialEq)]
pub struct CacheArguments {
    /// Keep grown leaves in this folder, without a limit, instead of in the user's cache folder (see `lamina cache`)
    #[arg(long, value_name = "DIR", conflicts_with = "no_cache")]
    pub cache: Option<PathBuf>,
    /// Grow every leaf, and keep none
    #[arg(long)]
    pub no_cache: bool,
}

impl CacheArguments {
    /// The user's cache folder.
    pub const USUAL: Self = Self {
        cache: None,
        no_cache: false,
    };

    /// The cache; `None` if there should be none, or if the user's folder cannot be used.
    ///
    /// # Errors
    ///
    /// [`CacheError`] for a folder that the command line names and that cannot be used.
    pub fn open(&self) -> Result<Option<PlantCache>, CacheError> {
        if self.no_cache {
            return Ok(None);
        }
        if let Some(folder) = &self.cache {
            return PlantCache::open(folder, None).map(Some);
        }
        let usual = PlantCache::usual_folder();
        Ok(usual.and_then(|folder| PlantCache::open(&folder, Some(MOST_BYTES)).ok()))
    }

    /// The same as words of a command line.
    pub fn words(&self) -> Vec<String> {
        let folder = self.cache.iter();
        let folder = folder.flat_map(|folder| ["--cache".to_owned(), folder.display().to_string()]);
        let none = self.no_cache.then(|| "--no-cache".to_owned());
        folder.chain(none).collect()
    }
}

/// `lamina cache`.
#[derive(Args, Clone, Debug, PartialEq)]
pub struct CacheCommandArguments {
    /// Delete the leaves that are kept
    #[arg(long)]
    pub clear: bool,
    /// This folder instead of the user's cache folder
    #[arg(long, value_name = "DIR")]
    pub cache: Option<PathBuf>,
}
