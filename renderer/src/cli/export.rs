//! `lamina export`: a scene for another renderer.

use std::path::Path;

use crate::cli::arguments::{CacheArguments, MitsubaArguments};
use crate::cli::building::{Building, load_scene};
use crate::cli::needs;
use crate::cli::places::check_writable;
use crate::cli::signals::Signals;
use crate::cli::terminal::{Failure, say};
use crate::export::mitsuba::{self, ExportError};

pub(super) fn run(arguments: &MitsubaArguments) -> Result<(), Failure> {
    let signals = Signals::listen()?;
    check_folder(&arguments.out)?;
    let scene = load_scene(&arguments.scene)?.description;
    mitsuba::check(&scene).map_err(Failure::bad)?;
    needs::check_geometry(&scene, "export", arguments.memory)?;
    let building = Building {
        memory: arguments.memory,
        cache: Some(&CacheArguments::USUAL),
        ..Building::default()
    };
    let world = building.world(&scene)?;
    // What is begun is written to its end, or not at all.
    signals.begin_work();
    mitsuba::write(&scene, &world, &arguments.out).map_err(|error| match error {
        ExportError::Write { .. } | ExportError::Image(_) => Failure::system(error),
        ExportError::Asset(_)
        | ExportError::Fluorescence
        | ExportError::Lens(_)
        | ExportError::Nested { .. }
        | ExportError::CameraInside
        | ExportError::Layers(_)
        | ExportError::Tangents(_)
        | ExportError::NotOurs(_) => Failure::bad(error),
    })?;
    say(arguments.out.display());
    if world.objects.have_drops() {
        eprintln!(
            "note: under drops Mitsuba takes leaves as they are in air, so that they send out 1/eta² of their \
             light; Lamina does not"
        );
    }
    let leaking = mitsuba::leaking(&scene, &world);
    if !leaking.is_empty() {
        eprintln!(
            "note: {} smooth and {} Mitsuba's own diffuse or dielectric BSDF, with which some light passes \
             closed bodies at their outline and terminator: {}; leaves, solid tissue and plastic let none pass",
            if leaking.len() == 1 {
                "one object is"
            } else {
                "some objects are"
            },
            if leaking.len() == 1 { "has" } else { "have" },
            leaking.join(", ")
        );
    }
    Ok(())
}

/// Refuses a folder that cannot be written, before anything is grown.
fn check_folder(out: &Path) -> Result<(), Failure> {
    mitsuba::check_ours(out).map_err(Failure::bad)?;
    // Within the folder if it is there, else beside it.
    check_writable(&if out.is_dir() {
        out.join("lamina.json")
    } else {
        out.to_owned()
    })
}
