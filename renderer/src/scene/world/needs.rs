//! Memory that the things of a scene will need, said before any of them is built, and what is left of it
//! while they are.

use super::error::WorldError;
use crate::geometry::TriangleMesh;
use crate::geometry::scatter::{Amount, Most, Volume};
use crate::geometry::shapes::{Disc, Drop, Lump, Sphere};
use crate::image::claimed;
use crate::scene::assets;
use crate::scene::description::{Description, Held, Mesh, Object, Shape, StrewnOn};

/// Memory of a triangle with its fraction of the trees while they are built, bytes; measured with
/// spheres of 16.8 million triangles (4.9 GB).
const OF_A_TRIANGLE: f64 = 290.0;

/// Memory of an instance of a mesh, bytes: its placement with its fraction of the upper tree;
/// measured with 168,000 leaves of two parts (363 MB).
const OF_AN_INSTANCE: f64 = 1100.0;

/// Memory of a place of an object of two parts, as a leaf with its petiole is, bytes.
const OF_A_PLACE: f64 = 2.0 * OF_AN_INSTANCE;

/// Memory of what a scene builds and grows, bytes, with what it is for.
///
/// # Errors
///
/// The leaf or body of which nobody can say what it needs, and why.
pub(crate) fn of_geometry(scene: &Description) -> Result<Vec<(f64, &'static str)>, String> {
    let mut pictures = of_pictures(scene);
    let meshes = scene.meshes.iter().enumerate();
    let meshes = meshes.map(|(number, named)| match &named.value {
        Shape::Body(body) => body.triangles.len() as f64 * OF_A_TRIANGLE,
        Shape::Mesh(
            Mesh::Sphere(Sphere { segments, .. })
            | Mesh::Drop(Drop { segments, .. })
            | Mesh::Lump(Lump { segments, .. }),
        ) => f64::from(*segments) * f64::from(*segments) * OF_A_TRIANGLE,
        Shape::Mesh(Mesh::Terrain(terrain)) => {
            let [across, along] = terrain.squares();
            2.0 * across * along * OF_A_TRIANGLE
        }
        Shape::Mesh(Mesh::Masonry(wall)) => 2.0 * wall.squares() * OF_A_TRIANGLE,
        Shape::Mesh(Mesh::Disc(disc)) => f64::from(disc.segments) * OF_A_TRIANGLE,
        Shape::Mesh(Mesh::Gltf(model)) => {
            // Reading reports what is wrong with it.
            let claims = assets::claims_of_model(model, scene.wanted_of(number));
            claims.map_or(0.0, |claims| {
                pictures += claims.pictures;
                claims.triangles as f64 * OF_A_TRIANGLE
            })
        }
        Shape::Mesh(Mesh::Rectangle(_) | Mesh::Box(_) | Mesh::File(_)) => 0.0,
    });
    let meshes: f64 = meshes.fold(0.0, |sum, bytes| sum + bytes);
    let places = scene.objects.iter().map(|object| {
        let own = object.value.instances.as_ref().map_or(1, Vec::len);
        let strewn = object.value.strewn.as_ref();
        let copies = strewn.map_or(1.0, |strewn| match strewn.plan.amount {
            Amount::Count(count) => f64::from(count),
            Amount::PerSquareMetre(density) => density * area(scene, strewn),
        });
        let afloat = object.value.volume.as_ref();
        let copies = afloat.map_or(copies, |volume| leaves_afloat(scene, &object.value, volume));
        own as f64 * copies * OF_A_PLACE
    });
    let mut leaves = Vec::new();
    for leaf in &scene.leaves {
        let memory = leaf.value.plan.memory();
        leaves.push(memory.map_err(|error| format!("leaves.{}: {error}", leaf.name))?);
    }
    let kept = leaves.iter().map(|leaf| leaf.kept);
    // As many leaves grow at once as there are threads; the largest may be among them.
    let mut growing: Vec<f64> = leaves.iter().map(|leaf| leaf.veins + leaf.blade).collect();
    growing.sort_by(|a, b| b.total_cmp(a));
    growing.truncate(rayon::current_num_threads());
    let mut bodies = 0.0;
    for solid in &scene.solids {
        let of_one = solid.value.plan.memory_bytes();
        bodies += of_one.map_err(|error| format!("solids.{}: {error}", solid.name))?;
    }
    // The sums start from 0, since an empty sum is -0.
    let sum = |all: &mut dyn Iterator<Item = f64>| all.fold(0.0, |sum, bytes| sum + bytes);
    Ok(vec![
        (meshes, "meshes"),
        (pictures, "pictures that are read"),
        (sum(&mut { places }), "places of objects"),
        (sum(&mut { kept }) + sum(&mut growing.into_iter()), "leaves"),
        (bodies, "bodies"),
    ])
}

/// Memory of the pictures of materials and lights while they are read, bytes.
fn of_pictures(scene: &Description) -> f64 {
    let materials = scene.materials.iter().flat_map(|material| {
        let picture = material.value.picture().map(|(file, _)| file);
        let map = match material.value.held() {
            Some(Held::Map { file, .. }) => Some(file.as_path()),
            Some(Held::Contents { .. }) | None => None,
        };
        picture.into_iter().chain(map)
    });
    let lights = scene.lights.iter();
    let lights = lights.filter_map(|light| light.value.picture().map(|(file, _)| file));
    let files = materials.chain(lights);
    files.fold(0.0, |sum, file| sum + claimed::bytes_of_file(file))
}

/// About the number of leaves in a volume: of discs, since the areas of other shapes are known only
/// once they are built.
fn leaves_afloat(scene: &Description, object: &Object, volume: &Volume) -> f64 {
    let [least, most] = volume.within;
    let ground = (most - least).truncate().element_product();
    let leaf = mesh_of(scene, object).and_then(flat_area);
    leaf.map_or(0.0, |leaf| volume.lai * ground / leaf)
}

/// About the area over which something is strewn, m²: that of its rectangle or of an even or uneven
/// ground in one place; of other surfaces none, since it is known only once they are built.
fn area(scene: &Description, strewn: &StrewnOn) -> f64 {
    if let Some([least, most]) = strewn.plan.within {
        return (most - least).element_product();
    }
    let on = &scene.objects[strewn.on].value;
    let mesh = mesh_of(scene, on).filter(|_| on.instances.is_none());
    let size = match mesh {
        Some(Mesh::Terrain(terrain)) => Some(terrain.size[0] * terrain.size[1]),
        Some(Mesh::Rectangle(ground)) => Some(ground.width * ground.height),
        Some(_) | None => None,
    };
    size.map_or(0.0, |size| {
        let [x, y] = [on.to_world.x_axis, on.to_world.y_axis].map(glam::DVec4::truncate);
        size * x.cross(y).length()
    })
}

/// The mesh of an object's first shape, if the scene says what it is.
fn mesh_of<'s>(scene: &'s Description, object: &Object) -> Option<&'s Mesh> {
    match &scene.meshes[object.first_mesh()?].value {
        Shape::Mesh(mesh) => Some(mesh),
        Shape::Body(_) => None,
    }
}

/// The area of a leaf that is given by its numbers, m².
fn flat_area(mesh: &Mesh) -> Option<f64> {
    match mesh {
        Mesh::Disc(Disc { radius, .. }) => Some(std::f64::consts::PI * radius * radius),
        Mesh::Rectangle(leaf) => Some(leaf.width * leaf.height),
        Mesh::Sphere(_)
        | Mesh::Box(_)
        | Mesh::Drop(_)
        | Mesh::Lump(_)
        | Mesh::Terrain(_)
        | Mesh::Masonry(_)
        | Mesh::File(_)
        | Mesh::Gltf(_) => None,
    }
}

/// Memory that is left for what is built next.
#[derive(Debug)]
pub(super) struct Memory {
    /// What may be taken in all, bytes; infinite if nobody limits it.
    all: f64,
    left: f64,
}

impl Memory {
    pub(super) fn new(most_bytes: Option<f64>) -> Self {
        let all = most_bytes.unwrap_or(f64::INFINITY);
        Self { all, left: all }
    }

    /// Takes what meshes need with their trees.
    pub(super) fn take_meshes(&mut self, meshes: &[TriangleMesh]) -> Result<(), WorldError> {
        let triangles: usize = meshes.iter().map(|mesh| mesh.triangles().len()).sum();
        let needed = triangles as f64 * OF_A_TRIANGLE;
        if needed > self.left {
            return Err(WorldError::Memory {
                triangles,
                needed,
                allowed: self.all,
            });
        }
        self.left -= needed;
        Ok(())
    }

    /// How many things there may be if each is so many instances.
    pub(super) fn most(&self, instances: usize) -> Most {
        let things = self.left / (instances.max(1) as f64 * OF_AN_INSTANCE);
        // Infinity becomes the greatest number.
        Most::UNBOUND.and(Most::InMemory(things as usize))
    }

    /// Takes what instances need.
    pub(super) fn take_instances(&mut self, instances: usize) {
        self.left -= instances as f64 * OF_AN_INSTANCE;
    }
}
