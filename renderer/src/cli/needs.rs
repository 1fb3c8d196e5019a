//! Memory that a render, an export or the growth of a leaf needs, said before it begins.

use std::path::PathBuf;

use crate::cli::Failure;
use crate::film::Film;
use crate::geometry::scatter::{Amount, Volume};
use crate::image::claimed;
use crate::integrator::layers::Layout;
use crate::scene::assets;
use crate::scene::description::{
    Description, Drop, Held, Lump, Mesh, Object, ObjectShape, Reflectance, Shape, StrewnOn,
};
use crate::scene::world::memory::{OF_A_TRIANGLE, OF_AN_INSTANCE};
use crate::spectrum::WavelengthSampler;

const MIB: f64 = 1024.0 * 1024.0;
const GIB: f64 = 1024.0 * MIB;

/// Memory of a place of an object of two parts, as a leaf with its petiole is, bytes.
const OF_A_PLACE: f64 = 2.0 * OF_AN_INSTANCE;

/// Copies of a picture's layers while its file is made: values, compressed blocks, the file.
const COPIES: f64 = 3.0;

/// Fails if a scene, once grown and built, and its picture need more memory than `allowed` (GiB),
/// or than the machine has free, or has a film that cannot be made. Meshes of OBJ and PLY files are
/// not counted here, but when they have been read.
pub(super) fn check(scene: &Description, allowed: Option<f64>) -> Result<(), Failure> {
    let film = &scene.film;
    let layout = Layout::new(&WavelengthSampler::new(&film.kind));
    let sums = Film::bytes(film.width, film.height, layout.beauty, &layout.sums());
    let sums = sums.map_err(Failure::bad)? as f64;
    let channels: usize = layout
        .layers()
        .map(|layer| layer.channel_names(&film.kind).len())
        .sum();
    let pixels = f64::from(film.width) * f64::from(film.height);
    let pictures = COPIES * 4.0 * channels as f64 * pixels;
    let mut needs = vec![(sums, "the film"), (pictures, "its pictures")];
    needs.extend(of_geometry(scene)?);
    compare("render", &needs, allowed)
}

/// As [`check`], for work of this name that makes no picture.
pub(super) fn check_geometry(
    scene: &Description,
    work: &str,
    allowed: Option<f64>,
) -> Result<(), Failure> {
    compare(work, &of_geometry(scene)?, allowed)
}

/// Memory of what a scene builds and grows, bytes, with what it is for.
fn of_geometry(scene: &Description) -> Result<Vec<(f64, &'static str)>, Failure> {
    let mut pictures = of_pictures(scene);
    let meshes = scene.meshes.iter().enumerate();
    let meshes = meshes.map(|(number, named)| match &named.value {
        Shape::Body(body) => body.triangles.len() as f64 * OF_A_TRIANGLE,
        Shape::Mesh(
            Mesh::Sphere { segments, .. }
            | Mesh::Drop(Drop { segments, .. })
            | Mesh::Lump(Lump { segments, .. }),
        ) => f64::from(*segments) * f64::from(*segments) * OF_A_TRIANGLE,
        Shape::Mesh(Mesh::Terrain(terrain)) => {
            let [across, along] = terrain.squares();
            2.0 * across * along * OF_A_TRIANGLE
        }
        Shape::Mesh(Mesh::Masonry(wall)) => 2.0 * wall.squares() * OF_A_TRIANGLE,
        Shape::Mesh(Mesh::Disc { segments, .. }) => f64::from(*segments) * OF_A_TRIANGLE,
        Shape::Mesh(Mesh::Gltf { file, beside, .. }) => {
            // Reading reports what is wrong with it.
            let claims = assets::claims_of_model(file, beside, scene.wanted_of(number));
            claims.map_or(0.0, |claims| {
                pictures += claims.pictures;
                claims.triangles as f64 * OF_A_TRIANGLE
            })
        }
        Shape::Mesh(Mesh::Rectangle { .. } | Mesh::Box { .. } | Mesh::File { .. }) => 0.0,
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
        leaves
            .push(memory.map_err(|error| Failure::bad(format!("leaves.{}: {error}", leaf.name)))?);
    }
    let kept = leaves.iter().map(|leaf| leaf.kept);
    // As many leaves grow at once as there are threads; the largest may be among them.
    let mut growing: Vec<f64> = leaves.iter().map(|leaf| leaf.veins + leaf.blade).collect();
    growing.sort_by(|a, b| b.total_cmp(a));
    growing.truncate(rayon::current_num_threads());
    let mut bodies = 0.0;
    for solid in &scene.solids {
        let of_one = solid.value.plan.memory_bytes();
        bodies +=
            of_one.map_err(|error| Failure::bad(format!("solids.{}: {error}", solid.name)))?;
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
        let reflectance = match material.value.reflectance() {
            Some(Reflectance::Picture { file, .. }) => Some(file),
            Some(Reflectance::Even(_) | Reflectance::OfMesh(_)) | None => None,
        };
        let held = match material.value.held() {
            Some(Held::Map { file, .. }) => Some(file),
            Some(Held::Contents { .. }) | None => None,
        };
        reflectance.into_iter().chain(held)
    });
    let lights = scene.lights.iter();
    let lights = lights.filter_map(|light| light.value.picture().map(|(file, _)| file));
    let files = materials.map(PathBuf::as_path).chain(lights);
    files.fold(0.0, |sum, file| sum + claimed::bytes_of_file(file))
}

/// About the number of leaves in a volume: of discs, since the areas of other shapes are known only
/// once they are built.
fn leaves_afloat(scene: &Description, object: &Object, volume: &Volume) -> f64 {
    let [least, most] = volume.within;
    let ground = (most - least).truncate().element_product();
    let Some(ObjectShape::Mesh { mesh, .. }) = object.shapes.first() else {
        return 0.0;
    };
    let Shape::Mesh(mesh) = &scene.meshes[*mesh].value else {
        return 0.0;
    };
    match mesh {
        Mesh::Disc { radius, .. } => volume.lai * ground / (std::f64::consts::PI * radius * radius),
        Mesh::Rectangle { width, height } => volume.lai * ground / (width * height),
        Mesh::Sphere { .. }
        | Mesh::Box { .. }
        | Mesh::Drop(_)
        | Mesh::Lump(_)
        | Mesh::Terrain(_)
        | Mesh::Masonry(_)
        | Mesh::File { .. }
        | Mesh::Gltf { .. } => 0.0,
    }
}

/// About the area over which something is strewn, m²: that of its rectangle or of an even or uneven
/// ground in one place; of other surfaces none, since it is known only once they are built.
fn area(scene: &Description, strewn: &StrewnOn) -> f64 {
    if let Some([least, most]) = strewn.plan.within {
        return (most - least).element_product();
    }
    let on = &scene.objects[strewn.on].value;
    let (Some(ObjectShape::Mesh { mesh, .. }), None) = (on.shapes.first(), &on.instances) else {
        return 0.0;
    };
    let Shape::Mesh(mesh) = &scene.meshes[*mesh].value else {
        return 0.0;
    };
    let size = match mesh {
        Mesh::Rectangle { width, height } => width * height,
        Mesh::Terrain(terrain) => terrain.size[0] * terrain.size[1],
        Mesh::Sphere { .. }
        | Mesh::Box { .. }
        | Mesh::Disc { .. }
        | Mesh::Drop(_)
        | Mesh::Lump(_)
        | Mesh::Masonry(_)
        | Mesh::File { .. }
        | Mesh::Gltf { .. } => return 0.0,
    };
    let [x, y] = [on.to_world.x_axis, on.to_world.y_axis].map(glam::DVec4::truncate);
    size * x.cross(y).length()
}

/// Fails if what is needed is more than what is allowed.
pub(super) fn compare(
    work: &str,
    needs: &[(f64, &'static str)],
    allowed: Option<f64>,
) -> Result<(), Failure> {
    let needed = needs.iter().fold(0.0, |sum, (bytes, _)| sum + bytes);
    let most = most_bytes(allowed).unwrap_or(f64::INFINITY);
    if needed <= most {
        return Ok(());
    }
    let limit = match allowed {
        Some(allowed) if allowed * GIB <= most => format!("the {allowed} GiB of --memory"),
        Some(_) => format!("the {} that the system lets this program have", shown(most)),
        None => format!("the {} that are free", shown(most)),
    };
    let parts = needs.iter().filter(|(bytes, _)| *bytes >= MIB);
    let parts: Vec<String> = parts
        .map(|(bytes, what)| format!("{} for {what}", shown(*bytes)))
        .collect();
    let parts = match parts.as_slice() {
        [] => String::new(),
        parts => format!(" ({})", parts.join(", ")),
    };
    Err(Failure::bad(format!(
        "this {work} needs about {} of memory{parts}, more than {limit}: make it smaller, or allow it with --memory {}",
        shown(needed),
        (needed / GIB).ceil(),
    )))
}

/// Bytes that a scene may take while it is built: `allowed` GiB, or what the machine has free, and no
/// more than the system lets this program have.
pub(super) fn most_bytes(allowed: Option<f64>) -> Option<f64> {
    let most = allowed.map(|allowed| allowed * GIB).or_else(free_bytes);
    most.into_iter().chain(granted_bytes()).reduce(f64::min)
}

/// Bytes that the limits of this process and of its group (`ulimit -v`, a container's memory) leave;
/// `None` without limits, or where the system does not report them.
fn granted_bytes() -> Option<f64> {
    let read = |path: &str| std::fs::read_to_string(path).ok();
    let status = read("/proc/self/status")?;
    let used = |name: &str| -> Option<f64> {
        let line = status.lines().find_map(|line| line.strip_prefix(name))?;
        let kib: f64 = line.split_whitespace().next()?.parse().ok()?;
        Some(kib * 1024.0)
    };
    #[cfg(unix)]
    let of_process = {
        use rustix::process::{Resource, getrlimit};
        let limit = getrlimit(Resource::As).current;
        limit.and_then(|limit| Some(limit as f64 - used("VmSize:")?))
    };
    #[cfg(not(unix))]
    let of_process: Option<f64> = None;
    let group = read("/proc/self/cgroup").unwrap_or_default();
    let group = group.lines().find_map(|line| line.strip_prefix("0::"));
    let group = group.unwrap_or("/").trim_end_matches('/');
    // Within a container its own group is the root.
    let files = [
        format!("/sys/fs/cgroup{group}/memory.max"),
        "/sys/fs/cgroup/memory.max".to_owned(),
    ];
    let limit = files
        .iter()
        .find_map(|file| read(file)?.trim().parse::<f64>().ok());
    let of_group = limit.and_then(|limit| Some(limit - used("VmRSS:")?));
    of_process
        .into_iter()
        .chain(of_group)
        .map(|bytes: f64| bytes.max(0.0))
        .reduce(f64::min)
}

fn shown(bytes: f64) -> String {
    if bytes < GIB {
        format!("{:.0} MiB", bytes / MIB)
    } else {
        format!("{:.1} GiB", bytes / GIB)
    }
}

/// Memory that programs can have without others having to give up theirs; `None` where the system
/// does not tell.
fn free_bytes() -> Option<f64> {
    let memory = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = memory
        .lines()
        .find_map(|line| line.strip_prefix("MemAvailable:"))?;
    let kib: f64 = line.split_whitespace().next()?.parse().ok()?;
    Some(kib * 1024.0)
}
