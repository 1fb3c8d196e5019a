//! A folder that Mitsuba 3 renders: `scene.xml`, meshes, content maps, and what the comparison wants to know.
//!
//! Leaves become the plugin `lamina_leaf`, solid tissue `lamina_solid`; `reference/` registers both. Everything else is Mitsuba's own. The sun's
//! disc becomes a disk emitter so far away that irradiance differs by 2e-5 over the scene.
//! Environment pictures are upsampled to spectra by Mitsuba's own method, so scenes with one cannot be
//! compared band by band.

mod mesh;
mod spectra;
mod xml;

use std::collections::BTreeSet;
use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use leafmodel::optics::ProspectD;
use serde_json::json;
use thiserror::Error;

use crate::image::{ImageError, Layer, Picture, openexr};
use crate::material::Material;
use crate::material::contents_texture::{CHANNELS, ContentsTexture};
use crate::material::leaf::LeafTissue;
use crate::material::solid::SolidTissue;
use crate::scene::description::{Band, Description, FilmKind, Light};
use crate::scene::world::World;

use self::spectra::Spectra;

/// Why a scene could not be exported.
#[derive(Debug, Error)]
pub enum ExportError {
    /// The folder or a file in it cannot be written.
    #[error("{path}: {source}")]
    Write {
        /// What was being written.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// A map cannot be written.
    #[error(transparent)]
    Image(#[from] ImageError),
    /// The folder is there and holds something else than an export.
    #[error(
        "{path} exists and holds no lamina.json: name a new folder, or one that was exported before"
    )]
    NotOurs {
        /// The folder.
        path: PathBuf,
    },
}

/// PROSPECT-D's table with its notice, and what betalains absorb in columns of their own.
fn absorption_table() -> String {
    let mut text: String = ProspectD::notice()
        .map(|line| format!("# {line}\n"))
        .collect();
    text += "wavelength_nm,refractive_index,chlorophyll,carotenoids,anthocyanins,betacyanins,betaxanthins,brown,water,dry_matter\n";
    for nm in 400..=2500 {
        let at = ProspectD::coefficients_extrapolated(f64::from(nm));
        let k = at.absorption;
        let columns = [
            at.interface.refractive_index,
            k.chlorophyll,
            k.carotenoids,
            k.anthocyanins,
            k.betacyanins,
            k.betaxanthins,
            k.brown,
            k.water,
            k.dry_matter,
        ];
        text += &nm.to_string();
        text.extend(columns.map(|value| format!(",{value}")));
        text.push('\n');
    }
    text
}

/// Writes the folder `dir`, whole or not at all; an earlier export there is replaced.
///
/// # Errors
///
/// [`ExportError`] if something cannot be written, or `dir` is a folder of another kind.
pub fn write(scene: &Description, world: &World, dir: &Path) -> Result<(), ExportError> {
    let at = |path: &Path| {
        let path = path.to_owned();
        move |source| ExportError::Write { path, source }
    };
    if dir.exists() && !dir.join("lamina.json").is_file() {
        return Err(ExportError::NotOurs {
            path: dir.to_owned(),
        });
    }
    let parent = dir.parent().filter(|parent| !parent.as_os_str().is_empty());
    let parent = parent.unwrap_or(Path::new("."));
    let folder = tempfile::Builder::new()
        .prefix(".lamina-export")
        .tempdir_in(parent)
        .map_err(at(parent))?;
    fill(scene, world, folder.path())?;
    let new = folder.keep();
    if dir.exists() {
        fs::remove_dir_all(dir).map_err(at(dir))?;
    }
    fs::rename(&new, dir).map_err(at(dir))
}

fn fill(scene: &Description, world: &World, folder: &Path) -> Result<(), ExportError> {
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
    let mut written = BTreeSet::new();
    for number in 0..world.objects.len() {
        let file = xml::mesh_file(scene, world, number);
        let mesh = world
            .geometry
            .mesh(world.geometry.instance(number as u32).mesh);
        let is_part = number >= scene.objects.len();
        let mirrored = is_part && xml::is_mirrored(world, number);
        if written.insert(file.clone()) {
            save(&file, &mesh::ply(mesh, mirrored))?;
        }
    }
    for (number, material) in world.materials.iter().enumerate() {
        let map = match material {
            Material::Leaf(leaf) => match &leaf.tissue {
                LeafTissue::Map(map) => Some(map),
                LeafTissue::Uniform(_) | LeafTissue::Measured { .. } => None,
            },
            Material::Solid(solid) => match solid.tissue() {
                SolidTissue::Map(map) => Some(map),
                SolidTissue::Uniform(_) => None,
            },
            Material::Diffuse(_) | Material::Dielectric(_) => None,
        };
        if let Some(map) = map {
            let path = folder.join(format!(
                "maps/{}.exr",
                xml::material_id(scene, world, number)
            ));
            openexr::write(&map_picture(map), &path)?;
        }
    }
    for light in &scene.lights {
        if let Light::Environment { file, .. } = &light.value {
            let path = folder.join(xml::environment_file(&light.name, file));
            fs::copy(file, &path).map_err(|source| ExportError::Write { path, source })?;
        }
    }
    save("prospect_d.csv", absorption_table().as_bytes())?;
    let mut spectra = Spectra::default();
    save(
        "scene.xml",
        xml::scene(scene, world, &mut spectra).as_bytes(),
    )?;
    for (name, text) in &spectra.files {
        save(&format!("spectra/{name}"), text.as_bytes())?;
    }
    save("lamina.json", format!("{:#}\n", summary(scene)).as_bytes())
}

/// A contents map as a picture whose first row is v = 0.
pub fn map_picture(map: &ContentsTexture) -> Picture {
    let (width, height) = map.size();
    let layers = CHANNELS
        .into_iter()
        .enumerate()
        .map(|(channel, name)| Layer {
            name: name.to_owned(),
            data: map.texels().iter().map(|texel| texel[channel]).collect(),
        })
        .collect();
    Picture {
        width: width as u32,
        height: height as u32,
        layers,
        attributes: Vec::new(),
    }
}

/// The bands of the film; a colour film is exported as one band over its range.
fn bands(scene: &Description) -> Vec<Band> {
    match &scene.film.kind {
        FilmKind::Spectral { bands } => bands.clone(),
        FilmKind::Rgb { range_nm } => vec![Band {
            center_nm: 0.5 * (range_nm[0] + range_nm[1]),
            width_nm: range_nm[1] - range_nm[0],
        }],
    }
}

fn summary(scene: &Description) -> serde_json::Value {
    let bands: Vec<_> = bands(scene)
        .iter()
        .map(|band| json!({ "center_nm": band.center_nm, "width_nm": band.width_nm }))
        .collect();
    let suns = scene
        .lights
        .iter()
        .filter(|light| matches!(light.value, Light::Distant { .. }));
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
mod tests {
    use super::*;
    use crate::scene::load;

    const SCENE: &str = r#"
format = 1
[film.spectral]
size = [8, 4]
spp = 1
bands_nm = [450, 550]
[camera.perspective]
position_m = [0, 0, 0.5]
look_at_m = [0, 0, 0]
up = [0, 1, 0]
vertical_fov_deg = 20
[materials.mapped.leaf.map]
file = "map.exr"
[materials.plain.leaf.measured]
reflectance = 0.4
transmittance = 0.5
[meshes.blade.rectangle]
width_m = 0.05
height_m = 0.1
[objects.left]
mesh = "blade"
material = "mapped"
position_m = [-0.1, 0, 0]
[objects.right]
mesh = "blade"
material = "plain"
position_m = [0.1, 0, 0]
[lights.sun.distant]
irradiance_w_m2_nm = { blackbody_k = 5800, scale = 1.5 }
towards = [0, 0, 1]
"#;

    /// A contents map of 2 × 3 texels, each of its 42 numbers different.
    fn map() -> ContentsTexture {
        let texel =
            |i: u16| std::array::from_fn(|channel| 1.0 + f32::from(i) + channel as f32 / 8.0);
        ContentsTexture::new(2, 3, (0..6).map(texel).collect())
    }

    fn scene(folder: &Path) -> (Description, World) {
        openexr::write(&map_picture(&map()), &folder.join("map.exr")).expect("a map");
        let scene = load::parse(SCENE, "scene.toml", folder, &[])
            .expect("a good scene")
            .description;
        let world = World::build(&scene).expect("a scene that can be built");
        (scene, world)
    }

    #[test]
    fn an_export_holds_all_that_its_xml_names() {
        let folder = tempfile::tempdir().expect("a folder");
        let (scene, world) = scene(folder.path());
        let out = folder.path().join("out");
        write(&scene, &world, &out).expect("it is written");
        let xml = fs::read_to_string(out.join("scene.xml")).expect("scene.xml");
        let mut files = 0;
        for word in xml.split('"') {
            let ending = Path::new(word)
                .extension()
                .and_then(|ending| ending.to_str());
            if ending.is_some_and(|ending| ["ply", "exr", "spd", "csv"].contains(&ending)) {
                assert!(out.join(word).is_file(), "{word} is missing");
                files += 1;
            }
        }
        assert_eq!(
            files, 5,
            "two meshes, a map, the sun's spectrum, PROSPECT's table: {xml}"
        );
        assert!(out.join("lamina.json").is_file());
    }

    #[test]
    fn a_map_is_exported_as_it_is() {
        let folder = tempfile::tempdir().expect("a folder");
        let (scene, world) = scene(folder.path());
        let out = folder.path().join("out");
        write(&scene, &world, &out).expect("it is written");
        let back = crate::scene::assets::contents_map(&out.join("maps/material-mapped.exr"))
            .expect("a contents map");
        assert_eq!(back.size(), map().size());
        assert_eq!(back.texels(), map().texels());
    }

    #[test]
    fn every_part_of_a_compound_leaf_is_a_shape_and_mirrored_ones_are_mirrored_in_their_files() {
        const LEAF: &str = r#"
[leaves.trefoil]
length_mm = 20
map_size = 16
[leaves.trefoil.outline.cubic]
[leaves.trefoil.venation.arcuate]
[leaves.trefoil.contents]
structure = 1.5
chlorophyll_ug_per_cm2 = 40
carotenoids_ug_per_cm2 = 9
water_cm = 0.01
dry_matter_g_per_cm2 = 0.006
[leaves.trefoil.compound.palmate]
leaflets = 3
spread_deg = 240
petiolule = 1
petiole = 1
variants = 2
[objects.clover]
leaf = "trefoil"
position_m = [0, 0, 0.1]
"#;
        let folder = tempfile::tempdir().expect("a folder");
        openexr::write(&map_picture(&map()), &folder.path().join("map.exr")).expect("a map");
        let text = SCENE.to_owned() + LEAF;
        let scene = load::parse(&text, "scene.toml", folder.path(), &[])
            .unwrap_or_else(|errors| panic!("{errors}"))
            .description;
        let world = World::build(&scene).expect("a scene that can be built");
        // Two rectangles; three blades with a stalk each, and the petiole.
        assert_eq!(world.objects.len(), 2 + 7);
        let out = folder.path().join("out");
        write(&scene, &world, &out).expect("it is written");
        let xml = fs::read_to_string(out.join("scene.xml")).expect("scene.xml");
        assert_eq!(xml.matches("<shape type=\"ply\"").count(), 9);
        // Two blades and what stalks are made of; each shape names one.
        assert_eq!(
            xml.matches("<bsdf type=\"lamina_leaf\" id=\"leaf-trefoil")
                .count(),
            3
        );
        assert_eq!(xml.matches("<ref id=\"leaf-trefoil").count(), 7);
        for word in xml
            .split('"')
            .filter(|word| word.starts_with("meshes/") || word.starts_with("maps/"))
        {
            assert!(out.join(word).is_file(), "{word} is missing");
        }
        for number in 0..world.objects.len() {
            let instance = world.geometry.instance(number as u32);
            let file = xml::mesh_file(&scene, &world, number);
            let bytes = fs::read(out.join(&file)).expect("its mesh");
            let mesh = crate::geometry::import(&bytes, "ply", 1.0).expect("a mesh");
            let own = world.geometry.mesh(instance.mesh);
            let side = if file.contains("mirrored") { -1.0 } else { 1.0 };
            assert_eq!(mesh.positions()[0].x, side * own.positions()[0].x);
            assert_eq!(file.contains("mirrored"), xml::is_mirrored(&world, number));
        }
    }

    #[test]
    fn an_earlier_export_is_replaced_and_another_folder_is_left_alone() {
        let folder = tempfile::tempdir().expect("a folder");
        let (scene, world) = scene(folder.path());
        let out = folder.path().join("out");
        write(&scene, &world, &out).expect("it is written");
        fs::write(out.join("stale"), "").expect("a file");
        write(&scene, &world, &out).expect("it is written again");
        assert!(
            !out.join("stale").exists(),
            "the folder is the new export alone"
        );

        let other = folder.path().join("photographs");
        fs::create_dir(&other).expect("a folder");
        fs::write(other.join("leaf.jpg"), "dear").expect("a file");
        let refused = write(&scene, &world, &other);
        assert!(
            matches!(refused, Err(ExportError::NotOurs { .. })),
            "{refused:?}"
        );
        assert_eq!(
            fs::read(other.join("leaf.jpg")).expect("still there"),
            b"dear"
        );
    }
}
