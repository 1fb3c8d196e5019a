//! `lamina instruments`: figures of a scene's instruments as tables.

mod plot;
mod table;

use std::io::Write as _;
use std::path::Path;
use std::time::Instant;

use crate::cli::arguments::InstrumentsArguments;
use crate::cli::progress::Patience;
use crate::cli::{Failure, colour, needs, places, say};
use crate::image::atomic;
use crate::instruments::{Budget, CutPaths, Row, notes, read_out, sets_of};
use crate::scene::description::Description;
use crate::scene::load;
use crate::scene::plant_cache::PlantCache;
use crate::scene::world::{BuildOptions, World};
use crate::spectrum::WavelengthSampler;

/// Rays if the command line says nothing.
const USUAL_RAYS: u64 = 1 << 16;
/// Most rays if it gives a target error alone.
const MOST_RAYS: u64 = 1 << 32;

pub(super) fn run(arguments: &InstrumentsArguments) -> Result<(), Failure> {
    let given = &arguments.scene;
    let loaded = load::load_for_instruments(&given.scene, &given.overrides)?;
    for warning in &loaded.warnings {
        eprint!("{}", warning.render(colour()));
    }
    let scene = loaded.description;
    let mut inputs = loaded.inputs;
    inputs.push(given.scene.clone());
    check_outputs(arguments, &inputs)?;
    let chosen = choose(arguments, &scene)?;
    let threads = arguments.threads.map_or(0, usize::from);
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(Failure::system)?;
    let most = if arguments.error.is_some() {
        MOST_RAYS
    } else {
        USUAL_RAYS
    };
    let budget = Budget {
        rays: arguments.rays.unwrap_or(most),
        error: arguments.error,
        seed: arguments.seed,
    };
    let (rows, cuts) = pool.install(|| measure(arguments, &scene, &chosen, &budget))?;
    for path in &arguments.out {
        let text = if has_ending(path, "json") {
            table::json(&scene, &budget, &rows, &cuts)
        } else {
            table::csv(&rows)
        };
        atomic::replace(path, |file| file.write_all(text.as_bytes())).map_err(Failure::system)?;
        say(path.display());
    }
    if let Some(path) = &arguments.plot {
        let drawing = plot::svg(&rows).ok_or_else(|| {
            Failure::bad(format!(
                "{}: there is nothing to draw: a line needs figures at two wavelengths, view angles \
                 or depths",
                path.display()
            ))
        })?;
        atomic::replace(path, |file| file.write_all(drawing.as_bytes()))
            .map_err(Failure::system)?;
        say(path.display());
    }
    Ok(())
}

/// Numbers of the instruments that are read out.
fn choose(arguments: &InstrumentsArguments, scene: &Description) -> Result<Vec<usize>, Failure> {
    let shown = arguments.scene.scene.display();
    let all = &scene.instruments;
    if all.is_empty() {
        return Err(Failure::bad(format!(
            "{shown} has no instruments: add one, for example `[instruments.ball.sphere]` with \
             `object = \"leaf\"`"
        )));
    }
    for name in &arguments.only {
        if !all.iter().any(|instrument| instrument.name == *name) {
            let known: Vec<&str> = all.iter().map(|known| known.name.as_str()).collect();
            return Err(Failure::bad(format!(
                "--only: {shown} has no instrument `{name}`, but {}",
                known.join(", ")
            )));
        }
    }
    let is_chosen = |name: &String| arguments.only.is_empty() || arguments.only.contains(name);
    let numbers = (0..all.len()).filter(|&number| is_chosen(&all[number].name));
    Ok(numbers.collect())
}

/// The paths that were cut in the measurement of each instrument.
type Cuts = Vec<(String, CutPaths)>;

/// Builds the scene and reads the instruments out.
fn measure(
    arguments: &InstrumentsArguments,
    scene: &Description,
    chosen: &[usize],
    budget: &Budget,
) -> Result<(Vec<Row>, Cuts), Failure> {
    needs::check_geometry(scene, "measurement", arguments.memory)?;
    let Some((sampler, first)) = sets_of(scene) else {
        return Ok((Vec::new(), Vec::new()));
    };
    let world = build(arguments, scene, &sampler)?;
    for note in &world.notes {
        eprintln!("note: {note}");
    }
    let (mut rows, mut cuts) = (Vec::new(), Vec::new());
    for &number in chosen {
        let started = Instant::now();
        let name = &scene.instruments[number].name;
        for note in notes(&world, scene, number) {
            eprintln!("note: {name}: {note}");
        }
        let found = read_out(&world, scene, number, first[number], budget).map_err(Failure::bad)?;
        if found.cut.paths > 0 {
            eprintln!(
                "note: {name}: {} paths were cut after {} events (`integrator.max_events`); what they \
                 carried, at most {:.1e} of the light, counts as absorbed",
                found.cut.paths, scene.integrator.max_events, found.cut.at_most
            );
        }
        cuts.push((name.clone(), found.cut));
        let found = found.rows;
        let greatest = found.iter().map(|row| row.error).fold(0.0, f64::max);
        eprintln!(
            "{name}: {} figures in {:.1} s, standard errors up to {greatest:.1e}",
            found.len(),
            started.elapsed().as_secs_f64()
        );
        let is_open = |row: &&Row| {
            let allowed = budget.error.map(|target| target.allowed(row.value));
            allowed.is_some_and(|allowed| row.error > allowed)
        };
        let open = found.iter().filter(is_open).count();
        if open > 0 {
            eprintln!(
                "warning: {name}: {} rays are not enough for --error: {open} figures have greater \
                 standard errors, up to {greatest:.1e}",
                budget.rays
            );
        }
        rows.extend(found);
    }
    Ok((rows, cuts))
}

fn build(
    arguments: &InstrumentsArguments,
    scene: &Description,
    sampler: &WavelengthSampler,
) -> Result<World, Failure> {
    let cache = arguments.cache.as_deref().map(PlantCache::open);
    let cache = cache.transpose().map_err(Failure::bad)?;
    let patience = Patience::building(scene.leaves.len());
    let options = BuildOptions {
        cache: cache.as_ref(),
        wavelengths: Some(sampler),
        ..patience.options()
    };
    World::build_with(scene, &options).map_err(Failure::bad)
}

/// Fails if files cannot be written, are named twice or read, or end in what is not written.
fn check_outputs(
    arguments: &InstrumentsArguments,
    inputs: &[std::path::PathBuf],
) -> Result<(), Failure> {
    for path in &arguments.out {
        if !has_ending(path, "csv") && !has_ending(path, "json") {
            return Err(Failure::bad(format!(
                "{}: --out writes tables: let its name end in .csv or .json",
                path.display()
            )));
        }
    }
    if let Some(path) = arguments
        .plot
        .as_ref()
        .filter(|path| !has_ending(path, "svg"))
    {
        return Err(Failure::bad(format!(
            "{}: --plot draws: let its name end in .svg",
            path.display()
        )));
    }
    let outputs: Vec<&Path> = arguments
        .out
        .iter()
        .chain(&arguments.plot)
        .map(std::path::PathBuf::as_path)
        .collect();
    places::check_outputs(&outputs, inputs, "the command")
}

fn has_ending(path: &Path, ending: &str) -> bool {
    path.extension()
        .is_some_and(|given| given.eq_ignore_ascii_case(ending))
}
