//! `lamina check`: every error of a scene at once, and what it would build.

use crate::cli::arguments::SceneArguments;
use crate::cli::{Failure, load_scene, say};
use crate::scene::world::World;

pub(super) fn run(arguments: &SceneArguments) -> Result<(), Failure> {
    let loaded = load_scene(arguments)?;
    let world = World::build(&loaded.description).map_err(Failure::bad)?;
    for note in &world.notes {
        eprintln!("note: {note}");
    }
    let (low, high) = world.geometry.bounds();
    let size = high - low;
    let count = loaded.description.objects.len();
    let parts = if world.objects.len() > count {
        format!(" ({} parts)", world.objects.len())
    } else {
        String::new()
    };
    say(format!(
        "{}: {}{parts}, {}, {:.4} × {:.4} × {:.4} m, {:.1} MiB of geometry",
        arguments.scene.display(),
        counted(count, "object"),
        counted(world.lights.len(), "light"),
        size.x,
        size.y,
        size.z,
        world.geometry.memory_bytes() as f64 / f64::from(1 << 20)
    ));
    Ok(())
}

/// A number of things, in words.
fn counted(count: usize, thing: &str) -> String {
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {thing}{plural}")
}
