//! `lamina export`: a scene for another renderer.

use crate::cli::arguments::MitsubaArguments;
use crate::cli::{Failure, load_scene, say};
use crate::export::mitsuba;
use crate::scene::world::World;

pub(super) fn run(arguments: &MitsubaArguments) -> Result<(), Failure> {
    let scene = load_scene(&arguments.scene)?.description;
    let world = World::build(&scene).map_err(Failure::bad)?;
    mitsuba::write(&scene, &world, &arguments.out).map_err(Failure::system)?;
    say(arguments.out.display());
    Ok(())
}
