//! `lamina render`: a scene file to STEM.exr and STEM.png.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use crate::cli::arguments::RenderArguments;
use crate::cli::interrupt::stop_on_interrupt;
use crate::cli::progress::Reporter;
use crate::cli::{Failure, check_writable, load_scene, say, stats};
use crate::image::{openexr, portable_network, tone};
use crate::integrator::develop::develop;
use crate::integrator::render::{Ended, Halt, Job, Rendered, render_until};
use crate::scene::description::{Description, FilmKind};
use crate::scene::load::Loaded;
use crate::scene::plant_cache::PlantCache;
use crate::scene::world::World;
use crate::spectrum::wavelengths::seen_at;

pub(super) fn run(arguments: &RenderArguments) -> Result<(), Failure> {
    let started = Instant::now();
    let loaded = load_scene(&arguments.scene)?;
    let [exr, png] = outputs(arguments, &loaded)?;
    let scene = loaded.description;
    let job = Job {
        width: scene.film.width,
        height: scene.film.height,
        spp: arguments.spp.unwrap_or(scene.film.spp),
        seed: arguments.seed.unwrap_or(scene.film.seed),
    };
    let halt = Halt {
        // 0 on the command line switches off the scene's setting.
        noise: arguments
            .noise
            .or(scene.film.noise)
            .filter(|&noise| noise > 0.0),
        time: arguments.time.map(Duration::from_secs_f64),
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
    let reporter = Reporter::new(halt.time);
    let tracing = Instant::now();
    let rendered = pool
        .install(|| {
            let tell = |progress| reporter.tell(progress);
            render_until(&world, &job, &halt, &stop, &tell)
        })
        .map_err(Failure::bad)?;
    reporter.finish();
    let trace_seconds = tracing.elapsed().as_secs_f64();
    pool.install(|| write_picture(&scene, &world, &job, &rendered, &exr, &png))?;
    let paths = rendered.film.drawn();
    let times = Times {
        all: started.elapsed().as_secs_f64(),
        build: build_seconds,
        trace: trace_seconds,
    };
    if let Some(path) = &arguments.stats {
        let threads = pool.current_num_threads();
        stats::write(path, &report(&scene, &world, &rendered, &times, threads))?;
    }
    eprintln!(
        "{:.1} s in all: {:.1} s to build, {:.1} s for {:.2} million paths ({:.2} Mpaths/s, {:.2} Mrays/s)",
        times.all,
        times.build,
        times.trace,
        paths as f64 * 1e-6,
        times.millions_per_second(paths),
        times.millions_per_second(rendered.rays)
    );
    tell_samples(&rendered);
    say(exr.display());
    say(png.display());
    if rendered.film.rejected() > 0 {
        eprintln!(
            "note: {} samples were not finite and are left out",
            rendered.film.rejected()
        );
    }
    if rendered.ended == Ended::Interrupted {
        eprintln!("interrupted: the pictures hold what was rendered until then");
        return Err(Failure::Interrupted);
    }
    // More than one rejected sample in a million is not due to rounding.
    if rendered.film.rejected() as f64 > 1e-6 * paths as f64 {
        return Err(Failure::system(
            "too many samples were not finite; the picture is not to be trusted",
        ));
    }
    Ok(())
}

/// The picture files, after checking that they can be written and are not inputs.
fn outputs(arguments: &RenderArguments, loaded: &Loaded) -> Result<[PathBuf; 2], Failure> {
    let stem = match &arguments.out {
        Some(out) => stem_of(out)?,
        None => PathBuf::from(&loaded.description.name),
    };
    let outputs = ["exr", "png"].map(|ending| with_ending(&stem, ending));
    check_writable(&outputs[0])?;
    for output in &outputs {
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
    Ok(outputs)
}

/// Times of a render, seconds.
struct Times {
    all: f64,
    build: f64,
    trace: f64,
}

impl Times {
    fn millions_per_second(&self, count: u64) -> f64 {
        count as f64 * 1e-6 / self.trace
    }
}

/// The output of `--stats`.
fn report(
    scene: &Description,
    world: &World,
    rendered: &Rendered,
    times: &Times,
    threads: usize,
) -> Value {
    let film = &rendered.film;
    let pixels = f64::from(film.width()) * f64::from(film.height());
    json!({
        "scene": scene.name,
        "seconds": times.all,
        "build_seconds": times.build,
        "trace_seconds": times.trace,
        "peak_mib": stats::peak_mib(),
        "geometry_mib": world.geometry.memory_bytes() as f64 / f64::from(1 << 20),
        "threads": threads,
        "spp": film.drawn() as f64 / pixels,
        "spp_range": film.drawn_range(),
        "noise": rendered.noise.and_then(|noise| noise.reached),
        "ended": ended(rendered.ended),
        "rays": rendered.rays,
        "roulette_below": rendered.effort.roulette_below,
        "branches": rendered.effort.branches,
        "light_samples": rendered.effort.light_samples,
        "paths": film.drawn(),
        "mrays_per_s": times.millions_per_second(rendered.rays),
        "mpaths_per_s": times.millions_per_second(film.drawn()),
        "rejected_samples": film.rejected(),
        "clamped_values": film.clamped(),
        "interrupted": rendered.ended == Ended::Interrupted,
    })
}

/// Prints the number of samples per pixel if it was not given.
fn tell_samples(rendered: &Rendered) {
    let [fewest, most] = rendered.film.drawn_range();
    let pixels = f64::from(rendered.film.width()) * f64::from(rendered.film.height());
    let mean = rendered.film.drawn() as f64 / pixels;
    if let Some(noise) = rendered.noise {
        let reached = noise.reached.map_or_else(
            || "noise not known from so few".to_owned(),
            |reached| format!("noise {reached:.4}, aimed at {}", noise.aim),
        );
        eprintln!("{fewest} to {most} samples a pixel, {mean:.1} on average; {reached}");
    } else if rendered.ended == Ended::Time {
        eprintln!("{most} samples a pixel, then the time was over");
    }
}

/// The reason why a render ended, in one word.
fn ended(ended: Ended) -> &'static str {
    match ended {
        Ended::Samples => "samples",
        Ended::Noise => "noise",
        Ended::Time => "time",
        Ended::Interrupted => "interrupt",
    }
}

fn build_world(scene: &Description, arguments: &RenderArguments) -> Result<World, Failure> {
    let cache = arguments.cache.as_deref().map(PlantCache::open);
    let cache = cache.transpose().map_err(Failure::bad)?;
    World::build_with(scene, cache.as_ref()).map_err(Failure::bad)
}

/// The stem given by `--out`, which may have the ending of either picture.
fn stem_of(out: &Path) -> Result<PathBuf, Failure> {
    let text = out.as_os_str().as_encoded_bytes();
    if out.file_name().is_none() || text.ends_with(b"/") {
        return Err(Failure::bad(format!(
            "{} is a folder: name the pictures in it, for example --out {}",
            out.display(),
            out.join("leaf").display()
        )));
    }
    let is_ending = |ending: &std::ffi::OsStr| ending == "png" || ending == "exr";
    Ok(if out.extension().is_some_and(is_ending) {
        out.with_extension("")
    } else {
        out.to_owned()
    })
}

/// `stem` with an ending added, even if it already contains dots.
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

/// Linear sRGB for the PNG: that of the film, or a preview of the bands.
fn preview(scene: &Description, rendered: &Rendered) -> Vec<[f32; 3]> {
    let film = &rendered.film;
    let FilmKind::Spectral { bands } = &scene.film.kind else {
        return film.map(|pixel| [0, 1, 2].map(|i| pixel.mean(i) as f32));
    };
    // Visible bands represent the wavelengths around them; a film without visible bands is shown in
    // grey.
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
    for nm in (400..780).map(|nm| f64::from(nm) + 0.5) {
        let weight = &mut weights[nearest(nm)];
        for (sum, value) in weight.iter_mut().zip(seen_at(nm)) {
            *sum += value as f32;
        }
    }
    film.map(|pixel| {
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
}
