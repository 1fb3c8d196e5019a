//! `lamina cache`: what is kept of grown leaves.

use crate::cli::arguments::CacheCommandArguments;
use crate::cli::terminal::{Failure, say};
use crate::scene::plant_cache::{MOST_BYTES, PlantCache};

const MB: f64 = 1e6;

pub(super) fn run(arguments: &CacheCommandArguments) -> Result<(), Failure> {
    let named = arguments.cache.clone();
    let limit = if named.is_some() {
        String::new()
    } else {
        format!(" of at most {} MB", MOST_BYTES as f64 / MB)
    };
    let Some(folder) = named.or_else(PlantCache::usual_folder) else {
        say("no folder: LAMINA_CACHE is empty, or the system names no folder for caches");
        return Ok(());
    };
    if arguments.clear {
        PlantCache::clear(&folder).map_err(Failure::system)?;
    }
    let (files, bytes) = PlantCache::content(&folder);
    say(format_args!(
        "{}: {files} files, {:.1} MB{limit}",
        folder.display(),
        bytes as f64 / MB
    ));
    Ok(())
}
