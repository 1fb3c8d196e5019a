//! `lamina export`: a scene for another renderer.

use crate::cli::arguments::MitsubaArguments;
use crate::cli::progress::Patience;
use crate::cli::{Failure, load_scene, needs, say};
use crate::export::mitsuba;
use crate::scene::world::World;

pub(super) fn run(arguments: &MitsubaArguments) -> Result<(), Failure> {
    let scene = load_scene(&arguments.scene)?.description;
    needs::check_geometry(&scene, "export", arguments.memory)?;
    let patience = Patience::building(scene.leaves.len());
    let world = World::build_with(&scene, &patience.options()).map_err(Failure::bad)?;
    drop(patience);
    mitsuba::write(&scene, &world, &arguments.out).map_err(Failure::system)?;
    say(arguments.out.display());
    if world.objects.have_drops() {
        eprintln!(
            "note: under drops Mitsuba takes leaves as they are in air, so that they send out 1/eta² of their \
             light; Lamina does not"
        );
    }
    Ok(())
}
