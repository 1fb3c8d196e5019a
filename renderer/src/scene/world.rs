//! The finished scene, immutable and shared by all threads.

mod bodies;
mod error;
mod light_colours;
mod lights;
mod materials;
pub(crate) mod meshes;
pub(crate) mod needs;
mod notes;
mod placing;
mod seen;
mod strewing;
#[cfg(test)]
mod tests;

use std::ops::Deref;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use glam::{DAffine3, DVec3};
use leafmodel::optics::fluorescence::EXCITED_NM;
use leafmodel::optics::solid::ReflectanceTable;
use rayon::prelude::*;

use self::bodies::{around, build_media, set_bodies, set_drops};
use self::error::BlockError;
pub use self::error::WorldError;
use self::light_colours::{brightest, check_brightness, check_white, light_colours};
use self::lights::build_lights;
use self::materials::{Known, build_materials};
use self::meshes::{OwnSurface, build_mesh};
pub use self::notes::on_mesh;
pub use self::placing::{MaterialOwner, Pieces};
use self::placing::{Placed, place};
use self::seen::Seen;
pub use self::strewing::Places;
use self::strewing::Strewing;
use crate::camera::Camera;
use crate::camera::filter::PixelFilter;
use crate::camera::view::View;
use crate::geometry::{Geometry, Instance, TriangleMesh};
use crate::image::light_colour::LightColour;
use crate::light::Light;
use crate::light::selection::Selections;
use crate::material::Material;
use crate::material::palette::{Palette, Palettes};
use crate::material::solid::SolidMaterial;
use crate::scene::description::{Description, Named};
use crate::scene::plant_cache::PlantCache;
use crate::scene::plants::{self, Piece};
use crate::spectrum::{WavelengthGrid, WavelengthSampler};
use trace::world::{self as traced, WorldObjects};

/// The world of a scene, and where its parts come from.
#[derive(Debug)]
pub struct World {
    /// What rays meet.
    pub traced: traced::World,
    /// The parts of leaves and bodies.
    pub pieces: Pieces,
    /// The places of each object that is strewn, in the scene's frame, by its number.
    pub strewn: Places,
    /// The owner of each material.
    pub owners: Vec<MaterialOwner>,
    /// The distinct palettes of pigments.
    pub palettes: Palettes,
    /// The colours of the lights' spectra on the film; none without a film.
    pub light_colours: Vec<LightColour>,
    /// The camera's view, focused.
    pub view: View,
    /// Notes for the user, such as dropped faces or clamped reflectance.
    pub notes: Vec<String>,
}

impl Deref for World {
    type Target = traced::World;

    fn deref(&self) -> &traced::World {
        &self.traced
    }
}

/// What a world is built with besides its description.
#[derive(Clone, Copy, Debug, Default)]
pub struct BuildOptions<'a> {
    /// Leaves are read from it if they are there; those that are not are stored.
    pub cache: Option<&'a PlantCache>,
    /// Counts the leaves that have grown.
    pub grown: Option<&'a AtomicUsize>,
    /// Counts what has come to rest, and of how many things it has.
    pub at_rest: Option<&'a [AtomicUsize; 2]>,
    /// Wavelengths of paths that are not the film's.
    pub wavelengths: Option<&'a WavelengthSampler>,
    /// Most memory that meshes with their trees and the places of objects may take, bytes.
    pub most_bytes: Option<f64>,
}

impl World {
    /// Builds what a scene describes: reads meshes and pictures, grows leaves, builds the trees.
    ///
    /// # Errors
    ///
    /// [`WorldError`], which names the block of the scene.
    pub fn build(scene: &Description) -> Result<Self, WorldError> {
        Self::build_with(scene, &BuildOptions::default())
    }

    /// As [`World::build`], with options.
    ///
    /// # Errors
    ///
    /// As [`World::build`]; a cache that fails only gives a note.
    pub fn build_with(scene: &Description, options: &BuildOptions<'_>) -> Result<Self, WorldError> {
        let mut notes = Vec::new();
        let (mut meshes, surfaces) = build_meshes(scene, &mut notes)?;
        let of_film = || WavelengthSampler::new(&scene.film.kind);
        let wavelengths = options.wavelengths.cloned().unwrap_or_else(of_film);
        let range_nm = wavelengths.range_nm();
        let mut known = Known::on(wavelengths.grid());
        let mut materials = build_materials(scene, &surfaces, &mut known, &mut notes)?;
        let names = scene.materials.iter().map(|named| named.name.as_str());
        notes.extend(notes::on_maps(names.zip(&materials)));
        notes.extend(notes::on_missing_uvs(scene, &meshes, &materials));
        let (for_leaves, for_solids) = known.for_grown(scene);
        let mut owners: Vec<MaterialOwner> =
            (0..materials.len()).map(MaterialOwner::Scene).collect();
        let (grown_leaves, grown_solids) = rayon::join(
            || grow_leaves(scene, for_leaves, options),
            || grow_solids(scene, for_solids),
        );
        let of_cache = options.cache.map(PlantCache::take_notes);
        notes.extend(of_cache.into_iter().flatten());
        // The pieces of each leaf, with the scene's numbers of meshes and materials.
        let mut leaves: Vec<Vec<Piece>> = Vec::new();
        for (number, grown) in grown_leaves?.into_iter().enumerate() {
            let pieces = grown.pieces.into_iter().map(|piece| Piece {
                mesh: meshes.len() + piece.mesh,
                material: materials.len() + piece.material,
                ..piece
            });
            leaves.push(pieces.collect());
            meshes.extend(grown.meshes);
            for (part, material) in grown.materials.into_iter().enumerate() {
                owners.push(MaterialOwner::Leaf { leaf: number, part });
                materials.push(Material::Leaf(Box::new(material)));
            }
        }
        let mut solids = Vec::new();
        for (number, (mesh, material)) in grown_solids?.into_iter().enumerate() {
            solids.push(Piece {
                mesh: meshes.len(),
                material: materials.len(),
                to_leaf: DAffine3::IDENTITY,
            });
            meshes.push(mesh);
            owners.push(MaterialOwner::Solid(number));
            materials.push(Material::Solid(Box::new(material)));
        }
        notes.extend(notes::on_coats(scene, &materials, &owners, range_nm));
        let pieces = Pieces { leaves, solids };
        let limits = (options.most_bytes, options.at_rest);
        let strewing = Strewing::new(&meshes, &pieces, &scene.objects, 0, limits)?;
        let strewn = strewing.all(&mut notes)?;
        let strewn_places = strewing::as_places(&strewn);
        notes.extend(notes::on_sizes(scene, &meshes, &pieces, &strewn_places));
        let Placed {
            instances,
            mut objects,
            first,
        } = place(scene, &pieces, &strewn_places);
        set_drops(&mut objects, scene, &owners, &instances);
        let mut media = build_media(scene, wavelengths.grid());
        if media.are_present {
            set_bodies(&mut objects, scene, &owners, (&meshes, &instances))?;
        }
        let mut view = view_of(scene, &meshes, &instances, &objects)?;
        let seen = (&meshes[..], &instances[..], &objects);
        let origin = look(scene, &mut view, seen, options, &mut notes);
        let placed = (&meshes[..], &surfaces[..], &instances[..], &first[..]);
        let mut lights = build_lights(scene, placed, origin, &mut objects, &mut notes)?;
        let light_colours = colours_on_film(scene, &lights, &wavelengths, options)?;
        tabulate(&mut materials, &mut lights, wavelengths.grid());
        let fluoresces = materials.iter().any(|own| own.fluorescing().is_some());
        let geometry = Geometry::build_around(origin, meshes, instances)?;
        if media.are_present {
            media.around_camera = around((view.start() - origin).as_vec3(), &geometry, &objects);
        }
        Ok(Self {
            traced: traced::World {
                geometry,
                objects,
                materials,
                media,
                brightest: brightest(&lights, &wavelengths, fluoresces),
                selections: Selections::new(&lights, lit_range(range_nm, fluoresces)),
                lights,
                camera: Camera::new(&view, scene.film.width, scene.film.height),
                filter: PixelFilter::new(scene.film.filter_radius as f32),
                integrator: scene.integrator,
                wavelengths,
                fluoresces,
            },
            pieces,
            strewn,
            owners,
            palettes: known.palettes,
            light_colours,
            view,
            notes,
        })
    }
}

impl World {
    /// Draws what is scattered or floats another time, for instruments: `draw` is the number of one of
    /// several independent draws, and 0 is that with which a world is built. Notes stay those of the first.
    ///
    /// # Errors
    ///
    /// [`WorldError`] if there is no room; the world is then as it was.
    pub fn draw_again(
        &mut self,
        scene: &Description,
        draw: u32,
        options: &BuildOptions<'_>,
    ) -> Result<(), WorldError> {
        let traced = &mut self.traced;
        let meshes = traced.geometry.meshes();
        let limits = (options.most_bytes, options.at_rest);
        let strewing = Strewing::new(meshes, &self.pieces, &scene.objects, draw, limits)?;
        let strewn = strewing.all(&mut Vec::new())?;
        let Placed {
            instances,
            mut objects,
            ..
        } = place(scene, &self.pieces, &strewing::as_places(&strewn));
        set_drops(&mut objects, scene, &self.owners, &instances);
        if traced.media.are_present {
            set_bodies(&mut objects, scene, &self.owners, (meshes, &instances))?;
        }
        // Lamps stand in one place each, and these come first.
        for number in 0..traced.objects.len().min(objects.len()) {
            if let Some(light) = traced.objects[number].light {
                objects.shine(number, light);
            }
        }
        traced.geometry = traced
            .geometry
            .with_instances(instances, traced.geometry.origin())?;
        traced.objects = objects;
        self.strewn = strewn;
        Ok(())
    }
}

/// Wavelengths at which lights count, nm: those of paths, and those that excite what fluoresces.
fn lit_range([first, last]: [f64; 2], fluoresces: bool) -> [f64; 2] {
    if fluoresces {
        [first.min(EXCITED_NM[0]), last.max(EXCITED_NM[1])]
    } else {
        [first, last]
    }
}

/// Finds out what a view shows and where its rays are traced, and returns the origin for them.
fn look(
    scene: &Description,
    view: &mut View,
    (meshes, instances, objects): (&[TriangleMesh], &[Instance], &WorldObjects),
    options: &BuildOptions<'_>,
    notes: &mut Vec<String>,
) -> DVec3 {
    let seen = Seen::of(scene, view, meshes, instances);
    view.near = seen.near();
    // Instruments look at what they measure, wherever the camera is.
    if options.wavelengths.is_none() {
        notes.extend(seen.notes(scene, meshes, (instances, objects)));
    }
    view.near.origin
}

/// The colours of the lights on the film, if there is one: instruments have wavelengths of their own.
fn colours_on_film(
    scene: &Description,
    lights: &[Light],
    wavelengths: &WavelengthSampler,
    options: &BuildOptions<'_>,
) -> Result<Vec<LightColour>, WorldError> {
    if options.wavelengths.is_some() {
        return Ok(Vec::new());
    }
    check_brightness(scene, lights, wavelengths)?;
    let colours = light_colours(scene, lights, wavelengths);
    check_white(scene, &colours)?;
    Ok(colours)
}

/// Evaluates all spectra at the wavelengths of paths.
fn tabulate(materials: &mut [Material], lights: &mut [Light], grid: &WavelengthGrid) {
    for material in materials {
        material.tabulate(grid);
    }
    for light in lights {
        light.tabulate(grid);
    }
}

/// The camera's view, once it is known where things are.
fn view_of(
    scene: &Description,
    meshes: &[TriangleMesh],
    instances: &[Instance],
    objects: &WorldObjects,
) -> Result<View, WorldError> {
    let places = seen::ObjectPlaces {
        meshes,
        instances,
        objects,
    };
    let aspect = f64::from(scene.film.width) / f64::from(scene.film.height);
    Ok(scene.camera.view_on(&places, aspect)?)
}

/// Meshes, and the surface that each brings along.
type MeshesAndSurfaces = (Vec<TriangleMesh>, Vec<OwnSurface>);

/// Reads or makes the scene's meshes; what was dropped of them is noted.
fn build_meshes(
    scene: &Description,
    notes: &mut Vec<String>,
) -> Result<MeshesAndSurfaces, WorldError> {
    let (mut meshes, mut surfaces) = (Vec::new(), Vec::new());
    for (number, mesh) in scene.meshes.iter().enumerate() {
        let built = build_mesh(&mesh.name, &mesh.value, scene.wanted_of(number))?;
        notes.extend(on_mesh(&mesh.name, &built.mesh, &built.left_out));
        meshes.push(built.mesh);
        surfaces.push(built.surface);
    }
    Ok((meshes, surfaces))
}

/// Grows the scene's leaves, each with its palette of pigments.
fn grow_leaves(
    scene: &Description,
    palettes: Vec<Palette>,
    options: &BuildOptions<'_>,
) -> Result<Vec<plants::GrownLeaf>, WorldError> {
    if let Some(cache) = options.cache {
        plants::keep_shared_veins(scene.leaves.iter().map(|leaf| &leaf.value), cache);
    }
    grow_all("leaves", &scene.leaves, palettes, |leaf, palette| {
        let leaf = plants::grow(leaf, &palette, options.cache);
        if let Some(grown) = options.grown {
            grown.fetch_add(1, Ordering::Relaxed);
        }
        leaf
    })
}

/// Grows the scene's bodies of solid tissue, each with its palette and the table of its refractive
/// index.
fn grow_solids(
    scene: &Description,
    shared: Vec<(Palette, Arc<ReflectanceTable>)>,
) -> Result<Vec<(TriangleMesh, SolidMaterial)>, WorldError> {
    grow_all(
        "solids",
        &scene.solids,
        shared,
        |solid, (palette, table)| plants::grow_solid(solid, palette, table),
    )
}

/// Grows the blocks of a section on all threads, each with what it shares with others.
fn grow_all<B: Sync, S: Send, G: Send, E: Into<BlockError>>(
    section: &str,
    blocks: &[Named<B>],
    shared: Vec<S>,
    grow: impl Fn(&B, S) -> Result<G, E> + Sync,
) -> Result<Vec<G>, WorldError> {
    let blocks = blocks.par_iter().zip(shared).with_max_len(1);
    let grown = blocks.map(|(block, shared)| {
        let place = || format!("{section}.{}", block.name);
        grow(&block.value, shared).map_err(|error| WorldError::of(place())(error))
    });
    // Of several errors the first in the scene's order is returned, whichever occurred first.
    let grown: Vec<Result<G, WorldError>> = grown.collect();
    grown.into_iter().collect()
}
