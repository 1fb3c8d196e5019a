//! `lamina render`: a scene file to STEM.exr and STEM.png.

use std::path::{Path, PathBuf};
use std::time::Instant;

use serde_json::json;

use crate::cli::arguments::RenderArguments;
use crate::cli::interrupt::stop_on_interrupt;
use crate::cli::progress::Reporter;
use crate::cli::{Failure, check_writable, load_scene, say, stats};
use crate::image::{openexr, portable_network, tone};
use crate::integrator::develop::develop;
use crate::integrator::render::{Job, Rendered, render};
use crate::scene::description::{Description, FilmKind};
use crate::scene::plant_cache::PlantCache;
use crate::scene::world::{World, wavelength_sampler};
use crate::spectrum::Lanes;

pub(super) fn run(arguments: &RenderArguments) -> Result<(), Failure> {
    let started = Instant::now();
    let loaded = load_scene(&arguments.scene)?;
    let scene = loaded.description;
    let stem = arguments
        .out
        .clone()
        .unwrap_or_else(|| PathBuf::from(&scene.name));
    let exr = with_ending(&stem, "exr");
    let png = with_ending(&stem, "png");
    check_writable(&exr)?;
    for output in [&exr, &png] {
        let is_input =
            std::fs::canonicalize(output).is_ok_and(|file| loaded.inputs.contains(&file));
        if is_input {
            return Err(Failure::bad(format!(
                "{} is a file that the scene reads: let --out name another",
                output.display()
            )));
        }
    }
    if let Some(path) = &arguments.stats {
        check_writable(path)?;
    }
    let job = Job {
        width: scene.film.width,
        height: scene.film.height,
        spp: arguments.spp.unwrap_or(scene.film.spp),
        seed: arguments.seed.unwrap_or(scene.film.seed),
    };
    let threads = arguments.threads.map_or(0, usize::from);
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(Failure::system)?;
    let world = pool.install(|| build_world(&scene, arguments))?;
    for note in &world.notes {
        eprintln!("note: {note}");
    }
    let build_seconds = started.elapsed().as_secs_f64();
    let stop = stop_on_interrupt()?;
    let reporter = Reporter::new();
    let tracing = Instant::now();
    let rendered = pool
        .install(|| render(&world, &job, &stop, &|progress| reporter.tell(progress)))
        .map_err(Failure::bad)?;
    reporter.finish();
    let trace_seconds = tracing.elapsed().as_secs_f64();
    write_picture(&scene, &world, &job, &rendered, &exr, &png)?;
    let paths = rendered.film.samples() + rendered.film.rejected();
    let seconds = started.elapsed().as_secs_f64();
    let rays_per_second = rendered.rays as f64 / trace_seconds;
    let paths_per_second = paths as f64 / trace_seconds;
    if let Some(path) = &arguments.stats {
        let report = json!({
            "scene": scene.name,
            "seconds": seconds,
            "build_seconds": build_seconds,
            "trace_seconds": trace_seconds,
            "peak_mib": stats::peak_mib(),
            "geometry_mib": world.geometry.memory_bytes() as f64 / f64::from(1 << 20),
            "threads": pool.current_num_threads(),
            "spp": paths as f64 / (f64::from(job.width) * f64::from(job.height)),
            "rays": rendered.rays,
            "paths": paths,
            "mrays_per_s": rays_per_second * 1e-6,
            "mpaths_per_s": paths_per_second * 1e-6,
            "rejected_samples": rendered.film.rejected(),
            "clamped_values": rendered.film.clamped(),
            "interrupted": rendered.interrupted,
        });
        stats::write(path, &report)?;
    }
    eprintln!(
        "{:.1} s in all: {build_seconds:.1} s to build, {trace_seconds:.1} s for {:.2} million paths \
         ({:.2} Mpaths/s, {:.2} Mrays/s)",
        seconds,
        paths as f64 * 1e-6,
        paths_per_second * 1e-6,
        rays_per_second * 1e-6
    );
    say(exr.display());
    say(png.display());
    if rendered.film.rejected() > 0 {
        eprintln!(
            "note: {} samples were not finite and are left out",
            rendered.film.rejected()
        );
    }
    if rendered.interrupted {
        eprintln!("interrupted: the pictures hold what was rendered until then");
        return Err(Failure::Interrupted);
    }
    // More than one sample in a million lost is no rounding accident.
    if rendered.film.rejected() as f64 > 1e-6 * paths as f64 {
        return Err(Failure::system(
            "too many samples were not finite; the picture is not to be trusted",
        ));
    }
    Ok(())
}

fn build_world(scene: &Description, arguments: &RenderArguments) -> Result<World, Failure> {
    let cache = arguments.cache.as_deref().map(PlantCache::open);
    let cache = cache.transpose().map_err(Failure::bad)?;
    World::build_with(scene, cache.as_ref()).map_err(Failure::bad)
}

/// `stem` with an ending added, whatever dots it has already.
fn with_ending(stem: &Path, ending: &str) -> PathBuf {
    let mut name = stem.as_os_str().to_owned();
    name.push(".");
    name.push(ending);
    PathBuf::from(name)
}

fn write_picture(
    scene: &Description,
    world: &World,
    job: &Job,
    rendered: &Rendered,
    exr: &Path,
    png: &Path,
) -> Result<(), Failure> {
    let picture = develop(scene, world, job, rendered);
    openexr::write(&picture, exr).map_err(Failure::system)?;
    let colours = preview(scene, rendered);
    let bytes = tone::to_bytes(
        colours.as_flattened(),
        scene.picture.exposure_ev,
        scene.picture.tone,
    );
    portable_network::write(png, job.width, job.height, &bytes).map_err(Failure::system)
}

/// Linear sRGB for the PNG: the film's own, or what the bands would look like.
fn preview(scene: &Description, rendered: &Rendered) -> Vec<[f32; 3]> {
    let film = &rendered.film;
    let FilmKind::Spectral { bands } = &scene.film.kind else {
        return film
            .pixels()
            .iter()
            .map(|pixel| [0, 1, 2].map(|i| pixel.mean(i) as f32))
            .collect();
    };
    // Bands within the visible stand for the wavelengths around them; a film without any is shown grey.
    let visible = wavelength_sampler(&FilmKind::Rgb {
        range_nm: [400.0, 780.0],
    });
    let steps = 380;
    let nearest = |nm: f64| {
        let distance = |i: &usize| (bands[*i].center_nm - nm).abs();
        (0..bands.len())
            .min_by(|a, b| distance(a).total_cmp(&distance(b)))
            .unwrap_or(0)
    };
    let in_sight = bands
        .iter()
        .any(|band| (400.0..=780.0).contains(&band.center_nm));
    let mut weights = vec![[0.0_f32; 3]; bands.len()];
    for step in 0..steps {
        let wavelengths = visible.draw::<1>((step as f32 + 0.5) / steps as f32);
        let mut colour = [0.0; 3];
        visible.film_values(&wavelengths, &Lanes::ONE, &mut colour);
        let weight = &mut weights[nearest(f64::from(wavelengths.nm[0]))];
        for (sum, value) in weight.iter_mut().zip(colour) {
            *sum += value / steps as f32;
        }
    }
    film.pixels()
        .iter()
        .map(|pixel| {
            if !in_sight {
                let mean = (0..bands.len()).map(|band| pixel.mean(band)).sum::<f64>();
                return [(mean / bands.len() as f64) as f32; 3];
            }
            let mut colour = [0.0; 3];
            for (band, weight) in weights.iter().enumerate() {
                for (sum, value) in colour.iter_mut().zip(weight) {
                    *sum += value * pixel.mean(band) as f32;
                }
            }
            colour
        })
        .collect()
}
