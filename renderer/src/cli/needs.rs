//! Memory that a render, an export or the growth of a leaf needs, said before it begins.

use crate::cli::terminal::Failure;
use crate::film::Film;
use crate::integrator::layers::Layout;
use crate::scene::description::Description;
use crate::scene::world::needs::of_geometry;
use crate::spectrum::WavelengthSampler;

const MIB: f64 = 1024.0 * 1024.0;
const GIB: f64 = 1024.0 * MIB;

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
    needs.extend(of_geometry(scene).map_err(Failure::bad)?);
    compare("render", &needs, allowed)
}

/// As [`check`], for work of this name that makes no picture.
pub(super) fn check_geometry(
    scene: &Description,
    work: &str,
    allowed: Option<f64>,
) -> Result<(), Failure> {
    compare(work, &of_geometry(scene).map_err(Failure::bad)?, allowed)
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
    Err(bad!(
        "this {work} needs about {} of memory{parts}, more than {limit}: make it smaller, or allow it with --memory {}",
        shown(needed),
        (needed / GIB).ceil(),
    ))
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
    let used = |name| reported_bytes("/proc/self/status", name);
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
/// does not report it.
fn free_bytes() -> Option<f64> {
    reported_bytes("/proc/meminfo", "MemAvailable:")
}

/// Greatest resident memory of this process so far, MiB; `None` where the system does not report
/// it.
pub(super) fn peak_mib() -> Option<f64> {
    Some(reported_bytes("/proc/self/status", "VmHWM:")? / MIB)
}

/// A number of bytes by its name in a file of the system that counts in KiB.
fn reported_bytes(file: &str, name: &str) -> Option<f64> {
    let text = std::fs::read_to_string(file).ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix(name))?;
    let kib: f64 = line.split_whitespace().next()?.parse().ok()?;
    Some(kib * 1024.0)
}

/// Does work on so many threads; without a number on one for each processor.
pub(super) fn on_threads<T: Send>(
    threads: Option<u16>,
    work: impl FnOnce() -> Result<T, Failure> + Send,
) -> Result<T, Failure> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.map_or(0, usize::from));
    pool.build().map_err(Failure::system)?.install(work)
}
