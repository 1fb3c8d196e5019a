//! `lamina check`: reports every error of a scene or of a file of leaves at once and, on request,
//! the size of the scene once built.

use leafmodel::document::error::{DocumentError, LocatedError};

use crate::cli::arguments::{CacheArguments, CheckArguments, SceneArguments};
use crate::cli::building::{Building, load_scene};
use crate::cli::needs;
use crate::cli::progress::Patience;
use crate::cli::signals::Signals;
use crate::cli::terminal::{Failure, note, say, warn};
use crate::scene::description::{Description, Held, Mesh, Named, Shape};
use crate::scene::world::meshes::build_mesh;
use crate::scene::world::on_mesh;
use crate::scene::{assets, load};

pub(super) fn run(arguments: &CheckArguments) -> Result<(), Failure> {
    let CheckArguments {
        scene,
        build,
        memory,
    } = arguments;
    if let Some(leaves) = load::load_if_only_leaves(&scene.scene, &scene.overrides) {
        let (leaves, warnings) = match leaves {
            Ok(read) => read,
            Err(errors) => {
                // Whatever else is wrong with a leaf is told, here as everywhere.
                let lacks_contents = |error: &LocatedError| matches!(&error.error, DocumentError::MissingKey { key, .. } if key == "contents");
                if !errors.errors().iter().all(lacks_contents) {
                    return Err(errors.into());
                }
                let count = load::count_veins(&scene.scene, &scene.overrides);
                let count = count.ok_or(errors)?;
                let leaves = counted(count, "leaf", "leaves");
                say(format!("{}: {leaves}", scene.scene.display()));
                eprintln!(
                    "note: margin and veins alone; a picture or a blade needs `contents` too"
                );
                return Ok(());
            }
        };
        warn(&warnings);
        let leaves = counted(leaves.len(), "leaf", "leaves");
        say(format!("{}: {leaves}", scene.scene.display()));
        return Ok(());
    }
    let description = load_scene(scene)?.description;
    needs::check(&description, *memory)?;
    if *build {
        let _signals = Signals::listen()?;
        return report_world(scene, &description, *memory);
    }
    let patience = Patience::reading();
    read_files(&description)?;
    drop(patience);
    let film = &description.film;
    let mut parts = vec![
        counted(description.objects.len(), "object", "objects"),
        counted(description.lights.len(), "light", "lights"),
    ];
    if !description.leaves.is_empty() {
        parts.push(counted(description.leaves.len(), "leaf", "leaves"));
    }
    if !description.solids.is_empty() {
        parts.push(counted(description.solids.len(), "body", "bodies"));
    }
    say(format!(
        "{}: {}, {} × {} pixels, {}",
        scene.scene.display(),
        parts.join(", "),
        film.width,
        film.height,
        counted(film.spp as usize, "sample a pixel", "samples a pixel"),
    ));
    Ok(())
}

/// Reads the files of a scene whose existence alone was checked so far.
fn read_files(description: &Description) -> Result<(), Failure> {
    for (number, mesh) in description.meshes.iter().enumerate() {
        if let Shape::Mesh(Mesh::Gltf(_) | Mesh::File(_)) = &mesh.value {
            let built = build_mesh(&mesh.name, &mesh.value, description.wanted_of(number));
            let built = built.map_err(Failure::bad)?;
            note(on_mesh(&mesh.name, &built.mesh, &built.left_out));
        }
    }
    for material in &description.materials {
        let refused = |error| bad!("materials.{}: {error}", material.name);
        if let Some((file, layer)) = material.value.picture() {
            assets::reflectances(file, layer).map_err(refused)?;
        }
        if let Some(Held::Map { file, .. }) = material.value.held() {
            assets::contents_map(file).map_err(refused)?;
        }
    }
    for light in &description.lights {
        if let Some((file, layer)) = light.value.picture() {
            let told = |error| bad!("lights.{}: {error}", light.name);
            assets::shining(file, layer).map_err(told)?;
        }
    }
    Ok(())
}

/// Builds the scene and prints its size.
fn report_world(
    scene: &SceneArguments,
    description: &Description,
    memory: Option<f64>,
) -> Result<(), Failure> {
    let building = Building {
        memory,
        cache: Some(&CacheArguments::USUAL),
        ..Building::default()
    };
    let mut world = building.world(description)?;
    note(std::mem::take(&mut world.notes));
    for Named { name, value } in &description.crossing {
        let [crossing, leaves] = value;
        eprintln!(
            "note: plants.{name}: {crossing} of {leaves} leaves cut another one or an axis; a greater `evasions` \
             lets them try more turns"
        );
    }
    let (low, high) = world.geometry.bounds();
    let size = high - low;
    let count = description.objects.len();
    let parts = if world.objects.len() > count {
        format!(" ({} parts)", world.objects.len())
    } else {
        String::new()
    };
    say(format!(
        "{}: {}{parts}, {}, {:.4} × {:.4} × {:.4} m, {:.1} MiB of geometry",
        scene.scene.display(),
        counted(count, "object", "objects"),
        counted(description.lights.len(), "light", "lights"),
        size.x,
        size.y,
        size.z,
        world.geometry.memory_bytes() as f64 / f64::from(1 << 20)
    ));
    Ok(())
}

/// A number of things, in words.
fn counted(count: usize, one: &str, several: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { several })
}
