//! `lamina grow`: a leaf's veins, blade, contents and measures as files.

mod about;
mod ages;
mod choice;
mod drawings;
mod fields;
pub(super) mod films;
mod frames;
mod grown;
mod individuals;
mod maps;
pub(super) mod outputs;

use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use leafmodel::compound::{CompoundLeaf, StalkKind, WholeLeaf};
use leafmodel::document::written::Extent;
use leafmodel::leaf::{Lamina, LeafPlan};
use leafmodel::measure::description::describe;
use leafmodel::measure::measure;
use leafmodel::plan_file::{leaf_beside_preset, leaf_to_toml};
use leafmodel::species::PRESETS;
use leafmodel::species::diagnosis::findings;
use serde_json::json;

use self::choice::Chosen;
pub(super) use self::choice::{NotChosen, Wish, is_word, unknown_preset};
use self::drawings::{Look, without_sources};
use self::films::Films;
use self::grown::Grown;
use self::outputs::{Kind, Outputs, finish};
use crate::checkpoint::PROGRAM;
use crate::cli::arguments::GrowArguments;
use crate::cli::needs;
use crate::cli::needs::on_threads;
use crate::cli::places::write_json;
use crate::cli::progress::Patience;
use crate::cli::signals::Signals;
use crate::cli::terminal::{Failure, say};
use crate::export::blade::{self, Parts};
use crate::export::daylight::{colour_in_daylight, in_daylight};
use crate::image::portable_network;

pub(super) fn run(arguments: &GrowArguments) -> Result<(), Failure> {
    if arguments.list {
        let longest = PRESETS.iter().map(|preset| preset.name.len()).max();
        for preset in PRESETS {
            let width = longest.unwrap_or(0);
            say(format!("{:<width$}  {}", preset.name, preset.about()));
        }
        return Ok(());
    }
    if arguments.about {
        about::tell(arguments.leaf.as_deref().unwrap_or_default())?;
        if !arguments.writes_anything() {
            return Ok(());
        }
    }
    let started = Instant::now();
    let outputs = Outputs::planned(arguments)?;
    let chosen = choice::choose(arguments.into(), outputs.show_only_veins(arguments))?;
    // Impossible requests are refused before anything is written.
    if arguments.fields.is_some() {
        fields::check(&chosen.plan)?;
    }
    if arguments.individuals.is_some() {
        individuals::check(&outputs)?;
    }
    films::check(&outputs.staged)?;
    if arguments.frames.is_some() {
        frames::check(&chosen.plan)?;
        if arguments.sources {
            frames::check_sources(&chosen.plan)?;
        }
    }
    if arguments.ages.is_some() {
        ages::check(&chosen.plan)?;
    }
    let grown = grown_plan(arguments, &outputs, &chosen.plan)?;
    if outputs.veins {
        check_memory(&grown, outputs.blade, arguments.memory)?;
    }
    let signals = Signals::listen()?;
    signals.begin_work();
    let work = || {
        carry_out(
            arguments,
            (&chosen, &grown),
            &outputs,
            &signals.stop,
            started,
        )
    };
    on_threads(arguments.threads, work)
}

/// Fails if the growth of a leaf needs more memory than `allowed`; a blade is made and painted only
/// if `has_blade`.
fn check_memory(plan: &LeafPlan, has_blade: bool, allowed: Option<f64>) -> Result<(), Failure> {
    let memory = plan.memory().map_err(Failure::bad)?;
    let mut needs = vec![(memory.veins, "veins")];
    if has_blade {
        needs.push((memory.blade, "the blade and its contents"));
    }
    needs::compare("growth", &needs, allowed)
}

/// Writes the materials of an OBJ and their pictures beside it, and returns the name of their file.
fn materials_beside(
    path: &Path,
    leaf: &WholeLeaf,
    plan: &LeafPlan,
    stop: &AtomicBool,
) -> Result<String, Failure> {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let mut pictures = Vec::new();
    for (number, blade) in leaf.blades.iter().enumerate() {
        let name = format!("{stem}-blade-{}.png", number + 1);
        let map = &blade.contents;
        let rgb = in_daylight(map, &plan.pigments, None);
        let png =
            portable_network::encoded(map.width, map.height, &rgb).map_err(Failure::system)?;
        finish(&path.with_file_name(&name), &png, stop)?;
        pictures.push(name);
    }
    let stalks = leaf.stalk_contents(plan).map_err(Failure::bad)?;
    let stalks = colour_in_daylight(&stalks, &plan.pigments);
    let materials = path.with_extension("mtl");
    finish(&materials, blade::mtl(&pictures, stalks).as_bytes(), stop)?;
    Ok(format!("{stem}.mtl"))
}

/// What has to grow of a plan: its form alone where nothing of its contents is written.
fn grown_plan(
    arguments: &GrowArguments,
    outputs: &Outputs,
    plan: &LeafPlan,
) -> Result<LeafPlan, Failure> {
    let writes_contents = arguments.contents.is_some() && arguments.ages.is_none();
    if writes_contents || outputs.show_colours() {
        Ok(plan.clone())
    } else {
        plan.form_alone().map_err(Failure::bad)
    }
}

/// The leaf that a command line names, with its margin and veins as they would be grown.
pub(super) fn named_plan(wish: Wish<'_>) -> Result<(String, LeafPlan), NotChosen> {
    let chosen = choice::choose(wish, true)?;
    Ok((chosen.name, chosen.plan))
}

fn carry_out(
    arguments: &GrowArguments,
    (chosen, to_grow): (&Chosen, &LeafPlan),
    outputs: &Outputs,
    stop: &AtomicBool,
    started: Instant,
) -> Result<(), Failure> {
    let (name, plan) = (chosen.name.as_str(), &chosen.plan);
    if let Some(count) = arguments.individuals {
        let _patience = Patience::about("growing");
        return individuals::write(chosen, outputs, count, arguments.size, stop);
    }
    write_plans(arguments, chosen, outputs, stop)?;
    if !outputs.veins {
        return Ok(());
    }
    let growing = Instant::now();
    let patience = Patience::about("growing");
    let grown = Grown::new(to_grow, outputs.blade, stop)?;
    drop(patience);
    let build_seconds = growing.elapsed().as_secs_f64();
    let _patience = Patience::about("drawing and writing");
    let Lamina {
        outline, network, ..
    } = grown.lamina();
    // With its stalks, and all its leaflets.
    let flat = grown.flat(plan)?;
    let (page, outlines, all_veins) = match &flat {
        Some(flat) => (flat.bounds(), flat.outlines.as_slice(), &flat.network),
        None => (outline.bounds(), std::slice::from_ref(outline), network),
    };
    let look = Look::asked_for(arguments, page, all_veins);
    for (path, kind) in &outputs.whole {
        let bytes = match *kind {
            Kind::Veins(format) => look.file(format, without_sources(outlines, all_veins), None)?,
            Kind::Ply | Kind::Obj => match &grown {
                Grown::Whole(leaf) => {
                    let parts = Parts::of(leaf, arguments.units);
                    eprintln!("{}: {}", path.display(), parts.extent());
                    if *kind == Kind::Ply {
                        blade::ply(&parts)
                    } else {
                        let materials = materials_beside(path, leaf, to_grow, stop)?;
                        blade::obj(&parts, &materials).into_bytes()
                    }
                }
                Grown::Flat { .. } => continue,
            },
            Kind::Film(_) | Kind::Mp4 | Kind::Toml => continue,
        };
        finish(path, &bytes, stop)?;
    }
    if let (Some(folder), None, Grown::Whole(leaf)) = (&arguments.contents, arguments.ages, &grown)
    {
        for (number, blade) in leaf.blades.iter().enumerate() {
            let name = match number {
                0 => name.to_owned(),
                _ => format!("{name}-{}", number + 1),
            };
            let (map, outline) = (&blade.contents, blade.lamina.intact());
            maps::write(folder, &name, map, outline, maps::day(plan), stop)?;
        }
    }
    if let Some(path) = &arguments.fields {
        fields::write(path, plan, grown.lamina(), stop)?;
    }
    if let Some(count) = arguments.frames {
        let films = Films::begun(&outputs.staged, arguments.film.timing(), count);
        frames::write(plan, grown.lamina(), outputs, &look, films, stop)?;
    }
    if let Some(count) = arguments.ages {
        let written = ages::Written {
            count,
            pixels: arguments.size,
            captions: arguments.caption,
            contents: arguments.contents.as_deref(),
            name,
        };
        let films = Films::begun(&outputs.staged, arguments.film.timing(), count);
        ages::write(plan, grown.lamina(), outputs, written, films, stop)?;
    }
    report_veins(arguments, chosen, &grown, stop)?;
    let seconds = started.elapsed().as_secs_f64();
    if let Some(path) = &arguments.stats {
        let report = json!({
            "leaf": name,
            "seconds": seconds,
            "build_seconds": build_seconds,
            "peak_mib": needs::peak_mib(),
            "nodes": all_veins.nodes().len(),
            "sources": all_veins.sources(),
            "steps": all_veins.steps(),
            "loops": all_veins.loops(),
            "triangles": grown.triangles(),
        });
        write_json(path, &report)?;
    }
    let triangles = grown
        .triangles()
        .map_or_else(String::new, |count| format!("{count} triangles, "));
    eprintln!(
        "{name}: {} vein nodes, {} loops, {} steps, {triangles}{seconds:.2} s",
        all_veins.nodes().len(),
        all_veins.loops(),
        all_veins.steps(),
    );
    Ok(())
}

/// Measures of the veins, and their description.
fn report_veins(
    arguments: &GrowArguments,
    chosen: &Chosen,
    grown: &Grown,
    stop: &AtomicBool,
) -> Result<(), Failure> {
    let (plan, preset) = (&chosen.plan, chosen.preset);
    let Lamina {
        outline, network, ..
    } = grown.lamina();
    if let Some(path) = &arguments.measure {
        if !network.map().is_flat() {
            eprintln!("note: the blade is curved; measures are those of its conformal map");
        }
        let measures = measure(outline, network, plan.venation.murray_exponent());
        let mut report = measures.json();
        report["program"] = PROGRAM.into();
        if let (Some(leaf), Some(report)) = (grown.compound(), report.as_object_mut()) {
            eprintln!("note: measures are those of the largest leaflet");
            report.insert("compound".to_owned(), compound_measures(leaf));
        }
        eprint!("{}", measures.table());
        finish(path, format!("{report:#}\n").as_bytes(), stop)?;
    }
    if arguments.describe {
        if grown.compound().is_some() {
            eprintln!("note: the description is that of the largest leaflet");
        }
        for line in describe(outline, network).text().lines() {
            say(line);
        }
        let found = findings(preset.unwrap_or_default(), plan, outline, network);
        if !found.is_empty() {
            say(about::findings_table(&found));
        }
    }
    Ok(())
}

/// The plan as files: what differs from the preset, or all of it.
fn write_plans(
    arguments: &GrowArguments,
    chosen: &Chosen,
    outputs: &Outputs,
    stop: &AtomicBool,
) -> Result<(), Failure> {
    let (name, plan) = (chosen.name.as_str(), &chosen.plan);
    let text = match chosen.preset {
        _ if arguments.full => leaf_to_toml(name, plan, Extent::All),
        Some(preset) => leaf_beside_preset(name, plan, preset),
        None => leaf_to_toml(name, plan, Extent::Changed),
    };
    let text = format!("# Written by Lamina {PROGRAM}.\n{text}");
    for (path, kind) in &outputs.whole {
        if *kind == Kind::Toml {
            finish(path, text.as_bytes(), stop)?;
        }
    }
    Ok(())
}

/// The number of leaflets and the lengths of the axes.
fn compound_measures(leaf: &CompoundLeaf) -> serde_json::Value {
    let length = |wanted: StalkKind| -> f64 {
        let stalks = leaf.stalks.iter().filter(|stalk| stalk.kind == wanted);
        let pieces = stalks.flat_map(|stalk| stalk.points.windows(2));
        // The sum starts from 0, since an empty sum is -0.
        pieces.fold(0.0, |sum, pair| sum + pair[0].distance(pair[1]))
    };
    json!({
        "leaflets": leaf.leaflets.len(),
        "petiole_length_mm": length(StalkKind::Petiole),
        "rachis_length_mm": length(StalkKind::Rachis),
        "pinnae_length_mm": length(StalkKind::Pinna),
        "petiolules_length_mm": length(StalkKind::Petiolule),
    })
}
