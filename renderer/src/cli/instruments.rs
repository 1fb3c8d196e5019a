//! `lamina instruments`: figures of a scene's instruments as tables.

use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use crate::cli::arguments::InstrumentsArguments;
use crate::cli::building::Building;
use crate::cli::needs;
use crate::cli::needs::on_threads;
use crate::cli::places::{
    check_outputs, has_ending, is_json_not_csv, require_ending, write_and_say,
};
use crate::cli::progress::Clock;
use crate::cli::signals::Signals;
use crate::cli::terminal::{Failure, note, warn};
use crate::image::atomic::folder_of;
use crate::instruments::{
    Budget, CutPaths, Effort, ErrorParts, MOST_TURNS, Reading, Row, Watch, notes, read_out_watched,
    sets_of,
};
use crate::provenance::{Provenance, Settings};
use crate::report::instruments as report;
use crate::scene::description::{Description, Named};
use crate::scene::fingerprint::hexadecimal;
use crate::scene::load;
use crate::scene::world::BuildOptions;

/// Rays if the command line says nothing.
const USUAL_RAYS: u64 = 1 << 16;
/// Most rays if it gives a target error alone.
const MOST_RAYS: u64 = 1 << 32;

pub(super) fn run(arguments: &InstrumentsArguments, settings: &Settings) -> Result<(), Failure> {
    let signals = Signals::listen()?;
    let given = &arguments.scene;
    let loaded = load::load_for_instruments(&given.scene, &given.overrides)?;
    warn(&loaded.warnings);
    let mut provenance = Provenance {
        scene: Some(hexadecimal(loaded.fingerprint().map_err(Failure::bad)?)),
        files: loaded
            .files(folder_of(&given.scene))
            .map_err(Failure::bad)?,
        overrides: given.overrides.clone(),
        ..Provenance::of("instruments", "out", settings)
    };
    let scene = loaded.description;
    let mut inputs = loaded.inputs;
    inputs.push(given.scene.clone());
    for path in &arguments.out {
        is_json_not_csv(Some(path))?;
    }
    require_ending(&arguments.plot, "svg", "--plot draws")?;
    let outputs = arguments.out.iter().chain(&arguments.plot);
    check_outputs(outputs, &inputs, "the command")?;
    let chosen = choose(arguments, &scene)?;
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
    let rays = vec![budget.rays.to_string()];
    provenance.settings.insert("rays".to_owned(), rays);
    let MeasuredRows { rows, cuts, ended } = on_threads(arguments.threads, || {
        measure(arguments, &scene, &chosen, &budget, &signals)
    })?;
    let ended = match ended {
        // Nothing was measured: what older runs wrote stays.
        Some(ReadOutEnd::Failed(failure)) if rows.is_empty() => return Err(failure),
        ended => ended,
    };
    provenance.complete = ended.is_none();
    for path in &arguments.out {
        let text = if has_ending(path, "json") {
            report::json(&scene, &budget, (&rows, &cuts), &provenance)
        } else {
            provenance.comment() + &report::csv(&rows)
        };
        write_and_say(path, text)?;
    }
    if let Some(path) = &arguments.plot {
        let drawing = report::svg(&rows).ok_or_else(|| {
            bad_at!(
                path,
                "there is nothing to draw: a line needs figures at two wavelengths, view angles \
                 or depths"
            )
        })?;
        write_and_say(path, drawing)?;
    }
    match ended {
        Some(ReadOutEnd::Failed(failure)) => Err(failure),
        Some(ReadOutEnd::Late) | None => Ok(()),
    }
}

/// What was measured.
#[derive(Default)]
struct MeasuredRows {
    rows: Vec<Row>,
    /// Paths that the limit of events cut, of each instrument.
    cuts: CutsByName,
    /// Why not all of it was, or not with all rays.
    ended: Option<ReadOutEnd>,
}

/// Why a measurement ended early.
enum ReadOutEnd {
    /// The time was over.
    Late,
    /// One of the instruments cannot measure, or somebody interrupted it.
    Failed(Failure),
}

/// Numbers of the instruments that are read out.
fn choose(arguments: &InstrumentsArguments, scene: &Description) -> Result<Vec<usize>, Failure> {
    let shown = arguments.scene.scene.display();
    let all = &scene.instruments;
    if all.is_empty() {
        bail!(
            "{shown} has no instruments: add one, for example `[instruments.ball.sphere]` with \
             `object = \"leaf\"`"
        );
    }
    for name in &arguments.only {
        if !all.iter().any(|instrument| instrument.name == *name) {
            let known: Vec<&str> = all.iter().map(|known| known.name.as_str()).collect();
            bail!(
                "--only: {shown} has no instrument `{name}`, but {}",
                known.join(", ")
            );
        }
    }
    let is_chosen = |name: &String| arguments.only.is_empty() || arguments.only.contains(name);
    let numbers = (0..all.len()).filter(|&number| is_chosen(&all[number].name));
    Ok(numbers.collect())
}

/// The paths that were cut in the measurement of each instrument.
type CutsByName = Vec<(String, CutPaths)>;

/// Builds the scene and reads the instruments out.
fn measure(
    arguments: &InstrumentsArguments,
    scene: &Description,
    chosen: &[usize],
    budget: &Budget,
    signals: &Signals,
) -> Result<MeasuredRows, Failure> {
    needs::check_geometry(scene, "measurement", arguments.memory)?;
    let mut measured = MeasuredRows::default();
    let Some((sampler, first)) = sets_of(scene) else {
        return Ok(measured);
    };
    let building = Building {
        memory: arguments.memory,
        cache: Some(&arguments.cache),
        wavelengths: Some(&sampler),
    };
    let mut world = building.world(scene)?;
    // Things that are drawn again come to rest without a line on how far they are.
    let options = BuildOptions {
        most_bytes: needs::most_bytes(arguments.memory),
        ..BuildOptions::default()
    };
    note(&world.notes);
    signals.begin_work();
    let time = arguments.time.map(Duration::from_secs_f64);
    let until = time.map(|time| Instant::now() + time);
    for (place, &number) in chosen.iter().enumerate() {
        let started = Instant::now();
        let Named { name, value: own } = &scene.instruments[number];
        let draws = own.realisations();
        let own = notes(&world, scene, number).into_iter();
        note(own.map(|note| format!("{name}: {note}")));
        let progress = Rays::new(name, budget, draws);
        let watch = Watch {
            until,
            stop: &signals.stop,
            tell: &|rays| progress.tell(rays),
        };
        let effort = Effort {
            budget: *budget,
            watch: Some(&watch),
        };
        let first = first[number];
        let found = read_out_watched(&mut world, scene, number, first, &effort, &options);
        let found = match found {
            Ok(found) => found,
            Err(error) => {
                measured.ended = Some(ReadOutEnd::Failed(Failure::bad(error)));
                break;
            }
        };
        report_cuts(name, &found.cut, scene.integrator.max_events);
        measured.cuts.push((name.clone(), found.cut));
        let is_short = found.draws < draws;
        if draws > 1 {
            report_draws(name, &found, draws);
        }
        let found = found.rows;
        let greatest = found.iter().map(|row| row.error).fold(0.0, f64::max);
        eprintln!(
            "{name}: {} figures in {:.1} s, standard errors up to {greatest:.1e}",
            found.len(),
            started.elapsed().as_secs_f64()
        );
        let rays = progress.rays();
        let is_open = |row: &&Row| {
            let allowed = budget.error.map(|target| target.allowed(row.value));
            let by_rays = row.parts.map_or(row.error, |parts| parts.by_rays);
            allowed.is_some_and(|allowed| by_rays > allowed)
        };
        let open = found.iter().filter(is_open).count();
        if open > 0 {
            eprintln!(
                "warning: {name}: {rays} rays are not enough for --error: {open} figures have greater \
                 standard errors, up to {greatest:.1e}"
            );
        }
        measured.rows.extend(found);
        let left = chosen[place + 1..].iter();
        let left = left.map(|&number| scene.instruments[number].name.as_str());
        let left: Vec<&str> = left.collect();
        let all = u64::from(draws) * budget.rays;
        let is_cut = is_short || open > 0 || (budget.error.is_none() && (1..all).contains(&rays));
        let is_stopped = signals.stop.load(Ordering::Relaxed);
        let is_over = is_stopped || until.is_some_and(|until| Instant::now() >= until);
        if is_over && (is_cut || !left.is_empty()) {
            let by = ["--time", "the interruption"][usize::from(is_stopped)];
            let rest = match left.as_slice() {
                [] => String::new(),
                left => format!("; not measured: {}", left.join(", ")),
            };
            eprintln!("note: {by} ended the measurement after {rays} rays of `{name}`{rest}");
            measured.ended = Some(if is_stopped {
                ReadOutEnd::Failed(Failure::Interrupted)
            } else {
                ReadOutEnd::Late
            });
            break;
        }
    }
    Ok(measured)
}

/// Says over how many draws figures are means, and by how much errors of draws exceed those of rays.
fn report_draws(name: &str, found: &Reading, wanted: u32) {
    let parts = || found.rows.iter().filter_map(|row| row.parts);
    let greatest = |part: fn(ErrorParts) -> f64| parts().map(part).fold(0.0, f64::max);
    if parts().next().is_none() {
        eprintln!(
            "warning: {name}: one of {wanted} draws was measured: errors hold for its leaves alone"
        );
        return;
    }
    eprintln!(
        "{name}: {} of {wanted} draws, errors by rays up to {:.1e}, by draws up to {:.1e}",
        found.draws,
        greatest(|parts| parts.by_rays),
        greatest(|parts| parts.by_draws)
    );
}

/// Says so if a limit cut paths.
fn report_cuts(name: &str, cut: &CutPaths, most_events: u32) {
    if cut.paths > 0 {
        eprintln!(
            "note: {name}: {} paths were cut after {most_events} events (`integrator.max_events`), or after \
             {MOST_TURNS} times through the sides of a canopy's box; what they carried, at most {:.1e} of the \
             light, counts as absorbed or is missing",
            cut.paths, cut.at_most
        );
    }
}

/// The progress of an instrument, a line every ten seconds.
struct Rays<'a> {
    name: &'a str,
    budget: &'a Budget,
    draws: u32,
    clock: Clock,
    followed: AtomicU64,
}

impl<'a> Rays<'a> {
    fn new(name: &'a str, budget: &'a Budget, draws: u32) -> Self {
        Self {
            name,
            budget,
            draws,
            clock: Clock::new(),
            followed: AtomicU64::new(0),
        }
    }

    fn rays(&self) -> u64 {
        self.followed.load(Ordering::Relaxed)
    }

    fn tell(&self, rays: u64) {
        self.followed.store(rays, Ordering::Relaxed);
        if !self.clock.is_due() {
            return;
        }
        let all = u64::from(self.draws).saturating_mul(self.budget.rays);
        let name = self.name;
        if let Some(error) = self.budget.error {
            let seconds = self.clock.seconds();
            eprintln!("{name}: {rays} rays after {seconds:.0} s, until --error {error}");
        } else {
            let after = self.clock.after(rays.max(1) as f64 / all as f64);
            eprintln!("{name}: {rays} of {all} rays {after}");
        }
    }
}
