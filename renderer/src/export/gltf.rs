//! A scene as one glTF 2.0 file (\[gltf2022\]) for other programs: metres, +y up.
//!
//! - **In**: a world that was built with [`wavelengths`], so that every leaf, individual and place is
//!   there.
//! - **Out**: the bytes of a `.glb` file. Materials are colours of the same R(λ) and T(λ) that are traced,
//!   under a named illuminant.
//! - **Always true**: the same scene gives the same bytes.
//! - **Left out**: lights, camera, media, fluorescence, dust and bloom.

mod coarse;
mod colours;
mod document;
mod error;
mod mesh;
mod places;
mod spectra;
mod surface;

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt;

use glam::{DAffine3, DVec3, Mat3, Vec2};
use rayon::prelude::*;
use serde_json::json;

use self::colours::Colorimetry;
pub use self::colours::{Illuminant, wavelengths};
use self::document::GltfDocument;
pub use self::error::GltfError;
use self::mesh::Dressing;
use self::places::MeshPlace;
pub(super) use self::surface::{Arrangement, Finish, Surface};
use self::surface::{Blade, Observation};
use super::names::material_id;
use crate::geometry::TriangleMesh;
use crate::material::Material;
use crate::material::leaf::LeafMaterial;
use crate::scene::description::Description;
use crate::scene::world::{MaterialOwner, World};

/// What the file should be like.
#[derive(Clone, Copy, Debug)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "each is an option of its own"
)]
pub struct GltfOptions {
    /// The light under which colours are seen.
    pub illuminant: Illuminant,
    /// Most texels along a side of a texture, a power of two.
    pub texture: u32,
    /// Most triangles of a blade or of a tube; of all other meshes each triangle is there.
    pub triangles: Option<u32>,
    /// Whether each blade is a card of two triangles, with all pictures of blades in one.
    pub cards: bool,
    /// Whether each place is a node of its own.
    pub plain_nodes: bool,
    /// Whether a leaf is one surface, seen from both sides, with the adaxial face's colours.
    pub one_face: bool,
    /// Whether materials have their reflectance and transmittance beside their colours; not with cards.
    pub spectra: bool,
}

impl Default for GltfOptions {
    fn default() -> Self {
        Self {
            illuminant: Illuminant::default(),
            texture: 1024,
            triangles: None,
            cards: false,
            plain_nodes: false,
            one_face: false,
            spectra: false,
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
    let coarse = Coarse { world, options };
    let dresses = dresses(scene, &coarse, groups.keys())?;
    let mut file = GltfDocument::default();
    let mut materials: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    let mut meshes: BTreeMap<(usize, usize), (usize, usize)> = BTreeMap::new();
    let mut nodes: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    let (mut triangles, mut stored) = (0, 0);
    for (&(object, mesh, material), instances) in &groups {
        let is_sheet = coarse.is_sheet(mesh, material);
        let (number, place) = dresses.of[&(mesh, material)];
        let surface = &dresses.surfaces[number];
        let numbers = materials.entry(number);
        let is_seen_from_behind = options.one_face || !is_sheet;
        let numbers = numbers.or_insert_with(|| {
            let numbers = surface.written(&mut file, is_seen_from_behind);
            if options.spectra && !options.cards {
                coarse.add_spectra(&mut file, &numbers, mesh, material);
            }
            numbers
        });
        let dressing = Dressing {
            surface,
            materials: numbers,
            is_one_face: options.one_face,
            is_tinted: world.materials[material].is_tinted(),
            place,
        };
        let id = material_id(scene, world, material);
        let mut add = |file: &mut GltfDocument, linear: Mat3| {
            let added = mesh::add(file, &id, &coarse.mesh(mesh, material), linear, &dressing);
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

/// The meshes of a world as they are written.
#[derive(Clone, Copy, Debug)]
struct Coarse<'a> {
    world: &'a World,
    options: GltfOptions,
}

impl<'a> Coarse<'a> {
    /// The leaf, if a mesh of its material is a blade: stalks and hairs, which are tubes, have no texture
    /// coordinates.
    fn sheet(&self, mesh: usize, material: usize) -> Option<&'a LeafMaterial> {
        let is_grown = matches!(self.world.owners[material], MaterialOwner::Leaf { .. });
        let is_blade = !is_grown || self.own(mesh).uvs().is_some();
        let leaf = if let Material::Leaf(leaf) = &self.world.materials[material] {
            Some(&**leaf)
        } else {
            None
        };
        leaf.filter(|_| is_blade)
    }

    fn is_sheet(&self, mesh: usize, material: usize) -> bool {
        self.sheet(mesh, material).is_some()
    }

    /// The mesh that is traced.
    fn own(&self, mesh: usize) -> &'a TriangleMesh {
        self.world.geometry.mesh(mesh as u32)
    }

    /// Adds the spectra of a mesh's material to what the file says of it.
    fn add_spectra(
        &self,
        file: &mut GltfDocument,
        numbers: &[usize],
        mesh: usize,
        material: usize,
    ) {
        let sheet = self.sheet(mesh, material);
        let faces = spectra::extras(&self.world.materials[material], sheet, self.own(mesh));
        let only = sheet.and_then(LeafMaterial::half_face);
        for (place, &number) in numbers.iter().enumerate() {
            let face = only.unwrap_or(place.min(1));
            file.describe("materials", number, faces[face].clone());
        }
    }

    /// How many triangles a mesh may have.
    fn most(&self, mesh: usize, material: usize) -> Option<usize> {
        let most = match self.options.triangles.map(|most| most as usize) {
            _ if self.options.cards && self.is_sheet(mesh, material) => Some(2),
            most => most,
        };
        most.filter(|&most| self.own(mesh).triangles().len() > most)
    }

    /// A mesh as it is written.
    fn mesh(&self, mesh: usize, material: usize) -> Cow<'a, TriangleMesh> {
        let own = self.own(mesh);
        let most = self.most(mesh, material);
        let fewer = most.and_then(|most| {
            if self.is_sheet(mesh, material) {
                coarse::grid(own, most)
            } else if own.uvs().is_none() && own.colours().is_none() {
                coarse::joined(own, most)
            } else {
                None
            }
        });
        fewer.map_or(Cow::Borrowed(own), Cow::Owned)
    }

    /// A blade as it is shown.
    fn blade(&self, mesh: usize, leaf: &'a LeafMaterial, material: usize) -> Blade<'a> {
        Blade {
            leaf,
            masked: self.most(mesh, material).map(|_| self.own(mesh)),
            is_card: self.options.cards,
        }
    }
}

/// The surfaces of all materials that are seen.
struct Dresses<'a> {
    surfaces: Vec<Surface<'a>>,
    /// For a mesh and a material the number of the surface, and its place in the pictures there.
    of: BTreeMap<(usize, usize), (usize, [Vec2; 2])>,
}

fn dresses<'a, 'd>(
    scene: &Description,
    coarse: &Coarse<'a>,
    groups: impl Iterator<Item = &'d Dressed>,
) -> Result<Dresses<'a>, GltfError> {
    const WHOLE: [Vec2; 2] = [Vec2::ZERO, Vec2::ONE];
    let Coarse { world, options } = *coarse;
    let colorimetry = Colorimetry::under(options.illuminant);
    let seen = Observation {
        colorimetry: &colorimetry,
        wavelengths: world.wavelengths.grid().set(0),
        texture: options.texture,
    };
    let mut pairs: Vec<(usize, usize)> = groups
        .map(|&(_, mesh, material)| (mesh, material))
        .collect();
    pairs.sort_unstable();
    pairs.dedup();
    let (cards, others): (Vec<_>, Vec<_>) = pairs
        .into_iter()
        .partition(|&(mesh, material)| options.cards && coarse.is_sheet(mesh, material));
    let surfaces = others.par_iter().map(|&(mesh, material)| {
        let name = material_id(scene, world, material);
        match coarse.sheet(mesh, material) {
            Some(leaf) => Surface::of_blade(coarse.blade(mesh, leaf, material), &name, seen),
            None => Surface::of(&world.materials[material], &name, seen),
        }
    });
    let mut surfaces: Vec<Surface<'a>> = surfaces.collect::<Result<_, _>>()?;
    let numbered = others.into_iter().enumerate();
    let mut of: BTreeMap<_, _> = numbered
        .map(|(number, pair)| (pair, (number, WHOLE)))
        .collect();
    let blades = cards.iter().filter_map(|&(mesh, material)| {
        let leaf = coarse.sheet(mesh, material)?;
        Some(coarse.blade(mesh, leaf, material))
    });
    let blades: Vec<Blade<'a>> = blades.collect();
    if !blades.is_empty() {
        let (surface, places) = Surface::of_cards(&blades, "cards", seen)?;
        let places = places.into_iter().map(|place| (surfaces.len(), place));
        of.extend(cards.into_iter().zip(places));
        surfaces.push(surface);
    }
    Ok(Dresses { surfaces, of })
}

/// The surface of each material that is seen, by its number, with all meshes as they are.
pub(super) fn surfaces_of<'a>(
    scene: &Description,
    world: &'a World,
    texture: u32,
    illuminant: Illuminant,
) -> Result<BTreeMap<usize, Surface<'a>>, GltfError> {
    let options = GltfOptions {
        illuminant,
        texture,
        ..GltfOptions::default()
    };
    let mut seen: BTreeMap<usize, Dressed> = BTreeMap::new();
    for instance in 0..world.objects.len() as u32 {
        let material = world.objects[instance as usize].material;
        let mesh = world.geometry.instance(instance).mesh as usize;
        seen.entry(material).or_insert((0, mesh, material));
    }
    let Dresses { surfaces, of } = dresses(scene, &Coarse { world, options }, seen.values())?;
    let mut surfaces: Vec<Option<Surface<'a>>> = surfaces.into_iter().map(Some).collect();
    let numbered = of
        .into_iter()
        .filter_map(|((_, material), (number, _))| Some((material, surfaces[number].take()?)));
    Ok(numbered.collect())
}

#[cfg(test)]
mod tests;
