//! A folder that Mitsuba 3 renders: `scene.xml`, meshes, content maps, and the data for the
//! comparison.
//!
//! Leaves become the plugin `lamina_leaf`, those with a relief `lamina_relief`, solid tissue
//! `lamina_solid`, coated bodies `lamina_plastic`, materials of models `lamina_model`, maps of
//! colours the texture `lamina_colours`, skies and pictures of surroundings textures on a sphere around
//! the scene; `reference/` registers them. Everything else is Mitsuba's own. The sun's disc becomes a disk emitter so far away that
//! irradiance differs by 2e-5 over the scene.

mod bsdf;
mod emitter;
mod media;
mod mesh;
mod sensor;
mod shapes;
mod stock;
mod surroundings;
mod xml;

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use leafmodel::optics::{Constituent, Pigments, ProspectD};
use serde_json::json;
use thiserror::Error;

use self::stock::Stock;
pub use self::stock::StockError;
use crate::export::names::material_id;
use crate::image::{ImageError, Layer, Picture, openexr};
use crate::material::colour_map::ColourMap;
use crate::material::contents_texture::ContentsTexture;
use crate::material::relief::Relief;
use crate::plugin::emitter::Emitter;
use crate::plugin::spectra::Spectra;
use crate::plugin::surface::{absorption_file, relief_file};
use crate::plugin::{self, colours};
use crate::scene::assets::{self, AssetError};
use crate::scene::description::Description;
use crate::scene::world::World;
use crate::spectrum::rgb;

/// Why a scene could not be exported.
#[derive(Debug, Error)]
pub enum ExportError {
    /// The folder or a file in it cannot be written.
    #[error("{path}: {source}")]
    Write {
        /// The file or folder that was being written.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// A map cannot be written.
    #[error(transparent)]
    Image(#[from] ImageError),
    /// The picture of a light cannot be read any more.
    #[error(transparent)]
    Asset(#[from] AssetError),
    /// Light that changes its wavelength.
    #[error(
        "a leaf fluoresces, which cannot be exported: Mitsuba's light keeps its wavelength; leave \
         `fluorescence` out"
    )]
    Fluorescence,
    /// A lens that Mitsuba does not have; the key that says so.
    #[error(
        "camera.perspective.{0} cannot be exported: Mitsuba's thin lens is round, open over the \
         whole picture and parallel to the film; leave the key out"
    )]
    Lens(&'static str),
    /// Bodies within each other.
    #[error(
        "the objects `{first}` and `{second}` are transparent bodies that touch or lie within each \
         other, of which one holds a medium or has the index of air: Mitsuba must be told what is \
         around the inner one, and a scene does not say so; move them apart"
    )]
    Nested {
        /// Name of an object.
        first: String,
        /// Name of the other.
        second: String,
    },
    /// The camera stands in a medium.
    #[error("the camera stands within a transparent body: move it out, to export the scene")]
    CameraInside,
    /// A medium of leaves; its name.
    #[error(
        "media.{0}.leaves cannot be exported: Mitsuba has no phase function of leaves; scatter small discs \
         with `volume` instead"
    )]
    Foliage(String),
    /// A leaf whose inside is followed; the block that says so.
    #[error(
        "{0}.optics = \"layers\" cannot be exported: Mitsuba follows no light through a leaf of \
         layers; write \"plates\""
    )]
    Layers(String),
    /// An object that is a hole to the camera; its name.
    #[error(
        "objects.{0}.holdout cannot be exported: Mitsuba has no such objects; leave the key out"
    )]
    Holdout(String),
    /// Tangents for a map of normals; the object that has them.
    #[error(
        "the object `{0}` has a map of normals with tangents of its file, which cannot be exported: the \
         plugin for Mitsuba has those of the texture coordinates; save the glTF file without tangents"
    )]
    Tangents(String),
    /// Mitsuba's own materials cannot show one of the scene's.
    #[error(transparent)]
    Stock(#[from] StockError),
    /// The folder exists and holds something other than an export.
    #[error(
        "{0} exists and holds no lamina.json: name a new folder, or one that was exported before"
    )]
    NotOurs(PathBuf),
}

/// PROSPECT-D's table with its notice, with the columns of these pigments and additional columns
/// for the absorption of betalains.
fn absorption_table(pigments: &Pigments) -> String {
    let mut text: String = ProspectD::notice()
        .map(|line| format!("# {line}\n"))
        .collect();
    if *pigments != Pigments::default() {
        text +=
            "# Some of the pigments are others than PROSPECT-D's: those that the scene names.\n";
    }
    text += "wavelength_nm,refractive_index";
    text.extend(Constituent::ABSORBING.map(|constituent| format!(",{}", constituent.channel())));
    text.push('\n');
    for nm in 400..=2500 {
        let at = ProspectD::coefficients_of(pigments, f64::from(nm));
        text += &format!("{nm},{}", at.interface.refractive_index);
        let absorbed = Constituent::ABSORBING.map(|constituent| at.absorption[constituent]);
        text.extend(absorbed.map(|value| format!(",{value}")));
        text.push('\n');
    }
    text
}

/// Refuses a folder that holds something else.
///
/// # Errors
///
/// [`ExportError::NotOurs`].
pub fn check_ours(dir: &Path) -> Result<(), ExportError> {
    if dir.exists() && !dir.join("lamina.json").is_file() {
        return Err(ExportError::NotOurs(dir.to_owned()));
    }
    Ok(())
}

/// Refuses a scene that cannot be exported, as far as that shows before anything is grown.
///
/// # Errors
///
/// [`ExportError`] if it has a lens that Mitsuba lacks, a leaf that fluoresces, or one of layers.
pub fn check(scene: &Description) -> Result<(), ExportError> {
    if let Some(key) = sensor::foreign_key(&scene.camera.view) {
        return Err(ExportError::Lens(key));
    }
    if let Some(object) = scene.objects.iter().find(|object| object.value.holdout) {
        return Err(ExportError::Holdout(object.name.clone()));
    }
    if let Some(place) = bsdf::layered(scene) {
        return Err(ExportError::Layers(place));
    }
    if let Some(medium) = scene
        .media
        .iter()
        .find(|medium| medium.value.leaves.is_some())
    {
        return Err(ExportError::Foliage(medium.name.clone()));
    }
    let mut leaves = scene.leaves.iter();
    let mut materials = scene.materials.iter();
    let fluoresces = leaves.any(|leaf| leaf.value.fluorescence.is_some())
        || materials.any(|material| bsdf::fluoresces(&material.value));
    if fluoresces {
        return Err(ExportError::Fluorescence);
    }
    Ok(())
}

/// Names of the smooth objects whose material is a BSDF of Mitsuba's own: there light may pass a
/// closed body, because the shading normal decides on which side of a triangle it is.
pub fn leaking<'s>(scene: &'s Description, world: &World, are_stock: bool) -> Vec<&'s str> {
    let mut objects: Vec<usize> = (0..world.objects.len() as u32)
        .filter(|&number| {
            let mesh = world.geometry.mesh(world.geometry.instance(number).mesh);
            let object = world.objects[number as usize];
            mesh.normals().is_some() && (are_stock || bsdf::is_stock(scene, world, object.material))
        })
        .map(|number| world.objects[number as usize].object)
        .collect();
    objects.sort_unstable();
    objects.dedup();
    let names = objects.into_iter();
    names
        .map(|number| scene.objects[number].name.as_str())
        .collect()
}

/// An object whose map of normals follows tangents of its file.
fn with_tangents<'s>(scene: &'s Description, world: &World) -> Option<&'s str> {
    let mut all = 0..world.objects.len() as u32;
    let found = all.find(|&number| {
        let mesh = world.geometry.mesh(world.geometry.instance(number).mesh);
        let object = world.objects[number as usize];
        mesh.tangents().is_some() && world.materials[object.material].has_normals()
    });
    found.map(|number| {
        scene.objects[world.objects[number as usize].object]
            .name
            .as_str()
    })
}

/// Writes the folder `dir` completely or not at all; an earlier export there is replaced.
///
/// # Errors
///
/// [`ExportError`] if the scene has a lens that Mitsuba lacks or a leaf that fluoresces, something
/// cannot be written, or `dir` is a folder of another kind.
pub fn write(scene: &Description, world: &World, dir: &Path) -> Result<(), ExportError> {
    write_with(scene, world, dir, None)
}

/// As [`write()`] with materials of Mitsuba's own alone; the world has to be built with
/// [`super::gltf::wavelengths`].
///
/// # Errors
///
/// As [`write()`], and [`ExportError::Stock`].
pub fn write_stock(scene: &Description, world: &World, dir: &Path) -> Result<(), ExportError> {
    check_ours(dir)?;
    write_with(scene, world, dir, Some(&Stock::of(scene, world)?))
}

fn write_with(
    scene: &Description,
    world: &World,
    dir: &Path,
    stock: Option<&Stock<'_>>,
) -> Result<(), ExportError> {
    check(scene)?;
    if world.fluoresces {
        return Err(ExportError::Fluorescence);
    }
    let at = |path: &Path| {
        let path = path.to_owned();
        move |source| ExportError::Write { path, source }
    };
    check_ours(dir)?;
    if let Some([first, second]) = media::nested(scene, world) {
        return Err(ExportError::Nested {
            first: first.to_owned(),
            second: second.to_owned(),
        });
    }
    if let Some(object) = with_tangents(scene, world) {
        return Err(ExportError::Tangents(object.to_owned()));
    }
    if world.media.around_camera.innermost().is_some() {
        return Err(ExportError::CameraInside);
    }
    let parent = dir.parent().filter(|parent| !parent.as_os_str().is_empty());
    let parent = parent.unwrap_or(Path::new("."));
    let folder = tempfile::Builder::new()
        .prefix(".lamina-export")
        .tempdir_in(parent)
        .map_err(at(parent))?;
    fill(scene, world, folder.path(), stock)?;
    let new = folder.keep();
    if dir.exists() {
        fs::remove_dir_all(dir).map_err(at(dir))?;
    }
    fs::rename(&new, dir).map_err(at(dir))
}

fn fill(
    scene: &Description,
    world: &World,
    folder: &Path,
    stock: Option<&Stock<'_>>,
) -> Result<(), ExportError> {
    let save = |name: &str, bytes: &[u8]| {
        let path = folder.join(name);
        fs::File::create(&path)
            .and_then(|mut file| file.write_all(bytes))
            .map_err(|source| ExportError::Write { path, source })
    };
    for name in ["meshes", "maps", "spectra"] {
        let path = folder.join(name);
        fs::create_dir(&path).map_err(|source| ExportError::Write { path, source })?;
    }
    let show = |name: &str, picture: &Picture| openexr::write(picture, &folder.join(name));
    let show_colours = |id: &str, map: &ColourMap| -> Result<(), ExportError> {
        for (name, picture) in colours::pictures(id, map) {
            show(&name, &picture)?;
        }
        save(colours::BASIS, rgb::basis_text().as_bytes())
    };
    for (name, bytes) in stock.into_iter().flat_map(Stock::pictures) {
        save(&name, bytes)?;
    }
    let of_plugins = if stock.is_some() {
        &[]
    } else {
        &world.materials[..]
    };
    for (number, material) in of_plugins.iter().enumerate() {
        let id = material_id(scene, world, number);
        if let Some(map) = material.contents_map() {
            show(&format!("maps/{id}.exr"), &map_picture(map))?;
        }
        for (id, map) in colours::maps(&id, material) {
            show_colours(&id, &map)?;
        }
        if let Some(relief) = material.relief() {
            show(&relief_file(&id), &relief_picture(relief))?;
        }
    }
    for (light, table) in surroundings::tables(scene, world) {
        let picture = surroundings::weights(table.size, &table.weights);
        show(&plugin::weights_file(light), &picture)?;
        let spectra = surroundings::spectra(&table);
        save(&surroundings::spectra_file(light), spectra.as_bytes())?;
    }
    for (light, built) in scene.with_built(&world.lights) {
        if let Some(map) = emitter::emission(built) {
            let id = plugin::light_id(&light.name);
            show_colours(&id, map)?;
        }
        if light.value.area().is_some()
            && let Some((file, layer)) = light.value.picture()
        {
            let picture = assets::shining(file, layer)?;
            let size = [picture.width, picture.texels.len() / picture.width];
            let picture = surroundings::weights(size, &picture.texels);
            show(&plugin::weights_file(&light.name), &picture)?;
        }
    }
    for palette in world.palettes.iter().filter(|_| stock.is_none()) {
        let table = absorption_table(palette.pigments());
        save(&absorption_file(palette), table.as_bytes())?;
    }
    let mut spectra = Spectra::default();
    let (xml, meshes) = xml::scene(scene, world, stock, &mut spectra);
    save("scene.xml", xml.as_bytes())?;
    for file in meshes {
        let mesh = world.geometry.mesh(file.mesh as u32);
        save(&file.path(scene, world), &mesh::ply(mesh, file.mirrored))?;
    }
    for (name, text) in &spectra.files {
        save(&format!("spectra/{name}"), text.as_bytes())?;
    }
    save("lamina.json", format!("{:#}\n", summary(scene)).as_bytes())
}

/// A contents map as a picture whose first row is v = 0.
pub fn map_picture(map: &ContentsTexture) -> Picture {
    let (width, height) = map.size();
    let layers = Constituent::ALL.map(|constituent| {
        Layer::new(
            constituent.channel(),
            map.texels()
                .iter()
                .map(|texel| texel[constituent])
                .collect(),
        )
    });
    Picture::new([width as u32, height as u32], layers)
}

/// The slopes of a relief as a picture whose first row is v = 0.
fn relief_picture(relief: &Relief) -> Picture {
    let ([width, height], texels) = relief.finest();
    let faces = ["adaxial", "abaxial"].into_iter();
    let names = faces.flat_map(|face| ["x", "y", "xx", "yy"].map(|of| format!("{face}.{of}")));
    let layers = names.enumerate().map(|(channel, name)| Layer {
        name,
        data: texels.iter().map(|texel| texel[channel]).collect(),
    });
    Picture::new([width as u32, height as u32], layers)
}

fn summary(scene: &Description) -> serde_json::Value {
    let bands: Vec<_> = sensor::bands(scene)
        .iter()
        .map(|band| json!({ "center_nm": band.center_nm, "width_nm": band.width_nm }))
        .collect();
    let suns = scene
        .lights
        .iter()
        .map(|light| light.value.emitter(&mut Spectra::default()))
        .filter(|emitter| matches!(emitter, Emitter::Disc { .. }));
    json!({
        "name": scene.name,
        "width": scene.film.width,
        "height": scene.film.height,
        "spp": scene.film.spp,
        "seed": scene.film.seed,
        "bands": bands,
        "max_depth": scene.integrator.max_depth,
        "sun_disks": suns.count(),
        "program": format!("Lamina {}", env!("CARGO_PKG_VERSION")),
    })
}

#[cfg(test)]
mod tests;
