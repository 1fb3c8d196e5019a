//! Memory that a render needs, said before it begins.

use crate::cli::Failure;
use crate::film::Film;
use crate::integrator::layers::Layout;
use crate::scene::description::{Description, Mesh};
use crate::spectrum::WavelengthSampler;

const MIB: f64 = 1024.0 * 1024.0;
const GIB: f64 = 1024.0 * MIB;

/// Memory of a triangle with its share of the trees while they are built, bytes; measured with
/// spheres of 16.8 million triangles (4.9 GB).
const OF_A_TRIANGLE: f64 = 290.0;

/// Copies of a picture's layers while its file is made: values, compressed blocks, the file.
const COPIES: f64 = 3.0;

/// Fails if a render needs more memory than `allowed` (GiB), or than the machine has free, or has
/// a film that cannot be made. The estimate takes in the film, its pictures and spheres; not what
/// is grown or read, which is small beside a large film.
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
    let spheres = scene.meshes.iter().map(|mesh| match mesh.value {
        Mesh::Sphere { segments, .. } => f64::from(segments) * f64::from(segments) * OF_A_TRIANGLE,
        Mesh::Rectangle { .. } | Mesh::File { .. } => 0.0,
    });
    // The sum starts from 0, since an empty sum is -0.
    let spheres = spheres.fold(0.0, |sum, bytes: f64| sum + bytes);
    let needed = sums + pictures + spheres;
    let free = || free_bytes().unwrap_or(f64::INFINITY);
    if needed <= allowed.map_or_else(free, |allowed| allowed * GIB) {
        return Ok(());
    }
    let limit = match allowed {
        Some(allowed) => format!("the {allowed} GiB of --memory"),
        None => format!("the {} that are free", shown(free())),
    };
    Err(Failure::bad(format!(
        "this render needs about {} of memory ({} for the film, {} for its pictures, {} for spheres), \
         more than {limit}: make it smaller, or allow it with --memory {}",
        shown(needed),
        shown(sums),
        shown(pictures),
        shown(spheres),
        (needed / GIB).ceil(),
    )))
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
