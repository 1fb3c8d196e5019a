//! `lamina export`: a scene, or a leaf, for another program.

use std::path::Path;

use crate::cli::arguments::{CacheArguments, GltfArguments, MitsubaArguments, SceneArguments};
use crate::cli::building::{Building, load_scene, preset_of};
use crate::cli::grow::unknown_preset;
use crate::cli::needs;
use crate::cli::places::{check_outputs, check_writable, require_ending, write_and_say};
use crate::cli::signals::Signals;
use crate::cli::terminal::{Failure, note, say, warn};
use crate::export::gltf::{self, GltfError, GltfOptions};
use crate::export::mitsuba::{self, ExportError};
use crate::scene::description::Description;
use crate::scene::load;
use crate::scene::portrait::alone;

pub(super) fn gltf(arguments: &GltfArguments) -> Result<(), Failure> {
    let signals = Signals::listen()?;
    require_ending([&arguments.out], "glb", "--out writes one binary glTF file")?;
    check_outputs(
        [&arguments.out],
        std::slice::from_ref(&arguments.scene),
        "the export",
    )?;
    let scene = scene_or_preset(&arguments.scene, &arguments.overrides)?;
    needs::check_geometry(&scene, "export", arguments.memory)?;
    let wavelengths = gltf::wavelengths();
    let building = Building {
        memory: arguments.memory,
        cache: Some(&CacheArguments::USUAL),
        wavelengths: Some(&wavelengths),
    };
    let world = building.world(&scene)?;
    note(&world.notes);
    let options = GltfOptions {
        illuminant: arguments.illuminant,
        texture: arguments.texture,
        triangles: arguments.triangles,
        cards: arguments.cards,
        plain_nodes: arguments.plain_nodes,
        one_face: arguments.one_face,
        spectra: arguments.spectra,
    };
    let (bytes, extent) = gltf::glb(&scene, &world, options).map_err(|error| match error {
        GltfError::TooLarge(_) => Failure::bad(error),
        GltfError::Image(_) => Failure::system(error),
    })?;
    signals.begin_work();
    write_and_say(&arguments.out, bytes)?;
    note([extent]);
    Ok(())
}

/// The scene of a file, or one of a preset by itself.
fn scene_or_preset(scene: &Path, overrides: &[String]) -> Result<Description, Failure> {
    let Some(preset) = preset_of(scene) else {
        let arguments = SceneArguments {
            scene: scene.to_owned(),
            overrides: overrides.to_owned(),
        };
        return Ok(load_scene(&arguments)?.description);
    };
    let text = alone(preset).ok_or_else(|| unknown_preset(preset))?;
    let loaded = load::parse(&text, preset, Path::new("."), overrides)?;
    warn(&loaded.warnings);
    Ok(loaded.description)
}

pub(super) fn mitsuba(arguments: &MitsubaArguments) -> Result<(), Failure> {
    let signals = Signals::listen()?;
    check_folder(&arguments.out)?;
    let scene = load_scene(&arguments.scene)?.description;
    mitsuba::check(&scene).map_err(Failure::bad)?;
    needs::check_geometry(&scene, "export", arguments.memory)?;
    let wavelengths = gltf::wavelengths();
    let building = Building {
        memory: arguments.memory,
        cache: Some(&CacheArguments::USUAL),
        wavelengths: arguments.stock.then_some(&wavelengths),
    };
    let world = building.world(&scene)?;
    let write = if arguments.stock {
        mitsuba::write_stock
    } else {
        mitsuba::write
    };
    // What is begun is written to its end, or not at all.
    signals.begin_work();
    write(&scene, &world, &arguments.out).map_err(|error| match error {
        ExportError::Write { .. } | ExportError::Image(_) => Failure::system(error),
        ExportError::Asset(_)
        | ExportError::Fluorescence
        | ExportError::Foliage(_)
        | ExportError::Holdout(_)
        | ExportError::Lens(_)
        | ExportError::Nested { .. }
        | ExportError::CameraInside
        | ExportError::Layers(_)
        | ExportError::Tangents(_)
        | ExportError::Stock(_)
        | ExportError::NotOurs(_) => Failure::bad(error),
    })?;
    say(arguments.out.display());
    if !arguments.stock {
        note(["lamina.mitsuba.load of the Python package lamina-render[mitsuba] opens it"]);
    }
    if world.objects.have_drops() {
        eprintln!(
            "note: under drops Mitsuba takes leaves as they are in air, so that they send out 1/eta² of their \
             light; Lamina does not"
        );
    }
    let leaking = mitsuba::leaking(&scene, &world, arguments.stock);
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
