//! A scene as one glTF 2.0 file (\[gltf2022\]) for other programs: metres, +y up.
//!
//! - **In**: a world that was built with [`wavelengths`], so that every leaf, individual and place is
//!   there.
//! - **Out**: the bytes of a `.glb` file. Materials are colours of the same R(λ) and T(λ) that are traced,
//!   under a named illuminant.
//! - **Always true**: the same scene gives the same bytes.
//! - **Left out**: lights, camera, media, fluorescence, dust and bloom.

mod colours;
mod document;
mod mesh;
mod places;
mod surface;

use std::collections::BTreeMap;
use std::fmt;

use glam::{DAffine3, DVec3, Mat3};
use rayon::prelude::*;
use serde_json::json;
use thiserror::Error;

use self::colours::Colorimetry;
pub use self::colours::{Illuminant, wavelengths};
use self::document::GltfDocument;
use self::mesh::Dressing;
use self::places::MeshPlace;
use self::surface::{Observation, Surface};
use super::mitsuba::material_id;
use crate::image::ImageError;
use crate::material::Material;
use crate::scene::description::Description;
use crate::scene::world::{MaterialOwner, World};

/// Why there is no file.
#[derive(Debug, Error)]
pub enum GltfError {
    /// More bytes than the numbers of a `.glb` file hold.
    #[error(
        "the file would have {0} bytes, and a .glb file has 4294967295 at most: ask for smaller textures \
         or fewer triangles"
    )]
    TooLarge(usize),
    /// A texture cannot be made.
    #[error(transparent)]
    Image(#[from] ImageError),
}

/// What the file should be like.
#[derive(Clone, Copy, Debug)]
pub struct GltfOptions {
    /// The light under which colours are seen.
    pub illuminant: Illuminant,
    /// Most texels along a side of a texture, a power of two.
    pub texture: u32,
    /// Whether each place is a node of its own.
    pub plain_nodes: bool,
    /// Whether a leaf is one surface, seen from both sides, with the adaxial face's colours.
    pub one_face: bool,
}

impl Default for GltfOptions {
    fn default() -> Self {
        Self {
            illuminant: Illuminant::default(),
            texture: 1024,
            plain_nodes: false,
            one_face: false,
        }
    }
}

/// What a file holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// Size along x, y and z of the scene, m.
    pub size_m: DVec3,
    /// Triangles of all places.
    pub triangles: usize,
    /// Triangles of all meshes.
    pub stored: usize,
    /// Textures.
    pub textures: usize,
    /// Bytes of the file.
    pub bytes: usize,
}

impl fmt::Display for Extent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z] = self.size_m.to_array();
        write!(
            f,
            "{x:.3} m × {y:.3} m × {z:.3} m high, {} triangles ({} stored), {} textures, {} bytes",
            self.triangles, self.stored, self.textures, self.bytes
        )
    }
}

/// The number of an object, of a mesh and of a material.
type Dressed = (usize, usize, usize);

/// The file of a scene, and what it holds.
///
/// # Errors
///
/// [`GltfError::TooLarge`].
///
/// # Panics
///
/// If the world was not built with [`wavelengths`].
pub fn glb(
    scene: &Description,
    world: &World,
    options: GltfOptions,
) -> Result<(Vec<u8>, Extent), GltfError> {
    let mut groups: BTreeMap<Dressed, Vec<u32>> = BTreeMap::new();
    for instance in 0..world.objects.len() as u32 {
        let object = world.objects[instance as usize];
        let mesh = world.geometry.instance(instance).mesh as usize;
        let group = groups.entry((object.object, mesh, object.material));
        group.or_default().push(instance);
    }
    let surfaces = surfaces(scene, world, options, groups.keys())?;
    let mut file = GltfDocument::default();
    let mut materials: BTreeMap<(usize, bool), Vec<usize>> = BTreeMap::new();
    let mut meshes: BTreeMap<(usize, usize), (usize, usize)> = BTreeMap::new();
    let mut nodes: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    let (mut triangles, mut stored) = (0, 0);
    for (&(object, mesh, material), instances) in &groups {
        let is_sheet = is_sheet(world, mesh, material);
        let surface = &surfaces[&(material, is_sheet)];
        let numbers = materials.entry((material, is_sheet));
        let is_seen_from_behind = options.one_face || !is_sheet;
        let numbers = numbers.or_insert_with(|| surface.written(&mut file, is_seen_from_behind));
        let dressing = Dressing {
            surface,
            materials: numbers,
            is_one_face: options.one_face,
            is_tinted: world.materials[material].is_tinted(),
        };
        let id = material_id(scene, world, material);
        let mut add = |file: &mut GltfDocument, linear: Mat3| {
            let own = world.geometry.mesh(mesh as u32);
            let added = mesh::add(file, &id, own, linear, &dressing);
            stored += added.1;
            added
        };
        let mut places: Vec<MeshPlace> = Vec::new();
        let own = nodes.entry(object).or_default();
        let name = &scene.objects[object].name;
        for &instance in instances {
            let to_scene: DAffine3 = world.geometry.instance(instance).to_scene();
            let (place, skewed) = MeshPlace::of(&to_scene);
            if let Some(linear) = skewed {
                let (number, count) = add(&mut file, linear);
                triangles += count;
                own.extend(places::add(&mut file, name, number, &[place], true));
            } else {
                places.push(place);
            }
        }
        if places.is_empty() {
            continue;
        }
        let (number, count) = *meshes
            .entry((mesh, material))
            .or_insert_with(|| add(&mut file, Mat3::IDENTITY));
        triangles += count * places.len();
        own.extend(places::add(
            &mut file,
            name,
            number,
            &places,
            options.plain_nodes,
        ));
    }
    let roots: Vec<usize> = nodes
        .into_iter()
        .map(|(object, own)| match own[..] {
            [alone] => alone,
            _ => file.add(
                "nodes",
                json!({ "name": scene.objects[object].name, "children": own }),
            ),
        })
        .collect();
    let textures = file.count("textures");
    let bytes = file.finish(&scene.name, &roots)?;
    let extent = Extent {
        size_m: size_of(world),
        triangles,
        stored,
        textures,
        bytes: bytes.len(),
    };
    Ok((bytes, extent))
}

/// Size of all that is placed, m.
fn size_of(world: &World) -> DVec3 {
    let all = 0..world.geometry.instances();
    let bounds = all.map(|instance| world.geometry.bounds_of(instance));
    let around = bounds.reduce(|(low, high), (a, b)| (low.min(a), high.max(b)));
    around.map_or(DVec3::ZERO, |(low, high)| high - low)
}

/// Whether a mesh of a leaf's material is a blade: stalks and hairs, which are tubes, have no texture
/// coordinates.
fn is_sheet(world: &World, mesh: usize, material: usize) -> bool {
    let is_grown = matches!(world.owners[material], MaterialOwner::Leaf { .. });
    let is_tissue = matches!(world.materials[material], Material::Leaf(_));
    is_tissue && (!is_grown || world.geometry.mesh(mesh as u32).uvs().is_some())
}

/// The surfaces of all materials that are seen, as sheets or as bodies.
fn surfaces<'a>(
    scene: &Description,
    world: &'a World,
    options: GltfOptions,
    groups: impl Iterator<Item = &'a Dressed>,
) -> Result<BTreeMap<(usize, bool), Surface<'a>>, GltfError> {
    let colorimetry = Colorimetry::under(options.illuminant);
    let seen = Observation {
        colorimetry: &colorimetry,
        wavelengths: world.wavelengths.grid().set(0),
        texture: options.texture,
    };
    let kinds = groups.map(|&(_, mesh, material)| (material, is_sheet(world, mesh, material)));
    let mut kinds: Vec<(usize, bool)> = kinds.collect();
    kinds.sort_unstable();
    kinds.dedup();
    let surfaces = kinds.into_par_iter().map(|(material, is_sheet)| {
        let name = material_id(scene, world, material);
        let surface = Surface::of(&world.materials[material], &name, is_sheet, seen)?;
        Ok(((material, is_sheet), surface))
    });
    surfaces.collect()
}

#[cfg(test)]
mod tests;
